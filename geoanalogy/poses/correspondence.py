"""Which place of one outline corresponds to which of another: the fixed starts of section 4.7."""

from collections.abc import Callable

import numpy as np
import shapely
from numpy.typing import NDArray

from ..geometry.features import features_by_ring
from ..geometry.polygon import Polygon
from .local_coordinates import BoundarySystem

Array = NDArray[np.float64]

#: Weight of where corners lie in the polygons' frames beside what they are like. Derived orientations are known up to a
#: quarter turn, so they only decide between shifts that are equally good.
DERIVED_FRAME = 0.1

#: The same where both polygons state their orientation: it decides.
STATED_FRAME = 10.0


def corresponding_arcs(
    source: BoundarySystem, target: BoundarySystem, corners: bool, upright: bool = False
) -> tuple[Array, Array]:
    """Arc lengths of the places that correspond: the fixed start, and all corners where there are equally many.

    Parameters
    ----------
    source, target : BoundarySystem
    corners : bool
        Whether all corners are wanted; else the start alone.
    upright : bool
        Whether the polygons are parts of walls: the lower left corresponds to the lower left, whatever they are like.

    Returns
    -------
    source, target : ndarray of shape (k,), k >= 1
        Pairs of arc lengths, in the order in which the boundaries run.
    """
    count = len(source.corner_arcs)
    if count and count == len(target.corner_arcs):
        shift = _best_shift(source, target, upright)
        order = (np.arange(count) + shift) % count
        kept = slice(None) if corners else slice(1)
        return source.corner_arcs[kept], target.corner_arcs[order][kept]
    if count and len(target.corner_arcs):
        pair = corner_costs(source, target, upright)
        i, j = np.unravel_index(np.argmin(pair.round(9)), pair.shape)
        return source.corner_arcs[[i]], target.corner_arcs[[j]]
    return np.array([_axis_arc(source, upright)]), np.array([_axis_arc(target, upright)])


def corner_costs(source: BoundarySystem, target: BoundarySystem, upright: bool = False) -> Array:
    """How badly corners match: their openings (I_m of section 4.4) and their places in the polygons' frames.

    Parameters
    ----------
    source, target : BoundarySystem
    upright : bool
        Whether their frames are those of the walls that they are parts of.

    Returns
    -------
    ndarray of shape (source corners, target corners)
    """
    a, b = _openings(source.polygon), _openings(target.polygon)
    p, q = _places(source, upright), _places(target, upright)
    apart = np.hypot(*(p[:, None] - q).transpose(2, 0, 1))
    weight = STATED_FRAME if upright else _frame_weight(source.polygon, target.polygon)
    return np.abs(a[:, None] - b) / np.pi + weight * apart


def _best_shift(source: BoundarySystem, target: BoundarySystem, upright: bool) -> int:
    """The number of corners by which the target's are counted on, for the best match all round."""
    pairs = corner_costs(source, target, upright)
    count = len(pairs)
    shares = [np.diff(s.corner_arcs, append=s.corner_arcs[0] + s.perimeter) / s.perimeter for s in (source, target)]
    pairs = pairs + np.abs(shares[0][:, None] - shares[1])
    at = np.arange(count)
    costs = np.array([pairs[at, (at + shift) % count].mean() for shift in range(count)])
    # Shifts that differ by rounding alone are equal; of equal ones the first counts.
    return int(np.argmin(costs.round(9)))


def _openings(polygon: Polygon) -> Array:
    return np.array([c.opening for c in features_by_ring(polygon)[0][1]])


def _frame_weight(source: Polygon, target: Polygon) -> float:
    stated = source.orientation is not None and target.orientation is not None
    return STATED_FRAME if stated else DERIVED_FRAME


def _places(system: BoundarySystem, upright: bool) -> Array:
    """The corners in the box of the polygon's frame, each coordinate from 0 to 1."""
    to_frame = _frame(_direction(system, upright))
    box = to_frame(system.ring)
    low, high = box.min(axis=0), box.max(axis=0)
    return (to_frame(system.places(system.corner_arcs)) - low) / (high - low)  # type: ignore[no-any-return]


def _direction(system: BoundarySystem, upright: bool) -> float:
    """The x axis of the polygon's frame; of a part of a wall, that of the wall, which is level."""
    return 0.0 if upright else system.polygon.main_orientation


def _frame(direction: float) -> Callable[[Array], Array]:
    c, s = np.cos(direction), np.sin(direction)
    return lambda points: points @ np.array([[c, -s], [s, c]])


def _axis_arc(system: BoundarySystem, upright: bool) -> float:
    """Arc length of the place farthest along the frame's x axis, seen from the centroid."""
    towards = _direction(system, upright)
    centre = system.polygon.centroid
    far = 2 * np.hypot(*np.ptp(system.ring, axis=0))
    ray = shapely.LineString([centre, centre + far * np.array([np.cos(towards), np.sin(towards)])])
    line = shapely.LinearRing(system.ring)
    met = shapely.get_coordinates(ray.intersection(line))
    place = met[np.argmax(np.hypot(*(met - centre).T))]
    return float(shapely.line_locate_point(line, shapely.Point(place)))
