"""Drawings of short marks are matched as sets of points."""

import numpy as np
import pytest
from drawn import bent, box, fish, moved

import geoanalogy as ga
from geoanalogy.regions.marks import of_marks
from geoanalogy.regions.query import Query


def dots():
    """A fish of short dashes."""
    line = fish()[0][::3]
    return [np.vstack([p, p + np.array([0.006, 0.002])]) for p in line[:-1]]


def all_moved(lines, **move):
    return [moved(line, **move) for line in lines]


def test_many_short_strokes_are_marks_and_an_outline_is_none():
    for lines, expected in ((dots(), True), (fish(), False)):
        drawing = ga.Drawing(lines + all_moved(lines, shift=(3.0, 0.0)))
        assert of_marks(drawing.contours, Query.of(drawing, box(fish()), ga.RegionOptions())) is expected


@pytest.mark.parametrize("mirrored", [False, True])
def test_a_turned_copy_of_marks_is_found(mirrored):
    move = {"scale": 0.8, "angle": 2.0, "shift": (3.0, 0.5), "mirrored": mirrored}
    drawing = ga.Drawing(dots() + all_moved(dots(), **move))
    match = ga.match_regions(drawing, box(fish()))[0]
    assert match.mirrored == mirrored
    assert match.coverage == 1.0
    truth = moved(fish()[0], **move)
    assert np.linalg.norm(match.map(fish()[0]) - truth, axis=1).mean() < 0.01


def test_bent_marks_among_stray_ones_are_found():
    rng = np.random.default_rng(2)
    stray = [np.vstack([p, p + np.array([0.006, 0.0])]) for p in rng.uniform((2.6, -0.6), (4.2, 1.2), (20, 2))]
    target = [moved(bent(line, 0.6), shift=(3.0, 0.2)) for line in dots()]
    match = ga.match_regions(ga.Drawing(dots() + target + stray), box(fish()))[0]
    truth = moved(bent(fish()[0], 0.6), shift=(3.0, 0.2))
    assert np.linalg.norm(match.map(fish()[0]) - truth, axis=1).mean() < 0.03
    assert match.evidence.own < 1.0


def test_marks_are_not_mirrored_where_that_is_not_wanted():
    drawing = ga.Drawing(dots() + all_moved(dots(), shift=(3.0, 0.0), mirrored=True))
    options = ga.RegionOptions(mirrored=False, threshold=0.0, contrast=0.0)
    assert not any(m.mirrored for m in ga.match_regions(drawing, box(fish()), options).every)
