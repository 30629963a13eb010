"""The evidence for a candidate: a few figures between 0 and 1 that follow from its relations."""

import numpy as np
from numpy.typing import NDArray

from ..relations.table import Kind
from .arrangement import Arrangement
from .boxes import interval_overlap
from .lesson import Lesson, Match
from .regularity import alignment, beats, mirrored_extents, on_beat, rhythm
from .signature import PARENT_BOX, Signature
from .similarity import SIGMA
from .taught import coverage
from .turns import parent_sizes

Array = NDArray[np.float64]

#: The figures of a single candidate, in the order of their columns.
SINGLE = (
    "similarity",  # to the most similar example
    "mean similarity",
    "against cohesion",  # similarity over what examples have with each other
    "shortfall",  # how far it is below that, where examples are alike
    "habit",  # how well its edges keep to what they keep to most closely among the examples
    "broken habit",  # by how much the worst edge does not
    "unexplained",  # by how much its worst edge keeps to nothing that the examples agree in exactly
    "best anchor",  # agreement with the group of elements that agrees best, times its reliability
    "anchors",  # mean agreement of all groups, by reliability
    "sure anchors",  # the same by squared reliability
    "missed anchor",  # largest reliability times disagreement
    "along x",
    "along y",
    "best along x",
    "best along y",
    "missed along x",
    "missed along y",
    "in parent",  # agreement with the parent's box, times its reliability
    "in parent along x",
    "in parent along y",
    "as in like parents",  # similarity to examples, the more alike the parents the more they count
    "share as in like parents",  # the same for the shares of the parent's box alone
    "shape",  # logarithmic difference in size to the example most alike
    "beyond shapes",  # how far its sides are beyond those of the examples, and as much again as these differ
    "covered",  # more of it is covered by elements of some label than of any example
    "uncovered",
    "touched",  # it covers more of some element than any example does
    "outside",  # more of it lies outside the parent
    "row",  # shares its extent along y with an example drawn here
    "column",
    "row and column",
    "mean row",
    "mean column",
    "rhythm along x",  # stands in a column of an example, or where columns of examples go on
    "rhythm along y",
    "beat along x",  # keeps a regular distance that the examples' columns keep, times the trust in it
    "beat along y",
    "on both beats",
    "mirrored along x",  # where the examples' columns are, mirrored about the parent's middle
    "mirrored along y",
    "aligned along x",  # its column is that of elements which the examples' columns are those of
    "aligned along y",
    "misaligned along x",
    "misaligned along y",
    "reliability",  # of the examples' best group; the same for all candidates
    "reliability along x",
    "reliability along y",
    "reliability in parent",
    "cohesion",
    "number",  # logarithm of the number of examples
)

#: Logarithmic differences in aspect and in size at which two parents are still alike.
LIKE_ASPECT, LIKE_SIZE = 0.15, 0.5
#: Similarity among examples from which they are somewhat alike, and all but equal.
ALIKE = (0.7, 0.9)
#: How much less similar than examples are to each other a place may always be, in the unit of similarities.
SLACK = 0.1


