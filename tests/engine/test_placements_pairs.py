"""Shutters that were shown on both sides of windows are placed in pairs."""

import numpy as np
import pytest
from placement_scenes import facade

import geoanalogy as ga
from geoanalogy.placements.arrangement import arrangement_of
from geoanalogy.placements.pairs import paired_about, twins

WIDTH, COLUMNS, ROWS = 0.4, 4, 3


def shutter(scene, id, side, gap=0.1):
    """Beside a window, at its left (-1) or right (1)."""
    x0, y0, x1, y1 = scene.polygon(id).bounds
    x = (x0 + x1) / 2 + side * ((x1 - x0) / 2 + gap + WIDTH / 2)
    return ga.Rectangle(x, (y0 + y1) / 2, WIDTH, y1 - y0)


def lesson_of(scene, rectangles):
    return ga.learn_placement([ga.Example(scene, r) for r in rectangles]).lesson


@pytest.fixture
def scene():
    return ga.Scene(facade(0, COLUMNS, ROWS))


def test_examples_on_both_sides_of_windows_come_in_pairs(scene):
    assert paired_about(lesson_of(scene, [shutter(scene, "f 0 0", -1), shutter(scene, "f 1 1", 1)])) == "window"


@pytest.mark.parametrize("side", [-1, 1])
def test_examples_on_one_side_do_not(scene, side):
    assert paired_about(lesson_of(scene, [shutter(scene, f"f {i} {i}", side) for i in range(3)])) is None


def test_what_is_larger_than_what_it_stands_beside_does_not(scene):
    def wide(id, side):
        x0, y0, x1, y1 = scene.polygon(id).bounds
        return ga.Rectangle((x0 + x1) / 2 + side * 1.5, (y0 + y1) / 2, 1.6, y1 - y0)

    assert paired_about(lesson_of(scene, [wide("f 1 0", -1), wide("f 2 1", 1)])) is None


def test_what_is_below_does_not(scene):
    def below(id, side):
        x0, y0, x1, _ = scene.polygon(id).bounds
        return ga.Rectangle((x0 + x1) / 2 + side * 0.4, y0 - 0.3, 0.4, 0.2)

    assert paired_about(lesson_of(scene, [below("f 0 0", -1), below("f 1 1", 1)])) is None


def box_of(rectangle):
    return rectangle.box(0.0)[0]


def test_a_twin_is_the_mirror_image_about_the_element(scene):
    arrangement = arrangement_of(scene, scene.polygon("f"), 0.0)
    boxes = np.array([box_of(shutter(scene, "f 1 1", side)) for side in (-1, 1)])
    found, of = twins("window", arrangement, boxes)
    assert found == pytest.approx(boxes[::-1])
    assert of.tolist() == [0, 1]


def test_what_has_no_twin(scene):
    arrangement = arrangement_of(scene, scene.polygon("f"), 0.0)
    left, right = (np.array(scene.polygon(id).bounds) for id in ("f 1 1", "f 2 1"))
    middle = (left[2] + right[0]) / 2
    amid = [middle - 0.2, left[1], middle + 0.2, left[3]]  # as near to one window as to the other
    across = [left[0], left[1], left[0] + 1.0, left[3]]
    beyond = [left[0], -9.0, left[0] + 0.1, -8.0]
    assert len(twins("window", arrangement, np.array([amid, across, beyond]))[0]) == 0
    assert len(twins("lamp", arrangement, np.array([amid]))[0]) == 0
    assert len(twins("window", arrangement, np.zeros((0, 4)))[0]) == 0


def test_both_sides_of_every_window_are_placed(scene):
    examples = [
        ga.Example(scene, shutter(scene, id, side)) for id, side in (("f 0 0", -1), ("f 2 1", -1), ("f 1 2", 1))
    ]
    found = ga.learn_placement(examples).place(scene)
    wanted = [box_of(shutter(scene, f"f {i} {j}", s)) for i in range(COLUMNS) for j in range(ROWS) for s in (-1, 1)]
    shown = [box_of(e.rectangle) for e in examples]
    missing = [w for w in wanted if not any(np.allclose(w, b) for b in shown)]
    placed = np.array([box_of(p.rectangle) for p in found])
    assert len(placed) == len(missing)
    assert all(np.abs(placed - w).max(axis=1).min() < 0.02 for w in missing)


def test_a_rejected_twin_takes_its_like_along(scene):
    shown = [ga.Example(scene, shutter(scene, id, side)) for id, side in (("f 0 0", -1), ("f 2 1", -1), ("f 1 2", 1))]
    rejected = [ga.Example(scene, shutter(scene, f"f {i} 0", 1), target=0.0) for i in (0, 2)]

    def score_of(model, rectangle):
        wanted = box_of(rectangle)
        some = [p.score for p in model.place(scene, 0.01) if np.abs(box_of(p.rectangle) - wanted).max() < 0.05]
        return max(some, default=0.0)

    twin = shutter(scene, "f 3 0", 1)
    before = score_of(ga.learn_placement(shown), twin)
    assert before >= 0.5
    assert score_of(ga.learn_placement(shown + rejected), twin) < before - 0.2
