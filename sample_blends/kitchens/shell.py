"""The room: its windows and its door, and what hangs on its walls."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ..houses.parts import level_bar, upright_bar
from ..houses.recorder import Box, Draw, Sheet
from .drawn import Along, KitchenRecorder, filling, free

BACK, DOOR = "back wall", "door wall"

#: Lower and upper edge of wall cabinets, and their depth.
LOW, HIGH, SHALLOW = 1.42, 2.12, 0.33

#: How deep windows lie in walls, and how far sills stand out of these.
REVEAL, SILL = 0.09, 0.04


def window_over(run: str, ends: Callable[[float, float], tuple[float, float]]) -> Draw:
    """Over a run of cabinets, its ends by those of that."""

    def draw(s: Sheet) -> Sequence[Box]:
        _, y0, _, _ = s.edges
        found = []
        for x0, _, x1, _ in s.boxes(run):
            left, right = ends(x0, x1)
            found.append((left, y0 + 1.15, right, y0 + HIGH))
        return found

    return draw


def window_in(s: Sheet) -> Sequence[Box]:
    """In the middle of what is free of a wall."""
    _, y0, _, _ = s.edges
    start, end = free(s, 1.5)
    middle, half = (start + end) / 2, 0.2 * (end - start)
    return [(middle - half, y0 + 0.95, middle + half, y0 + 2.12)]


def below_window(s: Sheet) -> Sequence[Box]:
    _, y0, _, _ = s.edges
    return [(x0 + 0.08, y0 + 0.14, x1 - 0.08, y0 + 0.7) for x0, _, x1, _ in s.boxes("side window")]


def sill(s: Sheet) -> Sequence[Box]:
    x0, y0, x1, _ = s.edges
    return [(x0, y0, x1, y0 + 0.04)]


def door(s: Sheet) -> Sequence[Box]:
    x0, y0, _, _ = s.edges
    return [(x0 + 0.4, y0, x0 + 1.28, y0 + 2.04)]


def over_splash(run: str, high: float) -> Draw:
    """From the worktop upwards, along a run."""
    return lambda s: [(x0, y1 + 0.04, x1, high) for x0, _, x1, y1 in s.boxes(run)]


def between(run: str, labels: Sequence[str], number: int, least: float = 0.35) -> Draw:
    """What windows and hoods leave free over a run: one of the parts, counted from the left."""

    def draw(s: Sheet) -> Sequence[Box]:
        _, y0, _, _ = s.edges
        taken = sorted((*box, 0.1 if label == "window" else 0.02) for label in labels for box in s.boxes(label))
        found = []
        for x0, _, x1, _ in s.boxes(run):
            ends = [x0, *(x for a, _, b, _, out in taken for x in (a - out, b + out)), x1]
            a, b = ends[2 * number : 2 * number + 2]
            found += [(a, y0 + LOW, b, y0 + HIGH)] if b - a > least else []
        return found

    return draw


def hood_over(run: str, place: Along) -> Draw:
    """From over the hob to the rim, its middle somewhere along a run."""

    def draw(s: Sheet) -> Sequence[Box]:
        _, _, _, top = s.edges
        middles = [place(x0, x1) for x0, _, x1, _ in s.boxes(run)]
        return [(x - 0.3, 1.5, x + 0.3, top) for x in middles]

    return draw


def leaf_part(low: float, high: float) -> Draw:
    """On a door leaf, between two shares of its height, clear of its edges."""

    def draw(s: Sheet) -> Sequence[Box]:
        x0, y0, x1, y1 = s.edges
        return [(x0 + 0.12, y0 + low * (y1 - y0), x1 - 0.2, y0 + high * (y1 - y0))]

    return draw


def casing(left: float, low: float, right: float, high: float) -> Draw:
    """Beside or over the door: offsets from its left edge, its foot, its right edge and its head; where it is wide."""

    def draw(s: Sheet) -> Sequence[Box]:
        return [
            (x0 + left if left <= 0 else x1, y1 if low else y0, x1 + right if right >= 0 else x0, y1 + high)
            for x0, y0, x1, y1 in s.boxes("door")
        ]

    return draw


def switch(s: Sheet) -> Sequence[Box]:
    return [(x1 + 0.2, y0 + 1.06, x1 + 0.28, y0 + 1.14) for _, y0, x1, _ in s.boxes("door")]


def handle(s: Sheet) -> Sequence[Box]:
    _, y0, x1, _ = s.edges
    return [(x1 - 0.16, y0 + 0.92, x1 - 0.02, y0 + 1.12)]


def clock(s: Sheet) -> Sequence[Box]:
    """Between the door and the far end of its wall, where there is room."""
    _, y0, x1, _ = s.edges
    middles = [(b[2] + x1) / 2 for b in s.boxes("door") if x1 - b[2] > 1.0]
    return [(m - 0.15, y0 + 1.75, m + 0.15, y0 + 2.05) for m in middles]


def openings(r: KitchenRecorder, over: Draw, free_wall: str) -> None:
    """Where the windows are: over the run, and in the wall that stays free."""
    r.place("window", BACK, over, 4, max_per={BACK: 1})
    r.place("side window", free_wall, window_in, 4, max_per={free_wall: 1})
    r.fit("radiator", free_wall, below_window)


def windows(r: KitchenRecorder) -> None:
    """Push the windows in; sills, and bars in some of them."""
    for label in ("window", "side window"):
        glass = f"{label} glass"
        r.recess(label, REVEAL, glass)
        r.place(f"{label} sill", glass, sill, 2, max_per={glass: 1})
        r.attach(f"{label} sill", REVEAL + SILL)
    plain, barred = r.select("window glass", (1.0, 1.0))
    r.at = (barred,)
    r.place("upright", "window glass", upright_bar(0.05), 2, max_per={"window glass": 1})
    r.place("crossbar", "window glass", level_bar(0.04), 2, max_per={"window glass": 1})
    r.extrude("upright", 0.03)
    r.extrude("crossbar", 0.035)
    r.at = (plain, *r.at)
    r.place("side upright", "side window glass", upright_bar(0.05), 2, max_per={"side window glass": 1})
    r.extrude("side upright", 0.03)


def hanging(
    r: KitchenRecorder,
    wall: str,
    run: str,
    hood: tuple[str, Along] | None,
    beside: Sequence[str],
    numbers: Sequence[int],
) -> None:
    """Tiles over a worktop, a hood where there is a hob, and cabinets beside the hood and the window."""
    if hood:
        name, place = hood
        r.fit(name, wall, hood_over(run, place))
    for number in numbers:
        r.place("wall cabinet", wall, between(run, beside, number), 4, max_per={wall: 1}, forbid_intersections=True)
    r.place("splash", wall, over_splash(run, 1.15 if "window" in beside else LOW), 4, max_per={wall: 1})


def cabinets(r: KitchenRecorder) -> None:
    """Pull the wall cabinets and the tiles out; doors of wood or of glass, by chance."""
    r.extrude("splash", 0.012)
    r.attach("wall cabinet", SHALLOW, top="cabinet front", side="wall cabinet")
    solid, glazed = r.select("cabinet front", (2.0, 1.0))
    ends = []
    for link, name in ((solid, "wall door"), (glazed, "glass door")):
        r.at = (link,)
        r.fit(name, "cabinet front", filling(), 3, fit=("divide", "scale"))
        ends += r.at
    r.at = tuple(ends)


def entrance(r: KitchenRecorder) -> None:
    """The door, panelled or glazed by chance, with casing, handle and switch; a clock where there is room."""
    r.place("door", DOOR, door, 4, max_per={DOOR: 1})
    for label, offsets in (
        ("left casing", (-0.08, 0.0, -1.0, 0.0)),
        ("right casing", (1.0, 0.0, 0.08, 0.0)),
        ("door head", (-0.08, 1.0, 0.08, 0.08)),
    ):
        r.place(label, DOOR, casing(*offsets), 3, max_per={DOOR: 1})
        r.extrude(label, 0.02, side="casing", top="casing")
    r.recess("door", 0.06, "door leaf", "casing")
    r.fit("light switch", DOOR, switch, 3)
    r.fit("clock", DOOR, clock, 4, forbid_intersections=True)
    panelled, glazed = r.select("door leaf", (1.0, 1.0))
    r.at = (panelled,)
    r.place("lower panel", "door leaf", leaf_part(0.08, 0.42), 3, max_per={"door leaf": 1})
    r.place("upper panel", "door leaf", leaf_part(0.5, 0.93), 3, max_per={"door leaf": 1})
    r.recess("lower panel", 0.015, "panelling", "panelling")
    r.recess("upper panel", 0.015, "panelling", "panelling")
    ends = r.at
    r.at = (glazed,)
    r.place("door light", "door leaf", leaf_part(0.42, 0.93), 3, max_per={"door leaf": 1})
    r.recess("door light", 0.02, "door glass", "panelling")
    r.at = (*ends, *r.at)
    r.fit("door handle", "door leaf", handle, 3)