def single_evidence(
    lesson: Lesson,
    arrangement: Arrangement,
    boxes: Array,
    seen: Signature,
    matches: dict[str, Match],
    present: Array,
) -> Array:
    """The figures of `SINGLE`.

    Parameters
    ----------
    lesson : Lesson
    arrangement : Arrangement
    boxes : ndarray of shape (n, 4)
    seen : Signature
        Of the boxes.
    matches : dict of str to Match
        Of the boxes with all examples.
    present : ndarray of shape (m, 4)
        Positive examples drawn in this arrangement.

    Returns
    -------
    ndarray of shape (n, len(SINGLE))
    """
    p = lesson.positive
    n = len(boxes)
    similarity = lesson.similarities(matches)[:, p]
    keys = [key for key in matches if key != PARENT_BOX]
    reliable = np.array([lesson.reliability[key] for key in keys]).reshape(-1, 3)
    joint = np.array([matches[key].joint[:, p].max(axis=1) for key in keys]).reshape(len(keys), n).T
    of_boxes = [i for i, key in enumerate(keys) if matches[key].of_boxes]
    x, y = (
        np.array([getattr(matches[keys[i]], name)[:, p].max(axis=1) for i in of_boxes]).reshape(len(of_boxes), n).T
        for name in ("along_x", "along_y")
    )
    rx, ry, rj = reliable[of_boxes, 0], reliable[of_boxes, 1], reliable[:, 2]
    parent = matches[PARENT_BOX]
    in_parent = lesson.reliability[PARENT_BOX]
    habit, explained = lesson.habits.kept_to(seen)
    like = like_parents(lesson, arrangement)
    size = np.log(boxes[:, 2:] - boxes[:, :2])
    taught_size = np.log(lesson.sizes[p])
    covered, uncovered, touched, outside = excess(lesson, arrangement, boxes)
    rows = columns = np.zeros((n, 1))
    if len(present):
        rows, columns = interval_overlap(boxes, present, 1), interval_overlap(boxes, present, 0)
    beat, mirror, aligned, missed = _lines(arrangement, boxes, present)
    best = similarity.max(axis=1)
    figures = {
        "similarity": best,
        "mean similarity": similarity.mean(axis=1),
        "against cohesion": np.minimum(best / max(lesson.cohesion, 0.05), 2.0),
        "shortfall": _shortfall(best, lesson.cohesion),
        "habit": habit.mean(axis=(1, 2)),
        "broken habit": 1.0 - habit.min(axis=(1, 2), initial=1.0),
        "unexplained": 1.0 - explained.min(axis=(1, 2), initial=1.0),
        "best anchor": (joint * rj).max(axis=1, initial=0.0),
        "anchors": joint @ rj / max(rj.sum(), 1e-9),
        "sure anchors": joint @ rj**2 / max((rj**2).sum(), 1e-9),
        "missed anchor": missed_anchor(lesson, matches),
        "along x": x @ rx**2 / max((rx**2).sum(), 1e-9),
        "along y": y @ ry**2 / max((ry**2).sum(), 1e-9),
        "best along x": (x * rx).max(axis=1, initial=0.0),
        "best along y": (y * ry).max(axis=1, initial=0.0),
        "missed along x": ((1 - x) * rx).max(axis=1, initial=0.0),
        "missed along y": ((1 - y) * ry).max(axis=1, initial=0.0),
        "in parent": parent.joint[:, p].max(axis=1) * in_parent[2],
        "in parent along x": parent.along_x[:, p].max(axis=1) * in_parent[0],
        "in parent along y": parent.along_y[:, p].max(axis=1) * in_parent[1],
        "as in like parents": similarity @ like,
        "share as in like parents": _shares(lesson, seen) @ like,
        "shape": np.minimum(np.hypot(*(size[:, None] - taught_size[None]).T).T.min(axis=1), 1.0),
        "beyond shapes": np.minimum(np.hypot(*_beyond(size, taught_size).T), 1.0),
        "covered": covered,
        "uncovered": uncovered,
        "touched": touched,
        "outside": outside,
        "row": rows.max(axis=1),
        "column": columns.max(axis=1),
        "row and column": np.minimum(rows.max(axis=1), columns.max(axis=1)),
        "mean row": rows.mean(axis=1),
        "mean column": columns.mean(axis=1),
        "rhythm along x": np.maximum(columns.max(axis=1), _rhythm(boxes, present, 0)),
        "rhythm along y": np.maximum(rows.max(axis=1), _rhythm(boxes, present, 1)),
        "beat along x": beat[0],
        "beat along y": beat[1],
        "on both beats": np.minimum(np.maximum(beat[0], columns.max(axis=1)), np.maximum(beat[1], rows.max(axis=1))),
        "mirrored along x": mirror[0],
        "mirrored along y": mirror[1],
        "aligned along x": aligned[0],
        "aligned along y": aligned[1],
        "misaligned along x": missed[0],
        "misaligned along y": missed[1],
        "reliability": np.full(n, rj.max(initial=0.0)),
        "reliability along x": np.full(n, rx.max(initial=0.0)),
        "reliability along y": np.full(n, ry.max(initial=0.0)),
        "reliability in parent": np.full(n, in_parent[2]),
        "cohesion": np.full(n, lesson.cohesion),
        "number": np.full(n, np.log(len(p))),
    }
    return np.stack([figures[name] for name in SINGLE], axis=1)


def _lines(arrangement: Arrangement, boxes: Array, present: Array) -> tuple[list[Array], ...]:
    """On a beat, mirrored, aligned and misaligned, each along x and y."""
    found: tuple[list[Array], ...] = ([], [], [], [])
    for axis in (0, 1):
        values = [np.zeros(len(boxes))] * 4
        if len(present):
            low, high = arrangement.parent_box[axis], arrangement.parent_box[axis + 2]
            along = present[:, [axis, axis + 2]]
            mirrored = np.repeat(mirrored_extents(along, low, high), 2, axis=1)
            values = [
                on_beat(boxes, axis, *beats(along, low, high)),
                interval_overlap(boxes, mirrored, axis).max(axis=1),
                *alignment(boxes, present, arrangement.drawn, axis),
            ]
        for kept, value in zip(found, values, strict=True):
            kept.append(value)
    return found


