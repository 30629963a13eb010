"""Moving what has been chosen to what is most similar to the examples nearby."""

import numpy as np
from numpy.typing import NDArray

from .arrangement import Arrangement
from .boxes import union_overlap
from .construction import EQUALLY_ALIKE, ROUNDED
from .lesson import Lesson
from .signature import signature
from .survey import SAME, Survey

Array = NDArray[np.float64]

#: Proposals near a result that are looked at to refine it.
VARIANTS = 12
#: Overlap from which candidates are of the same place.
SAME_PLACE = 0.6


def refined(lesson: Lesson, arrangement: Arrangement, seen: Survey, chosen: NDArray[np.intp]) -> tuple[Array, Array]:
    """Chosen candidates, each moved to what is most similar to the examples nearby.

    The quick look tells places apart, not whether an edge follows the window's edge or its centre: of the proposals
    that were taken for the same, the full feature vector decides.

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
        To every example.
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
    return boxes, similar
