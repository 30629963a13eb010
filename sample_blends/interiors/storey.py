"""A storey as a plan: rooms on both sides of a corridor, with their doors and windows, in the storey's own frame."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

import geoanalogy as ga
from geoanalogy.geometry.frame import Frame
from geoanalogy.operations.element import Element

from ..kitchens.rooms import KITCHEN, room
from ..plans.outlines import rectangle

#: Metres: the outer wall, half an inner wall, and the corridor.
FACADE, HALF_WALL, CORRIDOR = 0.35, 0.06, 1.6

#: Doors, the room to step through them, windows, and the room to open these.
DOOR, PASSAGE, WINDOW, SILL = 0.9, 0.6, 1.6, 0.15

#: The rooms of one flat along the corridor and the widths that they should have.
FLAT = (("living room", 4.6), ("bedroom", 3.6), ("bathroom", 2.3), (KITCHEN, 3.6), ("bedroom", 3.4))

Box = tuple[float, float, float, float]


@dataclass(frozen=True)
class Storey:
    """One storey of a building.

    Attributes
    ----------
    frame : Frame
        Where it lies: its origin is the left front corner inside the outer walls, x along the front.
    width, depth : float
        Inside the outer walls.
    """

    frame: Frame
    width: float
    depth: float

    @classmethod
    def of(cls, building: Element, level: float) -> Storey:
        """A storey of a building with a rectangular outline, its floor at a height.

        Raises
        ------
        InputError
            Where there is no room for a corridor with rooms on both sides.
        """
        ring = building.ring
        if ring is None or len(ring) != 4:
            raise ga.InputError(f"{building.id!r} has no rectangular outline; choose another building")
        c, s = np.cos(building.pose.angle), np.sin(building.pose.angle)
        turned = ring @ np.array([[c, -s], [s, c]])
        width, depth = np.ptp(turned, axis=0) - 2 * FACADE
        if min(width, depth) < CORRIDOR + 6.4:
            raise ga.InputError(f"{building.id!r} is {width:.1f} by {depth:.1f} inside; choose a larger building")
        x, y = turned.min(axis=0) + FACADE
        origin = (float(c * x - s * y), float(s * x + c * y), level)
        return cls(Frame(origin, (float(c), float(s), 0.0), (float(-s), float(c), 0.0)), float(width), float(depth))

    def rooms(self) -> list[tuple[str, Box, bool]]:
        """Labels of the rooms, their clear floors, and whether they lie before the corridor."""
        found = []
        half = (self.depth - CORRIDOR) / 2
        for front in (True, False):
            labels = _in_a_row(self.width, FLAT if front else FLAT[::-1])
            low, high = (0.0, half - HALF_WALL) if front else (half + CORRIDOR + HALF_WALL, self.depth)
            for label, x0, x1 in labels:
                left, right = (0.0 if x0 <= 0 else HALF_WALL), (0.0 if x1 >= self.width else HALF_WALL)
                found.append((label, (x0 + left, low, x1 - right, high), front))
        return found

    @property
    def corridor(self) -> Box:
        """The clear floor of the corridor."""
        half = (self.depth - CORRIDOR) / 2
        return (0.0, half + HALF_WALL, self.width, half + CORRIDOR - HALF_WALL)

    def openings(self) -> list[tuple[str, Box, bool]]:
        """Label of every door and window, its ends along the wall, and whether its room lies before the corridor."""
        found = []
        for label, (x0, _, x1, _), front in self.rooms():
            if label != KITCHEN:
                found.append(("door", (x0 + 0.15, 0.0, x0 + 0.15 + DOOR, 0.0), front))
                if label != "bathroom":
                    middle = (x0 + x1) / 2
                    found.append(("window", (middle - WINDOW / 2, 0.0, middle + WINDOW / 2, 0.0), front))
        return found

    def plan(self) -> ga.Scene:
        """What the furniture of rooms is placed by: rooms but for kitchens, leaves and passages of doors, windows."""
        half = (self.depth - CORRIDOR) / 2
        made = [ga.Polygon(rectangle(*self.corridor), label="corridor", id="corridor")]
        for i, (label, box, _) in enumerate(self.rooms()):
            if label != KITCHEN:
                made.append(ga.Polygon(rectangle(*box), label=label, id=f"{label} {i + 1}"))
        for i, (label, (x0, _, x1, _), front) in enumerate(self.openings()):
            if label == "window":
                spans = [(0.0, SILL)]
            else:
                spans = [(half - HALF_WALL - DOOR, half - HALF_WALL), (half + HALF_WALL, half + HALF_WALL + PASSAGE)]
            for k, (low, high) in enumerate(spans):
                y0, y1 = (low, high) if front else (self.depth - high, self.depth - low)
                made.append(ga.Polygon(rectangle(x0, y0, x1, y1), label=label, id=f"{label} {i + 1} {k}"))
        return ga.Scene(made)

    def kitchens(self) -> ga.Scene:
        """The kitchens; their doors are in their walls along the corridor."""
        made = []
        for i, (label, (x0, y0, x1, y1), front) in enumerate(self.rooms()):
            if label == KITCHEN:
                corners = ((0.0, 0.0), (x1 - x0, 0.0), (x1 - x0, y1 - y0), (0.0, y1 - y0))
                place = (x1, y1, np.pi) if front else (x0, y0, 0.0)
                made.append(room(corners, f"{KITCHEN} {i + 1}", *place))
        return ga.Scene(made)


def _in_a_row(width: float, flat: Sequence[tuple[str, float]]) -> list[tuple[str, float, float]]:
    """As many rooms as fit best, in the flat's order, all stretched alike."""
    taken, total = [], 0.0
    while True:
        label, wanted = flat[len(taken) % len(flat)]
        if taken and abs(total - width) <= abs(total + wanted - width):
            break
        taken.append((label, wanted))
        total += wanted
    ends = np.cumsum([0.0, *(w for _, w in taken)]) * width / total
    return [(label, float(a), float(b)) for (label, _), a, b in zip(taken, ends[:-1], ends[1:], strict=True)]
