"""Contours of a drawing: even resampling, smoothing, tangents, and samples that are denser where the line turns.

Points are complex numbers x + iy here: a similarity is then z -> a z + b, and a turn is the argument of a quotient.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d

from ..tolerances import (
    CONTOUR_POINTS,
    CONTOUR_SMOOTHING,
    CORNER_TURN,
    CORNER_WINDOW,
    HULL_DIRECTIONS,
    LEAST_CONTOUR_POINTS,
)

Complex = NDArray[np.complex128]
Floats = NDArray[np.float64]
Indices = NDArray[np.intp]


def surrounding_circle(z: Complex) -> tuple[complex, float]:
    """Centre and diameter of the smallest circle round points.

    Parameters
    ----------
    z : (n,) complex

    Returns
    -------
    tuple[complex, float]

    Notes
    -----
    The diagonal of the bounding box, which the thesis takes as a unit, changes when a drawing is turned. Of many points
    only the outermost in HULL_DIRECTIONS directions are taken: the exact circle takes quadratic time in the vertices of
    the convex hull, and the difference is a hundred-thousandth.
    """
    if len(z) > HULL_DIRECTIONS:
        ways = np.exp(2j * np.pi * np.arange(HULL_DIRECTIONS) / HULL_DIRECTIONS)
        z = z[np.unique([int((z.real * w.real + z.imag * w.imag).argmax()) for w in ways])]
    points = shapely.multipoints(np.stack([z.real, z.imag], 1))
    circle = shapely.minimum_bounding_circle(points)
    middle = shapely.get_coordinates(circle).reshape(-1, 2)
    low, high = middle.min(0), middle.max(0)
    return complex(*((low + high) / 2.0)), 2.0 * float(shapely.minimum_bounding_radius(points))


def even(line: Complex, closed: bool, count: int) -> Complex:
    """Points at equal arc length along a line.

    Parameters
    ----------
    line : (n,) complex
        Vertices without consecutive duplicates; a closed line does not repeat its first vertex.
    closed : bool
        Whether the last vertex is joined to the first.
    count : int
        Number of points; an open line keeps both its ends.

    Returns
    -------
    (count,) complex
    """
    path = np.append(line, line[0]) if closed else line
    length = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(path)))])
    at = np.linspace(0.0, length[-1], count, endpoint=not closed)
    return np.interp(at, length, path.real) + 1j * np.interp(at, length, path.imag)


def smooth(line: Complex, closed: bool, width: float) -> Complex:
    """An evenly sampled line under a Gaussian.

    Parameters
    ----------
    line : (n,) complex
        Points at equal arc length.
    closed : bool
        Whether the last point is joined to the first.
    width : float
        Standard deviation, in points. An open line is continued beyond its ends by point reflection, which keeps the
        ends.

    Returns
    -------
    (n,) complex
    """
    if width <= 0.0 or len(line) < 3:
        return line
    pair = np.stack([line.real, line.imag])
    if closed:
        pair = gaussian_filter1d(pair, width, axis=1, mode="wrap")
    else:
        margin = min(len(line) - 1, int(4.0 * width) + 1)
        before = 2.0 * pair[:, :1] - pair[:, margin:0:-1]
        after = 2.0 * pair[:, -1:] - pair[:, -2 : -margin - 2 : -1]
        pair = gaussian_filter1d(np.hstack([before, pair, after]), width, axis=1, mode="nearest")
        pair = pair[:, margin : margin + len(line)]
    return pair[0] + 1j * pair[1]


def headings(line: Complex, closed: bool) -> Floats:
    """Direction of an evenly sampled line at each of its points, unwrapped along it.

    Parameters
    ----------
    line : (n,) complex
        Points at equal arc length.
    closed : bool
        Whether the last point is joined to the first.

    Returns
    -------
    (n,) float
        Radians, continuous: the difference of two entries is the turn between them.
    """
    if closed:
        step = np.roll(line, -1) - np.roll(line, 1)
    else:
        step = np.gradient(line)
    return np.unwrap(np.angle(step))


@dataclass(frozen=True)
class Contours:
    """All lines of a drawing, evenly resampled and smoothed, in one array.

    Attributes
    ----------
    points : (n,) complex
        Points, line after line.
    drawn : (n,) complex
        The same points before smoothing: where the line was drawn.
    heading : (n,) float
        Direction of the line at each point, radians, unwrapped along the line.
    line : (n,) int
        Number of the line that a point is of.
    first : (m + 1,) int
        Index of the first point of each line; the last entry is n.
    closed : (m,) bool
        Whether a line is closed.
    spacing : (m,) float
        Arc length between consecutive points of a line.
    """

    points: Complex
    drawn: Complex
    heading: Floats
    line: Indices
    first: Indices
    closed: NDArray[np.bool_]
    spacing: Floats

    @classmethod
    def of(cls, lines: list[Complex], closed: list[bool], size: float, smoothing: float) -> "Contours":
        """Resample and smooth lines.

        Parameters
        ----------
        lines : list of (n,) complex
            Vertices; closed lines do not repeat their first.
        closed : list of bool
            Whether each line is closed.
        size : float
            Extent of the drawing, the unit of the smoothing that every line gets.
        smoothing : float
            Standard deviation of further smoothing, for noisy lines, as a length.

        Notes
        -----
        The turning angle of appendix A sums absolute turns, so it must not see the jitter of vectorised lines: every
        line is smoothed by CONTOUR_SMOOTHING of its own length, so that a small shape keeps the detail of a large one.
        """
        lengths = np.array([_length(z, c) for z, c in zip(lines, closed, strict=True)])
        grain = lengths.sum() / CONTOUR_POINTS
        parts, drawn, turns, spacings = [], [], [], []
        for z, is_closed, length in zip(lines, closed, lengths, strict=True):
            count = max(LEAST_CONTOUR_POINTS, int(np.ceil(length / grain)))
            spacing = length / (count if is_closed else count - 1)
            width = max(CONTOUR_SMOOTHING * min(length, size), smoothing) / spacing
            drawn.append(even(z, is_closed, count))
            z = smooth(drawn[-1], is_closed, width)
            parts.append(z)
            turns.append(headings(z, is_closed))
            spacings.append(spacing)
        first = np.concatenate([[0], np.cumsum([len(z) for z in parts])])
        return cls(
            np.concatenate(parts),
            np.concatenate(drawn),
            np.concatenate(turns),
            np.repeat(np.arange(len(parts)), np.diff(first)),
            first,
            np.array(closed, bool),
            np.array(spacings),
        )

    def slice_of(self, line: int) -> slice:
        """The indices of a line's points."""
        return slice(int(self.first[line]), int(self.first[line + 1]))

    @cached_property
    def weight(self) -> Floats:
        """Arc length that each point stands for."""
        return self.spacing[self.line]

    @cached_property
    def turning(self) -> Floats:
        """Absolute turn at each point, (n,) radians: half the turn between its two neighbours."""
        out = np.empty(len(self.points))
        for k in range(len(self.closed)):
            s = self.slice_of(k)
            turn = np.abs(np.diff(self.heading[s], append=self.heading[s.start]))
            if self.closed[k]:
                around = self.heading[s.stop - 1] - self.heading[s.start]
                turn[-1] = abs((around + np.pi) % (2 * np.pi) - np.pi)
                out[s] = (turn + np.roll(turn, 1)) / 2
            else:
                turn[-1] = 0.0
                out[s] = (turn + np.concatenate([[0.0], turn[:-1]])) / 2
        return out

    @cached_property
    def corners(self) -> Floats:
        """Running count of corners along each line, (n,).

        It grows by about 1 over a corner, sharp or blunt, and hardly elsewhere.
        A corner stays one when a shape is bent, while its angle changes; so corners are counted beside the turn. A
        stretch of CORNER_WINDOW of the line's length is a corner in so far as it turns by more than CORNER_TURN.
        """
        out = np.empty(len(self.points))
        for k in range(len(self.closed)):
            s = self.slice_of(k)
            half = max(1, round(CORNER_WINDOW * (s.stop - s.start) / 2))
            heading = self.heading[s]
            if self.closed[k]:
                around = round((heading[-1] - heading[0]) / (2 * np.pi)) * 2 * np.pi
                padded = np.concatenate([heading[-half:] - around, heading, heading[:half] + around])
            else:
                padded = np.pad(heading, half, mode="edge")
            turn = padded[2 * half :] - padded[: -2 * half]
            out[s] = np.cumsum(1.0 - np.exp(-((turn / CORNER_TURN) ** 2))) / (2 * half)
        return out

    def samples(self, spacing: float, turn: float, least: int) -> Indices:
        """Points that are denser where the line turns (appendix A).

        Parameters
        ----------
        spacing : float
            Largest arc length between neighbouring samples: straight stretches are not undersampled.
        turn : float
            Largest absolute turn between neighbouring samples, radians.
        least : int
            Samples that every line gets at least.

        Returns
        -------
        (k,) int
            Indices into `points`, ascending.
        """
        density = np.maximum(self.weight / spacing, self.turning / turn)
        chosen = []
        for k in range(len(self.closed)):
            s = self.slice_of(k)
            d = density[s]
            total = float(d.sum())
            if total < least:
                d = d + (least - total) / len(d)
                total = float(d.sum())
            step = np.cumsum(d) - d / 2
            wanted = (np.arange(np.ceil(total)) + 0.5) * total / np.ceil(total)
            chosen.append(np.unique(np.clip(np.searchsorted(step, wanted), 0, len(d) - 1)) + s.start)
        return np.concatenate(chosen)


def _length(line: Complex, closed: bool) -> float:
    """Arc length of a line."""
    return float(np.abs(np.diff(line, append=line[:1] if closed else line[-1:])).sum())
