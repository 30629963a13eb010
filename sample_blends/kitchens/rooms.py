"""Rooms as plain numbers: those that the kitchens are recorded in, and those that they are then built in.

A room is drawn from the left corner of its wall with the door on, counter-clockwise, seen from that wall.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

import geoanalogy as ga

KITCHEN = "kitchen"

Corners = Sequence[tuple[float, float]]


def rectangular(width: float, depth: float) -> Corners:
    return ((0, 0), (width, 0), (width, depth), (0, depth))


def angled(width: float, depth: float, across: float, along: float) -> Corners:
    """L-shaped: a rectangle without its right back corner."""
    inner = width - across
    return ((0, 0), (width, 0), (width, depth - along), (inner, depth - along), (inner, depth), (0, depth))


def chamfered(width: float, depth: float, cut: float) -> Corners:
    """A rectangle whose right front corner is cut off."""
    return ((0, 0), (width - cut, 0), (width, cut), (width, depth), (0, depth))


def niched(width: float, depth: float, across: float, along: float) -> Corners:
    """A rectangle with a niche at the left of its front."""
    return ((0, 0), (across, 0), (across, along), (width, along), (width, depth), (0, depth))


#: The rooms that the kitchens are recorded in.
RECORDED: tuple[Corners, ...] = (
    rectangular(3.4, 3.6),
    rectangular(4.0, 3.2),
    rectangular(3.0, 4.2),
    rectangular(4.6, 4.0),
    rectangular(3.6, 4.8),
    rectangular(5.0, 3.5),
    angled(4.8, 4.6, 1.5, 1.6),
    chamfered(4.2, 4.1, 0.9),
    rectangular(2.8, 3.3),
)

#: The rooms that they are built in.
BUILT: tuple[Corners, ...] = (
    rectangular(3.2, 3.9),
    rectangular(4.3, 3.4),
    rectangular(3.7, 3.7),
    angled(5.2, 4.2, 1.7, 1.5),
    rectangular(2.9, 5.4),
    rectangular(6.0, 3.3),
    chamfered(4.4, 3.8, 0.8),
    rectangular(4.9, 4.4),
    angled(4.4, 5.0, 1.2, 2.0),
    rectangular(3.1, 3.1),
    niched(4.6, 4.8, 1.5, 1.1),
    rectangular(3.9, 4.5),
    chamfered(3.7, 4.6, 1.1),
    rectangular(5.4, 3.9),
    angled(4.0, 4.1, 0.9, 1.1),
    rectangular(3.4, 4.9),
)

#: Rooms in a row, and the least distance between them.
ROW, APART = 4, 1.6


def edge_labels(corners: Corners) -> tuple[str, ...]:
    """The labels of a room's edges: "door" for the first; of those that face one way seen from there, the longest is
    "right", "back" or "left", the others are "inner", "front" or "slanted".
    """
    ring = np.asarray(corners, float)
    edges = np.roll(ring, -1, axis=0) - ring
    lengths = np.hypot(*edges.T)
    ahead = edges[0] / lengths[0]
    along = edges @ ahead / lengths
    across = (edges @ (-ahead[1], ahead[0])) / lengths
    names = np.select([along > 0.99, across > 0.99, along < -0.99, across < -0.99], range(4), default=-1)
    labels = []
    for i, name in enumerate(names):
        if name < 0:
            labels.append("slanted")
        elif name == 0:
            labels.append("front" if i else "door")
        else:
            longest = max(np.flatnonzero(names == name), key=lambda k: lengths[k])
            labels.append(("right", "back", "left")[name - 1] if i == longest else "inner")
    return tuple(labels)


def room(corners: Corners, name: str, x: float = 0.0, y: float = 0.0, angle: float = 0.0) -> ga.Polygon:
    """A kitchen whose first corner is at a point, its wall with the door running at an angle."""
    c, s = np.cos(angle), np.sin(angle)
    ring = np.asarray(corners, float) @ np.array([[c, s], [-s, c]]) + (x, y)
    return ga.Polygon(ring, label=KITCHEN, id=name, orientation=angle, segment_labels=edge_labels(corners))


def _in_rows(rooms: Sequence[Corners], name: str) -> ga.Scene:
    """Rooms side by side, the first row at the back."""
    made, y = [], 0.0
    for start in range(0, len(rooms), ROW):
        row = [np.asarray(corners, float) for corners in rooms[start : start + ROW]]
        y -= max(float(ring[:, 1].max()) for ring in row) + APART
        x = 0.0
        for i, ring in enumerate(row):
            made.append(room(ring.tolist(), f"{name} {start + i + 1:02d}", x, y))
            x += float(ring[:, 0].max()) + APART
    return ga.Scene(made)


def recorded() -> ga.Scene:
    """The nine rooms that the kitchens are recorded in."""
    return _in_rows(RECORDED, "example")


def built() -> ga.Scene:
    """Sixteen other rooms: rectangular, long, L-shaped, with a chamfer, with a niche."""
    return _in_rows(BUILT, "room")
