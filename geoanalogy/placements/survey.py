"""From a lesson and an arrangement to rated candidates: propose, glance, look, grow, settle."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .arrangement import Arrangement
from .boxes import interval_overlap, overlap, union_overlap
from .calibration import ABROAD, ALONE, AT_HOME, Judgement
from .candidates import crossings, predictions, proposals
from .company import Company, anchors_of
from .construction import EQUALLY_ALIKE, constructed_boxes, construction, is_constructed
from .evidence import like_parents, single_evidence
from .lattice import regular
from .lesson import Lesson, Match
from .one_each import copies, copy_evidence
from .own_elements import astray
from .regularity import beats, rhythm, rows_of
from .selection import shape_factor, thin, without_overlaps
from .signature import Signature, signature

Array = NDArray[np.float64]

#: Least and most candidates that get a full look, and the certainty at a glance from which they do.
LOOKED_AT, WORTH_A_LOOK = (100, 600), 0.25
#: Candidates that get one where a parent holds one placement, none of which is likely at a glance, and the overlap from
#: which two of those are the same.
LOOKED_AT_ALONE, SAME_ALONE = 300, 0.7
#: Candidates that may be added when rows and columns are continued.
GROWN = 150
#: Overlap from which two candidates are the same.
SAME = 0.65
#: Share of the smaller of both that a candidate and an example share at most.
EXAMPLE_AGAIN = 0.4
#: Meetings of rows and columns that are tried for every one that may be added.
MOST_MET = 4
#: Similarity from which a candidate is like an example, the certainty of its equal, and the similarity below
#: which candidates are something else.
ALIKE, SURELY_ALIKE, UNLIKE = 0.85, 0.9, 0.7
#: Overlap with a candidate from which others are around it: of its place, with other edges.
AROUND = 0.3
#: By what the odds are multiplied of what keeps to what all examples keep to exactly, for every example that confirms
#: another one (a single one for itself), as long as these are few; and of what does not.
EXACT, INEXACT, MOST_FAVOURS = 3.0, 0.1, 4
#: Examples from which what they keep to exactly is no accident: elements then predict all that is meant, rows nothing.
FEW_EXACT = 3
#: Certainty from which a candidate's extents are continued across the arrangement.
CONTINUED = 0.15


@dataclass(frozen=True)
class Survey:
    """Candidates of one arrangement.

    Attributes
    ----------
    boxes : ndarray of shape (n, 4)
    similarities, contrast : ndarray of shape (n, m)
        To every example; and by what tells examples and counter-examples apart.
    certainty : ndarray of shape (n,)
        How surely each is meant, 0 to 1.
    predicted : ndarray of shape (p, 4)
        All that elements predict; the candidates are those that differ. Nothing where they follow from a rule.
    repeats : ndarray of shape (p,), int
        How often each is predicted.
    chosen : int or None
        The one candidate, where every parent holds one.
    """

    boxes: Array
    similarities: Array
    contrast: Array
    certainty: Array
    predicted: Array
    repeats: NDArray[np.intp]
    chosen: int | None = None


@dataclass(frozen=True)
class Grounds:
    """What the certainty of searched candidates rests on.

    Attributes
    ----------
    company : Company
        The candidates among each other.
    single, among, settled : ndarray of shape (n, …)
        Evidence of each candidate, among the others by similarity, and by certainty.
    """

    company: Company
    single: Array
    among: Array
    settled: Array


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
    more = copies(lesson, arrangement) if is_alone(lesson, present) else None
    boxes = proposals(lesson, arrangement, present, predicted, repeats, more)
    outlines = is_alone(lesson, present) or not arrangement.parent_fills_box
    seen = signature(arrangement, boxes, 1, lesson.labels, outlines)
    return boxes, _evidence(lesson, arrangement, boxes, seen, lesson.match(seen, 1), present, 1)


def is_alone(lesson: Lesson, present: Array) -> bool:
    """Whether an arrangement is to hold one placement, as those of the examples do.

    Parameters
    ----------
    lesson : Lesson
    present : ndarray of shape (m, 4)
        Positive examples drawn in it.

    Returns
    -------
    bool
    """
    return lesson.one_each and not len(present)


def judgement_of(lesson: Lesson, present: Array) -> Judgement:
    """The models that rate the candidates of an arrangement.

    Parameters
    ----------
    lesson : Lesson
    present : ndarray of shape (m, 4)
        Positive examples drawn in it.

    Returns
    -------
    Judgement
    """
    if len(present):
        return AT_HOME
    return ALONE if lesson.one_each else ABROAD


def _evidence(
    lesson: Lesson,
    arrangement: Arrangement,
    boxes: Array,
    seen: Signature,
    matches: dict[str, Match],
    present: Array,
    neighbours: int,
) -> Array:
    """Evidence of single candidates, that of copies included where there is one placement."""
    single = single_evidence(lesson, arrangement, boxes, seen, matches, present)
    if not is_alone(lesson, present):
        return single
    like = like_parents(lesson, arrangement)
    return np.hstack([single, copy_evidence(lesson, arrangement, boxes, seen, like, neighbours)])


def survey(lesson: Lesson, arrangement: Arrangement, present: Array, shown: Array) -> Survey:
    """Rated candidates of an arrangement: what follows from a rule, or from rows of examples alone, or else a search.

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
    if is_alone(lesson, present) and is_constructed(lesson):
        made = construction(lesson, arrangement)
        if made is not None:
            nothing = np.zeros((0, 4)), np.zeros(0, dtype=np.intp)
            similar = made.similarities
            return Survey(made.boxes, similar, similar, made.certainty, *nothing, 0 if len(made.boxes) else None)
    even = regular(lesson, arrangement, present)
    if even is not None:
        new = _unlike_shown(even[0], shown)
        boxes, certainty = even[0][new], even[1][new]
        similar, contrast, *_ = look(lesson, arrangement, boxes, present)
        return Survey(boxes, similar, contrast, certainty, np.zeros((0, 4)), np.zeros(0, dtype=np.intp))
    return search(lesson, arrangement, present, shown)[0]


