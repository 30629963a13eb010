"""Frames of planes in space: where a flat arrangement lies (section 5.6, surfaces)."""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
Triple = tuple[float, float, float]


@dataclass(frozen=True)
class Frame:
    """A plane with an origin and two axes; a frame of space, since the normal is the third.

    Attributes
    ----------
    origin : (float, float, float)
        Scene units.
    x, y : (float, float, float)
        Unit vectors at right angles. The plane is seen from the side that x cross y points to.
    """

    origin: Triple = (0.0, 0.0, 0.0)
    x: Triple = (1.0, 0.0, 0.0)
    y: Triple = (0.0, 1.0, 0.0)

    @classmethod
    def of(cls, origin: ArrayLike, x: ArrayLike, y: ArrayLike) -> "Frame":
        """A frame from arrays.

        Parameters
        ----------
        origin, x, y : array_like of shape (3,)

        Returns
        -------
        Frame
        """
        return cls(_triple(origin), _triple(x), _triple(y))

    @cached_property
    def axes(self) -> Array:
        """x, y and the normal as rows, shape (3, 3)."""
        return np.array([self.x, self.y, self._across])

    @cached_property
    def _across(self) -> Triple:
        """The normal as plain numbers: single vectors are turned faster without arrays."""
        return _cross(self.x, self.y)

    @property
    def normal(self) -> Array:
        """Unit vector out of the plane, shape (3,)."""
        return self.axes[2]

    @cached_property
    def matrix(self) -> Array:
        """The matrix that takes the frame's coordinates to space, shape (4, 4)."""
        matrix = np.eye(4)
        matrix[:3, :3] = self.axes.T
        matrix[:3, 3] = self.origin
        return matrix

    def to_space(self, points: ArrayLike) -> Array:
        """Points of the frame in the coordinates that it is given in.

        Parameters
        ----------
        points : array_like of shape (n, 2) or (n, 3)
            The third coordinate is the height above the plane; 0 where there is none.

        Returns
        -------
        ndarray of shape (n, 3)
        """
        given = np.asarray(points, float)
        return given @ self.axes[: given.shape[1]] + self.origin

    def to_plane(self, points: ArrayLike) -> Array:
        """Points of space in the frame's coordinates: the inverse of `to_space`.

        Parameters
        ----------
        points : array_like of shape (n, 3)

        Returns
        -------
        ndarray of shape (n, 3)
            The third coordinate is the height above the plane.
        """
        return (np.asarray(points, float) - self.origin) @ self.axes.T

    def inside(self, outer: "Frame") -> "Frame":
        """A frame that is given in the coordinates of another one, in those that the other is given in.

        Parameters
        ----------
        outer : Frame

        Returns
        -------
        Frame
        """
        across = outer._across
        x, y, z = _turned(self.origin, outer.x, outer.y, across)
        u, v, w = outer.origin
        return Frame(
            (x + u, y + v, z + w), _turned(self.x, outer.x, outer.y, across), _turned(self.y, outer.x, outer.y, across)
        )

    def seen_from(self, outer: "Frame") -> "Frame":
        """The frame in the coordinates of another one: the inverse of `inside`.

        Parameters
        ----------
        outer : Frame

        Returns
        -------
        Frame
        """
        (x, y, z), (u, v, w), across = self.origin, outer.origin, outer._across
        rows = tuple(zip(outer.x, outer.y, across, strict=True))
        return Frame(_turned((x - u, y - v, z - w), *rows), _turned(self.x, *rows), _turned(self.y, *rows))

    def moved(self, x: float, y: float, angle: float = 0.0) -> "Frame":
        """The frame with its origin elsewhere in its plane, turned.

        Parameters
        ----------
        x, y : float
            The origin's coordinates in this frame.
        angle : float
            Radians, counter-clockwise from this frame's x axis.

        Returns
        -------
        Frame
        """
        if x == 0.0 and y == 0.0 and angle == 0.0:
            return self
        c, s = np.cos(angle), np.sin(angle)
        return Frame((float(x), float(y), 0.0), (float(c), float(s), 0.0), (float(-s), float(c), 0.0)).inside(self)

    def upright(self, up: ArrayLike) -> "Frame":
        """The frame turned about its normal so that y points as far up as it can; itself where the plane is level.

        Parameters
        ----------
        up : array_like of shape (3,)
            Unit vector.

        Returns
        -------
        Frame
        """
        (a, b, c), (u, v, w) = self._across, _triple(up)
        along = a * u + b * v + c * w
        x, y, z = u - along * a, v - along * b, w - along * c
        length = math.sqrt(x * x + y * y + z * z)
        if length < 1e-6:
            return self
        upwards = (x / length, y / length, z / length)
        return Frame(self.origin, _cross(upwards, self._across), upwards)

    @property
    def flipped(self) -> "Frame":
        """The plane seen from behind: x the other way."""
        x, y, z = self.x
        return Frame(self.origin, (-x, -y, -z), self.y)


def _turned(v: Triple, x: Triple, y: Triple, z: Triple) -> Triple:
    """The vector with given coordinates along three axes."""
    a, b, c = v
    return a * x[0] + b * y[0] + c * z[0], a * x[1] + b * y[1] + c * z[1], a * x[2] + b * y[2] + c * z[2]


def _cross(a: Triple, b: Triple) -> Triple:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def _triple(values: ArrayLike) -> Triple:
    x, y, z = values.tolist() if isinstance(values, np.ndarray) else map(float, values)  # type: ignore[arg-type, union-attr]
    return x, y, z


#: The frame of the ground, and of space.
SPACE = Frame()
