"""Where every element has its example, nothing is left to place, and nothing is shown that nothing speaks for."""

import numpy as np
import pytest
from placement_scenes import facade, polygon

import geoanalogy as ga
from geoanalogy.placements.arrangement import arrangement_of
from geoanalogy.placements.own_elements import SHARE_POWER, UNSEEN
from geoanalogy.placements.selection import LIKELIER_THAN_NOT, useful_cut
from geoanalogy.placements.survey import look

#: By how much edges drawn by eye are off, in metres.
BY_EYE = 0.02


def street(*columns, rows=1):
    """Facades side by side with so many windows in a row, 1 m by 1.5 m, the first of them `f0`."""
    polygons, x = [], 0.0
    for i, count in enumerate(columns):
        width, step = 3.0 * count, 3.0 - 0.2 * i
        polygons.append(polygon(x, 0, width, 1.5 + 2.6 * rows, "facade", f"f{i}"))
        for j in range(count):
            for r in range(rows):
                polygons.append(polygon(x + 1 + step * j, 1.2 + 2.6 * r, 1.0, 1.5, "window", f"f{i} {j} {r}"))
        x += width + 2
    return ga.Scene(polygons)


def sill(scene, id, rng=None):
    """A sill below a window, drawn by eye where random numbers are given."""
    x0, y0, x1, _ = scene.polygon(id).bounds
    edges = np.array([x0 - 0.05, y0 - 0.15, x1 + 0.05, y0 - 0.02])
    if rng is not None:
        edges = edges + rng.normal(0, BY_EYE, 4)
    return ga.Rectangle(*(edges[:2] + edges[2:]) / 2, *edges[2:] - edges[:2])


def learned(scene, ids, seed=None):
    rng = None if seed is None else np.random.default_rng(seed)
    return ga.learn_placement([ga.Example(scene, sill(scene, id, rng)) for id in ids])


def placed(scene, model):
    """By facade, the windows that results lie below; None for a result below no window."""
    found = {}
    for c in model.place(scene):
        x, y = c.rectangle.x, c.rectangle.y
        below = [
            p.id
            for p in scene.polygons
            if p.label == "window" and p.bounds[0] < x < p.bounds[2] and p.bounds[1] - 0.3 < y < p.bounds[1]
        ]
        found.setdefault(c.parent.id, []).append(below[0] if below else None)
    return {id: sorted(places, key=str) for id, places in found.items()}


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("columns", [2, 3])
def test_nothing_is_added_to_a_facade_whose_windows_all_have_their_sills(columns, seed):
    scene = street(columns, 2, 3)
    model = learned(scene, [f"f0 {j} 0" for j in range(columns)], seed)
    assert placed(scene, model) == {"f1": ["f1 0 0", "f1 1 0"], "f2": ["f2 0 0", "f2 1 0", "f2 2 0"]}


def test_nothing_is_added_over_several_rows_either():
    scene = street(2, 2, rows=2)
    ids = [f"f0 {j} {r}" for j in range(2) for r in range(2)]
    assert placed(scene, learned(scene, ids, 1)) == {"f1": [id.replace("f0", "f1") for id in ids]}


@pytest.mark.parametrize("seed", range(4))
def test_windows_that_were_left_free_get_their_sills_and_nothing_else_is_placed(seed):
    scene = street(4, 2)
    found = placed(scene, learned(scene, ["f0 0 0", "f0 2 0"], seed))
    assert found == {"f0": ["f0 1 0", "f0 3 0"], "f1": ["f1 0 0", "f1 1 0"]}


def strays(scene, ids, *rectangles):
    """What is said against rectangles on the first facade by sills below the windows of these names."""
    model = learned(scene, ids)
    arrangement = arrangement_of(scene, scene.polygon("f0"), 0.0)
    boxes = np.array([r.box(0.0)[0] for r in rectangles])
    present = np.array([t.rectangle.box(0.0)[0] for t in model.shown_in(arrangement)]).reshape(-1, 4)
    return look(model.lesson, arrangement, boxes, present)[3]


