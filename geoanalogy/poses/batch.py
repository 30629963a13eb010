"""The importance of section 4.5 for many poses in many arrangements at once.

Poses are moved onto maxima in small numbers per arrangement; what is evaluated here is a flat list of pairs of a pose
and one of the features that may answer there, so that a plan of rooms costs what its pairs cost.
"""

import copy
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..relations.elements import Elements, ElementType, ranges
from ..relations.sighting import Sighting
from ..relations.table import Positional
from .fields import FAR
from .kernels import WIDE_WIDTH, level_set, wrap
from .matching import Answers
from .query import is_length, reference, side, turning

if TYPE_CHECKING:
    from .importance import Importance

Array = NDArray[np.float64]
Bools = NDArray[np.bool_]
Indices = NDArray[np.intp]

#: Differences of ratios below this are none, where the ratio does not change with the point.
FLAT = 1e-6


@dataclass(frozen=True)
class Misses:
    """How far poses miss the relations asked for, for one type of element.

    Attributes
    ----------
    seen : Sighting
        The elements of the rows, as their samples see them.
    place : ndarray of shape (relations, n)
        Signed distance in the plane from the level set, in scene units.
    turn : ndarray of shape (relations, n)
        Signed angle from the direction asked for, radians; 0 where none is asked for.
    allowed : ndarray of shape (n,), bool
        Whether the sample is on the side asked for.
    uphill : ndarray of shape (relations, n), complex, or None
        Direction of length 1 in which a sample would have to move for `place` to grow.
    """

    seen: Sighting
    place: Array
    turn: Array
    allowed: Bools
    uphill: NDArray[np.complex128] | None = None


class Batch:
    """Several importances of one query, side by side.

    Parameters
    ----------
    importances : sequence of Importance
        All of the same query.
    share : float
        Pairs of features that can contribute less than this share of the strongest one of their type are left out.
    """

    def __init__(self, importances: "Sequence[Importance]", share: float = 0.0) -> None:
        self.query = importances[0].query
        width = np.array([i.width for i in importances])
        #: What counts as one step, per importance: the half-widths of level sets, twice, and of directions.
        self.unit = np.column_stack([width, width, np.full(len(width), self.query.options.direction_width)])
        targets = list(dict.fromkeys(i.target for i in importances))
        #: The number of each importance's arrangement.
        self.arrangement = np.array([targets.index(i.target) for i in importances])
        elements = Elements.joined([t.elements for t in targets])
        self._parts: dict[ElementType, _Part] = {}
        for element in ElementType:
            asked = [(k, i.answers[element]) for k, i in enumerate(importances) if element in i.answers]
            if asked:
                chosen = [(k, a.strongest(share) if share else a) for k, a in asked]
                first = np.cumsum([0, *(t.elements.count(element) for t in targets[:-1])])
                shift = [int(first[self.arrangement[k]]) for k, _ in chosen]
                self._parts[element] = _Part.of(element, elements, importances, chosen, shift)

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
        result = copy.copy(self)
        result.unit = self.unit[which]
        result.arrangement = self.arrangement[which]
        rows = self.rows(which)
        result._parts = {
            r.element: self._parts[r.element].among(r, *r.near(position, angle, reach, turn)) for r in rows
        }
        return result

    def rows(self, which: Indices) -> "list[Rows]":
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
        return [Rows(part, which, self) for part in self._parts.values()]

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

    def total(self, rows: "Sequence[Rows]", position: Array, angle: Array) -> Array:
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


