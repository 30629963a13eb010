"""Candidate poses of a footprint: its samples, moved rigidly, accumulate the level sets that they stand on.

Sides and corners of the footprint stand in relations as well as its centre, so that the plane of section 4.5 does not
suffice: positions are tried in the few directions that the features of an arrangement suggest.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..relations.elements import ElementType
from ..relations.runs import ranges
from ..relations.table import Kind, Positional
from .candidates import MAXIMA, Candidates
from .directions import directions
from .fields import Fields
from .importance import Importance
from .kernels import wrap
from .matching import Answers
from .sheets import Grid

Array = NDArray[np.float64]
Array32 = NDArray[np.float32]
Indices = NDArray[np.intp]

#: Least distance between neighbouring candidate places (the next whole step of the grid), and half-width of the level
#: sets they are found with, in half-widths of the exact ones: coarse enough to be cheap, so wide that every exact
#: maximum has a candidate on its slope.
STEP = 1.2
WIDTH = 3.0

#: How deep inside an obstacle a sample at a candidate place may be, in the same unit: its maximum is up to a step away.
SLACK = 1.5

#: Pairs of features that can contribute less than this share of the strongest one are left out where places are only
#: looked for.
STRONG = 0.15

#: Values held at once while level sets are accumulated: what a processor's cache holds; and places at the least.
MOST_VALUES = 1 << 17
LEAST_PLACES = 64

#: Candidates whose wide importance is below this share of the best one's are not refined.
WORTH_REFINING = 0.45


def find_footprint_candidates(
    importance: Importance, fields: Fields, blocked: NDArray[np.bool_], taken: NDArray[np.bool_]
) -> Candidates:
    """The maxima of what all samples of a footprint accumulate.

    Parameters
    ----------
    importance : Importance
        Of the arrangement, for one sense and scale.
    fields : Fields
        The arrangement's, with the importance's relations evaluated.
    blocked : ndarray of shape (points,), bool
        Grid points where no part of the object may be.
    taken : ndarray of shape (points,), bool
        Grid points where its position may not be.

    Returns
    -------
    Candidates
    """
    grid = fields.grid
    stride = max(1, math.ceil(STEP * importance.width / grid.spacing))
    importance = importance.of_strongest(STRONG)
    tried = directions(importance)
    if not len(tried):
        return Candidates(np.zeros((0, 2)), np.zeros(0), np.zeros(0))
    rows, columns = np.arange(0, grid.rows, stride), np.arange(0, grid.columns, stride)
    lattice = rows[:, None] * grid.columns + columns
    places = _places(importance, grid, tried, (rows, columns), ~(taken | blocked)[lattice], blocked)
    # A border all around, so that every place has neighbours.
    sheets = np.full((len(tried), len(rows) + 2, len(columns) + 2), -1.0, dtype=np.float32)
    inner = sheets[:, 1:-1, 1:-1]
    inner[places.which, places.row, places.column] = _accumulate(importance, fields, places)
    top = np.maximum(np.maximum(sheets[:, :-2], sheets[:, 1:-1]), sheets[:, 2:])
    top = np.maximum(np.maximum(top[:, :, :-2], top[:, :, 1:-1]), top[:, :, 2:])
    best = np.flatnonzero((inner == top) & (inner > 0))
    found = inner.ravel()
    best = best[np.argsort(-found[best], kind="stable")]
    # Not all from one direction.
    most = max(MAXIMA, importance.query.options.candidates)
    which, cell = np.divmod(best, lattice.size)
    rank = np.cumsum(which[:, None] == np.arange(len(tried)), axis=0)
    chosen = np.flatnonzero(rank[np.arange(len(best)), which] <= most)[: 2 * most]
    strength = found[best[chosen]].astype(np.float64)
    worth = strength >= WORTH_REFINING * strength.max(initial=0.0)
    chosen, strength = chosen[worth], strength[worth]
    return Candidates(
        grid.points[lattice.ravel()[cell[chosen]]], tried[which[chosen]], strength / importance.query.total
    )


@dataclass(frozen=True)
class _Places:
    """The places where a footprint is tried, those of one direction after those of another.

    Attributes
    ----------
    directions : ndarray of shape (d,)
    which : ndarray of shape (n,), int
        The number of each place's direction, ascending.
    row, column : ndarray of shape (n,), int
        In the lattice.
    samples : ndarray of shape (samples, n), int
        The grid points of the footprint's samples there.
    """

    directions: Array
    which: Indices
    row: Indices
    column: Indices
    samples: Indices


def _places(
    importance: Importance,
    grid: Grid,
    tried: Array,
    lattice: tuple[Indices, Indices],
    free: NDArray[np.bool_],
    blocked: NDArray[np.bool_],
) -> _Places:
    """The places of a lattice, given by its rows and columns in the grid, where no sample is outside or blocked."""
    c, s = np.cos(tried), np.sin(tried)
    turns = np.ascontiguousarray(np.array([[c, s], [-s, c]]).transpose(2, 0, 1))
    steps = grid.steps(importance.samples @ turns).transpose(1, 0, 2)
    # Of every sample and direction.
    row, column = lattice[0] + steps[:, :, 1:], lattice[1] + steps[:, :, :1]
    inside = ((row >= 0) & (row < grid.rows)).all(axis=0)[:, :, None]
    inside = inside & ((column >= 0) & (column < grid.columns)).all(axis=0)[:, None]
    which, i, j = np.nonzero(free & inside)
    row *= grid.columns
    count = len(importance.samples)
    samples = row.reshape(count, -1).take(which * len(lattice[0]) + i, axis=1)
    samples += column.reshape(count, -1).take(which * len(lattice[1]) + j, axis=1)
    kept = np.flatnonzero(~blocked.take(samples).any(axis=0))
    return _Places(tried, which[kept], i[kept], j[kept], samples.take(kept, axis=1))


def _accumulate(importance: Importance, fields: Fields, places: _Places) -> Array32:
    """The importance at places, with wide level sets; shape (places,)."""
    total = np.zeros(len(places.which), dtype=np.float32)
    ends = np.cumsum(np.bincount(places.which, minlength=len(places.directions))).tolist()
    for element, a in importance.answers.items():
        heading = importance.target.elements.heading(element)
        sets = _LevelSets.of(importance, element, a, shared=heading is None)
        if heading is None:
            turned = None if element is ElementType.CORNER else places.directions[places.which].astype(np.float32)
            sets.add(total, fields, places.samples, turned)
            continue
        # The directional kernel is the same everywhere, and for all samples of a pair.
        lead = a.pair_start
        miss = places.directions[:, None, None] - heading[a.target[lead]] - a.turn.take(lead, axis=1)
        kernel = np.maximum(0, 1 - np.abs(wrap(miss)) / importance.query.options.direction_width)
        for one, start, end in zip(sets.aligned(a, kernel), [0, *ends], ends, strict=False):
            one.add(total[start:end], fields, places.samples[:, start:end])
    return total


@dataclass(slots=True)
class _LevelSets:
    """The level sets of one type of element, laid out for accumulation: an entry per pair of features and sample.

    Attributes
    ----------
    relations : sequence of Positional
    target, sample : ndarray of shape (e,), int
        Or what of both is read, where several entries share it: then
    spread : ndarray of shape (e,), int, or None
        is which of that each entry reads.
    value, weight, fall, turn : ndarray of shape (relations, e)
        The value asked for, what meeting it is worth, how much less it is worth per scene unit, and the direction.
    period : sequence of (ndarray of shape (e,) or None)
        Of values, per relation.
    features : list of (int, int, int)
        First entry, end and number of samples of each feature of the example: all its pairs have the same samples.
    tolerance : float
        Half-width of directions.
    """

    element: ElementType
    relations: Sequence[Positional]
    target: Indices
    sample: Indices
    spread: Indices | None
    value: Array32
    weight: Array32
    fall: Array32
    turn: Array32
    period: Sequence[Array32 | None]
    features: list[tuple[int, int, int]]
    tolerance: float

    @classmethod
    def of(cls, importance: Importance, element: ElementType, a: Answers, shared: bool) -> "_LevelSets":
        value = a.value.copy()
        periods: list[Array32 | None] = []
        for k, relation in enumerate(a.relations):
            if relation.kind is Kind.LENGTH:
                value[k] *= importance.scale
            period = None if relation.period is None else relation.period(importance.target.elements)
            cyclic = None if period is None else np.isfinite(period)
            if period is None or cyclic is None or not cyclic.any():
                periods.append(None)
                continue
            period, cyclic = period[a.target], cyclic[a.target]
            value[k, cyclic] %= period[cyclic]
            periods.append(period.astype(np.float32))
        weight = a.layout.worth
        target, sample, spread = a.layout.looks if shared else (a.target, a.sample, None)
        return cls(
            element=element,
            relations=a.relations,
            target=target,
            sample=sample,
            spread=spread,
            value=value.astype(np.float32),
            weight=weight.astype(np.float32),
            fall=(weight / (WIDTH * importance.width)).astype(np.float32),
            turn=a.turn.astype(np.float32),
            period=periods,
            features=a.layout.features,
            tolerance=importance.query.options.direction_width,
        )

    def aligned(self, a: Answers, kernel: Array) -> "Iterator[_LevelSets]":
        """In several directions: the pairs that have them, worth so much less.

        Parameters
        ----------
        a : Answers
            That these level sets are of.
        kernel : ndarray of shape (directions, relations, pairs)

        Yields
        ------
        _LevelSets
            One per direction.
        """
        which, pair = np.nonzero(kernel.any(axis=1))
        size = a.per_pair[pair]
        entry = ranges(a.pair_start[pair], size)
        factor = np.repeat(kernel[which, :, pair].T.astype(np.float32), size, axis=1)
        value, turn = self.value.take(entry, axis=1), self.turn.take(entry, axis=1)
        weight, fall = self.weight.take(entry, axis=1) * factor, self.fall.take(entry, axis=1) * factor
        target, sample = self.target[entry], self.sample[entry]
        period = [None if p is None else p[entry] for p in self.period]
        ends = np.bincount(which, weights=size, minlength=len(kernel)).cumsum().astype(np.intp).tolist()
        for start, end, features in zip([0, *ends], ends, _features(a, which, pair, len(kernel)), strict=False):
            part = slice(start, end)
            yield _LevelSets(
                element=self.element,
                relations=self.relations,
                target=target[part],
                sample=sample[part],
                spread=None,
                value=value[:, part],
                weight=weight[:, part],
                fall=fall[:, part],
                turn=turn[:, part],
                period=[None if p is None else p[part] for p in period],
                features=features,
                tolerance=self.tolerance,
            )

    def add(self, total: Array32, fields: Fields, samples: Indices, direction: Array32 | None = None) -> None:
        """Add what places meet.

        Parameters
        ----------
        total : ndarray of shape (n,)
            Added to.
        fields : Fields
        samples : ndarray of shape (samples, n), int
            The grid points of the footprint's samples.
        direction : ndarray of shape (n,), optional
            Of the footprint; None: directions do not count.
        """
        entries = self.value.shape[1]
        most = max(LEAST_PLACES, MOST_VALUES // max(1, entries))
        for start in range(0, len(total) if entries else 0, most):
            part = slice(start, start + most)
            index = fields.index(self.element, self.target, samples[self.sample, part])
            met = self._met(fields, index, None if direction is None else direction[part])
            here = total[part]
            for first, end, count in self.features:
                pairs = met[first:end]
                if count > 1:
                    pairs = np.add.reduce(pairs.reshape(-1, count, len(here)), axis=1)
                here += pairs[0] if len(pairs) == 1 else np.maximum.reduce(pairs, axis=0)

    def _of_entries(self, read: Array32) -> Array32:
        """What is read at places, for every entry."""
        return read if self.spread is None else read.take(self.spread, axis=0)

    def _met(self, fields: Fields, index: Indices, direction: Array32 | None) -> Array32:
        """What every entry is worth at places; shape (e, n)."""
        met: Array32 | None = None
        for k, relation in enumerate(self.relations):
            worth = self._of_entries(fields.value(relation, index))
            worth -= self.value[k, :, None]
            np.abs(worth, out=worth)
            period = self.period[k]
            if period is not None:
                np.minimum(worth, period[:, None] - worth, out=worth)
            if relation.kind is not Kind.LENGTH:
                worth *= self._of_entries(fields.reach(relation, index))
            worth *= self.fall[k, :, None]
            np.subtract(self.weight[k, :, None], worth, out=worth)
            np.maximum(worth, 0, out=worth)
            if direction is not None:
                miss = direction - self._of_entries(fields.direction(relation, index)) - self.turn[k, :, None]
                worth *= np.maximum(0, 1 - np.abs(wrap(miss)) / np.float32(self.tolerance))
            met = worth if met is None else np.add(met, worth, out=met)
        assert met is not None
        return met


def _features(a: Answers, which: Indices, pair: Indices, count: int) -> list[list[tuple[int, int, int]]]:
    """Of the pairs chosen in several directions, per direction: the features they belong to.

    `which`: number of the direction, ascending; `pair`: ascending in each; `count`: number of directions.
    """
    features: list[list[tuple[int, int, int]]] = [[] for _ in range(count)]
    owner = a.source_feature[pair].tolist()
    direction, before, end = -1, -1, 0
    for k, of, size in zip(which.tolist(), owner, a.per_pair[pair].tolist(), strict=True):
        if k != direction:
            direction, before, end = k, -1, 0
        start = end
        if of == before:
            start = features[k].pop()[0]
        end += size
        features[k].append((start, end, size))
        before = of
    return features
