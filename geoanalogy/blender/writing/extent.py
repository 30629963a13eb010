"""What everything that is built lies within: few points, whatever there is of it."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

#: Lower and upper corners of boxes, each of shape (n, 3).
Boxes = tuple[Array, Array]

#: Cells of a grid over the plan, along its longer side: boxes in one cell count as one.
CELLS = 64

#: Corners of the unit cube.
CUBE = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)


def turned(low: Array, size: Array, scales: Array, places: Array) -> Boxes:
    """Level boxes round boxes that stand in their places.

    Parameters
    ----------
    low, size : ndarray of shape (n, 3)
        Lower corners and extents, in coordinates of their own.
    scales : ndarray of shape (n, 3)
    places : ndarray of shape (n, 4, 4)
        From those coordinates, times the scales, to space.

    Returns
    -------
    Boxes
    """
    turns = places[:, :3, :3]
    centre = places[:, :3, 3] + (turns @ ((low + size / 2) * scales)[:, :, None])[:, :, 0]
    half = (np.abs(turns) @ np.abs(size / 2 * scales)[:, :, None])[:, :, 0]
    return centre - half, centre + half


def outermost(several: Sequence[Boxes]) -> Array:
    """Corners of boxes that all of these lie in.

    Parameters
    ----------
    several : sequence of Boxes

    Returns
    -------
    ndarray of shape (8 k, 3)
        k is at most the square of `CELLS`.
    """
    low = np.concatenate([np.zeros((0, 3)), *(one for one, _ in several)])
    high = np.concatenate([np.zeros((0, 3)), *(one for _, one in several)])
    if not len(low):
        return low
    plan = (low[:, :2] + high[:, :2]) / 2
    size = max(float(np.ptp(plan, axis=0).max()), np.finfo(float).tiny)
    column, row = np.minimum((plan - plan.min(axis=0)) / size * CELLS, CELLS - 1).astype(np.intp).T
    cell = CELLS * row + column
    order = np.argsort(cell, kind="stable")
    starts = np.flatnonzero(np.diff(cell[order], prepend=-1))
    least, most = np.minimum.reduceat(low[order], starts), np.maximum.reduceat(high[order], starts)
    corners: Array = (least[:, None] + CUBE * (most - least)[:, None]).reshape(-1, 3)
    return corners
