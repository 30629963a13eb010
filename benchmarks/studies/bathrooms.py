"""Four bathrooms and five pieces to furnish them with: the scene of figures 4.14 and 4.15."""

import geoanalogy as ga
from geoanalogy.relations.table import CENTROID_DIRECTION, POSE_RELATIONS

from .furnishing import Edit, box, outline, pose, rectangle

ROOMS = ("source", "wide", "angled", "long")

SCENE = ga.Scene(
    [
        ga.Polygon(rectangle(0, 0, 2.6, 3.2), "bathroom", "source"),
        ga.Polygon(rectangle(3.4, 0, 3.4, 2.6), "bathroom", "wide"),
        ga.Polygon(
            outline((0, 0), (3.2, 0), (3.2, 1.8), (2.2, 1.8), (2.2, 3.4), (0, 3.4), at=(7.6, 0)), "bathroom", "angled"
        ),
        ga.Polygon(rectangle(11.6, 0, 2.4, 4.0), "bathroom", "long"),
        ga.Polygon(rectangle(1.6, -0.1, 0.8, 0.2), "door"),
        ga.Polygon(rectangle(6.7, 0.2, 0.2, 0.8), "door"),
        ga.Polygon(rectangle(9.8, -0.1, 0.8, 0.2), "door"),
        ga.Polygon(rectangle(12.9, -0.1, 0.8, 0.2), "door"),
    ]
)

#: All relations of section 4.3 and the centroid direction; one piece per room; nobody may stand in a doorway.
OPTIONS = ga.PoseOptions(
    relations=tuple(r.name for r in (*POSE_RELATIONS, CENTROID_DIRECTION)),
    scale="fixed",
    max_per={"bathroom": 1},
    clearance={"door": 0.3},
    cells=20_000,
)

EDITS = {
    "a": Edit("bathtub", box(0.8, 1.7), pose(0.87, 2.78, -90), OPTIONS),
    "b": Edit("toilet", box(0.7, 0.4), pose(0.37, 1.2, 0), OPTIONS),
    "c": Edit("bidet", box(0.45, 0.6), pose(2.36, 1.3, 180), OPTIONS),
    "d": Edit("bathmat", box(0.5, 0.8), pose(0.95, 2.1, -90), OPTIONS),
    "e": Edit("shelf", box(0.3, 0.7), pose(2.43, 2.2, 180), OPTIONS),
}
