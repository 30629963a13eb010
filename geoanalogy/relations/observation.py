"""What points see of elements: nearest places, distances and directions, evaluated once and shared by all relations."""

from collections.abc import Callable
from functools import cached_property
from typing import Any, Protocol

import numpy as np
import shapely
from numpy.typing import NDArray

from ..tolerances import ZERO_LENGTH
from .elements import Elements

Array = NDArray[np.float64]
Directions = NDArray[np.complex128]


def length(x: Array, y: Array) -> Array:
    """Length of ways in the plane.

    Coordinates are bounded, so that their squares are: without the guard against overflow that ``hypot`` has, it takes
    a tenth of the time.

    Parameters
    ----------
    x, y : ndarray of one shape

    Returns
    -------
    ndarray of the same shape
    """
    squared = x * x
    squared += y * y
    return np.sqrt(squared, out=squared)


class Nearest(Protocol):
    """The boundary place nearest to each point, per segment or polygon; all shapes are (elements, points)."""

    @property
    def distance(self) -> Array:
        """In scene units, not negative."""

    @property
    def arc(self) -> Array:
        """Arc length from the start of the segment (or of the ring) to the place."""

    @property
    def tangent(self) -> Array:
        """Direction of the boundary there, radians.

        At a vertex, where the boundary has two, it is the one at right angles to the way to the point: it turns
        steadily from the first to the second as the point goes round the vertex.
        """

    @property
    def between(self) -> NDArray[np.bool_]:
        """Whether the place lies inside an edge, where moving the point along the boundary moves the place as far.

        At a vertex it stays.
        """

    @property
    def edge(self) -> NDArray[np.intp]:
        """Index of the edge that the place is on."""

    @property
    def left(self) -> NDArray[np.bool_]:
        """Whether the point lies to the left of the boundary there: on the interior's side."""

    @property
    def across(self) -> Array:
        """Signed distance of the point from the straight line through that edge, positive to the left."""


class NearestOfAll:
    """The boundary places of every element nearest to every point.

    As `Nearest` says; what is derived from the places is evaluated at the first use: fields of distances need no
    directions.

    Parameters
    ----------
    elements : Elements
    points : ndarray of shape (n, 2)
    edge : ndarray of shape (elements, n), int
    along : ndarray of shape (elements, n)
        Length from the start of the edge to the place.
    distance : ndarray of shape (elements, n)
    offset : ndarray of shape (edges,)
        Arc length from the start of the segment (or of the ring) to each edge.
    ends : ndarray of shape (edges, 2), bool
        At which of its vertices an edge has no neighbour in its segment.
    """

    def __init__(
        self,
        elements: Elements,
        points: Array,
        edge: NDArray[np.intp],
        along: Array,
        distance: Array,
        offset: Array,
        ends: NDArray[np.bool_],
    ) -> None:
        self.edge = edge
        self.distance = distance
        self._elements = elements
        self._points = points
        self._along = along
        self._offset = offset
        self._ends = ends

    def _of_edges(self, values: NDArray[Any]) -> NDArray[Any]:
        """A value of each place's edge."""
        # Straight segments are an edge each.
        return values[self.edge[:, :1]] if self.edge.strides[1] == 0 else values[self.edge]

    @cached_property
    def arc(self) -> Array:
        """As `Nearest` says."""
        return self._along + self._of_edges(self._offset)

    @cached_property
    def between(self) -> NDArray[np.bool_]:
        """As `Nearest` says."""
        return (self._along > 0) & (self._along < self._of_edges(self._elements.edge_length))

    @cached_property
    def _round_vertices(self) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.intp], NDArray[np.intp]]:
        """Element and point of the places at vertices that two edges share; the edge, and which of its ends it is."""
        end = (self._along > 0).astype(np.intp)
        row, point = np.nonzero(~self.between & (self.distance > 0) & ~self._ends[self.edge, end])
        return row, point, self.edge[row, point], end[row, point]

    @cached_property
    def tangent(self) -> Array:
        """As `Nearest` says."""
        e = self._elements
        tangent = e.edge_heading[self.edge]
        row, point, edge, end = self._round_vertices
        way = self._points[point] - e.edge_start[edge] - end[:, None] * e.edge_vector[edge]
        # Points nearest to a vertex lie on the outer side of its turn.
        side = np.where(e.edge_turns[edge, end] > 0, np.pi / 2, -np.pi / 2)
        tangent[row, point] = np.arctan2(way[:, 1], way[:, 0]) + side
        return tangent

    @cached_property
    def across(self) -> Array:
        """As `Nearest` says."""
        e = self._elements
        across = self._of_edges(e.edge_direction.real) * (self._points[:, 1] - self._of_edges(e.edge_start[:, 1]))
        across -= self._of_edges(e.edge_direction.imag) * (self._points[:, 0] - self._of_edges(e.edge_start[:, 0]))
        return across

    @cached_property
    def left(self) -> NDArray[np.bool_]:
        """As `Nearest` says."""
        left = self.across >= -ZERO_LENGTH * self._of_edges(self._elements.edge_length)
        # Round a vertex the two edges may disagree; there the points lie on the outer side of its turn.
        row, point, edge, end = self._round_vertices
        left[row, point] = self._elements.edge_turns[edge, end] <= 0
        return left


