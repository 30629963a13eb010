"""The importance of section 4.5 for many poses in many arrangements at once.

Poses are moved onto maxima in small numbers per arrangement; what is evaluated here is a flat list of pairs of a pose
and one of the features that may answer there, so that a plan of rooms costs what its pairs cost.
"""

import copy
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..relations.elements import Elements, ElementType
from .importance import Importance, arrangements_of
from .part import Part
from .pruning import near, strongest
from .rows import Rows

Array = NDArray[np.float64]
Indices = NDArray[np.intp]


class Batch:
    """Several importances of one query, side by side.

    Parameters
    ----------
    importances : sequence of Importance
        All of the same query.

    Attributes
    ----------
    query : Query
    unit : ndarray of shape (importances, 3)
        What counts as one step: the half-widths of level sets, twice, and of directions.
    arrangement : ndarray of shape (importances,), int
        The number of each importance's arrangement.
    """

    def __init__(self, importances: Sequence[Importance]) -> None:
        self.query = importances[0].query
        width = np.array([i.width for i in importances])
        self.unit = np.column_stack([width, width, np.full(len(width), self.query.options.direction_width)])
        targets, self.arrangement = arrangements_of(importances)
        elements = Elements.joined([t.elements for t in targets])
        self._parts: list[Part] = []
        for element in ElementType:
            first = np.cumsum([0, *(t.elements.count(element) for t in targets)])[self.arrangement]
            part = Part.of(element, elements, importances, first)
            if part is not None:
                self._parts.append(part)

    def _with(self, which: Indices, parts: list[Part]) -> "Batch":
        """Of other parts, made for some of the importances."""
        result = copy.copy(self)
        result.unit = self.unit[which]
        result.arrangement = self.arrangement[which]
        result._parts = parts
        return result

    def strongest(self, share: float) -> "Batch":
        """The same without the pairs of features that contribute little: enough to find where maxima are.

        Parameters
        ----------
        share : float
            Of an importance's strongest pair of one type of element, below which a pair is left out.

        Returns
        -------
        Batch
        """
        every = np.arange(len(self.unit))
        return self._with(every, [strongest(r, share) for r in self.rows(every)])

    def near(self, which: Indices, position: Array, angle: Array, reach: float, turn: float) -> "Batch":
        """What poses that hardly move any more can still meet: an importance a pose.

        Parameters
        ----------
        which : ndarray of shape (m,), int
            The number of each pose's importance.
        position : ndarray of shape (m, 2)
        angle : ndarray of shape (m,)
        reach : float
            How far they may move, in half-widths of level sets.
        turn : float
            How far they may turn, radians.

        Returns
        -------
        Batch
            Of `m` importances, without the pairs of features that contribute nothing there.
        """
        return self._with(which, [near(r, position, angle, reach, turn) for r in self.rows(which)])

    def rows(self, which: Indices) -> list[Rows]:
        """What is compared for poses in given arrangements.

        Parameters
        ----------
        which : ndarray of shape (m,), int
            The number of each pose's importance.

        Returns
        -------
        list of Rows
            One per type of element.
        """
        width = self.unit[which, 0]
        return [Rows(part, which, width, self.query.options.direction_width) for part in self._parts]

    def importance(self, which: Indices, position: Array, angle: Array) -> Array:
        """The importance of poses, 1 for a perfect copy.

        Parameters
        ----------
        which : ndarray of shape (m,), int
        position : ndarray of shape (m, 2)
        angle : ndarray of shape (m,)

        Returns
        -------
        ndarray of shape (m,)
        """
        return self.total(self.rows(which), position, angle)

    def total(self, rows: Sequence[Rows], position: Array, angle: Array) -> Array:
        """The importance of poses that rows stand for.

        Parameters
        ----------
        rows : sequence of Rows
            One per type of element.
        position : ndarray of shape (m, 2)
        angle : ndarray of shape (m,)

        Returns
        -------
        ndarray of shape (m,)
        """
        total = np.zeros(len(angle))
        for r in rows:
            total += r.total(r.misses(position, angle))
        return self.normalised(total)

    def normalised(self, total: Array) -> Array:
        """Sums divided by that of a perfect copy.

        Parameters
        ----------
        total : ndarray

        Returns
        -------
        ndarray
        """
        return total / self.query.total if self.query.total else total


def importance_at(importance: Importance, position: Array, angle: Array) -> Array:
    """The importance of poses in one arrangement, 1 for a perfect copy.

    Parameters
    ----------
    importance : Importance
    position : ndarray of shape (m, 2)
    angle : ndarray of shape (m,)

    Returns
    -------
    ndarray of shape (m,)
    """
    return Batch([importance]).importance(np.zeros(len(angle), dtype=np.intp), position, angle)
