"""Results that resemble no example stand in the middle of what is likely around them."""

import numpy as np
import pytest
from placement_scenes import below, facade, polygon

import geoanalogy as ga
from geoanalogy.placements.arrangement import arrangement_of
from geoanalogy.placements.refinement import OWN_WEIGHT, colliding, copied, middle, snapped

BOX = np.array([[0.0, 0.0, 2.0, 1.0]])


def test_the_middle_weighs_candidates_by_their_certainty():
    around = np.array([[0.2, 0.0, 2.2, 1.0], [0.0, 0.1, 2.0, 1.1]])
    moved = middle(BOX, around, np.array([1.0, 0.5]))
    whole = OWN_WEIGHT + 1.5
    assert moved == pytest.approx(BOX + np.array([[0.2, 0.05, 0.2, 0.05]]) / whole)


def test_what_stands_elsewhere_does_not_pull():
    elsewhere = np.array([[5.0, 0.0, 7.0, 1.0], [1.8, 0.0, 3.8, 1.0]])
    assert middle(BOX, elsewhere, np.ones(2)) == pytest.approx(BOX)


def test_a_box_without_candidates_stays():
    assert middle(BOX, np.zeros((0, 4)), np.zeros(0)) == pytest.approx(BOX)


def test_each_box_moves_by_itself():
    boxes = np.concatenate([BOX, BOX + 10])
    candidates = np.concatenate([BOX + 0.1, BOX + 9.9])
    moved = middle(boxes, candidates, np.ones(2))
    step = 0.1 / (1 + OWN_WEIGHT)
    assert moved == pytest.approx(boxes + np.array([[step], [-step]]))


def test_a_copy_of_an_example_stays_exactly_where_it_is():
    scene = ga.Scene(facade(0, 4, 3))
    gaps = {"f 0 0": 0.1, "f 2 1": 0.25, "f 3 0": 0.4}
    lesson = ga.learn_placement([ga.Example(scene, below(scene, id, gap)) for id, gap in gaps.items()]).lesson
    arrangement = arrangement_of(scene, scene.polygon("f"), 0.0)
    boxes = np.array([below(scene, "f 1 2", gap).box(0.0)[0] for gap in (0.25, 0.3)])
    assert copied(lesson, arrangement, boxes).tolist() == [True, False]


def test_what_would_overlap_after_a_move_stays_where_it_was():
    before = np.array([[0.0, 0.0, 1.0, 1.0], [1.2, 0.0, 2.2, 1.0], [5.0, 0.0, 6.0, 1.0]])
    after = np.array([[0.3, 0.0, 1.3, 1.0], [1.2, 0.0, 2.2, 1.0], [5.3, 0.0, 6.3, 1.0]])
    nothing = np.zeros((0, 4))
    assert colliding(before, after, nothing, 0.02).tolist() == [True, False, False]
    assert colliding(before, after, nothing, 0.2).tolist() == [False, False, False]
    assert colliding(before, after, np.array([[6.2, 0.0, 7.0, 1.0]]), 0.02).tolist() == [True, False, True]


def test_a_box_that_goes_back_takes_those_along_that_are_in_its_way():
    before = np.array([[0.0, 0.0, 1.0, 1.0], [1.0, 0.0, 2.0, 1.0], [2.0, 0.0, 3.0, 1.0]])
    after = before + np.array([[0.0, 0, 0, 0], [-0.5, 0, -0.5, 0], [-0.5, 0, -0.5, 0]])
    assert colliding(before, after, np.zeros((0, 4)), 0.02).tolist() == [False, True, True]


def buildings(noise, count=9):
    """Plots of different sizes side by side, a building on each that keeps its margins as well as an eye can."""
    rng = np.random.default_rng(1)
    plots, rectangles, x = [], [], 0.0
    for i in range(count):
        width, depth = rng.uniform(6, 16, 2)
        plots.append(polygon(x, 0, width, depth, "plot", f"p{i}"))
        low = np.array([x + 1.0, 2.0]) + rng.uniform(-noise, noise, 2)
        high = np.array([x + width - 1.5, depth - 1.2]) + rng.uniform(-noise, noise, 2)
        rectangles.append(ga.Rectangle(*(low + high) / 2, *(high - low)))
        x += width + 3
    return ga.Scene(plots), rectangles


@pytest.mark.parametrize("count", [3, 5])
def test_margins_that_are_drawn_by_eye_are_kept(count):
    scene, rectangles = buildings(0.05)
    model = ga.learn_placement([ga.Example(scene, r) for r in rectangles[:count]])
    found = model.place(scene)
    assert sorted(p.parent.id for p in found) == [f"p{i}" for i in range(count, 9)]
    for p in found:
        meant = rectangles[int(p.parent.id[1:])]
        assert p.rectangle.box(0.0)[0] == pytest.approx(meant.box(0.0)[0], abs=0.12)


def test_two_examples_agree_by_accident():
    scene, rectangles = buildings(0.05)
    lesson = ga.learn_placement([ga.Example(scene, r) for r in rectangles[:2]]).lesson
    arrangement = arrangement_of(scene, scene.polygon("p5"), 0.0)
    boxes = rectangles[5].box(0.0)[0][None] + 0.2
    assert snapped(lesson, arrangement, boxes) is boxes


def test_edges_far_from_every_habit_stay():
    scene, rectangles = buildings(0.05)
    lesson = ga.learn_placement([ga.Example(scene, r) for r in rectangles[:4]]).lesson
    arrangement = arrangement_of(scene, scene.polygon("p5"), 0.0)
    right = rectangles[5].box(0.0)[0]
    moved = snapped(lesson, arrangement, right + np.array([[0.3] * 4, [0.3, 0.3, -4.0, 0.3]]))
    assert moved[0] == pytest.approx(right, abs=0.12)
    assert moved[1, [0, 1, 3]] == pytest.approx(right[[0, 1, 3]], abs=0.12)
    assert moved[1, 2] == right[2] - 4.0


def framed(noise=0.0, count=12):
    """Windows of different sizes anywhere on a facade, and a frame around each with fixed margins on all four sides."""
    rng = np.random.default_rng(4)
    polygons, rectangles, x = [polygon(0, 0, 30, 12, "facade", "f")], [], 1.0
    for i in range(count):
        width, height, y = rng.uniform(0.6, 1.8), rng.uniform(0.8, 2.5), rng.uniform(1, 8)
        polygons.append(polygon(x, y, width, height, "window", f"w{i}"))
        rectangles.append(ga.Rectangle(x + width / 2, y + height / 2 - 0.1, width + 0.4, height + 0.4))
        x += width + 0.6
    return ga.Scene(polygons), rectangles


@pytest.mark.parametrize("count", [3, 4, 5, 6, 8])
def test_more_examples_of_one_rule_make_results_no_less_sure(count):
    scene, rectangles = framed()
    found = ga.learn_placement([ga.Example(scene, r) for r in rectangles[:count]]).place(scene)
    best = found[: len(rectangles) - count]
    got = np.array(sorted(p.rectangle.box(0.0)[0].tolist() for p in best))
    meant = np.array(sorted(r.box(0.0)[0].tolist() for r in rectangles[count:]))
    assert got == pytest.approx(meant, abs=1e-6)
    if count >= 5:
        assert min(p.score for p in best) > 0.8
        assert len(found) == len(best)
