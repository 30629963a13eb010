"""One placement below one element: of flat boxes just above each other one is meant, though they do not overlap.

How surely a place is known goes with the examples' diagonal, so that a sill may be off by more than its own height. Two
sills below one window are then two guesses at one place. What stands side by side is a row, narrow windows as well.
"""

import numpy as np
from numpy.typing import NDArray

from .arrangement import Arrangement
from .boxes import interval_overlap
from .company import ALIGNED, anchors_of
from .lesson import Lesson
from .similarity import length_widths

Array = NDArray[np.float64]

#: Differences of edges, in widths of the Gaussians for a kernel size of 1, up to which two boxes may be one place.
ONE_PLACE = 6.0
#: Mean width of examples, in their mean height, from which they are flat: others as near as that overlap, or are meant.
FLAT = 4.0
#: Gap between two boxes, in their heights, up to which one is just above the other.
JUST_ABOVE = 1.0


def doubled(lesson: Lesson, arrangement: Arrangement, boxes: Array) -> NDArray[np.bool_]:
    """Whether every two boxes are guesses at one place: just above each other, and nearest to the same element.

    Parameters
    ----------
    lesson : Lesson
    arrangement : Arrangement
    boxes : ndarray of shape (n, 4)

    Returns
    -------
    ndarray of shape (n, n), bool
        False on the diagonal.
    """
    widths = length_widths(lesson.sizes[lesson.positive], 1.0)[:2]
    height = boxes[:, 3] - boxes[:, 1]
    off = np.abs(boxes[:, None] - boxes[None]) <= ONE_PLACE * np.tile(widths, 2)
    gap = np.maximum(boxes[:, None, 1] - boxes[None, :, 3], boxes[None, :, 1] - boxes[:, None, 3])
    above = (gap <= JUST_ABOVE * (height[:, None] + height[None]) / 2) & (interval_overlap(boxes, boxes, 0) >= ALIGNED)
    anchor = anchors_of(lesson, arrangement, boxes)[0]
    found = off.all(axis=2) & above & (anchor[:, None] == anchor[None])
    np.fill_diagonal(found, False)
    return np.asarray(found)


def without_doubles(lesson: Lesson, arrangement: Arrangement, boxes: Array, drawn: Array) -> NDArray[np.intp]:
    """The boxes that are no second guess at the place of a better one or of an example.

    Parameters
    ----------
    lesson : Lesson
    arrangement : Arrangement
    boxes : ndarray of shape (n, 4)
        The best first.
    drawn : ndarray of shape (k, 4)
        Examples drawn in the arrangement; where two of them are just above each other, that is meant.

    Returns
    -------
    ndarray of int
        Indices, ascending.
    """
    width, high = lesson.sizes[lesson.positive].mean(axis=0)
    if width < FLAT * high or not len(boxes):
        return np.arange(len(boxes))
    k = len(drawn)
    doubles = doubled(lesson, arrangement, np.concatenate([drawn, boxes]))
    kept = list(range(k))
    if not doubles[:k, :k].any():
        for i in range(k, len(doubles)):
            if not doubles[i, kept].any():
                kept.append(i)
        return np.array(kept[k:], dtype=np.intp) - k
    return np.arange(len(boxes))
