"""Rooms, pieces of furniture, and edits applied one after the other."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

import geoanalogy as ga

Array = NDArray[np.float64]


def box(length: float, width: float) -> Array:
    """The footprint of a piece of furniture: its centre is the origin, it faces along x."""
    return np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) * (length / 2, width / 2)


def outline(*vertices: tuple[float, float], at: tuple[float, float] = (0.0, 0.0)) -> Array:
    """A ring from its vertices, moved by `at`."""
    return np.add(vertices, at, dtype=np.float64)


def rectangle(x: float, y: float, width: float, height: float) -> Array:
    """An upright rectangle from its lower left corner."""
    return outline((0, 0), (width, 0), (width, height), (0, height), at=(x, y))


def pose(x: float, y: float, degrees: float = 0.0) -> ga.Pose:
    """A pose with its direction in degrees."""
    return ga.Pose((x, y), float(np.radians(degrees)))


def piece(at: ga.Pose, footprint: ArrayLike, label: str, id: str | None = None, scale: float = 1.0) -> ga.Polygon:
    """A piece of furniture where it stands; its frame is its pose's."""
    return ga.Polygon(at.to_scene(np.asarray(footprint) * scale), label=label, id=id, orientation=at.angle)


@dataclass(frozen=True)
class Edit:
    """A piece of furniture put down by hand, to be propagated.

    Attributes
    ----------
    label : str
    footprint : ndarray of shape (n, 2)
    pose : Pose
    options : PoseOptions
    """

    label: str
    footprint: Array
    pose: ga.Pose
    options: ga.PoseOptions = field(default_factory=ga.PoseOptions)


@dataclass(frozen=True)
class Step:
    """An edit and what came of it.

    Attributes
    ----------
    edit : Edit
    model : PoseModel
    before, after : Scene
        Without the piece; with the example and all its copies.
    results : PoseResults
        The copies.
    """

    edit: Edit
    model: ga.PoseModel
    before: ga.Scene
    after: ga.Scene
    results: ga.PoseResults


def furnish(scene: ga.Scene, edits: Sequence[Edit], threshold: float = 0.0) -> list[Step]:
    """Apply edits one after the other: each sees what the ones before it have placed.

    Parameters
    ----------
    scene : Scene
    edits : sequence of Edit
    threshold : float
        Results of less importance are not placed.

    Returns
    -------
    list of Step
        The example's own parent gets no second copy.
    """
    steps = []
    for edit in edits:
        model = ga.learn_pose(scene, edit.pose, edit.footprint, edit.options)
        found = model.place(scene).above(threshold).disjoint()
        results = ga.PoseResults([r for r in found if r.parent.id != model.parent.id], model.footprint)
        placed = [piece(edit.pose, edit.footprint, edit.label)]
        placed += [piece(r.pose, edit.footprint, edit.label, scale=r.scale) for r in results]
        after = scene.with_polygons(placed)
        steps.append(Step(edit, model, scene, after, results))
        scene = after
    return steps


def overlaps(scene: ga.Scene, rooms: Sequence[str], allowed: float = 0.02) -> list[tuple[str, str]]:
    """Pairs of pieces that intersect, or a piece and the room it juts out of.

    Parameters
    ----------
    scene : Scene
    rooms : sequence of str
        Ids of the polygons that are rooms.
    allowed : float
        Share of the smaller area that may be shared, or of a piece's that may be outside.

    Returns
    -------
    list of (str, str)
        Labels.
    """
    wrong = []
    for id in rooms:
        members = scene.members_of(id)
        for i, a in enumerate(members):
            if a.shape.difference(scene.polygon(id).shape).area > (allowed + 0.03) * a.area:
                wrong.append((a.label, id))
            for b in members[:i]:
                if shapely.area(a.shape.intersection(b.shape)) > allowed * min(a.area, b.area):
                    wrong.append((a.label, b.label))
    return wrong
