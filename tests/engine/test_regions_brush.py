"""Queries of several strokes or rings: a brush."""

import numpy as np
import pytest
from drawn import box, fish, inner_points, moved

import geoanalogy as ga
from geoanalogy.regions.query import Query, parts_of

DRAWING = ga.Drawing(fish() + [moved(line, 0.8, 1.0, (2.5, 0.5)) for line in fish()])


def test_one_query_is_one_part_and_several_are_several():
    ring = box(fish())
    assert len(parts_of(ring)) == len(parts_of(ring.tolist())) == 1
    assert len(parts_of([ring, ring[:3]])) == len(parts_of(np.stack([ring, ring]))) == 2


def test_overlapping_rings_are_their_union():
    left = [(-0.1, -0.4), (0.6, -0.4), (0.6, 0.5), (-0.1, 0.5)]
    right = [(0.5, -0.4), (1.2, -0.4), (1.2, 0.5), (0.5, 0.5)]
    match = ga.match_regions(DRAWING, [np.array(left), np.array(right)])[0]
    truth = moved(inner_points(), 0.8, 1.0, (2.5, 0.5))
    assert np.linalg.norm(match.map(inner_points()) - truth, axis=1).mean() < 0.004


def test_brush_strokes_take_in_what_is_within_reach():
    strokes = [
        np.array([(0.0, 0.1), (1.0, 0.1)]),
        np.array([(0.0, -0.1), (1.0, -0.1)]),
        np.array([(0.3, 0.3), (0.5, 0.3)]),
    ]
    query = Query.of(DRAWING, strokes, ga.RegionOptions(reach=0.15))
    own = sum(len(line) for line in fish())
    assert query.inside.any() and own > 0
    match = ga.match_regions(DRAWING, strokes, ga.RegionOptions(reach=0.15))[0]
    truth = moved(inner_points(), 0.8, 1.0, (2.5, 0.5))
    assert np.linalg.norm(match.map(inner_points()) - truth, axis=1).mean() < 0.02


def test_parts_that_lie_apart_are_one_query():
    head = [(-0.1, -0.3), (0.3, -0.3), (0.3, 0.3), (-0.1, 0.3)]
    tail = [(0.75, -0.3), (1.2, -0.3), (1.2, 0.4), (0.75, 0.4)]
    options = ga.RegionOptions(threshold=0.0, contrast=0.0)
    match = ga.match_regions(DRAWING, [np.array(head), np.array(tail)], options)[0]
    some = np.array([(0.05, 0.03), (0.2, 0.1), (0.9, 0.05)])
    assert np.linalg.norm(match.map(some) - moved(some, 0.8, 1.0, (2.5, 0.5)), axis=1).max() < 0.03


def test_a_bad_part_is_named():
    with pytest.raises(ga.InputError, match="fewer than two different points"):
        ga.match_regions(DRAWING, [box(fish()), np.array([(0.0, 0.0), (0.0, 0.0)])])
