"""Places that follow from what all examples keep to exactly.

Whoever draws by a rule (a metre from either side, flush with the window) draws boxes that keep to one element with all
four edges, to the last digit, however different their surroundings are. Where parents hold one placement each, such a
rule says where it is, and nothing needs to be searched for or weighed: the more examples keep to it, the surer it is.
"""

import itertools
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .arrangement import Arrangement
from .candidates import plausible
from .evidence import excess, missed_anchor
from .habits import CONSTRUCTED
from .lesson import Lesson
from .signature import BOX, PARENT_BOX, signature

Array = NDArray[np.float64]

#: Certainty of what keeps to the rule in surroundings like those of the examples.
SURE = 0.95
#: How much of what is around examples may be missing (reliability times disagreement) for surroundings to be familiar,
#: and how much makes them another kind of place.
FAMILIAR, FOREIGN = 0.5, 0.9
#: Difference in similarity, a few times what float32 leaves of it, below which two boxes are alike.
EQUALLY_ALIKE = 1e-4
#: Difference in size, as a share of what counts as exact, below which elements are equal but for rounding.
SAME_SIZE = 1e-5
#: Digits to which logarithms of deformations differ by more than rounding.
ROUNDED = 6


#: How exactly a box keeps to an element whose rule it follows.
KEPT = 0.99


@dataclass(frozen=True)
class Construction:
    """The boxes that follow from the rule.

    Attributes
    ----------
    boxes : ndarray of shape (n, 4)
        The surest first; none where the rule leaves no room.
    similarities : ndarray of shape (n, m)
        To every example.
    certainty : ndarray of shape (n,)
    """

    boxes: Array
    similarities: Array
    certainty: Array


def is_constructed(lesson: Lesson) -> bool:
    """Whether examples in different surroundings, one in each, all keep exactly to one element.

    Parameters
    ----------
    lesson : Lesson

    Returns
    -------
    bool
        Never with a single example or with counter-examples: then other things count.
    """
    return len(lesson.positive) > 1 and not len(lesson.negative) and lesson.one_each and bool(lesson.habits.exact)


def constructed_boxes(lesson: Lesson, arrangement: Arrangement) -> tuple[Array, NDArray[np.intp]]:
    """The boxes that keep to an element here as all examples keep to theirs.

    Where examples agree in several coordinates of an edge that contradict each other here (parents of one width, and
    this one is wider), there is a box for each.

    Parameters
    ----------
    lesson : Lesson
    arrangement : Arrangement
        The target.

    Returns
    -------
    boxes : ndarray of shape (n, 4)
        In the arrangement's frame, of about the examples' size.
    made_from : ndarray of shape (n, 2), int
        Number of the group among those of `Habits.exact`, and of the element among those of its label.
    """
    boxes, made_from = [np.zeros((0, 4))], [np.zeros((0, 2), dtype=np.intp)]
    tolerance = 2 * CONSTRUCTED * lesson.widths[:2]
    for g, (key, exact) in enumerate(lesson.habits.exact.items()):
        middle = lesson.habits.of[key].middle
        elements = arrangement.boxes.get(key.removeprefix(BOX), np.zeros((0, 4)))
        elements = arrangement.parent_box[None] if key == PARENT_BOX else elements
        # What follows from elements of one size differs by where they are.
        sizes = elements[:, 2:] - elements[:, :2]
        _, first, kind = np.unique(
            np.round(sizes / (SAME_SIZE * tolerance)), axis=0, return_index=True, return_inverse=True
        )
        of_kind = []
        for size in sizes[first][..., None]:
            places = np.stack(
                [middle[..., 0], size + middle[..., 1], size / 2 + middle[..., 2], size * middle[..., 3]], -1
            )
            edges = [_distinct(places[a, s][exact[a, s]], tolerance[a]) for s in (0, 1) for a in (0, 1)]
            of_kind.append(np.array(list(itertools.product(*edges))))
        for e, (element, k) in enumerate(zip(elements, kind.ravel(), strict=True)):
            boxes.append(of_kind[k] + np.tile(element[:2], 2))
            made_from.append(np.full((len(boxes[-1]), 2), (g, e)))
    every = np.concatenate(boxes)
    some = plausible(every, lesson.sizes[lesson.positive])
    return every[some], np.concatenate(made_from)[some]


def _distinct(places: Array, tolerance: float) -> Array:
    """Places along an axis that differ, those that are one but for rounding as their mean."""
    ordered = np.sort(places)
    number = np.concatenate([[0], np.cumsum(np.diff(ordered) > tolerance)])
    return np.asarray(np.bincount(number, ordered) / np.bincount(number))


def construction(lesson: Lesson, arrangement: Arrangement) -> Construction | None:
    """The placements that follow from what all examples keep to exactly.

    Of several boxes that keep to a rule the one most similar to the examples is meant, of equals the one that deforms
    them least; where it keeps to an element of which there are several, there is one beside each that a box keeps to in
    all the same ways. A placement is the less certain the more of it lies outside, covers or leaves bare what no
    example does, and the less the rest of its surroundings is like theirs.

    Parameters
    ----------
    lesson : Lesson
        One that `is_constructed`.
    arrangement : Arrangement
        The target.

    Returns
    -------
    Construction or None
        None where elements stand so differently here that the place may be a turned or mirrored one: that is to be
        searched for.
    """
    boxes, made_from = constructed_boxes(lesson, arrangement)
    if not len(boxes):
        return Construction(boxes, np.zeros((0, len(lesson.taught))), np.zeros(0))
    seen = signature(arrangement, boxes, lesson.options.neighbours, lesson.labels)
    matches = lesson.match(seen)
    similar = lesson.similarities(matches)
    # Another element may be nearer to a box than the one that it was made from.
    exactness = lesson.habits.exactness(seen)
    keeps = np.stack([exactness[key] >= KEPT for key in lesson.habits.exact])
    worth = np.where(keeps.any(axis=0), similar.max(axis=1) + similar.mean(axis=1), 0.0)
    size = np.log(boxes[:, 2:] - boxes[:, :2])
    deformed = np.abs(size[:, None] - np.log(lesson.sizes)[None]).sum(axis=2).min(axis=1)

    def best(some: NDArray[np.intp]) -> int:
        close = worth[some] < worth[some].max() - EQUALLY_ALIKE
        return int(some[np.lexsort((-worth[some], np.round(deformed[some], ROUNDED), close))[0]])

    first = best(np.arange(len(boxes)))
    missed = missed_anchor(lesson, matches)
    if missed[first] >= FOREIGN and lesson.labels:
        return None
    ways = keeps[:, first]
    chosen = [first]
    in_parent = np.array([key == PARENT_BOX for key in lesson.habits.exact])
    if ways.any() and not (ways & in_parent).any():
        group, element = made_from.T
        like = (group == np.argmax(ways)) & keeps[ways].all(axis=0)
        chosen = [best(np.flatnonzero(like & (element == e))) for e in np.unique(element[like])]
    index = np.array(sorted(chosen, key=lambda i: -worth[i]))
    familiar = np.clip((FOREIGN - missed[index]) / (FOREIGN - FAMILIAR), 0.0, 1.0)
    odd = np.prod([np.clip(1 - 2 * e, 0.0, 1.0) for e in excess(lesson, arrangement, boxes[index])], axis=0)
    return Construction(boxes[index], similar[index], SURE * keeps[:, index].any(axis=0) * familiar * odd)
