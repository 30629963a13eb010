"""What points see of elements: nearest places, distances and directions, evaluated once and shared by all relations."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely
from numpy.typing import NDArray

from ..tolerances import ZERO_LENGTH
from .elements import Elements

Array = NDArray[np.float64]
Directions = NDArray[np.complex128]


@dataclass(frozen=True)
class Nearest:
    """The boundary place nearest to each point, per segment or polygon.

    Attributes
    ----------
    distance : ndarray of shape (elements, points)
        In scene units, not negative.
    arc : ndarray of shape (elements, points)
        Arc length from the start of the segment (or of the ring) to the place.
    tangent : ndarray of shape (elements, points)
        Direction of the boundary there, radians. At a vertex, where the boundary has two, it is the one at right angles
        to the way to the point: it turns steadily from the first to the second as the point goes round the vertex.
    between : ndarray of shape (elements, points), bool
        Whether the place lies inside an edge, where moving the point along the boundary moves the place as far; at a
        vertex it stays.
    edge : ndarray of shape (elements, points), int
        Index of the edge that the place is on.
    left : ndarray of shape (elements, points), bool
        Whether the point lies to the left of the boundary there: on the interior's side.
    across : ndarray of shape (elements, points)
        Signed distance of the point from the straight line through that edge, positive to the left.
    """

    distance: Array
    arc: Array
    tangent: Array
    between: NDArray[np.bool_]
    edge: NDArray[np.intp]
    left: NDArray[np.bool_]
    across: Array


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
        along = np.clip(x * direction[:, :1] + y * direction[:, 1:], 0.0, e.edge_length[:, None])
        x -= along * direction[:, :1]
        y -= along * direction[:, 1:]
        return along, np.hypot(x, y)

    def _nearest(self, group: NDArray[np.intp], count: int, offset: Array, ends: NDArray[np.bool_]) -> Nearest:
        along, distance = self._edges
        e = self.elements
        n = len(self.points)
        if not count:
            empty = np.zeros((0, n))
            return Nearest(empty, empty, empty, empty.astype(bool), empty.astype(np.intp), empty.astype(bool), empty)
        if len(group) == count:  # one edge each: straight segments
            best = np.broadcast_to(np.arange(count)[:, None], (count, n))
        else:
            first = np.searchsorted(group, np.arange(count))
            best = np.empty((count, n), dtype=np.intp)
            last = np.append(first[1:], len(group))
            for k in range(count):
                best[k] = first[k] + np.argmin(distance[first[k] : last[k]], axis=0)
        column = np.arange(n)
        place = along[best, column]
        between = (place > 0) & (place < e.edge_length[best])
        tangent = e.edge_heading[best]
        distance = distance[best, column]
        end = (place > 0).astype(np.intp)
        row, point = np.nonzero(~between & (distance > 0) & ~ends[best, end])
        edge, end = best[row, point], end[row, point]
        way = self.points[point] - e.edge_start[edge] - end[:, None] * e.edge_vector[edge]
        # Points nearest to a vertex lie on the outer side of its turn.
        side = np.where(e.edge_turns[edge, end] > 0, np.pi / 2, -np.pi / 2)
        tangent[row, point] = np.arctan2(way[:, 1], way[:, 0]) + side
        across = e.edge_direction.real[best] * (self.points[:, 1] - e.edge_start[best, 1])
        across -= e.edge_direction.imag[best] * (self.points[:, 0] - e.edge_start[best, 0])
        # Round a vertex the two edges may disagree; there the points lie on the outer side of its turn.
        left = across >= -ZERO_LENGTH * e.edge_length[best]
        left[row, point] = e.edge_turns[edge, end] <= 0
        return Nearest(distance, place + offset[best], tangent, between, best, left, across)

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
            touching, 1j * e.edge_direction[nearest.edge], (x + 1j * y) / np.where(touching, 1.0, np.hypot(x, y))
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
        return np.hypot(x, y), np.arctan2(y, x)

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
        return np.hypot(x, y), np.arctan2(y, x)

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
