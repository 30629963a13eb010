"""Figure 4.19: importance by distance alone attends to the wrong neighbours, and weights by label mend it.

The chair belongs to the desk, but two chairs of the table behind it are as near. In the other room the places before
the desk and between such chairs are apart.
"""

from collections.abc import Mapping

import geoanalogy as ga

from .furnishing import box, piece, pose, rectangle

ROOMS = ("source", "target")
CHAIR = box(0.5, 0.5)
DESK = box(0.7, 1.5)
TABLE = box(1.0, 1.3)

SOURCE = pose(3.4, 2.6)
#: Where the chair belongs in the other room: before the desk.
AT_DESK = pose(8.6, 3.35, 90)


def _table(x: float, y: float) -> list[ga.Polygon]:
    """A table with four chairs."""
    chairs = [pose(x + dx, y + dy, 180 if dx > 0 else 0) for dx in (-0.7, 0.7) for dy in (-0.33, 0.33)]
    return [piece(pose(x, y), TABLE, "table"), *(piece(c, CHAIR, "chair") for c in chairs)]


SCENE = ga.Scene(
    [
        ga.Polygon(rectangle(0, 0, 4.6, 5.2), "study", "source"),
        ga.Polygon(rectangle(5.2, 0, 5.4, 4.6), "study", "target"),
        piece(pose(4.25, 2.6, 180), DESK, "desk"),
        piece(pose(8.6, 4.2, -90), DESK, "desk"),
        *_table(2.17, 2.6),
        *_table(7.0, 1.9),
    ]
)


def run(relation_weights: Mapping[str, float] | None = None) -> tuple[ga.PoseModel, ga.PropagatedPose]:
    """Propagate the chair of the desk into the other room.

    Parameters
    ----------
    relation_weights : mapping of str to float, optional
        Factors per label, besides the importance by distance.

    Returns
    -------
    model : PoseModel
    best : PropagatedPose
        In the other room.
    """
    options = ga.PoseOptions(scale="fixed", relation_weights=dict(relation_weights or {}))
    model = ga.learn_pose(SCENE, SOURCE, CHAIR, options)
    return model, next(r for r in model.place(SCENE) if r.parent.id == "target")
