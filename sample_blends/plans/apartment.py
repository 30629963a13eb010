"""One floor of an apartment building (figure 4.10): eight flats about a corridor and a stairwell, without furniture.

Rooms are drawn by the centre lines of their walls; their polygons are the clear floor between the walls. A door gives a
polygon to each of its two rooms: the square its leaf sweeps on one side, the space to walk through on the other.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np

from .outlines import PlanPolygon, arc, inset, rectangle

HALF_WALL = 0.06
# The outer wall reaches further out from the centre line than inwards.
FACADE = 0.24
DOOR_WIDTH = 0.9
# Toilets have narrow doors, and so has a room at a short piece of wall.
NARROW_DOOR_WIDTH = 0.75
_NARROW = ("1 toilet", "3 toilet", "5 toilet", "7 toilet", "8 toilet", "3 living room")
# Room to step through a door on the side into which it does not open.
PASSAGE = 0.6
# How far a window's sill, and what must stay free to open it, reach into the room.
SILL = 0.15


def _bay(x0: float, x1: float, y: float, depth: float) -> list[tuple[float, float]]:
    """Points of a shallow arc from (x0, y) to (x1, y) that bulges by ``depth`` (positive to the right of its way)."""
    half = abs(x1 - x0) / 2
    radius = (half**2 + depth**2) / (2 * depth)
    opening = np.degrees(np.arcsin(half / radius))
    if x1 > x0:  # along +x: bulges downwards
        points = arc(((x0 + x1) / 2, y + radius - depth), radius, 270 - opening, 270 + opening, 13)
    else:
        points = arc(((x0 + x1) / 2, y - radius + depth), radius, 90 - opening, 90 + opening, 13)
    return [tuple(point) for point in np.round(points, 6)]


# (label, id, centre lines of the walls); ids begin with the number of the flat.
_ROOMS: list[tuple[str, str, list[tuple[float, float]]]] = [
    ("corridor", "corridor", [(5, 10), (41, 10), (41, 12), (5, 12)]),
    ("stairwell", "stairwell", [(20, 12), (25, 12), (25, 18), (20, 18)]),
    # north-west
    ("hall", "1 hall", [(5, 12), (6.8, 12), (6.8, 17.4), (5, 17.4)]),
    ("bathroom", "1 bathroom", [(2.2, 11), (5, 11), (5, 13.8), (2.2, 13.8)]),
    ("closet", "1 closet", [(0, 11), (2.2, 11), (2.2, 13.8), (0, 13.8)]),
    ("bedroom", "1 bedroom a", [(0, 13.8), (5, 13.8), (5, 17.4), (0, 17.4)]),
    ("bedroom", "1 bedroom b", [(0, 17.4), (6.2, 17.4), (6.2, 22), (1.6, 22), (0, 20.4)]),
    ("toilet", "1 toilet", [(6.8, 12), (8.3, 12), (8.3, 14), (6.8, 14)]),
    ("kitchen", "1 kitchen", [(8.3, 12), (12, 12), (12, 15.2), (6.8, 15.2), (6.8, 14), (8.3, 14)]),
    ("living room", "1 living room", [(6.8, 15.2), (12, 15.2), (12, 22), (6.2, 22), (6.2, 17.4), (6.8, 17.4)]),
    # north, with a bay
    ("hall", "2 hall", [(14.4, 12), (16.6, 12), (16.6, 16), (14.4, 16)]),
    ("bathroom", "2 bathroom", [(12, 12), (14.4, 12), (14.4, 14.6), (12, 14.6)]),
    ("closet", "2 closet", [(12, 14.6), (14.4, 14.6), (14.4, 16), (12, 16)]),
    ("kitchen", "2 kitchen", [(16.6, 12), (20, 12), (20, 15.4), (16.6, 15.4)]),
    ("bedroom", "2 bedroom", [(12, 16), (15.5, 16), (15.5, 22), (12, 22)]),
    (
        "living room",
        "2 living room",
        [(15.5, 16), (16.6, 16), (16.6, 15.4), (20, 15.4), (20, 22), *_bay(19.2, 16.3, 22, 1.1), (15.5, 22)],
    ),
    # north, behind the stairwell
    ("hall", "3 hall", [(27.2, 12), (29, 12), (29, 15.9), (31.4, 15.9), (31.4, 17.6), (27.2, 17.6)]),
    ("kitchen", "3 kitchen", [(25, 12), (27.2, 12), (27.2, 15.2), (25, 15.2)]),
    ("toilet", "3 toilet", [(25, 15.2), (27.2, 15.2), (27.2, 16.6), (25, 16.6)]),
    ("bathroom", "3 bathroom", [(29, 12), (31.8, 12), (31.8, 15.9), (29, 15.9)]),
    ("closet", "3 closet", [(31.8, 12), (34, 12), (34, 15.9), (31.8, 15.9)]),
    ("bedroom", "3 bedroom a", [(26.6, 17.6), (30.2, 17.6), (30.2, 22), (26.6, 22)]),
    ("bedroom", "3 bedroom b", [(30.2, 17.6), (31.4, 17.6), (31.4, 15.9), (34, 15.9), (34, 22), (30.2, 22)]),
    (
        "living room",
        "3 living room",
        [(20, 18), (25, 18), (25, 16.6), (27.2, 16.6), (27.2, 17.6), (26.6, 17.6), (26.6, 22), (20, 22)],
    ),
    # north-east
    ("hall", "4 hall", [(36.4, 12), (38.2, 12), (38.2, 15.4), (42.4, 15.4), (42.4, 17), (36.4, 17)]),
    ("bathroom", "4 bathroom", [(34, 12), (36.4, 12), (36.4, 15), (34, 15)]),
    ("closet", "4 closet", [(34, 15), (36.4, 15), (36.4, 17), (34, 17)]),
    ("bedroom", "4 bedroom a", [(34, 17), (38.2, 17), (38.2, 22), (34, 22)]),
    ("kitchen", "4 kitchen", [(38.2, 12), (41, 12), (41, 15.4), (38.2, 15.4)]),
    ("bedroom", "4 bedroom b", [(41, 11), (46, 11), (46, 15.4), (41, 15.4)]),
    (
        "living room",
        "4 living room",
        [(38.2, 17), (42.4, 17), (42.4, 15.4), (46, 15.4), (46, 20), (44, 22), (38.2, 22)],
    ),
    # south-west
    ("hall", "5 hall", [(5, 4.6), (6.8, 4.6), (6.8, 10), (5, 10)]),
    ("bathroom", "5 bathroom", [(2, 4), (5, 4), (5, 6.4), (2, 6.4)]),
    ("closet", "5 closet", [(0, 4), (2, 4), (2, 6.4), (0, 6.4)]),
    ("bedroom", "5 bedroom a", [(0, 6.4), (5, 6.4), (5, 11), (0, 11)]),
    ("bedroom", "5 bedroom b", [(0, 1.4), (1.4, 0), (6.1, 0), (6.1, 4.6), (5, 4.6), (5, 4), (0, 4)]),
    ("toilet", "5 toilet", [(6.8, 8.4), (8.4, 8.4), (8.4, 10), (6.8, 10)]),
    ("kitchen", "5 kitchen", [(8.4, 6.4), (13, 6.4), (13, 10), (8.4, 10)]),
    (
        "living room",
        "5 living room",
        [(6.1, 0), (13, 0), (13, 6.4), (8.4, 6.4), (8.4, 8.4), (6.8, 8.4), (6.8, 4.6), (6.1, 4.6)],
    ),
    # south
    ("hall", "6 hall", [(15.4, 6), (17.8, 6), (17.8, 10), (15.4, 10)]),
    ("bathroom", "6 bathroom", [(13, 7.4), (15.4, 7.4), (15.4, 10), (13, 10)]),
    ("closet", "6 closet", [(13, 6), (15.4, 6), (15.4, 7.4), (13, 7.4)]),
    ("kitchen", "6 kitchen", [(17.8, 6.6), (21, 6.6), (21, 10), (17.8, 10)]),
    ("bedroom", "6 bedroom", [(13, 0), (16.5, 0), (16.5, 6), (13, 6)]),
    ("living room", "6 living room", [(16.5, 0), (21, 0), (21, 6.6), (17.8, 6.6), (17.8, 6), (16.5, 6)]),
    # south
    ("hall", "7 hall", [(25, 4.8), (26.8, 4.8), (26.8, 10), (25, 10)]),
    ("bathroom", "7 bathroom", [(22.4, 7.4), (25, 7.4), (25, 10), (22.4, 10)]),
    ("closet", "7 closet", [(21, 7.4), (22.4, 7.4), (22.4, 10), (21, 10)]),
    ("bedroom", "7 bedroom a", [(21, 0), (24.4, 0), (24.4, 4.8), (25, 4.8), (25, 7.4), (21, 7.4)]),
    ("bedroom", "7 bedroom b", [(24.4, 0), (28, 0), (28, 4.8), (24.4, 4.8)]),
    ("toilet", "7 toilet", [(26.8, 8.4), (28.4, 8.4), (28.4, 10), (26.8, 10)]),
    ("kitchen", "7 kitchen", [(26.8, 6.4), (33, 6.4), (33, 10), (28.4, 10), (28.4, 8.4), (26.8, 8.4)]),
    ("living room", "7 living room", [(28, 0), (33, 0), (33, 6.4), (26.8, 6.4), (26.8, 4.8), (28, 4.8)]),
    # south-east, with a bay
    ("hall", "8 hall", [(36, 5.4), (37.8, 5.4), (37.8, 10), (36, 10)]),
    ("bathroom", "8 bathroom", [(33, 7), (36, 7), (36, 10), (33, 10)]),
    ("bedroom", "8 bedroom a", [(33, 0), (36.6, 0), (36.6, 5.4), (36, 5.4), (36, 7), (33, 7)]),
    ("living room", "8 living room", [(36.6, 0), *_bay(37.9, 41.3, 0, 1.2), (42.5, 0), (42.5, 5.4), (36.6, 5.4)]),
    ("kitchen", "8 kitchen", [(37.8, 5.4), (41, 5.4), (41, 8.4), (37.8, 8.4)]),
    ("toilet", "8 toilet", [(37.8, 8.4), (39.4, 8.4), (39.4, 10), (37.8, 10)]),
    ("closet", "8 closet", [(39.4, 8.4), (41, 8.4), (41, 10), (39.4, 10)]),
    ("bedroom", "8 bedroom b", [(41, 5.4), (46, 5.4), (46, 11), (41, 11)]),
    ("bedroom", "8 bedroom c", [(42.5, 0), (44.4, 0), (46, 1.6), (46, 5.4), (42.5, 5.4)]),
]

# (middle of the threshold on the wall's centre line, the room it opens into, the other room)
_DOORS: list[tuple[tuple[float, float], str, str]] = [
    ((5.52, 12), "1 hall", "corridor"),
    ((5, 13.1), "1 bathroom", "1 hall"),
    ((1.1, 13.8), "1 closet", "1 bedroom a"),
    ((5, 14.6), "1 bedroom a", "1 hall"),
    ((5.6, 17.4), "1 bedroom b", "1 hall"),
    ((6.8, 13.4), "1 hall", "1 toilet"),
    ((6.8, 14.6), "1 kitchen", "1 hall"),
    ((6.8, 16.4), "1 living room", "1 hall"),
    ((15.5, 12), "2 hall", "corridor"),
    ((14.4, 13.8), "2 bathroom", "2 hall"),
    ((14.4, 15.3), "2 closet", "2 hall"),
    ((14.95, 16), "2 bedroom", "2 hall"),
    ((16.05, 16), "2 living room", "2 hall"),
    ((16.6, 14.6), "2 kitchen", "2 hall"),
    ((28.1, 12), "3 hall", "corridor"),
    ((27.2, 14.4), "3 kitchen", "3 hall"),
    ((27.2, 15.9), "3 hall", "3 toilet"),
    ((29, 14.6), "3 bathroom", "3 hall"),
    ((33.0, 15.9), "3 closet", "3 bedroom b"),
    ((28.4, 17.6), "3 bedroom a", "3 hall"),
    ((31.4, 16.75), "3 bedroom b", "3 hall"),
    ((27.2, 17.1), "3 living room", "3 hall"),
    ((37.3, 12), "4 hall", "corridor"),
    ((36.4, 14.2), "4 bathroom", "4 hall"),
    ((36.4, 16.2), "4 closet", "4 hall"),
    ((37.4, 17), "4 bedroom a", "4 hall"),
    ((38.2, 14.4), "4 kitchen", "4 hall"),
    ((41.75, 15.4), "4 bedroom b", "4 hall"),
    ((40.3, 17), "4 living room", "4 hall"),
    ((5.52, 10), "5 hall", "corridor"),
    ((5, 5.5), "5 bathroom", "5 hall"),
    ((1.0, 6.4), "5 closet", "5 bedroom a"),
    ((5, 7.2), "5 bedroom a", "5 hall"),
    ((5.55, 4.6), "5 bedroom b", "5 hall"),
    ((6.8, 9.2), "5 hall", "5 toilet"),
    ((6.8, 7.2), "5 living room", "5 hall"),
    ((9.2, 6.4), "5 kitchen", "5 living room"),
    ((16.4, 10), "6 hall", "corridor"),
    ((15.4, 8.2), "6 bathroom", "6 hall"),
    ((15.4, 6.7), "6 closet", "6 hall"),
    ((17.8, 7.4), "6 kitchen", "6 hall"),
    ((15.95, 6), "6 bedroom", "6 hall"),
    ((17.15, 6), "6 living room", "6 hall"),
    ((25.52, 10), "7 hall", "corridor"),
    ((25, 8.2), "7 bathroom", "7 hall"),
    ((21.7, 7.4), "7 closet", "7 bedroom a"),
    ((25, 6.6), "7 bedroom a", "7 hall"),
    ((25.7, 4.8), "7 bedroom b", "7 hall"),
    ((26.8, 9.2), "7 hall", "7 toilet"),
    ((26.8, 7.4), "7 kitchen", "7 hall"),
    ((26.8, 5.6), "7 living room", "7 hall"),
    ((36.52, 10), "8 hall", "corridor"),
    ((36, 7.8), "8 bathroom", "8 hall"),
    ((36, 6.2), "8 bedroom a", "8 hall"),
    ((37.2, 5.4), "8 living room", "8 hall"),
    ((37.8, 6.4), "8 kitchen", "8 hall"),
    ((37.8, 9.2), "8 hall", "8 toilet"),
    ((41, 9.2), "8 closet", "8 bedroom b"),
    ((41.75, 5.4), "8 bedroom b", "8 living room"),
    ((42.5, 4.5), "8 bedroom c", "8 living room"),
]

# (middle on the outer wall's centre line, room, width)
_WINDOWS: list[tuple[tuple[float, float], str, float]] = [
    ((0, 12.4), "1 closet", 0.7),
    ((0, 15.6), "1 bedroom a", 1.6),
    ((0, 18.9), "1 bedroom b", 1.4),
    ((3.9, 22), "1 bedroom b", 1.8),
    ((9.1, 22), "1 living room", 2.6),
    ((13.75, 22), "2 bedroom", 1.6),
    ((22.0, 22), "3 living room", 1.8),
    ((25.0, 22), "3 living room", 1.4),
    ((28.4, 22), "3 bedroom a", 1.6),
    ((32.1, 22), "3 bedroom b", 1.8),
    ((36.1, 22), "4 bedroom a", 1.8),
    ((41.1, 22), "4 living room", 2.4),
    ((45, 21), "4 living room", 1.4),
    ((46, 17.7), "4 living room", 1.8),
    ((46, 13.2), "4 bedroom b", 1.8),
    ((0, 8.7), "5 bedroom a", 1.8),
    ((0, 5.2), "5 closet", 0.7),
    ((0, 2.7), "5 bedroom b", 1.0),
    ((3.6, 0), "5 bedroom b", 1.8),
    ((9.5, 0), "5 living room", 2.6),
    ((14.75, 0), "6 bedroom", 1.6),
    ((18.75, 0), "6 living room", 2.2),
    ((22.7, 0), "7 bedroom a", 1.6),
    ((26.2, 0), "7 bedroom b", 1.6),
    ((30.5, 0), "7 living room", 2.4),
    ((34.8, 0), "8 bedroom a", 1.6),
    ((46, 8.2), "8 bedroom b", 1.8),
    ((46, 3.4), "8 bedroom c", 1.6),
    ((43.4, 0), "8 bedroom c", 1.0),
]

# Rooms whose arc is one curved window.
BAYS = ("2 living room", "8 living room")


@dataclass(frozen=True)
class Opening:
    """A door or a window.

    Attributes
    ----------
    id : str
    position : ndarray (2,)
        Its middle on the inner face of the wall of ``room``.
    direction : ndarray (2,)
        Unit vector into ``room``.
    room : str
        The room into which it opens.
    other : str or None
        A door's other room; None for a window.
    width : float
    hinge : int
        A door's hinge: 1 where it is to the left as one enters ``room``, -1 to the right.
    """

    id: str
    position: np.ndarray
    direction: np.ndarray
    room: str
    other: str | None
    width: float
    hinge: int = 0

    @property
    def angle(self) -> float:
        """Angle of the direction, radians."""
        return float(np.arctan2(self.direction[1], self.direction[0]))

    def outline(self, low: float, high: float) -> np.ndarray:
        """Rectangle of the opening's width between two depths, measured along its direction from the inner face."""
        across = np.array((-self.direction[1], self.direction[0])) * self.width / 2
        near, far = self.position + low * self.direction, self.position + high * self.direction
        return np.array((near - across, far - across, far + across, near + across))


