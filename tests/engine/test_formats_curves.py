"""Curves as cubics, and how they become edges."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import numbers

from geoanalogy.formats.curves import bulge_arc, elliptic_arc, flatten, quadratic, straight, transform
from geoanalogy.tolerances import CURVE_TURN, SMOOTH_TURN

CUBICS = st.lists(st.tuples(numbers(-5, 5), numbers(-5, 5)), min_size=4, max_size=4).map(lambda p: np.array([p]))


def evaluate(cubic, t):
    a, b, c, d = cubic
    t = t[:, None]
    return (1 - t) ** 3 * a + 3 * (1 - t) ** 2 * t * b + 3 * (1 - t) * t**2 * c + t**3 * d


def distance_to(points, line):
    """From each point to the nearest place of a polyline."""
    start, way = line[:-1], np.diff(line, axis=0)
    along = ((points[:, None] - start) * way).sum(axis=2) / np.maximum((way * way).sum(axis=1), 1e-300)
    return np.hypot(*(points[:, None] - start - np.clip(along, 0, 1)[..., None] * way).T).min(axis=0)


def turns(line):
    steps = np.diff(line, axis=0)
    steps = steps[np.hypot(*steps.T) > 1e-9]
    a, b = steps[:-1], steps[1:]
    return np.abs(np.arctan2(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0], (a * b).sum(axis=1)))


@given(CUBICS)
def test_flattened_curve_stays_on_the_curve(cubic):
    line = flatten(cubic)
    size = np.ptp(cubic.reshape(-1, 2), axis=0).max()
    assert line[0].tolist() == cubic[0, 0].tolist()
    assert line[-1].tolist() == cubic[0, 3].tolist()
    dense = evaluate(cubic[0], np.linspace(0, 1, 300))
    assert distance_to(dense, line).max() <= 0.02 * size + 1e-12
    assert distance_to(line, evaluate(cubic[0], np.linspace(0, 1, 3000))).max() <= 2e-3 * size + 1e-12


def test_a_circle_becomes_about_64_edges_of_equal_turn():
    line = flatten(elliptic_arc((3, 4), (2, 0), (0, 2), 0, 2 * np.pi))
    assert 64 <= len(line) - 1 <= 128
    assert turns(line).max() <= CURVE_TURN * 1.01
    assert np.hypot(*(line - (3, 4)).T) == pytest.approx(2, rel=1e-5)


@pytest.mark.parametrize("ratio", [1, 3, 10, 40])
def test_ellipses_have_no_corners(ratio):
    line = flatten(elliptic_arc((0, 0), (ratio, 0), (0, 1), 0, 2 * np.pi))
    assert np.cos(turns(line).max()) > SMOOTH_TURN
    assert np.hypot(line[:, 0] / ratio, line[:, 1]) == pytest.approx(1, rel=1e-4)


def test_arcs_run_both_ways():
    forth = elliptic_arc((0, 0), (2, 0), (0, 1), 0.3, 2.0)
    back = elliptic_arc((0, 0), (2, 0), (0, 1), 2.0, 0.3)
    assert back[::-1, ::-1] == pytest.approx(forth)


def test_straight_lines_keep_their_points():
    points = np.array([(0.0, 0.0), (1, 0), (2, 0), (2, 5)])
    assert flatten(straight(points)).tolist() == points.tolist()
    assert straight(points[:1]).shape == (0, 4, 2)


def test_quadratic_is_raised_exactly():
    t = np.linspace(0, 1, 7)
    a, b, c = np.array([(0.0, 0.0), (1, 2), (3, -1)])
    exact = (1 - t[:, None]) ** 2 * a + 2 * t[:, None] * (1 - t[:, None]) * b + t[:, None] ** 2 * c
    assert evaluate(quadratic(a, b, c)[0], t) == pytest.approx(exact)


@pytest.mark.parametrize("bulge", [0.1, 0.5, 1.0, 3.0, -0.2, -1.0])
def test_bulge_is_the_tangent_of_a_quarter_of_the_angle(bulge):
    start, end = np.array([1.0, 1.0]), np.array([4.0, 5.0])
    run = bulge_arc(start, end, bulge)
    assert run[0, 0] == pytest.approx(start)
    assert run[-1, 3] == pytest.approx(end)
    # The arc's middle stands off the chord by the bulge times half of it, to the right where the bulge is positive.
    chord = (end - start) / 5
    right = np.array([chord[1], -chord[0]])
    stand = (flatten(run) - start) @ right
    assert stand[np.abs(stand).argmax()] == pytest.approx(bulge * 2.5, rel=2e-3)
    angle = turns(flatten(run)).sum() * len(flatten(run)) / (len(flatten(run)) - 1)
    assert angle == pytest.approx(4 * abs(np.arctan(bulge)), rel=0.1)


def test_no_bulge_and_no_chord_are_straight():
    assert flatten(bulge_arc((0, 0), (3, 0), 0)).tolist() == [[0, 0], [3, 0]]
    assert flatten(bulge_arc((1, 1), (1, 1), 0.5)).tolist() == [[1, 1], [1, 1]]


def test_transform_maps_the_control_points():
    run = elliptic_arc((0, 0), (1, 0), (0, 1), 0, 2 * np.pi)
    moved = flatten(transform(run, np.array([[3.0, 0, 10], [0, 3.0, -5]])))
    assert np.hypot(*(moved - (10, -5)).T) == pytest.approx(3, rel=1e-5)


def test_cusps_end_the_halving():
    cusp = np.array([[(0.0, 0.0), (2, 1), (-1, 1), (1, 0)]])
    doubling_back = np.array([[(0.0, 0.0), (3, 0), (-2, 0), (1, 0)]])
    for curve in (cusp, doubling_back):
        assert len(flatten(curve)) < 200
