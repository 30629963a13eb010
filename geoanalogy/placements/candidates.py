"""Candidate placements (section 5.5), from exact intersections instead of a grid.

The thesis looks for the maxima of each sample's score on a dense grid and joins pairs of maxima to boxes. On a box's
edges those maxima lie where level sets of box coordinates cross: at the place that an element of the target predicts
for the low and the high edge, along x and along y, from the same element's counterpart around an example. These places
are computed as they are, without a grid: each element of the target, for each way of keeping a coordinate (from the
minimum, the maximum or the centre, each side from its own side, or as shares), predicts an extent along x and one along
y, and every two of them make a box. Extents that many elements predict are crossed with each other, whatever element
they came from: a window stands in the column of a balcony and the row of a cornice.
"""

import numpy as np
from numpy.typing import NDArray

from .arrangement import PARENT, Arrangement
from .lesson import Lesson
from .regularity import beats, mirrored_extents, rhythm
from .signature import BOX, PARENT_BOX
from .turns import flipped

Array = NDArray[np.float64]

#: Cell in which two candidates are one, as a share of the examples' mean size: smaller than what the score can tell.
CANDIDATE_CELL = 0.08
#: The same for extents that are counted.
EXTENT_CELL = 0.15
#: Ways of keeping coordinates that are tried, of the five.
WAYS = 3
#: Difference in agreement, a few times what float32 leaves of it, below which two ways are worth the same.
EQUALLY_AGREED = 1e-5
#: Cell, as a share of the candidates' one, in which predictions are equal but for rounding.
EQUAL = 1e-4
#: Digits of lengths in cells that are no rounding errors.
DIGITS_OF_CELLS = 5
#: How many of the most predicted extents are crossed, along x and along y.
CROSSED = (30, 20)
#: How many of the surest beats of rhythms are crossed.
BEATS_CROSSED = 24
#: Largest factor by which a candidate's side may differ from all the examples'.
LARGEST_STRETCH = 5.0


def extents(values: Array, low: Array, high: Array) -> Array:
    """Extents along one axis that elements predict.

    Parameters
    ----------
    values : ndarray of shape (m, 3, 4)
        Box coordinates of m examples along the axis, relative to their counterpart elements.
    low, high : ndarray of shape (e,)
        Extents of the target's elements.

    Returns
    -------
    ndarray of shape (m, e, 5, 2)
        Low and high edge, for each way of keeping the coordinates.
    """
    origin = np.stack([low, high, (low + high) / 2], axis=1)  # (e, 3)
    kept = origin[None, :, :, None] + np.stack([values[:, 0, :3], values[:, 2, :3]], axis=-1)[:, None]
    sides = np.stack([low[None] + values[:, 0, :1], high[None] + values[:, 2, 1:2]], axis=-1)[:, :, None]
    share = np.stack([values[:, 0, 3], values[:, 2, 3]], axis=-1)[:, None]
    shares = (low[:, None] + (high - low)[:, None] * share)[:, :, None]
    return np.concatenate([kept, sides, shares], axis=2)


def crossings(x: Array, y: Array) -> Array:
    """Boxes of every two extents of the same example and element.

    Parameters
    ----------
    x : ndarray of shape (..., a, 2)
    y : ndarray of shape (..., b, 2)

    Returns
    -------
    ndarray of shape (n, 4)
    """
    shape = (*x.shape[:-2], x.shape[-2], y.shape[-2])
    x = np.broadcast_to(x[..., :, None, :], (*shape, 2)).reshape(-1, 2)
    y = np.broadcast_to(y[..., None, :, :], (*shape, 2)).reshape(-1, 2)
    return np.stack([x[:, 0], y[:, 0], x[:, 1], y[:, 1]], axis=1)


def predicted(lesson: Lesson, arrangement: Arrangement) -> Array:
    """Boxes that the target's elements predict from the element of their label nearest to each example.

    Parameters
    ----------
    lesson : Lesson
    arrangement : Arrangement
        The target.

    Returns
    -------
    ndarray of shape (n, 4)
        In the arrangement's frame; some are turned inside out.
    """
    found = [_from_parent(lesson, arrangement)]
    for label in lesson.labels:
        elements = arrangement.boxes.get(label)
        values = lesson.kept.boxes[BOX + label][lesson.positive, 0]
        known = np.isfinite(values[:, 0, 0, 0])
        if elements is None or not known.any():
            continue
        weights = lesson.weights[BOX + label][lesson.positive, 0][known]
        values, weights = _with_middle(values[known]), np.concatenate([weights, weights.mean(axis=0, keepdims=True)])
        x, y = (
            np.where(
                agreed_ways(weights[:, axis])[:, None, :, None],
                extents(values[:, axis], elements[:, axis], elements[:, axis + 2]),
                np.nan,
            )
            for axis in (0, 1)
        )
        boxes = crossings(x, y)
        found.append(boxes[np.isfinite(boxes).all(axis=1)])
    return np.concatenate(found)