@cache
def centre_lines() -> dict[str, np.ndarray]:
    """Ring of the walls' centre lines about each room, by the room's id."""
    return {name: np.array(points, dtype=float) for _, name, points in _ROOMS}


def rooms() -> list[PlanPolygon]:
    """The rooms: clear floor between the walls."""
    return [PlanPolygon(label, name, inset(centre_lines()[name], HALF_WALL)) for label, name, _ in _ROOMS]


def _wall_at(room: str, point: np.ndarray) -> tuple[np.ndarray, float, float]:
    """Inward normal of the wall of a room that runs through a point, and the distances to the wall's two ends."""
    ring = centre_lines()[room]
    for start, end in zip(ring, np.roll(ring, -1, axis=0), strict=True):
        along = (end - start) / np.linalg.norm(end - start)
        normal = np.array((-along[1], along[0]))
        reach = float((point - start) @ along)
        if abs((point - start) @ normal) < 1e-6 and 0 < reach < np.linalg.norm(end - start):
            return normal, reach, float(np.linalg.norm(end - start)) - reach
    raise ValueError(f"no wall of {room!r} runs through {tuple(point)}")


def doors() -> list[Opening]:
    """The doors; each hinge is on the side of the nearer corner, so that the leaf opens against a wall."""
    made = []
    for at, room, other in _DOORS:
        point = np.array(at, dtype=float)
        normal, before, after = _wall_at(room, point)
        _wall_at(other, point)
        # Looking into the room, the wall (counter-clockwise about it) runs from left to right behind one's back.
        hinge = 1 if before < after else -1
        width = NARROW_DOOR_WIDTH if room in _NARROW or other in _NARROW else DOOR_WIDTH
        made.append(Opening(f"door {other} to {room}", point + HALF_WALL * normal, normal, room, other, width, hinge))
    return made


