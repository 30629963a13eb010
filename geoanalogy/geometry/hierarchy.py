"""The containment hierarchy of a set of polygons (section 4.8)."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from ..errors import InputError
from ..tolerances import CONTAINED_SHARE, STRADDLING_SHARE
from .polygon import Polygon


@dataclass(frozen=True)
class Overlaps:
    """Which polygons without a stated parent intersect larger ones.

    Attributes
    ----------
    polygons : int
        Number of the polygons that were compared.
    small, large : ndarray of shape (k,), int
        Indices of the polygons of each pair.
    share : ndarray of shape (k,)
        Of the smaller one's area that lies in the larger one.
    """

    polygons: int
    small: NDArray[np.intp]
    large: NDArray[np.intp]
    share: NDArray[np.float64]


def find_overlaps(polygons: Sequence[Polygon], known: Overlaps | None = None) -> Overlaps:
    """Compare the polygons that state no parent with all that are larger.

    Parameters
    ----------
    polygons : sequence of Polygon
    known : Overlaps, optional
        Of the first of them: only pairs with another polygon are compared.

    Returns
    -------
    Overlaps
    """
    n, done = len(polygons), 0 if known is None else known.polygons
    shapes = np.array([p.shape for p in polygons], dtype=object)
    free = np.array([i for i, p in enumerate(polygons) if p.parent is None], dtype=np.intp)
    pairs = [np.zeros((2, 0), dtype=np.intp)]
    for these, first in ((free[free < done], done), (free[free >= done], 0)):
        if len(these) and first < n:
            query, found = shapely.STRtree(shapes[first:]).query(shapes[these], predicate="intersects")
            pairs.append(np.stack([these[query], found + first]))
    small, large = np.concatenate(pairs, axis=1)
    areas = np.array([p.area for p in polygons])
    # Equal areas: the one that comes first holds the other, so that two copies of a polygon are no circle.
    candidate = (areas[large] > areas[small]) | ((areas[large] == areas[small]) & (large < small))
    small, large = small[candidate], large[candidate]
    share = shapely.area(shapely.intersection(shapes[small], shapes[large])) / areas[small]
    if known is None:
        return Overlaps(n, small, large, share)
    both = ((known.small, small), (known.large, large), (known.share, share))
    return Overlaps(n, *(np.concatenate(pair) for pair in both))


def find_parents(
    polygons: Sequence[Polygon], overlaps: Overlaps | None = None
) -> tuple[NDArray[np.intp], list[list[int]]]:
    """The parent of every polygon, and the members of every polygon.

    The parent is the one a polygon names, else the smallest larger polygon that holds 95 % of its area. Members are the
    children; where a polygon without a stated parent overlaps one that is larger and neither its parent nor an
    ancestor (a door across the wall of two rooms), it is a member of that one as well, as in section 4.8, provided
    both have the same parent: it then stands in relations on both sides.

    Parameters
    ----------
    polygons : sequence of Polygon
    overlaps : Overlaps, optional
        Theirs, where they are known.

    Returns
    -------
    parents : ndarray of shape (n,), int
        Index of the parent, -1 for none.
    members : list of list of int
        Indices of the members of each polygon, ascending.

    Raises
    ------
    InputError
        Where a polygon names a parent that is not in the scene, or names form a circle.
    """
    n = len(polygons)
    parents = _stated_parents(polygons)
    members: list[set[int]] = [set() for _ in range(n)]
    straddling: list[tuple[int, int]] = []
    overlaps = find_overlaps(polygons) if overlaps is None else overlaps
    small, large, share = overlaps.small, overlaps.large, overlaps.share
    if len(small):
        areas = np.array([p.area for p in polygons])
        holds = share >= CONTAINED_SHARE
        order = np.lexsort((large[holds], areas[large[holds]], small[holds]))
        first, second = small[holds][order], large[holds][order]
        _, start = np.unique(first, return_index=True)
        parents[first[start]] = second[start]
        over = ~holds & (share >= STRADDLING_SHARE)
        straddling = list(zip(small[over].tolist(), large[over].tolist(), strict=True))
        # A room said to belong to its own table: what is stated stands, and the found link of the circle gives way.
        for circle in _circles(parents):
            found = [i for i in circle if polygons[i].parent is None]
            parents[max(found, key=lambda i: areas[i])] = -1
    for child, parent in enumerate(parents):
        if parent >= 0:
            members[parent].add(child)
    for i, j in straddling:
        if parents[i] == parents[j]:
            members[j].add(i)
    return parents, [sorted(m) for m in members]


def _stated_parents(polygons: Sequence[Polygon]) -> NDArray[np.intp]:
    """Index of the parent that each polygon names, -1 where it names none."""
    index = {p.id: i for i, p in enumerate(polygons)}
    parents = np.full(len(polygons), -1)
    for i, p in enumerate(polygons):
        if p.parent is not None:
            if p.parent not in index:
                raise InputError(
                    f"polygon {p.id!r} names the parent {p.parent!r}, which is not in the scene; "
                    "add it or leave the parent out"
                )
            parents[i] = index[p.parent]
    circles = _circles(parents)
    if circles:
        raise InputError(f"polygon {polygons[circles[0][0]].id!r} is its own ancestor; correct the stated parents")
    return parents


def _circles(parents: NDArray[np.intp]) -> list[list[int]]:
    """The circles that following the parents runs into, each once."""
    above = np.append(parents, -1)
    for _ in range(len(parents).bit_length()):
        above = above[above]  # twice as far up as before
    if (above < 0).all():
        return []
    circles: list[list[int]] = []
    done = parents < 0
    for start in range(len(parents)):
        path: dict[int, None] = {}
        i = start
        while not done[i] and i not in path:
            path[i] = None
            i = int(parents[i])
        if not done[i]:
            circles.append(list(path)[list(path).index(i) :])
        done[list(path)] = True
    return circles