def _with_middle(values: Array) -> Array:
    """Coordinates of the examples and their medians: where examples scatter, their middle is the best guess."""
    return np.concatenate([values, np.median(values, axis=0, keepdims=True)])


def agreed_ways(weights: Array) -> NDArray[np.bool_]:
    """Which ways of keeping coordinates along one axis are worth trying: those in which examples agree best.

    Parameters
    ----------
    weights : ndarray of shape (m, 3, 4)
        Of the box coordinates along the axis.

    Returns
    -------
    ndarray of shape (m, 5), bool
        In the order of `extents`.
    """
    low, high = weights[:, 0], weights[:, 2]
    worth = np.concatenate([low[:, :3] + high[:, :3], low[:, :1] + high[:, 1:2], low[:, 3:] + high[:, 3:]], axis=1)
    return worth >= np.sort(worth, axis=1)[:, -WAYS, None] - EQUALLY_AGREED


def _from_parent(lesson: Lesson, arrangement: Arrangement) -> Array:
    """Boxes from the parent's own box and corners, in all eight ways that a room can be turned and mirrored.

    Which of them is meant is for the score to say: relations to segments and corners are assigned one to one, whatever
    side they are on (section 5.3).
    """
    values = _with_middle(lesson.kept.boxes[PARENT_BOX][lesson.positive, 0])
    low, high = arrangement.parent_box[None, :2], arrangement.parent_box[None, 2:]
    mirrored = flipped(values)
    found = []
    for along_x, along_y in ((0, 1), (1, 0)):
        x = [extents(v[:, along_x], low[:, 0], high[:, 0]) for v in (values, mirrored)]
        y = [extents(v[:, along_y], low[:, 1], high[:, 1]) for v in (values, mirrored)]
        found.append(crossings(np.concatenate(x, axis=2), np.concatenate(y, axis=2)))
    if not arrangement.parent_fills_box:
        corners = arrangement.turned(arrangement.outlines[PARENT].corner_vertex)
        # The distances to the nearer side of the own parent, kept from every corner, into all four quadrants.
        near = np.where(
            (np.abs(values[:, :, 0, 0]) <= np.abs(values[:, :, 2, 1]))[..., None],
            values[:, :, [0, 2], 0],
            mirrored[:, :, [0, 2], 0],
        )
        for order in ((0, 1), (1, 0)):
            ways = [np.stack([s, s[..., ::-1] * -1], axis=1) for s in (near[:, order[0]], near[:, order[1]])]
            x, y = (corners[None, :, None, None, axis] + ways[axis][:, None] for axis in (0, 1))
            found.append(crossings(x, y))
    return np.concatenate(found)


def most_predicted(low: Array, high: Array, cell: float, count: int) -> Array:
    """The extents predicted most often.

    Parameters
    ----------
    low, high : ndarray of shape (n,)
        From the parent's centre, so that a mirrored drawing has mirrored cells.
    cell : float
        Extents in the same cell of this size are one.
    count : int

    Returns
    -------
    ndarray of shape (at most count, 2)
        Their mean low and high edges.
    """
    cells = _cells(np.stack([low, high], axis=1), cell)
    _, group, number = np.unique(cells, return_inverse=True, return_counts=True)
    mean = np.stack([np.bincount(group, low), np.bincount(group, high)], axis=1) / number[:, None]
    order = np.argsort(-number, kind="stable")
    if len(order) > count:
        # Which of equally frequent extents come first is an accident of order: all of them, or none.
        tied = number >= number[order[count - 1]]
        order = np.flatnonzero(tied if tied.sum() <= 2 * count else number > number[order[count - 1]])
    return mean[order]


def distinct(boxes: Array, repeats: NDArray[np.intp], cell: Array) -> Array:
    """One box of each cell of a grid in (x0, y0, x1, y1): the one predicted most often, else nearest to the mean.

    Two boxes are equally near to their mean: then the smaller one counts, else the one nearer to the parent's centre.

    Parameters
    ----------
    boxes : ndarray of shape (n, 4)
        From the parent's centre, so that a mirrored drawing has mirrored cells.
    repeats : ndarray of shape (n,), int
        How often each was predicted.
    cell : ndarray of shape (4,)

    Returns
    -------
    ndarray of shape (m, 4)
    """
    if not len(boxes):
        return boxes
    _, group, number = np.unique(_cells(boxes, cell), return_inverse=True, return_counts=True)
    mean = np.stack([np.bincount(group, column) for column in boxes.T], axis=1) / number[:, None]
    off = np.abs(boxes - mean[group]) / cell
    extent = (boxes[:, 2:] - boxes[:, :2]) / cell[:2]
    away = np.abs(boxes[:, 2:] + boxes[:, :2]) / cell[:2]
    # All but rounding apart, which must not choose.
    near, size, far = (np.round(part.sum(axis=1), DIGITS_OF_CELLS) for part in (off, extent, away))
    order = np.lexsort((far, size, near, -repeats, group))
    return boxes[order[np.concatenate([[0], np.cumsum(number)[:-1]])]]


def _cells(values: Array, cell: Array | float) -> NDArray[np.int64]:
    """The cell of a grid that each row of values lies in, as one integer."""
    return _mixed(np.round(values / cell).astype(np.int64))


