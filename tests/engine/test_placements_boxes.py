"""Boxes: overlaps, distances, gaps between neighbours, and arrays of elements."""

import numpy as np
import pytest

import geoanalogy as ga
from geoanalogy.placements import boxes as b
from geoanalogy.placements.arrays import element_array, repeated

ONE = np.array([[0.0, 0, 2, 2]])
OTHERS = np.array([[1.0, 1, 3, 3], [2, 0, 4, 2], [0, 0, 1, 1]])


def test_overlaps_of_known_boxes():
    assert b.shared_areas(ONE, OTHERS).tolist() == [[1, 0, 1]]
    assert b.overlap(ONE, OTHERS).tolist() == [[0.25, 0, 1]]
    assert np.allclose(b.union_overlap(ONE, OTHERS), [[1 / 7, 0, 0.25]])
    assert np.allclose(b.interval_overlap(ONE, OTHERS, 0), [[1 / 3, 0, 0.5]])


def test_an_overlapping_box_is_nearer_than_one_beside_it_and_a_concentric_one_nearest():
    at = b.distances(ONE, np.array([[0.5, 0.5, 1.5, 1.5], [1, 1, 3, 3], [3, 0, 5, 2]]))[0]
    assert at[0] == 0 and at[0] < at[1] < at[2]


def test_the_gap_between_neighbours_is_an_element():
    found = b.gaps_between({"lamp": np.array([[0.0, 4, 2, 5]]), "basin": np.array([[0.0, 0, 2, 1]])})
    assert list(found) == ["between basin and lamp"]
    assert found["between basin and lamp"].tolist() == [[0, 1, 2, 4]]


def test_there_is_no_gap_across_a_third_box_or_between_boxes_that_are_not_abreast():
    row = {"a": np.array([[0.0, 0, 1, 1], [2, 0, 3, 1], [4, 0, 5, 1], [9, 8, 10, 9]])}
    assert b.gaps_between(row)["between a and a"].tolist() == [[1, 0, 2, 1], [3, 0, 4, 1]]
    assert b.gaps_between({"a": ONE}) == {}


def test_elements_are_repeated_flush_with_the_ends_and_at_least_the_gap_apart():
    centres = repeated(10.0, 2.0, 0.5)
    assert len(centres) == 4
    assert centres[0] - 1 == -5 and centres[-1] + 1 == 5
    assert np.diff(centres).min() - 2 >= 0.5
    assert repeated(1.0, 2.0, 0.0).tolist() == [0.0]
    assert len(repeated(3.0, 1.0, 0.0)) == 3


def test_each_axis_scales_or_repeats():
    place = ga.Rectangle(5, 1, 10, 2)
    scaled = element_array(place, (3, 1))
    assert [(e.x, e.y, e.width, e.height) for e in scaled] == [(5, 1, 10, 2)]
    row = element_array(place, (3, 1), ("repeat", "scale"), (0.5, 0))
    assert [(e.x, e.width, e.height) for e in row] == [(1.5, 3, 2), (5, 3, 2), (8.5, 3, 2)]
    both = element_array(place, (3, 1), ("repeat", "repeat"), (0.5, 0))
    assert [(e.x, e.y) for e in both] == [(1.5, 0.5), (5, 0.5), (8.5, 0.5), (1.5, 1.5), (5, 1.5), (8.5, 1.5)]


@pytest.mark.parametrize(("width", "count"), [(0.4, 1), (1.2, 2), (1.8, 3), (1.95, 3)])
def test_divided_elements_and_their_gaps_fill_the_placement(width, count):
    made = element_array(ga.Rectangle(1.0, 2.0, width, 0.7), (0.5, 0.5), ("divide", "scale"), (0.1, 0.0))
    lows, highs = (np.array([r.x + side * r.width / 2 for r in made]) for side in (-1, 1))
    assert len(made) == count and all(r.height == pytest.approx(0.7) for r in made)
    assert (lows[0], highs[-1]) == pytest.approx((1.0 - width / 2, 1.0 + width / 2))
    assert lows[1:] - highs[:-1] == pytest.approx([made[0].width / 5] * (count - 1))


def test_the_elements_of_a_turned_placement_are_turned_about_its_centre():
    up, down = element_array(ga.Rectangle(1, 1, 4, 1, -np.pi / 2), (1, 1), ("repeat", "scale"), (2, 0))
    assert np.allclose([(up.x, up.y), (down.x, down.y)], [(1, 2.5), (1, -0.5)])
    assert up.angle == -np.pi / 2


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (((0, 1),), "the element has the width 0; give a positive number"),
        (((1, float("nan")),), "the element has the height nan"),
        (((1, 1), ("scale", "scale"), (0, -1)), "the distance along the height is -1"),
        (((1, 1), ("tile", "scale")), "the fit along the width is 'tile'; choose 'scale', 'repeat' or 'divide'"),
        (((1e-6, 1), ("repeat", "scale")), "give a larger element or a larger distance"),
    ],
)
def test_what_cannot_be_an_array_is_refused(arguments, message):
    with pytest.raises(ga.InputError, match=message):
        element_array(ga.Rectangle(0, 0, 10, 2), *arguments)
