"""Chains of chords: corners of the query laid along corners of a drawing."""

import numpy as np
import pytest
from drawn import closed, moved
from hypothesis import given, settings
from hypothesis import strategies as st

import geoanalogy as ga
from geoanalogy.geometry.contours import Contours
from geoanalogy.regions.chains import GRADES, SCALE_GAIN, TURN_GAIN, chain, corners
from geoanalogy.regions.query import Run

STAIR = np.array([(0, 0), (3, 0), (3, 1), (2, 1), (2, 1.6), (1.2, 1.6), (1.2, 2.5), (0, 2.2)], float)
EXACT = (0.006, 1.0)


def complex_of(points):
    return np.asarray(points) @ np.array([1.0, 1.0j])


def laid(other, mirrored=True):
    """The chains of the stair with one other line, the contours' points being those of a drawing of both."""
    drawing = ga.Drawing([closed(STAIR), other])
    contours: Contours = drawing.contours
    runs = [Run(np.arange(contours.first[k], contours.first[k + 1]), bool(contours.closed[k])) for k in (0, 1)]
    return drawing, chain(contours, runs[:1], runs[1:], mirrored)


def test_the_corners_of_a_polygon_are_its_vertices():
    line = complex_of(
        np.vstack([np.linspace(a, b, 20, endpoint=False) for a, b in zip(STAIR, np.roll(STAIR, -1, 0), strict=True)])
    )
    found = corners(line, True, EXACT)
    assert len(found) == len(STAIR)
    assert np.abs(found[:, None] - complex_of(STAIR)[None]).min(1).max() < 1e-9


def test_long_chords_are_divided_evenly():
    found = corners(complex_of([(0, 0), (1, 0), (1, 1)]), False, (0.006, 0.1))
    np.testing.assert_allclose(np.abs(np.diff(found)), 0.2)


def test_lines_with_very_many_corners_lose_the_smallest():
    rng = np.random.default_rng(0)
    assert len(corners(complex_of(rng.normal(size=(2000, 2))), False, EXACT)) <= 90


@settings(max_examples=8, deadline=None)
@given(
    scale=st.floats(0.2, 5.0),
    angle=st.floats(-3.1, 3.1),
    first=st.integers(0, 7),
    way=st.sampled_from([-1, 1]),
    mirrored=st.booleans(),
)
def test_a_copy_has_a_whole_chain_whatever_its_place(scale, angle, first, way, mirrored):
    other = moved(closed(np.roll(STAIR, first, axis=0)[::way]), scale, angle, (20.0, 3.0), mirrored)
    drawing, found = laid(other)
    best = found.found[0]
    assert best.mirrored == mirrored
    assert best.score == pytest.approx(found.most[best.grade].sum(), rel=0.02)
    there = np.conj(best.target) if mirrored else best.target
    truth = moved(drawing.out_of_frame(best.source), scale, angle, (20.0, 3.0), mirrored)
    assert np.linalg.norm(drawing.out_of_frame(there) - truth, axis=1).max() < 0.06 * scale


def test_what_a_copy_is_worth_grows_with_its_corners():
    _, found = laid(moved(closed(STAIR), shift=(20.0, 0.0)))
    assert found.most.shape == (len(GRADES), 1)
    assert found.most[0, 0] == pytest.approx((len(STAIR) - 1) * (TURN_GAIN + SCALE_GAIN))


def test_a_cut_line_has_the_chain_of_what_is_left():
    _, whole = laid(moved(closed(STAIR), shift=(20.0, 0.0)))
    _, cut = laid(moved(STAIR[:6], shift=(20.0, 0.0)))
    assert 0.4 * whole.found[0].score < cut.found[0].score < 0.8 * whole.found[0].score


@pytest.mark.parametrize("way", [-1, 1])
def test_a_line_cut_between_corners_ends_there_and_not_at_the_next_corner(way):
    ring = closed(STAIR)
    begin, end = 0.4 * ring[0] + 0.6 * ring[1], 0.7 * ring[5] + 0.3 * ring[6]
    left = np.vstack([begin, ring[1:6], end])[::way]
    drawing, found = laid(moved(left, 1.3, 0.7, (20.0, 3.0)))
    best = found.found[0]
    truth = moved(drawing.out_of_frame(best.source), 1.3, 0.7, (20.0, 3.0))
    assert np.linalg.norm(drawing.out_of_frame(best.target) - truth, axis=1).max() < 0.08


def test_mirror_images_are_only_looked_for_where_they_are_wanted():
    _, found = laid(moved(closed(STAIR), shift=(20.0, 0.0), mirrored=True), mirrored=False)
    assert not any(c.mirrored for c in found.found)
    assert not found.found or found.found[0].score < 0.7 * found.most[found.found[0].grade].sum()
