"""Chains retraced along fits: what lines as a whole do not tell."""

import numpy as np
import pytest
from drawn import bent, box, fish, moved

import geoanalogy as ga
from geoanalogy.regions.chains import MOST_TARGETS, chain
from geoanalogy.regions.evidence import COVERED, trusted
from geoanalogy.regions.fitting import MEASURING, Fit, Fitter
from geoanalogy.regions.query import Query
from geoanalogy.regions.retraced import counterpart, retraced, wanting
from geoanalogy.regions.transformation import Nodes, TransformationFunction

SHIFT = (3.0, 0.0)


def fitted(lines, shift=SHIFT):
    """The drawing, query and fitter of a fish in a drawing, and the fit that moves it by `shift`."""
    drawing = ga.Drawing(lines)
    options = ga.RegionOptions()
    query = Query.of(drawing, box(fish()), options)
    nodes = Nodes.of(query.points, query.spacing, options.neighbourhood)
    fitter = Fitter(drawing.contours, query, nodes)
    unit = abs(np.diff(drawing.into_frame([(0.0, 0.0), (1.0, 0.0)]))[0])
    unknowns = np.concatenate([nodes.at + unit * complex(*shift), np.ones(len(nodes.at), complex)])
    at, _, _, distance, tilt = fitter.counterparts(fitter.sampling, unknowns[None], np.array([False]), MEASURING)
    m = len(nodes.at)
    fit = Fit(TransformationFunction(nodes, unknowns[:m], unknowns[m:], False), at[0], distance[0], tilt[0])
    return drawing, query, fitter, fit


def copied(cut=None):
    """Two fish, the outline of the second whole or cut."""
    outline, *others = (moved(line, shift=SHIFT) for line in fish())
    return [*fish(), outline[slice(*cut)] if cut else outline, *others]


def test_the_counterpart_of_a_closed_line_is_all_of_it():
    _, query, fitter, fit = fitted(copied())
    found = counterpart(fit, fitter, 0)
    assert found.closed and query.runs[0].closed
    assert len(found.indices) == len(query.runs[0].indices)


def test_the_counterpart_in_a_line_that_goes_on_is_a_part_of_it():
    lines = copied(cut=(20, 140))
    tail = lines[3][-1] + np.linspace(0.0, 1.0, 60)[:, None] * (0.0, 4.0)
    lines[3] = np.vstack([lines[3], tail[1:]])
    drawing, _, fitter, fit = fitted(lines)
    found = counterpart(fit, fitter, 0)
    assert not found.closed
    there = drawing.out_of_frame(drawing.contours.points[found.indices])
    assert there[:, 1].max() < 0.5 < lines[3][:, 1].max()
    assert np.ptp(there[:, 0]) == pytest.approx(np.ptp(copied(cut=(20, 140))[3][:, 0]), rel=0.1)


def test_where_nothing_is_there_is_no_counterpart():
    _, _, fitter, fit = fitted(copied(), shift=(3.0, 5.0))
    assert counterpart(fit, fitter, 0) is None


def test_a_copy_is_worth_what_a_copy_may_be_and_a_fit_to_nothing_is_worth_nothing():
    drawing, query, fitter, fit = fitted(copied())
    nowhere = fitted(copied(), shift=(3.0, 5.0))[-1]
    most = chain(drawing.contours, query.runs[:1], query.rest, True).most.sum(1).mean()
    worth = retraced(drawing.contours, query, fitter, [nowhere, fit], True)
    assert worth[0] == 0.0
    assert worth[1] > 0.8 * most


def test_a_small_shape_among_many_long_lines_is_found():
    arc = np.stack([np.linspace(0.0, 0.87, 12), 0.06 * np.sin(np.linspace(0.0, 3.0, 12))], 1)
    others = [moved(arc, shift=(0.9 * (i % 4) - 0.5, 0.1 * (i // 4) + 0.6)) for i in range(MOST_TARGETS + 1)]
    small = [moved(bent(line, 0.3), 0.3, 2.0, (2.2, 0.0)) for line in fish()]
    assert np.linalg.norm(np.diff(small[0], axis=0), axis=1).sum() < 0.87
    found = ga.match_regions(ga.Drawing([*fish(), *small, *others]), box(fish()))
    assert len(found) == 1 and found[0].evidence.chained > 0.5
    middle = np.array([(0.5, 0.0)])
    assert np.allclose(found[0].map(middle), moved(bent(middle, 0.3), 0.3, 2.0, (2.2, 0.0)), atol=0.01)


def test_what_few_lines_support_is_a_guess():
    assert trusted([0.0, COVERED / 2.0, COVERED, 1.0]) == pytest.approx([0.0, 0.25, 1.0, 1.0])


def test_only_places_without_enough_evidence_want_more():
    _, _, fitter, fit = fitted(copied())
    elsewhere = fitted(copied(), shift=(3.0, 5.0))[-1]
    assert wanting(fitter, [fit, fit, elsewhere], np.array([1.0, 0.4, 0.4])).tolist() == [2]
    assert wanting(fitter, [fit, fit, elsewhere], np.array([0.9, 0.4, 1.0])).tolist() == [0, 1]
