"""Moving what has been chosen to what is most similar to the examples nearby, and to the middle of what is likely."""

import numpy as np
from numpy.typing import NDArray

from .arrangement import Arrangement
from .boxes import union_overlap
from .construction import EQUALLY_ALIKE, ROUNDED
from .habits import CONSTRUCTED
from .lesson import Lesson
from .signature import signature
from .survey import AROUND, SAME, Survey

Array = NDArray[np.float64]

#: Proposals near a result that are looked at to refine it.
VARIANTS = 12
#: Overlap from which candidates are of the same place.
SAME_PLACE = 0.6
#: Similarity to an example from which a result stays as it is: it is where the example says, not somewhere near.
SURE = 0.9
#: How much the result itself counts among the likely candidates around it, as a certainty.
OWN_WEIGHT = 0.5


def refined(lesson: Lesson, arrangement: Arrangement, seen: Survey, chosen: NDArray[np.intp]) -> tuple[Array, Array]:
    """Chosen candidates, each moved to what is most similar to the examples nearby, or amid what is likely.

    The quick look tells places apart, not whether an edge follows the window's edge or its centre: of the proposals
    that were taken for the same, the full feature vector decides. What is still unlike every example, where nothing is
    kept to exactly, goes to the `middle` of the candidates around it.

    Parameters
    ----------
    lesson : Lesson
    arrangement : Arrangement
    seen : Survey
    chosen : ndarray of shape (c,), int

    Returns
    -------
    boxes : ndarray of shape (c, 4)
    similarities : ndarray of shape (c, m)
        To every example, of what is most similar in the place.
    """
    boxes, similar = seen.boxes[chosen].copy(), seen.similarities[chosen].copy()
    if not len(chosen) or not len(seen.predicted) or (seen.chosen is not None and not lesson.habits.exact):
        return boxes, similar
    alike = union_overlap(boxes, seen.predicted)
    near = np.where(alike >= SAME, seen.repeats[None] + alike / 2, -1.0)
    best = np.argsort(-near, axis=1, kind="stable")[:, :VARIANTS]
    row = np.repeat(np.arange(len(chosen)), best.shape[1])
    best, valid = best.ravel(), np.take_along_axis(near, best, axis=1).ravel() >= 0
    row, best = row[valid], best[valid]
    variants, where = np.unique(best, return_inverse=True)
    matches = lesson.match(signature(arrangement, seen.predicted[variants], lesson.options.neighbours, lesson.labels))
    of_variants = lesson.similarities(matches)
    p = lesson.positive

    def quality(similarities: Array) -> Array:
        return similarities[:, p].max(axis=1) + similarities[:, p].mean(axis=1)

    # Variants from the proposals, and the candidates that were looked at, of the same place.
    among_row, among = np.nonzero(union_overlap(boxes, seen.boxes) >= SAME_PLACE)
    rows = np.concatenate([row, among_row])
    options = np.concatenate([seen.predicted[best], seen.boxes[among]])
    similarities = np.concatenate([of_variants[where.ravel()], seen.similarities[among]])
    worth = quality(similarities)
    # Ways that agree equally well differ by rounding: of those the one that deforms the examples least.
    deformed = (
        np.abs(np.log(options[:, 2:] - options[:, :2])[:, None] - np.log(lesson.sizes[p])[None]).sum(axis=2).min(axis=1)
    )
    top = np.zeros(len(chosen))
    np.maximum.at(top, rows, worth)
    order = np.lexsort((-worth, np.round(deformed, ROUNDED), worth < top[rows] - EQUALLY_ALIKE, rows))
    row, first = np.unique(rows[order], return_index=True)
    boxes[row], similar[row] = options[order[first]], similarities[order[first]]
    unsure = np.flatnonzero(similar[:, p].max(axis=1) < SURE)
    if len(unsure) and not lesson.habits.exact:
        unsure = unsure[~copied(lesson, arrangement, boxes[unsure])]
        boxes[unsure] = middle(boxes[unsure], seen.boxes, seen.certainty)
    return boxes, similar


def copied(lesson: Lesson, arrangement: Arrangement, boxes: Array) -> NDArray[np.bool_]:
    """Which boxes stand to an element just as an example stands to its own, which is of the same size.

    What is kept exactly by a box and an element of the same sizes is no estimate: a middle could only blur it.

    Parameters
    ----------
    lesson : Lesson
    arrangement : Arrangement
    boxes : ndarray of shape (n, 4)

    Returns
    -------
    ndarray of shape (n,), bool
    """
    found = np.zeros(len(boxes), dtype=bool)
    seen = signature(arrangement, boxes, 1, lesson.labels, outlines=False)
    limit = CONSTRUCTED * lesson.widths[:2, None, None]
    for key, values in seen.boxes.items():
        # From the minimum and from the maximum of the nearest element, at the low and the high edge.
        here, taught = (v[:, 0][:, :, [0, 2], :2] for v in (values, lesson.kept.boxes[key][lesson.positive]))
        found |= (np.abs(here[:, None] - taught[None]) <= limit).all(axis=(2, 3, 4)).any(axis=1)
    return found


def middle(boxes: Array, candidates: Array, certainty: Array) -> Array:
    """Boxes moved to the middle of the candidates around them, each of which counts by its certainty.

    Candidates of one place disagree about its edges; whichever of them is right, their middle overlaps with it.

    Parameters
    ----------
    boxes : ndarray of shape (c, 4)
    candidates : ndarray of shape (n, 4)
    certainty : ndarray of shape (n,)

    Returns
    -------
    ndarray of shape (c, 4)
    """
    weight = np.where(union_overlap(boxes, candidates) >= AROUND, certainty, 0.0)
    return (weight @ candidates + OWN_WEIGHT * boxes) / (weight.sum(axis=1, keepdims=True) + OWN_WEIGHT)
