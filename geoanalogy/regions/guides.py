"""Chains and alignments as guides: which of them agree with a function, and what those are worth."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..geometry.contours import Complex, Floats, Indices
from .alignment import GAIN, Alignment
from .chains import Chain, Chains
from .fitting import Fitter

#: Mean distance, in extents of the query at the target's scale, at which a guide agrees with a function to 0.6.
AGREEING = 0.06
#: Points of a guide that are looked at.
LOOKED_AT = 8


@dataclass(frozen=True)
class Guides:
    """The chains and alignments of a query.

    Attributes
    ----------
    fitter : Fitter
    chains : Chains
    alignments : list of Alignment
    """

    fitter: Fitter
    chains: Chains
    alignments: list[Alignment]

    @cached_property
    def every(self) -> list[Chain | Alignment]:
        """The chains, then the alignments."""
        return [*self.chains.found, *self.alignments]

    @cached_property
    def most(self) -> float:
        """Score of the chains that an identical copy would have."""
        return float(self.chains.most.sum(1).mean())

    @cached_property
    def worth(self) -> Floats:
        """Score of each guide as a share of what an identical copy would have, (k,)."""
        whole = [float(self.chains.most[c.grade, c.run]) for c in self.chains.found] + [GAIN] * len(self.alignments)
        return self._score / np.array(whole)

    @cached_property
    def _score(self) -> Floats:
        return np.array([guide.score for guide in self.every], dtype=np.float64)

    @cached_property
    def _way(self) -> tuple[Complex, Complex, NDArray[np.bool_]]:
        """Maps of a function's unknowns to the points looked at, where these should be, and who is mirrored."""
        picked = [np.linspace(0, len(g.source) - 1, LOOKED_AT).round().astype(int) for g in self.every]
        source = np.concatenate([g.source[at] for g, at in zip(self.every, picked, strict=True)])
        goal = np.concatenate([g.target[at] for g, at in zip(self.every, picked, strict=True)])
        return self.fitter.nodes.rows(source).T, goal, np.array([g.mirrored for g in self.every])

    @cached_property
    def _groups(self) -> tuple[Indices, Indices, Indices]:
        """The order of chains by grade and stretch as one number, which numbers there are, and where each begins."""
        grade = np.array([c.grade for c in self.chains.found], dtype=np.intp)
        run = np.array([c.run for c in self.chains.found], dtype=np.intp)
        group = grade * self.chains.most.shape[1] + run
        order = np.argsort(group, kind="stable")
        return order, *np.unique(group[order], return_index=True)

    def agreeing(self, unknowns: Complex, mirrored: NDArray[np.bool_]) -> Floats:
        """How far functions agree with each guide.

        Parameters
        ----------
        unknowns : (h, 2m) complex
        mirrored : (h,) bool

        Returns
        -------
        (h, k) float
            0 to 1; of the chains, then of the alignments.
        """
        if not self.every or not len(unknowns):
            return np.zeros((len(unknowns), len(self.every)))
        rows, goal, flip = self._way
        unit = np.abs(unknowns[:, len(self.fitter.nodes.at) :]).mean(1) * self.fitter.size
        gap = np.abs(unknowns @ rows - goal).reshape(len(unknowns), -1, LOOKED_AT).mean(2)
        share = np.exp(-0.5 * (gap / (AGREEING * unit[:, None])) ** 2)
        return np.where(mirrored[:, None] == flip, share, 0.0)

    def agreement(self, unknowns: Complex, mirrored: NDArray[np.bool_]) -> tuple[Floats, Floats]:
        """What the guides that agree with each function are worth.

        Parameters
        ----------
        unknowns : (h, 2m) complex
        mirrored : (h,) bool

        Returns
        -------
        chained : (h,) float
            Scores of the best chain of each grade and stretch, averaged over the grades and added over the stretches.
        aligned : (h,) float
            Score of the best alignment.
        """
        scores = self.agreeing(unknowns, mirrored) * self._score
        count = len(self.chains.found)
        best = np.zeros((len(unknowns), self.chains.most.size))
        if count:
            order, present, begin = self._groups
            best[:, present] = np.maximum(np.maximum.reduceat(scores[:, order], begin, axis=1), 0.0)
        chained = best.reshape(len(unknowns), *self.chains.most.shape)
        return chained.sum(2).mean(1), scores[:, count:].max(1, initial=0.0)
