"""Normal equations by moments, beside those by the rows themselves."""

import numpy as np
import pytest

from geoanalogy.regions.least_squares import Blended
from geoanalogy.regions.transformation import Nodes, smoothness


def case(shift, count=40, candidates=3):
    rng = np.random.default_rng(3)
    grid = np.array([x + 1j * y for x in range(4) for y in range(3)]) * 0.1 + shift
    nodes = Nodes.of(grid, 0.1, 1.5)
    points = shift + rng.uniform(-0.05, 0.35, count) + 1j * rng.uniform(-0.05, 0.25, count)
    goal = rng.normal(size=(candidates, count)) + 1j * rng.normal(size=(candidates, count))
    return Blended(nodes, points), goal, rng.uniform(0.0, 1.0, (candidates, count))


def smooth(nodes):
    strain, bend = smoothness(nodes)
    return 0.02 * strain + 0.1 * bend + 1e-9 * np.eye(len(strain))


@pytest.mark.parametrize("shift", [0.0, 1.0 - 0.7j])
def test_the_solution_is_that_of_the_equations_written_out(shift):
    blended, goal, weight = case(shift)
    found = blended.solve(goal, weight, smooth(blended.nodes))
    rows = blended.rows
    for own, to, some in zip(found, goal, weight, strict=True):
        share = some / some.sum()
        left = (rows.conj().T * share) @ rows + smooth(blended.nodes)
        np.testing.assert_allclose(own, np.linalg.solve(left, rows.conj().T @ (share * to)), rtol=1e-6, atol=1e-7)


def test_a_similarity_is_met_whatever_the_weights():
    blended, _, weight = case(0.2j)
    goal = np.broadcast_to((0.6 - 0.8j) * blended.points + 2.0, weight.shape)
    found = blended.solve(goal, weight, smooth(blended.nodes))
    m = len(blended.nodes.at)
    np.testing.assert_allclose(found[:, :m], np.tile((0.6 - 0.8j) * blended.nodes.at + 2.0, (3, 1)), atol=1e-4)
    np.testing.assert_allclose(found[:, m:], 0.6 - 0.8j, atol=1e-4)


def test_only_how_weights_compare_counts():
    blended, goal, weight = case(0.0)
    same = smooth(blended.nodes)
    np.testing.assert_allclose(blended.solve(goal, weight, same), blended.solve(goal, 7.0 * weight, same), rtol=1e-9)


def test_what_is_added_to_the_right_hand_sides_draws_the_solution():
    blended, goal, weight = case(0.0)
    same, m = smooth(blended.nodes), len(blended.nodes.at)
    toward = np.zeros((len(goal), 2 * m), complex)
    toward[:, m:] = 1e6 * 0.7j
    drawn = blended.solve(goal, weight, same + 1e6 * np.diag(np.r_[np.zeros(m), np.ones(m)]), toward)
    np.testing.assert_allclose(drawn[:, m:], 0.7j, atol=1e-4)
