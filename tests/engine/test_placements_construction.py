"""Rules that all examples keep to exactly say where placements are, whatever else may be."""

import numpy as np
import pytest

import geoanalogy as ga
from geoanalogy.placements.arrangement import arrangement_of
from geoanalogy.placements.construction import construction, is_constructed


def rectangle(x0, y0, x1, y1):
    return ga.Rectangle((x0 + x1) / 2, (y0 + y1) / 2, x1 - x0, y1 - y0)


def ring(x0, y0, x1, y1):
    return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]


def walls(sizes):
    """Walls of given sizes, one above the other so that none shares an origin with another."""
    return ga.Scene([ga.Polygon(ring(0, 50 * i, w, 50 * i + h), "wall", f"w{i}") for i, (w, h) in enumerate(sizes)])


def lesson_of(scene, boxes):
    return ga.learn_placement([ga.Example(scene, rectangle(*b)) for b in boxes])


def box_of(placement):
    r = placement.rectangle
    return r.x - r.width / 2, r.y - r.height / 2, r.x + r.width / 2, r.y + r.height / 2


def in_margins(scene, margins=(3.0, 2.0, 3.5, 1.5)):
    left, low, right, high = margins
    return [
        (x0 + left, y0 + low, x1 - right, y1 - high) for x0, y0, x1, y1 in (p.bounds.tolist() for p in scene.polygons)
    ]


@pytest.mark.parametrize("count", [3, 4, 5, 6, 10])
def test_more_examples_with_fixed_margins_make_the_right_box_surer_not_less_sure(count):
    sizes = [
        (18, 9.97),
        (12, 9.97),
        (12, 10.4),
        (12, 10.4),
        (18, 13.65),
        (20, 12),
        (14, 11.1),
        (11, 14),
        (17, 15),
        (16, 8),
    ]
    scene = walls([*sizes[:count], (15, 11)])
    *boxes, wanted = in_margins(scene)
    (found,) = [p for p in lesson_of(scene, boxes).place(scene) if p.parent.id == f"w{count}"]
    assert box_of(found) == pytest.approx(wanted, abs=1e-6)
    assert found.score > 0.8


def test_where_the_rule_leaves_no_room_nothing_is_placed():
    scene = walls([(18, 10), (12, 11), (14, 9), (6, 10), (9, 13)])
    boxes = in_margins(scene)
    found = {p.parent.id for p in lesson_of(scene, boxes[:3]).place(scene)}
    assert found == {"w4"}


def test_what_is_flush_with_a_window_is_placed_at_every_window():
    polygons, shown, wanted = [], [], []
    for i, (width, count) in enumerate([(9, 2), (13, 3), (11, 2), (16, 4)]):
        y = 20 * i
        polygons.append(ga.Polygon(ring(0, y, width, y + 6), "facade", f"f{i}"))
        for k in range(count):
            x = 1.2 + 3.1 * k + 0.37 * i
            polygons.append(ga.Polygon(ring(x, y + 2, x + 1.2 + 0.1 * i, y + 3.5), "window", f"f{i} {k}"))
            below = (x - 0.1, y + 1.7, x + 1.3 + 0.1 * i, y + 1.9)
            if i < 3 and k == i % count:
                shown.append(below)
            elif i == 3:
                wanted.append(below)
    scene = ga.Scene(polygons)
    found = [box_of(p) for p in lesson_of(scene, shown).place(scene) if p.parent.id == "f3"]
    assert np.array(sorted(found)) == pytest.approx(np.array(sorted(wanted)), abs=1e-6)


def test_of_contradicting_rules_the_placement_most_like_the_examples_is_meant():
    # The examples' walls are all of one height: the distances from below, from above and the share agree in all.
    scene = walls([(10, 8), (13, 8), (16, 8), (19, 8), (12, 9)])
    boxes = [(1.0, y0, 2.0, y0 + 2.1) for y0 in (0.0, 50.0, 100.0, 150.0)]
    (found,) = [p for p in lesson_of(scene, boxes).place(scene) if p.parent.id == "w4"]
    x0, y0, x1, _ = box_of(found)
    assert (x0, y0, x1) == pytest.approx((1.0, 200.0, 2.0), abs=1e-6)
    assert found.score >= 0.5


def test_a_box_that_would_cover_what_no_example_covers_is_not_placed():
    scene = walls([(18, 10), (12, 11), (14, 9), (15, 12)])
    *boxes, blocked = in_margins(scene)
    door = ga.Polygon(ring(*blocked), "door", "door")
    open_, built = scene, ga.Scene([*scene.polygons, door])
    lesson = lesson_of(open_, boxes)
    assert [p.parent.id for p in lesson.place(open_)] == ["w3"]
    assert not lesson.place(built)


def test_elsewhere_things_are_searched_for():
    scene = walls([(18, 10), (12, 11), (14, 9)])
    boxes = in_margins(scene)
    assert is_constructed(lesson_of(scene, boxes[:2]).lesson)
    assert not is_constructed(lesson_of(scene, boxes[:1]).lesson)  # a single example
    askew = [boxes[0], tuple(np.add(boxes[1], 0.05))]
    assert not is_constructed(lesson_of(scene, askew).lesson)  # drawn by eye
    counter = [ga.Example(scene, rectangle(*boxes[0])), ga.Example(scene, rectangle(*boxes[1]))]
    rejected = ga.learn_placement([*counter, ga.Example(scene, rectangle(*boxes[2]), target=0.0)])
    assert not is_constructed(rejected.lesson)


def test_where_all_stands_the_other_way_round_the_rule_does_not_decide():
    def room(i, mirrored, width):
        y = 20.0 * i
        flip = (lambda b: (width - b[2], b[1], width - b[0], b[3])) if mirrored else (lambda b: b)
        door, box = flip((0.5, y, 1.5, y + 0.1)), flip((2.0, y + 0.2, 2.6, y + 1.0))
        return [ga.Polygon(ring(0, y, width, y + 4), "room", f"r{i}"), ga.Polygon(ring(*door), "door", f"d{i}")], box

    made = [room(0, False, 5.0), room(1, False, 6.0), room(2, False, 7.0), room(3, True, 6.5), room(4, False, 6.2)]
    scene = ga.Scene([p for polygons, _ in made for p in polygons])
    model = lesson_of(scene, [box for _, box in made[:3]])
    arrangements = [arrangement_of(scene, scene.polygon(f"r{i}"), 0.0) for i in (3, 4)]
    mirrored, familiar = (construction(model.lesson, a) for a in arrangements)
    assert familiar.boxes[0] == pytest.approx(made[4][1])
    assert mirrored is None or mirrored.certainty.max() < familiar.certainty.max()
