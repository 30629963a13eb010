"""Features of a polygon's boundary: smooth segments and sharp corners (section 4.3)."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..tolerances import SMOOTH_TURN
from .polygon import Polygon


@dataclass(frozen=True)
class Segment:
    """A run of edges between two corners, without a corner in between.

    Attributes
    ----------
    vertices : ndarray of shape (n, 2), n >= 2
        In the boundary's direction, the interior on the left; a closed smooth ring repeats its first vertex.
    label : str
        The label of its edges ("" where they have none).
    """

    vertices: NDArray[np.float64]
    label: str = ""

    @property
    def length(self) -> float:
        """Arc length in scene units."""
        return float(np.hypot(*np.diff(self.vertices, axis=0).T).sum())

    @property
    def curvature(self) -> float:
        """Average absolute curvature: the turns between its edges in radians, divided by its length."""
        steps = np.diff(self.vertices, axis=0)
        angles = np.arctan2(steps[:, 1], steps[:, 0])
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
        turn = np.arctan2(
            self.before[0] * self.after[1] - self.before[1] * self.after[0], float(np.dot(self.before, self.after))
        )
        return float(np.pi - turn)

    @property
    def bisector(self) -> float:
        """Direction in radians that halves the interior angle."""
        return float(np.arctan2(self.after[1], self.after[0]) + self.opening / 2)


def sharp_vertices(ring: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Which vertices of a ring are corners: those whose edges turn by more than the smooth limit.

    Parameters
    ----------
    ring : ndarray of shape (n, 2)
        Vertices without a repeated last one.

    Returns
    -------
    ndarray of shape (n,), bool

    Examples
    --------
    >>> octagon = np.exp(2j * np.pi * np.arange(8) / 8)
    >>> bool(sharp_vertices(np.stack([octagon.real, octagon.imag], 1)).all())
    True
    """
    after = np.roll(ring, -1, axis=0) - ring
    after = after / np.hypot(*after.T)[:, None]
    before = np.roll(after, 1, axis=0)
    return np.einsum("ij,ij->i", before, after) <= SMOOTH_TURN


def ring_features(ring: NDArray[np.float64], edge_labels: tuple[str, ...] = ()) -> tuple[list[Segment], list[Corner]]:
    """The segments and corners of one ring.

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
    n = len(ring)
    labels = edge_labels or ("",) * n
    sharp = sharp_vertices(ring)
    ends = np.flatnonzero(sharp | np.array([labels[i - 1] != labels[i] for i in range(n)]))
    directions = np.roll(ring, -1, axis=0) - ring
    directions = directions / np.hypot(*directions.T)[:, None]
    corners = [Corner(ring[i], directions[i - 1], directions[i]) for i in np.flatnonzero(sharp)]
    if not len(ends):
        return [Segment(np.vstack([ring, ring[:1]]), labels[0])], corners
    segments = []
    for start, end in zip(ends, np.append(ends[1:], ends[0] + n), strict=True):
        segments.append(Segment(ring[np.arange(start, end + 1) % n], labels[start]))
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
    segments, corners = ring_features(polygon.points, polygon.segment_labels)
    for hole in polygon.holes:
        more_segments, more_corners = ring_features(hole)
        segments += more_segments
        corners += more_corners
    return segments, corners
