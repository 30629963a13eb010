"""Results do not depend on how the scene lies: the edits of the apartment, turned and moved."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

import geoanalogy as ga

#: By how many degrees the plan is turned, and by how much it is moved then, scene units.
TURNS = ((0.0, (0.0, 0.0)), (-152.0, (-26.0, 31.0)), (17.3, (8.5, -44.0)), (61.0, (-3.0, 12.0)), (123.4, (40.0, -9.0)))


@dataclass(frozen=True)
class Best:
    """The best result of one edit in one room.

    Attributes
    ----------
    edit, room : str
    importance : tuple of float
        In every direction of the plan; 0 where there is none.
    """

    edit: str
    room: str
    importance: tuple[float, ...]


def best_results(edits: Iterable[tuple[str, ga.PoseModel, ga.Scene]]) -> list[Best]:
    """What the edits of a plan find in every room, however it is turned.

    Parameters
    ----------
    edits : iterable of (str, PoseModel, Scene)
        Name and example of each edit, and the scene that it is made in.

    Returns
    -------
    list of Best
        Of every edit and room that has a result in some direction.
    """
    found: dict[tuple[str, str], list[float]] = {}
    for name, model, scene in edits:
        for k, (degrees, shift) in enumerate(TURNS):
            turn = float(np.radians(degrees))
            x, y = _turned(np.array([model.pose.position]), turn)[0] + shift
            pose = ga.Pose((x, y), model.pose.angle + turn, model.pose.mirrored)
            example = ga.learn_pose(_moved(model.source, turn, shift), pose, model.footprint, model.options)
            for result in example.place(_moved(scene, turn, shift)):
                values = found.setdefault((name, str(result.parent.id)), [0.0] * len(TURNS))
                values[k] = max(values[k], result.importance)
    return [Best(*where, tuple(values)) for where, values in found.items()]


def _turned(points: np.ndarray, turn: float) -> np.ndarray:
    c, s = np.cos(turn), np.sin(turn)
    return points @ np.array([[c, s], [-s, c]])


def _moved(scene: ga.Scene, turn: float, shift: tuple[float, float]) -> ga.Scene:
    return ga.Scene(
        [
            ga.Polygon(
                _turned(p.points, turn) + shift,
                p.label,
                p.id,
                [_turned(h, turn) + shift for h in p.holes],
                p.parent,
                orientation=None if p.orientation is None else p.orientation + turn,
                segment_labels=p.segment_labels,
            )
            for p in scene.polygons
        ]
    )
