"""Arrays of objects: copies at a fixed spacing along the offset boundary of a polygon (section 4.8)."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial import cKDTree

from ..arguments import flag, number, positive, word
from ..errors import InputError
from ..geometry.polygon import Polygon
from ..geometry.scene import Scene
from ..options import Options, option
from ..progress import Progress, Stepper, run, within
from .arrangement import arrangement_of
from .model import PoseModel
from .offset_path import Alignment, OffsetPath, Stretch, align, offset_paths
from .options import PoseOptions
from .pose import Pose
from .propagate import learn_pose
from .results import PropagatedPose
from .validation import Validation

Array = NDArray[np.float64]

#: Start and end nearer than this share of the spacing are one place.
SAME_PLACE = 0.25

#: Share of the importance of a boundary's best start (or end) below which other starts (or ends) do not count there: a
#: weak end before the right one would cut the array short.
MUCH_WEAKER = 0.7


@dataclass(frozen=True)
class ArrayOptions(Options):
    """How arrays are made.

    Attributes
    ----------
    corners : {"round", "mitre"}
        The offset boundary at corners that point to its side. "round": the places at equal distance from the boundary,
        a level set of R_bd, on which start poses lie exactly. "mitre": straight on to a sharp corner, as rows of trees
        round a square do.
    even : bool
        Whether the spacing is changed to the nearest one that leaves no rest at the array's end.
    threshold : float
        Least importance of starts and ends; weaker ones would take the ends of good arrays.
    validate : bool
        Whether objects that intersect what the example does not are left out (section 4.8); the others stay in place.
    way : {"shorter", "left", "right"}
        The way from the example's start to its end: with the boundary, the polygon's interior on the left, or against
        it. Arrays from mirrored starts run the other way.
    """

    subject = "arrays"

    corners: Literal["round", "mitre"] = option("round", word, "round", "mitre")
    even: bool = option(False, flag)
    threshold: float = option(0.3, number, 0, 1)
    validate: bool = option(True, flag)
    way: Literal["shorter", "left", "right"] = option("shorter", word, "shorter", "left", "right")


@dataclass(frozen=True)
class PoseArray:
    """One array.

    Attributes
    ----------
    poses : tuple of Pose
        The objects, from the start on.
    polygon : Polygon
        The one whose offset boundary they are aligned along.
    parent : Polygon
        What they stand in.
    importance : float
        The lower of the start's and the end's.
    scale : float
        Size of the objects in proportion to the example's.
    closed : bool
        Whether it runs all round.
    example : bool
        Whether it starts with the example itself.
    """

    poses: tuple[Pose, ...]
    polygon: Polygon
    parent: Polygon
    importance: float
    scale: float = 1.0
    closed: bool = False
    example: bool = False


class ArrayModel:
    """An array's start and end as examples, ready to be propagated in any scene.

    Parameters
    ----------
    start : PoseModel
        The first object, and the poses that arrays start at.
    end : PoseModel or None
        Where arrays end. None, or the start's own position: all round.
    spacing : float
        Distance along the path between two objects, scene units.
    options : ArrayOptions

    Raises
    ------
    InputError
        For a spacing that is not positive, and where the example itself is no array: start and end are nearest to
        different polygons, or on different sides, or no offset path joins them.
    """

    def __init__(self, start: PoseModel, end: PoseModel | None, spacing: float, options: ArrayOptions) -> None:
        spacing = positive(spacing, "the spacing of the array")
        self.start = start
        if end is not None and math.dist(start.pose.position, end.pose.position) < SAME_PLACE * spacing:
            end = None
        self.end = end
        self.spacing = spacing
        self.options = options
        self._source = arrangement_of(start.source, start.parent)
        self._validation = Validation(self._source, start.pose, start.footprint, start.options)
        at = align(start.pose.position, self._source.elements.polygons)
        self._label = at.polygon.label
        # Until the example's own stretch is known, both ways are open.
        self._sense = {"shorter": 0, "left": 1, "right": -1}[options.way]
        stretch = self._example_stretch(at)
        self._sense = stretch.sense
        self._turn = start.pose.angle - float(stretch.directions(np.zeros(1))[0])

    @property
    def closed(self) -> bool:
        """Whether arrays run all round."""
        return self.end is None

    def _example_stretch(self, at: Alignment) -> Stretch:
        end = self.end or self.start
        to = align(end.pose.position, arrangement_of(end.source, end.parent).elements.polygons)
        if to.polygon.id != at.polygon.id:
            other = "another one" if to.polygon.label == at.polygon.label else _named(to.polygon)
            raise InputError(
                f"the array's start is nearest to {_named(at.polygon)} and its end to {other}; move them so that both "
                "are nearest to the same one"
            )
        if to.inside != at.inside:
            raise InputError(
                f"the array's start and end are on different sides of the boundary of {_named(at.polygon)}; move them "
                "to the same side"
            )
        stretch = self._stretch(self._paths(at), self.start.pose, end.pose)
        if stretch is None:
            raise InputError(
                f"no path along the boundary of {_named(at.polygon)} joins the array's start and end; move them"
            )
        return stretch

    def _paths(self, at: Alignment) -> list[OffsetPath]:
        return offset_paths(at.polygon, at.offset, at.inside, self.options.corners)

    def _stretch(self, paths: Sequence[OffsetPath], start: Pose, end: Pose) -> Stretch | None:
        """The way from a start to an end; None where they are on different parts of the offset boundary."""
        if not paths:
            return None
        path = min(paths, key=lambda p: p.distance(start.position))
        if min(paths, key=lambda p: p.distance(end.position)) is not path:
            return None
        begin = path.project(start.position)
        # Mirrored arrays run against the example; 0: its own way is yet to be found.
        sense = -self._sense if start.mirrored else self._sense
        if self.closed:
            return Stretch(path, begin, sense or 1, path.length)
        forward = (path.project(end.position) - begin) % path.length
        if path.length - forward < SAME_PLACE * self.spacing:
            forward = 0.0  # no round trip to an end that is the start, a rounding error behind it
        sense = sense or (1 if forward <= path.length / 2 else -1)
        length = forward if sense > 0 else (path.length - forward) % path.length
        return Stretch(path, begin, sense, length)

    def place(self, scene: Scene, progress: Progress | None = None) -> list[PoseArray]:
        """Find all arrays of a scene.

        Parameters
        ----------
        scene : Scene
            The example's own or another one.
        progress : callable (fraction, text) -> bool, optional
            Returning False cancels.

        Returns
        -------
        list of PoseArray
            The one that starts with the example first where that stands in the scene, then best first.

        Raises
        ------
        Cancelled
            When `progress` returned False.
        """
        return run(self.steps(scene), progress)

    def steps(self, scene: Scene) -> Stepper[list[PoseArray]]:
        """The stepper behind `place`.

        A start and an end make an array when both are nearest to the same polygon, on the same side, of the label that
        the example's has (unless labels do not count), and when both are mirrored or neither is. Of several ends the
        one that is nearest to the start along the path is taken, and an end serves the one start that is nearest to it:
        further starts make no array. All round a boundary runs one array, from the best start, and no array runs where
        a better one does. Starts and ends much weaker than a boundary's best are no answers.

        Parameters
        ----------
        scene : Scene

        Returns
        -------
        generator of (float, str)
            Returns a list of PoseArray.
        """
        half = 1.0 if self.closed else 0.5
        starts = list((yield from within(self.start.steps(scene), 0.0, half)).above(self.options.threshold))
        starts = self._with_example(scene, self.start, starts)
        if self.end is None:
            ends = starts
        else:
            ends = list((yield from within(self.end.steps(scene), half, 1.0)).above(self.options.threshold))
            ends = self._with_example(scene, self.end, ends)
        origins = self._aligned(scene, starts)
        if self.closed:
            # One array runs all round a boundary: the best start's.
            firsts = {_boundary(o): i for i, o in reversed(list(enumerate(origins))) if o is not None}
            origins = [o if o is not None and firsts[_boundary(o)] == i else None for i, o in enumerate(origins)]
        goals = origins if self.closed else self._aligned(scene, ends)
        arrays = []
        for i, j, stretch in self._pairs(starts, ends, origins, goals):
            polygon = goals[j].polygon  # type: ignore[union-attr]
            arrays.append(self._array(scene, starts[i], ends[j], polygon, stretch))
        return self._apart([array for array in arrays if array.poses])

    def _apart(self, arrays: list[PoseArray]) -> list[PoseArray]:
        """The best arrays that do not run where better ones do."""
        kept: list[PoseArray] = []
        # Of equal ones, those that are not mirrored.
        for array in sorted(arrays, key=lambda a: (not a.example, -round(a.importance, 6), a.poses[0].mirrored)):
            here = np.array([p.position for p in array.poses])
            there = np.array([p.position for k in kept if k.polygon.id == array.polygon.id for p in k.poses])
            # Both may be ten thousand: no table of all pairs.
            gaps = cKDTree(there.reshape(-1, 2)).query(here)[0]
            if not (gaps < self.spacing * array.scale / 2).any():
                kept.append(array)
        return kept

    def _with_example(self, scene: Scene, model: PoseModel, found: list[PropagatedPose]) -> list[PropagatedPose]:
        """The results after the example itself, where its parent is in the scene."""
        source = arrangement_of(model.source, model.parent)
        own = [p for p in model.targets(scene) if p.id == model.parent.id and arrangement_of(scene, p).is_at(source)]
        return [*(PropagatedPose(model.pose, 1.0, p) for p in own), *found]

    def _aligned(self, scene: Scene, found: Sequence[PropagatedPose]) -> list[Alignment | None]:
        """The boundary that each start or end belongs to; None for those that make no array."""
        aligned: list[Alignment | None] = []
        best: dict[tuple[str | None, bool], float] = {}
        for f in found:
            at = align(f.pose.position, arrangement_of(scene, f.parent).elements.polygons)
            if self.start.options.labels and at.polygon.label != self._label:
                aligned.append(None)
                continue
            # The example is no measure for the others: they are in other places.
            if f.pose is not self.start.pose and (self.end is None or f.pose is not self.end.pose):
                best[_boundary(at)] = max(best.get(_boundary(at), 0.0), f.importance)
            aligned.append(at if f.importance >= MUCH_WEAKER * best.get(_boundary(at), 0.0) else None)
        return aligned

    def _pairs(
        self,
        starts: Sequence[PropagatedPose],
        ends: Sequence[PropagatedPose],
        origins: Sequence[Alignment | None],
        goals: Sequence[Alignment | None],
    ) -> list[tuple[int, int, Stretch]]:
        ways: list[tuple[float, int, int, Stretch]] = []
        own = self._begins(starts, self.start) and (self.end is None or self._begins(ends, self.end))
        for i, origin in enumerate(origins):
            # The example's start goes to the example's end.
            goal_range = [i] if self.closed else [0] if own and i == 0 else range(len(goals))
            agreeing = [
                j
                for j in goal_range
                if origin is not None and _agree(origin, goals[j]) and starts[i].pose.mirrored == ends[j].pose.mirrored
            ]
            paths = self._paths(origin) if origin is not None and agreeing else []
            for j in agreeing:
                stretch = self._stretch(paths, starts[i].pose, ends[j].pose)
                # An end in the start's own place is another array's.
                if stretch is not None and stretch.length >= SAME_PLACE * self.spacing:
                    ways.append((stretch.length, i, j, stretch))
        by_start: dict[int, tuple[float, int, int, Stretch]] = {}
        for way in sorted(ways, key=lambda w: w[:3]):
            by_start.setdefault(way[1], way)
        if self.closed:
            return [(i, j, stretch) for _, i, j, stretch in sorted(by_start.values(), key=lambda w: w[1])]
        by_end: dict[int, tuple[float, int, int, Stretch]] = {}
        for way in sorted(by_start.values(), key=lambda w: (not (own and w[1] == 0), *w[:3])):
            by_end.setdefault(way[2], way)
        return [(i, j, stretch) for _, i, j, stretch in sorted(by_end.values(), key=lambda w: w[1])]

    @staticmethod
    def _begins(found: Sequence[PropagatedPose], model: PoseModel) -> bool:
        return bool(found) and found[0].pose is model.pose

    def _array(
        self, scene: Scene, start: PropagatedPose, end: PropagatedPose, polygon: Polygon, stretch: Stretch
    ) -> PoseArray:
        places = stretch.places(self.spacing * start.scale, self.options.even, self.closed)
        positions = stretch.points(places)
        mirrored = start.pose.mirrored
        angles = (stretch.directions(places) + (-self._turn if mirrored else self._turn)) % (2 * np.pi)
        kept = np.ones(len(places), dtype=bool)
        if self.options.validate:
            target = arrangement_of(scene, start.parent)
            kept = self._validation.accepts(target, positions, angles, mirrored, start.scale)
        poses = [Pose((p[0], p[1]), a, mirrored) for p, a in zip(positions[kept], angles[kept], strict=True)]
        return PoseArray(
            tuple(poses),
            polygon,
            start.parent,
            min(start.importance, end.importance),
            start.scale,
            self.closed,
            start.pose is self.start.pose,
        )

    def to_dict(self) -> dict[str, Any]:
        """The model as plain data.

        Returns
        -------
        dict
        """
        return {
            "start": self.start.to_dict(),
            "end": None if self.end is None else self.end.to_dict(),
            "spacing": self.spacing,
            "options": asdict(self.options),
        }

    @classmethod
    def from_dict(cls, plain: Mapping[str, Any]) -> "ArrayModel":
        """The model that `to_dict` wrote.

        Parameters
        ----------
        plain : mapping

        Returns
        -------
        ArrayModel

        Raises
        ------
        InputError
            Where something is missing or is not what it should be.
        """
        try:
            start = PoseModel.from_dict(plain["start"])
            end = None if plain["end"] is None else PoseModel.from_dict(plain["end"])
            return cls(start, end, float(plain["spacing"]), ArrayOptions.from_dict(plain["options"]))
        except (KeyError, TypeError) as error:
            raise InputError(f"the stored array model lacks or garbles {error}; record the operation again") from error


def _named(polygon: Polygon) -> str:
    """A polygon as who made the array knows it: what operations have placed has an id that nobody has given it."""
    return f"a polygon labelled {polygon.label!r}" if polygon.label else "a polygon without a label"


def _agree(origin: Alignment, goal: Alignment | None) -> bool:
    """Whether a start and an end are nearest to the same polygon, on the same side."""
    return goal is not None and _boundary(goal) == _boundary(origin)


def _boundary(at: Alignment) -> tuple[str | None, bool]:
    return at.polygon.id, at.inside


def learn_array(
    scene: Scene,
    start: Pose,
    end: Pose | None,
    spacing: float,
    footprint: ArrayLike | None = None,
    options: PoseOptions | None = None,
    array_options: ArrayOptions | None = None,
) -> ArrayModel:
    """Take an array's start and end from their scene.

    Parameters
    ----------
    scene : Scene
    start : Pose
        The first object.
    end : Pose or None
        Where the array ends; None: it runs all round back to its start.
    spacing : float
        Distance along the path between two objects, scene units.
    footprint : array_like of shape (n, 2), optional
        The objects' outline in the pose's own frame; None: points.
    options : PoseOptions, optional
        Of both propagations.
    array_options : ArrayOptions, optional

    Returns
    -------
    ArrayModel

    Raises
    ------
    InputError
        As `learn_pose`, and where the example is no array.
    """
    first = learn_pose(scene, start, footprint, options)
    last = None if end is None else learn_pose(scene, end, footprint, options)
    return ArrayModel(first, last, spacing, array_options or ArrayOptions())