def windows() -> list[Opening]:
    """The straight windows."""
    made = []
    for number, (at, room, width) in enumerate(_WINDOWS):
        point = np.array(at, dtype=float)
        normal, _, _ = _wall_at(room, point)
        made.append(Opening(f"window {number} {room}", point + HALF_WALL * normal, normal, room, None, width))
    return made


def bay_lines() -> dict[str, np.ndarray]:
    """Centre line (n, 2) of the curved outer wall of each bay, counter-clockwise about its room."""
    return {
        name: np.array([point for point in points if point[1] > 22 - 1e-5 or point[1] < 1e-5], dtype=float)[1:-1]
        for _, name, points in _ROOMS
        if name in BAYS
    }


def offset_line(line: np.ndarray, distance: float) -> np.ndarray:
    """An open line moved to its left, corners mitred, ends perpendicularly."""
    along = np.diff(line, axis=0)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    normal = np.column_stack((-along[:, 1], along[:, 0]))
    before, after = np.vstack((normal[:1], normal)), np.vstack((normal, normal[-1:]))
    return line + distance * (before + after) / (1 + np.sum(before * after, axis=1, keepdims=True))


def plan() -> list[PlanPolygon]:
    """All labelled polygons: rooms, doors (one for each side), windows."""
    polygons = rooms()
    for door in doors():
        polygons.append(PlanPolygon("door", f"{door.id}, leaf", door.outline(0.0, door.width), door.room))
        beyond = -2 * HALF_WALL
        polygons.append(PlanPolygon("door", f"{door.id}, passage", door.outline(beyond - PASSAGE, beyond), door.other))
    for window in windows():
        polygons.append(PlanPolygon("window", window.id, window.outline(0.0, SILL), window.room))
    for room, line in bay_lines().items():
        # The bay's window stops short of its ends, where the wall bends outwards.
        inner, sill = (offset_line(line, depth)[1:-1] for depth in (HALF_WALL, HALF_WALL + SILL))
        polygons.append(PlanPolygon("window", f"bay {room}", np.vstack((inner, sill[::-1])), room))
    return polygons


def outline() -> np.ndarray:
    """Bounding rectangle of the building."""
    every = np.vstack(list(centre_lines().values()))
    return rectangle(*(every.min(axis=0) - FACADE), *(every.max(axis=0) + FACADE))