class Observation:
    """The elements of an arrangement as seen from points.

    Parameters
    ----------
    elements : Elements
    points : ndarray of shape (n, 2)
        Scene coordinates.
    """

    def __init__(self, elements: Elements, points: Array) -> None:
        self.elements = elements
        self.points = points

    @cached_property
    def _edges(self) -> tuple[Array, Array]:
        """Position along each edge (0 to its length) nearest to each point, and the distance; both (edges, points)."""
        e = self.elements
        direction = e.edge_vector / e.edge_length[:, None]
        x = self.points[:, 0] - e.edge_start[:, :1]
        y = self.points[:, 1] - e.edge_start[:, 1:]
        along = x * direction[:, :1]
        along += y * direction[:, 1:]
        np.maximum(along, 0.0, out=along)
        np.minimum(along, e.edge_length[:, None], out=along)
        x -= along * direction[:, :1]
        y -= along * direction[:, 1:]
        return along, length(x, y)

    def _nearest(self, group: NDArray[np.intp], count: int, offset: Array, ends: NDArray[np.bool_]) -> Nearest:
        along, distance = self._edges
        n = len(self.points)
        if len(group) == count:  # one edge each: straight segments
            edge = np.broadcast_to(np.arange(count)[:, None], (count, n))
        else:
            first = np.searchsorted(group, np.arange(count))
            edge = np.empty((count, n), dtype=np.intp)
            last = np.append(first[1:], len(group))
            for k in range(count):
                edge[k] = first[k] + np.argmin(distance[first[k] : last[k]], axis=0)
            place = edge * n + np.arange(n)
            along, distance = along.ravel().take(place), distance.ravel().take(place)
        return NearestOfAll(self.elements, self.points, edge, along, distance, offset, ends)

    @cached_property
    def segment(self) -> Nearest:
        """Nearest place on each segment; arcs from the segment's start."""
        e = self.elements
        last = np.append(np.diff(e.edge_segment) != 0, True)
        ends = np.stack([np.roll(last, 1), last], axis=1) & ~e.segment_closed[e.edge_segment, None]
        return self._nearest(e.edge_segment, len(e.segment_length), e.edge_offset, ends)

    @cached_property
    def boundary(self) -> Nearest:
        """Nearest place on each polygon's boundary; arcs from its ring's first vertex."""
        e = self.elements
        ends = np.zeros((len(e.edge_polygon), 2), dtype=bool)
        return self._nearest(e.edge_polygon, len(e.polygons), e.edge_ring_offset, ends)

    def away(self, nearest: Nearest) -> Directions:
        """Direction from nearest places to the points: where the distance grows.

        Parameters
        ----------
        nearest : Nearest
            `segment` or `boundary`.

        Returns
        -------
        ndarray of shape (elements, points), complex
            Of length 1. Where a point lies on the boundary, to the interior's side.
        """
        e = self.elements
        along = self._edges[0][nearest.edge, np.arange(len(self.points))]
        share = along / e.edge_length[nearest.edge]
        x = self.points[:, 0] - e.edge_start[nearest.edge, 0] - share * e.edge_vector[nearest.edge, 0]
        y = self.points[:, 1] - e.edge_start[nearest.edge, 1] - share * e.edge_vector[nearest.edge, 1]
        touching = nearest.distance <= ZERO_LENGTH * e.edge_length[nearest.edge]
        return np.where(
            touching, 1j * e.edge_direction[nearest.edge], (x + 1j * y) / np.where(touching, 1.0, length(x, y))
        )

    def along(self, nearest: Nearest) -> Directions:
        """Direction of the boundary at nearest places.

        Parameters
        ----------
        nearest : Nearest
            `segment` or `boundary`.

        Returns
        -------
        ndarray of shape (elements, points), complex
            Of length 1.
        """
        return np.exp(1j * nearest.tangent)

    @cached_property
    def inside(self) -> NDArray[np.bool_]:
        """Whether each polygon contains each point, boundary included; shape (polygons, points)."""
        x, y = self.points.T
        return np.array([shapely.intersects_xy(p.shape, x, y) for p in self.elements.polygons]).reshape(
            -1, len(self.points)
        )

    @cached_property
    def corner(self) -> tuple[Array, Array]:
        """Distance and direction (radians) from each corner to each point; both (corners, points)."""
        v = self.elements.corner_vertex
        x = self.points[:, 0] - v[:, :1]
        y = self.points[:, 1] - v[:, 1:]
        return length(x, y), np.arctan2(y, x)

    @cached_property
    def corner_turn(self) -> Array:
        """Angle from each corner's first edge to the way to each point, 0 to a full turn; shape (corners, points)."""
        turn = self.elements.corner_before[:, None] - self.corner[1]
        # Several times as fast as the remainder.
        turn -= 2 * np.pi * np.floor(turn / (2 * np.pi))
        return turn

    @cached_property
    def corner_side(self) -> tuple[NDArray[np.bool_], Array]:
        """Whether points lie between the edges of corners, and the angle they lie in; both (corners, points)."""
        opening = self.elements.corner_opening[:, None]
        inside = self.corner_turn <= opening
        return inside, np.where(inside, opening, 2 * np.pi - opening)

    @cached_property
    def from_corner(self) -> Directions:
        """Direction from each corner to each point, of length 1 or, at the corner, 0; shape (corners, points)."""
        v = self.elements.corner_vertex
        way = (self.points[:, 0] - v[:, :1]) + 1j * (self.points[:, 1] - v[:, 1:])
        return np.divide(way, self.corner[0], out=np.zeros_like(way), where=self.corner[0] > 0)

    @cached_property
    def centroid(self) -> tuple[Array, Array]:
        """Distance and direction (radians) from each point to each polygon's centroid; both (polygons, points)."""
        c = self.elements.polygon_centroid
        x = c[:, :1] - self.points[:, 0]
        y = c[:, 1:] - self.points[:, 1]
        return length(x, y), np.arctan2(y, x)

    @cached_property
    def box(self) -> tuple[Array, Array, Array]:
        """The points in the elements' frame, (2, n), and each polygon's least and greatest coordinates, (p, 2)."""
        c, s = np.cos(self.elements.frame), np.sin(self.elements.frame)
        turn = np.array([[c, s], [-s, c]])
        rings = [turn @ p.points.T for p in self.elements.polygons]
        low = np.array([r.min(axis=1) for r in rings]).reshape(-1, 2)
        high = np.array([r.max(axis=1) for r in rings]).reshape(-1, 2)
        return turn @ self.points.T, low, high


Field = Callable[[Observation], tuple[Array, Array]]
