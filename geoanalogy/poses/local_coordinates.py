"""Local coordinate systems of a polygon (section 4.7): coordinates of points, and points of coordinates.

Two systems. The one of the boundary takes the boundary distance R_bd and the arc length R_bf from a fixed start; the
one of a corner takes the corner distance R_cd and the corner ratio R_cr, the only pair of the relations of section 4.3
that is invertible everywhere.

R_bd and R_bf are invertible inside a convex polygon, but for its medial axis, where the boundary is equally near on two
sides and the coordinates jump (the discontinuities that section 4.7 concedes). Round a vertex all points on the outer
side of its turn have its arc length: there the share of the fan between its two normals is kept as a third coordinate,
which makes the system of every polygon invertible in itself. A fan is squeezed onto a line where the other polygon has
no such vertex.

Only the outline counts; holes have no part in the coordinates.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

from ..errors import InputError
from ..geometry.polygon import Polygon
from ..relations.elements import Elements
from ..relations.observation import Observation
from ..relations.table import RELATIONS
from ..tolerances import ZERO_LENGTH

Array = NDArray[np.float64]

#: Halvings by which the medial axis is looked for: to a billionth of the largest inscribed circle's radius.
HALVINGS = 32

#: Share of its distance by which a point may be nearer to the boundary than its coordinate says: rounding.
REACHED = 1e-6


@dataclass(frozen=True)
class Located:
    """Points in the coordinates of a boundary.

    Attributes
    ----------
    arc : ndarray of shape (n,)
        R_bf as a length: from the outline's first vertex to the nearest place, scene units.
    distance : ndarray of shape (n,)
        R_bd, scene units; negative outside.
    share : ndarray of shape (n,)
        Round a vertex, the share of the fan from the normal of the edge before it to that of the edge after it; one
        half elsewhere.
    """

    arc: Array
    distance: Array
    share: Array


class BoundarySystem:
    """The coordinates R_bd and R_bf of a polygon's outline.

    Parameters
    ----------
    polygon : Polygon
    """

    def __init__(self, polygon: Polygon) -> None:
        self.polygon = polygon
        self.ring = polygon.clear_rings[0].points
        self._outline = Polygon(polygon.points, label=polygon.label, orientation=polygon.orientation)
        steps = np.roll(self.ring, -1, axis=0) - self.ring
        lengths = np.hypot(*steps.T)
        self._length = lengths
        self._unit = steps / lengths[:, None]
        self._smooth = ~polygon.clear_rings[0].sharp
        self._direction = np.arctan2(steps[:, 1], steps[:, 0])
        #: Turn of the boundary at each vertex, radians, positive to the left.
        self.turn = (self._direction - np.roll(self._direction, 1) + np.pi) % (2 * np.pi) - np.pi
        #: Arc length of each vertex.
        self.vertex_arc = np.concatenate([[0.0], np.cumsum(lengths)[:-1]])
        self.perimeter = float(lengths.sum())

    @cached_property
    def inscribed_radius(self) -> float:
        """Radius of the largest circle inside the outline, to a hundred-thousandth of its size."""
        shape = self._outline.shape
        return float(shapely.length(shapely.maximum_inscribed_circle(shape, tolerance=1e-5 * self._outline.size)))

    @cached_property
    def corner_arcs(self) -> Array:
        """Arc lengths of the corners, ascending."""
        return self.vertex_arc[~self._smooth]

    @cached_property
    def _line(self) -> shapely.LinearRing:
        line = shapely.LinearRing(self.ring)
        shapely.prepare(line)
        return line

    def boundary_distance(self, points: Array) -> Array:
        """R_bd without its sign.

        Parameters
        ----------
        points : ndarray of shape (n, 2)

        Returns
        -------
        ndarray of shape (n,)
        """
        return shapely.distance(self._line, shapely.points(points))  # type: ignore[no-any-return]

    def locate(self, points: ArrayLike) -> Located:
        """The coordinates of points.

        Parameters
        ----------
        points : array_like of shape (n, 2)
            Scene coordinates.

        Returns
        -------
        Located
        """
        seen = Observation(Elements.of([self._outline]), np.asarray(points, dtype=np.float64).reshape(-1, 2))
        nearest = seen.boundary
        arc = nearest.arc[0] % self.perimeter
        vertex, at_vertex = self._vertex_at(arc)
        inside = seen.inside[0]
        distance = np.where(inside, nearest.distance[0], -nearest.distance[0])
        share = np.full(len(arc), 0.5)
        fan = at_vertex & self._is_fan(vertex, inside) & (nearest.distance[0] > 0)
        from_first = nearest.tangent[0, fan] - self._direction[vertex[fan] - 1]
        share[fan] = ((from_first + np.pi) % (2 * np.pi) - np.pi) / self.turn[vertex[fan]]
        return Located(np.where(at_vertex, self.vertex_arc[vertex], arc), distance, share)

    def _vertex_at(self, arc: Array) -> tuple[NDArray[np.intp], NDArray[np.bool_]]:
        """The vertex nearest to each arc length, and whether it is there."""
        extended = np.append(self.vertex_arc, self.perimeter)
        after = np.clip(np.searchsorted(extended, arc), 1, len(extended) - 1)
        nearest = np.where(arc - extended[after - 1] <= extended[after] - arc, after - 1, after)
        at = np.abs(arc - extended[nearest]) <= ZERO_LENGTH * self.perimeter
        return nearest % len(self.vertex_arc), at

    def _is_fan(self, vertex: NDArray[np.intp], inside: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """Whether a side of a vertex is the outer side of its turn, where points are nearest to the vertex itself."""
        return np.where(inside, self.turn[vertex] < 0, self.turn[vertex] > 0)

    def tangent(self, arc: Array, share: Array) -> Array:
        """Direction of the boundary, radians; at a vertex between those of its edges.

        Parameters
        ----------
        arc : ndarray of shape (n,)
        share : ndarray of shape (n,)
            Of the turn, at a vertex.

        Returns
        -------
        ndarray of shape (n,)
        """
        arc = arc % self.perimeter
        vertex, at_vertex = self._vertex_at(arc)
        edge = np.searchsorted(self.vertex_arc, arc, side="right") - 1
        between = self._direction[vertex - 1] + share * self.turn[vertex]
        return np.where(at_vertex, between, self._direction[edge])

    def places(self, arc: Array) -> Array:
        """Points of the boundary.

        Parameters
        ----------
        arc : ndarray of shape (n,)

        Returns
        -------
        ndarray of shape (n, 2)
        """
        arc = arc % self.perimeter
        edge = np.searchsorted(self.vertex_arc, arc, side="right") - 1
        return self.ring[edge] + (arc - self.vertex_arc[edge])[:, None] * self._unit[edge]

    def points(self, located: Located) -> Array:
        """The points of coordinates: at arc length R_bf, R_bd along the inner normal.

        Parameters
        ----------
        located : Located

        Returns
        -------
        ndarray of shape (n, 2)
            Beyond the medial axis there is no point of these coordinates; what is returned is then nearer to another
            part of the boundary (see `depth` and `reached`).
        """
        normal = self.tangent(located.arc, located.share) + np.pi / 2
        way = np.stack([np.cos(normal), np.sin(normal)], axis=1)
        return self.places(located.arc) + located.distance[:, None] * way

    def reached(self, located: Located) -> NDArray[np.bool_]:
        """Whether there is a point of these coordinates: on this side of the medial axis.

        Parameters
        ----------
        located : Located

        Returns
        -------
        ndarray of shape (n,), bool
        """
        away = np.abs(located.distance)
        nearer = np.maximum(REACHED, self._facet(located))
        return self.boundary_distance(self.points(located)) >= away * (1 - nearer) - ZERO_LENGTH * self.perimeter

    def _facet(self, located: Located) -> Array:
        """Share of its distance by which a point is nearer to the boundary because a curve was drawn as a polygon.

        Every vertex on the inner side of its turn has a branch of the medial axis. A smooth one stands for a curve
        that has none there: normals that cross at such a vertex are not held to have crossed.
        """
        arc = located.arc % self.perimeter
        edge = np.searchsorted(self.vertex_arc, arc, side="right") - 1
        share = np.zeros(len(arc))
        for vertex, gap in (
            (edge, arc - self.vertex_arc[edge]),
            ((edge + 1) % len(self.turn), self.vertex_arc[edge] + self._length[edge] - arc),
        ):
            turn = np.abs(self.turn[vertex])
            crossed = self._smooth[vertex] & (gap <= np.abs(located.distance) * np.tan(turn / 2))
            share = np.maximum(share, np.where(crossed, 1 - np.cos(turn), 0.0))
        return share

    def depth(self, arc: Array, share: Array) -> Array:
        """Distance from the boundary to the medial axis, along the inner normal.

        Parameters
        ----------
        arc, share : ndarray of shape (n,)

        Returns
        -------
        ndarray of shape (n,)
            0 at a vertex that turns to the left.
        """
        low = np.zeros(len(arc))
        high = np.full(len(arc), 1.001 * self.inscribed_radius)
        for _ in range(HALVINGS):
            middle = (low + high) / 2
            free = self.reached(Located(arc, middle, share))
            low, high = np.where(free, middle, low), np.where(free, high, middle)
        return low


class CornerSystem:
    """The coordinates R_cd and R_cr of a polygon's corner, invertible in the whole plane.

    Parameters
    ----------
    polygon : Polygon
    corner : int
        Number of the corner along the outline.

    Raises
    ------
    InputError
        Where the outline has no such corner.
    """

    def __init__(self, polygon: Polygon, corner: int) -> None:
        self.polygon = polygon
        self._elements = Elements.of([Polygon(polygon.points)])
        count = len(self._elements.corner_vertex)
        if not 0 <= corner < count:
            raise InputError(f"polygon {polygon.id!r} has no corner {corner}; it has {count}, counted from 0")
        self.corner = corner
        self.vertex = self._elements.corner_vertex[corner]
        self.opening = float(self._elements.corner_opening[corner])
        self._before = float(self._elements.corner_before[corner])

    def locate(self, points: ArrayLike) -> tuple[Array, Array]:
        """The coordinates of points.

        Parameters
        ----------
        points : array_like of shape (n, 2)
            Scene coordinates.

        Returns
        -------
        distance : ndarray of shape (n,)
            R_cd, scene units.
        ratio : ndarray of shape (n,)
            R_cr: 0 to 1 in the corner's interior angle, 1 to 2 outside it.
        """
        seen = Observation(self._elements, np.asarray(points, dtype=np.float64).reshape(-1, 2))
        distance, ratio = (RELATIONS[name].value(seen)[self.corner] for name in ("corner distance", "corner ratio"))
        return distance, ratio

    def directions(self, ratio: Array) -> Array:
        """Direction from the corner of points of a ratio, radians.

        Parameters
        ----------
        ratio : ndarray of shape (n,)

        Returns
        -------
        ndarray of shape (n,)
        """
        outside = self.opening + (ratio - 1) * (2 * np.pi - self.opening)
        return self._before - np.where(ratio <= 1, ratio * self.opening, outside)

    def points(self, distance: Array, ratio: Array) -> Array:
        """The points of coordinates.

        Parameters
        ----------
        distance, ratio : ndarray of shape (n,)

        Returns
        -------
        ndarray of shape (n, 2)
        """
        towards = self.directions(ratio)
        return self.vertex + distance[:, None] * np.stack([np.cos(towards), np.sin(towards)], axis=1)
