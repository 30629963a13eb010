"""From candidates to answers: refined, free of what is in the way, apart from one another and ranked (section 4.5)."""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np
import shapely
from numpy.typing import NDArray

from ..relations.runs import run_starts, sizes
from .arrangement import Arrangement
from .candidates import Candidates
from .explanation import explain
from .giving_way import give_way
from .importance import Importance, arrangements_of
from .kernels import wrap
from .matching import Sense
from .pose import Pose, outlines_at
from .query import Query
from .refinement import refine
from .results import PropagatedPose, RelationShare
from .rivals import Refined
from .validation import Validation

Array = NDArray[np.float64]
Bools = NDArray[np.bool_]

#: Differences in importance below this are none: about what the refinement leaves.
EQUAL = 1e-4

#: Factor on the importance of answers in proportion to the room: of two equal answers the object at its own size is
#: preferred.
SCALED_FACTOR = 0.95

#: The object gives way from a place that may not be accepted where that is worth more than the best accepted one by
#: this factor: to give way costs about as much.
WORTH_GIVING_WAY = 1.2


@dataclass(frozen=True, slots=True)
class Found:
    """A place of an arrangement, before it is told: most give way to better ones.

    Attributes
    ----------
    worth : float
        Its importance, less what its size takes off.
    position : ndarray of shape (2,)
    angle : float
    importance : Importance
        What found it.
    """

    worth: float
    position: Array
    angle: float
    importance: Importance


