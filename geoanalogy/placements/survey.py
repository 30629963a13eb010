"""From a lesson and an arrangement to rated candidates: propose, glance, look, grow, settle."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .arrangement import Arrangement
from .boxes import interval_overlap, union_overlap
from .calibration import ABROAD, AT_HOME
from .candidates import crossings, predictions, proposals, rhythm, rows_of
from .evidence import Company, anchors_of, single_evidence
from .lesson import Lesson
from .selection import thin, without_overlaps
from .signature import signature

Array = NDArray[np.float64]

#: Candidates that get a full look, and that may be added when rows and columns are continued.
LOOKED_AT, GROWN = 300, 150
#: Proposals near a result that are looked at to refine it.
VARIANTS = 12
#: Difference in similarity, a few times what float32 leaves of it, below which two boxes are alike.
EQUALLY_ALIKE = 1e-4
#: Overlap from which candidates are of the same place.
SAME_PLACE = 0.6
#: Overlap from which two candidates are the same.
SAME = 0.75
#: Overlap with an example from which a candidate is that example again.
EXAMPLE_AGAIN = 0.5
#: Meetings of rows and columns that are tried for every one that may be added.
MOST_MET = 4
#: Certainty from which a candidate's extents are continued across the arrangement.
CONTINUED = 0.15


@dataclass(frozen=True)
class Survey:
    """Candidates of one arrangement.

    Attributes
    ----------
    boxes : ndarray of shape (n, 4)
    company : Company
        The candidates among each other.
    similarities : ndarray of shape (n, m)
        To every example.
    single, among, settled : ndarray of shape (n, …)
        Evidence of each candidate, among the others by similarity, and by certainty.
    certainty : ndarray of shape (n,)
        How surely each is meant, 0 to 1.
    predicted : ndarray of shape (p, 4)
        All that elements predict; the candidates are those that differ.
    repeats : ndarray of shape (p,), int
        How often each is predicted.
    """

    boxes: Array
    company: Company
    similarities: Array
    single: Array
    among: Array
    settled: Array
    certainty: Array
    predicted: Array
    repeats: NDArray[np.intp]


def glance(
    lesson: Lesson, arrangement: Arrangement, present: Array, predicted: Array, repeats: NDArray[np.intp]
) -> tuple[Array, Array]:
    """All proposals and quick evidence on them, from the nearest element of every label alone.

    Parameters
    ----------
    lesson : Lesson
    arrangement : Arrangement
    present : ndarray of shape (m, 4)
        Positive examples drawn here.
    predicted, repeats : ndarray of shape (p, 4) and (p,)
        See `predictions`.

    Returns
    -------
    boxes : ndarray of shape (n, 4)
    evidence : ndarray of shape (n, len(SINGLE))
    """
    boxes = proposals(lesson, arrangement, present, predicted, repeats)
    seen = signature(arrangement, boxes, 1, lesson.labels, outlines=not arrangement.parent_fills_box)
    return boxes, single_evidence(lesson, arrangement, boxes, seen, lesson.match(seen, 1), present)


def survey(lesson: Lesson, arrangement: Arrangement, present: Array, shown: Array) -> Survey:
    """Rated candidates of an arrangement.

    Parameters
    ----------
    lesson : Lesson
    arrangement : Arrangement
    present : ndarray of shape (m, 4)
        Positive examples drawn here.
    shown : ndarray of shape (k, 4)
        All examples drawn here: no candidate repeats them.

    Returns
    -------
    Survey
    """
    judge = AT_HOME if len(present) else ABROAD
    predicted, repeats = predictions(lesson, arrangement)
    proposed, quick = glance(lesson, arrangement, present, predicted, repeats)
    boxes = _without_shown(proposed[thin(proposed, judge.glance.certainty(quick), SAME, LOOKED_AT)], shown)
    similar, single = look(lesson, arrangement, boxes, present)
    company = Company(boxes, present, anchors_of(lesson, arrangement, np.concatenate([boxes, present])))
    among = company.evidence(similar[:, lesson.positive].max(axis=1, initial=0.0))
    first = judge.look.certainty(np.hstack([single, among]))
    more = _without_shown(_continued(boxes, first, present, arrangement), shown)
    if len(more):
        more_similar, more_single = look(lesson, arrangement, more, present)
        boxes = np.concatenate([boxes, more])
        similar = np.concatenate([similar, more_similar])
        single = np.concatenate([single, more_single])
        company = Company(boxes, present, anchors_of(lesson, arrangement, np.concatenate([boxes, present])))
        among = company.evidence(similar[:, lesson.positive].max(axis=1, initial=0.0))
        first = judge.look.certainty(np.hstack([single, among]))
    settled = np.hstack([judge.look.value(np.hstack([single, among]))[:, None], company.evidence(first)])
    certainty = judge.settle.certainty(np.hstack([single, among, settled]))
    return Survey(boxes, company, similar, single, among, settled, certainty, predicted, repeats)


def look(lesson: Lesson, arrangement: Arrangement, boxes: Array, present: Array) -> tuple[Array, Array]:
    """Similarities (n, m) and evidence (n, len(SINGLE)) of boxes from all their relations.

    Parameters
    ----------
    lesson : Lesson
    arrangement : Arrangement
    boxes : ndarray of shape (n, 4)
    present : ndarray of shape (m, 4)

    Returns
    -------
    similarities, evidence : ndarray
    """
    seen = signature(arrangement, boxes, lesson.options.neighbours, lesson.labels)
    matches = lesson.match(seen)
    return lesson.similarities(matches), single_evidence(lesson, arrangement, boxes, seen, matches, present)


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
    if not len(chosen):
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
    order = np.lexsort((deformed, worth < top[rows] - EQUALLY_ALIKE, rows))
    row, first = np.unique(rows[order], return_index=True)
    boxes[row], similar[row] = options[order[first]], similarities[order[first]]
    return boxes, similar


def _without_shown(boxes: Array, shown: Array) -> Array:
    return boxes[(union_overlap(boxes, shown) <= EXAMPLE_AGAIN).all(axis=1)] if len(shown) else boxes


def _continued(boxes: Array, certainty: Array, present: Array, arrangement: Arrangement) -> Array:
    """Boxes where the rows and columns of likely candidates and of examples meet, as far as they are no candidates yet.

    What people place by the dozen stands in rows and columns; a place whose own surroundings say little is still where
    a row that is sure meets a column that is sure.
    """
    likely = without_overlaps(boxes, certainty, present, 0.1)
    likely = likely[certainty[likely] >= CONTINUED]
    every = np.concatenate([present, boxes[likely]])
    if len(every) < 2:
        return np.zeros((0, 4))
    x, y = (rows_of(every[:, [a, a + 2]]) for a in (0, 1))
    meetings = crossings(np.concatenate([x, rhythm(x)]), np.concatenate([y, rhythm(y)]))
    weight = np.concatenate([np.ones(len(present)), certainty[likely]])
    support = np.prod([(interval_overlap(meetings, every, a) * weight).sum(axis=1) for a in (0, 1)], axis=0)
    best = np.argsort(-support, kind="stable")[: MOST_MET * GROWN]
    meetings = meetings[best]
    new = union_overlap(meetings, boxes).max(axis=1, initial=0.0) < SAME
    return meetings[new & (arrangement.share_outside(meetings) <= 0.5)][:GROWN]
