"""Scene elements as arrays: the polygons, segments and corners that relations are taken to (sections 4.3 and 5.3).

One `Elements` holds all features of a few polygons side by side, so that a relationship function is evaluated for all
of them and all points in one call.
"""

import enum
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..geometry.features import features_by_ring
from ..geometry.polygon import Polygon

Array = NDArray[np.float64]
Indices = NDArray[np.intp]


class ElementType(enum.Enum):
    """The kinds of elements a relation can be taken to."""

    POLYGON = "polygon"
    SEGMENT = "segment"
    CORNER = "corner"


@dataclass(frozen=True)
class Elements:
    """All features of a list of polygons.

    Attributes
    ----------
    polygons : tuple of Polygon
    frame : float
        Direction in radians of the x axis in which bounding boxes are taken.
    edge_start, edge_vector : ndarray of shape (e, 2)
        Every boundary edge of every polygon: its first vertex and the way to its second.
    edge_length, edge_offset : ndarray of shape (e,)
        Length, and arc length from the segment's start.
    edge_ring_offset, edge_ring_length : ndarray of shape (e,)
        Arc length from the first vertex of the edge's ring, and the length of that ring.
    edge_turns : ndarray of shape (e, 2)
        Turns of the boundary at the edge's first and second vertex, in radians, positive to the left.
    edge_polygon, edge_segment : ndarray of shape (e,), int
        The polygon and segment of each edge; edges are ordered by segment, segments by polygon.
    segment_polygon : ndarray of shape (s,), int
    segment_length, segment_curvature : ndarray of shape (s,)
    segment_closed : ndarray of shape (s,), bool
        Whether the segment is a whole smooth ring.
    segment_label : tuple of str
    corner_polygon : ndarray of shape (c,), int
    corner_vertex : ndarray of shape (c, 2)
    corner_before : ndarray of shape (c,)
        Direction in radians from the corner back along the boundary: the first adjacent edge (section 4.3).
    corner_opening : ndarray of shape (c,)
        Interior angle in radians.
    """

    polygons: tuple[Polygon, ...]
    frame: float
    edge_start: Array
    edge_vector: Array
    edge_length: Array
    edge_offset: Array
    edge_ring_offset: Array
    edge_ring_length: Array
    edge_turns: Array
    edge_polygon: Indices
    edge_segment: Indices
    segment_polygon: Indices
    segment_length: Array
    segment_curvature: Array
    segment_closed: NDArray[np.bool_]
    segment_label: tuple[str, ...]
    corner_polygon: Indices
    corner_vertex: Array
    corner_before: Array
    corner_opening: Array

    @classmethod
    def of(cls, polygons: Sequence[Polygon], frame: float = 0.0) -> "Elements":
        """Extract the features of polygons.

        Parameters
        ----------
        polygons : sequence of Polygon
        frame : float
            Direction in radians of the x axis in which bounding boxes are taken.

        Returns
        -------
        Elements
        """
        starts, vectors, turns, offsets, ring_offsets, ring_lengths = [], [], [], [], [], []
        edge_polygon: list[int] = []
        edge_segment: list[int] = []
        lengths: list[float] = []
        segment_polygon, curvatures, closed, labels = [], [], [], []
        vertices, before, opening, corner_polygon = [], [], [], []
        for i, polygon in enumerate(polygons):
            for segments, corners in features_by_ring(polygon):
                ring_length = sum(s.length for s in segments)
                first_edge = len(edge_polygon)
                for s in segments:
                    steps = np.diff(s.vertices, axis=0)
                    arc = np.cumsum(np.hypot(*steps.T))
                    starts.append(s.vertices[:-1])
                    vectors.append(steps)
                    offsets.append(np.concatenate([[0.0], arc[:-1]]))
                    # A segment may run over the ring's first vertex; there the count starts again.
                    ring_offsets.append((s.ring_offset + offsets[-1]) % ring_length)
                    edge_polygon += [i] * len(steps)
                    edge_segment += [len(lengths)] * len(steps)
                    segment_polygon.append(i)
                    lengths.append(arc[-1])
                    curvatures.append(s.curvature)
                    closed.append(s.closed)
                    labels.append(s.label)
                ring_lengths.append(np.full(len(edge_polygon) - first_edge, ring_length))
                turns.append(_turns(np.concatenate(vectors[-len(segments) :])))
                for c in corners:
                    vertices.append(c.vertex)
                    before.append(np.arctan2(-c.before[1], -c.before[0]))
                    opening.append(c.opening)
                    corner_polygon.append(i)
        edge_vector = np.concatenate(vectors) if vectors else np.zeros((0, 2))
        return cls(
            polygons=tuple(polygons),
            frame=frame,
            edge_start=np.concatenate(starts) if starts else np.zeros((0, 2)),
            edge_vector=edge_vector,
            edge_length=np.hypot(*edge_vector.T),
            edge_offset=np.concatenate(offsets) if offsets else np.zeros(0),
            edge_ring_offset=np.concatenate(ring_offsets) if ring_offsets else np.zeros(0),
            edge_ring_length=np.concatenate(ring_lengths) if ring_lengths else np.zeros(0),
            edge_turns=np.concatenate(turns) if turns else np.zeros((0, 2)),
            edge_polygon=np.array(edge_polygon, dtype=np.intp),
            edge_segment=np.array(edge_segment, dtype=np.intp),
            segment_polygon=np.array(segment_polygon, dtype=np.intp),
            segment_length=np.array(lengths),
            segment_curvature=np.array(curvatures),
            segment_closed=np.array(closed, dtype=bool),
            segment_label=tuple(labels),
            corner_polygon=np.array(corner_polygon, dtype=np.intp),
            corner_vertex=np.array(vertices, dtype=np.float64).reshape(-1, 2),
            corner_before=np.array(before),
            corner_opening=np.array(opening),
        )

    def count(self, element: ElementType) -> int:
        """Number of elements of a type.

        Parameters
        ----------
        element : ElementType

        Returns
        -------
        int
        """
        return len(self.polygon_of(element))

    def polygon_of(self, element: ElementType) -> Indices:
        """Index in `polygons` of the polygon of every element of a type.

        Parameters
        ----------
        element : ElementType

        Returns
        -------
        ndarray of int
        """
        if element is ElementType.POLYGON:
            return np.arange(len(self.polygons))
        return self.segment_polygon if element is ElementType.SEGMENT else self.corner_polygon


def _turns(steps: Array) -> Array:
    """Turns before and after each edge of a ring, shape (n, 2), from the ways along its edges."""
    following = np.roll(steps, -1, axis=0)
    cross = steps[:, 0] * following[:, 1] - steps[:, 1] * following[:, 0]
    after = np.arctan2(cross, np.einsum("ij,ij->i", steps, following))
    return np.stack([np.roll(after, 1), after], axis=1)
