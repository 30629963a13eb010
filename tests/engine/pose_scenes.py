"""Furnished rooms for the tests of pose propagation: a room, its members and what is put into it."""

import numpy as np
from shapes import rectangle, ring
from strategies import Similarity

from geoanalogy import Polygon, Pose, Scene

#: An L, so that a mirrored one is seen; its long side runs along x.
L_DESK = ring((-0.8, -0.4), (0.8, -0.4), (0.8, 0.0), (-0.2, 0.0), (-0.2, 0.4), (-0.8, 0.4))
#: A bed's outline: the same above and below its own x axis.
BED = rectangle(2.0, 1.6, (-1.0, -0.8))

#: 5 by 4 metres: a door below, a window at the left, a wardrobe in the upper right corner. No symmetry.
BEDROOM = (
    ("bedroom", rectangle(5, 4)),
    ("door", rectangle(0.9, 0.9, (3.7, 0.0))),
    ("window", rectangle(0.15, 1.5, (0.0, 1.0))),
    ("wardrobe", rectangle(1.8, 0.6, (3.2, 3.4))),
)
#: Head at the upper wall, left of the wardrobe.
BED_POSE = Pose((1.6, 3.0), -np.pi / 2)


def furnished(things, name, where=Similarity()):  # noqa: B008  (frozen)
    """Polygons of a room and its members (label, ring), moved; ids begin with the room's."""
    (label, outline), *members = things
    room = Polygon(where(outline), label, name)
    return [room, *(Polygon(where(r), m, f"{name} {m}", parent=name) for m, r in members)]


def scene_of(things, *places):
    """A scene of one room at several places: ids "room 0", "room 1", …; the first one is where it was drawn."""
    everywhere = (Similarity(), *places)
    return Scene([p for k, where in enumerate(everywhere) for p in furnished(things, f"room {k}", where)])


def moved(pose, where):
    """A pose after a similarity; a reflection makes it the mirror image."""
    x, y = where(np.array([pose.position]))[0]
    angle = -pose.angle if where.mirrored else pose.angle
    return Pose((x, y), angle + where.angle, pose.mirrored != where.mirrored)


def gap(pose, other):
    """Distance in the plane and turn (radians, not negative) between two poses."""
    away = np.hypot(pose.position[0] - other.position[0], pose.position[1] - other.position[1])
    return float(away), float(abs(np.angle(np.exp(1j * (pose.angle - other.angle)))))


def best_in(results, parent):
    """The best result in a parent, by its id."""
    return next(r for r in results if r.parent.id == parent)
