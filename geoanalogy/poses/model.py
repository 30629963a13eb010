"""An example taken from its scene, and the steps of section 4.2 (figure 4.4) that find its analogues put together."""

from collections.abc import Iterator, Mapping
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arguments import given
from ..errors import InputError
from ..geometry.polygon import Polygon
from ..geometry.scene import Scene
from ..progress import Progress, Stepper, run
from ..relations.elements import keep_features
from .answering import Answering
from .arrangement import Arrangement, arrangement_of
from .candidates import Candidates, find_candidates
from .directions import directions_read
from .fields import Fields
from .footprint_candidates import SLACK, STRONG, find_footprint_candidates
from .giving_way import FREE
from .importance import Importance
from .matching import Matching, senses
from .options import PoseOptions
from .pose import Pose, footprint_ring
from .query import Query
from .results import PoseResults, PropagatedPose
from .validation import JUTTING_SHARE, Validation

Array = NDArray[np.float64]
#: Rooms within this share of the example's size are of its size: in proportion to the room (option `scale`) is then
#: the same as fixed.
SAME_SIZE = 0.01

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
        self._answering = Answering(self._arrangement, self.query, self._validation, footprint)

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
                found += self._answering.answers(tried, partial(self._free_in, spacing))
                tried.clear()
                scene.memory.settle()
        return PoseResults(self._answering.ranked(found), self.footprint)

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

    def _free_in(self, spacing: float, importance: Importance) -> Candidates:
        """Where the object is hardly in anything that it may not be in."""
        return self._candidates_of(importance, spacing, FREE * importance.width)

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
        taken = self._answering.is_example(target, fields.grid.points)
        find = find_footprint_candidates if self.query.rigid else find_candidates
        return find(importance, fields, blocked, taken)

    def _fields(self, target: Arrangement, spacing: float, margin: float) -> Fields:
        """The fields of an arrangement; coarser where a large object may jut out of a small parent."""
        box = target.parent.bounds[2:] - target.parent.bounds[:2] + 2 * margin
        least = float(np.sqrt(np.prod(box) / (MOST_CELLS * self.options.cells)))
        coarser = max(0.0, float(np.ceil(np.log2(least / spacing))))
        return target.fields(spacing * 2**coarser, margin + spacing * 2**coarser)

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
