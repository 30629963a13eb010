"""Scene elements as arrays: the polygons, segments and corners that relations are taken to (sections 4.3 and 5.3).

One `Elements` holds all features of a few polygons side by side, so that a relationship function is evaluated for all
of them and all points in one call.
"""

import enum
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property
from weakref import WeakKeyDictionary

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
    edge_direction : ndarray of shape (e,), complex
        The way divided by its length; x is the real part.
    edge_heading : ndarray of shape (e,)
        Its angle, radians.
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
    polygon_centroid : ndarray of shape (p, 2)
    polygon_orientation : ndarray of shape (p,)
        Main orientation of each polygon, radians.
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
    edge_direction: NDArray[np.complex128]
    edge_heading: Array
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
    polygon_centroid: Array
    polygon_orientation: Array
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
        if not polygons:
            return cls._extracted((), frame)
        parts = []
        for polygon in polygons:
            kept = _KEPT.get(polygon)
            if kept is None:
                kept = _KEPT[polygon] = cls._extracted((polygon,), 0.0)
            parts.append(kept)
        return cls.joined(parts, frame)

    @classmethod
    def _extracted(cls, polygons: tuple[Polygon, ...], frame: float) -> "Elements":
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
        edge_length = np.hypot(*edge_vector.T)
        return cls(
            polygons=polygons,
            frame=frame,
            edge_start=np.concatenate(starts) if starts else np.zeros((0, 2)),
            edge_vector=edge_vector,
            edge_direction=(edge_vector[:, 0] + 1j * edge_vector[:, 1]) / edge_length,
            edge_heading=np.arctan2(edge_vector[:, 1], edge_vector[:, 0]),
            edge_length=edge_length,
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
            polygon_centroid=np.array([p.centroid for p in polygons]).reshape(-1, 2),
            polygon_orientation=np.array([p.main_orientation for p in polygons]),
            corner_polygon=np.array(corner_polygon, dtype=np.intp),
            corner_vertex=np.array(vertices, dtype=np.float64).reshape(-1, 2),
            corner_before=np.array(before),
            corner_opening=np.array(opening),
        )

    @classmethod
    def joined(cls, parts: Sequence["Elements"], frame: float = 0.0) -> "Elements":
        """The features of several lists of polygons, one after another.

        Parameters
        ----------
        parts : sequence of Elements
            At least one.
        frame : float
            Direction in radians of the x axis in which bounding boxes are taken.

        Returns
        -------
        Elements
        """
        together = {name: np.concatenate([getattr(p, name) for p in parts]) for name in _ARRAYS}
        polygons = np.cumsum([0, *(len(p.polygons) for p in parts[:-1])])
        segments = np.cumsum([0, *(len(p.segment_length) for p in parts[:-1])])
        counted = (("edge_polygon", polygons), ("edge_segment", segments))
        for name, first in (*counted, ("segment_polygon", polygons), ("corner_polygon", polygons)):
            together[name] += np.repeat(first, [len(getattr(p, name)) for p in parts])
        return cls(
            polygons=tuple(polygon for p in parts for polygon in p.polygons),
            frame=frame,
            segment_label=tuple(label for p in parts for label in p.segment_label),
            **together,
        )

    def take(self, element: ElementType, rows: Indices, edges_kept: NDArray[np.bool_] | None = None) -> "Elements":
        """Chosen elements of one type, each as a feature of its own, as often as it is chosen.

        Parameters
        ----------
        element : ElementType
        rows : ndarray of shape (n,), int
        edges_kept : ndarray of shape (e,), bool, optional
            Of all edges, those that the elements keep; None: all.

        Returns
        -------
        Elements
            With `n` elements of the type, as far as points see them, and nothing else.
        """
        edges = owner = np.zeros(0, dtype=np.intp)
        if element is not ElementType.CORNER:
            group = self.edge_segment if element is ElementType.SEGMENT else self.edge_polygon
            if len(group) == self.count(element):  # an edge each
                edges, owner = rows, np.arange(len(rows))
            else:
                first = np.searchsorted(group, np.arange(self.count(element) + 1))
                count = np.diff(first)[rows]
                edges, owner = ranges(first[rows], count), np.repeat(np.arange(len(rows)), count)
            if edges_kept is not None:
                kept = edges_kept[edges]
                edges, owner = edges[kept], owner[kept]
        return replace(
            _nothing(),
            frame=self.frame,
            edge_segment=owner,
            edge_polygon=owner,
            **{name: getattr(self, name).take(edges, axis=0) for name in _SEEN_OF_EDGES[element]},
            **{name: getattr(self, name).take(rows, axis=0) for name in _SEEN[element]},
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
        of = {ElementType.POLYGON: self.polygon_orientation, ElementType.SEGMENT: self.segment_length}
        return len(of.get(element, self.corner_opening))

    @cached_property
    def first_edges(self) -> Indices:
        """The first edge of each polygon that has edges; shape (polygons,)."""
        return run_starts(self.edge_polygon)

    def heading(self, element: ElementType) -> Array | None:
        """Direction of every element of a type, where each has one: straight segments do.

        Parameters
        ----------
        element : ElementType

        Returns
        -------
        ndarray of shape (elements,), radians, or None
        """
        if element is not ElementType.SEGMENT or len(self.edge_segment) != len(self.segment_length):
            return None
        return self.edge_heading

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
            return np.arange(len(self.polygon_orientation))
        return self.segment_polygon if element is ElementType.SEGMENT else self.corner_polygon


_OF_EDGES = (
    "edge_start",
    "edge_vector",
    "edge_direction",
    "edge_heading",
    "edge_length",
    "edge_offset",
    "edge_ring_offset",
    "edge_ring_length",
    "edge_turns",
)
_OF_SEGMENTS = ("segment_polygon", "segment_length", "segment_curvature", "segment_closed")
_OF_CORNERS = ("corner_polygon", "corner_vertex", "corner_before", "corner_opening")
_OF_POLYGONS = ("polygon_centroid", "polygon_orientation")
#: What points see of edges, and of the elements themselves, by the type of element.
_SEEN_OF_EDGES: dict[ElementType, tuple[str, ...]] = {
    ElementType.POLYGON: tuple(n for n in _OF_EDGES if n not in ("edge_vector", "edge_offset")),
    ElementType.SEGMENT: ("edge_start", "edge_direction", "edge_heading", "edge_length", "edge_offset", "edge_turns"),
    ElementType.CORNER: (),
}
_SEEN: dict[ElementType, tuple[str, ...]] = {
    ElementType.POLYGON: _OF_POLYGONS,
    ElementType.SEGMENT: ("segment_length", "segment_closed"),
    ElementType.CORNER: ("corner_vertex", "corner_before", "corner_opening"),
}
_ARRAYS = (*_OF_EDGES, *_OF_SEGMENTS, *_OF_CORNERS, *_OF_POLYGONS, "edge_polygon", "edge_segment")

#: The features of polygons that are in use: they are asked for again with every arrangement that holds them.
_KEPT: WeakKeyDictionary[Polygon, Elements] = WeakKeyDictionary()


@cache
def _nothing() -> Elements:
    """No elements at all."""
    return Elements.of(())


def ranges(start: Indices, count: Indices) -> Indices:
    """Runs of whole numbers, one after another.

    Parameters
    ----------
    start, count : ndarray of shape (n,), int
        First number and length of each run.

    Returns
    -------
    ndarray of shape (sum of `count`,), int

    Examples
    --------
    >>> ranges(np.array([5, 0, 8]), np.array([2, 0, 3])).tolist()
    [5, 6, 8, 9, 10]
    """
    before = np.cumsum(count) - count
    runs: Indices = np.arange(count.sum())
    runs += np.repeat(start - before, count)
    return runs


def run_starts(values: Indices) -> Indices:
    """Where runs of equal values begin.

    Parameters
    ----------
    values : ndarray of shape (n,), int

    Returns
    -------
    ndarray of int

    Examples
    --------
    >>> run_starts(np.array([4, 4, 1, 4])).tolist()
    [0, 2, 3]
    """
    changed = np.ones(len(values), dtype=bool)
    np.not_equal(values[1:], values[:-1], out=changed[1:])
    return np.flatnonzero(changed)


def _turns(steps: Array) -> Array:
    """Turns before and after each edge of a ring, shape (n, 2), from the ways along its edges."""
    following = np.roll(steps, -1, axis=0)
    cross = steps[:, 0] * following[:, 1] - steps[:, 1] * following[:, 0]
    after = np.arctan2(cross, np.einsum("ij,ij->i", steps, following))
    return np.stack([np.roll(after, 1), after], axis=1)
