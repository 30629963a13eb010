"""Examples on their own: where nothing that is drawn says where more are meant, their rows and columns go on evenly.

Three windows on a plain facade have relations to its edges and to each other, and to nothing that is repeated. What is
meant then is what they show: the same size, the same gaps, in the same rows.
"""

import numpy as np
from numpy.typing import NDArray

from .arrangement import Arrangement
from .boxes import interval_overlap
from .candidates import crossings
from .company import ALIGNED
from .evidence import excess
from .lesson import Lesson
from .regularity import LEAST_STEP, alignment, rows_of
from .signature import BOX

Array = NDArray[np.float64]

#: Agreement of examples with elements along an axis from which these say where more are meant.
SPEAKS = 0.5
#: Largest distance of a row from its place, in sizes and as a share of the step: drawn by eye, not irregular.
OFF_SIZE, OFF_STEP = 0.15, 0.1
#: Into how many steps the least distance of two rows may be divided so that all rows keep them.
MOST_PARTS = 2
#: Excess over the examples, of what a box covers and of what lies outside the parent, up to which it is no obstacle.
CLEAR = 0.02
#: Certainty of what fills the rows of examples, and of what continues them.
FILLS, CONTINUES = 0.9, 0.75


def lattice(extents_along: Array, low: float, high: float) -> Array | None:
    """Rows at one distance that all rows of examples keep, throughout the parent.

    Parameters
    ----------
    extents_along : ndarray of shape (n, 2)
        Low and high edges of examples along one axis.
    low, high : float
        Extent of the parent.

    Returns
    -------
    ndarray of shape (m, 2) or None
        All of the mean size; a single row is the only one. None where rows keep no distance.
    """
    rows = rows_of(extents_along)
    size = float((extents_along[:, 1] - extents_along[:, 0]).mean())
    middle = rows.mean(axis=1)
    if len(rows) < 2:
        return middle[:, None] + np.array([-0.5, 0.5]) * size
    for parts in range(1, MOST_PARTS + 1):
        step = float(np.diff(middle).min()) / parts
        if step < LEAST_STEP * size:
            return None
        number = np.round((middle - middle[0]) / step)
        step, start = (float(v) for v in np.polyfit(number, middle, 1))
        if np.abs(middle - start - step * number).max() <= min(OFF_SIZE * size, OFF_STEP * step):
            break
    else:
        return None
    margin = max(min((step - size) / 2, float(rows[0, 0]) - low, high - float(rows[-1, 1])), 0.0) + size / 2
    # What nearly keeps the margin keeps it: it was drawn by eye as well.
    slack = OFF_STEP * (step - size)
    first = min(np.ceil((low + margin - slack - start) / step), 0)
    last = max(np.floor((high - margin + slack - start) / step), number[-1])
    at = start + step * np.arange(first, last + 1)
    return at[:, None] + np.array([-0.5, 0.5]) * size


def is_silent(lesson: Lesson, arrangement: Arrangement, present: Array, axis: int) -> bool:
    """Whether no elements say where along an axis more is meant than the examples themselves show.

    Elements do that which examples of different rows agree with along the axis, or which their rows stand in line with,
    where there are several of them.

    Parameters
    ----------
    lesson : Lesson
    arrangement : Arrangement
    present : ndarray of shape (m, 4)
        Positive examples drawn here.
    axis : int
        0: where columns are; 1: where rows are.

    Returns
    -------
    bool
    """
    here = [i for i in lesson.positive if lesson.taught[i].fingerprint == arrangement.fingerprint]
    drawn = np.array([lesson.taught[i].rectangle.box(arrangement.frame)[0] for i in here])
    others = interval_overlap(drawn, drawn, axis) < ALIGNED
    if not others.any():  # a single row agrees with all that it runs along
        others = ~np.eye(len(here), dtype=bool)
    for label, elements in arrangement.boxes.items():
        match = lesson.among_examples.get(BOX + label)
        if match is None:
            continue
        agreement = np.where(others, (match.along_x, match.along_y)[axis][np.ix_(here, here)], 0.0)
        if agreement.max(axis=1).mean() >= SPEAKS and _is_repeated(elements, axis):
            return False
    labels = {label: elements for label, elements in arrangement.drawn.items() if _is_repeated(elements, axis)}
    return bool(alignment(present, present, labels, axis)[0].max() < SPEAKS)


def _is_repeated(elements: Array, axis: int) -> bool:
    """Whether elements stand in more than one row or column."""
    return len(rows_of(elements[:, [axis, axis + 2]])) > 1


def regular(lesson: Lesson, arrangement: Arrangement, present: Array) -> tuple[Array, Array] | None:
    """Boxes where rows and columns of examples go on evenly, in an arrangement of which nothing else tells anything.

    Parameters
    ----------
    lesson : Lesson
    arrangement : Arrangement
    present : ndarray of shape (m, 4)
        Positive examples drawn here.

    Returns
    -------
    boxes : ndarray of shape (n, 4)
    certainty : ndarray of shape (n,)
        None of both where elements tell more, or examples stand in no rows at regular distances.
    """
    if len(present) < 2:
        return None
    box = arrangement.parent_box
    along = [present[:, [axis, axis + 2]] for axis in (0, 1)]
    if all(len(rows_of(extents)) == len(present) for extents in along):
        return None  # each in a row and a column of its own
    x, y = (lattice(along[axis], box[axis], box[axis + 2]) for axis in (0, 1))
    if x is None or y is None or not all(is_silent(lesson, arrangement, present, axis) for axis in (0, 1)):
        return None
    boxes = crossings(x, y)
    covered, _, touched, outside = excess(lesson, arrangement, boxes)
    boxes = boxes[np.maximum(covered, np.maximum(touched, outside)) <= CLEAR]
    middle = (boxes[:, :2] + boxes[:, 2:]) / 2
    within = ((middle >= present[:, :2].min(axis=0)) & (middle <= present[:, 2:].max(axis=0))).all(axis=1)
    return boxes, np.where(within, FILLS, CONTINUES)
