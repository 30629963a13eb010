"""How far poses miss what is asked for, and what they meet of it: the sums of section 4.5."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..relations.elements import Elements, ElementType
from ..relations.runs import first_of, ranges, sizes
from ..relations.sighting import Sighting
from ..relations.table import Positional
from .kernels import level_set, wrap
from .part import Part
from .query import is_length, reference, side, turning
from .sheets import FAR

Array = NDArray[np.float64]
Bools = NDArray[np.bool_]
Indices = NDArray[np.intp]

#: Differences of ratios below this are none, where the ratio does not change with the point.
FLAT = 1e-6


@dataclass(slots=True)
class Misses:
    """How far poses miss the relations asked for, for one type of element.

    Attributes
    ----------
    seen : Sighting
        The elements of the rows, as their samples see them.
    place : ndarray of shape (relations, n)
        Signed distance in the plane from the level set, in scene units.
    turn : ndarray of shape (relations, n) or (1, n), or None
        Signed angle from the direction asked for, radians, and 0 where none is; of one row where all relations ask for
        the same; None: no row asks for any.
    allowed : ndarray of shape (n,), bool, or None
        Whether the sample is on the side asked for; None: all are.
    uphill : ndarray of shape (relations, n), complex, or None
        Direction of length 1 in which a sample would have to move for `place` to grow.
    """

    seen: Sighting
    place: Array
    turn: Array | None
    allowed: Bools | None
    uphill: NDArray[np.complex128] | None = None


class Rows:
    """Every pair of a pose and an entry of its importance, for one type of element.

    Parameters
    ----------
    part : Part
    which : ndarray of shape (m,), int
        The number of each pose's importance.
    width : ndarray of shape (m,)
        Half-width of the level sets of each pose, scene units.
    tolerance : float
        Half-width of directions, radians.

    Attributes
    ----------
    part : Part
    tolerance : float
    poses : int
        Their number.
    entry : ndarray of shape (n,), int
        The entry of each row.
    pose : ndarray of shape (n,), int
        The pose of each row; rows of one pose, and in it those of one pair of features, are neighbours.
    weight : ndarray of shape (relations, n)
    accuracy : ndarray of shape (pairs,)
    pair_start, feature_start : ndarray of int
        First row of every pair, and first pair of every feature of the example, pose by pose.
    """

    def __init__(self, part: Part, which: Indices, width: Array, tolerance: float) -> None:
        self.part = part
        self.tolerance = tolerance
        self.poses = len(which)
        #: Whether the rows are all the entries there are, in order.
        self._whole = len(which) == len(part.entries) and bool((which == np.arange(len(which))).all())
        if self._whole:
            self._entries, pairs, features = part.entries, part.pairs, part.features
            self.entry = np.arange(len(part.target))
            self.accuracy, self.weight = part.accuracy, part.weight
            pair_start, feature_start = part.pair_start, part.feature_start
        else:
            self._entries, pairs, features = part.entries[which], part.pairs[which], part.features[which]
            self.entry = ranges(part.first_entry[which], self._entries)
            pair = ranges(part.first_pair[which], pairs)
            self.accuracy, self.weight = part.accuracy[pair], part.weight.take(self.entry, axis=1)
            pair_start = part.pair_start[pair]
            feature_start = part.feature_start[ranges(part.first_feature[which], features)]
        first_row = first_of(self._entries)
        numbers = np.arange(len(which))
        self.pose = numbers.repeat(self._entries)
        self.pair_start = pair_start + first_row.repeat(pairs)
        self.feature_start = feature_start + first_of(pairs).repeat(features)
        self._feature_pose = numbers.repeat(features)
        #: Half-width of the level sets of each row.
        self.width = width[:1] if (width == width[:1]).all() else width[self.pose]
        self._held = self._entries.nonzero()[0]
        self._first_row = first_row[self._held]

    @property
    def element(self) -> ElementType:
        """The type of element that the rows are about."""
        return self.part.element

    @property
    def relations(self) -> tuple[Positional, ...]:
        """The relations to this type of element."""
        return self.part.relations

    @cached_property
    def per_pair(self) -> Indices:
        """Number of rows of each pair."""
        return sizes(self.pair_start, len(self.entry))

    @cached_property
    def per_feature(self) -> Indices:
        """Number of pairs of each feature of the example."""
        return sizes(self.feature_start, len(self.accuracy))

    @cached_property
    def directed(self) -> Bools:
        """Which rows ask for a direction; shape (n,)."""
        return self.part.directed if self._whole else self.part.directed[self.entry]

    @cached_property
    def _all_directed(self) -> bool | None:
        """Whether all rows ask for a direction; None: no row does."""
        return bool(self.directed.all()) if self.directed.any() else None

    @cached_property
    def elements(self) -> Elements:
        """The element of each row."""
        if self._whole and self.part.has_own_elements:
            return self.part.elements
        target = self.part.target
        return self.part.elements.take(self.part.element, target if self._whole else target[self.entry])

    @cached_property
    def asked(self) -> tuple[Array, Array, Array, Bools, Bools]:
        """Sample (x and y), value, turn, inner and contact of each row."""
        part = self.part
        if self._whole:
            return part.sample.T.copy(), part.value, part.turn, part.inner, part.contact < self.width
        e = self.entry
        sample = part.sample.take(e, axis=0).T.copy()
        return (
            sample,
            part.value.take(e, axis=1),
            part.turn.take(e, axis=1),
            part.inner[e],
            part.contact[e] < self.width,
        )

    @cached_property
    def _directions(self) -> int:
        """Number of directions that differ: 1 where all relations ask for the same."""
        turn = self.asked[2]
        same = len({r.directional for r in self.relations}) == 1 and bool((turn[1:] == turn[0]).all())
        return 1 if same else len(self.relations)

    @cached_property
    def _cycles(self) -> list[tuple[Bools, Array] | None]:
        """Per relation: which rows' values are cyclic, and their periods; None: none are."""
        cycles: list[tuple[Bools, Array] | None] = []
        for relation in self.relations:
            period = None if relation.period is None else relation.period(self.elements)
            cyclic = None if period is None else np.isfinite(period)
            cycles.append(None if period is None or cyclic is None or not cyclic.any() else (cyclic, period[cyclic]))
        return cycles

    def arms(self, angle: Array) -> tuple[Array, Array]:
        """The way from poses to their samples.

        Parameters
        ----------
        angle : ndarray of shape (m,)

        Returns
        -------
        x, y : ndarray of shape (n,)
        """
        sx, sy = self.asked[0]
        c, s = np.cos(angle).take(self.pose), np.sin(angle).take(self.pose)
        x, y = c * sx, s * sx
        x -= s * sy
        y += c * sy
        return x, y

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
        _, value, _, inner, near = self.asked
        element = self.part.element
        x, y = self.arms(angle)
        x += position[:, 0].take(self.pose)
        y += position[:, 1].take(self.pose)
        seen = Sighting(self.elements, element, x, y)
        signed = allowed = None
        if element is not ElementType.CORNER:  # which have no sides
            same = side(element, seen)[:, 0] == inner
            # Beyond a segment's ends no distance has a side.
            signed = same if element is not ElementType.SEGMENT else same | ~seen.segment.between[:, 0]
            # At a contact, on either side of it, the side means nothing but to the distance itself.
            allowed = near | (turning(element, seen)[:, 0] < self.width)
            allowed |= same
        place = np.empty((len(self.relations), len(self.entry)))
        grows = np.empty(place.shape, dtype=np.complex128) if uphill else None
        for k, relation in enumerate(self.relations):
            place[k] = self._off_level_set(k, value[k], seen, signed)
            if grows is not None:
                way = relation.uphill(seen)[:, 0]
                grows[k] = way if signed is None or not is_length(relation) else np.where(signed, way, -way)
        return Misses(seen, place, self._turned(angle, seen), allowed, grows)

    def _turned(self, angle: Array, seen: Sighting) -> Array | None:
        """Signed angles from the directions asked for."""
        if self._all_directed is None:
            return None
        turn = self.asked[2][: self._directions]
        miss = angle.take(self.pose) - turn
        for k, relation in enumerate(self.relations[: self._directions]):
            miss[k] -= reference(relation, seen)[:, 0]
        miss = wrap(miss)
        if not self._all_directed:
            miss *= self.directed
        return miss

    def _off_level_set(self, k: int, value: Array, seen: Sighting, signed: Bools | None) -> Array:
        """Difference in value divided by the slope: distance in the plane. Beyond a boundary distances are negative."""
        relation = self.relations[k]
        seen_value = relation.value(seen)[:, 0]
        if is_length(relation):
            return (seen_value if signed is None else np.where(signed, seen_value, -seen_value)) - value
        miss: Array = seen_value - value
        if (cycle := self._cycles[k]) is not None:
            cyclic, period = cycle
            if len(period) == len(miss):
                miss = wrap(miss, period)
            else:
                miss[cyclic] = wrap(miss[cyclic], period)
        slope = relation.slope(seen)[:, 0]
        sloping = slope > 0
        if sloping.all():
            return np.divide(miss, slope, out=miss)
        # Where the value does not change (beyond a segment's ends) the level set is reached everywhere or nowhere.
        nowhere = np.where(np.abs(miss) > FLAT, FAR, 0.0)
        return np.divide(miss, slope, out=nowhere, where=sloping)

    def kernel(self, misses: Misses) -> Array:
        """The kernel k of section 4.5: 1 on a level set, falling off linearly with the distance in the plane.

        Parameters
        ----------
        misses : Misses

        Returns
        -------
        ndarray of shape (relations, n)
        """
        away = np.abs(misses.place)
        away /= self.width
        kernel: Array = level_set(away)
        if misses.allowed is not None:
            kernel *= misses.allowed
        return kernel

    def directional(self, misses: Misses) -> Array | None:
        """The directional level sets' kernel, to be multiplied with the positional one.

        Parameters
        ----------
        misses : Misses

        Returns
        -------
        ndarray of shape (relations, n) or (1, n), or None
            1 where no direction is asked for; of one row where all relations ask for the same; None: 1 everywhere.
        """
        if misses.turn is None:
            return None
        kernel: Array = np.abs(misses.turn)
        kernel /= -self.tolerance
        kernel += 1.0
        return np.maximum(kernel, 0.0, out=kernel)

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
        return self.accuracy * np.add.reduceat(np.einsum("kn,kn->n", self.weight, kernel), self.pair_start)

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
        return np.bincount(self._feature_pose, weights=best, minlength=self.poses).astype(np.float64, copy=False)

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
        kernel = self.kernel(misses)
        directional = self.directional(misses)
        if directional is not None:
            kernel *= directional
        return self.of_poses(self.best(self.of_pairs(kernel)))
