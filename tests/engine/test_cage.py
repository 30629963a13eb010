"""Mean value coordinates: exact on the outline, linear, and bounded in convex outlines."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shapes import CATALOGUE, L_ROOM, UNIT_SQUARE, regular

from geoanalogy.geometry.cage import cage_coordinates


@pytest.mark.parametrize("outline", [outline for _, outline, _, _ in CATALOGUE])
@given(seed=st.integers(0, 2**32 - 1))
def test_the_outline_gives_the_points_that_it_was_measured_for(outline, seed):
    low, high = outline.min(axis=0) - 0.5, outline.max(axis=0) + 0.5
    points = np.random.default_rng(seed).uniform(low, high, (20, 2))
    weights = cage_coordinates(points, outline)
    assert weights.sum(axis=1) == pytest.approx(1.0)
    assert weights @ outline == pytest.approx(points, abs=1e-6)


@pytest.mark.parametrize("turned", [1, -1], ids=["counter-clockwise", "clockwise"])
def test_points_of_the_outline_belong_to_their_edge_alone(turned):
    ring = np.array(L_ROOM, dtype=float)[::turned]
    assert cage_coordinates(ring, ring) == pytest.approx(np.eye(len(ring)))
    third = ring + (np.roll(ring, -1, axis=0) - ring) / 3
    assert cage_coordinates(third, ring) == pytest.approx(
        np.eye(len(ring)) * 2 / 3 + np.eye(len(ring), k=1) / 3 + np.eye(len(ring), k=1 - len(ring)) / 3
    )


def test_the_middle_of_a_regular_outline_has_equal_weights():
    assert cage_coordinates([(2.0, 1.0)], regular(7, 3.0, (2.0, 1.0))) == pytest.approx(np.full((1, 7), 1 / 7))


def test_what_is_inside_a_convex_outline_stays_inside_a_bent_convex_one():
    inside = np.random.default_rng(5).uniform(0.01, 0.99, (100, 2))
    weights = cage_coordinates(inside, UNIT_SQUARE)
    assert (weights > 0).all()
    moved = weights @ np.array([(0, 0), (3, 1), (2.5, 2), (-1, 1.5)])
    assert (moved.min(axis=0) > (-1, 0)).all() and (moved.max(axis=0) < (3, 2)).all()
