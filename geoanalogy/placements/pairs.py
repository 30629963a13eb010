"""What stands on both sides of something comes in pairs: the shutters of a window, the lamps of a door.

Where examples stand beside larger elements, some on this side and some on that, every result has a twin on the other
side of its element, and so has every example. Sides are left and right in the frame of the parent: above and below are
not mirror images of each other in what stands upright.
"""

import numpy as np
from numpy.typing import NDArray

from .arrangement import Arrangement
from .boxes import BETWEEN, distances, overlap
from .lesson import Lesson
from .regression import predicted_targets
from .signature import BOX, EQUALLY_FAR, PARENT_BOX
from .survey import SURELY_ALIKE, look

Array = NDArray[np.float64]

#: Distance of its middle from that of the element, in widths, from which something stands on one side.
ONE_SIDE = 0.45
#: Gap to the element, in widths, up to which something stands beside it.
LARGEST_GAP = 1.0
#: Shared height over united height from which two things stand beside each other.
LEVEL = 0.5
#: Share of the examples that must stand beside elements of one label.
LEAST_BESIDE = 0.75
#: Shared area over the smaller one from which a twin is what it should be the twin of.
OWN_TWIN = 0.15
#: Share of a twin that may lie outside the parent.
MOST_OUTSIDE = 0.5


def paired_about(lesson: Lesson) -> str | None:
    """Label of the elements that examples stand on both sides of; None where they do not.

    Parameters
    ----------
    lesson : Lesson

    Returns
    -------
    str or None
        Of the label that most examples stand beside, the nearest one.
    """
    found = []
    for key, values in lesson.kept.boxes.items():
        if key == PARENT_BOX or key.startswith(BOX + BETWEEN):
            continue
        # Low and high edges as shares of the nearest element.
        (left, right), (bottom, top) = values[lesson.positive, 0][:, :, [0, 2], 3].transpose(1, 2, 0)
        width = right - left
        level = np.minimum(top, 1.0) - np.maximum(bottom, 0.0)
        level /= np.maximum(top, 1.0) - np.minimum(bottom, 0.0)
        gap = np.maximum(np.maximum(-right, left - 1.0), 0.0) / width
        beside = (width * (top - bottom) < 1.0) & (level >= LEVEL) & (gap <= LARGEST_GAP)
        side = ((left + right) / 2 - 0.5) / width
        both = (beside & (side > ONE_SIDE)).any() and (beside & (side < -ONE_SIDE)).any()
        if both and beside.mean() >= LEAST_BESIDE:
            found.append((-beside.mean(), gap[beside].mean(), key.removeprefix(BOX)))
    return min(found)[-1] if found else None


def twins(label: str, arrangement: Arrangement, boxes: Array) -> tuple[Array, NDArray[np.intp]]:
    """The mirror images of boxes about the middle of the element that each stands beside.

    Parameters
    ----------
    label : str
        Of the elements.
    arrangement : Arrangement
    boxes : ndarray of shape (n, 4)

    Returns
    -------
    twins : ndarray of shape (t, 4)
    of : ndarray of shape (t,), int
        Which box each is the twin of: what stands on no side, or between two elements, has none.
    """
    elements = arrangement.drawn.get(label)
    if elements is None or not len(boxes):
        return np.zeros((0, 4)), np.zeros(0, dtype=np.intp)
    far = distances(boxes, elements)
    own = elements[np.argmin(far, axis=1)]
    between = (far <= far.min(axis=1, keepdims=True) * (1 + EQUALLY_FAR)).sum(axis=1) > 1
    mirrored = boxes.copy()
    mirrored[:, [0, 2]] = (own[:, 0] + own[:, 2])[:, None] - boxes[:, [2, 0]]
    side = np.abs(mirrored[:, 0] - boxes[:, 0]) / 2 / (boxes[:, 2] - boxes[:, 0])
    apart = np.diagonal(overlap(mirrored, boxes)) <= OWN_TWIN
    of = np.flatnonzero((side > ONE_SIDE) & apart & ~between & (arrangement.share_outside(mirrored) <= MOST_OUTSIDE))
    return mirrored[of], of


def with_twins(
    lesson: Lesson, arrangement: Arrangement, present: Array, boxes: Array, similar: Array, score: Array
) -> tuple[Array, Array, Array]:
    """Results, their twins and those of the examples.

    Parameters
    ----------
    lesson : Lesson
    arrangement : Arrangement
    present : ndarray of shape (k, 4)
        Positive examples drawn here.
    boxes : ndarray of shape (n, 4)
    similar : ndarray of shape (n, m)
        To every example.
    score : ndarray of shape (n,)

    Returns
    -------
    boxes, similar, score : ndarray
        As given, and after them the twins. These are as good as what they are twins of, unless they are like
        counter-examples.
    """
    label = paired_about(lesson)
    if label is None:
        return boxes, similar, score
    more, of = twins(label, arrangement, np.concatenate([boxes, present]))
    if not len(more):
        return boxes, similar, score
    more_similar, contrast = look(lesson, arrangement, more, present)[:2]
    worth = np.concatenate([score, np.full(len(present), SURELY_ALIKE)])[of]
    if len(lesson.negative):
        worth = worth * predicted_targets(contrast, lesson.contrast.gram, lesson.targets) / lesson.targets.max()
    return np.concatenate([boxes, more]), np.concatenate([similar, more_similar]), np.concatenate([score, worth])
