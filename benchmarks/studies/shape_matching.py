"""Figure 4.18: against two methods by shape contexts, SC B-spline and SC inner.

A bed stands with its head at the end of an angled room's leg. The first target is an affine image of the room, the
second has legs of other lengths and widths, the third has other angles too. In the fourth row a night table belongs to
one of several pieces that are arranged in another way.
"""

import time
from dataclasses import dataclass

import numpy as np

import geoanalogy as ga

from ..peers import shape_contexts as sc
from .furnishing import Array, box, piece, pose, rectangle

METHODS = ("SC B-spline", "SC inner", "relations")
BED, NIGHT_TABLE = box(2.0, 1.6), box(0.45, 0.45)
ANGLED = np.array([(0, 0), (5, 0), (5, 2.0), (2.8, 2.0), (2.8, 5.6), (0, 5.6)])


@dataclass(frozen=True)
class Row:
    """A source room, a target room, and the place that is meant.

    Attributes
    ----------
    scene : Scene
        With the rooms "source" and "target".
    footprint : ndarray of shape (n, 2)
    source, intended : Pose
    """

    scene: ga.Scene
    footprint: Array
    source: ga.Pose
    intended: ga.Pose

    def rings(self, room: str) -> list[Array]:
        """Outlines of a room and of what stands in it."""
        return [self.scene.polygon(room).points, *(m.points for m in self.scene.members_of(room))]


@dataclass(frozen=True)
class Answer:
    """Where a method puts the object.

    Attributes
    ----------
    pose : Pose
    error : float
        Distance from the intended place, in scene units.
    turn : float
        Angle from the intended direction, radians.
    seconds : float
    detail : object
        What the method shows: its registration, its qualities, or its model.
    """

    pose: ga.Pose
    error: float
    turn: float
    seconds: float
    detail: sc.Registration | sc.InnerMatch | ga.PoseModel


def _at_end(outline: Array, first: int) -> ga.Pose:
    """A bed in the middle of the edge that starts at a vertex, its head 5 centimetres from it."""
    a, b = outline[first], outline[first + 1]
    inwards = np.array([a[1] - b[1], b[0] - a[0]]) / np.hypot(*(b - a))
    x, y = (a + b) / 2 + 1.05 * inwards
    return ga.Pose((float(x), float(y)), float(np.arctan2(inwards[1], inwards[0])))


def _bed_row(target: Array, first: int = 4) -> Row:
    """The bed from the angled room to another one."""
    aside = np.array([7.0, 0.0])
    scene = ga.Scene([ga.Polygon(ANGLED, "bedroom", "source"), ga.Polygon(target + aside, "bedroom", "target")])
    return Row(scene, BED, _at_end(ANGLED, 4), _at_end(target + aside, first))


def affine() -> Row:
    """A stretched and sheared room."""
    return _bed_row(ANGLED @ np.array([[1.05, 0.0], [0.2, 1.1]]))


def locally_affine() -> Row:
    """One leg longer and narrower, the other shorter."""
    return _bed_row(np.array([(0, 0), (6.4, 0), (6.4, 1.8), (2.4, 1.8), (2.4, 7.2), (0, 7.2)]))


def neither() -> Row:
    """Other angles at every corner."""
    return _bed_row(
        np.array([(0.6, 0.7), (5.2, 0), (7.3, 2.3), (4.9, 3.1), (3.4, 2.6), (2.3, 6.5), (-0.5, 5.6)]), first=5
    )


def several_objects() -> Row:
    """A night table beside the bed, in rooms that are furnished differently."""
    wardrobe, desk = box(0.6, 1.8), box(0.7, 1.4)
    scene = ga.Scene(
        [
            ga.Polygon(rectangle(0, 0, 5, 4), "bedroom", "source"),
            piece(pose(1.8, 2.95, -90), BED, "bed"),
            piece(pose(4.68, 2.2, 180), wardrobe, "wardrobe"),
            piece(pose(1.5, 0.37, 90), desk, "desk"),
            ga.Polygon(rectangle(7.5, 0, 4.6, 4.8), "bedroom", "target"),
            piece(pose(11.05, 1.4, 180), BED, "bed"),
            piece(pose(9.2, 4.48, -90), wardrobe, "wardrobe"),
            piece(pose(7.87, 2.2, 0), desk, "desk"),
        ]
    )
    return Row(scene, NIGHT_TABLE, pose(0.72, 3.7, -90), pose(11.8, 2.48, 180))


ROWS = {
    "affine": affine,
    "locally affine": locally_affine,
    "neither": neither,
    "several objects": several_objects,
}


def run(row: Row, method: str) -> Answer:
    """Carry the object over with one method.

    Parameters
    ----------
    row : Row
    method : str
        Of `METHODS`.

    Returns
    -------
    Answer
    """
    start = time.perf_counter()
    detail: sc.Registration | sc.InnerMatch | ga.PoseModel
    if method == "SC B-spline":
        detail = sc.register(row.rings("source"), row.rings("target"))
        place, angle = detail.pose(row.source.position, row.source.angle)
        found = ga.Pose((place[0], place[1]), angle)
    elif method == "SC inner":
        detail = sc.match_inside(row.rings("source"), row.source.position, row.source.angle, row.rings("target"))
        found = ga.Pose((detail.position[0], detail.position[1]), detail.angle)
    else:
        detail = ga.learn_pose(row.scene, row.source, row.footprint, ga.PoseOptions(scale="fixed", mirror=False))
        found = next(r for r in detail.place(row.scene) if r.parent.id == "target").pose
    seconds = time.perf_counter() - start
    error = float(np.hypot(*np.subtract(found.position, row.intended.position)))
    turn = abs(float(np.angle(np.exp(1j * (found.angle - row.intended.angle)))))
    return Answer(found, error, turn, seconds, detail)
