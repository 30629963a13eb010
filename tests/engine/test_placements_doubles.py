"""Of flat boxes just above each other at one element one is a second guess at the place of the other."""

import numpy as np
from placement_scenes import polygon

import geoanalogy as ga
from geoanalogy.placements.arrangement import arrangement_of
from geoanalogy.placements.doubles import without_doubles


def street():
    """A facade with four windows, 1 m by 1.5 m, in two rows."""
    windows = [polygon(1 + 3 * i, 1.2 + 3 * j, 1.0, 1.5, "window", f"{i} {j}") for i in range(2) for j in range(2)]
    return ga.Scene([polygon(0, 0, 6, 7, "facade", "f"), *windows])


def sill(i, j, below):
    """Edges of a sill, 10 cm high, so far below a window."""
    x, y = 1 + 3 * i, 1.2 + 3 * j - below
    return np.array([x - 0.05, y - 0.1, x + 1.05, y])


def kept(boxes, drawn=()):
    scene = street()
    model = ga.learn_placement(
        [
            ga.Example(scene, ga.Rectangle(*(b[:2] + b[2:]) / 2, *b[2:] - b[:2]))
            for b in (drawn if len(drawn) else [sill(0, 0, 0.02)])
        ]
    )
    arrangement = arrangement_of(scene, scene.polygon("f"), 0.0)
    shown = np.array(drawn).reshape(-1, 4)
    return without_doubles(model.lesson, arrangement, np.array(boxes), shown).tolist()


def test_of_two_sills_below_one_window_the_better_one_stays():
    assert kept([sill(0, 0, 0.02), sill(1, 0, 0.02), sill(0, 0, 0.15), sill(1, 0, 0.15)]) == [0, 1]
    assert kept([sill(0, 0, 0.15), sill(0, 0, 0.02)]) == [0]


def test_a_second_guess_at_the_place_of_an_example_goes():
    assert kept([sill(0, 0, 0.15), sill(1, 1, 0.15)], [sill(0, 0, 0.02), sill(1, 0, 0.02)]) == [1]


def test_sills_farther_below_each_other_both_stay():
    assert kept([sill(0, 0, 0.02), sill(0, 0, 0.3)]) == [0, 1]


def test_boxes_that_are_not_flat_all_stay():
    narrow, beside, drawn = (np.array([x, 0.3, x + 0.1, 1.1]) for x in (1.2, 1.35, 4.2))
    assert kept([narrow, beside], [drawn]) == [0, 1]


def test_where_examples_are_drawn_above_each_other_results_may_be():
    drawn = [sill(0, 0, 0.02), sill(0, 0, 0.15)]
    assert kept([sill(1, 0, 0.02), sill(1, 0, 0.15)], drawn) == [0, 1]