@dataclass(frozen=True)
class _Part:
    """The answers of several importances, or poses, for one type of element, one after another.

    Attributes
    ----------
    entries, pairs, features : ndarray of shape (importances,), int
        How many each has.
    pair_start, feature_start : ndarray of int
        Counted from the first entry, and the first pair, of their importance.
    has_own_elements : bool
        Whether every entry has an element of its own, in order.
    """

    element: ElementType
    elements: Elements
    relations: tuple[Positional, ...]
    entries: Indices
    pairs: Indices
    features: Indices
    target: Indices
    sample: Array
    value: Array
    weight: Array
    turn: Array
    inner: Bools
    contact: Array
    directed: Bools
    accuracy: Array
    pair_start: Indices
    feature_start: Indices
    has_own_elements: bool = False

    @classmethod
    def of(
        cls,
        element: ElementType,
        elements: Elements,
        importances: "Sequence[Importance]",
        asked: Sequence[tuple[int, Answers]],
        shift: Sequence[int],
    ) -> "_Part":
        """`asked`: numbers of importances, and what they ask for; `shift`: their arrangements' first element."""
        answers = [a for _, a in asked]
        relations = answers[0].relations

        def per(count: str) -> Indices:
            size = np.zeros(len(importances), dtype=np.intp)
            for k, a in asked:
                size[k] = len(getattr(a, count))
            return size

        lengths = np.array([is_length(r) for r in relations])[:, None]
        scaled = [np.where(lengths, importances[k].scale, 1.0) * a.value for k, a in asked]
        return cls(
            element=element,
            elements=elements,
            relations=relations,
            entries=per("target"),
            pairs=per("pair_start"),
            features=per("feature_start"),
            target=np.concatenate([a.target + s for a, s in zip(answers, shift, strict=True)]),
            sample=np.concatenate([importances[k].samples[a.sample] for k, a in asked]),
            value=np.concatenate(scaled, axis=1),
            weight=np.concatenate([a.weight for a in answers], axis=1),
            turn=np.concatenate([a.turn for a in answers], axis=1),
            inner=np.concatenate([a.inner for a in answers]),
            contact=np.concatenate([a.contact for a in answers]),
            directed=np.concatenate([importances[k].directed(element, a.sample) for k, a in asked]),
            accuracy=np.concatenate([a.accuracy for a in answers]),
            pair_start=np.concatenate([a.pair_start for a in answers]),
            feature_start=np.concatenate([a.feature_start for a in answers]),
        )

    def among(self, rows: "Rows", kept: Bools, edges: Bools | None) -> "_Part":
        """The same pose by pose, with some of the pairs of rows, and of the edges of their elements.

        Every entry has an element of its own.
        """
        entry = np.repeat(kept, rows.per_pair)
        chosen = rows.entry[entry]
        answering = np.add.reduceat(kept.astype(np.intp), rows.feature_start) if len(kept) else np.zeros(0, np.intp)
        entries = np.bincount(rows.pose[entry], minlength=rows.poses)
        pairs = np.bincount(rows.pose[rows.pair_start[kept]], minlength=rows.poses)
        features = np.bincount(rows.pose[rows.pair_start[rows.feature_start[answering > 0]]], minlength=rows.poses)
        return replace(
            self,
            entries=entries,
            pairs=pairs,
            features=features,
            elements=rows.elements.take(self.element, np.flatnonzero(entry), edges),
            target=np.arange(len(chosen)),
            has_own_elements=True,
            sample=self.sample[chosen],
            value=self.value[:, chosen],
            weight=self.weight[:, chosen],
            turn=self.turn[:, chosen],
            inner=self.inner[chosen],
            contact=self.contact[chosen],
            directed=self.directed[chosen],
            accuracy=rows.accuracy[kept],
            pair_start=_starts(rows.per_pair[kept], entries, pairs),
            feature_start=_starts(answering[answering > 0], pairs, features),
        )


def _first(size: Indices) -> Indices:
    """Where neighbours of given sizes begin."""
    return np.cumsum(size) - size


def _starts(size: Indices, whole: Indices, parts: Indices) -> Indices:
    """Where neighbours of given sizes begin, counted from where the whole that they are parts of begins."""
    return _first(size) - np.repeat(_first(whole), parts)


