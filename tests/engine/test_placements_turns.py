"""Feature vectors in turned, mirrored and scaled surroundings are those that would be evaluated there."""

import numpy as np
import pytest
from placement_scenes import polygon

import geoanalogy as ga
from geoanalogy.placements.arrangement import arrangement_of
from geoanalogy.placements.lesson import Lesson
from geoanalogy.placements.one_each import middles
from geoanalogy.placements.signature import PARENT_BOX, Signature, signature
from geoanalogy.placements.turns import (
    TURNS,
    in_units,
    parent_shares,
    parent_sizes,
    turned_boxes,
    turned_outlines,
    turned_shares,
)

ROOM = [(0, 0), (6, 0), (6, 2.5), (4, 2.5), (4, 4), (0, 4)]
DOORS = [(1.0, 0.0, 0.9, 0.1), (5.9, 0.7, 0.1, 0.8)]
BOX = np.array([[0.3, 2.9, 1.5, 3.8], [4.5, 0.2, 5.7, 1.0]])


def laid(points, turn, scale=1.0):
    """Points of a box of 6 by 4 after a turn, at a scale."""
    p = np.asarray(points, float).copy()
    for axis, size in ((0, 6.0), (1, 4.0)):
        if turn[axis]:
            p[:, axis] = size - p[:, axis]
    return scale * (p[:, ::-1] if turn[2] else p)


def room(turn, scale=1.0):
    polygons = [ga.Polygon(laid(ROOM, turn, scale), "room", "r", orientation=0.0)]
    for x, y, w, h in DOORS:
        ring = [(x, y), (x + w, y), (x + w, y + h), (x, y + h)]
        polygons.append(ga.Polygon(laid(ring, turn, scale), "door"))
    scene = ga.Scene(polygons)
    return arrangement_of(scene, scene.polygon("r"), 0.0)


def boxes_in(turn, scale=1.0):
    corners = np.stack([laid(BOX[:, :2], turn, scale), laid(BOX[:, 2:], turn, scale)])
    return np.hstack([corners.min(axis=0), corners.max(axis=0)])


def turned(seen, turn):
    boxes = {key: turned_boxes(values, turn) for key, values in seen.boxes.items()}
    return Signature(boxes, turned_outlines(seen.outlines, turn))


@pytest.mark.parametrize("turn", TURNS)
@pytest.mark.parametrize("scale", [1.0, 2.5])
def test_a_turned_feature_vector_is_that_of_the_turned_room(turn, scale):
    here = in_units(turned(signature(room(TURNS[0]), BOX, 3), turn), 1 / scale)
    there = signature(room(turn, scale), boxes_in(turn, scale), 3)
    assert here.boxes.keys() == there.boxes.keys() and here.outlines.keys() == there.outlines.keys()
    for key, values in there.boxes.items():
        assert here.boxes[key] == pytest.approx(values, abs=1e-9, nan_ok=True)
    for key, values in there.outlines.items():
        assert here.outlines[key] == pytest.approx(values, abs=1e-9, nan_ok=True)


def lesson(*rows):
    scene = ga.Scene([ga.Polygon(ROOM, "room", orientation=0.0)])
    drawn = [ga.Rectangle.from_box(BOX[i], 0.0) for i in rows]
    model = ga.learn_placement([ga.Example(scene, r) for r in drawn])
    return Lesson(model.lesson.taught, signature(room(TURNS[0]), BOX[list(rows)], 3), model.options)


@pytest.mark.parametrize("count", [1, 3])
def test_similarities_and_habits_in_all_turns_are_those_of_every_turned_feature_vector(count):
    learned = lesson(0, 1)
    at = np.random.default_rng(3).uniform(0, 3, (200, 2))
    seen = signature(room(TURNS[0]), np.hstack([at, at + 0.7]), count)
    similar, habit = learned.turned_similarities(seen, count), learned.habits.turned(seen)
    assert similar.max() > 0.05 and np.ptp(similar, axis=0).max() > 0.01
    for i, turn in enumerate(TURNS):
        there = turned(seen, turn)
        assert similar[i] == pytest.approx(learned.similarities(learned.match(there, count)), abs=1e-6)
        assert habit[i] == pytest.approx(learned.habits.kept_to(there)[0].mean(axis=(1, 2)), abs=1e-9)


def test_boxes_that_share_an_extent_are_compared_once_and_all_are_answered():
    at = np.stack(np.meshgrid(np.linspace(0, 3, 12), np.linspace(0, 2, 10)), axis=-1).reshape(-1, 2)
    seen = signature(room(TURNS[0]), np.hstack([at, at + 0.7]), 1)
    for axis, count in ((0, 12), (1, 10)):
        values = seen.boxes[PARENT_BOX][:, :, axis]
        first, kind = seen.distinct(PARENT_BOX, axis)
        assert len(first) == count and values[first][kind] == pytest.approx(values, abs=1e-12)


