"""An example taken from its scene, and the steps of section 4.2 (figure 4.4) that find its analogues put together."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cached_property, partial
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from ..arguments import given
from ..errors import InputError
from ..geometry.polygon import Polygon
from ..geometry.scene import Scene
from ..progress import Progress, Stepper, run
from ..relations.elements import keep_features
from .arrangement import Arrangement, arrangement_of
from .candidates import Candidates, find_candidates
from .directions import directions_read
from .explanation import explain
from .fields import Fields
from .footprint_candidates import SLACK, STRONG, find_footprint_candidates
from .giving_way import FREE, give_way
from .importance import Importance
from .kernels import wrap
from .matching import Matching, Sense, senses
from .options import PoseOptions
from .pose import Pose, footprint_ring
from .query import Query
from .refinement import refine
from .results import PoseResults, PropagatedPose, RelationShare
from .rivals import Refined
from .validation import JUTTING_SHARE, Validation

Array = NDArray[np.float64]
Indices = NDArray[np.intp]

#: Importance, position, angle, and the importance that they are of.
Found = tuple[float, Array, float, Importance]

#: Differences in importance below this are none: about what the refinement leaves.
EQUAL = 1e-4

#: Rooms within this share of the example's size are of its size: in proportion to the room (option `scale`) is then
#: the same as fixed.
SAME_SIZE = 0.01

#: Factor on the importance of answers in proportion to the room: of two equal answers the object at its own size is
#: preferred.
SCALED_FACTOR = 0.95

#: Parents whose candidates are refined together: enough that little is spent on each, and so few that a plan of
#: thousands of rooms is not held at once.
TOGETHER = 16

#: Grid points of one parent at most, in proportion to those wanted over all.
MOST_CELLS = 4

#: Grid spacing at least, in half-widths of level sets: finer grids find nothing that the refinement would not. The
#: level sets that places of footprints are found with are wider.
FINEST = 0.5
FINEST_OF_FOOTPRINTS = 0.8


class PoseModel:
    """An example, ready to be propagated in any scene: the pose in its surroundings.

    Parameters
    ----------
    source : Scene
        The example's parent polygon and its members.
    parent : Polygon
        The polygon of `source` that the example stands in.
    pose : Pose
    footprint : ndarray of shape (n, 2) or None
        Ring in the pose's frame.
    options : PoseOptions
    """

    def __init__(
        self, source: Scene, parent: Polygon, pose: Pose, footprint: Array | None, options: PoseOptions
    ) -> None:
        self.source = source
        self.parent = parent
        self.pose = pose
        self.footprint = footprint
        self.options = options
        self._arrangement = arrangement_of(source, parent)
        self.query = Query(self._arrangement, pose, footprint, options)
        self._validation = Validation(self._arrangement, pose, footprint, options)

    def place(self, scene: Scene, progress: Progress | None = None) -> PoseResults:
        """Find all places of a scene that answer the example.

        Parameters
        ----------
        scene : Scene
            The example's own or another one.
        progress : callable (fraction, text) -> bool, optional
            Returning False cancels.

        Returns
        -------
        PoseResults
            Best first; the example itself is never among them.

        Raises
        ------
        Cancelled
            When `progress` returned False.
        """
        return run(self.steps(scene), progress)

    def steps(self, scene: Scene) -> Stepper[PoseResults]:
        """The stepper behind `place`: a step per parent.

        Parameters
        ----------
        scene : Scene

        Returns
        -------
        generator of (float, str)
            Returns PoseResults.
        """
        given(scene, Scene, "the scene", "Scene([polygon, …])")
        targets = self.targets(scene)
        spacing = self._spacing(targets)
        keep_features(p for polygon in targets for p in (polygon, *scene.members_of(str(polygon.id))))
        found: list[PropagatedPose] = []
        tried: list[tuple[Importance, Candidates]] = []
        for i, polygon in enumerate(targets):
            yield i / len(targets), f"placing in {polygon.label or polygon.id}"
            tried += self._candidates_in(arrangement_of(scene, polygon), spacing)
            if (i + 1) % TOGETHER == 0 or i + 1 == len(targets):
                found += self._answers(tried, spacing)
                tried.clear()
                scene.memory.settle()
        return PoseResults(self._ranked(found), self.footprint)

    def targets(self, scene: Scene) -> list[Polygon]:
        """The polygons of a scene that can hold answers.

        Parameters
        ----------
        scene : Scene

        Returns
        -------
        list of Polygon
            Those of the parent's label (all, where labels do not count), in the scene's order.
        """
        free = not self.options.labels or self.options.other_parents
        return [p for p in scene.places() if free or p.label == self.parent.label]

    def _spacing(self, targets: list[Polygon]) -> float:
        """Distance between grid points in a parent of the example's size."""
        area = sum(float(np.prod(p.bounds[2:] - p.bounds[:2])) for p in targets)
        spacing = float(np.sqrt(area / self.options.cells)) or 1.0
        finest = FINEST_OF_FOOTPRINTS if self.query.rigid else FINEST
        coarser = max(0.0, np.log2(finest * self.query.width / spacing))
        # In steps, so that examples of parents of different sizes share the fields.
        return float(spacing * 2 ** (np.ceil(2 * coarser) / 2))

    def scales(self, target: Arrangement) -> list[float]:
        """The sizes, in proportion to the example's, at which an arrangement is tried.

        Parameters
        ----------
        target : Arrangement

        Returns
        -------
        list of float
        """
        ratio = target.parent.size / self._arrangement.parent.size
        if self.options.scale == "fixed" or abs(ratio - 1) <= SAME_SIZE:
            return [1.0]
        return [1.0, ratio]

    def importances(self, target: Arrangement) -> Iterator[Importance]:
        """The importance in an arrangement, for every sense and scale that the options ask for.

        Parameters
        ----------
        target : Arrangement

        Yields
        ------
        Importance
            Those that cannot reach the threshold are left out.
        """
        matching = Matching(self.query, target)
        for scale in self.scales(target):
            for sense in senses(self.query):
                importance = Importance(self.query, target, sense, scale, matching)
                if self.query.total and importance.bound >= self.options.threshold:
                    yield importance

    def _candidates_in(self, target: Arrangement, spacing: float) -> Iterator[tuple[Importance, Candidates]]:
        """Where to look in an arrangement, for every sense and scale."""
        for importance in self.importances(target):
            candidates = self._candidates_of(importance, spacing, SLACK * importance.width)
            if len(candidates.angle):
                yield importance, candidates

    def _candidates_of(self, importance: Importance, spacing: float, slack: float) -> Candidates:
        """Where to look, up to `slack` deep inside what the object may not be in."""
        target = importance.target
        share = 1.0 if self._validation.may_jut_out else 2 * JUTTING_SHARE
        margin = share * float(np.hypot(*importance.samples.T).max())
        fields = self._fields(target, spacing, margin)
        relations = importance.relations
        if self.query.rigid:
            read = importance.of_strongest(STRONG)
            fields.evaluate(relations, directions_read(read), read.answering)
        else:
            fields.evaluate(relations, polygons=importance.answering)
        blocked = self._validation.blocked(target, fields, slack)
        # The example would outshine the other places of its room.
        taken = self._is_example(target, fields.grid.points, importance.mirrored)
        find = find_footprint_candidates if self.query.rigid else find_candidates
        return find(importance, fields, blocked, taken)

    def _fields(self, target: Arrangement, spacing: float, margin: float) -> Fields:
        """The fields of an arrangement; coarser where a large object may jut out of a small parent."""
        box = target.parent.bounds[2:] - target.parent.bounds[:2] + 2 * margin
        least = float(np.sqrt(np.prod(box) / (MOST_CELLS * self.options.cells)))
        coarser = max(0.0, float(np.ceil(np.log2(least / spacing))))
        return target.fields(spacing * 2**coarser, margin + spacing * 2**coarser)

    def _answers(self, tried: Sequence[tuple[Importance, Candidates]], spacing: float) -> list[PropagatedPose]:
        """What the candidates of some arrangements lead to."""
        importances = [importance for importance, _ in tried]
        factor = [self._factor(importance) for importance in importances]
        refined = refine(importances, [candidates for _, candidates in tried], factor, self._stands)
        found: dict[Arrangement, list[Found]] = {i.target: [] for i in importances}
        self._accept(importances, refined, found)
        # Where no maximum may be accepted the object gives way.
        left = [i for i in importances if not found[i.target]]
        if left and self.footprint is not None and self.options.validate:
            free = [self._candidates_of(i, spacing, FREE * i.width) for i in left]
            factor = [self._factor(i) for i in left]
            self._accept(left, give_way(left, free, factor, self._stands), found)
        results = []
        for target, places in found.items():
            apart = self._apart(self._ranked([self._result(target, *place) for place in places]))
            most = min(self.options.candidates, self.options.max_per.get(target.parent.label, self.options.candidates))
            results += self._ranked(self._passable(target, apart))[:most]
        return results

    def _accept(
        self, importances: Sequence[Importance], refined: Refined, found: dict[Arrangement, list[Found]]
    ) -> None:
        """Add the poses that may be answers to what is found in their arrangements."""
        for k, mine in refined.by_importance():
            importance, poses = importances[k], refined.of(mine)
            target, turned, factor = importance.target, importance.mirrored, self._factor(importance)
            good = poses.value * factor >= self.options.threshold
            good &= ~self._is_example(target, poses.position, turned)
            good &= self.query.is_upright(poses.angle, turned)
            poses = poses.of(good)
            poses = poses.of(self._accepts(importance, poses.position, poses.angle))
            rows = zip(poses.value * factor, poses.position, poses.angle, strict=True)
            found[target].extend((float(v), p, float(a), importance) for v, p, a in rows)

    def _factor(self, importance: Importance) -> float:
        return 1.0 if importance.scale == 1.0 else SCALED_FACTOR

    def _accepts(self, importance: Importance, position: Array, angle: Array) -> NDArray[np.bool_]:
        """Which poses intersect nothing that the example does not."""
        i = importance
        return self._validation.accepts(i.target, position, angle, i.mirrored, i.scale)

    def _stands(self, importances: Sequence[Importance], poses: Refined, slack: float) -> NDArray[np.bool_]:
        """Whether poses that move no further than `slack`, in half-widths of level sets, may be accepted."""
        number = {t: k for k, t in enumerate(dict.fromkeys(i.target for i in importances))}
        target = np.array([number[i.target] for i in importances], dtype=np.intp)[poses.which]
        mirrored = np.array([i.mirrored for i in importances], dtype=bool)[poses.which]
        scale = np.array([i.scale for i in importances])[poses.which]
        width = np.array([i.width for i in importances])[poses.which]
        targets = list(number)
        return ~self._validation.hopeless(targets, target, poses.position, poses.angle, mirrored, scale, slack * width)

    def _ranked(self, found: Sequence[PropagatedPose]) -> list[PropagatedPose]:
        """Best first; of equals, the object as it is before its mirror image, the least turned one first."""
        importance = np.array([p.importance for p in found])
        frame = np.array([p.parent.main_orientation for p in found]) - self.parent.main_orientation
        turn = np.abs(wrap(np.array([p.pose.angle for p in found]) - self.pose.angle - frame)).round(3)
        order = np.argsort(-importance, kind="stable")
        # Equals are those that the best of them is hardly better than.
        group = np.zeros(len(order), dtype=np.intp)
        first = 0
        for i in range(1, len(order)):
            if importance[order[first]] - importance[order[i]] > EQUAL:
                first = i
            group[order[i]] = first
        mirrored = np.array([p.mirrored != self.pose.mirrored for p in found])
        return [found[i] for i in np.lexsort((turn, mirrored, group))]

    def _is_example(self, target: Arrangement, position: Array, mirrored: bool) -> NDArray[np.bool_]:
        """Whether poses are the example itself, or its mirror image in the same place."""
        if not target.is_at(self._arrangement):
            return np.zeros(len(position), dtype=bool)
        return np.hypot(*(position - self.pose.position).T) < max(self.reach, self.query.width)

    @cached_property
    def reach(self) -> float:
        """Least distance between two results, in scene units: nearer ones are the same place."""
        if self.options.spacing is not None:
            return self.options.spacing
        if self.footprint is None:
            return 2 * self.query.width
        return float(np.ptp(self.footprint, axis=0).min()) / 2

    def _result(
        self, target: Arrangement, value: float, position: Array, angle: float, importance: Importance
    ) -> PropagatedPose:
        """A place found, as it is told."""
        pose = Pose((position[0], position[1]), angle % (2 * np.pi), importance.mirrored)
        # Results outlive the fields of their parents, so they hold none of them.
        surroundings = partial(Arrangement, target.parent, target.members)
        explain = partial(self._explain, surroundings, importance.sense, importance.scale, position, angle)
        return PropagatedPose(pose, value, target.parent, importance.scale, explain)

    def _apart(self, found: list[PropagatedPose]) -> list[PropagatedPose]:
        """The best of one parent that keep their distance (non-maximum suppression)."""
        in_space = self.options.accumulation == "pose space"
        kept: list[PropagatedPose] = []
        for p in found:
            # In pose space two directions at one place are two answers (figure 4.17).
            if not any(
                math.dist(p.pose.position, k.pose.position) < self.reach * p.scale
                and not (
                    in_space
                    and abs(math.remainder(p.pose.angle - k.pose.angle, math.tau)) > self.options.direction_width
                )
                for k in kept
            ):
                kept.append(p)
        return kept

    def _passable(self, target: Arrangement, found: list[PropagatedPose]) -> list[PropagatedPose]:
        """The same, worth less as far as they are in the way where the example is not."""
        if self.footprint is None or not self.options.validate or not len(target.fronts) or not found:
            return found
        outlines = shapely.polygons([p.pose.to_scene(self.footprint * p.scale) for p in found])
        left = target.fronts.passable(outlines, self._in_front)
        less = (replace(p, importance=p.importance * f) for p, f in zip(found, left.tolist(), strict=True))
        return [p for p in less if p.importance >= self.options.threshold]

    @cached_property
    def _in_front(self) -> dict[str, float]:
        """How much of fronts the example covers."""
        if self.footprint is None:
            return {}
        return self._arrangement.fronts.covered_by(shapely.Polygon(self.pose.to_scene(self.footprint)))

    def _explain(
        self, surroundings: Callable[[], Arrangement], sense: Sense, scale: float, position: Array, angle: float
    ) -> tuple[RelationShare, ...]:
        return explain(Importance(self.query, surroundings(), sense, scale), position, angle)

    def to_dict(self) -> dict[str, Any]:
        """The model as plain data: the example's surroundings, pose, footprint and options.

        Returns
        -------
        dict
        """
        return {
            "source": self.source.to_dict(),
            "parent": self.parent.id,
            "position": list(self.pose.position),
            "angle": self.pose.angle,
            "mirrored": self.pose.mirrored,
            "footprint": None if self.footprint is None else self.footprint.tolist(),
            "options": self.options.to_dict(),
        }

    @classmethod
    def from_dict(cls, plain: Mapping[str, Any]) -> "PoseModel":
        """The model that `to_dict` wrote.

        Parameters
        ----------
        plain : mapping

        Returns
        -------
        PoseModel

        Raises
        ------
        InputError
            Where something is missing or is not what it should be.
        """
        try:
            source = Scene([Polygon(**p) for p in plain["source"]["polygons"]])
            return cls(
                source,
                source.polygon(plain["parent"]),
                Pose(tuple(plain["position"]), plain["angle"], plain["mirrored"]),
                footprint_ring(plain["footprint"]),
                PoseOptions.from_dict(plain["options"]),
            )
        except (KeyError, TypeError, AttributeError, IndexError) as error:
            raise InputError(f"the stored pose model lacks or garbles {error}; record the operation again") from error
