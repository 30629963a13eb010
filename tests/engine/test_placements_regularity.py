"""Rows, columns, rhythm, mirror images and lines of elements."""

import numpy as np
import pytest

from geoanalogy.placements.regularity import alignment, beats, mirrored_extents, on_beat, rhythm, rows_of

SIZE = 1.2


def extents(*middles):
    return np.array([(m - SIZE / 2, m + SIZE / 2) for m in middles])


def boxes(*middles):
    return np.array([(m - SIZE / 2, 0.0, m + SIZE / 2, 1.0) for m in middles])


def test_boxes_in_line_are_one_row():
    rows = rows_of(extents(5.0, 2.0, 5.1, 8.0))
    assert rows.mean(axis=1) == pytest.approx([2.0, 5.05, 8.0])
    assert len(rows_of(np.zeros((0, 2)))) == 0


def test_steps_go_on_outwards_and_are_halved_where_there_is_room():
    found = rhythm(extents(4.0, 8.0)).mean(axis=1)
    assert {0.0, 2.0, 6.0, 10.0, 12.0} <= set(np.round(found, 6))
    assert len(rhythm(extents(4.0))) == 0


def test_rows_at_one_distance_give_a_rhythm_through_the_whole_parent():
    at, trust = beats(extents(4.0, 6.4, 13.6), 0.0, 20.0)
    best = np.round(at[trust == trust.max()].mean(axis=1), 6)
    assert best.tolist() == pytest.approx([1.6, 4.0, 6.4, 8.8, 11.2, 13.6, 16.0, 18.4])
    assert 0 < trust.max() <= 1


def test_a_rhythm_is_trusted_the_more_the_more_of_its_beats_are_rows():
    def surest(*middles):
        return beats(extents(*middles), 0.0, 30.0)[1].max(initial=0.0)

    assert surest(4.0, 6.4, 8.8, 11.2) > surest(4.0, 8.8, 11.2, 18.4) > surest(4.0, 27.0)


def test_there_is_no_rhythm_of_one_row_or_of_steps_without_number():
    assert len(beats(extents(4.0), 0.0, 20.0)[0]) == 0
    assert len(beats(extents(4.0, 4.1), 0.0, 20.0)[0]) == 0
    assert len(beats(extents(4.0, 6.4), 0.0, 1e6)[0]) == 0


def test_boxes_on_a_beat_are_told_from_those_between():
    rhythm_of = beats(extents(4.0, 6.4, 8.8), 0.0, 20.0)
    on, off = on_beat(boxes(13.6, 12.4), 0, *rhythm_of)
    assert on == pytest.approx(rhythm_of[1].max()) and off < 0.7 * on
    assert on_beat(boxes(3.0), 0, *beats(extents(4.0), 0.0, 20.0)).tolist() == [0.0]


def test_mirrored_extents_lie_on_the_other_side_of_the_parents_middle():
    assert mirrored_extents(np.array([[1.0, 3.0]]), 0.0, 20.0).tolist() == [[17.0, 19.0]]


def test_columns_of_elements_that_examples_stand_in_are_told_from_others():
    doors = np.array([(m - 0.5, -3.0, m + 0.5, -1.0) for m in (2.0, 6.0, 9.0, 14.0)])
    aligned, missed = alignment(boxes(14.0, 11.5), boxes(2.0, 6.0, 9.0), {"door": doors}, 0)
    assert aligned[0] > 0.4 and missed[0] < 0.05
    assert aligned[1] < 0.05 and missed[1] > 0.4


def test_elements_that_run_across_or_stand_anywhere_say_nothing():
    cornice = np.array([(0.0, 2.0, 20.0, 2.2)])
    stray = np.array([(m - 0.5, -3.0, m + 0.5, -1.0) for m in (3.1, 11.0)])
    for drawn in ({"cornice": cornice}, {"stray": stray}, {}):
        aligned, missed = alignment(boxes(14.0), boxes(2.0, 6.0, 9.0), drawn, 0)
        assert aligned.max() < 0.05 and missed.max() < 0.05
    assert alignment(boxes(14.0), np.zeros((0, 4)), {"stray": stray}, 0)[0].tolist() == [0.0]