#: Beside no window of the first facade, in nothing like a sill's place.
ELSEWHERE = ga.Rectangle(0.35, 3.7, 0.3, 0.2)


@pytest.mark.parametrize("columns", [2, 3, 4])
def test_each_further_window_with_its_sill_confirms_the_rule(columns):
    scene = street(columns)
    ids = [f"f0 {j} 0" for j in range(columns)]
    against = strays(scene, ids, ELSEWHERE)
    assert against == pytest.approx(np.log(UNSEEN / (columns - 1 + UNSEEN)), abs=0.02)


def test_free_windows_leave_the_rule_open():
    whole, half = strays(street(2), ["f0 0 0", "f0 1 0"], ELSEWHERE), strays(street(4), ["f0 0 0", "f0 1 0"], ELSEWHERE)
    assert half == pytest.approx(whole * 0.5**SHARE_POWER, rel=0.05)


def test_nothing_is_said_against_what_is_below_a_window():
    scene = street(4)
    against = strays(scene, ["f0 0 0", "f0 1 0"], sill(scene, "f0 2 0"), sill(scene, "f0 3 0"))
    assert against == pytest.approx(0, abs=1e-3)


def test_a_single_example_confirms_nothing():
    assert strays(street(1), ["f0 0 0"], ELSEWHERE) == pytest.approx(0)


def test_nothing_is_said_where_no_example_was_drawn():
    scene = street(2, 2)
    assert strays(scene, ["f1 0 0", "f1 1 0"], ELSEWHERE) == pytest.approx(0)


def test_windows_are_not_drawn_at_their_sills():
    """Elements smaller than the examples are additions to some of them: a window may have none."""
    scene = ga.Scene([p for p in street(3).polygons if p.label == "facade"])
    windows = [ga.Rectangle(1.5 + 3 * j, 1.95, 1.0, 1.5) for j in range(2)]
    sills = [polygon(0.95 + 3 * j, 1.05, 1.1, 0.13, "sill") for j in range(2)]
    scene = ga.Scene([*scene.polygons, *sills])
    model = ga.learn_placement([ga.Example(scene, w) for w in windows])
    arrangement = arrangement_of(scene, scene.polygon("f0"), 0.0)
    boxes = np.array([r.box(0.0)[0] for r in (ga.Rectangle(7.5, 1.95, 1.0, 1.5), *windows)])
    assert look(model.lesson, arrangement, boxes[:1], boxes[1:])[3] == pytest.approx(0)


def test_nothing_is_shown_where_that_nothing_is_meant_is_likelier_than_the_best_choice_is_good():
    weak = np.array([0.2, 0.15, 0.1])
    assert np.prod(1 - weak) > 2 * weak.sum() / 4
    assert useful_cut(weak, False, True) == LIKELIER_THAN_NOT
    assert useful_cut(weak, False, False) < weak.min() + 0.1


@pytest.mark.parametrize("certain", [[0.9], [0.6, 0.2], [0.3] * 10, [0.9, 0.9, 0.4]])
def test_where_something_is_likely_the_cut_is_the_usual_one(certain):
    certain = np.array(certain)
    assert useful_cut(certain, False, True) == useful_cut(certain, False, False) < certain.max()


def test_what_is_likelier_than_not_is_always_shown():
    for certainty in np.linspace(0.501, 0.99, 20):
        assert useful_cut(np.array([certainty]), False, True) < certainty


def test_a_facade_of_many_windows_keeps_its_certain_results():
    scene = ga.Scene(facade(0, 4, 3))
    x = [scene.polygon(f"f {i} 0").bounds for i in range(2)]
    examples = [ga.Example(scene, ga.Rectangle((b[0] + b[2]) / 2, b[1] - 0.1, b[2] - b[0] + 0.2, 0.2)) for b in x]
    assert len(ga.learn_placement(examples).place(scene)) == 10
