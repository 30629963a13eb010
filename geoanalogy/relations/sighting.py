"""Chosen elements, each as seen from one point of its own: what a few pairs of many arrangements need."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..tolerances import ZERO_LENGTH
from .elements import Elements, ElementType, Indices
from .observation import Array, Directions, Nearest, Observation, length
from .runs import run_starts

#: Stands for the points of an observation: there is one of each element.
_ONE = np.zeros((1, 2))


@dataclass(slots=True)
class NearestOfOne:
    """The boundary place of one element nearest to one point, for many such pairs; all shapes are (n, 1).

    Attributes
    ----------
    distance, arc, tangent, between, edge, left, across : ndarray of shape (n, 1)
        As `Nearest` says.
    x, y : ndarray of shape (n,)
        The way from the place to the point, scene units.
    """

    distance: Array
    arc: Array
    tangent: Array
    between: NDArray[np.bool_]
    edge: Indices
    left: NDArray[np.bool_]
    across: Array
    x: Array
    y: Array


class Sighting(Observation):
    """Elements of one type, each seen from one point.

    To relationship functions it is an observation of `n` elements from a single point: what they return has the shape
    (n, 1).

    Parameters
    ----------
    elements : Elements
        Chosen by `Elements.take`.
    element : ElementType
        Their type.
    x, y : ndarray of shape (n,)
        The point of each, scene coordinates.
    """

    def __init__(self, elements: Elements, element: ElementType, x: Array, y: Array) -> None:
        super().__init__(elements, _ONE)
        self._element = element
        self._x = x
        self._y = y

    def _nearest_of_own(self, owner: Indices, offset: Array, ends: NDArray[np.bool_] | None) -> NearestOfOne:
        """`ends`: at which of their two vertices edges have no neighbour in their element; None: at both."""
        e = self.elements
        single = len(owner) == len(self._x)
        x = (self._x if single else self._x[owner]) - e.edge_start[:, 0]
        y = (self._y if single else self._y[owner]) - e.edge_start[:, 1]
        ux, uy, size, tangent = e.edge_direction.real, e.edge_direction.imag, e.edge_length, e.edge_heading
        along = x * ux
        along += y * uy
        np.maximum(along, 0.0, out=along)
        np.minimum(along, size, out=along)
        x -= along * ux
        y -= along * uy
        distance = self._edge_distance = length(x, y)
        edge = np.arange(len(owner))
        if not single:
            first = e.first_edges
            least = np.minimum.reduceat(distance, first)
            at = np.flatnonzero(distance == least[owner])
            edge = at[run_starts(owner[at])]
            x, y, along, distance = x[edge], y[edge], along[edge], distance[edge]
            ux, uy, size, tangent, offset = ux[edge], uy[edge], size[edge], tangent[edge], offset[edge]
        between = (along > 0) & (along < size)
        across = ux * y
        across -= uy * x
        left = across >= -ZERO_LENGTH * size
        if ends is not None:
            end = (along > 0).astype(np.intp)
            row = np.flatnonzero(~between & (distance > 0) & ~ends[edge, end])
            outer = e.edge_turns[edge[row], end[row]] > 0
            # As in an observation: round a vertex the tangent is at right angles to the way.
            tangent = tangent.copy()
            tangent[row] = np.arctan2(y[row], x[row]) + np.where(outer, np.pi / 2, -np.pi / 2)
            left[row] = ~outer
        return NearestOfOne(
            distance=distance[:, None],
            arc=(along + offset)[:, None],
            tangent=tangent[:, None],
            between=between[:, None],
            edge=edge[:, None],
            left=left[:, None],
            across=across[:, None],
            x=x,
            y=y,
        )

    @cached_property
    def segment(self) -> NearestOfOne:
        """Nearest place on the segment of each pair; arcs from the segment's start."""
        e = self.elements
        ends = None
        if len(e.edge_segment) > len(self._x) or e.segment_closed.any():
            last = np.append(np.diff(e.edge_segment) != 0, True)
            ends = np.stack([np.roll(last, 1), last], axis=1) & ~e.segment_closed[e.edge_segment, None]
        return self._nearest_of_own(e.edge_segment, e.edge_offset, ends)

    @cached_property
    def boundary(self) -> NearestOfOne:
        """Nearest place on the boundary of the polygon of each pair; arcs from its ring's first vertex."""
        e = self.elements
        return self._nearest_of_own(e.edge_polygon, e.edge_ring_offset, np.zeros((len(e.edge_polygon), 2), dtype=bool))

    def reachable_edges(self, reach: Array) -> NDArray[np.bool_]:
        """The edges of polygons that a boundary's nearest place may come to lie on.

        Parameters
        ----------
        reach : ndarray of shape (n,)
            How far each point may move, scene units.

        Returns
        -------
        ndarray of shape (edges,), bool
        """
        e = self.elements
        farthest = self.boundary.distance[:, 0] + 2 * reach
        # A little more: the nearest edge itself is always among them.
        return self._edge_distance <= (1 + ZERO_LENGTH) * farthest[e.edge_polygon] + ZERO_LENGTH

    def away(self, nearest: Nearest) -> Directions:
        """Direction from nearest places to the points: where the distance grows.

        Parameters
        ----------
        nearest : Nearest
            `segment` or `boundary`.

        Returns
        -------
        ndarray of shape (n, 1), complex
            Of length 1. Where a point lies on the boundary, to the interior's side.
        """
        assert isinstance(nearest, NearestOfOne)
        edge, distance = nearest.edge[:, 0], nearest.distance[:, 0]
        direction = self.elements.edge_direction[edge]
        touching = distance <= ZERO_LENGTH * self.elements.edge_length[edge]
        away = np.where(touching, 1.0, distance)
        way = np.empty(len(away), dtype=np.complex128)
        way.real = np.where(touching, -direction.imag, nearest.x) / away
        way.imag = np.where(touching, direction.real, nearest.y) / away
        return way[:, None]

    def along(self, nearest: Nearest) -> Directions:
        """Direction of the boundary at nearest places.

        Parameters
        ----------
        nearest : Nearest
            `segment` or `boundary`.

        Returns
        -------
        ndarray of shape (n, 1), complex
        """
        direction = self.elements.edge_direction[nearest.edge]
        turned = nearest.tangent != self.elements.edge_heading[nearest.edge]
        direction[turned] = np.exp(1j * nearest.tangent[turned])
        return direction

    @cached_property
    def corner(self) -> tuple[Array, Array]:
        """Distance and direction (radians) from the corner of each pair to its point; both (n, 1)."""
        x, y = self._from_corner
        return length(x, y)[:, None], np.arctan2(y, x)[:, None]

    @cached_property
    def _from_corner(self) -> tuple[Array, Array]:
        vertex = self.elements.corner_vertex
        return self._x - vertex[:, 0], self._y - vertex[:, 1]

    @cached_property
    def from_corner(self) -> Directions:
        """Direction from the corner of each pair to its point, of length 1 or, at the corner, 0; shape (n, 1)."""
        x, y = self._from_corner
        away = self.corner[0][:, 0]
        away = np.where(away > 0, away, 1.0)
        way = np.empty(len(x), dtype=np.complex128)
        np.divide(x, away, out=way.real)
        np.divide(y, away, out=way.imag)
        return way[:, None]

    @cached_property
    def centroid(self) -> tuple[Array, Array]:
        """Distance and direction (radians) from the point of each pair to its polygon's centroid; both (n, 1)."""
        centroid = self.elements.polygon_centroid
        x, y = centroid[:, 0] - self._x, centroid[:, 1] - self._y
        return length(x, y)[:, None], np.arctan2(y, x)[:, None]