def test_shares_and_sizes_of_parents_follow_from_feature_vectors():
    seen = signature(room(TURNS[0]), BOX, 3)
    assert parent_sizes(seen) == pytest.approx(np.array([[6, 4], [6, 4]]))
    assert parent_shares(seen) == pytest.approx(BOX / [6, 4, 6, 4])
    assert parent_shares(seen, [1]) == pytest.approx(BOX[1:] / [6, 4, 6, 4])
    for turn in TURNS:
        after = turned_boxes(seen.boxes[PARENT_BOX], turn)
        assert turned_shares(parent_shares(seen), turn) == pytest.approx(
            after[:, 0][:, :, [0, 2], 3].transpose(0, 2, 1).reshape(2, 4)
        )


def test_every_turn_is_undone_by_one_of_them():
    shares = np.array([[0.1, 0.2, 0.4, 0.9]])
    for turn in TURNS:
        assert any(np.allclose(turned_shares(turned_shares(shares, turn), back), shares) for back in TURNS)


def test_the_middle_of_mirrored_boxes_is_found_after_turning_them_back():
    first = np.array([0.1, 0.1, 0.4, 0.3])
    near = np.add(first, [0.02, 0, 0.02, 0])
    mirrored = turned_shares(np.add(first, [0.04, 0, 0.04, 0])[None], TURNS[3])[0]
    central = middles(np.array([first, near, mirrored]))
    assert np.abs(central - near).max(axis=1).min() < 1e-12


def rooms(*turns):
    """Rooms of many sizes side by side, a toilet in the corner away from the door in each; the last one is bare."""
    polygons, shown, x = [], [], 0.0
    for i, (turn, scale) in enumerate(turns):
        outline = laid([(0, 0), (6, 0), (6, 4), (0, 4)], turn, scale)
        wide = outline[:, 0].max()
        polygons.append(ga.Polygon(np.add(outline, (x, 0)), "restroom", f"r{i}", orientation=0.0))
        door = laid([(0.5, 0), (1.5, 0), (1.5, 0.1), (0.5, 0.1)], turn, scale)
        polygons.append(ga.Polygon(np.add(door, (x, 0)), "opening", f"d{i}", parent=f"r{i}"))
        corners = laid([(4.6, 3.0), (6.0, 4.0)], turn, scale)
        shown.append((*np.add(corners.min(axis=0), (x, 0)), *np.add(corners.max(axis=0), (x, 0))))
        x += wide + 1
    return ga.Scene(polygons), shown


def box_of(r):
    return r.x - r.width / 2, r.y - r.height / 2, r.x + r.width / 2, r.y + r.height / 2


def placed_in(scene, boxes, threshold=None):
    examples = [ga.Example(scene, ga.Rectangle((a + c) / 2, (b + d) / 2, c - a, d - b)) for a, b, c, d in boxes]
    return [np.array(box_of(p.rectangle)) for p in ga.learn_placement(examples).place(scene, threshold)]


def test_rooms_are_furnished_in_any_scale():
    scene, (*boxes, wanted) = rooms((TURNS[0], 1.0), (TURNS[0], 1.3), (TURNS[0], 0.8), (TURNS[0], 1.7))
    assert placed_in(scene, boxes)[0] == pytest.approx(np.array(wanted), abs=0.02 * 6 * 1.7)


def test_the_mirror_image_is_among_what_a_mirrored_room_is_offered():
    scene, (*boxes, wanted) = rooms((TURNS[0], 1.0), (TURNS[0], 1.3), (TURNS[1], 0.8), (TURNS[1], 1.7))
    offered = placed_in(scene, boxes, 0.1)[:5]
    assert min(np.abs(box - wanted).max() for box in offered) < 0.1 * 6 * 1.7


def test_a_parent_that_holds_one_placement_offers_the_one_in_the_midst_of_the_examples_first():
    shares = [(0.1, 0.1, 0.9, 0.5), (0.1, 0.12, 0.9, 0.55), (0.1, 0.05, 0.9, 0.7)]
    polygons, examples = [], []
    for i in range(4):
        polygons.append(polygon(12 * i, 0, 8 + i % 2, 10 - i % 3, "plot", f"p{i}"))
    scene = ga.Scene(polygons)
    for share, plot in zip(shares, scene.polygons, strict=False):
        x0, y0, x1, y1 = plot.bounds
        a, b = x0 + share[0] * (x1 - x0), y0 + share[1] * (y1 - y0)
        c, d = x0 + share[2] * (x1 - x0), y0 + share[3] * (y1 - y0)
        examples.append(ga.Example(scene, ga.Rectangle((a + c) / 2, (b + d) / 2, c - a, d - b)))
    found = ga.learn_placement(examples).place(scene)
    assert {p.parent.id for p in found} == {"p3"}
    x0, y0, x1, y1 = scene.polygon("p3").bounds
    r = found[0].rectangle
    top = (r.y + r.height / 2 - y0) / (y1 - y0)
    assert 0.45 < top < 0.65
    assert r.width == pytest.approx(0.8 * (x1 - x0), rel=0.05)
