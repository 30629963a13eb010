"""The last step of a match: counterparts continued along lines, and the average of what agrees."""

import numpy as np
import pytest
from drawn import closed, fish, inner_points, moved

import geoanalogy as ga
from geoanalogy.regions import consensus, matching
from geoanalogy.regions.fitting import FITTING, Fitter
from geoanalogy.regions.growing import LIGHT, REACH, grown
from geoanalogy.regions.query import Query
from geoanalogy.regions.transformation import Nodes

OUTLINE = fish()[0][:-1]
RING = np.array([(-2.0, -2.0), (2.5, -2.0), (2.5, 2.0), (-2.0, 2.0)])
SHIFT = (6.0, 0.0)


def fitter_of(other):
    """Of the fish and another line: drawing, query, fitter, and the unknowns of the shift."""
    drawing = ga.Drawing([closed(OUTLINE), other])
    options = ga.RegionOptions()
    query = Query.of(drawing, RING, options)
    nodes = Nodes.of(query.points, query.spacing, options.neighbourhood)
    fitter = Fitter(drawing.contours, query, nodes)
    shift = drawing.into_frame(np.array([SHIFT])) - drawing.into_frame(np.array([(0.0, 0.0)]))
    return drawing, query, fitter, np.concatenate([nodes.at + shift, np.ones(len(nodes.at))])[None]


def without(some, mirrored=False, other=None):
    """Counterparts of a copy, but for those of some samples, and what they are continued to."""
    _, _, fitter, unknowns = fitter_of(moved(closed(OUTLINE), shift=SHIFT) if other is None else other)
    flip = np.array([mirrored])
    at, goal, weight, _, _ = fitter.counterparts(fitter.sampling, unknowns, flip, FITTING)
    at[0, some], goal[0, some], weight[0, some] = -1, 0.0, 0.0
    return fitter, unknowns, at, grown(fitter.sampling, fitter.target, unknowns, flip, (at, goal, weight))


@pytest.mark.parametrize("begin", [30, 92])
def test_counterparts_are_continued_along_the_line_from_both_sides(begin):
    some = np.arange(begin, begin + 10) % 96
    fitter, unknowns, _, (goal, weight) = without(some)
    truth = unknowns[0] @ fitter.sampling.rows.T
    step = fitter.sampling.samples.spacing[0]
    assert np.abs(goal[0, some] - truth[some]).max() < 0.5 * step
    assert ((weight[0, some] > 0.8 * LIGHT) & (weight[0, some] <= LIGHT)).all()


def test_counterparts_are_continued_by_a_few_samples_only():
    some = np.arange(20, 60)
    _, _, _, (_, weight) = without(some)
    assert (weight[0, some][:REACH] > 0.0).all() and (weight[0, some][-REACH:] > 0.0).all()
    assert (weight[0, some][REACH:-REACH] == 0.0).all()


def test_counterparts_are_not_continued_beyond_the_end_of_a_line():
    _, _, at, (_, weight) = without([], other=moved(OUTLINE[:100], shift=SHIFT))
    missing = at[0] < 0
    assert missing.sum() > 20
    assert weight[0, missing].max() < 0.5 * LIGHT or (weight[0, missing] > 0.0).sum() <= 2


def test_rigidity_draws_factors_to_one_scale_and_leaves_their_rotations():
    fitter = fitter_of(moved(closed(OUTLINE), shift=SHIFT))[2]
    m, blended = len(fitter.nodes.at), fitter.sampling.blended
    # a conformal map whose scale grows along the fish
    away = blended.points - blended.points.mean()
    goal = (away + away**2 / (2.0 * fitter.size))[None]
    weight = np.ones(goal.shape)
    turned = 1.2 * np.exp(0.3j * np.arange(m))[None]
    free = fitter.solve(blended, goal, weight, (0.01, 0.1))[0, m:]
    soft = fitter.solve(blended, goal, weight, (0.01, 0.1), (0.1, free[None]))[0, m:]
    stiff = fitter.solve(blended, goal, weight, (0.01, 0.1), (1e5, turned))[0, m:]
    assert np.abs(free).std() > 0.02
    assert np.abs(soft).std() < 0.9 * np.abs(free).std()
    np.testing.assert_allclose(stiff, turned[0], atol=1e-3)


def test_a_round_is_rigid_where_it_is_asked_to_be():
    _, _, fitter, unknowns = fitter_of(moved(closed(OUTLINE), shift=SHIFT) * np.array([1.15, 0.9]))
    m, flip = len(fitter.nodes.at), np.array([False])
    stretch = {}
    for rigidity in (0.0, 1.0):
        found = unknowns
        for _ in range(4):
            found = fitter.moved(fitter.sampling, found, flip, (0.01, 0.1), consensus.SETTLING, rigidity)
        stretch[rigidity] = np.log(np.abs(found[0, m:])).std()
    assert stretch[1.0] < stretch[0.0]


def functions(shifts):
    """Three nodes moved by shifts, unturned."""
    at = np.array([0.0, 1.0, 1.0j])
    return np.array([np.concatenate([at + shift, np.ones(3)]) for shift in shifts])


def test_what_is_as_alike_counts_as_much():
    found = consensus.averaged(functions([0.0, 0.04, 0.02j]), np.array([0.7, 0.7, 0.7]), 2.0)
    np.testing.assert_allclose(found, functions([(0.04 + 0.02j) / 3.0])[0], atol=1e-12)


def test_what_is_less_alike_counts_for_little():
    found = consensus.averaged(functions([0.0, 0.04]), np.array([0.7, 0.35]), 2.0)
    np.testing.assert_allclose(found, functions([0.0])[0], atol=1e-9)


def test_another_fit_counts_for_nothing_however_alike_it_is():
    found = consensus.averaged(functions([0.0, 0.5]), np.array([0.5, 1.0]), 2.0)
    np.testing.assert_array_equal(found, functions([0.0])[0])


def test_without_any_evidence_the_average_is_a_plain_one():
    found = consensus.averaged(functions([0.0, 0.04]), np.zeros(2), 2.0)
    np.testing.assert_allclose(found, functions([0.02])[0], atol=1e-12)


def test_what_is_shown_is_settled_and_keeps_its_similarity(monkeypatch):
    lines = [closed(OUTLINE), moved(closed(OUTLINE), 0.7, 0.4, SHIFT)[:110]]
    as_settled = ga.match_regions(ga.Drawing(lines), RING)
    monkeypatch.setattr(matching, "MOST_SETTLED", 0)
    as_found = ga.match_regions(ga.Drawing(lines), RING)
    assert as_settled[0].similarity == as_found[0].similarity
    points = inner_points()
    truth = moved(points, 0.7, 0.4, SHIFT)
    error = [np.linalg.norm(m[0].map(points) - truth, axis=1).mean() for m in (as_settled, as_found)]
    assert error[0] != error[1]
    assert error[0] < max(0.02, 1.2 * error[1])
