"""Candidate poses of a footprint: its samples, moved rigidly, accumulate the level sets that they stand on.

Sides and corners of the footprint stand in relations as well as its centre, so that the plane of section 4.5 does not
suffice: positions are tried in the few directions that the features of an arrangement suggest.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import maximum_filter

from ..relations.elements import ElementType, ranges
from ..relations.table import Kind, Positional
from .candidates import MAXIMA, Candidates
from .fields import Fields
from .importance import Importance
from .kernels import wrap
from .matching import Answers

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

#: Most directions a footprint is tried in; the strongest suggestions that are tried as the middle of one; and the share
#: of all suggestions below which what is left is not worth a direction.
MOST_DIRECTIONS = 24
LEADS = 64
LEAST_SUGGESTED = 0.02

#: Suggested directions nearer than this, in radians, are the same but for rounding.
SAME_DIRECTION = 1e-9

#: Candidates whose wide importance is below this share of the best one's are not refined.
WORTH_REFINING = 0.45


def directions_read(importance: Importance) -> list[Positional]:
    """The relations whose reference directions are read from fields.

    The places of the samples tell directions from corners better, and a straight segment has one everywhere.

    Parameters
    ----------
    importance : Importance

    Returns
    -------
    list of Positional
    """
    fixed = {ElementType.CORNER}
    if importance.target.elements.heading(ElementType.SEGMENT) is not None:
        fixed.add(ElementType.SEGMENT)
    return [r for r in importance.relations if r.element not in fixed]


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
    rows, columns = np.arange(0, grid.rows, stride), np.arange(0, grid.columns, stride)
    lattice = rows[:, None] * grid.columns + columns
    numbers = np.arange(lattice.size).reshape(lattice.shape)
    open_cells = ~taken[lattice]
    closed = blocked.reshape(grid.rows, grid.columns)
    tried = directions(importance)
    if not tried:
        return Candidates(np.zeros((0, 2)), np.zeros(0), np.zeros(0))
    places = []
    for direction in tried:
        c, s = np.cos(direction), np.sin(direction)
        steps = grid.steps(importance.samples @ np.array([[c, s], [-s, c]]))
        (left, low), (right, high) = steps.min(axis=0), steps.max(axis=0)
        row, column = _fitting(low, high, stride, grid.rows), _fitting(left, right, stride, grid.columns)
        free = open_cells[row, column]
        if free.size:
            free = free.copy()
            for along, up in steps.tolist():
                free &= ~closed[_moved(row, up, stride), _moved(column, along, stride)]
        cells = numbers[row, column][free]
        # Where each sample of the footprint is.
        at = lattice.ravel()[cells] + (steps[:, 1] * grid.columns + steps[:, 0])[:, None]
        places.append(_Places(direction, cells, at))
    sheets = np.full((len(tried), lattice.size), -1.0, dtype=np.float32)
    for sheet, p, total in zip(sheets, places, _accumulate(importance, fields, places), strict=True):
        sheet[p.cells] = total
    sheets = sheets.reshape(len(tried), *lattice.shape)
    top = maximum_filter(sheets, size=(1, 3, 3), mode="constant", cval=-1.0)
    best = np.flatnonzero((sheets == top) & (sheets > 0))
    strength = sheets.ravel()[best]
    best = best[np.argsort(-strength, kind="stable")]
    # Not all from one direction.
    most = max(MAXIMA, importance.query.options.candidates)
    rank = np.cumsum(best[:, None] // lattice.size == np.arange(len(tried)), axis=0)
    best = best[rank[np.arange(len(best)), best // lattice.size] <= most][: 2 * most]
    strength = sheets.ravel()[best].astype(np.float64)
    chosen = strength >= WORTH_REFINING * strength.max(initial=0.0)
    which, cell = np.divmod(best[chosen], lattice.size)
    angle = np.array(tried)[which]
    return Candidates(grid.points[lattice.ravel()[cell]], angle, strength[chosen] / importance.query.total)


def _fitting(low: int, high: int, stride: int, size: int) -> slice:
    """Which of every so many-th place in a line keep within its size with what reaches from `low` to `high`."""
    return slice(max(0, math.ceil(-low / stride)), max(0, (size - 1 - high) // stride + 1))


def _moved(places: slice, by: int, stride: int) -> slice:
    """The grid points, some steps on, of every so many-th place in a line."""
    return slice(places.start * stride + by, (places.stop - 1) * stride + by + 1, stride)


@dataclass(frozen=True)
class _Places:
    """The places where a footprint is tried in one direction.

    Attributes
    ----------
    direction : float
    cells : ndarray of shape (n,), int
        Their numbers among all places of the lattice.
    samples : ndarray of shape (samples, n), int
        The grid points of the footprint's samples there.
    """

    direction: float
    cells: Indices
    samples: Indices


def _accumulate(importance: Importance, fields: Fields, places: list[_Places]) -> list[Array32]:
    """The importance at places, with wide level sets; per direction of shape (places,)."""
    direction = np.array([p.direction for p in places])
    count = [len(p.cells) for p in places]
    first = np.cumsum([0, *count])
    total = np.zeros(first[-1], dtype=np.float32)
    samples = np.concatenate([p.samples for p in places], axis=1)
    for element, a in importance.answers.items():
        sets = _LevelSets.of(importance, element, a)
        heading = importance.target.elements.heading(element)
        if heading is None:
            turned = None if element is ElementType.CORNER else np.repeat(direction, count).astype(np.float32)
            sets.add(total, fields, samples, turned)
            continue
        # The directional kernel is the same everywhere, and for all samples of a pair.
        lead = a.pair_start
        miss = direction[:, None, None] - heading[a.target[lead]] - a.turn.take(lead, axis=1)
        kernel = np.maximum(0, 1 - np.abs(wrap(miss)) / importance.query.options.direction_width)
        for one, start, end in zip(sets.aligned(a, kernel), first, first[1:], strict=False):
            one.add(total[start:end], fields, samples[:, start:end])
    return np.split(total, first[1:-1])


@dataclass(frozen=True)
class _LevelSets:
    """The level sets of one type of element, laid out for accumulation: an entry per pair of features and sample.

    Attributes
    ----------
    relations : sequence of Positional
    target, sample : ndarray of shape (e,), int
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
    value: Array32
    weight: Array32
    fall: Array32
    turn: Array32
    period: Sequence[Array32 | None]
    features: list[tuple[int, int, int]]
    tolerance: float

    @classmethod
    def of(cls, importance: Importance, element: ElementType, a: Answers) -> "_LevelSets":
        value = a.value.copy()
        periods: list[Array32 | None] = []
        for k, relation in enumerate(a.relations):
            if relation.kind is Kind.LENGTH:
                value[k] *= importance.scale
            period = None if relation.period is None else relation.period(importance.target.elements)[a.target]
            if period is None or not np.isfinite(period).any():
                periods.append(None)
                continue
            cyclic = np.isfinite(period)
            value[k, cyclic] %= period[cyclic]
            periods.append(period.astype(np.float32))
        weight = a.weight * np.repeat(a.accuracy, a.per_pair)
        return cls(
            element=element,
            relations=a.relations,
            target=a.target,
            sample=a.sample,
            value=value.astype(np.float32),
            weight=weight.astype(np.float32),
            fall=(weight / (WIDTH * importance.width)).astype(np.float32),
            turn=a.turn.astype(np.float32),
            period=periods,
            features=_features(a, np.zeros(len(a.accuracy), dtype=np.intp), np.arange(len(a.accuracy)), 1)[0],
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
            yield replace(
                self,
                target=target[part],
                sample=sample[part],
                value=value[:, part],
                weight=weight[:, part],
                fall=fall[:, part],
                turn=turn[:, part],
                period=[None if p is None else p[part] for p in period],
                features=features,
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
        most = max(LEAST_PLACES, MOST_VALUES // max(1, len(self.target)))
        for start in range(0, len(total) if len(self.target) else 0, most):
            part = slice(start, start + most)
            index = fields.index(self.element, self.target, samples[self.sample, part])
            met = self._met(fields, index, None if direction is None else direction[part])
            for first, end, count in self.features:
                pairs = met[first:end].reshape(-1, count, met.shape[1]).sum(axis=1)
                total[part] += pairs.max(axis=0)

    def _met(self, fields: Fields, index: Indices, direction: Array32 | None) -> Array32:
        """What every entry is worth at places; shape (e, n)."""
        met: Array32 | None = None
        for k, relation in enumerate(self.relations):
            worth = fields.value(relation, index)
            worth -= self.value[k, :, None]
            np.abs(worth, out=worth)
            period = self.period[k]
            if period is not None:
                np.minimum(worth, period[:, None] - worth, out=worth)
            if relation.kind is not Kind.LENGTH:
                worth *= fields.reach(relation, index)
            worth *= self.fall[k, :, None]
            np.subtract(self.weight[k, :, None], worth, out=worth)
            np.maximum(worth, 0, out=worth)
            if direction is not None:
                miss = direction - fields.direction(relation, index) - self.turn[k, :, None]
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


def directions(importance: Importance) -> list[float]:
    """The directions a footprint may take: along the features that answer, as the example is along its own.

    Parameters
    ----------
    importance : Importance

    Returns
    -------
    list of float
        Radians; strongest first, at least most of the directional kernel's width apart.
    """
    a = importance.answers.get(ElementType.SEGMENT)
    if a is None:
        base = importance.target.parent.main_orientation - importance.query.arrangement.parent.main_orientation
        quarters = base + importance.query.pose.angle + np.arange(4) * np.pi / 2
        return [float(q) for q in quarters[importance.query.is_upright(quarters, importance.mirrored)]]
    e = importance.target.elements
    strength = a.weight.sum(axis=0) * np.repeat(a.accuracy, a.per_pair)
    # A suggestion per entry and edge of its segment.
    edge, entry = np.nonzero(e.edge_segment[:, None] == a.target)
    angle = (e.edge_heading[edge] + a.turn[0, entry]) % (2 * np.pi)
    weight = strength[entry] * (e.edge_length / e.segment_length[e.edge_segment])[edge]
    upright = importance.query.is_upright(angle, importance.mirrored)
    angle, weight = angle[upright], weight[upright]
    # Most suggest one of a few directions.
    group = np.rint(angle / SAME_DIRECTION)
    _, first, same = np.unique(group, return_index=True, return_inverse=True)
    angle, weight = angle[first], np.bincount(same.ravel(), weights=weight)
    apart = 0.9 * importance.query.options.direction_width
    least = LEAST_SUGGESTED * weight.sum()
    left = weight.copy()
    result: list[float] = []
    while len(result) < MOST_DIRECTIONS and left.max(initial=0.0) > 0:
        # The angle that gathers most around it, then the mean of what it gathers.
        lead = np.argsort(-left, kind="stable")[:LEADS]
        near = np.abs(wrap(angle[lead][:, None] - angle)) < apart
        gathered = near @ left
        most = int(np.argmax(gathered))
        if result and gathered[most] < least:
            break
        best, middle = near[most], angle[lead[most]]
        share = np.maximum(left[best], 1e-12)
        mean = middle + (wrap(angle[best] - middle) @ share) / share.sum()
        result.append(float(mean % (2 * np.pi)))
        left[best] = 0.0
    return result
