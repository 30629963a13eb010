"""What stands out of a drawing, and is shown."""

import numpy as np
import pytest
from drawn import bent, box, fish, moved
from hypothesis import given
from hypothesis import strategies as st

import geoanalogy as ga
from geoanalogy.regions.standing import (
    ALIKE,
    CERTAIN,
    HALFWAY,
    above_chance,
    least_shown,
    middle_of_gap,
    standing,
)

SIMILARITIES = st.lists(st.floats(0.0, 1.0), min_size=1, max_size=12)


@given(SIMILARITIES)
def test_standing_ascends_from_nothing_to_one(values):
    every = np.sort(values)[::-1]
    found = standing(np.linspace(0.0, 1.0, 50), every)
    assert (np.diff(found) >= -1e-12).all()
    assert found[0] == pytest.approx(0.0, abs=1e-6) and found[-1] == pytest.approx(1.0)


def test_the_same_similarity_stands_out_of_weak_clutter_more_than_of_strong():
    half = np.array([HALFWAY])
    among_alike = standing(half, np.array([0.5, 0.5, 0.5, 0.5, 0.5]))[0]
    among_weak = standing(half, np.array([0.5, 0.1, 0.1, 0.1, 0.1]))[0]
    assert among_alike == pytest.approx(0.5, abs=0.02)
    assert among_weak > 0.75


@given(SIMILARITIES, st.floats(0.01, 0.99), st.floats(0.0, 0.99))
def test_what_is_shown_stands_out_and_what_is_not_does_not(values, threshold, contrast):
    every = np.sort(values)[::-1]
    least = least_shown(every, np.ones(len(every)), threshold, contrast)
    found = standing(every, every)
    needed = max(threshold, contrast * found[0])
    assert (found[every >= least] >= needed - 1e-6).all()
    hidden = (every < least) & (every > middle_of_gap(every))
    assert (found[hidden] < needed + 1e-6).all()


@pytest.mark.parametrize(
    ("similarities", "shown"),
    [
        ([0.55, 0.5, 0.43, 0.42, 0.38, 0.12, 0.1], 5),
        ([0.95, 0.9, 0.4, 0.38, 0.37], 2),
        ([0.8, 0.7, 0.65], 3),
        ([0.9], 1),
        ([0.09, 0.05], 0),
    ],
)
def test_what_lies_below_the_widest_gap_is_clutter(similarities, shown):
    every = np.array(similarities)
    assert (every >= least_shown(every, np.ones(len(every)), 0.2, 0.0)).sum() == shown


def test_a_threshold_in_a_gap_lies_in_its_middle():
    assert middle_of_gap(np.array([0.9, 0.7, 0.3, 0.2])) == pytest.approx(0.5)
    assert middle_of_gap(np.array([0.9, 0.8])) == pytest.approx(0.45)


def test_all_is_shown_without_threshold_and_contrast():
    assert least_shown(np.array([0.7, 0.01, 0.0]), np.zeros(3), 0.0, 0.0) == 0.0
    assert least_shown(np.zeros(0), np.zeros(0), 0.5, 0.5) == 0.0


@pytest.mark.parametrize(
    ("similarities", "corners", "shown"),
    [
        ([0.5, 0.4, 0.3], [0.3, 0.2, 0.1], 1),
        ([0.5, 0.48, 0.3], [1.0, 0.2, 0.1], 1),
        ([0.5, 0.48, 0.3], [0.1, 0.8, 0.1], 2),
        ([0.5, 0.48, 0.45], [1.0, 0.2, 1.0], 1),
        ([0.9, 0.88, 0.86], [0.1, 0.1, 0.1], 3),
        ([0.3], [0.0], 1),
    ],
)
def test_what_may_be_chance_is_shown_only_as_the_best(similarities, corners, shown):
    every = np.array(similarities)
    assert (every >= above_chance(every, np.array(corners))).sum() == shown


@given(SIMILARITIES, st.floats(0.0, 1.0), st.randoms(use_true_random=False))
def test_what_is_shown_is_certain_or_alike_or_the_best(values, threshold, random):
    every = np.sort(values)[::-1]
    corners = np.array([random.random() for _ in values])
    least = least_shown(every, corners, max(threshold, 0.01), 0.0)
    no_chance = (corners >= CERTAIN) | (every >= ALIKE)
    no_chance[0] = True
    assert (no_chance | (every < least) | np.isin(every, every[no_chance])).all()


def test_copies_of_what_has_no_corners_are_no_chance():
    t = np.linspace(0.0, 2.0 * np.pi, 80)
    oval = np.stack([np.cos(t), 0.4 * np.sin(t)], 1)
    drawing = ga.Drawing([oval, *(moved(oval, s, a, (4.0 * k, 0.0)) for k, s, a in ((1, 1.0, 0.3), (2, 1.2, 1.0)))])
    assert len(ga.match_regions(drawing, box([oval]))) == 2


def test_a_match_keeps_its_similarity_whatever_else_the_drawing_has():
    target = [moved(bent(line, 0.9), 0.8, 1.0, (2.5, 0.5)) for line in fish()]
    other = [moved(line, shift=(6.0, 0.0)) for line in fish()]
    alone = ga.match_regions(ga.Drawing(fish() + target), box(fish()))
    beside = ga.match_regions(ga.Drawing(fish() + target + other), box(fish()))
    assert beside[0].similarity > 0.95
    assert beside[1].similarity == pytest.approx(alone[0].similarity, abs=0.05)
    assert alone.threshold < beside.threshold