def _mixed(keys: NDArray[np.int64]) -> NDArray[np.int64]:
    """One integer per row of cell numbers; rows that differ collide only across the whole range of int64."""
    mixed = np.zeros(len(keys), dtype=np.int64)
    for column in keys.T:
        mixed = mixed * 1000003 + column
    return mixed


def predictions(lesson: Lesson, arrangement: Arrangement) -> tuple[Array, NDArray[np.intp]]:
    """The boxes that elements predict, each once.

    Parameters
    ----------
    lesson : Lesson
    arrangement : Arrangement
        The target.

    Returns
    -------
    boxes : ndarray of shape (n, 4)
        With positive sides, of about the examples' size; in the arrangement's frame.
    repeats : ndarray of shape (n,), int
        How often each was predicted.
    """
    found = predicted(lesson, arrangement)
    if lesson.options.mirrored:
        found = np.hstack([np.minimum(found[:, :2], found[:, 2:]), np.maximum(found[:, :2], found[:, 2:])])
    sizes = lesson.sizes[lesson.positive]
    found = found[plausible(found, sizes)]
    cells = _cells(found - _centre(arrangement), EQUAL * CANDIDATE_CELL * np.tile(sizes.mean(axis=0), 2))
    _, first, repeats = np.unique(cells, return_index=True, return_counts=True)
    return found[first], repeats


def _centre(arrangement: Arrangement) -> Array:
    return np.tile((arrangement.parent_box[:2] + arrangement.parent_box[2:]) / 2, 2)


def proposals(
    lesson: Lesson,
    arrangement: Arrangement,
    present: Array,
    boxes: Array,
    repeats: NDArray[np.intp],
    copied: Array | None = None,
) -> Array:
    """Every candidate that is worth a look: the predictions that differ, and crossings of their extents.

    Parameters
    ----------
    lesson : Lesson
    arrangement : Arrangement
        The target.
    present : ndarray of shape (m, 4)
        Positive examples that were drawn in this very arrangement.
    boxes, repeats : ndarray of shape (n, 4) and (n,)
        See `predictions`.
    copied : ndarray of shape (k, 4), optional
        More candidates.

    Returns
    -------
    ndarray of shape (p, 4)
    """
    centre = _centre(arrangement)
    size = lesson.sizes[lesson.positive].mean(axis=0)
    if copied is not None:
        copied = copied[plausible(copied, lesson.sizes[lesson.positive])]
        boxes = np.concatenate([boxes, copied])
        repeats = np.concatenate([repeats, np.ones(len(copied), dtype=np.intp)])
    cell = CANDIDATE_CELL * np.tile(size, 2)
    found = distinct(boxes - centre, repeats, cell)
    more = crossed(found, present - centre, size, arrangement.parent_box - centre)
    first = np.repeat([1, 0], [len(found), len(more)])  # what was predicted stays as it is
    return distinct(np.concatenate([found, more]), first, cell) + centre


def crossed(boxes: Array, present: Array, size: Array, parent: Array) -> Array:
    """The most predicted extents along x crossed with those along y, and with the rows and columns of examples there.

    Parameters
    ----------
    boxes : ndarray of shape (n, 4)
    present : ndarray of shape (m, 4)
    size : ndarray of shape (2,)
        The examples' mean.
    parent : ndarray of shape (4,)
        The parent's box.

    Returns
    -------
    ndarray of shape (k, 4)
    """
    x, y = (
        np.concatenate(
            [
                continued(present[:, [axis, axis + 2]], parent[axis], parent[axis + 2]),
                most_predicted(boxes[:, axis], boxes[:, axis + 2], EXTENT_CELL * size[axis], CROSSED[axis]),
            ]
        )
        for axis in (0, 1)
    )
    return crossings(x, y)


def continued(present: Array, low: float, high: float) -> Array:
    """Extents of rows (or columns) that examples stand in, and of those that follow from them.

    Parameters
    ----------
    present : ndarray of shape (m, 2)
        Low and high edges of the examples.
    low, high : float
        Extent of the parent.

    Returns
    -------
    ndarray of shape (n, 2)
    """
    if not len(present):
        return present
    at, trust = beats(present, low, high)
    surest = at[np.argsort(-trust, kind="stable")[:BEATS_CROSSED]]
    return np.concatenate([present, rhythm(present), mirrored_extents(present, low, high), surest])


def plausible(boxes: Array, sizes: Array) -> NDArray[np.bool_]:
    """Which boxes are not turned inside out, and no more than `LARGEST_STRETCH` times smaller or larger than examples.

    Parameters
    ----------
    boxes : ndarray of shape (n, 4)
    sizes : ndarray of shape (m, 2)
        Of the examples.

    Returns
    -------
    ndarray of shape (n,), bool
    """
    size = boxes[:, 2:] - boxes[:, :2]
    return ((size > sizes.min(axis=0) / LARGEST_STRETCH) & (size < sizes.max(axis=0) * LARGEST_STRETCH)).all(axis=1)
