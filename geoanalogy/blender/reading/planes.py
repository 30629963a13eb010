"""Planes in space and the frame on each of them: where flat polygons become two-dimensional, and results go back.

Coplanar things share a frame. On a level plane its axes are the world's x and y, and its origin lies above or below the
world's, so that plane coordinates are world coordinates; on any other plane x runs level and y upwards.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...errors import InputError
from ...geometry.frame import SPACE, Frame

Array = NDArray[np.float64]

#: Sine of the angle between two planes, or between a plane and the level, below which they are parallel: half a degree,
#: more than single precision and a hasty hand leave.
PARALLEL = 0.009

#: Upward part of a unit normal from which a face counts as level rather than as a wall: 45 degrees.
STEEP = 0.7071

#: Distance from its plane, in sizes of a shape, below which the shape is flat.
FLAT = 0.005

#: Distance between two parallel planes, in sizes of what lies on them, below which they are one: a carpet on a floor.
SAME_PLANE = 0.02

#: The same where one does not lie over the other: facades in a row may stand a hand's breadth back.
SAME_PLANE_ASIDE = 0.002


@dataclass(frozen=True)
class Plane:
    """A plane of the world, by the frame that lies on it.

    Attributes
    ----------
    frame : Frame
        Its origin and axes in the world.
    """

    frame: Frame = SPACE

    @classmethod
    def of_matrix(cls, matrix: ArrayLike) -> "Plane":
        """The plane of a matrix.

        Parameters
        ----------
        matrix : array_like of shape (4, 4)
            From plane coordinates (x, y, height, 1) to the world's; its columns are the axes, orthonormal, and the
            origin.

        Returns
        -------
        Plane
        """
        given = np.asarray(matrix, float)
        return cls(Frame.of(given[:3, 3], given[:3, 0], given[:3, 1]))

    @classmethod
    def through(cls, point: ArrayLike, normal: ArrayLike) -> "Plane":
        """The plane through a point, in its canonical frame.

        Parameters
        ----------
        point, normal : array_like of shape (3,)
            World coordinates; the normal's length does not matter, of level planes nor its sign: they are seen from
            above.

        Returns
        -------
        Plane
        """
        n = np.asarray(normal, float) / np.linalg.norm(normal)
        if np.hypot(n[0], n[1]) < PARALLEL:
            return cls(Frame((0.0, 0.0, float(np.asarray(point, float)[2]))))
        x = np.array([-n[1], n[0], 0.0]) / np.hypot(n[0], n[1])
        return cls(Frame.of(n * np.dot(n, np.asarray(point, float)), x, np.cross(n, x)))

    @property
    def matrix(self) -> Array:
        """From plane coordinates (x, y, height, 1) to the world's, shape (4, 4)."""
        return self.frame.matrix

    @property
    def origin(self) -> Array:
        """Of the frame, in the world, shape (3,)."""
        return np.array(self.frame.origin)

    @property
    def normal(self) -> Array:
        """Unit normal in the world, shape (3,)."""
        return self.frame.normal

    @property
    def is_wall(self) -> bool:
        """Whether it is steep, so that its y axis points up and things on it hang."""
        return bool(abs(self.normal[2]) <= STEEP)

    def under(self, surface: Frame) -> "Plane":
        """The plane of a surface whose frame is given in this plane's coordinates.

        Parameters
        ----------
        surface : Frame

        Returns
        -------
        Plane
        """
        return self if surface is SPACE else Plane(surface.inside(self.frame))

    def to_plane(self, points: ArrayLike) -> Array:
        """World points in plane coordinates: x, y and height above the plane.

        Parameters
        ----------
        points : array_like of shape (n, 3)

        Returns
        -------
        ndarray of shape (n, 3)
        """
        return self.frame.to_plane(points)

    def to_world(self, points: ArrayLike) -> Array:
        """The inverse of `to_plane`.

        Parameters
        ----------
        points : array_like of shape (n, 3)

        Returns
        -------
        ndarray of shape (n, 3)
        """
        return self.frame.to_space(points)

    def is_coplanar(self, other: "Plane", size: float, share: float = SAME_PLANE) -> bool:
        """Whether another plane is this one, seen from either side, for things of a size.

        Parameters
        ----------
        other : Plane
        size : float
            Scene units.
        share : float
            Of the size, how far apart they may be.

        Returns
        -------
        bool
        """
        parallel = np.linalg.norm(np.cross(self.normal, other.normal)) < PARALLEL
        return bool(parallel and self.gap_to(other) <= share * size)

    def gap_to(self, other: "Plane") -> float:
        """Distance from this plane to the origin of another.

        Parameters
        ----------
        other : Plane

        Returns
        -------
        float
        """
        return float(abs(np.dot(self.normal, other.origin - self.origin)))


def extent(points: Array) -> float:
    """Diagonal of the box around points.

    Parameters
    ----------
    points : ndarray of shape (n, d)

    Returns
    -------
    float
        0 without points.
    """
    return float(np.linalg.norm(np.ptp(points, axis=0))) if len(points) else 0.0


def best_plane(rings: Sequence[Array], name: str) -> Plane | None:
    """The plane that rings in space lie on.

    Parameters
    ----------
    rings : sequence of ndarray of shape (n, 3)
        World coordinates.
    name : str
        What they are called in messages.

    Returns
    -------
    Plane or None
        None where they lie on no common plane.

    Raises
    ------
    InputError
        Where they have no area, or coordinates that are not finite.
    """
    points = np.vstack(rings)
    if not np.isfinite(points).all():
        raise InputError(f"{name} has a coordinate that is not finite (NaN or infinity); correct or delete that vertex")
    middle = points.mean(axis=0)
    size = extent(points)
    _, lengths, axes = np.linalg.svd(points - middle, full_matrices=False)
    if len(lengths) < 3 or lengths[1] <= 1e-6 * max(lengths[0], np.finfo(float).tiny):
        raise InputError(f"{name} has no area; give a ring that encloses one")
    normal = axes[2]
    if np.abs((points - middle) @ normal).max() > FLAT * size:
        return None
    # Of the two sides, the one from which the first ring runs counter-clockwise.
    first = rings[0] - middle
    area = np.cross(first, np.roll(first, -1, axis=0)).sum(axis=0)
    return Plane.through(middle, normal if np.dot(area, normal) >= 0 else -normal)
