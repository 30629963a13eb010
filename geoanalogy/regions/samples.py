"""Samples of the query's lines, and the linear maps from a function's unknowns to where it takes them."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..geometry.contours import Complex, Contours, Floats
from .courses import Course, lengths
from .least_squares import Blended
from .query import Query
from .transformation import Nodes

#: Samples of the query's lines, and stretches, longest first, that get any.
SAMPLES, MOST_RUNS = 96, 40
#: Candidate counterparts of each of SAMPLES: so many to each side of the nearest point of a line.
BAND = 7


@dataclass(frozen=True)
class Samples:
    """Samples of the query's lines.

    Attributes
    ----------
    points : (s,) complex
    heading : (s,) float
        Direction of the line.
    step : (s,) float
        Arc length to the sample before; 0 where a stretch begins.
    turn : (s,) float
        Turn from the sample before.
    spacing : (s,) float
        Arc length between the samples of its stretch.
    before, after : (s,) int
        Numbers of its neighbours along the line, -1 beyond the end of an open one.
    """

    points: Complex
    heading: Floats
    step: Floats
    turn: Floats
    spacing: Floats
    before: NDArray[np.intp]
    after: NDArray[np.intp]

    @property
    def turning(self) -> float:
        """The sum of the unsigned turns, radians."""
        return float(np.abs((self.turn + np.pi) % (2.0 * np.pi) - np.pi).sum())

    @classmethod
    def of(cls, contours: Contours, query: Query, number: int) -> "Samples":
        """Spread about `number` samples over the lines of the query by length."""
        length = lengths(contours, query.runs)
        parts: list[tuple[Complex, Floats, Floats, Floats, Floats, NDArray[np.intp], NDArray[np.intp]]] = []
        first = 0
        for run, own in zip(query.runs[:MOST_RUNS], length, strict=False):
            count = max(2, round(number * own / length.sum()))
            course = Course.along(contours, run, count)
            heading = course.heading
            spacing = np.full(count, own / (count if run.closed else count - 1))
            step = spacing.copy()
            step[0] = 0.0
            indices = first + np.arange(count)
            before, after = np.roll(indices, 1), np.roll(indices, -1)
            if not run.closed:
                before[0], after[-1] = -1, -1
            turn = np.diff(heading, prepend=heading[0])
            parts.append((course.points, heading, step, turn, spacing, before, after))
            first += count
        return cls(*(np.concatenate(p) for p in zip(*parts, strict=True)))


@dataclass(frozen=True)
class Sampling:
    """Samples, and where functions take them.

    Attributes
    ----------
    samples : Samples
    blended : Blended
        The samples as functions take them along.
    ahead : (s, 2m) complex
        The linear map from the unknowns of a function to the images of points just ahead of the samples.
    band : int
        Candidate counterparts of a sample: so many to each side of the nearest point of a line.
    """

    samples: Samples
    blended: Blended
    ahead: Complex
    band: int

    @property
    def rows(self) -> Complex:
        """The linear map (s, 2m) from the unknowns of a function to the images of the samples."""
        return self.blended.rows

    @classmethod
    def of(cls, contours: Contours, query: Query, nodes: Nodes, coarse: int) -> "Sampling":
        """The sampling by every `coarse`-th of SAMPLES, whose counterparts are looked for about as far."""
        samples = Samples.of(contours, query, SAMPLES // coarse)
        ahead = samples.points + 1e-3 * query.size * np.exp(1j * samples.heading)
        return cls(samples, Blended(nodes, samples.points), nodes.rows(ahead), -(-BAND // coarse))
