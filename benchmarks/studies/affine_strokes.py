"""Transformations with many free parameters that the projection error cannot tell apart (figure 3.11).

Two correspondences whose query points lie on the axis of what their transformations do, a turn about the axis of an
extruded shape in space or a scale across the axis of a fish, take each other's points to the same places: their
projection error is zero. The parameters themselves differ, and the gradient of equation 3.5 tells.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..regions_scenes import Array, spline
from ..regions_scenes import fish as fish_lines

#: Units of the transformation space (section 3.2): 45° of a rotation, and a factor of 1.25.
TURN, FACTOR = np.radians(45.0), 1.25


@dataclass(frozen=True)
class Study:
    """Two correspondences between a shape and another.

    Attributes
    ----------
    shapes : pair of sequences of (n, d) float
        Query and target: faces in space, or lines in the plane.
    pairs : list of pairs of (d,) float
        Query points and their targets.
    linear : (2, d, d) float
        Linear parts of the two transformations.
    difference : float
        Between them in the parameter that differs, in its unit.
    """

    shapes: tuple[Sequence[Array], Sequence[Array]]
    pairs: list[tuple[Array, Array]]
    linear: NDArray[np.float64]
    difference: float

    @property
    def projection_error(self) -> float:
        """Mean distance by which each transformation misses the other's target, and back (Cho et al., equation 1)."""
        (qi, pi), (qj, pj) = self.pairs
        a, b = self.linear
        forth = np.linalg.norm(pi + a @ (qj - qi) - pj) + np.linalg.norm(pj + b @ (qi - qj) - pi)
        inverse = np.linalg.inv(self.linear)
        back = np.linalg.norm(qi + inverse[0] @ (pj - pi) - qj) + np.linalg.norm(qj + inverse[1] @ (pi - pj) - qi)
        return float(forth + back) / 4.0


def bar(twist: float = np.radians(60.0)) -> Study:
    """An extruded shape, and the same with its second half turned about the axis (figure 3.11 a)."""
    section = np.array([(-0.5, -0.25), (0.5, -0.25), (0.5, 0.0), (0.1, 0.0), (0.1, 0.3), (-0.5, 0.3)])
    c, s = np.cos(twist), np.sin(twist)
    turn = np.array([(1.0, 0.0, 0.0), (0.0, c, -s), (0.0, s, c)])
    away = np.array((0.0, -2.2, 0.0))

    def half(start: float, end: float, linear: Array, shift: Array) -> list[Array]:
        rings = [np.column_stack([np.full(len(section), x), section]) @ linear.T + shift for x in (start, end)]
        walls = [np.array([rings[0][i], rings[0][i - 1], rings[1][i - 1], rings[1][i]]) for i in range(len(section))]
        return [*walls, *rings]

    straight = np.eye(3)
    query = [*half(0.0, 1.5, straight, np.zeros(3)), *half(1.5, 3.0, straight, np.zeros(3))]
    target = [*half(0.0, 1.5, straight, away), *half(1.5, 3.0, turn, away)]
    points = [np.array((x, 0.0, 0.0)) for x in (0.75, 2.25)]
    pairs = [(p, p + away) for p in points]
    return Study((query, target), pairs, np.stack([straight, turn]), twist / TURN)


def fish(squeeze: float = 0.45) -> Study:
    """A fish, and one whose rear half is squeezed across its axis (figure 3.11 b)."""
    middle, away = 0.5, np.array((0.0, -0.75))
    own = [np.vstack([line]) for line in fish_lines()]
    own += [spline([(x, -0.1), (x + 0.02, 0.02), (x, 0.12)], count=12) for x in (0.34, 0.46, 0.58, 0.68)]
    target = [np.where(line[:, :1] > middle, line * (1.0, squeeze), line) + away for line in own]
    pairs = [(p, p + away) for p in (np.array((0.3, 0.0)), np.array((0.8, 0.0)))]
    linear = np.stack([np.eye(2), np.diag((1.0, squeeze))])
    return Study((own, target), pairs, linear, abs(np.log(squeeze)) / np.log(FACTOR))
