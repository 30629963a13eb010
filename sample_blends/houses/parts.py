"""What all three types of houses have: doors, windows, sills, shutters, drawn as a user draws them."""

from __future__ import annotations

from collections.abc import Sequence

from .recorder import Box, Draw, Recorder, Sheet

STREET, SIDE, GARDEN = "street wall", "side wall", "garden wall"


def under(label: str, out: float, low: float, high: float) -> Draw:
    """A box under every element of a label: so much wider on either side, from and to so much below its lower edge."""
    return lambda s: [(x0 - out, y0 - low, x1 + out, y0 - high) for x0, y0, x1, _ in s.boxes(label)]


def over(label: str, out: float, low: float, high: float) -> Draw:
    """A box over every element of a label."""
    return lambda s: [(x0 - out, y1 + low, x1 + out, y1 + high) for x0, _, x1, y1 in s.boxes(label)]


def left_of(label: str, gap: float, width: float) -> Draw:
    """A box to the left of every element of a label, as high as it is."""
    return lambda s: [(x0 - gap - width, y0, x0 - gap, y1) for x0, y0, _, y1 in s.boxes(label)]


def right_of(label: str, gap: float, width: float) -> Draw:
    """A box to the right of every element of a label, as high as it is."""
    return lambda s: [(x1 + gap, y0, x1 + gap + width, y1) for _, y0, x1, y1 in s.boxes(label)]


def shutters(r: Recorder, window: str, on: str) -> None:
    """Shutters on half of the windows: a selection and six operations."""
    plain, shuttered = r.select(window, (1.0, 1.0))
    r.at = (shuttered,)
    r.place("left shutter", on, left_of(window, 0.04, 0.3), 4, forbid_intersections=True)
    r.place("right shutter", on, right_of(window, 0.04, 0.3), 4, forbid_intersections=True)
    r.attach("left shutter", 0.05)
    r.attach("right shutter", 0.05)
    r.at = (plain, *r.at)


def bars(r: Recorder, glass: str) -> None:
    """An upright and a level bar on panes: six operations."""
    upright, level = cross(0.06)
    r.place(f"{glass} upright", glass, upright, 3, max_per={glass: 1})
    r.place(f"{glass} level", glass, level, 3, max_per={glass: 1})
    r.attach(f"{glass} upright", 0.04)
    r.attach(f"{glass} level", 0.05)


def cross(thickness: float) -> tuple[Draw, Draw]:
    """The upright and the level bar of a window."""
    half = thickness / 2

    def upright(s: Sheet) -> Sequence[Box]:
        x0, y0, x1, y1 = s.edges
        return [((x0 + x1) / 2 - half, y0, (x0 + x1) / 2 + half, y1)]

    def level(s: Sheet) -> Sequence[Box]:
        x0, y0, x1, y1 = s.edges
        return [(x0, y0 + 0.65 * (y1 - y0) - half, x1, y0 + 0.65 * (y1 - y0) + half)]

    return upright, level


def windows(
    r: Recorder,
    label: str,
    on: str,
    draw: Draw,
    size: tuple[float, float],
    gap: tuple[float, float],
    depth: float = 0.15,
) -> None:
    """A field of windows, pushed in, with sills: six operations."""
    r.place(label, on, draw, 5, size=size, gap=gap, fit=("repeat", "repeat"), max_per={on: 1})
    r.recess(label, depth, f"{label} glass")
    r.place(f"{label} sill", on, under(label, 0.08, 0.1, 0.0), 5)
    r.attach(f"{label} sill", 0.1)
