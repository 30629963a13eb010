"""The one-storey house: low, under a gable roof, with a wing behind it or without, and a shed in the garden."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from geoanalogy.geometry.roof import Roof

from .parts import GARDEN, PAVED, SIDE, STREET, bars, mullion, over, pane, windows
from .recorder import Box, Recorder, Sheet

PLOT = "one-storey"
PITCH = float(np.radians(28.0))


def body(s: Sheet) -> Sequence[Box]:
    x0, y0, x1, _ = s.edges
    return [(x0 + 3, y0 + 6, x1 - 3, y0 + 14)]


def wing(s: Sheet) -> Sequence[Box]:
    """Deeper than wide, so that its gable looks into the garden, and so far inside that the other one is hidden."""
    return [(x0, y1 - 2.6, x0 + 4.8, y1 + 4) for x0, _, _, y1 in s.boxes("house")]


def wing_windows(s: Sheet) -> Sequence[Box]:
    x0, y0, x1, _ = s.edges
    return [(x0 + 0.9, y0 + 0.9, x1 - 0.9, y0 + 2.2)]


def door(s: Sheet) -> Sequence[Box]:
    x0, y0, _, _ = s.edges
    return [(x0 + 1.2, y0, x0 + 2.3, y0 + 2.1)] if s.width > 7 else []


def street_panels(s: Sheet) -> Sequence[Box]:
    _, y0, x1, _ = s.edges
    return [(d[2] + 0.7, y0 + 0.8, x1 - 0.6, y0 + 2.3) for d in s.boxes("door")]


def window(s: Sheet) -> Sequence[Box]:
    x0, y0, x1, y1 = s.edges
    return [(x0 + 0.4, y0 + 0.1, x1 - 0.4, y1 - 0.1)]


def left_shutter(s: Sheet) -> Sequence[Box]:
    return [(x0 - 0.34, y0, x0 - 0.02, y1) for x0, y0, _, y1 in s.boxes("window")]


def right_shutter(s: Sheet) -> Sequence[Box]:
    return [(x1 + 0.02, y0, x1 + 0.34, y1) for _, y0, x1, y1 in s.boxes("window")]


def side_windows(s: Sheet) -> Sequence[Box]:
    x0, y0, x1, _ = s.edges
    return [(x0 + 1.2, y0 + 0.9, x1 - 1.2, y0 + 2.2)] if s.width > 6 else []


def terrace_door(s: Sheet) -> Sequence[Box]:
    _, y0, x1, _ = s.edges
    return [(x1 - 3.4, y0, x1 - 1.0, y0 + 2.2)] if s.width > 5 else []


def garden_windows(s: Sheet) -> Sequence[Box]:
    x0, y0, _, _ = s.edges
    return [(x0 + 0.9, y0 + 0.9, d[0] - 0.9, y0 + 2.2) for d in s.boxes("terrace door") if d[0] - x0 > 3.5]


def skylight(s: Sheet) -> Sequence[Box]:
    """In the middle between eaves and ridge, so that it keeps clear of both on lower roofs."""
    x0, y0, x1, y1 = s.edges
    x, y = (x0 + x1) / 2, (y0 + y1) / 2
    return [(x - 0.5, y - 0.6, x + 0.5, y + 0.6)] if y1 - y0 > 4 else []


def gable_window(s: Sheet) -> Sequence[Box]:
    x0, y0, x1, _ = s.edges
    return [((x0 + x1) / 2 - 0.35, y0 + 0.3, (x0 + x1) / 2 + 0.35, y0 + 1.0)] if s.width > 7 else []


def shed(s: Sheet) -> Sequence[Box]:
    _, _, x1, y1 = s.edges
    return [(x1 - 4.5, y1 - 3.5, x1 - 1.0, y1 - 1.0)]


def shed_door(s: Sheet) -> Sequence[Box]:
    x0, y0, x1, _ = s.edges
    return [((x0 + x1) / 2 - 0.5, y0, (x0 + x1) / 2 + 0.5, y0 + 1.9)]


def left_hedge(s: Sheet) -> Sequence[Box]:
    x0, y0, _, y1 = s.edges
    return [(x0 + 0.2, y0 + 1, x0 + 0.9, y1 - 0.2)]


def right_hedge(s: Sheet) -> Sequence[Box]:
    _, y0, x1, y1 = s.edges
    return [(x1 - 0.9, y0 + 1, x1 - 0.2, y1 - 0.2)]


def path(s: Sheet) -> Sequence[Box]:
    _, y0, _, _ = s.edges
    return [(h[0] + 1.1, y0, h[0] + 2.4, h[1]) for h in s.boxes("house")]


def record(r: Recorder) -> None:
    """Record the operations on the plots of the recorder's scene."""
    r.place("house", PLOT, body, 4, max_per={PLOT: 1})
    without, winged = r.select(PLOT, (1.0, 1.0))
    r.at = (winged,)
    r.place("wing", PLOT, wing, 4, max_per={PLOT: 1})
    r.extrude("wing", 2.9, roof=Roof("gable", PITCH), side="wing wall", gable="wing gable")
    r.at = (without, *r.at)
    r.extrude("house", 2.9, roof=Roof("gable", PITCH), side="wall")
    r.merge("house", "siblings")

    r.place("skylight", "roof", skylight, 4, max_per={"roof": 1})
    r.attach("skylight", 0.06, top="skylight glass")
    r.place("gable window", "gable", gable_window, 4, max_per={"gable": 1})
    r.recess("gable window", 0.15, "gable glass")

    r.place("door", STREET, door, 4, max_per={STREET: 1})
    r.recess("door", 0.25, "front door")
    r.place("canopy", STREET, over("door", 0.3, 0.12, 0.24), 4, max_per={STREET: 1})
    r.attach("canopy", 0.9)
    # Panels, half of them with shutters, hold the windows of the front.
    r.place(
        "panel",
        STREET,
        street_panels,
        5,
        size=(2.1, 1.5),
        gap=(0.5, 1.0),
        fit=("repeat", "repeat"),
        max_per={STREET: 1},
    )
    r.recess("panel", 0.03, "panelling")
    r.place("window", "panelling", window, 2, max_per={"panelling": 1})
    plain, shuttered = r.select("panelling", (1.0, 1.0))
    r.at = (shuttered,)
    r.place("left shutter", "panelling", left_shutter, 2, max_per={"panelling": 1})
    r.place("right shutter", "panelling", right_shutter, 2, max_per={"panelling": 1})
    r.attach("left shutter", 0.06)
    r.attach("right shutter", 0.06)
    r.at = (plain, *r.at)
    r.recess("window", 0.12, "window glass")
    pane(r, "window")
    bars(r, "window")

    windows(r, "side window", SIDE, side_windows, (1.1, 1.3), (1.6, 1.0))
    r.place("terrace door", GARDEN, terrace_door, 4, max_per={GARDEN: 1})
    r.recess("terrace door", 0.2, "terrace glass")
    mullion(r, "terrace glass", "terrace upright")
    windows(r, "garden window", GARDEN, garden_windows, (1.6, 1.3), (0.9, 1.0))
    windows(r, "wing window", "garden wing wall", wing_windows, (1.3, 1.3), (0.4, 1.0))

    r.place("shed", PLOT, shed, 4, max_per={PLOT: 1})
    r.extrude("shed", 2.1, roof=Roof("hip", PITCH))
    r.place("shed door", "street shed", shed_door, 3, max_per={"street shed": 1})
    r.recess("shed door", 0.08, "shed door")
    r.place("hedge", PLOT, left_hedge, 4, max_per={PLOT: 1})
    r.place("hedge", PLOT, right_hedge, 4, max_per={PLOT: 1})
    r.extrude("hedge", 1.1, (0.8, 1.3))
    r.place("path", PLOT, path, 4, max_per={PLOT: 1})
    r.extrude("path", PAVED)
