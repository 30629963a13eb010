"""Courses: evenly sampled stretches of line, with what is compared along them: their turns and their corners."""

from dataclasses import dataclass

import numpy as np

from ..geometry.contours import Complex, Contours, Floats
from .query import Run


@dataclass(frozen=True)
class Course:
    """Samples at equal arc length along a stretch of line (a closed one does not repeat its first).

    Attributes
    ----------
    points : (n,) complex
    heading : (n,) float
        Direction, continuous along the stretch.
    corners : (n,) float
        Running count of corners.
    closed : bool
    """

    points: Complex
    heading: Floats
    corners: Floats
    closed: bool

    @classmethod
    def along(cls, contours: Contours, run: Run, count: int) -> "Course":
        """Sample a stretch with `count` points."""
        at = np.append(run.indices, run.indices[0]) if run.closed else run.indices
        z, heading = contours.points[at], np.unwrap(contours.heading[at])
        corner = contours.corners[at]
        corner = np.concatenate([[0.0], np.cumsum(np.maximum(np.diff(corner), 0.0))])
        where = np.linspace(0.0, len(at) - 1.0, count, endpoint=not run.closed)
        index = np.arange(len(at))
        points = np.interp(where, index, z.real) + 1j * np.interp(where, index, z.imag)
        return cls(points, np.interp(where, index, heading), np.interp(where, index, corner), run.closed)

    @property
    def clockwise(self) -> bool:
        """Whether a closed course runs clockwise."""
        return bool(self.heading[-1] < self.heading[0])

    def backward(self) -> "Course":
        """The same stretch walked the other way."""
        return Course(self.points[::-1], self.heading[::-1] + np.pi, self.corners[-1] - self.corners[::-1], self.closed)

    def reflected(self) -> "Course":
        """The mirror image of the stretch."""
        return Course(np.conj(self.points), -self.heading, self.corners, self.closed)

    def twice(self) -> "Course":
        """A closed course walked twice: every stretch of it, wherever it begins, is then one without a seam."""
        around = 2 * np.pi * (-1.0 if self.clockwise else 1.0)
        step = self.corners[-1] * len(self.points) / max(1, len(self.points) - 1)
        return Course(
            np.tile(self.points, 2),
            np.concatenate([self.heading, self.heading + around]),
            np.concatenate([self.corners, self.corners + step]),
            True,
        )


def lengths(contours: Contours, runs: list[Run]) -> Floats:
    """Arc length of each stretch.

    Parameters
    ----------
    contours : Contours
    runs : list[Run]

    Returns
    -------
    Floats
    """
    return np.array([contours.weight[run.indices].sum() for run in runs])
