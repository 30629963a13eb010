"""Windows drawn by eye on a plain facade go on evenly: equal sizes, equal gaps, one height per row."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from placement_scenes import polygon

import geoanalogy as ga
from geoanalogy.placements.lattice import lattice

WIDTH, HEIGHT, STEP, STOREY = 1.2, 1.6, 2.6, 3.2
#: Columns and rows of the examples.
DRAWN = {
    "row": [(0, 0), (1, 0), (2, 0)],
    "gap": [(0, 0), (1, 0), (3, 0)],
    "corner": [(0, 0), (1, 0), (0, 1)],
    "two rows": [(0, 1), (1, 1), (1, 0), (2, 0)],
}


def drawn_by_eye(places, seed, noise=0.03):
    """Windows whose sizes and places are off by up to three percent of their size."""
    rng = np.random.default_rng(seed)
    for i, j in places:
        width, height = np.array([WIDTH, HEIGHT]) * (1 + rng.uniform(-noise, noise, 2))
        x, y = np.array([2.0 + STEP * i, 2.8 + STOREY * j]) + rng.uniform(-noise, noise, 2) * (width, height)
        yield ga.Rectangle(x, y, width, height)


def plain(*more, width=20.0, height=9.0):
    return ga.Scene([polygon(0, 0, width, height, "facade", "f"), *more])


def placed(scene, drawn):
    return ga.learn_placement([ga.Example(scene, r) for r in drawn]).place(scene)


def edges(rectangles):
    rows = [(r.x - r.width / 2, r.y - r.height / 2, r.x + r.width / 2, r.y + r.height / 2) for r in rectangles]
    return np.array(rows).reshape(-1, 4)


@pytest.mark.parametrize("places", DRAWN.values(), ids=DRAWN)
@pytest.mark.parametrize("door", [False, True])
@settings(max_examples=8, deadline=None)
@given(seed=st.integers(0, 10_000))
def test_windows_drawn_by_eye_go_on_evenly(places, door, seed):
    scene = plain(*([polygon(9.3, 0, 1.4, 1.6, "door", "d")] if door else []))
    drawn = list(drawn_by_eye(places, seed))
    found = [c.rectangle for c in placed(scene, drawn)]
    rows = {j for _, j in places}
    assert len(found) == 7 * len(rows) - len(places)
    boxes = edges(found)
    sizes = boxes[:, 2:] - boxes[:, :2]
    assert np.ptp(sizes, axis=0) == pytest.approx([0, 0], abs=1e-9)
    assert sizes[0] == pytest.approx([WIDTH, HEIGHT], rel=0.03)
    # One grid: whole steps between any two, and one height for each row.
    x = np.sort(np.unique(np.round(boxes[:, 0], 9)))
    steps = np.diff(x) / np.diff(x).min()
    assert np.diff(x).min() == pytest.approx(STEP, rel=0.05)
    assert steps == pytest.approx(np.round(steps), abs=1e-6)
    assert len(np.unique(np.round(boxes[:, 1], 9))) == len(rows)
    # Nothing touches anything, and examples are in step as well as they were drawn.
    every = np.concatenate([boxes, edges(drawn)])
    low, high = np.maximum(every[:, None, :2], every[None, :, :2]), np.minimum(every[:, None, 2:], every[None, :, 2:])
    apart = (low - high).max(axis=2)[~np.eye(len(every), dtype=bool)]
    assert apart.min() >= 0.85 * min(STEP - WIDTH, STOREY - HEIGHT)


def test_what_stands_in_the_way_is_left_out():
    scene = plain(polygon(9.2, 0, 1.2, 3.4, "door", "d"))
    found = placed(scene, drawn_by_eye(DRAWN["two rows"], 0, 0.0))
    assert len(found) == 9
    assert all(abs(c.rectangle.x - 9.8) > 1 for c in found if c.rectangle.y < 4)


def test_a_rejected_place_stays_empty():
    scene = plain()
    drawn = list(drawn_by_eye(DRAWN["row"], 0, 0.0))
    examples = [ga.Example(scene, r) for r in drawn]
    examples.append(ga.Example(scene, ga.Rectangle(2.0 + 3 * STEP, 2.8, WIDTH, HEIGHT), target=0.0))
    found = ga.learn_placement(examples).place(scene)
    assert all(abs(c.rectangle.x - (2.0 + 3 * STEP)) > 1 for c in found)


def test_elements_that_are_repeated_say_more_than_rows_of_examples():
    sills = [polygon(x, 2.8, 1.2, 0.2, "sill", f"s{x}") for x in (1.4, 4.0, 6.6, 11.4, 16.0)]
    scene = plain(*sills)
    drawn = [ga.Rectangle(s.bounds[0] + 0.6, 3.8, WIDTH, HEIGHT) for s in sills[:3]]
    found = sorted(c.rectangle.x for c in placed(scene, drawn))
    assert found == pytest.approx([12.0, 16.6], abs=1e-6)


def test_what_fills_rows_is_surer_than_what_continues_them():
    found = placed(plain(), drawn_by_eye(DRAWN["gap"], 1))
    assert found[0].rectangle.x == pytest.approx(2.0 + 2 * STEP, abs=0.1)
    assert found[0].score > found[1].score > 0.5


@pytest.mark.parametrize("scale", [0.01, 1.0, 1000.0])
def test_rows_keep_the_margin_of_the_outermost_or_half_a_gap(scale):
    def rows(*middles):
        return np.array([(m - 0.5, m + 0.5) for m in middles]) * scale

    found = lattice(rows(2.0, 4.0, 6.0), 0.0, 10.0 * scale)
    assert found.mean(axis=1) / scale == pytest.approx([2, 4, 6, 8])
    found = lattice(rows(2.0, 4.0, 6.0), 1.2 * scale, 8.8 * scale)
    assert found.mean(axis=1) / scale == pytest.approx([2, 4, 6, 8])
    found = lattice(rows(2.0, 4.0, 6.0), 1.2 * scale, 8.6 * scale)
    assert found.mean(axis=1) / scale == pytest.approx([2, 4, 6])


def test_a_step_may_be_half_the_least_distance_and_rows_without_a_step_are_no_lattice():
    def rows(*middles):
        return np.array([(m - 0.5, m + 0.5) for m in middles])

    assert lattice(rows(2.0, 5.0, 9.5), 0.0, 12.0).mean(axis=1) == pytest.approx([2, 3.5, 5, 6.5, 8, 9.5, 11])
    assert lattice(rows(2.0, 4.0, 7.2), 0.0, 20.0) is None
    assert lattice(rows(2.0, 3.3, 5.25), 0.0, 20.0) is None
    assert lattice(rows(3.0), 0.0, 20.0).tolist() == [[2.5, 3.5]]
