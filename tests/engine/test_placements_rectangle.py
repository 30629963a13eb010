"""Rectangles: corners, frames, and what cannot be one."""

import numpy as np
import pytest
from hypothesis import given
from strategies import numbers

import geoanalogy as ga


def test_the_ring_of_a_turned_rectangle_runs_counter_clockwise_from_its_least_corner():
    ring = ga.Rectangle(1, 2, 4, 2, np.pi / 2).ring
    assert np.allclose(ring, [(2, 0), (2, 4), (0, 4), (0, 0)])
    assert ga.Rectangle(1, 2, 4, 2, np.pi / 2).area == 8


@given(numbers(-50, 50), numbers(-50, 50), numbers(0.1, 9), numbers(0.1, 9), numbers(-3, 3))
def test_a_box_in_a_frame_gives_the_rectangle_back(x, y, width, height, frame):
    for quarter in range(4):
        given_one = ga.Rectangle(x, y, width, height, frame + quarter * np.pi / 2)
        box, found = given_one.box(frame)
        again = ga.Rectangle.from_box(box, frame, found)
        assert found == quarter
        assert np.allclose(again.ring, given_one.ring, atol=1e-9)
        assert -np.pi < again.angle <= np.pi


def test_the_angle_of_an_upright_rectangle_is_a_plain_zero():
    assert str(ga.Rectangle.from_box(np.array([0.0, 0, 1, 1]), 0.0).angle) == "0.0"


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ((0, 0, 0, 1), "has no area; give a positive width and height"),
        ((0, 0, 1, -2), "has no area"),
        ((0, float("nan"), 1, 1), "not finite"),
        ((0, 0, 1, 1, float("inf")), "not finite"),
        ((1e12, 0, 1, 1), "move the scene near the origin"),
    ],
)
def test_what_is_no_rectangle_is_refused(values, message):
    with pytest.raises(ga.InputError, match=message):
        ga.Rectangle(*values)
