"""A storey as a plan: rooms behind the windows of its facades, in the storey's own frame."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

import geoanalogy as ga
from geoanalogy.geometry.frame import Frame
from geoanalogy.geometry.surface import GROUND
from geoanalogy.operations.element import Element

from ..kitchens.rooms import KITCHEN, room
from ..plans.outlines import rectangle

#: Metres: the outer wall, half an inner wall, and the corridor.
FACADE, HALF_WALL, CORRIDOR = 0.35, 0.06, 1.6

#: Height of a storey, doors, the room to step through them, and the room to open windows.
HEIGHT, DOOR, PASSAGE, SILL = 3.1, 0.9, 0.6, 0.15

#: The rooms of one flat along its windows, and the widths that they should have.
FLAT = (("living room", 5.4), ("bedroom", 3.6), (KITCHEN, 3.6), ("bedroom", 3.4))

#: What has no window: width of bathrooms beside a stretch of wall without any, and of the shortest such stretch.
BATHROOM, BLIND = 2.3, 4.5

#: How far from a window an inner wall stands that has none on its other side.
MARGIN = 0.7

#: What daylight comes through, by the last word of its label.
OPENINGS = ("window", "loggia")

Span = tuple[float, float]
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
    windows : (tuple of (float, float), tuple of (float, float))
        Ends of the windows in the front, and of those in the rear.
    """

    frame: Frame
    width: float
    depth: float
    windows: tuple[tuple[Span, ...], tuple[Span, ...]] = ((), ())

    @classmethod
    def of(cls, building: Element, level: float, elements: Iterable[Element] = ()) -> Storey:
        """A storey of a building with a rectangular outline, its floor at a height.

        Its windows are those of the elements that have been cut into the building's front and rear at that height.

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
        frame = Frame(origin, (float(c), float(s), 0.0), (float(-s), float(c), 0.0))
        return cls(frame, float(width), float(depth), _windows(frame, float(width), float(depth), elements))

    def rooms(self) -> list[tuple[str, Box, bool]]:
        """Labels of the rooms, their clear floors, and whether they lie before the corridor."""
        found = []
        half = (self.depth - CORRIDOR) / 2
        for front in (True, False):
            low, high = (0.0, half - HALF_WALL) if front else (half + CORRIDOR + HALF_WALL, self.depth)
            for label, x0, x1 in _behind(self.windows[0 if front else 1], self.width, FLAT if front else FLAT[::-1]):
                left, right = (0.0 if x0 <= 0 else HALF_WALL), (0.0 if x1 >= self.width else HALF_WALL)
                found.append((label, (x0 + left, low, x1 - right, high), front))
        return found

    @property
    def corridor(self) -> Box:
        """The clear floor of the corridor."""
        half = (self.depth - CORRIDOR) / 2
        return (0.0, half + HALF_WALL, self.width, half + CORRIDOR - HALF_WALL)

    def halls(self) -> list[Box]:
        """Clear floors of what opens to the corridor, where a facade has no windows: staircases, ways to a wing."""
        found = []
        half = (self.depth - CORRIDOR) / 2
        for front in (True, False):
            ends = [0.0, *(x for _, (x0, _, x1, _), before in self.rooms() if before == front for x in (x0, x1))]
            low, high = (0.0, half + HALF_WALL) if front else (half + CORRIDOR - HALF_WALL, self.depth)
            for a, b in zip(ends[::2], [*ends[1::2], self.width], strict=True):
                if b - a > 2 * HALF_WALL + 1e-6:
                    left, right = (2 * HALF_WALL if a > 0.0 else 0.0), (2 * HALF_WALL if b < self.width else 0.0)
                    found.append((a + left, low, b - right, high))
        return found

    def openings(self) -> list[tuple[str, Box, bool]]:
        """Label of every door and window, its ends along the wall, and whether its room lies before the corridor."""
        found = []
        for label, (x0, _, x1, _), front in self.rooms():
            if label != KITCHEN:
                found.append(("door", (x0 + 0.15, 0.0, x0 + 0.15 + DOOR, 0.0), front))
                for a, b in self.windows[0 if front else 1]:
                    if x0 <= a and b <= x1:
                        found.append(("window", (a, 0.0, b, 0.0), front))
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


def _windows(
    frame: Frame, width: float, depth: float, elements: Iterable[Element]
) -> tuple[tuple[Span, ...], tuple[Span, ...]]:
    """Ends of the windows in the front and in the rear of a storey."""
    found: tuple[list[Span], list[Span]] = ([], [])
    for e in elements:
        if e.surface == GROUND or e.ring is None or e.label.split()[-1] not in OPENINGS:
            continue
        corners = frame.to_plane(e.frame.to_space(e.ring))
        (x0, y0, z0), (x1, y1, z1) = corners.min(axis=0), corners.max(axis=0)
        inside = 0.0 < x0 and x1 < width and 0.0 < z0 and (z0 + z1) / 2 < HEIGHT
        for side, y in zip(found, (-FACADE, depth + FACADE), strict=True):
            if inside and max(abs(y0 - y), abs(y1 - y)) < FACADE:
                side.append((float(x0), float(x1)))
    return tuple(sorted(found[0])), tuple(sorted(found[1]))


def _behind(windows: Sequence[Span], width: float, flat: Sequence[tuple[str, float]]) -> list[tuple[str, float, float]]:
    """Rooms along a facade: a row behind neighbouring windows, bathrooms beside what has none.

    Inner walls stand in the middle between two windows.
    """
    ends = [0.0, *(x for span in windows for x in span), width]
    blind = [(a, b) for a, b in zip(ends[::2], ends[1::2], strict=True) if b - a > BLIND]
    # A wall keeps half the usual distance of two windows from them.
    rows, at = [], 0.0
    for a, b in blind:
        rows.append((at, a + MARGIN if a > 0.0 else 0.0))
        at = b - MARGIN if b < width else width
    rows.append((at, width))
    found: list[tuple[str, float, float]] = []
    for k, (x0, x1) in enumerate(rows):
        those = [span for span in windows if x0 <= span[0] and span[1] <= x1]
        if those:
            if k:
                found.append(("bathroom", x0 - BATHROOM, x0))
            found += _in_a_row(those, x0, x1, flat)
            if k + 1 < len(rows):
                found.append(("bathroom", x1, x1 + BATHROOM))
    return found


def _in_a_row(
    windows: Sequence[Span], x0: float, x1: float, flat: Sequence[tuple[str, float]]
) -> list[tuple[str, float, float]]:
    """Rooms from one end to another, in the flat's order, each with as many windows as come nearest to its width."""
    middles = [(a[1] + b[0]) / 2 for a, b in pairwise(windows)]
    ends = [x0, *middles, x1]
    found, at = [], 0
    while at < len(windows):
        label, wanted = flat[len(found) % len(flat)]
        last = min(range(at + 1, len(ends)), key=lambda k: abs(ends[k] - ends[at] - wanted))
        found.append((label, float(ends[at]), float(ends[last])))
        at = last
    return found
