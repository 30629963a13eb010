"""Results do not depend on the grid: the same edits on shifted, finer and coarser grids, and in moved scenes."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from unittest import mock

import numpy as np

import geoanalogy as ga
from geoanalogy.poses import arrangement

from . import bathrooms, distance_importance, labels, shape_matching
from .furnishing import Edit


@dataclass(frozen=True)
class Variant:
    """A grid other than the usual one.

    Attributes
    ----------
    cells : int
        Grid points, as in `PoseOptions`.
    shift : tuple of float
        By which the grid is moved against the rooms, in cells (0 to 1).
    move : tuple of float
        By which the whole scene is moved, scene units.
    """

    cells: int = 100_000
    shift: tuple[float, float] = (0.0, 0.0)
    move: tuple[float, float] = (0.0, 0.0)


VARIANTS = (
    Variant(cells=25_000),
    Variant(cells=400_000),
    Variant(shift=(0.5, 0.5)),
    Variant(shift=(0.31, 0.83)),
    Variant(shift=(0.77, 0.42)),
    Variant(move=(0.0137, -0.0071)),
    Variant(move=(1234.567, -987.654)),
)


@dataclass(frozen=True)
class Movement:
    """How far a result moves.

    Attributes
    ----------
    importance : float
        On the usual grid.
    distance : float
        Greatest distance from the nearest result on another grid, as a share of its room's size; inf where another
        grid has none of its direction.
    turn : float
        Greatest difference in direction, radians.
    """

    importance: float
    distance: float
    turn: float


@contextmanager
def shifted_grid(shift: tuple[float, float]) -> Iterator[None]:
    """Lay the grids of all rooms elsewhere, while this is entered.

    Parameters
    ----------
    shift : tuple of float
        In cells (0 to 1).
    """

    class Shifted(arrangement.Grid):
        def __init__(self, *args: object, **more: object) -> None:
            super().__init__(*args, **more)
            # A row and a column more, so that the room is covered as before.
            self.columns, self.rows = self.columns + 1, self.rows + 1
            self.origin = self.origin - self.spacing * np.array(shift)

    with mock.patch.object(arrangement, "Grid", Shifted):
        yield


def cases() -> dict[str, tuple[ga.Scene, Edit]]:
    """Scenes of other studies with one edit each.

    Returns
    -------
    dict of str to (Scene, Edit)
    """
    options = ga.PoseOptions(scale="fixed")
    found = {f"bathroom, {e.label}": (bathrooms.SCENE, e) for e in bathrooms.EDITS.values()}
    for name, row in shape_matching.ROWS.items():
        r = row()
        found[f"shape contexts, {name}"] = (r.scene, Edit("object", r.footprint, r.source, options))
    found["night table"] = (labels.SCENE, Edit("night table", labels.NIGHT_TABLE, labels.SOURCE, options))
    chair = Edit("chair", distance_importance.CHAIR, distance_importance.SOURCE, options)
    return found | {"chair": (distance_importance.SCENE, chair)}


def movements(scene: ga.Scene, edit: Edit) -> list[Movement]:
    """How the best result of an edit in every other room moves with the grid.

    Parameters
    ----------
    scene : Scene
    edit : Edit

    Returns
    -------
    list of Movement
        Best first.
    """
    usual = _place(scene, edit, Variant())
    own = ga.learn_pose(scene, edit.pose, edit.footprint).parent.id
    best = {str(r.parent.id): (r, p) for r, p in reversed(usual) if r.parent.id != own}
    rooms = {id: r for id, (r, _) in best.items()}
    place = {id: p for id, (_, p) in best.items()}
    worst = dict.fromkeys(rooms, (0.0, 0.0))
    for variant in VARIANTS:
        others = _place(scene, edit, variant)
        for id, result in rooms.items():
            near = [
                (
                    float(np.hypot(*(p - place[id]))),
                    abs(float(np.angle(np.exp(1j * (o.pose.angle - result.pose.angle))))),
                )
                for o, p in others
                if o.parent.id == id
            ]
            distance, turn = min((n for n in near if n[1] < 0.2), default=(np.inf, np.inf))
            worst[id] = (max(worst[id][0], distance / result.parent.size), max(worst[id][1], turn))
    found = [Movement(rooms[id].importance, *worst[id]) for id in rooms]
    return sorted(found, key=lambda m: -m.importance)


def _place(scene: ga.Scene, edit: Edit, variant: Variant) -> list[tuple[ga.PropagatedPose, np.ndarray]]:
    """The results on a variant of the grid, and where they are in the scene as it was."""
    moved = [
        ga.Polygon(p.points + variant.move, p.label, p.id, orientation=p.orientation, segment_labels=p.segment_labels)
        for p in scene.polygons
    ]
    x, y = np.add(edit.pose.position, variant.move)
    options = replace(edit.options, cells=variant.cells)
    with shifted_grid(variant.shift):
        results = ga.propagate_pose(ga.Scene(moved), ga.Pose((x, y), edit.pose.angle), edit.footprint, options)
    return [(r, np.subtract(r.pose.position, variant.move)) for r in results]
