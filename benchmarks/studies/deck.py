"""Figure 4.2: a bench on the deck of a ship. Local coordinates alone (section 4.7) do not see what stands on the deck.

Two hulls with a hatch, a mast and a deckhouse each, arranged differently. The bench stands along the deckhouse, its
back to it.
"""

from dataclasses import dataclass

import numpy as np
import shapely

import geoanalogy as ga
from geoanalogy.poses.local_mapping import LocalMapping, TransferOptions

from .furnishing import Array, box, piece, pose

BENCH = box(0.5, 1.8)
SOURCE = pose(5.97, 0.0)
#: Along the deckhouse of the other ship, its back to it.
INTENDED = pose(24.43, 0.4, 180)


def _hull(length: float, width: float, bow: float) -> Array:
    """A deck with a transom at its origin and its bow along x."""
    t = np.linspace(0, 1, 12)
    side = np.stack([length - bow + bow * np.sin(t * np.pi / 2), width / 2 * np.cos(t * np.pi / 2)], axis=1)
    return np.vstack([[(0.0, -0.42 * width)], side * (1, -1), side[-2::-1], [(0.0, 0.42 * width)]])


def _round(x: float, y: float, radius: float) -> Array:
    turn = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    return np.stack([x + radius * np.cos(turn), y + radius * np.sin(turn)], axis=1)


SCENE = ga.Scene(
    [
        ga.Polygon(_hull(14, 5, 6), "deck", "source"),
        piece(pose(4.2, 0), box(3.0, 2.6), "deckhouse"),
        ga.Polygon(_round(8.6, 0, 0.3), "mast"),
        piece(pose(10.4, 0), box(1.2, 1.2), "hatch"),
        piece(pose(1.1, 0), box(0.9, 1.6), "locker"),
        ga.Polygon(_hull(16, 5.6, 5) + np.array([16.0, 0.0]), "deck", "target"),
        piece(pose(26.2, 0.4, 180), box(3.0, 2.6), "deckhouse"),
        ga.Polygon(_round(19.4, 0, 0.3), "mast"),
        piece(pose(22.6, 0.2), box(1.2, 1.2), "hatch"),
        piece(pose(29.6, 0), box(0.9, 1.6), "locker"),
    ]
)


@dataclass(frozen=True)
class Placed:
    """Where the bench is put on the other deck.

    Attributes
    ----------
    pose : Pose
    error : float
        Distance from the intended place, metres.
    overlap : float
        Share of the bench's area that intersects what stands on the deck.
    """

    pose: ga.Pose
    error: float
    overlap: float


def by_local_coordinates() -> Placed:
    """Boundary distance and arc length from a fixed start, in both decks.

    Returns
    -------
    Placed
    """
    source, target = SCENE.polygon("source"), SCENE.polygon("target")
    found, _ = LocalMapping(source, target, TransferOptions(corners=False)).pose(SOURCE)
    return _judged(found)


def by_relations() -> tuple[ga.PoseModel, Placed]:
    """All relations.

    Returns
    -------
    model : PoseModel
    placed : Placed
    """
    model = ga.learn_pose(SCENE, SOURCE, BENCH, ga.PoseOptions(scale="fixed"))
    found = next(r for r in model.place(SCENE) if r.parent.id == "target")
    return model, _judged(found.pose)


def _judged(found: ga.Pose) -> Placed:
    ring = shapely.Polygon(found.to_scene(BENCH))
    shared = sum(ring.intersection(m.shape).area for m in SCENE.members_of("target"))
    error = float(np.hypot(*np.subtract(found.position, INTENDED.position)))
    return Placed(found, error, shared / ring.area)