def search(lesson: Lesson, arrangement: Arrangement, present: Array, shown: Array) -> tuple[Survey, Grounds]:
    """Rated candidates of an arrangement, from all that its elements predict.

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
    survey : Survey
    grounds : Grounds
    """
    judge = judgement_of(lesson, present)
    predicted, repeats = predictions(lesson, arrangement)
    proposed, quick = glance(lesson, arrangement, present, predicted, repeats)
    worth = judge.glance.certainty(quick)
    if judge.choose is None and lesson.habits.exact and len(lesson.positive) >= FEW_EXACT:
        # What follows from an exact rule is looked at first: what nearly repeats it is not what was drawn.
        made = constructed_boxes(lesson, arrangement)[0]
        proposed = np.concatenate([made, proposed])
        worth = np.concatenate([np.ones(len(made)), worth])
    new = _unlike_shown(proposed, shown)
    proposed, worth = proposed[new], worth[new]
    if judge.choose is None:
        boxes = proposed[_worth_a_look(proposed, worth)]
    else:
        boxes = proposed[thin(proposed, worth, SAME_ALONE, LOOKED_AT_ALONE)]
    similar, contrast, exact, strays, single = look(lesson, arrangement, boxes, present)
    company = Company(boxes, present, anchors_of(lesson, arrangement, np.concatenate([boxes, present])))
    among = company.evidence(similar[:, lesson.positive].max(axis=1, initial=0.0))
    first = judge.look.certainty(np.hstack([single, among]))
    more = np.zeros((0, 4))
    if len(lesson.positive) < FEW_EXACT or not lesson.habits.exact:
        more = _continued(boxes, first, present, arrangement)
        more = more[_unlike_shown(more, shown)]
    if len(more):
        more_similar, more_contrast, more_exact, more_strays, more_single = look(lesson, arrangement, more, present)
        boxes = np.concatenate([boxes, more])
        similar = np.concatenate([similar, more_similar])
        contrast = np.concatenate([contrast, more_contrast])
        exact = np.concatenate([exact, more_exact])
        strays = np.concatenate([strays, more_strays])
        single = np.concatenate([single, more_single])
        company = Company(boxes, present, anchors_of(lesson, arrangement, np.concatenate([boxes, present])))
        among = company.evidence(similar[:, lesson.positive].max(axis=1, initial=0.0))
        first = judge.look.certainty(np.hstack([single, among]))
    settled = np.hstack([judge.look.value(np.hstack([single, among]))[:, None], company.evidence(first)])
    every = np.hstack([single, among, settled])
    certainty = np.maximum(judge.settle.certainty(every), likeness(similar[:, lesson.positive]))
    # What keeps exactly to what examples keep to exactly follows the rule, whatever the weights say; the rest does not.
    favour = EXACT ** np.clip(len(lesson.positive) - 1, 1, MOST_FAVOURS)
    exactness = np.where(np.isnan(exact), 0.0, (1 - exact) * np.log(INEXACT) + exact * np.log(favour))
    certainty = more_certain(certainty, exactness + strays)
    follows = exact >= 1 - EQUALLY_ALIKE
    if follows.any():
        repeats_it = union_overlap(boxes, boxes[follows]).max(axis=1) >= SAME
        certainty[repeats_it & ~follows] = 0.0
    chosen = None
    if judge.choose is not None and len(boxes):
        chosen, middle = one_of(lesson, boxes, judge.choose.value(every) + exactness)
        if not lesson.habits.exact and (middle[2:] > middle[:2]).all():
            # Nothing is exact about it: no single candidate is better than the middle of those that are likely.
            boxes[chosen] = middle
            similar[chosen] = look(lesson, arrangement, middle[None], present)[0][0]
    return (
        Survey(boxes, similar, contrast, certainty, predicted, repeats, chosen),
        Grounds(company, single, among, settled),
    )


def _worth_a_look(boxes: Array, worth: Array) -> NDArray[np.intp]:
    """The proposals that differ and look good at a glance: few where one glance tells, many where it does not."""
    differing = thin(boxes, worth, SAME, LOOKED_AT[1])
    return differing[: max(int((worth[differing] >= WORTH_A_LOOK).sum()), LOOKED_AT[0])]


