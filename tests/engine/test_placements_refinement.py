"""Results that resemble no example stand in the middle of what is likely around them."""

import numpy as np
import pytest
from placement_scenes import below, facade

import geoanalogy as ga
from geoanalogy.placements.arrangement import arrangement_of
from geoanalogy.placements.refinement import OWN_WEIGHT, copied, middle

BOX = np.array([[0.0, 0.0, 2.0, 1.0]])


def test_the_middle_weighs_candidates_by_their_certainty():
    around = np.array([[0.2, 0.0, 2.2, 1.0], [0.0, 0.1, 2.0, 1.1]])
    moved = middle(BOX, around, np.array([1.0, 0.5]))
    whole = OWN_WEIGHT + 1.5
    assert moved == pytest.approx(BOX + np.array([[0.2, 0.05, 0.2, 0.05]]) / whole)


def test_what_stands_elsewhere_does_not_pull():
    elsewhere = np.array([[5.0, 0.0, 7.0, 1.0], [1.8, 0.0, 3.8, 1.0]])
    assert middle(BOX, elsewhere, np.ones(2)) == pytest.approx(BOX)


def test_a_box_without_candidates_stays():
    assert middle(BOX, np.zeros((0, 4)), np.zeros(0)) == pytest.approx(BOX)


def test_each_box_moves_by_itself():
    boxes = np.concatenate([BOX, BOX + 10])
    candidates = np.concatenate([BOX + 0.1, BOX + 9.9])
    moved = middle(boxes, candidates, np.ones(2))
    step = 0.1 / (1 + OWN_WEIGHT)
    assert moved == pytest.approx(boxes + np.array([[step], [-step]]))


def test_a_copy_of_an_example_stays_exactly_where_it_is():
    scene = ga.Scene(facade(0, 4, 3))
    gaps = {"f 0 0": 0.1, "f 2 1": 0.25, "f 3 0": 0.4}
    lesson = ga.learn_placement([ga.Example(scene, below(scene, id, gap)) for id, gap in gaps.items()]).lesson
    arrangement = arrangement_of(scene, scene.polygon("f"), 0.0)
    boxes = np.array([below(scene, "f 1 2", gap).box(0.0)[0] for gap in (0.25, 0.3)])
    assert copied(lesson, arrangement, boxes).tolist() == [True, False]
