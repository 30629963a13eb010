"""How well poses answer the example: the importance of section 4.5, evaluated exactly at any pose."""

import copy
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..relations.elements import ElementType
from ..relations.observation import Observation
from ..relations.table import Positional
from .arrangement import FAR, Arrangement
from .matching import Answers, Sense, answers
from .query import Query, distance, is_length, reference, side
from .results import RelationShare

Array = NDArray[np.float64]

#: The level sets' kernel is a narrow linear fall-off on a wide, low one: rooms of another size meet the example's
#: relations only nearly, and among places that miss them the nearer miss should win. Share of the wide part, and its
#: width in narrow ones.
WIDE_SHARE = 0.3
WIDE_WIDTH = 5.0


@dataclass(frozen=True)
class Misses:
    """How far poses miss the relations asked for, for one type of element.

    Attributes
    ----------
    place : ndarray of shape (relations, e, poses)
        Signed distance in the plane from the level set, in scene units.
    turn : ndarray of shape (relations, e, poses)
        Signed angle from the direction asked for, radians.
    allowed : ndarray of shape (e, poses), bool
        Whether the sample is on the side asked for.
    uphill : ndarray of shape (relations, e, poses) or None
        Direction in which a sample would have to move for `place` to grow, radians.
    """

    place: Array
    turn: Array
    allowed: NDArray[np.bool_]
    uphill: Array | None = None


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
    """

    def __init__(self, query: Query, target: Arrangement, sense: Sense, scale: float = 1.0) -> None:
        self.query = query
        self.target = target
        self.sense = sense
        self.scale = scale
        self.width = query.width * scale
        #: Whether poses are mirrored: an example that is mirrored itself has answers the other way about.
        self.mirrored = sense.mirrored != query.pose.mirrored
        self.samples = query.samples * scale * ((1.0, -1.0) if self.mirrored else (1.0, 1.0))
        self.answers = answers(query, target, sense)

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
        result = copy.copy(self)
        result.answers = {element: a.strongest(share) for element, a in self.answers.items()}
        return result

    @property
    def bound(self) -> float:
        """The greatest importance any pose here can have: what every feature's best pair would give."""
        total = 0.0
        for a in self.answers.values():
            pairs = a.accuracy * np.add.reduceat(a.weight.sum(axis=0), a.pair_start)
            total += float(np.maximum.reduceat(pairs, a.feature_start).sum())
        return total / self.query.total if self.query.total else 0.0

    def sample_points(self, position: Array, angle: Array) -> Array:
        """Where the samples of poses are.

        Parameters
        ----------
        position : ndarray of shape (m, 2)
        angle : ndarray of shape (m,)

        Returns
        -------
        ndarray of shape (s, m, 2)
        """
        c, s = np.cos(angle), np.sin(angle)
        x = position[:, 0] + np.multiply.outer(self.samples[:, 0], c) - np.multiply.outer(self.samples[:, 1], s)
        y = position[:, 1] + np.multiply.outer(self.samples[:, 0], s) + np.multiply.outer(self.samples[:, 1], c)
        return np.stack([x, y], axis=-1)

    def misses(self, position: Array, angle: Array, uphill: bool = False) -> dict[ElementType, Misses]:
        """How far poses miss every relation asked for.

        Parameters
        ----------
        position : ndarray of shape (m, 2)
        angle : ndarray of shape (m,)
        uphill : bool
            Whether the directions in which the misses grow are wanted too.

        Returns
        -------
        dict of ElementType to Misses
        """
        points = self.sample_points(position, angle)
        count, m = points.shape[:2]
        seen = Observation(self.target.elements, points.reshape(-1, 2))
        shape = (-1, count, m)
        result = {}
        for element, a in self.answers.items():
            at = (a.target, a.sample)
            same = side(element, seen).reshape(shape)[at] == a.inner[:, None]
            place, turn, grows = [], [], []
            for k, relation in enumerate(a.relations):
                place.append(self._off_level_set(relation, a, k, seen, shape, same))
                turn.append(wrap(angle - reference(relation, seen).reshape(shape)[at] - a.turn[k][:, None]))
                if uphill:
                    away = relation.uphill(seen).reshape(shape)[at]
                    grows.append(np.where(same, away, away + np.pi) if is_length(relation) else away)
            # At a contact, on either side of it, the side means nothing but to the distance itself.
            near = (a.contact[:, None] < self.width) | (distance(element, seen).reshape(shape)[at] < self.width)
            result[element] = Misses(np.array(place), np.array(turn), near | same, np.array(grows) if uphill else None)
        return result

    def _off_level_set(
        self,
        relation: Positional,
        a: Answers,
        k: int,
        seen: Observation,
        shape: tuple[int, ...],
        same: NDArray[np.bool_],
    ) -> Array:
        """Difference in value divided by the slope: distance in the plane. Beyond a boundary distances are negative."""
        at = (a.target, a.sample)
        seen_value = relation.value(seen).reshape(shape)[at]
        if is_length(relation):
            return np.where(same, seen_value, -seen_value) - a.value[k][:, None] * self.scale
        miss = seen_value - a.value[k][:, None]
        if relation.period is not None:
            period = relation.period(self.target.elements)[a.target][:, None]
            cyclic = np.isfinite(period[:, 0])
            miss[cyclic] = wrap(miss[cyclic], period[cyclic])
        slope = np.broadcast_to(relation.slope(seen), (len(relation.value(seen)), len(seen.points))).reshape(shape)[at]
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
        ndarray of shape (relations, e, poses)
        """
        away = np.abs(misses.place) / self.width
        k: Array = (1 - WIDE_SHARE) * np.maximum(0.0, 1 - away) + WIDE_SHARE * np.maximum(0.0, 1 - away / WIDE_WIDTH)
        return np.where(misses.allowed, k, 0.0)

    def directional(self, element: ElementType, misses: Misses) -> Array:
        """The directional level sets' kernel, to be multiplied with the positional one.

        Parameters
        ----------
        element : ElementType
        misses : Misses

        Returns
        -------
        ndarray of shape (relations, e, poses)
        """
        k: Array = np.maximum(0.0, 1 - np.abs(misses.turn) / self.query.options.direction_width)
        return np.where(self.directed(element)[:, None], k, 1.0)

    def directed(self, element: ElementType) -> NDArray[np.bool_]:
        """Which entries ask for a direction.

        Where sides and corners of a footprint are samples, their places tell the direction, and better: at a contact
        with a corner the direction of the boundary is one edge's or the other's by a rounding error. Segments have one
        direction.

        Parameters
        ----------
        element : ElementType

        Returns
        -------
        ndarray of shape (e,), bool
        """
        a = self.answers[element]
        if not self.query.rigid or element is ElementType.SEGMENT:
            return np.ones(len(a.sample), dtype=bool)
        return (a.sample == 0) & (element is ElementType.POLYGON)

    def pairs(self, position: Array, angle: Array) -> dict[ElementType, Array]:
        """What every pair of features contributes: I_m times the weighted kernels of all its relations and samples.

        Parameters
        ----------
        position : ndarray of shape (m, 2)
        angle : ndarray of shape (m,)

        Returns
        -------
        dict of ElementType to ndarray of shape (pairs, m)
        """
        result = {}
        for element, misses in self.misses(position, angle).items():
            result[element] = self.of_pairs(element, self.kernel(misses) * self.directional(element, misses))
        return result

    def of_pairs(self, element: ElementType, kernel: Array) -> Array:
        """What every pair contributes, given the kernels of its entries.

        Parameters
        ----------
        element : ElementType
        kernel : ndarray of shape (relations, e, m)

        Returns
        -------
        ndarray of shape (pairs, m)
        """
        a = self.answers[element]
        entries = np.einsum("re,rem->em", a.weight, kernel)
        return a.accuracy[:, None] * np.add.reduceat(entries, a.pair_start, axis=0)

    def __call__(self, position: Array, angle: Array) -> Array:
        """The importance of poses, 1 for a perfect copy.

        Parameters
        ----------
        position : ndarray of shape (m, 2)
        angle : ndarray of shape (m,)

        Returns
        -------
        ndarray of shape (m,)
        """
        total = np.zeros(len(position))
        for element, pairs in self.pairs(position, angle).items():
            total += np.maximum.reduceat(pairs, self.answers[element].feature_start, axis=0).sum(axis=0)
        return total / self.query.total if self.query.total else total

    def explain(self, position: Array, angle: float) -> tuple[RelationShare, ...]:
        """Which relations carry one pose (figure 4.14).

        Parameters
        ----------
        position : ndarray of shape (2,)
        angle : float

        Returns
        -------
        tuple of RelationShare
            Largest first; their weights add up to the importance.
        """
        shares = []
        for element, misses in self.misses(position[None], np.array([angle])).items():
            a = self.answers[element]
            k = self.kernel(misses) * self.directional(element, misses)
            per_relation = np.add.reduceat(a.weight * k[..., 0], a.pair_start, axis=1) * a.accuracy
            for start, end in zip(a.feature_start, np.append(a.feature_start[1:], len(a.accuracy)), strict=True):
                best = start + int(np.argmax(per_relation[:, start:end].sum(axis=0)))
                source = _place(self.query.arrangement, element, a.source_feature[best])
                target = _place(self.target, element, a.target_feature[best])
                for relation, weight in zip(a.relations, per_relation[:, best], strict=True):
                    if weight > 0:
                        share = float(weight / self.query.total)
                        shares.append(RelationShare(relation.name, source[0], target[0], source[1], target[1], share))
        return tuple(sorted(shares, key=lambda s: -s.weight))


#: Differences of ratios below this are none, where the ratio does not change with the point.
FLAT = 1e-6


def wrap(difference: NDArray[Any], period: NDArray[Any] | float = 2 * np.pi) -> NDArray[Any]:
    """A cyclic difference in the interval around zero: at most half a period in size.

    Parameters
    ----------
    difference : ndarray
    period : ndarray or float

    Returns
    -------
    ndarray
    """
    return difference - period * np.rint(difference / period)  # several times as fast as the remainder


def _place(arrangement: Arrangement, element: ElementType, feature: int) -> tuple[str, int]:
    """Id of the polygon of a feature, and the feature's number in it."""
    polygon_of = arrangement.elements.polygon_of(element)
    polygon = polygon_of[feature]
    return str(arrangement.elements.polygons[polygon].id), int(feature - np.flatnonzero(polygon_of == polygon)[0])
