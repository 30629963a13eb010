"""Groups of objects, transferred from one polygon to others in local coordinates, not rigidly (section 4.7)."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from ..errors import InputError
from ..geometry.polygon import Polygon
from ..geometry.scene import Scene
from ..progress import Progress, Stepper, run
from .local_mapping import LocalMapping, TransferOptions
from .pose import Pose, footprint_ring

Array = NDArray[np.float64]

#: Longest piece of an outline that stays straight where it is mapped, in lengths of the outline: the ends of a bench
#: say nothing of how its middle bends.
PIECE = 1 / 32


@dataclass(frozen=True)
class GroupObject:
    """One object of a group.

    Attributes
    ----------
    pose : Pose
        Scene coordinates.
    footprint : ndarray of shape (n, 2) or None
        Ring in the pose's frame; None: a point.
    """

    pose: Pose
    footprint: Array | None = None


@dataclass(frozen=True)
class TransferredObject:
    """One object in its new place.

    Attributes
    ----------
    index : int
        Its number in the group.
    pose : Pose
    footprint : ndarray of shape (n, 2) or None
        Ring in the pose's frame: where outlines are mapped, that of `GroupTransfer.outlines` bent.
    parent : Polygon
        The polygon it was taken to.
    reached : bool
        Whether the parent has points of these coordinates; where not, the object is at the end of the way there.
    """

    index: int
    pose: Pose
    footprint: Array | None
    parent: Polygon
    reached: bool


class GroupTransfer:
    """A group of objects in a polygon, ready to be taken to every other polygon of its label.

    Parameters
    ----------
    source : Polygon
        The polygon that the group is in.
    objects : sequence of GroupObject
    options : TransferOptions, optional

    Raises
    ------
    InputError
        For an empty group.
    """

    def __init__(self, source: Polygon, objects: Sequence[GroupObject], options: TransferOptions | None = None) -> None:
        if not objects:
            raise InputError("the group has no objects; select those that are to be transferred")
        self.source = source
        self.objects = tuple(GroupObject(o.pose, footprint_ring(o.footprint)) for o in objects)
        self.options = options or TransferOptions()

    @cached_property
    def outlines(self) -> tuple[Array | None, ...]:
        """The footprints of the objects, with vertices enough to be bent.

        Returns
        -------
        tuple of (ndarray of shape (n, 2) or None)
            Rings in the frames of the poses.
        """
        return tuple(None if o.footprint is None else _divided(o.footprint) for o in self.objects)

    def targets(self, scene: Scene) -> list[Polygon]:
        """The polygons of a scene that the group is taken to.

        Parameters
        ----------
        scene : Scene

        Returns
        -------
        list of Polygon
            Those of the source's label, without the source itself.
        """
        same = [p for p in scene.polygons if p.label == self.source.label]
        return [p for p in same if not (p.id == self.source.id and np.array_equal(p.points, self.source.points))]

    def place(self, scene: Scene, progress: Progress | None = None) -> list[TransferredObject]:
        """Take the group to every target.

        Parameters
        ----------
        scene : Scene
        progress : callable (fraction, text) -> bool, optional
            Returning False cancels.

        Returns
        -------
        list of TransferredObject
            Polygon by polygon, in the scene's order; in each, the objects in the group's order.

        Raises
        ------
        InputError
            Where the corner's system is asked for and a polygon has no corner.
        Cancelled
            When `progress` returned False.
        """
        return run(self.steps(scene), progress)

    def steps(self, scene: Scene) -> Stepper[list[TransferredObject]]:
        """The stepper behind `place`.

        Parameters
        ----------
        scene : Scene

        Returns
        -------
        generator of (float, str)
            Returns a list of TransferredObject.
        """
        targets = self.targets(scene)
        found: list[TransferredObject] = []
        for i, target in enumerate(targets):
            yield i / len(targets), f"transferring to {target.label or target.id}"
            found += self.to(target)
        return found

    def to(self, target: Polygon) -> list[TransferredObject]:
        """Take the group to one polygon.

        Parameters
        ----------
        target : Polygon

        Returns
        -------
        list of TransferredObject
            In the group's order.
        """
        middle = np.mean([o.pose.position for o in self.objects], axis=0)
        mapping = LocalMapping(self.source, target, self.options, middle)
        outlines = self.options.shape == "outline"
        # All points of all objects at once: the medial axis is found for many as fast as for one.
        points: list[Array] = []
        first: list[int] = []
        for o, outline in zip(self.objects, self.outlines, strict=True):
            first.append(sum(len(p) for p in points))
            points.append(np.array([o.pose.position]))
            if outlines and outline is not None:
                points.append(o.pose.to_scene(outline))
        mapped = mapping.map(np.vstack(points))
        found = []
        for i, (o, outline, k) in enumerate(zip(self.objects, self.outlines, first, strict=True)):
            x, y = mapped.points[k]
            pose = Pose((x, y), o.pose.angle + float(mapped.turn[k]), o.pose.mirrored)
            ring, reached = o.footprint, bool(mapped.reached[k])
            if outlines and outline is not None:
                vertices = slice(k + 1, k + 1 + len(outline))
                ring = pose.to_frame(mapped.points[vertices])
                # Across the medial axis an outline may come apart.
                reached &= bool(mapped.reached[vertices].all()) and shapely.LinearRing(ring).is_simple
            found.append(TransferredObject(i, pose, ring, target, reached))
        return found

    def to_dict(self) -> dict[str, Any]:
        """The group as plain data.

        Returns
        -------
        dict
        """
        return {
            "source": self.source.to_dict(),
            "objects": [
                {
                    "position": list(o.pose.position),
                    "angle": o.pose.angle,
                    "mirrored": o.pose.mirrored,
                    "footprint": None if o.footprint is None else o.footprint.tolist(),
                }
                for o in self.objects
            ],
            "options": self.options.to_dict(),
        }

    @classmethod
    def from_dict(cls, plain: Mapping[str, Any]) -> "GroupTransfer":
        """The group that `to_dict` wrote.

        Parameters
        ----------
        plain : mapping

        Returns
        -------
        GroupTransfer

        Raises
        ------
        InputError
            Where something is missing or is not what it should be.
        """
        try:
            objects = [
                GroupObject(Pose(tuple(o["position"]), o["angle"], o["mirrored"]), o["footprint"])
                for o in plain["objects"]
            ]
            return cls(Polygon(**plain["source"]), objects, TransferOptions.from_dict(plain["options"]))
        except (KeyError, TypeError, AttributeError) as error:
            raise InputError(f"the stored group lacks or garbles {error}; record the operation again") from error


def _divided(ring: Array) -> Array:
    closed = shapely.LinearRing(ring)
    return shapely.get_coordinates(shapely.segmentize(closed, PIECE * closed.length))[:-1]
