"""Stable keys: the name of a result that does not depend on its rank, and finding it again after a replay."""

from collections.abc import Iterable, Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..geometry.polygon import Polygon
from ..tolerances import SAME_RESULT


def to_parent(points: ArrayLike, parent: Polygon) -> NDArray[np.float64]:
    """Points in a polygon's own frame: from its centroid, along its main orientation, in sizes of the polygon.

    Parameters
    ----------
    points : array_like of shape (n, 2)
        Scene coordinates.
    parent : Polygon

    Returns
    -------
    ndarray of shape (n, 2)
        Unchanged when the polygon is moved, scaled or turned with its points.
    """
    c, s = np.cos(parent.main_orientation), np.sin(parent.main_orientation)
    return (np.asarray(points, float) - parent.centroid) @ np.array([[c, -s], [s, c]]) / parent.size


def from_parent(points: ArrayLike, parent: Polygon) -> NDArray[np.float64]:
    """The inverse of `to_parent`.

    Parameters
    ----------
    points : array_like of shape (n, 2)
        In the polygon's own frame.
    parent : Polygon

    Returns
    -------
    ndarray of shape (n, 2)
        Scene coordinates.
    """
    c, s = np.cos(parent.main_orientation), np.sin(parent.main_orientation)
    return np.asarray(points, float) * parent.size @ np.array([[c, s], [-s, c]]) + parent.centroid


def key_of(position: tuple[float, float], parent: Polygon) -> str:
    """The key of a result: its parent's id and its place there, in thousandths of the parent's size.

    Parameters
    ----------
    position : (float, float)
        Scene coordinates.
    parent : Polygon

    Returns
    -------
    str

    Examples
    --------
    >>> key_of((1.5, 1.0), Polygon([(0, 0), (4, 0), (4, 4), (0, 4)], id="room 7"))
    'room 7@-125,-250'
    """
    u, v = np.rint(1000 * to_parent([position], parent)[0]).astype(int)
    return f"{parent.id}@{u},{v}"


def distinct(keys: Iterable[str]) -> list[str]:
    """Keys of which each occurs once: those that come again get a number.

    Parameters
    ----------
    keys : iterable of str

    Returns
    -------
    list of str

    Examples
    --------
    >>> distinct(["r@0,0", "r@0,1", "r@0,0"])
    ['r@0,0', 'r@0,1', 'r@0,0,2']
    """
    seen: dict[str, int] = {}
    result = []
    for key in keys:
        seen[key] = seen.get(key, 0) + 1
        result.append(key if seen[key] == 1 else f"{key},{seen[key]}")
    return result


def find(wanted: Sequence[str], present: Sequence[str]) -> Mapping[str, str]:
    """Which of the present results each wanted key means: itself, else the nearest in the same parent.

    Parameters
    ----------
    wanted : sequence of str
        Keys of an earlier replay.
    present : sequence of str
        Keys of this one.

    Returns
    -------
    mapping of str to str
        From wanted to present; wanted keys that nothing is near to are left out, and no present key is used twice.
    """
    found = {key: key for key in wanted if key in set(present)}
    free = [key for key in present if key not in found]
    near = [
        (gap, i, j)
        for i, key in enumerate(wanted)
        if key not in found
        for j, other in enumerate(free)
        if (gap := _gap(key, other)) <= SAME_RESULT
    ]
    used: set[int] = set()
    for _, i, j in sorted(near):
        if wanted[i] not in found and j not in used:
            found[wanted[i]] = free[j]
            used.add(j)
    return found


def _gap(one: str, other: str) -> float:
    """Distance of two keys in sizes of their parent; infinite where the parents differ."""
    parent, _, place = one.rpartition("@")
    of, _, there = other.rpartition("@")
    if parent != of:
        return np.inf
    (u, v), (s, t) = ([int(n) for n in text.split(",")[:2]] for text in (place, there))
    return float(np.hypot(u - s, v - t)) / 1000
