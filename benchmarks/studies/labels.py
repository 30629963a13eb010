"""Figure 4.16: what labels are for. A night table, with and without them."""

import geoanalogy as ga

from .furnishing import box, piece, pose, rectangle

ROOMS = ("source", "middle", "right", "living")
NIGHT_TABLE = box(0.45, 0.45)
SOURCE = pose(0.7, 3.32, -90)
BED = box(2.0, 1.6)
CHAIR = box(0.5, 0.5)

SCENE = ga.Scene(
    [
        ga.Polygon(rectangle(0, 0, 4, 3.6), "bedroom", "source"),
        ga.Polygon(rectangle(4.2, 0, 4.4, 3.6), "bedroom", "middle"),
        ga.Polygon(rectangle(8.8, 0, 3.4, 4.4), "bedroom", "right"),
        ga.Polygon(rectangle(0, 3.8, 6.6, 4.6), "living room", "living"),
        piece(pose(1.8, 2.58, -90), BED, "bed"),
        piece(pose(7.58, 1.7, 180), BED, "bed"),
        piece(pose(10.6, 1.02, 90), BED, "bed"),
        piece(pose(2.2, 6.1), box(1.8, 1.0), "table"),
        *(
            piece(pose(2.2 + x, 6.1 + y, -90 if y > 0 else 90), CHAIR, "chair")
            for x in (-0.45, 0.45)
            for y in (-0.85, 0.85)
        ),
        piece(pose(6.1, 6.2, 180), box(0.9, 2.2), "sofa"),
        piece(pose(4.9, 6.2, 180), box(0.6, 1.1), "coffee table"),
        piece(pose(0.25, 7.2), box(0.45, 1.6), "sideboard"),
    ]
)

#: Results of less importance are not looked at.
THRESHOLD = 0.45


def run(labels: bool) -> tuple[ga.PoseModel, ga.PoseResults]:
    """Propagate the night table.

    Parameters
    ----------
    labels : bool
        Whether only features of equal label match.

    Returns
    -------
    model : PoseModel
    results : PoseResults
    """
    model = ga.learn_pose(SCENE, SOURCE, NIGHT_TABLE, ga.PoseOptions(labels=labels, scale="fixed", threshold=THRESHOLD))
    return model, model.place(SCENE)
