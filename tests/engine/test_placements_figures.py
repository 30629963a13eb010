"""What figures 5.4 and 5.10 to 5.13 of the thesis show; `benchmarks.placements_figures` draws them."""

import numpy as np
import pytest
from placement_scenes import overlap, polygon

import geoanalogy as ga
from benchmarks.studies import arrangements


def best_in(found, parent):
    return max((p for p in found if p.parent.id == parent), key=lambda p: p.score)


def values(rectangle):
    return rectangle.x, rectangle.y, rectangle.width, rectangle.height


def test_figure_5_4_balconies_are_found_in_front_of_windows_and_rank_above_all_else():
    case = arrangements.balconies()
    ranked = case.learned().place(case.scene, threshold=0)
    places = [arrangements.in_front(case.scene, str(p.id)) for p in case.scene.polygons if p.label == "window"]
    wanted = [w for w in places if all(overlap(w, r) < 0.5 for r in case.shown)]
    right = [max(overlap(p.rectangle, w) for w in wanted) > 0.9 for p in ranked]
    assert all(max(overlap(p.rectangle, w) for p in ranked) > 0.9 for w in wanted)
    assert all(right[: len(wanted)])


def test_figure_5_10_a_a_balcony_adapts_its_width_to_the_facade():
    case = arrangements.wide_balconies()
    found = case.learned().place(case.scene)
    assert values(best_in(found, "c").rectangle) == pytest.approx((22.5, 4, 9, 1))


def test_figure_5_10_b_more_examples_tell_whether_the_window_matters_or_the_door():
    case = arrangements.flower_boxes()
    boxes = {f"{h}{i}": arrangements.flower_box(case.scene, f"{h}{i}") for h in "pq" for i in range(3)}
    one, two = case.learned(1), case.learned(2)

    def score(model, key):
        found = [p for p in model.place(case.scene, threshold=0.01) if overlap(p.rectangle, boxes[key]) > 0.9]
        return max((p.score for p in found), default=0.0)

    # From one example a box below a window and above a door; from two that a window is all it takes.
    assert score(two, "q2") > score(one, "q2")
    assert all(score(two, key) >= 0.5 for key in ("p2", "q0", "q1", "q2"))


@pytest.mark.parametrize(("adapting", "expected"), [(False, (22.5, 1, 2, 2)), (True, (22.5, 1, 2.75, 2))])
def test_figure_5_10_c_a_second_example_tells_whether_doors_keep_their_size(adapting, expected):
    case = arrangements.doors(adapting)
    assert values(best_in(case.learned().place(case.scene), "c").rectangle) == pytest.approx(expected)


def test_figure_5_11_a_mirror_keeps_the_width_of_the_basin_below_lamps_of_any_width():
    case = arrangements.mirrors()
    model = case.learned()
    found = model.place(case.scene)
    assert len(found) == 2
    for name, x in (("c", 12), ("d", 17)):
        assert values(best_in(found, name).rectangle) == pytest.approx((x, 1.6, 1, 1))
    weights = {r.text: r.weight for r in model.rule()}
    assert weights["same width as the basin"] > 0.95
    assert not any("edge of the lamp" in text and text.startswith(("left", "right")) for text in weights)


def test_what_lies_between_two_elements_has_a_relation_to_their_gap():
    # The mirror fills the gap between basin and lamp, whatever that is.
    def wall(x, name, low, high):
        return [
            polygon(x, 0, 4, 4, "bathroom wall", name),
            polygon(x + 1, low - 0.3, 2, 0.3, "basin"),
            polygon(x + 1, high, 2, 0.2, "lamp"),
        ]

    scene = ga.Scene(wall(0, "a", 1.0, 2.4) + wall(6, "b", 0.6, 2.8) + wall(12, "c", 1.2, 3.4))
    filling = [ga.Example(scene, ga.Rectangle(2, 1.7, 2, 1.0)), ga.Example(scene, ga.Rectangle(8, 1.7, 2, 1.8))]
    model = ga.learn_placement(filling)
    assert "between basin and lamp" in model.lesson.labels
    assert values(best_in(model.place(scene), "c").rectangle) == pytest.approx((14, 2.3, 2, 1.8))
    alone = ga.learn_placement(filling, ga.PlacementOptions(between=False)).lesson.labels
    assert sorted(alone) == ["basin", "lamp"]


def test_figure_5_12_a_small_kernel_tells_a_misaligned_window_from_an_aligned_one():
    case = arrangements.entrances()

    def similarity(tau, name):
        return 1 - min(p.novelty for p in case.learned(tau=tau).place(case.scene, 0.01) if p.parent.id == name)

    small, large = 0.3, 3.0
    assert similarity(small, "c") - similarity(small, "d") > 0
    assert similarity(large, "c") > similarity(small, "c")
    assert similarity(large, "d") > similarity(small, "d")


def test_figure_5_13_two_floors_are_new_to_what_was_taught_on_one():
    case = arrangements.floors()
    found = case.learned().place(case.scene)
    assert best_in(found, "s").novelty < best_in(found, "t").novelty
    assert best_in(found, "s").score > 0.5
    assert np.isfinite([p.novelty for p in found]).all()
