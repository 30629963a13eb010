"""The two-storey house: under a hip roof, with a garage beside it or a bay in front, a balcony to the garden."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from geoanalogy.geometry.roof import Roof

from .parts import GARDEN, PAVED, SIDE, STREET, bars, mullion, over, windows
from .recorder import Box, Recorder, Sheet

PLOT = "two-storey"
PITCH = float(np.radians(33.0))

#: Height of the upper floor above the ground, metres.
FLOOR = 2.95


def body(s: Sheet) -> Sequence[Box]:
    x0, y0, x1, _ = s.edges
    return [(x0 + 4.5, y0 + 5, x1 - 2, y0 + 14)]


def garage(s: Sheet) -> Sequence[Box]:
    x0, _, _, _ = s.edges
    return [(x0 + 0.8, h[1] + 1.0, h[0] + 0.2, h[1] + 7.0) for h in s.boxes("house")]


def drive(s: Sheet) -> Sequence[Box]:
    """Up to where the garage begins; where there is none, a car stands in the open."""
    _, y0, _, _ = s.edges
    return [(h[0] - 3.4, y0, h[0] - 0.1, h[1] + 1.0) for h in s.boxes("house")]


def bay(s: Sheet) -> Sequence[Box]:
    return [(x1 - 4.0, y0 - 1.0, x1 - 1.2, y0 + 1.0) for x0, y0, x1, _ in s.boxes("house")]


def door(s: Sheet) -> Sequence[Box]:
    x0, y0, _, y1 = s.edges
    return [(x0 + 1.0, y0, x0 + 2.1, y0 + 2.2)] if s.width > 6 and y1 - y0 > 5 else []


def ground_windows(s: Sheet) -> Sequence[Box]:
    _, y0, x1, _ = s.edges
    return [(d[2] + 0.8, y0 + 0.9, x1 - 0.9, y0 + 2.3) for d in s.boxes("door")]


def upper_windows(s: Sheet) -> Sequence[Box]:
    x0, _, x1, y1 = s.edges
    return [(x0 + 0.9, y1 - 2.0, x1 - 0.9, y1 - 0.6)] if s.width > 5 and s.height > 5 else []


def garage_door(s: Sheet) -> Sequence[Box]:
    x0, y0, x1, y1 = s.edges
    return [(x0 + 0.3, y0, x1 - 0.3, y1 - 0.4)]


def bay_window(s: Sheet) -> Sequence[Box]:
    x0, y0, x1, y1 = s.edges
    return [(x0 + 0.4, y0 + 0.7, x1 - 0.4, y1 - 0.6)]


def terrace_door(s: Sheet) -> Sequence[Box]:
    x0, y0, _, y1 = s.edges
    return [(x0 + 1.2, y0, x0 + 3.8, y0 + 2.2)] if s.width > 7 and y1 - y0 > 5 else []


def balcony_door(s: Sheet) -> Sequence[Box]:
    return [(x0 + 0.5, y0 + FLOOR, x1 - 0.5, y0 + FLOOR + 2.1) for x0, y0, x1, _ in s.boxes("terrace door")]


def garden_windows(s: Sheet) -> Sequence[Box]:
    """Beside the doors, a row to each storey."""
    _, y0, x1, y1 = s.edges
    return [(d[2] + 1.2, y0 + 0.85, x1 - 0.9, y1 - 0.55) for d in s.boxes("terrace door")]


def balcony(s: Sheet) -> Sequence[Box]:
    """With its parapet."""
    return [(x0 - 0.4, y0 + FLOOR - 0.2, x1 + 0.4, y0 + FLOOR + 0.9) for x0, y0, x1, _ in s.boxes("terrace door")]


def hollow(s: Sheet) -> Sequence[Box]:
    """What the parapet surrounds, a little into the wall, so that nothing is left before the door."""
    x0, y0, x1, y1 = s.edges
    return [(x0 + 0.12, y0 - 0.01, x1 - 0.12, y1 - 0.12)]


def hedges(s: Sheet) -> Sequence[Box]:
    x0, _, x1, y1 = s.edges
    return [(x0 + 0.2, y1 - 0.9, x1 - 0.2, y1 - 0.2)]


def path(s: Sheet) -> Sequence[Box]:
    _, y0, _, _ = s.edges
    return [(h[0] + 0.9, y0, h[0] + 2.2, h[1]) for h in s.boxes("house")]


def record(r: Recorder) -> None:
    """Record the operations on the plots of the recorder's scene."""
    r.place("house", PLOT, body, 4, max_per={PLOT: 1})
    r.place("drive", PLOT, drive, 4, max_per={PLOT: 1})
    r.extrude("house", 5.8, roof=Roof("hip", PITCH, overhang=0.45), side="wall")
    with_garage, with_bay = r.select(PLOT, (1.0, 1.0))
    r.at = (with_garage,)
    r.place("garage", PLOT, garage, 4, max_per={PLOT: 1})
    r.extrude("garage", 2.7, side="garage wall", top="garage terrace")
    garages = r.at
    r.at = (with_bay,)
    r.place("bay", PLOT, bay, 4, max_per={PLOT: 1})
    r.extrude("bay", 2.9, side="bay wall", top="bay terrace")
    r.at = (*garages, *r.at)
    r.merge("house", "siblings")
    # Only now, or the house would be merged with it.
    r.extrude("drive", PAVED)

    r.place("door", STREET, door, 4, max_per={STREET: 1})
    r.recess("door", 0.3, "front door")
    r.place("canopy", STREET, over("door", 0.35, 0.1, 0.25), 4, max_per={STREET: 1})
    r.attach("canopy", 1.0)
    windows(r, "window", STREET, ground_windows, (1.2, 1.4), (0.9, 1.0))
    windows(r, "bedroom window", STREET, upper_windows, (1.2, 1.4), (1.0, 1.0))
    bars(r, "bedroom window")
    front = "street garage wall"
    r.place("garage door", front, garage_door, 3, max_per={front: 1})
    r.recess("garage door", 0.2, "garage gate")
    front = "street bay wall"
    r.place("bay window", front, bay_window, 3, max_per={front: 1})
    r.recess("bay window", 0.15, "bay glass")

    windows(r, "side window", SIDE, upper_windows, (1.0, 1.4), (2.2, 1.0))
    r.place("terrace door", GARDEN, terrace_door, 4, max_per={GARDEN: 1})
    r.recess("terrace door", 0.2, "terrace glass")
    mullion(r, "terrace glass", "terrace upright")
    r.place("balcony door", GARDEN, balcony_door, 4, max_per={GARDEN: 1})
    r.recess("balcony door", 0.2, "balcony glass")
    windows(r, "garden window", GARDEN, garden_windows, (1.2, 1.4), (1.0, 1.2))
    r.place("balcony", GARDEN, balcony, 4, max_per={GARDEN: 1})
    r.attach("balcony", 1.3, top="balcony front")
    top = "upper balcony"
    r.place("hollow", top, hollow, 2, max_per={top: 1})
    r.recess("hollow", 0.9, "balcony floor", "balcony")

    r.place("hedge", PLOT, hedges, 4, max_per={PLOT: 1})
    r.extrude("hedge", 1.2, (0.8, 1.3))
    r.place("path", PLOT, path, 4, max_per={PLOT: 1})
    r.extrude("path", PAVED)
