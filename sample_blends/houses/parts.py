"""What all three types of houses have: windows with sills, bars and shutters, drawn as a user draws them.

What is repeated many times is built up inside its own surface: a window is pushed in, and its sill and bars are then
placed on the pane. Equal panes are one lesson and one computation, however many there are.
"""

from __future__ import annotations

from collections.abc import Sequence

from .recorder import Box, Draw, Recorder, Sheet

STREET, SIDE, GARDEN = "street wall", "side wall", "garden wall"

#: How deep windows lie in walls, and how far sills stand out of them.
REVEAL, SILL = 0.15, 0.1

#: How high walks and drives lie above the lawn.
PAVED = 0.02


def over(label: str, out: float, low: float, high: float) -> Draw:
    """A box over every element of a label: so much wider on either side, from and to so much above it."""
    return lambda s: [(x0 - out, y1 + low, x1 + out, y1 + high) for x0, _, x1, y1 in s.boxes(label)]


def along_bottom(height: float) -> Draw:
    """A box along the lower edge."""

    def draw(s: Sheet) -> Sequence[Box]:
        x0, y0, x1, _ = s.edges
        return [(x0, y0, x1, y0 + height)]

    return draw


def upright_bar(thickness: float) -> Draw:
    """A bar up the middle."""

    def draw(s: Sheet) -> Sequence[Box]:
        x0, y0, x1, y1 = s.edges
        return [((x0 + x1 - thickness) / 2, y0, (x0 + x1 + thickness) / 2, y1)]

    return draw


def level_bar(thickness: float) -> Draw:
    """A bar across, at two thirds of the height."""

    def draw(s: Sheet) -> Sequence[Box]:
        x0, y0, x1, y1 = s.edges
        middle = y0 + 0.66 * (y1 - y0)
        return [(x0, middle - thickness / 2, x1, middle + thickness / 2)]

    return draw


def windows(r: Recorder, label: str, on: str, draw: Draw, size: tuple[float, float], gap: tuple[float, float]) -> None:
    """A field of windows, pushed in, with sills: six operations."""
    r.place(
        label, on, draw, 4, size=size, gap=gap, fit=("repeat", "repeat"), max_per={on: 1}, forbid_intersections=True
    )
    r.recess(label, REVEAL, f"{label} glass")
    pane(r, label)


def pane(r: Recorder, label: str, depth: float = REVEAL) -> None:
    """The sill of every window, on its pane: three operations."""
    r.place(f"{label} sill", f"{label} glass", along_bottom(0.08), 2, max_per={f"{label} glass": 1})
    r.attach(f"{label} sill", depth + SILL)


def bars(r: Recorder, label: str) -> None:
    """An upright and a level bar on every pane: six operations."""
    glass = f"{label} glass"
    r.place(f"{label} upright", glass, upright_bar(0.06), 2, max_per={glass: 1})
    r.place(f"{label} crossbar", glass, level_bar(0.06), 2, max_per={glass: 1})
    r.attach(f"{label} upright", 0.04)
    r.attach(f"{label} crossbar", 0.05)


def mullion(r: Recorder, glass: str, label: str) -> None:
    """An upright bar on every pane of a label: three operations."""
    r.place(label, glass, upright_bar(0.1), 2, max_per={glass: 1})
    r.attach(label, 0.06)