class Rows:
    """Every pair of a pose and an entry of its importance, for one type of element.

    Attributes
    ----------
    pose : ndarray of shape (n,), int
        The pose of each row; rows of one pose, and in it those of one pair of features, are neighbours.
    weight : ndarray of shape (relations, n)
    accuracy : ndarray of shape (pairs,)
    pair_start, feature_start : ndarray of int
        First row of every pair, and first pair of every feature of the example, pose by pose.
    """

    def __init__(self, part: _Part, which: Indices, batch: Batch) -> None:
        self._part = part
        self._batch = batch
        self.poses = len(which)
        entries = part.entries[which]
        first_row = _first(entries)
        #: Whether the rows are all the entries there are, in order.
        self._whole = len(which) == len(part.entries) and bool((which == np.arange(len(which))).all())
        self.entry = ranges(_first(part.entries)[which], entries)
        self.pose = np.repeat(np.arange(len(which)), entries)
        pairs = part.pairs[which]
        pair = ranges(_first(part.pairs)[which], pairs)
        self.pair_start = part.pair_start[pair] + np.repeat(first_row, pairs)
        self.accuracy = part.accuracy[pair]
        features = part.features[which]
        first_pair = _first(pairs)
        feature = ranges(_first(part.features)[which], features)
        self.feature_start = part.feature_start[feature] + np.repeat(first_pair, features)
        self._feature_pose = np.repeat(np.arange(len(which)), features)
        self.weight = part.weight if self._whole else part.weight[:, self.entry]
        width = batch.unit[which, 0]
        #: Half-width of the level sets of each row.
        self.width = width[self.pose] if np.ptp(width) else np.full(1, width[0])
        self._held = np.flatnonzero(entries)
        self._first_row = first_row[self._held]

    @property
    def element(self) -> ElementType:
        """The type of element."""
        return self._part.element

    @property
    def relations(self) -> tuple[Positional, ...]:
        """The relations to this type of element."""
        return self._part.relations

    @cached_property
    def per_pair(self) -> Indices:
        """Number of rows of each pair."""
        return np.diff(np.append(self.pair_start, len(self.entry)))

    @cached_property
    def per_feature(self) -> Indices:
        """Number of pairs of each feature of the example."""
        return np.diff(np.append(self.feature_start, len(self.accuracy)))

    @cached_property
    def directed(self) -> Bools:
        """Which rows ask for a direction; shape (n,)."""
        return self._part.directed if self._whole else self._part.directed[self.entry]

    @cached_property
    def elements(self) -> Elements:
        """The element of each row."""
        if self._whole and self._part.has_own_elements:
            return self._part.elements
        return self._part.elements.take(self._part.element, self._part.target[self.entry])

    @cached_property
    def _asked(self) -> tuple[Array, Array, Array, Bools, Bools]:
        """Sample (x and y), value, turn, inner and contact of each row."""
        part = self._part
        e = slice(None) if self._whole else self.entry
        near = part.contact[e] < self.width
        return part.sample[e].T.copy(), part.value[:, e], part.turn[:, e], part.inner[e], near

    def arms(self, angle: Array) -> tuple[Array, Array]:
        """The way from poses to their samples.

        Parameters
        ----------
        angle : ndarray of shape (m,)

        Returns
        -------
        x, y : ndarray of shape (n,)
        """
        sx, sy = self._asked[0]
        c, s = np.cos(angle)[self.pose], np.sin(angle)[self.pose]
        return c * sx - s * sy, s * sx + c * sy

    def misses(self, position: Array, angle: Array, uphill: bool = False) -> Misses:
        """How far poses miss every relation asked for.

        Parameters
        ----------
        position : ndarray of shape (m, 2)
        angle : ndarray of shape (m,)
        uphill : bool
            Whether the directions in which the misses grow are wanted too.

        Returns
        -------
        Misses
        """
        _, value, turn, inner, near = self._asked
        element = self._part.element
        x, y = self.arms(angle)
        x += position[self.pose, 0]
        y += position[self.pose, 1]
        seen = Sighting(self.elements, element, x, y)
        same = side(element, seen)[:, 0] == inner
        # Beyond a segment's ends no distance has a side.
        signed = same if element is not ElementType.SEGMENT else same | ~seen.segment.between[:, 0]
        place = np.empty((len(self.relations), len(self.entry)))
        off = np.zeros_like(place)
        grows = np.empty(place.shape, dtype=np.complex128) if uphill else None
        directed = self.directed
        for k, relation in enumerate(self.relations):
            place[k] = self._off_level_set(relation, value[k], seen, signed)
            if directed.any():
                miss = angle[self.pose] - reference(relation, seen)[:, 0] - turn[k]
                off[k] = np.where(directed, wrap(miss), 0.0)
            if grows is not None:
                way = relation.uphill(seen)[:, 0]
                grows[k] = np.where(signed, way, -way) if is_length(relation) else way
        # At a contact, on either side of it, the side means nothing but to the distance itself.
        allowed = near | (turning(element, seen)[:, 0] < self.width) | same
        return Misses(seen, place, off, allowed, grows)

    def _off_level_set(self, relation: Positional, value: Array, seen: Sighting, same: Bools) -> Array:
        """Difference in value divided by the slope: distance in the plane. Beyond a boundary distances are negative."""
        seen_value = relation.value(seen)[:, 0]
        if is_length(relation):
            return np.where(same, seen_value, -seen_value) - value
        miss = seen_value - value
        if relation.period is not None:
            period = relation.period(seen.elements)
            cyclic = np.isfinite(period)
            if cyclic.any():
                miss[cyclic] = wrap(miss[cyclic], period[cyclic])
        slope = relation.slope(seen)[:, 0]
        # Where the value does not change (beyond a segment's ends) the level set is reached everywhere or nowhere.
        nowhere = np.where(np.abs(miss) > FLAT, FAR, 0.0)
        return np.divide(miss, slope, out=nowhere, where=slope > 0)

    def kernel(self, misses: Misses) -> Array:
        """The kernel k of section 4.5: 1 on a level set, falling off linearly with the distance in the plane.

        Parameters
        ----------
        misses : Misses

        Returns
        -------
        ndarray of shape (relations, n)
        """
        kernel: Array = level_set(np.abs(misses.place) / self.width)
        kernel *= misses.allowed
        return kernel

    def near(self, position: Array, angle: Array, reach: float, turn: float) -> tuple[Bools, Bools | None]:
        """The pairs of features that poses can meet without going far, and the edges that they come near to.

        Parameters
        ----------
        position : ndarray of shape (m, 2)
        angle : ndarray of shape (m,)
        reach : float
            How far they may move, in half-widths of level sets.
        turn : float
            How far they may turn, radians.

        Returns
        -------
        pairs : ndarray of shape (pairs,), bool
        edges : ndarray of shape (edges,), bool, or None
            Of the rows' elements; None: all.
        """
        if not len(self.entry):
            return np.zeros(0, dtype=bool), None
        misses = self.misses(position, angle)
        far = reach * self.width + turn * np.hypot(*self._asked[0])
        met = (np.abs(misses.place) < WIDE_WIDTH * self.width + far).any(axis=0)
        if self._part.elements.heading(self.element) is not None:  # the same everywhere
            met &= (np.abs(misses.turn) < self._batch.query.options.direction_width + turn).any(axis=0)
        edges = misses.seen.reachable_edges(far) if self.element is ElementType.POLYGON else None
        return np.logical_or.reduceat(met, self.pair_start), edges

    def directional(self, misses: Misses) -> Array:
        """The directional level sets' kernel, to be multiplied with the positional one.

        Parameters
        ----------
        misses : Misses

        Returns
        -------
        ndarray of shape (relations, n)
            1 where no direction is asked for.
        """
        return np.maximum(0.0, 1 - np.abs(misses.turn) / self._batch.query.options.direction_width)

    def of_pairs(self, kernel: Array) -> Array:
        """What every pair of features contributes, given the kernels of its rows: I_m times their weighted sum.

        Parameters
        ----------
        kernel : ndarray of shape (relations, n)

        Returns
        -------
        ndarray of shape (pairs,)
        """
        if not len(self.entry):
            return np.zeros(0)
        return self.accuracy * np.add.reduceat((self.weight * kernel).sum(axis=0), self.pair_start)

    def best(self, pairs: Array) -> Array:
        """The best pair of every feature of the example.

        Parameters
        ----------
        pairs : ndarray of shape (pairs,)

        Returns
        -------
        ndarray of shape (features,)
        """
        return np.maximum.reduceat(pairs, self.feature_start) if len(pairs) else pairs

    def of_poses(self, best: Array) -> Array:
        """Sums per pose of what its features contribute.

        Parameters
        ----------
        best : ndarray of shape (features,)

        Returns
        -------
        ndarray of shape (m,)
        """
        return np.bincount(self._feature_pose, weights=best, minlength=self.poses).astype(np.float64)

    def summed(self, rows: Array) -> Array:
        """Sums per pose of values per row.

        Parameters
        ----------
        rows : ndarray of shape (..., n)

        Returns
        -------
        ndarray of shape (..., m)
        """
        total = np.zeros((*rows.shape[:-1], self.poses))
        if len(self._held):
            total[..., self._held] = np.add.reduceat(rows, self._first_row, axis=-1)
        return total

    def total(self, misses: Misses) -> Array:
        """The importance of poses that this type of element contributes, not normalised.

        Parameters
        ----------
        misses : Misses

        Returns
        -------
        ndarray of shape (m,)
        """
        return self.of_poses(self.best(self.of_pairs(self.kernel(misses) * self.directional(misses))))
