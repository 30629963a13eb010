"""From a lesson and an arrangement to rated candidates: propose, glance, look, grow, settle."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .arrangement import Arrangement
from .boxes import union_overlap
from .calibration import GLANCE, LOOK, SETTLE
from .candidates import crossings, most_predicted, proposals
from .evidence import among_evidence, single_evidence
from .lesson import Lesson
from .selection import thin, without_overlaps
from .signature import signature

Array = NDArray[np.float64]

#: Candidates that get a full look, and that may be added when rows and columns are continued.
LOOKED_AT, GROWN = 400, 150
#: Overlap from which two candidates are the same.
SAME = 0.75
#: Overlap with an example from which a candidate is that example again.
EXAMPLE_AGAIN = 0.5
#: Certainty from which a candidate's extents are continued across the arrangement.
CONTINUED = 0.15
#: Extents that are continued along each axis, at most.
MOST_CONTINUED = 30


@dataclass(frozen=True)
class Survey:
    """Candidates of one arrangement.

    Attributes
    ----------
    boxes : ndarray of shape (n, 4)
    similarities : ndarray of shape (n, m)
        To every example.
    single, among, settled : ndarray of shape (n, …)
        Evidence of each candidate, among the others by similarity, and by certainty.
    certainty : ndarray of shape (n,)
        How surely each is meant, 0 to 1.
    """

    boxes: Array
    similarities: Array
    single: Array
    among: Array
    settled: Array
    certainty: Array


def glance(lesson: Lesson, arrangement: Arrangement, present: Array) -> tuple[Array, Array]:
    """All proposals and quick evidence on them, from the nearest element of every label alone.

    Parameters
    ----------
    lesson : Lesson
    arrangement : Arrangement
    present : ndarray of shape (m, 4)
        Positive examples drawn here.

    Returns
    -------
    boxes : ndarray of shape (n, 4)
    evidence : ndarray of shape (n, len(SINGLE))
    """
    boxes = proposals(lesson, arrangement, present)
    seen = signature(arrangement, boxes, 1, lesson.labels, outlines=not arrangement.parent_fills_box)
    return boxes, single_evidence(lesson, arrangement, boxes, lesson.match(seen, 1), present)


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
    boxes, quick = glance(lesson, arrangement, present)
    boxes = _without_shown(boxes[thin(boxes, GLANCE.certainty(quick), SAME, LOOKED_AT)], shown)
    similar, single = look(lesson, arrangement, boxes, present)
    among = among_evidence(boxes, similar[:, lesson.positive].max(axis=1, initial=0.0), present)
    first = LOOK.certainty(np.hstack([single, among]))
    more = _without_shown(_continued(boxes, first, present, lesson, arrangement), shown)
    if len(more):
        more_similar, more_single = look(lesson, arrangement, more, present)
        boxes = np.concatenate([boxes, more])
        similar = np.concatenate([similar, more_similar])
        single = np.concatenate([single, more_single])
        among = among_evidence(boxes, similar[:, lesson.positive].max(axis=1, initial=0.0), present)
        first = LOOK.certainty(np.hstack([single, among]))
    settled = np.hstack([LOOK.value(np.hstack([single, among]))[:, None], among_evidence(boxes, first, present)])
    certainty = SETTLE.certainty(np.hstack([single, among, settled]))
    return Survey(boxes, similar, single, among, settled, certainty)


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
    matches = lesson.match(signature(arrangement, boxes, lesson.options.neighbours, lesson.labels))
    return lesson.similarities(matches), single_evidence(lesson, arrangement, boxes, matches, present)


def _without_shown(boxes: Array, shown: Array) -> Array:
    return boxes[(union_overlap(boxes, shown) <= EXAMPLE_AGAIN).all(axis=1)] if len(shown) else boxes


def _continued(boxes: Array, certainty: Array, present: Array, lesson: Lesson, arrangement: Arrangement) -> Array:
    """Boxes where the rows and columns of likely candidates and of examples meet, as far as they are no candidates yet.

    What people place by the dozen stands in rows and columns; a place whose own surroundings say little is still where
    a row that is sure meets a column that is sure.
    """
    likely = without_overlaps(boxes, certainty, present, 0.1)
    likely = likely[certainty[likely] >= CONTINUED]
    every = np.concatenate([present, boxes[likely]])
    if len(every) < 2:
        return np.zeros((0, 4))
    size = lesson.sizes[lesson.positive].mean(axis=0)
    centre = (arrangement.parent_box[:2] + arrangement.parent_box[2:]) / 2
    x, y = (
        most_predicted(every[:, a] - centre[a], every[:, a + 2] - centre[a], 2 * 0.15 * size[a], MOST_CONTINUED)
        for a in (0, 1)
    )
    crossed = crossings(x, y) + np.tile(centre, 2)
    known = union_overlap(crossed, boxes).max(axis=1, initial=0.0) >= SAME
    return crossed[~known][:GROWN]
