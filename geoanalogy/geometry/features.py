"""Features of a polygon's boundary: smooth segments and sharp corners (section 4.3)."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .persistence import ClearRing, clear_ring
from .polygon import Polygon


@dataclass(frozen=True)
class Segment:
    """A run of edges between two corners, without a corner in between.

    Attributes
    ----------
    vertices : ndarray of shape (n, 2), n >= 2
        In the boundary's direction, the interior on the left.
    label : str
        The label of its edges ("" where they have none).
    closed : bool
        Whether it is a whole ring without a corner; its last vertex is then its first again.
    ring_offset : float
        Arc length from the first vertex of its ring to its start.
    """

    vertices: NDArray[np.float64]
    label: str = ""
    closed: bool = False
    ring_offset: float = 0.0

    @property
    def length(self) -> float:
        """Arc length in scene units."""
        if len(self.vertices) == 2:
            return math.dist(*self.vertices.tolist())
        return float(np.hypot(*np.diff(self.vertices, axis=0).T).sum())

    @property
    def curvature(self) -> float:
        """Average absolute curvature: the turns between its edges in radians, divided by its length."""
        if len(self.vertices) == 2:
            return 0.0
        steps = np.diff(self.vertices, axis=0)
        angles = np.arctan2(steps[:, 1], steps[:, 0])
        if self.closed:
            angles = np.append(angles, angles[0])
        turns = (np.diff(angles) + np.pi) % (2 * np.pi) - np.pi
        return float(np.abs(turns).sum() / self.length)


@dataclass(frozen=True)
class Corner:
    """A sharp vertex of a boundary.

    Attributes
    ----------
    vertex, before, after : ndarray of shape (2,)
        The corner, and the boundary's unit directions that lead to it and away from it.
    """

    vertex: NDArray[np.float64]
    before: NDArray[np.float64]
    after: NDArray[np.float64]

    @property
    def opening(self) -> float:
        """Interior angle in radians, between 0 and 2 pi; above pi where the corner is reflex."""
        (bx, by), (ax, ay) = self.before.tolist(), self.after.tolist()
        return math.pi - math.atan2(bx * ay - by * ax, bx * ax + by * ay)

    @property
    def bisector(self) -> float:
        """Direction in radians that halves the interior angle."""
        return float(np.arctan2(self.after[1], self.after[0]) + self.opening / 2)


def ring_features(ring: NDArray[np.float64], edge_labels: tuple[str, ...] = ()) -> tuple[list[Segment], list[Corner]]:
    """The segments and corners of one ring, without the noise of its boundary.

    A change of edge label ends a segment as a corner does, but makes no corner: the wall with the door is a feature of
    its own even where it continues straight.

    Parameters
    ----------
    ring : ndarray of shape (n, 2)
        Vertices without a repeated last one, interior on the left.
    edge_labels : tuple of str
        A label per edge; empty: none has one.

    Returns
    -------
    segments : list of Segment
        In the ring's order; one closed segment where the ring has neither a corner nor a change of label.
    corners : list of Corner
        In the ring's order.
    """
    return _features(clear_ring(ring, edge_labels))


def _features(clear: ClearRing) -> tuple[list[Segment], list[Corner]]:
    ring, labels, sharp = clear.points, clear.labels, clear.sharp
    n = len(ring)
    ends = np.flatnonzero(sharp | np.array([labels[i - 1] != labels[i] for i in range(n)]))
    around = np.concatenate([ring, ring])
    directions = around[1 : n + 1] - ring
    lengths = np.hypot(directions[:, 0], directions[:, 1])
    offsets = np.cumsum(lengths) - lengths
    directions = directions / lengths[:, None]
    corners = [Corner(ring[i], directions[i - 1], directions[i]) for i in np.flatnonzero(sharp)]
    if not len(ends):
        return [Segment(np.vstack([ring, ring[:1]]), labels[0], closed=True)], corners
    segments = []
    starts = ends.tolist()
    for start, end in zip(starts, [*starts[1:], starts[0] + n], strict=True):
        # One may run over the ring's first vertex.
        segments.append(Segment(around[start : end + 1], labels[start], ring_offset=float(offsets[start])))
    return segments, corners


def polygon_features(polygon: Polygon) -> tuple[list[Segment], list[Corner]]:
    """The segments and corners of a polygon, its outline's first, then those of its holes.

    Parameters
    ----------
    polygon : Polygon

    Returns
    -------
    segments : list of Segment
    corners : list of Corner
    """
    by_ring = features_by_ring(polygon)
    return [s for segments, _ in by_ring for s in segments], [c for _, corners in by_ring for c in corners]


def features_by_ring(polygon: Polygon) -> list[tuple[list[Segment], list[Corner]]]:
    """The segments and corners of each ring of a polygon, its outline first.

    Parameters
    ----------
    polygon : Polygon

    Returns
    -------
    list of (list of Segment, list of Corner)
    """
    return [_features(clear) for clear in polygon.clear_rings]
