"""A drawing: the lines that chapter 3 matches."""

from collections.abc import Sequence
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ..arguments import listed, points_of, real, shown
from ..errors import InputError
from ..tolerances import LARGEST_COORDINATE, MOST_LINES, ZERO_LENGTH
from .contours import Complex, Contours, surrounding_circle


class Drawing:
    """Lines drawn as strokes, curves or outlines; never changed after it was made.

    Parameters
    ----------
    lines : sequence of (n, 2) arrays
        Polylines in scene units. A closed line repeats its first point. Consecutive equal points are dropped, and lines
        without length are left out.
    smoothing : float
        For noisy lines: standard deviation, in scene units along the line, of the Gaussian they are smoothed with
        before anything is measured (section 3.3). Zero leaves only the slight smoothing that every line gets.

    Attributes
    ----------
    lines : list of (n,) complex
        The lines in the frame of the drawing, without the repeated point of closed ones.
    closed : list of bool
        Whether each line is closed.
    centre : complex
        Origin of the frame, in scene units.
    size : float
        Unit of the frame in scene units: the diameter of the smallest circle round the drawing. (The diagonal of the
        bounding box, which the thesis takes, changes when the drawing is turned.)

    Raises
    ------
    InputError
        When there is no line, a coordinate is not finite or too large, or the smoothing is negative.
    """

    def __init__(self, lines: Sequence[ArrayLike], *, smoothing: float = 0.0):
        if not 0.0 <= real(smoothing) < np.inf:
            raise InputError(f"The smoothing of the drawing is {shown(smoothing)}: give a length of zero or more.")
        lines = listed(lines, "what the drawing is made of", "a list of lines")
        if len(lines) > MOST_LINES:
            raise InputError(f"The drawing has {len(lines)} lines: join or remove lines until {MOST_LINES} are left.")
        kept = [z for z in (_line(points, number) for number, points in enumerate(lines, 1)) if len(z) > 1]
        if not kept:
            raise InputError("The drawing has no lines: draw at least one stroke with some length.")
        self.centre, self.size = surrounding_circle(np.concatenate(kept))
        self.smoothing = float(smoothing)
        self.lines, self.closed = [], []
        for z in kept:
            z = (z - self.centre) / self.size
            is_closed = len(z) > 3 and abs(z[0] - z[-1]) <= ZERO_LENGTH
            z = z[:-1] if is_closed else z
            self.lines.append(z)
            self.closed.append(bool(is_closed))

    def into_frame(self, points: ArrayLike) -> Complex:
        """Scene points as complex numbers in the drawing's frame.

        Parameters
        ----------
        points : array_like of shape (n, 2)

        Returns
        -------
        ndarray of shape (n,), complex

        Raises
        ------
        InputError
            For anything but pairs of finite numbers.
        """
        p = points_of(points, "the points").reshape(-1, 2)
        return (p[:, 0] + 1j * p[:, 1] - self.centre) / self.size

    def out_of_frame(self, z: Complex) -> np.ndarray:
        """Complex numbers in the drawing's frame as scene points: the inverse of `into_frame`.

        Parameters
        ----------
        z : ndarray of shape (n,), complex

        Returns
        -------
        ndarray of shape (n, 2)
        """
        w = np.asarray(z) * self.size + self.centre
        return np.stack([w.real, w.imag], 1)

    @cached_property
    def contours(self) -> Contours:
        """The lines evenly resampled and smoothed, in the drawing's frame; computed once."""
        return Contours.of(self.lines, self.closed, 1.0, self.smoothing / self.size)


def _line(points: ArrayLike, number: int) -> Complex:
    """A polyline as complex numbers without consecutive duplicates; empty where it has no length."""
    try:
        p = np.asarray(points, float)
    except (TypeError, ValueError, OverflowError):
        raise InputError(f"Line {number} of the drawing is no list of points: give pairs of numbers.") from None
    if p.ndim != 2 or p.shape[1] != 2:
        raise InputError(f"Line {number} of the drawing has the shape {p.shape}: give points as (n, 2).")
    if not np.isfinite(p).all():
        raise InputError(f"Line {number} of the drawing has a coordinate that is no number: remove that point.")
    if np.abs(p).max(initial=0.0) > LARGEST_COORDINATE:
        raise InputError(
            f"Line {number} of the drawing has a coordinate beyond {LARGEST_COORDINATE:g}: move it nearer."
        )
    z = p[:, 0] + 1j * p[:, 1]
    if len(z) < 2:
        return z[:0]
    extent = max(np.ptp(z.real), np.ptp(z.imag))
    keep = np.concatenate([[True], np.abs(np.diff(z)) > ZERO_LENGTH * extent])
    return z[keep] if extent > 0.0 else z[:0]
