"""What cannot be learned from, one sentence each."""

import pytest
from placement_scenes import facade, polygon

import geoanalogy as ga

SCENE = ga.Scene(facade(0, 3, 2))
PLACE = ga.Rectangle(2, 3.2, 1, 0.3)


def example(*values, target=1.0):
    return ga.Example(SCENE, ga.Rectangle(*values), target)


@pytest.mark.parametrize(
    ("examples", "message"),
    [
        ([], "there are no examples to learn from; draw at least one rectangle"),
        ([example(2, 3.2, 1, 0.3, target=0)], "all examples have the target 0"),
        (
            [example(2, 3.2, 1, 0.3), example(2, 3.2, 1, 0.3, target=0.5)],
            r"the rectangle at x 2, y 3.2 is given twice, with the targets 1 and 0.5; keep one",
        ),
        ([example(200, 3, 1, 1)], "the example at x 200, y 3 lies in no polygon of its scene; draw it inside one"),
        (
            [example(2, 3.2, 1, 0.3), example(200, 3, 1, 1)],
            "the example at x 200, y 3 lies outside every polygon labelled 'facade'",
        ),
        ([PLACE], r"examples are of the type Example, not Rectangle; give Example\(scene"),
    ],
)
def test_examples_that_teach_nothing(examples, message):
    with pytest.raises(ga.InputError, match=message):
        ga.learn_placement(examples)


@pytest.mark.parametrize("target", [-0.1, 1.5, float("nan")])
def test_a_target_outside_its_range(target):
    with pytest.raises(ga.InputError, match=r"the example at x 2, y 3\.2 has the target"):
        ga.Example(SCENE, PLACE, target)


def test_a_rectangle_drawn_twice_counts_once():
    once = ga.learn_placement([ga.Example(SCENE, PLACE)])
    twice = ga.learn_placement([ga.Example(SCENE, PLACE), ga.Example(SCENE, PLACE)])
    assert once.to_dict() == twice.to_dict()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"tau": 0}, "the option tau is 0; give a positive number"),
        ({"area_tolerance": -1}, "the option area_tolerance is -1"),
        ({"threshold": 1.2}, "the option threshold is 1.2; give a number from 0 to 1"),
        ({"allow_overlaps": -0.1}, "the option allow_overlaps is -0.1"),
        ({"neighbours": 0}, "the option neighbours is 0; give a whole number from 1"),
    ],
)
def test_options_out_of_range(options, message):
    with pytest.raises(ga.InputError, match=message):
        ga.PlacementOptions(**options)


def test_a_threshold_out_of_range():
    model = ga.learn_placement([ga.Example(SCENE, PLACE)])
    with pytest.raises(ga.InputError, match="the threshold is 2; give a number from 0 to 1"):
        model.place(SCENE, threshold=2)


@pytest.mark.parametrize(
    ("plain", "message"),
    [
        ({"schema": "something else"}, "this is no stored placement model"),
        ([], "this is no stored placement model"),
        ({"schema": "geoanalogy.placement/1"}, "the stored placement model is damaged"),
    ],
)
def test_what_is_no_stored_model(plain, message):
    with pytest.raises(ga.InputError, match=message):
        ga.PlacementModel.from_dict(plain)


def test_infinite_tolerances_survive_storing():
    options = ga.PlacementOptions(aspect_tolerance=float("inf"))
    model = ga.learn_placement([ga.Example(SCENE, PLACE)], options)
    assert ga.PlacementModel.from_dict(model.to_dict()).options == options


def test_the_parent_is_the_smallest_label_that_contains_every_example():
    scene = ga.Scene([polygon(0, 0, 20, 20, "wall"), polygon(1, 1, 3, 3, "window", "a"), polygon(8, 8, 3, 3, "window")])
    inside = [ga.Example(scene, ga.Rectangle(2, 2, 1, 1)), ga.Example(scene, ga.Rectangle(9, 9, 1, 1))]
    assert ga.learn_placement(inside).label == "window"
    overlapping = [inside[0], ga.Example(scene, ga.Rectangle(4, 4, 3, 1))]
    assert ga.learn_placement(overlapping).label == "wall"
    jutting = [ga.Example(scene, ga.Rectangle(19.6, 5, 1.5, 1))]
    assert ga.learn_placement(jutting).label == "wall"
