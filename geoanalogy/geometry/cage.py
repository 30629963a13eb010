"""Mean value coordinates: what is inside an outline follows it when it is bent (Floater, 2003)."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

#: Distance from an outline, in sizes of it, below which a point lies on it: its coordinates are those of its edge.
ON_EDGE = 1e-9

#: Difference of outlines, in sizes of the outline, below which nothing is bent: equal polygons differ by rounding.
UNBENT = 1e-4


def is_bent(outline: Array, ring: Array) -> bool:
    """Whether an outline has been bent to a ring.

    Parameters
    ----------
    outline : ndarray of shape (n, 2)
    ring : ndarray of shape (m, 2)
        Vertex by vertex the bent outline; with another number of vertices it is none of these.

    Returns
    -------
    bool
    """
    return ring.shape == outline.shape and bool(np.abs(ring - outline).max() > UNBENT * np.ptp(outline, axis=0).max())


def cage_coordinates(points: ArrayLike, ring: ArrayLike) -> Array:
    """The mean value coordinates of points.

    Parameters
    ----------
    points : array_like of shape (n, 2)
        Inside, on or outside of the outline.
    ring : array_like of shape (m, 2)
        The outline.

    Returns
    -------
    ndarray of shape (n, m)
        Weights of its vertices, with sum 1: times the vertices they give the points, times the vertices of the bent
        outline the bent points.
    """
    vertices = np.asarray(ring, dtype=np.float64)
    away = vertices - np.asarray(points, dtype=np.float64).reshape(-1, 1, 2)
    following = np.roll(away, -1, axis=1)
    size = float(np.ptp(vertices, axis=0).max())
    length = np.hypot(away[..., 0], away[..., 1])
    cross = away[..., 0] * following[..., 1] - away[..., 1] * following[..., 0]
    dot = (away * following).sum(axis=2)
    # The tangent of half the angle in which an edge is seen; 0 for an edge that is seen from its end.
    apart = np.abs(cross) > (ON_EDGE * size) ** 2
    half = np.divide(length * np.roll(length, -1, axis=1) - dot, cross, out=np.zeros_like(cross), where=apart)
    weights = (half + np.roll(half, 1, axis=1)) / np.maximum(length, ON_EDGE * size)
    _on_edges(weights, away, following, size)
    return weights / weights.sum(axis=1, keepdims=True)  # type: ignore[no-any-return]


def _on_edges(weights: Array, away: Array, following: Array, size: float) -> None:
    """Set the weights of points on the outline: only those of their edge, in proportion."""
    along = following - away
    squared = np.maximum((along**2).sum(axis=2), (ON_EDGE * size) ** 2)
    at = np.clip(-(away * along).sum(axis=2) / squared, 0.0, 1.0)
    distance = np.linalg.norm(away + at[..., None] * along, axis=2)
    edge = distance.argmin(axis=1)
    (here,) = np.nonzero(distance[np.arange(len(edge)), edge] <= ON_EDGE * size)
    weights[here] = 0.0
    weights[here, edge[here]] = 1.0 - at[here, edge[here]]
    weights[here, (edge[here] + 1) % weights.shape[1]] += at[here, edge[here]]
