"""What poses in an arrangement are asked, and what an answer is worth: the terms of the importance of section 4.5."""

import copy
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..relations.elements import ElementType
from ..relations.table import Positional
from .arrangement import Arrangement
from .matching import Matching, Sense
from .query import Query

Array = NDArray[np.float64]
Indices = NDArray[np.intp]


class Importance:
    """The importance of poses in one arrangement, for one sense and one scale of the example.

    Equation for I(P, Q) of section 4.5, read as the sum over the example's features of I_l times the best match over
    the target's. One target feature answers for all relations and all samples of a feature, so that a desk's two ends
    are not near two different windows. Divided by the importance of a perfect copy.

    Parameters
    ----------
    query : Query
    target : Arrangement
    sense : Sense
    scale : float
        Size of the target in proportion to the example: lengths and the footprint are multiplied by it.
    matching : Matching, optional
        Of the arrangement, where it is known: it is the same in all senses and at all scales.
    """

    def __init__(
        self,
        query: Query,
        target: Arrangement,
        sense: Sense,
        scale: float = 1.0,
        matching: Matching | None = None,
    ) -> None:
        self.query = query
        self.target = target
        self.sense = sense
        self.scale = scale
        self.width = query.width * scale
        #: Whether poses are mirrored: an example that is mirrored itself has answers the other way about.
        self.mirrored = sense.mirrored != query.pose.mirrored
        self.samples = query.samples * scale * ((1.0, -1.0) if self.mirrored else (1.0, 1.0))
        self.answers = (Matching(query, target) if matching is None else matching).answers(sense)
        self._strongest: dict[float, Importance] = {}

    def of_strongest(self, share: float) -> "Importance":
        """The same without the pairs of features that contribute little: cheaper, and enough to find where maxima are.

        Parameters
        ----------
        share : float
            Of the strongest pair's contribution, below which a pair is left out.

        Returns
        -------
        Importance
        """
        result = self._strongest.get(share)
        if result is None:
            result = self._strongest[share] = copy.copy(self)
            result.answers = {element: a.strongest(share) for element, a in self.answers.items()}
            result._strongest = {}
        return result

    @property
    def answering(self) -> list[int]:
        """The numbers of the arrangement's polygons of which features may answer."""
        there = np.zeros(len(self.target.elements.polygons), dtype=bool)
        for element, a in self.answers.items():
            there[self.target.elements.polygon_of(element)[a.target]] = True
        answering: list[int] = np.flatnonzero(there).tolist()
        return answering

    @property
    def relations(self) -> tuple[Positional, ...]:
        """The positional relations in which the example stands."""
        return tuple(r for a in self.answers.values() for r in a.relations)

    @property
    def bound(self) -> float:
        """The greatest importance any pose here can have: what every feature's best pair would give."""
        total = 0.0
        for a in self.answers.values():
            total += float(np.maximum.reduceat(a.layout.possible, a.feature_start).sum())
        return total / self.query.total if self.query.total else 0.0

    def directed(self, element: ElementType, sample: Indices) -> NDArray[np.bool_]:
        """Which entries ask for a direction.

        Where sides and corners of a footprint are samples, their places tell the direction, and better: at a contact
        with a corner the direction of the boundary is one edge's or the other's by a rounding error. Segments have one
        direction.

        Parameters
        ----------
        element : ElementType
        sample : ndarray of shape (e,), int
            The sample of each entry.

        Returns
        -------
        ndarray of shape (e,), bool
        """
        if not self.query.rigid or element is ElementType.SEGMENT:
            return np.ones(len(sample), dtype=bool)
        return (sample == 0) & (element is ElementType.POLYGON)


def arrangements_of(importances: Sequence[Importance]) -> tuple[list[Arrangement], Indices]:
    """The arrangements of importances, each once, and which of them each importance is of.

    Parameters
    ----------
    importances : sequence of Importance

    Returns
    -------
    arrangements : list of Arrangement
        In the order in which they first come.
    number : ndarray of shape (importances,), int
    """
    number = {t: k for k, t in enumerate(dict.fromkeys(i.target for i in importances))}
    return list(number), np.array([number[i.target] for i in importances], dtype=np.intp)
