"""What is refused, in one sentence each, and what is put up with."""

import numpy as np
import pytest
from drawn import box, fish, moved

import geoanalogy as ga
from geoanalogy.tolerances import MOST_LINES

DRAWING = ga.Drawing(fish())


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        ([], "no lines"),
        ([[(1.0, 1.0), (1.0, 1.0)]], "no lines"),
        ([[(0, 0), (1, float("nan"))]], "Line 1 of the drawing has a coordinate that is no number"),
        ([[(0, 0), (1, 1)], [(0, 0), (1, float("inf"))]], "Line 2 of the drawing has a coordinate that is no number"),
        ([[(0, 0), (1, 1e12)]], "beyond 1e\\+09"),
        ([[(0, 0, 0), (1, 1, 1)]], "has the shape"),
        ([[0.0, 1.0]], "has the shape"),
        ([["a", "b"]], "no list of points"),
        ([[(0, 0), (1, 1)]] * (MOST_LINES + 1), "join or remove lines"),
    ],
)
def test_drawings_that_cannot_be_used(lines, message):
    with pytest.raises(ga.InputError, match=message):
        ga.Drawing(lines)


@pytest.mark.parametrize("smoothing", [-1.0, float("nan")])
def test_smoothing_must_be_a_length(smoothing):
    with pytest.raises(ga.InputError, match="smoothing of the drawing"):
        ga.Drawing(fish(), smoothing=smoothing)


EIGHT = [(0.0, -0.3), (1.0, 0.4), (1.0, -0.3), (0.0, 0.4)]


@pytest.mark.parametrize(
    ("query", "message"),
    [
        ([(5, 5), (6, 5), (6, 6)], "No line of the drawing lies in the query"),
        ([(0.3, 0.3), (0.3, 0.3)], "fewer than two different points"),
        ([], "has the shape"),
        ([(0, 0), (1, float("nan")), (1, 1)], "query has a coordinate that is not a number"),
        ([(0, 0, 0), (1, 1, 1), (2, 0, 0)], "query has the shape"),
        ([["a", "b"]], "query is no list of points"),
        (EIGHT, "crosses itself"),
    ],
)
def test_queries_that_cannot_be_used(query, message):
    with pytest.raises(ga.InputError, match=message):
        ga.match_regions(DRAWING, query)


def test_a_region_of_two_points_is_refused():
    with pytest.raises(ga.InputError, match="fewer than three corners"):
        ga.match_regions(DRAWING, [(0, 0), (1, 0)], ga.RegionOptions(query_kind="region"))


def test_straight_lines_match_nothing_in_particular():
    drawing = ga.Drawing([[(0, 0), (1, 0)], [(0, 1), (1, 1)]])
    with pytest.raises(ga.InputError, match="are straight and match everywhere"):
        ga.match_regions(drawing, [(-0.1, -0.1), (1.1, -0.1), (1.1, 0.1), (-0.1, 0.1)])


def test_the_loop_at_the_end_of_a_lasso_is_dropped():
    ring = np.vstack([box(fish()), [(-0.05, -0.27), (-0.06, -0.27)]])
    drawing = ga.Drawing(fish() + [moved(line, shift=(2.0, 0.0)) for line in fish()])
    assert ga.match_regions(drawing, ring)[0].similarity > 0.95


def test_lines_on_the_outline_of_the_query_count_as_inside():
    outline = fish()[0]
    drawing = ga.Drawing([outline, moved(outline, shift=(2.0, 0.0))])
    (match,) = ga.match_regions(drawing, outline)
    assert match.coverage > 0.98


def test_a_million_points_are_resampled():
    turn = np.linspace(0.0, 2.0 * np.pi, 1_000_000)
    radius = 1.0 + 0.2 * np.sin(3.0 * turn) + 0.1 * np.cos(5.0 * turn)
    blob = np.stack([radius * np.cos(turn), radius * np.sin(turn)], 1)
    drawing = ga.Drawing([blob, 0.5 * blob[::-7] + (4.0, 0.0)])
    assert len(drawing.contours.points) < 20_000
    assert ga.match_regions(drawing, box([blob]))[0].similarity > 0.9


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"contrast": -1.0}, "contrast is -1.0"),
        ({"threshold": 1.5}, "threshold is 1.5; give a number from 0 to 1"),
        ({"query_points": 2}, "query_points is 2"),
        ({"reach": 0.0}, "reach is 0.0"),
        ({"largest_scale": 0.5}, "largest_scale is 0.5"),
        ({"smoothing_radius": 0.0}, "smoothing_radius is 0.0"),
        ({"neighbourhood": 0.0}, "neighbourhood is 0.0"),
        ({"joint_tolerance": 2.0}, "joint_tolerance is 2.0"),
        ({"most": 0}, "most is 0"),
        ({"reach": float("nan")}, "reach is nan; give a number from 0.001 to 1"),
        ({"query_kind": "circle"}, "query_kind is 'circle'"),
    ],
)
def test_options_out_of_range_are_refused(options, message):
    with pytest.raises(ga.InputError, match=message):
        ga.RegionOptions(**options)


def test_a_noisy_line_is_smoothed_before_it_is_matched():
    rng = np.random.default_rng(3)
    noisy = [line + rng.normal(0.0, 0.01, line.shape) for line in fish()]
    rough = ga.Drawing([*fish(), *(moved(line, shift=(2.0, 0.0)) for line in noisy)])
    calm = ga.Drawing([*fish(), *(moved(line, shift=(2.0, 0.0)) for line in noisy)], smoothing=0.06)
    assert calm.contours.turning.sum() < 0.8 * rough.contours.turning.sum()
    anything = ga.RegionOptions(threshold=0.0, contrast=0.0)
    best = [ga.match_regions(d, box(fish()), anything)[0].similarity for d in (calm, rough)]
    assert best[0] > best[1]
