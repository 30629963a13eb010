"""The containment hierarchy of a set of polygons (section 4.8)."""

from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from ..errors import InputError
from ..tolerances import CONTAINED_SHARE, STRADDLING_SHARE
from .polygon import Polygon


def find_parents(polygons: Sequence[Polygon], ids: Sequence[str | None]) -> tuple[NDArray[np.intp], list[list[int]]]:
    """The parent of every polygon, and the members of every polygon.

    The parent is the one a polygon names, else the smallest larger polygon that holds 95 % of its area. Members are the
    children; where a polygon without a stated parent overlaps one that is larger and neither its parent nor an
    ancestor (a door across the wall of two rooms), it is a member of that one as well, as in section 4.8, provided
    both have the same parent: it then stands in relations on both sides.

    Parameters
    ----------
    polygons : sequence of Polygon
    ids : sequence of str or None
        The id of each, as children name it; may repeat.

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
    parents = np.full(n, -1)
    index: dict[str | None, list[int]] = {}
    for i, name in enumerate(ids):
        index.setdefault(name, []).append(i)
    for i, p in enumerate(polygons):
        if p.parent is not None:
            named = [k for k in index.get(p.parent, []) if k != i]
            if not named:
                raise InputError(
                    f"polygon {p.id!r} names the parent {p.parent!r}, which is not in the scene; "
                    "add it or leave the parent out"
                )
            # Several of that name: the one that holds most of the child.
            held = [polygons[k].shape.intersection(p.shape).area for k in named] if len(named) > 1 else [0.0]
            parents[i] = named[int(np.argmax(held))]
    members: list[set[int]] = [set() for _ in range(n)]
    straddling: list[tuple[int, int]] = []
    free = np.flatnonzero(parents < 0)
    if len(free) and n > 1:
        shapes = np.array([p.shape for p in polygons])
        areas = np.array([p.area for p in polygons])
        small, large = shapely.STRtree(shapes).query(shapes[free], predicate="intersects")
        small = free[small]
        # Equal areas: the one that comes first holds the other, so that two copies of a polygon are no circle.
        candidate = (areas[large] > areas[small]) | ((areas[large] == areas[small]) & (large < small))
        small, large = small[candidate], large[candidate]
        share = shapely.area(shapely.intersection(shapes[small], shapes[large])) / areas[small]
        holds = share >= CONTAINED_SHARE
        order = np.lexsort((large[holds], areas[large[holds]], small[holds]))
        first, second = small[holds][order], large[holds][order]
        _, start = np.unique(first, return_index=True)
        parents[first[start]] = second[start]
        over = ~holds & (share >= STRADDLING_SHARE)
        straddling = list(zip(small[over].tolist(), large[over].tolist(), strict=True))
    _refuse_circles(polygons, parents)
    for child, parent in enumerate(parents):
        if parent >= 0:
            members[parent].add(child)
    for i, j in straddling:
        if parents[i] == parents[j]:
            members[j].add(i)
    return parents, [sorted(m) for m in members]


def _refuse_circles(polygons: Sequence[Polygon], parents: NDArray[np.intp]) -> None:
    """Raise where following the parents never ends."""
    done = parents < 0
    for start in range(len(parents)):
        path = []
        i = start
        while not done[i]:
            path.append(i)
            i = int(parents[i])
            if i in path:
                raise InputError(f"polygon {polygons[i].id!r} is its own ancestor; correct the stated parents")
        done[path] = True
