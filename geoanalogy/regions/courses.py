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
        return Stretch.of(contours, run).course(count)

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

    @property
    def once_round(self) -> tuple[float, float]:
        """By how much direction and count of corners of a closed course grow once round it."""
        around = 2 * np.pi * (-1.0 if self.clockwise else 1.0)
        return around, float(self.corners[-1]) * len(self.points) / max(1, len(self.points) - 1)

    def twice(self) -> "Course":
        """A closed course walked twice: every stretch of it, wherever it begins, is then one without a seam."""
        around, more = self.once_round
        return Course(
            np.tile(self.points, 2),
            np.concatenate([self.heading, self.heading + around]),
            np.concatenate([self.corners, self.corners + more]),
            True,
        )


@dataclass(frozen=True)
class Stretch:
    """A stretch of line as its contour has it, to be sampled again and again.

    Attributes
    ----------
    points : (n,) complex
        A closed one ends with its first.
    measures : (n,) complex
        Direction, continuous along the stretch, and as imaginary part the running count of corners.
    closed : bool
    """

    points: Complex
    measures: Complex
    closed: bool

    @classmethod
    def of(cls, contours: Contours, run: Run) -> "Stretch":
        """The stretch of a run."""
        at = np.append(run.indices, run.indices[0]) if run.closed else run.indices
        corners = np.cumsum(np.maximum(np.diff(contours.corners[at], prepend=contours.corners[at[0]]), 0.0))
        return cls(contours.points[at], np.unwrap(contours.heading[at]) + 1j * corners, run.closed)

    def course(self, count: int) -> Course:
        """Its course by `count` samples."""
        index = np.arange(len(self.points))
        where = np.linspace(0.0, index[-1], count, endpoint=not self.closed)
        points, measures = np.interp(where, index, self.points), np.interp(where, index, self.measures)
        return Course(points, measures.real, measures.imag, self.closed)


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
