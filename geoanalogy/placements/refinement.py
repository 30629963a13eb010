"""Moving what has been chosen to what is most similar to the examples nearby, and to the middle of what is likely."""

import numpy as np
from numpy.typing import NDArray

from .arrangement import Arrangement
from .boxes import overlap, union_overlap
from .construction import EQUALLY_ALIKE, KEPT, ROUNDED
from .habits import CONSTRUCTED, HABIT_FLOOR
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
#: Examples from which their agreement is no accident, and how far an edge is moved for it, in widths of the Gaussians.
LEAST_AGREED, SNAPPED = 3, 1.0
#: How much a distance counts against a habit, as a scatter.
FARTHER = 0.1
#: How much the result itself counts among the likely candidates around it, as a certainty.
OWN_WEIGHT = 0.5


def refined(
    lesson: Lesson, arrangement: Arrangement, seen: Survey, chosen: NDArray[np.intp], drawn: Array, allowed: float
) -> tuple[Array, Array]:
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
    drawn : ndarray of shape (k, 4)
        Examples drawn in the arrangement.
    allowed : float
        Share of the smaller of two boxes that they may share: what would share more stays where it was.

    Returns
    -------
    boxes : ndarray of shape (c, 4)
    similarities : ndarray of shape (c, m)
        To every example, of what is most similar in the place.
    """
    boxes, similar = seen.boxes[chosen].copy(), seen.similarities[chosen].copy()
    if not len(chosen) or not len(seen.predicted):
        return boxes, similar
    if seen.chosen is not None and not lesson.habits.exact:
        return snapped(lesson, arrangement, boxes), similar
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
    if not lesson.habits.exact:
        unsure = np.flatnonzero(similar[:, p].max(axis=1) < SURE)
        if len(unsure):
            unsure = unsure[~copied(lesson, arrangement, boxes[unsure])]
            boxes[unsure] = middle(boxes[unsure], seen.boxes, seen.certainty)
        boxes = snapped(lesson, arrangement, boxes)
    else:
        # What was found by an exact rule is where the rule says: no other way of keeping relations is better.
        kept = lesson.habits.constructed(signature(arrangement, seen.boxes[chosen], 1, lesson.labels, outlines=False))
        stays = kept >= KEPT
        boxes[stays], similar[stays] = seen.boxes[chosen[stays]], seen.similarities[chosen[stays]]
    back = colliding(seen.boxes[chosen], boxes, drawn, allowed)
    boxes[back], similar[back] = seen.boxes[chosen[back]], seen.similarities[chosen[back]]
    return boxes, similar


def snapped(lesson: Lesson, arrangement: Arrangement, boxes: Array) -> Array:
    """Boxes whose edges are moved to where the examples' habits have them, if that is near.

    Where three and more examples agree closely in a coordinate of an edge, that is what the edge keeps to: a metre from
    the side, drawn by eye. Of several such coordinates the one counts in which they scatter least, and of
    those alike the nearest.

    Parameters
    ----------
    lesson : Lesson
    arrangement : Arrangement
    boxes : ndarray of shape (n, 4)

    Returns
    -------
    ndarray of shape (n, 4)
    """
    if len(lesson.positive) < LEAST_AGREED or not len(boxes):
        return boxes
    seen = signature(arrangement, boxes, 1, lesson.labels, outlines=False)
    widths = lesson.widths[:2, None, None]
    least, move = np.full((len(boxes), 2, 2), np.inf), np.zeros((len(boxes), 2, 2))
    for key, habit in lesson.habits.of.items():
        if key not in seen.boxes:
            continue
        edges = seen.boxes[key][:, 0][:, :, [0, 2]]
        off = edges - habit.middle
        off[..., 3] *= edges[..., 0] - edges[..., 1]
        near = (habit.scatter <= HABIT_FLOOR * widths) & (np.abs(off) <= SNAPPED * widths)
        cost = np.where(near, habit.scatter + FARTHER * np.abs(off), np.inf)
        best = np.argmin(cost, axis=3)[..., None]
        cost, off = (np.take_along_axis(v, best, axis=3)[..., 0] for v in (cost, off))
        move = np.where(cost < least, off, move)
        least = np.minimum(cost, least)
    found = boxes - move.transpose(0, 2, 1).reshape(-1, 4)
    kept = (found[:, 2:] > found[:, :2]).all(axis=1)
    return np.where(kept[:, None], found, boxes)


def colliding(before: Array, after: Array, drawn: Array, allowed: float) -> NDArray[np.bool_]:
    """Which boxes have to go back to where they were, so that none that was moved overlaps with another one.

    Parameters
    ----------
    before, after : ndarray of shape (c, 4)
    drawn : ndarray of shape (k, 4)
        What does not move.
    allowed : float
        Share of the smaller of two that they may share.

    Returns
    -------
    ndarray of shape (c,), bool
    """
    moved = (before != after).any(axis=1)
    back = np.zeros(len(after), dtype=bool)
    while True:
        now = np.where(back[:, None], before, after)
        shared = overlap(now, np.concatenate([now, drawn])) > allowed
        np.fill_diagonal(shared, False)
        more = shared.any(axis=1) & moved & ~back
        if not more.any():
            return back
        back |= more


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
