"""Arithmetic on axis-parallel boxes (x0, y0, x1, y1) in arrays of shape (n, 4)."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

#: Share of the smaller of two neighbours' extents that must lie abreast for a gap to be between them.
ABREAST = 0.5
#: Share of an extent up to which two edges are one but for rounding: what is flush neither overlaps nor leaves a gap.
TOUCHING = 1e-6


def areas(boxes: Array) -> Array:
    """Area of each box, shape (n,).

    Parameters
    ----------
    boxes : ndarray

    Returns
    -------
    ndarray
    """
    size = boxes[..., 2:] - boxes[..., :2]
    return np.asarray(np.multiply(size[..., 0], size[..., 1]))


def _paired(between: Callable[[Array, Array], Array], a: Array, b: Array) -> Array:
    """A function of the four edges of every two boxes, evaluated with the longer of both arrays innermost.

    Edges as contiguous columns, and no short inner loops: most calls compare thousands of boxes with a handful.

    Parameters
    ----------
    between : callable
        Of the columns of both, shapes (4, n, 1) and (4, 1, m) or the other way round.
    a : ndarray of shape (n, 4)
    b : ndarray of shape (m, 4)

    Returns
    -------
    ndarray of shape (n, m)
    """
    swapped = len(b) < len(a)
    outer, inner = (np.ascontiguousarray(boxes.T) for boxes in ((b, a) if swapped else (a, b)))
    found = np.empty((outer.shape[1], inner.shape[1]), dtype=np.result_type(a, b))
    step = max(1, AT_ONCE // max(inner.shape[1], 1))
    for start in range(0, len(found), step):
        some = outer[:, start : start + step, None]
        pair = (inner[:, None, :], some) if swapped else (some, inner[:, None, :])
        found[start : start + step] = between(*pair)
    return found.T if swapped else found


#: Pairs of boxes that are compared at once: what is kept between two steps of arithmetic stays in the cache.
AT_ONCE = 16384


def shared_areas(a: Array, b: Array) -> Array:
    """Area shared by each pair of boxes, shape (n, m).

    Parameters
    ----------
    a : ndarray
    b : ndarray

    Returns
    -------
    ndarray
    """
    return _paired(_shared, a, b)


def _shared_length(a: Array, b: Array, axis: int) -> Array:
    shared = np.minimum(a[axis + 2], b[axis + 2])
    shared -= np.maximum(a[axis], b[axis])
    return np.maximum(shared, 0.0, out=shared)


def _shared(a: Array, b: Array) -> Array:
    shared = _shared_length(a, b, 0)
    shared *= _shared_length(a, b, 1)
    return shared


def overlap(a: Array, b: Array) -> Array:
    """Shared area over the smaller area of each pair, shape (n, m).

    Parameters
    ----------
    a : ndarray
    b : ndarray

    Returns
    -------
    ndarray
    """
    return _paired(_overlap, a, b)


def _overlap(a: Array, b: Array) -> Array:
    shared = _shared(a, b)
    shared /= np.minimum(_area(a), _area(b))
    return shared


def _area(edges: Array) -> Array:
    return np.asarray(np.multiply(edges[2] - edges[0], edges[3] - edges[1]))


def union_overlap(a: Array, b: Array) -> Array:
    """Shared area over the area of the union of each pair, shape (n, m).

    Parameters
    ----------
    a : ndarray
    b : ndarray

    Returns
    -------
    ndarray
    """
    return _paired(_union_overlap, a, b)


def _union_overlap(a: Array, b: Array) -> Array:
    shared = _shared(a, b)
    union = _area(a) + _area(b)
    union -= shared
    shared /= union
    return shared


def interval_overlap(a: Array, b: Array, axis: int) -> Array:
    """Shared length over the length of the union of each pair of extents along an axis, shape (n, m).

    Parameters
    ----------
    a : ndarray
    b : ndarray
    axis : int

    Returns
    -------
    ndarray
    """

    def share(a: Array, b: Array) -> Array:
        union = np.maximum(a[axis + 2], b[axis + 2])
        union -= np.minimum(a[axis], b[axis])
        shared = _shared_length(a, b, axis)
        shared /= union
        return shared

    return _paired(share, a, b)


def distances(a: Array, b: Array) -> Array:
    """How far apart each pair of boxes is, shape (n, m).

    The gap between them, and a quarter of the way between their centres: it orders the elements that overlap a box,
    whose gap is zero.

    Parameters
    ----------
    a : ndarray
    b : ndarray

    Returns
    -------
    ndarray
    """
    return _paired(_distance, a, b)


def _distance(a: Array, b: Array) -> Array:
    gap = _squared([np.maximum(np.maximum(b[k] - a[k + 2], a[k] - b[k + 2]), 0.0) for k in (0, 1)])
    way = _squared([(a[k] + a[k + 2]) - (b[k] + b[k + 2]) for k in (0, 1)])
    way *= WAY_SQUARED
    found = np.sqrt(gap, out=gap)
    found += np.sqrt(way, out=way)
    return found


#: The square of a quarter of half: sums of edges are twice the centres.
WAY_SQUARED = 0.125**2


def _squared(parts: list[Array]) -> Array:
    x, y = parts
    x *= x
    y *= y
    x += y
    return x


def gaps_between(drawn: dict[str, Array]) -> dict[str, Array]:
    """The gaps between neighbours, as elements: what lies "between A and B" has relations to their gap.

    For every box the nearest box to its right that stands abreast, and the nearest above it that does.

    Parameters
    ----------
    drawn : dict of str to ndarray of shape (n, 4)
        Boxes by label.

    Returns
    -------
    dict of str to ndarray of shape (n, 4)
        Gaps by the label "between A and B", A and B in alphabetical order, so that mirroring changes no label.
    """
    labels = np.array([label for label, boxes in drawn.items() for _ in boxes])
    if len(labels) < 2:
        return {}
    every = np.concatenate(list(drawn.values()))
    found: dict[str, list[Array]] = {}
    for axis in (0, 1):
        across = 1 - axis
        extent = every[:, across + 2] - every[:, across]
        shared = np.minimum(every[:, None, across + 2], every[None, :, across + 2]) - np.maximum(
            every[:, None, across], every[None, :, across]
        )
        way = every[None, :, axis] - every[:, None, axis + 2]
        shorter = np.minimum(extent[:, None], extent[None])
        abreast = (shared >= (ABREAST - TOUCHING) * shorter) & (way > TOUCHING * shorter)
        way = np.where(abreast, way, np.inf)
        # Neighbours in both senses: nearest seen from either side, so that mirroring the drawing keeps the pairs.
        mutual = (way <= way.min(axis=1, keepdims=True)) & (way <= way.min(axis=0, keepdims=True)) & abreast
        for i, j in zip(*np.nonzero(mutual), strict=True):
            gap = np.empty(4)
            gap[[axis, axis + 2]] = every[i, axis + 2], every[j, axis]
            gap[across] = max(every[i, across], every[j, across])
            gap[across + 2] = min(every[i, across + 2], every[j, across + 2])
            found.setdefault(f"{BETWEEN}{' and '.join(sorted((labels[i], labels[j])))}", []).append(gap)
    return {label: np.array(found[label]) for label in sorted(found)}


#: Prefix of the labels of gaps.
BETWEEN = "between "
