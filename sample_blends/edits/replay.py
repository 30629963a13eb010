"""Apply edits to a plan with the engine, without Blender: what is placed where."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

import geoanalogy as ga

from ..library import ASSETS
from ..plans.outlines import PlanPolygon
from .edit import Edit


@dataclass(frozen=True)
class Placed:
    """One asset in its place.

    Attributes
    ----------
    asset : str
    pose : Pose
    edit : int
        Number of the edit in its list.
    parent : str
        Id of the polygon it stands in.
    importance : float
    example : bool
        Whether it was put there by hand.
    """

    asset: str
    pose: ga.Pose
    edit: int
    parent: str
    importance: float
    example: bool = False

    @property
    def ring(self) -> np.ndarray:
        """Its outline in the plan."""
        return self.pose.to_scene(ASSETS[self.asset].footprint)


def scene_of(polygons: Sequence[PlanPolygon]) -> ga.Scene:
    """The plan as the engine's scene."""
    return ga.Scene([ga.Polygon(p.ring, label=p.label, id=p.id, parent=p.parent) for p in polygons])


def _at_most(most: int | None, own: str | None, results: ga.PoseResults) -> list[ga.PropagatedPose]:
    """The best results of every parent; the example takes one of the places in its own."""
    taken = Counter({own: 1})
    kept = []
    for result in results:
        taken[result.parent.id] += 1
        if most is None or taken[result.parent.id] <= most:
            kept.append(result)
    return kept


def replay(scene: ga.Scene, edits: Sequence[Edit]) -> Iterator[tuple[Edit, list[Placed], ga.Scene]]:
    """Apply the edits one after the other; each sees what the ones before it have placed.

    Yields
    ------
    (Edit, list of Placed, Scene)
        The edit, what it placed (the example first), and the scene with it.
    """
    for number, edit in enumerate(edits):
        asset = ASSETS[edit.asset]
        pose = ga.Pose(edit.position, np.radians(edit.angle))
        model = ga.learn_pose(scene, pose, asset.footprint, ga.PoseOptions(**edit.options))
        results = _at_most(edit.most, model.parent.id, model.place(scene).above(edit.threshold).disjoint())
        placed = [Placed(asset.name, pose, number, str(model.parent.id), 1.0, True)]
        placed += [Placed(asset.name, r.pose, number, str(r.parent.id), r.importance) for r in results]
        scene = scene.with_polygons([ga.Polygon(p.ring, label=asset.label) for p in placed])
        yield edit, placed, scene