class Answering:
    """What the candidates of an example lead to.

    Parameters
    ----------
    arrangement : Arrangement
        The example's.
    query : Query
        The example's.
    validation : Validation
        The example's.
    footprint : ndarray of shape (n, 2) or None
        Ring in the pose's frame.
    """

    def __init__(self, arrangement: Arrangement, query: Query, validation: Validation, footprint: Array | None) -> None:
        self._arrangement = arrangement
        self._query = query
        self._pose = query.pose
        self._options = query.options
        self._validation = validation
        self._footprint = footprint

    def answers(
        self, tried: Sequence[tuple[Importance, Candidates]], free: Callable[[Importance], Candidates]
    ) -> list[PropagatedPose]:
        """What the candidates of some arrangements lead to.

        Parameters
        ----------
        tried : sequence of (Importance, Candidates)
            Those of one arrangement are neighbours.
        free : callable
            Where the object is hardly in anything that it may not be in; asked where no candidate leads to an answer.

        Returns
        -------
        list of PropagatedPose
            Arrangement by arrangement, the best first.
        """
        importances = [importance for importance, _ in tried]
        factor = np.array([self._factor(i) for i in importances])
        refined = refine(importances, [candidates for _, candidates in tried], factor, self._stand, self._are_example)
        found: dict[Arrangement, list[Found]] = {i.target: [] for i in importances}
        refused = self._accept(importances, factor, refined, found)
        if self._footprint is not None and self._options.validate:
            beside = self._beside(importances, factor, refused, found, free)
            left = [k for k, c in enumerate(beside) if len(c.angle)]
            if left:
                importances, factor = [importances[k] for k in left], factor[left]
                aside = give_way(importances, [beside[k] for k in left], factor, self._stand)
                self._accept(importances, factor, aside, found)
        results = []
        for target, places in found.items():
            apart = self._apart(self._best_first(target, places))
            most = min(
                self._options.candidates, self._options.max_per.get(target.parent.label, self._options.candidates)
            )
            kept = self._best_first(target, self._passable(target, apart))[:most]
            results += [self._result(target, place) for place in kept]
        return results

    def _accept(
        self,
        importances: Sequence[Importance],
        factor: Array,
        poses: Refined,
        found: dict[Arrangement, list[Found]],
    ) -> Refined:
        """Add the poses that may be answers to what is found in their arrangements, and return the refused ones."""
        worth = poses.value * factor[poses.which]
        mirrored = np.array([i.mirrored for i in importances], dtype=bool)[poses.which]
        scale = np.array([i.scale for i in importances])[poses.which]
        good = worth >= self._options.threshold
        good &= self._query.is_upright(poses.angle, mirrored)
        accepted = np.zeros(len(worth), dtype=bool)
        for target, there in _by_arrangement(importances, poses):
            good[there] &= ~self.is_example(target, poses.position[there])
            k = there.start + np.flatnonzero(good[there])
            accepted[k] = self._validation.accepts(target, poses.position[k], poses.angle[k], mirrored[k], scale[k])
            k = k[accepted[k]]
            importance = [importances[w] for w in poses.which[k].tolist()]
            found[target] += map(Found, worth[k].tolist(), poses.position[k], poses.angle[k].tolist(), importance)
        return poses.of(good & ~accepted)

    def _beside(
        self,
        importances: Sequence[Importance],
        factor: Array,
        refused: Refined,
        found: dict[Arrangement, list[Found]],
        free: Callable[[Importance], Candidates],
    ) -> list[Candidates]:
        """Beside what the object gives way, of each importance: refused places that would be much the best."""
        beside = []
        for k, importance in enumerate(importances):
            least = WORTH_GIVING_WAY * max((place.worth for place in found[importance.target]), default=0.0)
            poses = refused.of((refused.which == k) & (refused.value * factor[k] > least))
            better = Candidates(poses.position, poses.angle, poses.value)
            beside.append(better if found[importance.target] else better.joined(free(importance)))
        return beside

    def _factor(self, importance: Importance) -> float:
        return 1.0 if importance.scale == 1.0 else SCALED_FACTOR

    def _stand(self, importances: Sequence[Importance], poses: Refined, slack: float) -> Bools:
        """Whether poses that move no further than `slack`, in half-widths of level sets, may be accepted."""
        targets, number = arrangements_of(importances)
        mirrored = np.array([i.mirrored for i in importances], dtype=bool)[poses.which]
        scale = np.array([i.scale for i in importances])[poses.which]
        target, slack = number[poses.which], slack * self._query.width
        return ~self._validation.hopeless(targets, target, poses.position, poses.angle, mirrored, scale, slack)

    def ranked(self, found: Sequence[PropagatedPose]) -> list[PropagatedPose]:
        """Best first; of equals, the object as it is before its mirror image, the least turned one first.

        Parameters
        ----------
        found : sequence of PropagatedPose

        Returns
        -------
        list of PropagatedPose
        """
        importance = np.array([p.importance for p in found])
        frame = np.array([p.parent.main_orientation for p in found])
        angle = np.array([p.pose.angle for p in found])
        mirrored = np.array([p.mirrored for p in found], dtype=bool)
        return [found[i] for i in self._order(importance, frame, angle, mirrored)]

    def _best_first(self, target: Arrangement, places: Sequence[Found]) -> list[Found]:
        """Places of one arrangement, ranked as results are."""
        worth = np.array([p.worth for p in places])
        angle = np.array([p.angle for p in places])
        mirrored = np.array([p.importance.mirrored for p in places], dtype=bool)
        return [places[i] for i in self._order(worth, target.parent.main_orientation, angle, mirrored)]

    def _order(self, worth: Array, frame: Array | float, angle: Array, mirrored: Bools) -> list[int]:
        """The numbers of poses in frames of a direction, in the order of `ranked`."""
        turned = frame - self._arrangement.parent.main_orientation
        turn = np.abs(wrap(angle - self._pose.angle - turned)).round(3)
        order = np.argsort(-worth, kind="stable")
        # Equals are those that the best of them is hardly better than.
        group = np.zeros(len(order), dtype=np.intp)
        first = 0
        for i in range(1, len(order)):
            if worth[order[first]] - worth[order[i]] > EQUAL:
                first = i
            group[order[i]] = first
        ranks: list[int] = np.lexsort((turn, mirrored != self._pose.mirrored, group)).tolist()
        return ranks

    def is_example(self, target: Arrangement, position: Array) -> Bools:
        """Whether poses are the example itself, or its mirror image in the same place.

        Parameters
        ----------
        target : Arrangement
        position : ndarray of shape (m, 2)

        Returns
        -------
        ndarray of shape (m,), bool
        """
        if not target.is_at(self._arrangement):
            return np.zeros(len(position), dtype=bool)
        return np.hypot(*(position - self._pose.position).T) < max(self._reach, self._query.width)

    def _are_example(self, importances: Sequence[Importance], poses: Refined) -> Bools:
        """Whether poses are the example itself."""
        found = np.zeros(len(poses.which), dtype=bool)
        for target, there in _by_arrangement(importances, poses):
            found[there] = self.is_example(target, poses.position[there])
        return found

    @cached_property
    def _reach(self) -> float:
        """Least distance between two results, in scene units: nearer ones are the same place."""
        if self._options.spacing is not None:
            return self._options.spacing
        if self._footprint is None:
            return 2 * self._query.width
        return float(np.ptp(self._footprint, axis=0).min()) / 2

    def _result(self, target: Arrangement, found: Found) -> PropagatedPose:
        """A place, as it is told."""
        position, angle, importance = found.position, found.angle, found.importance
        pose = Pose((position[0], position[1]), angle % math.tau % math.tau, importance.mirrored)
        # Results outlive the fields of their parents, so they hold none of them.
        surroundings = partial(Arrangement, target.parent, target.members)
        explain = partial(self._explain, surroundings, importance.sense, importance.scale, position, angle)
        return PropagatedPose(pose, found.worth, target.parent, importance.scale, explain)

    def _apart(self, places: list[Found]) -> list[Found]:
        """The best of one parent that keep their distance (non-maximum suppression)."""
        in_space = self._options.accumulation == "pose space"
        kept: list[Found] = []
        for p in places:
            # In pose space two directions at one place are two answers (figure 4.17).
            if not any(
                math.dist(p.position, k.position) < self._reach * p.importance.scale
                and not (in_space and abs(math.remainder(p.angle - k.angle, math.tau)) > self._options.direction_width)
                for k in kept
            ):
                kept.append(p)
        return kept

    def _passable(self, target: Arrangement, places: list[Found]) -> list[Found]:
        """The same, worth less as far as they are in the way where the example is not."""
        if self._footprint is None or not self._options.validate or not len(target.fronts) or not places:
            return places
        outlines = outlines_at(
            self._footprint,
            np.array([p.position for p in places]),
            np.array([p.angle for p in places]),
            np.array([p.importance.mirrored for p in places], dtype=bool),
            np.array([p.importance.scale for p in places]),
        )
        left = target.fronts.passable(outlines, self._in_front)
        less = (replace(p, worth=p.worth * f) for p, f in zip(places, left.tolist(), strict=True))
        return [p for p in less if p.worth >= self._options.threshold]

    @cached_property
    def _in_front(self) -> dict[str, float]:
        """How much of fronts the example covers."""
        if self._footprint is None:
            return {}
        return self._arrangement.fronts.covered_by(shapely.Polygon(self._pose.to_scene(self._footprint)))

    def _explain(
        self, surroundings: Callable[[], Arrangement], sense: Sense, scale: float, position: Array, angle: float
    ) -> tuple[RelationShare, ...]:
        return explain(Importance(self._query, surroundings(), sense, scale), position, angle)


def _by_arrangement(importances: Sequence[Importance], poses: Refined) -> Iterator[tuple[Arrangement, slice]]:
    """The arrangements that poses are in, and which those are."""
    targets, number = arrangements_of(importances)
    there = number[poses.which]
    first = run_starts(there)
    for start, size in zip(first.tolist(), sizes(first, len(there)).tolist(), strict=True):
        yield targets[there[start]], slice(start, start + size)