def more_certain(certainty: Array, value: Array | float) -> Array:
    """Certainty after more evidence.

    Parameters
    ----------
    certainty : ndarray of shape (n,)
    value : ndarray of shape (n,) or float
        Logarithms of the factors of the odds.

    Returns
    -------
    ndarray of shape (n,)
    """
    odds = certainty * np.exp(value)
    return odds / (odds + 1 - certainty)


def likeness(similar: Array) -> Array:
    """Certainty of candidates that can hardly be told from an example.

    Whatever the weights say, what is like an example in all that counts is as good as one, unless most candidates are:
    then nothing that counts tells places apart.

    Parameters
    ----------
    similar : ndarray of shape (n, m)
        Similarities to positive examples.

    Returns
    -------
    ndarray of shape (n,)
        0 to `SURELY_ALIKE`.
    """
    best = similar.max(axis=1, initial=0.0)
    if not len(best):
        return best
    distinct = (best < UNLIKE).mean()
    return SURELY_ALIKE * distinct * np.clip((best - ALIKE) / (1 - ALIKE), 0.0, 1.0)


def one_of(lesson: Lesson, boxes: Array, value: Array) -> tuple[int, Array]:
    """The candidate that is nearest to the right one in expectation, and the middle of all in its place.

    Not the likeliest alone: of many that are somewhat likely, the one in their midst overlaps most with whichever is
    meant. Squared overlaps, so that one corner or the other is chosen and not the middle of the room between them.

    Parameters
    ----------
    lesson : Lesson
    boxes : ndarray of shape (n, 4)
    value : ndarray of shape (n,)
        Logarithms of their odds.

    Returns
    -------
    chosen : int
    middle : ndarray of shape (4,)
        Each edge the median of those of the candidates around the chosen one, by their odds.
    """
    options = lesson.options
    shape = shape_factor(
        boxes[:, 2:] - boxes[:, :2], lesson.sizes[lesson.positive], options.aspect_tolerance, options.area_tolerance
    )
    odds = np.exp(value - value.max()) * shape
    shared = union_overlap(boxes, boxes)
    chosen = int(np.argmax(shared**2 @ odds))
    around = shared[chosen] >= AROUND
    edges, weight = boxes[around], odds[around]
    order = np.argsort(edges, axis=0, kind="stable")
    ordered, below = np.take_along_axis(edges, order, axis=0), np.cumsum(weight[order], axis=0) / weight.sum()
    # Where two halves are equal but for rounding the middle lies between them.
    either = [np.argmax(below >= 0.5 + by, axis=0)[None] for by in (-EQUALLY_ALIKE, EQUALLY_ALIKE)]
    return chosen, np.mean([np.take_along_axis(ordered, at, axis=0)[0] for at in either], axis=0)


def look(lesson: Lesson, arrangement: Arrangement, boxes: Array, present: Array) -> tuple[Array, ...]:
    """What all relations of boxes say of them.

    Parameters
    ----------
    lesson : Lesson
    arrangement : Arrangement
    boxes : ndarray of shape (n, 4)
    present : ndarray of shape (m, 4)

    Returns
    -------
    similarities, contrast : ndarray of shape (n, m)
        To every example; and by what tells examples and counter-examples apart.
    exactness, strays : ndarray of shape (n,)
        See `Habits.constructed` and `astray`.
    evidence : ndarray of shape (n, f)
    """
    seen = signature(arrangement, boxes, lesson.options.neighbours, lesson.labels)
    matches = lesson.match(seen)
    evidence = _evidence(lesson, arrangement, boxes, seen, matches, present, lesson.options.neighbours)
    similar = lesson.similarities(matches)
    contrast = similar if lesson.contrast is lesson else lesson.contrast.similarities(lesson.contrast.match(seen))
    strays = astray(lesson, arrangement, matches, present)
    return similar, contrast, lesson.habits.constructed(seen), strays, evidence


def _unlike_shown(boxes: Array, shown: Array) -> NDArray[np.bool_]:
    """Which boxes are not in the place of an example: those can be no results."""
    return (overlap(boxes, shown) <= EXAMPLE_AGAIN).all(axis=1)


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
    box = arrangement.parent_box
    weight = np.concatenate([np.ones(len(present)), certainty[likely]])
    lines, supports = [], []
    for a in (0, 1):
        rows = rows_of(every[:, [a, a + 2]])
        lines.append(np.concatenate([rows, rhythm(rows), beats(rows, box[a], box[a + 2])[0]]))
        along = interval_overlap(np.repeat(lines[a], 2, axis=1), every, a)
        supports.append((along * weight).sum(axis=1))
    meetings = crossings(*lines)
    support = (supports[0][:, None] * supports[1][None]).ravel()
    best = np.argsort(-support, kind="stable")[: MOST_MET * GROWN]
    meetings = meetings[best]
    new = union_overlap(meetings, boxes).max(axis=1, initial=0.0) < SAME
    return meetings[new & (arrangement.share_outside(meetings) <= 0.5)][:GROWN]
