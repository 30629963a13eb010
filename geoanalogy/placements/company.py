"""Candidates among each other: which exclude each other, which stand in line, which belong to one element."""

import numpy as np
from numpy.typing import NDArray

from .arrangement import Arrangement
from .boxes import distances, interval_overlap, overlap
from .lesson import Lesson
from .signature import BOX

Array = NDArray[np.float64]

#: The figures of a candidate among the others of its arrangement.
AMONG = (
    "relative",  # similarity over the largest one
    "local",  # similarity over the largest one among those it overlaps
    "at anchor",  # similarity over the largest one among those with the same nearest element of the surest label
    "at second anchor",
    "row support",  # similarity of the best candidates in its row
    "column support",
)

#: Shared length over united length from which two extents are the same row or column.
ALIGNED = 0.75
#: Overlap from which two candidates exclude each other.
EXCLUDING = 0.1
#: How many of the best candidates support a row or a column.
SUPPORTERS = 4


def anchors_of(lesson: Lesson, arrangement: Arrangement, boxes: Array) -> NDArray[np.intp]:
    """The nearest element of the two labels that examples have the surest relations to.

    What is drawn once at every window is drawn once at this window too: the better of two candidates there counts.

    Parameters
    ----------
    lesson : Lesson
    arrangement : Arrangement
    boxes : ndarray of shape (n, 4)

    Returns
    -------
    ndarray of shape (2, n), int
        Index of the element; the boxes' own numbers, so that nobody shares them, where there is no such label.
    """
    sure = sorted(
        (label for label in arrangement.drawn if BOX + label in lesson.reliability),
        key=lambda label: (-round(lesson.reliability[BOX + label][2], 9), label),
    )[:2]
    found = [np.argmin(distances(boxes, arrangement.drawn[label]), axis=1) for label in sure]
    return np.array([*found, *[np.arange(len(boxes))] * (2 - len(found))])


class Company:
    """Candidates among each other: which exclude each other, which stand in line, which belong to one element.

    Parameters
    ----------
    boxes : ndarray of shape (n, 4)
    present : ndarray of shape (m, 4)
        Examples drawn in this arrangement; they are as strong as the best candidate.
    anchors : ndarray of shape (2, n + m), int
        Of the boxes and the examples, see `anchors_of`.
    """

    def __init__(self, boxes: Array, present: Array, anchors: NDArray[np.intp]) -> None:
        every = np.concatenate([boxes, present])
        free = overlap(boxes, every) <= EXCLUDING
        self.shown = len(present)
        self.anchors = anchors
        # Pairs, not tables: most candidates have little to do with each other.
        self.rivals = np.nonzero(~free[:, : len(boxes)])
        self.in_line = [np.nonzero((interval_overlap(boxes, every, axis) >= ALIGNED) & free) for axis in (1, 0)]

    def evidence(self, strength: Array) -> Array:
        """The figures of `AMONG`, with any strength in place of the similarity.

        Parameters
        ----------
        strength : ndarray of shape (n,)
            How good each candidate is by itself, not negative.

        Returns
        -------
        ndarray of shape (n, len(AMONG))
        """
        n = len(strength)
        top = max(float(strength.max(initial=0.0)), 1e-9)
        force = np.concatenate([strength, np.full(self.shown, top)])
        row, rival = self.rivals
        strongest_rival = np.zeros(n)
        np.maximum.at(strongest_rival, row, strength[rival])
        local = strength / np.maximum(strongest_rival, 1e-9)
        at_anchors = []
        for index in self.anchors:
            strongest = np.zeros(index.max(initial=0) + 1)
            np.maximum.at(strongest, index, force)
            at_anchors.append(strength / np.maximum(strongest[index[:n]], 1e-9))
        supports = []
        for row, other in self.in_line:
            # By rows, the strongest first: the best supporters are the first few of each.
            order = np.lexsort((-force[other], row))
            row, given = row[order], force[other[order]]
            rank = np.arange(len(row)) - np.searchsorted(row, row)
            given = np.where(rank < SUPPORTERS, given, 0.0)
            supports.append(np.bincount(row, given, minlength=n) / SUPPORTERS / top)
        return np.stack([strength / top, local, *at_anchors, *supports], axis=1)
