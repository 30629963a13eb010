"""Scene elements as arrays: the polygons, segments and corners that relations are taken to (sections 4.3 and 5.3).

One `Elements` holds all features of a few polygons side by side, so that a relationship function is evaluated for all
of them and all points in one call.
"""

import enum
import operator
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from ..geometry.polygon import Polygon
from .extraction import extract, extract_each
from .runs import ranges, run_starts

Array = NDArray[np.float64]
Indices = NDArray[np.intp]


class ElementType(enum.Enum):
    """The kinds of elements a relation can be taken to."""

    POLYGON = "polygon"
    SEGMENT = "segment"
    CORNER = "corner"

    # There is one of each: they are looked up thousands of times an operation, and a name takes longer to hash.
    __hash__ = object.__hash__


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
            return cls(polygons=(), frame=frame, **extract(()))
        found = [_KEPT.get(p) for p in polygons]
        if any(e is None for e in found):
            keep_features(polygons)
        parts = [_KEPT[p] if e is None else e for p, e in zip(polygons, found, strict=True)]
        return parts[0] if len(parts) == 1 and frame == parts[0].frame else cls.joined(parts, frame)

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
        every = zip(*map(_arrays_of, parts), strict=True)
        together = {name: np.concatenate(arrays) for name, arrays in zip(_ARRAYS, every, strict=True)}
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
        # Thousands of times an operation: `replace` would set one attribute after another.
        made = object.__new__(Elements)
        values = made.__dict__
        values.update(_nothing())
        values.update(frame=self.frame, edge_segment=owner, edge_polygon=owner)
        for name in _SEEN_OF_EDGES[element]:
            values[name] = self.__dict__[name].take(edges, axis=0)
        for name in _SEEN[element]:
            values[name] = self.__dict__[name].take(rows, axis=0)
        return made

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
_arrays_of = operator.attrgetter(*_ARRAYS)


def keep_features(polygons: Iterable[Polygon]) -> None:
    """Extract the features of polygons that are about to be asked for: together, which costs a fraction.

    Parameters
    ----------
    polygons : iterable of Polygon
    """
    missing = [p for p in dict.fromkeys(polygons) if p not in _KEPT]
    for polygon, arrays in extract_each(missing):
        _KEPT[polygon] = Elements(polygons=(polygon,), frame=0.0, **arrays)


@cache
def _nothing() -> dict[str, Any]:
    """The attributes of no elements at all."""
    return dict(vars(Elements.of(())))
