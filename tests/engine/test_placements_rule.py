"""The learned rule in words."""

from placement_scenes import below, facade, polygon

import geoanalogy as ga

STREET = ga.Scene(facade(0, 4, 3) + facade(20, 5, 4, name="g"))


def rule_of(scene, rectangles, **options):
    model = ga.learn_placement([ga.Example(scene, r) for r in rectangles], ga.PlacementOptions(**options))
    return {r.text: r for r in model.rule()}


def test_a_sill_is_below_the_window_and_as_wide():
    told = rule_of(STREET, [below(STREET, i, gap=0.5, overhang=0.0) for i in ("f 0 0", "g 2 1", "g 1 2")])
    assert told["0.3 below the window"].weight > 0.95
    assert told["same width as the window"].label == "window"
    assert not any("facade" in text and "from" not in text for text in told)


def test_what_touches_says_so():
    told = rule_of(STREET, [below(STREET, i) for i in ("f 0 0", "g 2 1", "g 1 2")])
    assert "touching the lower edge of the window" in told


def test_what_the_examples_differ_in_is_left_out():
    rooms = ga.Scene([polygon(0, 0, 8, 6, "room", "a"), polygon(10, 0, 5, 6, "room", "b")])
    told = rule_of(rooms, [ga.Rectangle(1, 3, 2, 1), ga.Rectangle(11, 3, 2, 1)])
    assert "left edge flush with the left edge of the room" in told
    assert not any("right edge of the room" in text for text in told)
    assert "centred vertically on the room" in told


def test_a_size_that_is_always_the_same_is_told():
    wall = ga.Scene([polygon(0, 0, 12, 6, "wall", "a"), polygon(20, 0, 7, 9, "wall", "b")])
    told = rule_of(wall, [ga.Rectangle(2, 4, 1, 1.5), ga.Rectangle(5, 1.5, 1, 1.5), ga.Rectangle(24, 6, 1, 2.5)])
    assert told["1 wide"].weight == 1.0 and told["1 wide"].label == ""
    assert not any(text.endswith("high") for text in told)
    told = rule_of(STREET, [below(STREET, i, overhang=0.0) for i in ("f 0 0", "g 2 1", "g 1 2")])
    assert "same width as the window" in told and not any(text.endswith("wide") for text in told)


def test_shares_are_told_where_they_alone_agree():
    rooms = ga.Scene([polygon(0, 0, 8, 6, "room", "a"), polygon(10, 0, 4, 6, "room", "b")])
    told = rule_of(rooms, [ga.Rectangle(3, 3, 2, 1), ga.Rectangle(11.5, 3, 1, 1)])
    assert "from 25% to 50% of the width of the room" in told


def test_the_surest_come_first_and_weights_are_shares():
    rule = ga.learn_placement([ga.Example(STREET, below(STREET, i)) for i in ("f 0 0", "g 2 1")]).rule()
    weights = [r.weight for r in rule]
    assert weights == sorted(weights, reverse=True)
    assert all(0.5 <= w <= 1 for w in weights)


def test_a_result_says_why():
    model = ga.learn_placement([ga.Example(STREET, below(STREET, i)) for i in ("f 0 0", "g 2 1", "g 1 2")])
    best = model.place(STREET)[0]
    assert best.relations[0].label == "window"
    assert best.relations[0].weight > 0.9
    assert all(0 <= r.weight <= 1 for r in best.relations)