def _rhythm(boxes: Array, present: Array, axis: int) -> Array:
    """Overlap of each box's extent along an axis with the best of those where the rows of examples go on."""
    beats = rhythm(present[:, [axis, axis + 2]])
    if not len(beats):
        return np.zeros(len(boxes))
    return interval_overlap(boxes, np.repeat(beats, 2, axis=1), axis).max(axis=1)


def like_parents(lesson: Lesson, arrangement: Arrangement) -> Array:
    """How much each positive example counts in a parent, by the proportions of its own.

    Parameters
    ----------
    lesson : Lesson
    arrangement : Arrangement

    Returns
    -------
    ndarray of shape (m,)
        The sum is 1.
    """
    taught = np.log(parent_sizes(lesson.kept)[lesson.positive])
    here = np.log(arrangement.parent_box[2:] - arrangement.parent_box[:2])
    off = taught - here
    aspect, size = off[:, 0] - off[:, 1], off.mean(axis=1)
    value = -0.5 * ((aspect / LIKE_ASPECT) ** 2 + (size / LIKE_SIZE) ** 2)
    weight = np.exp(value - value.max())
    return weight / weight.sum()


def _shares(lesson: Lesson, seen: Signature) -> Array:
    """Agreement of the edges, as shares of the parent's box, with those of each positive example; (n, m)."""
    here = seen.boxes[PARENT_BOX][:, 0][:, :, [0, 2], 3]
    taught = lesson.kept.boxes[PARENT_BOX][lesson.positive, 0][:, :, [0, 2], 3]
    width = lesson.options.tau * SIGMA[Kind.RATIO]
    return np.exp(-0.5 * ((here[:, None] - taught[None]) / width) ** 2).mean(axis=(2, 3))


def _shortfall(similarity: Array, cohesion: float) -> Array:
    """By how much less similar candidates are than examples to each other, in units of how far these are from 1.

    Where examples are all but equal, whatever is meant is equal to them too, and half of their relations are too few;
    where they differ it tells nothing.
    """
    alike = np.clip((cohesion - ALIKE[0]) / (ALIKE[1] - ALIKE[0]), 0.0, 1.0)
    return alike * np.clip((cohesion - similarity) / (1.0 - cohesion + SLACK), 0.0, 4.0)


def _beyond(size: Array, taught: Array) -> Array:
    """By how much logarithms of sides leave the examples' range, widened by its own extent on either side.

    Examples of one size ask for that size; examples of different sizes ask for sizes that follow from something else,
    which may be larger or smaller than any of them.
    """
    low, high = taught.min(axis=0), taught.max(axis=0)
    return np.clip(np.maximum(low - size, size - high) - (high - low), 0.0, None)


def missed_anchor(lesson: Lesson, matches: dict[str, Match]) -> Array:
    """How surely examples agree in a group of elements, and how little boxes agree with them in it: the worst group.

    Parameters
    ----------
    lesson : Lesson
    matches : dict of str to Match
        Of the boxes with all examples.

    Returns
    -------
    ndarray of shape (n,)
        Between 0 and 1.
    """
    missed = [
        (1 - match.joint[:, lesson.positive].max(axis=1)) * lesson.reliability[key][2]
        for key, match in matches.items()
        if key != PARENT_BOX
    ]
    return np.max([np.zeros(len(matches[PARENT_BOX].joint)), *missed], axis=0)


def excess(lesson: Lesson, arrangement: Arrangement, boxes: Array) -> tuple[Array, Array, Array, Array]:
    """By how much boxes are covered, bare, touch elements and lie outside more than any positive example.

    Parameters
    ----------
    lesson : Lesson
    arrangement : Arrangement
    boxes : ndarray of shape (n, 4)

    Returns
    -------
    covered, uncovered, touched, outside : ndarray of shape (n,)
        The figures of `SINGLE`.
    """
    outside = arrangement.share_outside(boxes) - max(lesson.taught[i].outside for i in lesson.positive)
    return *_overlaps(lesson, arrangement, boxes), np.clip(outside, 0.0, 1.0)


def _overlaps(lesson: Lesson, arrangement: Arrangement, boxes: Array) -> tuple[Array, Array, Array]:
    """How much more and less boxes are covered, and touch elements, than any positive example: sums over labels."""
    covered, touched = coverage(arrangement, boxes)
    more, less, hit = (np.zeros(len(boxes)) for _ in range(3))
    taught = [lesson.taught[i] for i in lesson.positive]
    for label, share in covered.items():
        known = [t.covered.get(label, 0.0) for t in taught]
        more += np.maximum(share - max(known), 0.0)
        less += np.maximum(min(known) - share, 0.0)
        hit += np.maximum(touched[label] - max(t.touched.get(label, 0.0) for t in taught), 0.0)
    return np.minimum(more, 1.5), np.minimum(less, 1.5), np.minimum(hit, 1.5)
