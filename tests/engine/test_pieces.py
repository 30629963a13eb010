"""Lines and arcs fitted to runs of points."""

import itertools

import numpy as np
import pytest
import strategies
from hypothesis import given
from hypothesis import strategies as st

from geoanalogy.geometry.pieces import (
    Arc,
    Line,
    cheapest_partition,
    deviations,
    fit_arc,
    fit_line,
    squared_deviations,
)
from geoanalogy.tolerances import CURVE_TURN


def on_circle(start, sweep, count, radius=2.0, centre=(3.0, -1.0)):
    angles = start + sweep * np.linspace(0, 1, count)
    return np.stack([np.cos(angles), np.sin(angles)], axis=1) * radius + centre


def test_line_through_points_on_a_line():
    line = fit_line(np.array([(0.0, 1.0), (1, 2), (2, 3), (5, 6)]))
    assert line.direction == pytest.approx(np.array([1, 1]) / np.sqrt(2))
    assert line.length == pytest.approx(5 * np.sqrt(2))
    assert line.nearest(np.array([2.0, 1.0])) == pytest.approx([1, 2])
    assert line.between(np.zeros(2), np.ones(2)).shape == (0, 2)


def test_line_runs_with_its_points():
    points = np.array([(0.0, 0.0), (1, 0.1), (2, -0.1), (3, 0)])
    assert fit_line(points).direction[0] > 0.99
    assert fit_line(points[::-1]).direction[0] < -0.99


@pytest.mark.parametrize("sweep", [0.3, 2.0, 5.0, 2 * np.pi, -0.3, -4.0])
def test_arc_through_points_on_a_circle(sweep):
    points = on_circle(0.4, sweep, 30)
    arc = fit_arc(points)
    assert isinstance(arc, Arc)
    assert arc.centre == pytest.approx([3, -1])
    assert arc.radius == pytest.approx(2)
    assert arc.sweep == pytest.approx(sweep)
    assert arc.length == pytest.approx(2 * abs(sweep))
    assert deviations(arc, points) == pytest.approx(0, abs=1e-9)
    # At right angles to the spoke, along the run.
    steps = np.diff(points, axis=0)
    assert arc.direction_at(points[0]) @ steps[0] / np.hypot(*steps[0]) > 0.98


def test_arc_of_points_on_a_line_is_a_line():
    assert isinstance(fit_arc(np.array([(0.0, 0.0), (1, 1), (2, 2), (3, 3)])), Line)


@pytest.mark.parametrize("sweep", [1.0, -1.0])
def test_vertices_along_an_arc(sweep):
    points = on_circle(0.4, sweep, 30)
    arc = fit_arc(points)
    along = arc.between(points[0], points[-1])
    assert deviations(arc, along) == pytest.approx(0, abs=1e-9)
    steps = np.hypot(*np.diff(np.vstack([points[:1], along, points[-1:]]), axis=0).T)
    assert steps == pytest.approx(steps[0])
    assert steps[0] <= 2 * CURVE_TURN
    whole = arc.between(points[0], points[0])
    assert len(whole) == round(2 * np.pi / CURVE_TURN) - 1
    # Ends the other way round are no arc of nearly a whole turn.
    assert arc.between(points[-1], points[0]).shape == (0, 2)


@given(st.integers(0, 1000))
def test_sums_of_all_runs_are_those_of_their_fits(seed):
    rng = np.random.default_rng(seed)
    points = on_circle(0, 3.0, 12, 0.5, (0.1, 0.2)) + rng.normal(scale=0.02, size=(12, 2))
    line, arc = squared_deviations(points)
    for i, j in itertools.combinations(range(12), 2):
        run = points[i : j + 1]
        if j - i >= 2:
            assert line[i, j] == pytest.approx((deviations(fit_line(run), run) ** 2).sum(), abs=1e-12)
            assert arc[i, j] <= line[i, j] + 1e-12
        if j - i >= 6:  # Taubin's sum is that of the distances but for terms of the noise's fourth power
            assert arc[i, j] == pytest.approx((deviations(fit_arc(run), run) ** 2).sum(), rel=0.1, abs=1e-9)


@given(st.integers(3, 9), st.integers(0, 1000))
def test_cheapest_partition_is_the_cheapest_of_all(m, seed):
    cost = np.random.default_rng(seed).uniform(0, 1, size=(m, m))
    possible = []
    for count in range(m):
        for cuts in itertools.combinations(range(1, m), count):
            runs = list(itertools.pairwise((0, *cuts, m)))
            if all(b - a >= 3 for a, b in runs):
                possible.append(sum(cost[a, b - 1] for a, b in runs))
    runs = cheapest_partition(cost)
    assert sum(cost[run] for run in runs) == pytest.approx(min(possible))
    assert [i for run in runs for i in range(run[0], run[1] + 1)] == list(range(m))


@given(strategies.similarities(scales=(0.2, 3.0)))
def test_fits_follow_similarity_transforms(similarity):
    points = on_circle(0.4, 2.0, 20, 0.5, (0, 0)) + np.random.default_rng(0).normal(scale=0.01, size=(20, 2))
    arc, moved = fit_arc(points), fit_arc(similarity(points))
    assert moved.centre == pytest.approx(similarity(arc.centre), abs=1e-6)
    assert moved.radius == pytest.approx(similarity.scale * arc.radius, rel=1e-6)
