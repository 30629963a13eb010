"""The adapted SL0 similarity, its assignment, and regression on a valid gram matrix (5.2 to 5.4, appendix C)."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from placement_scenes import facade, polygon
from scipy.optimize import linear_sum_assignment

import geoanalogy as ga
from geoanalogy.placements import signature as s
from geoanalogy.placements.arrangement import arrangement_of
from geoanalogy.placements.regression import LEAST_EIGENVALUE, predicted_targets, valid_gram
from geoanalogy.placements.similarity import best_assignment, box_agreement, length_widths
from geoanalogy.relations.elements import Elements
from geoanalogy.relations.observation import Observation
from geoanalogy.relations.table import RELATIONS

SCENE = ga.Scene(facade(0, 3, 2))
HERE = arrangement_of(SCENE, SCENE.polygon("f"), 0.0)


def test_box_coordinates_are_those_of_the_table_of_relations():
    window = SCENE.polygon("f 1 1")
    box = np.array([[1.0, 2.0, 4.0, 3.5]])
    found = s.box_coordinates(box, window.bounds[None, None])[0, 0]
    for i, points in enumerate(([1.0, 2.0], [2.5, 2.75], [4.0, 3.5])):
        seen = Observation(Elements.of([window]), np.array([points]))
        for axis, letter in enumerate("xy"):
            for j, name in enumerate(s.BOX_COORDINATES):
                assert found[axis, i, j] == pytest.approx(RELATIONS[f"{name} {letter}"].value(seen)[0, 0])


def test_a_signature_holds_the_nearest_elements_of_every_label_and_nil_elements():
    seen = s.signature(HERE, np.array([[1.4, 3.0, 2.6, 3.3]]), neighbours=3)
    windows = seen.boxes[s.BOX + "window"][0]
    assert np.allclose(windows[0, 0, 0, 0], 0)  # its left edge on that of the window above it
    assert np.isfinite(windows).all()
    doors = seen.boxes[s.BOX + "door"][0]
    assert np.isfinite(doors[0]).all() and np.isnan(doors[1:]).all()
    assert {k.split(" of ")[0] for k in seen.outlines} == {"polygons", "segments", "corners"}


def test_segments_of_another_label_are_another_group():
    room = ga.Polygon([(0, 0), (4, 0), (4, 3), (0, 3)], "room", "r", segment_labels=["", "door", "", ""])
    scene = ga.Scene([room])
    seen = s.signature(arrangement_of(scene, room, 0.0), np.array([[3.0, 1.0, 3.5, 2.0]]), neighbours=3)
    to_door = seen.outlines["segments of parent (door)"][0]
    assert to_door[0, :, 0].tolist() == pytest.approx([1, 0.5, 0.5, 1, 0.75])
    assert np.isnan(to_door[1:]).all()


def test_what_is_no_rectangle_has_segments_and_corners_of_its_own():
    house = ga.Polygon([(1, 1), (3, 1), (2, 3)], "gable", "g")
    scene = ga.Scene([polygon(0, 0, 6, 6, "plot", "p"), house, polygon(4, 4, 1, 1, "shed", "s")])
    groups = s.signature(arrangement_of(scene, scene.polygon("p"), 0.0), np.array([[4.0, 1, 5, 2]]), 2).outlines
    assert "corners of outline of gable" in groups
    assert not any("shed" in key for key in groups)


def test_agreement_is_one_for_equal_values_falls_with_distance_and_is_zero_for_nil_elements():
    boxes = np.array([[0.0, 0, 2, 1], [0.1, 0, 2.1, 1], [50, 50, 52, 51]])
    a = s.box_coordinates(boxes, np.broadcast_to([[[0.0, 0, 3, 3]]], (3, 1, 4)))
    widths = length_widths(np.array([[2.0, 1.0]]), 1.0)
    to_first = box_agreement(a, a[:1], widths, 1.0)[:, 0, 0, 0]
    assert (to_first[0] == 1).all()
    assert (to_first[1, 1] == 1).all() and (to_first[1, 0] < 1).all() and (to_first[1, 0] > 0.5).all()
    assert to_first[2].max() < 1e-6
    wider = box_agreement(a, a[:1], length_widths(np.array([[2.0, 1.0]]), 2.0), 2.0)[1, 0, 0, 0]
    assert (wider[0] > to_first[1, 0]).all()
    assert not box_agreement(np.full_like(a, np.nan), a, widths, 1.0).any()


@settings(max_examples=60)
@given(st.integers(1, 6), st.integers(0, 10_000))
def test_assignments_are_optimal_one_to_one_and_at_most_the_row_maxima(size, seed):
    rng = np.random.default_rng(seed)
    utility = rng.random((5, size, size)) ** rng.integers(1, 6)
    total, column = best_assignment(utility)
    for matrix, value, columns in zip(utility, total, column, strict=True):
        assert sorted(columns) == list(range(size))
        assert value == pytest.approx(matrix[linear_sum_assignment(matrix, maximize=True)].sum())
        assert value <= matrix.max(axis=1).sum() + 1e-12


def indefinite_gram():
    """Similarities of three sets of three points on a line by optimal assignment: not positive semi-definite.

    Assignments do not compose: what each pair is matched by differs, so that appendix C's embedding fails.
    """
    for seed in range(400):
        sets = np.random.default_rng(seed).choice([0.0, 1.0], (5, 3, 3))
        gram = np.zeros((5, 5))
        for i, j in itertools.product(range(5), repeat=2):
            gram[i, j] = best_assignment((sets[i][:, None] == sets[j][None]).sum(axis=2).astype(float)[None])[0][0]
        if np.linalg.eigvalsh(gram)[0] < -1e-3:
            return gram
    raise AssertionError("no indefinite case found")


def test_a_similarity_of_assignments_can_be_indefinite_and_is_made_valid():
    gram = indefinite_gram()
    assert np.allclose(gram, gram.T)
    assert np.linalg.eigvalsh(gram)[0] < 0
    mended = valid_gram(gram)
    values = np.linalg.eigvalsh(mended)
    assert values[0] >= LEAST_EIGENVALUE * values[-1] * 0.999
    assert np.abs(mended - gram).max() <= -np.linalg.eigvalsh(gram)[0] + LEAST_EIGENVALUE * values[-1]
    targets = np.array([1.0, 0.0, 1.0, 0.5, 1.0])
    assert np.isfinite(predicted_targets(gram, gram, targets)).all()


def test_an_example_is_predicted_its_target_and_what_lies_between_something_between():
    gram = np.array([[1.0, 0.3, 0.1], [0.3, 1.0, 0.2], [0.1, 0.2, 1.0]])
    targets = np.array([1.0, 0.0, 0.5])
    assert predicted_targets(gram, gram, targets) == pytest.approx(targets, abs=1e-9)
    between = predicted_targets(np.array([[0.65, 0.65, 0.1]]), gram, targets)[0]
    assert 0.3 < between < 0.7


def test_equal_targets_are_predicted_everywhere():
    assert predicted_targets(np.array([[0.0, 0.1]]), np.eye(2), np.array([0.7, 0.7])).tolist() == [0.7]
