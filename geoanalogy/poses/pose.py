"""Poses: a position with a direction, and whether the object is mirrored (sections 4.2 and 4.6)."""

import math
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

from ..arguments import is_flag, points_of, shown
from ..errors import InputError
from ..geometry.polygon import clean_ring


@dataclass(frozen=True)
class Pose:
    """Where an object stands and which way it faces.

    Attributes
    ----------
    position : tuple of float
        x and y in scene coordinates.
    angle : float
        Direction in radians, counter-clockwise from the x axis.
    mirrored : bool
        Whether the object is reflected about its direction before it is put there (the flag P_m of section 4.6).

    Raises
    ------
    InputError
        For anything but finite numbers.

    Examples
    --------
    >>> Pose((1, 2), 0.5).to_scene([(1.0, 0.0)]).round(3).tolist()
    [[1.878, 2.479]]
    """

    position: tuple[float, float]
    angle: float = 0.0
    mirrored: bool = False

    def __post_init__(self) -> None:
        try:
            x, y = (float(v) for v in self.position)
            angle = float(self.angle)
        except (TypeError, ValueError, OverflowError):
            raise InputError(
                "the pose's position is no pair of numbers, or its angle is none; give x, y and radians"
            ) from None
        if not is_flag(self.mirrored):
            raise InputError(f"the pose is mirrored or not, but not {shown(self.mirrored)}; give True or False")
        object.__setattr__(self, "mirrored", bool(self.mirrored))
        if not (math.isfinite(x) and math.isfinite(y) and math.isfinite(angle)):
            raise InputError("the pose has a position or angle that is not finite; give numbers")
        object.__setattr__(self, "position", (x, y))
        object.__setattr__(self, "angle", angle)

    def to_scene(self, points: ArrayLike) -> NDArray[np.float64]:
        """Points of the pose's own frame (x along its direction) in scene coordinates.

        Parameters
        ----------
        points : array_like of shape (n, 2)

        Returns
        -------
        ndarray of shape (n, 2)
        """
        p = points_of(points, "the points")
        if self.mirrored:
            p = p * (1.0, -1.0)
        c, s = np.cos(self.angle), np.sin(self.angle)
        return p @ np.array([[c, s], [-s, c]]) + self.position

    def to_frame(self, points: ArrayLike) -> NDArray[np.float64]:
        """Points of the scene in the pose's own frame: the inverse of `to_scene`.

        Parameters
        ----------
        points : array_like of shape (n, 2)

        Returns
        -------
        ndarray of shape (n, 2)
        """
        c, s = np.cos(self.angle), np.sin(self.angle)
        p = (points_of(points, "the points") - self.position) @ np.array([[c, -s], [s, c]])
        return p * (1.0, -1.0) if self.mirrored else p


def footprint_ring(footprint: ArrayLike | None) -> NDArray[np.float64] | None:
    """A footprint as a clean ring in the pose's frame; None stays None: the object is a point.

    Parameters
    ----------
    footprint : array_like of shape (n, 2) or None

    Returns
    -------
    ndarray of shape (m, 2) or None

    Raises
    ------
    InputError
        For anything that is no simple ring with an area.
    """
    return None if footprint is None else clean_ring(footprint, "the footprint")[0]


def outlines_at(
    ring: NDArray[np.float64],
    position: NDArray[np.float64],
    angle: NDArray[np.float64],
    mirrored: NDArray[np.bool_] | bool,
    scale: NDArray[np.float64] | float,
) -> NDArray[np.object_]:
    """A footprint at many poses.

    Parameters
    ----------
    ring : ndarray of shape (n, 2) or (m, n, 2)
        In the pose's frame; or one of each pose.
    position : ndarray of shape (m, 2)
    angle : ndarray of shape (m,)
    mirrored : bool or ndarray of shape (m,), bool
    scale : float or ndarray of shape (m,)
        Of the footprint.

    Returns
    -------
    ndarray of shape (m,)
        shapely polygons in scene coordinates.
    """
    scale = np.asarray(scale)[..., None]
    x, y = ring[..., 0] * scale, ring[..., 1] * scale * np.where(mirrored, -1.0, 1.0)[..., None]
    c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
    outlines = np.empty((len(position), ring.shape[-2], 2))
    outlines[..., 0] = position[:, :1] + c * x - s * y
    outlines[..., 1] = position[:, 1:] + s * x + c * y
    return shapely.polygons(outlines)  # type: ignore[no-any-return]
