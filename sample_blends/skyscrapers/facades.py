"""Facades: those of the base, of the shafts, and of the crown, drawn as a user draws them."""

from __future__ import annotations

from collections.abc import Sequence

from ..houses.parts import along_bottom, level_bar, over, upright_bar
from ..houses.recorder import Box, Draw, Recorder, Sheet
from .lots import LOT
from .mass import NOTCH

STREET, SIDE, REAR = "street base wall", "side base wall", "rear base wall"
SHAFT, WINGED, CROWN = "middle wall", "winged wall", "top wall"

#: Height of a shop and of a storey.
SHOP, STOREY = 4.6, 3.4


def band(low: float, high: float, from_top: bool = True, out: float = 0.0) -> Draw:
    """A band across all of a wall between two heights, from its upper or its lower edge on."""

    def draw(s: Sheet) -> Sequence[Box]:
        x0, y0, x1, y1 = s.edges
        return [(x0 - out, y1 - high, x1 + out, y1 - low)] if from_top else [(x0 - out, y0 + low, x1 + out, y0 + high)]

    return draw


def field(left: float, low: float, right: float, high: float, least: float = 4.0) -> Draw:
    """All of a wall but margins; none where it is narrow."""

    def draw(s: Sheet) -> Sequence[Box]:
        x0, y0, x1, y1 = s.edges
        return [(x0 + left, y0 + low, x1 - right, y1 - high)] if x1 - x0 > least else []

    return draw


def row(margin: float, low: float, high: float, least: float = 6.0) -> Draw:
    """Along a wall between two heights above its lower edge."""

    def draw(s: Sheet) -> Sequence[Box]:
        x0, y0, x1, _ = s.edges
        return [(x0 + margin, y0 + low, x1 - margin, y0 + high)] if x1 - x0 > least else []

    return draw


def middle(width: float, height: float, low: float = 0.0) -> Draw:
    """In the middle of a wall, so far above its lower edge."""

    def draw(s: Sheet) -> Sequence[Box]:
        x0, y0, x1, _ = s.edges
        x = (x0 + x1) / 2
        return [(x - width / 2, y0 + low, x + width / 2, y0 + low + height)]

    return draw


def beside(label: str, margin: float, gap: float, low: float, high: float, right: bool) -> Draw:
    """From what has a label to a margin before the end of the wall, between two heights."""

    def draw(s: Sheet) -> Sequence[Box]:
        x0, y0, x1, _ = s.edges
        ends = [(b[2] + gap, x1 - margin) if right else (x0 + margin, b[0] - gap) for b in s.boxes(label)]
        return [(a, y0 + low, b, y0 + high) for a, b in ends if b - a > 2.0]

    return draw


def at_end(width: float, right: bool) -> Draw:
    """Up one end of a wall."""

    def draw(s: Sheet) -> Sequence[Box]:
        x0, y0, x1, y1 = s.edges
        return [(x1 - width, y0, x1, y1) if right else (x0, y0, x0 + width, y1)]

    return draw


def openings(
    r: Recorder, label: str, on: str, draw: Draw, size: tuple[float, float], gap: tuple[float, float], depth: float
) -> None:
    """A field of openings, pushed in: three operations."""
    r.place(
        label, on, draw, 4, size=size, gap=gap, fit=("repeat", "repeat"), max_per={on: 1}, forbid_intersections=True
    )
    r.recess(label, depth, f"{label} glass")


def base(r: Recorder) -> None:
    """Entrance, shops, a mezzanine, pilasters and cornices."""
    r.place("entrance", STREET, middle(4.4, 5.4), 4, max_per={STREET: 1})
    r.recess("entrance", 1.2, "entrance glass")
    r.place("portal", STREET, over("entrance", 0.8, 0.0, 1.6), 4, max_per={STREET: 1})
    r.attach("portal", 0.5, top="portal front")
    r.place("canopy", "portal front", band(1.0, 1.35), 3, max_per={"portal front": 1})
    r.extrude("canopy", 2.2)
    r.place(
        "door post",
        "entrance glass",
        middle(3.2, 2.6),
        3,
        size=(0.12, 2.6),
        gap=(0.9, 0.0),
        fit=("repeat", "scale"),
        max_per={"entrance glass": 1},
    )
    r.extrude("door post", 0.1)
    r.place("transom", "entrance glass", band(2.6, 2.8, from_top=False), 3, max_per={"entrance glass": 1})
    r.extrude("transom", 0.14)
    for side, right in (("left", False), ("right", True)):
        label = f"{side} shop"
        r.place(
            label,
            STREET,
            beside("entrance", 1.4, 1.4, 0.7, SHOP, right),
            4,
            size=(3.2, SHOP - 0.7),
            gap=(0.9, 0.0),
            fit=("divide", "scale"),
            max_per={STREET: 1},
        )
        r.recess(label, 0.4, "shop glass")
    for wall in (SIDE, REAR):
        label = f"{wall.split()[0]} shop"
        r.place(
            label,
            wall,
            row(1.6, 0.7, SHOP),
            4,
            size=(3.2, SHOP - 0.7),
            gap=(0.9, 0.0),
            fit=("divide", "scale"),
            max_per={wall: 1},
        )
        r.recess(label, 0.4, "shop glass")
    r.place("shop bar", "shop glass", band(0.9, 1.02), 3, max_per={"shop glass": 1})
    r.extrude("shop bar", 0.1)
    r.place("shop post", "shop glass", upright_bar(0.1), 3, max_per={"shop glass": 1})
    r.extrude("shop post", 0.08)
    r.place("awning", "shop glass", band(0.0, 0.5), 3, max_per={"shop glass": 1})
    striped, _ = r.select("awning", (1.0, 1.0))
    bare = _
    r.at = (striped,)
    r.extrude("awning", 1.5)
    r.at = (*r.at, bare)
    for wall in (STREET, SIDE, REAR):
        name = wall.split()[0]
        r.place(
            f"{name} plinth",
            wall,
            row(0.0, 0.0, 0.5) if wall != STREET else band(SHOP + 1.3, SHOP + 1.7, False),
            3,
            max_per={wall: 1},
        )
        r.extrude(f"{name} plinth", 0.15)
        openings(r, f"{name} mezzanine", wall, field(1.6, 7.6, 1.6, 2.6), (1.5, 2.2), (1.1, 1.2), 0.3)
        r.place(f"{name} cornice", wall, band(0.2, 1.0), 4, max_per={wall: 1})
        r.extrude(f"{name} cornice", 0.7)


def shaft(r: Recorder) -> None:
    """Two styles by chance: slots with spandrels between piers, or windows with sills and bars."""
    for wall, out in ((SHAFT, 0.0), (WINGED, -NOTCH - 0.1)):
        r.place("belt", wall, band(0.0, 0.7, from_top=False), 4, max_per={wall: 1})
        r.place("parapet band", wall, band(0.0, 1.2, out=out), 4, max_per={wall: 1})
    r.place("frieze", SHAFT, band(2.0, 2.5), 4, max_per={SHAFT: 1})
    r.extrude("belt", 0.35)
    r.extrude("parapet band", 0.3)
    r.extrude("frieze", 0.2)
    openings(r, "window", WINGED, field(1.6, 2.4, 1.6, 3.8), (1.3, 1.9), (1.2, 1.5), 0.25)
    slotted, windowed = r.select(LOT, (1.0, 1.0), 3)
    r.at = (slotted,)
    r.place(
        "slot",
        SHAFT,
        field(1.2, 2.0, 1.2, 3.6),
        5,
        size=(1.5, 1.0),
        gap=(1.0, 0.0),
        fit=("repeat", "scale"),
        max_per={SHAFT: 1},
    )
    r.recess("slot", 0.4, "slot glass")
    r.place(
        "spandrel",
        "slot glass",
        field(0.0, 2.1, 0.0, 0.2, 0.5),
        3,
        size=(1.5, 1.2),
        gap=(0.0, STOREY - 1.2),
        fit=("scale", "repeat"),
        max_per={"slot glass": 1},
    )
    r.extrude("spandrel", 0.18)
    r.place("slot mullion", "slot glass", upright_bar(0.1), 3, max_per={"slot glass": 1})
    r.extrude("slot mullion", 0.1)
    r.place("slot head", "slot glass", band(0.0, 0.5), 3, max_per={"slot glass": 1})
    r.extrude("slot head", 0.5)
    ends = r.at
    r.at = (windowed,)
    r.place("left quoin", SHAFT, at_end(0.9, False), 4, max_per={SHAFT: 1})
    r.extrude("left quoin", 0.18)
    r.place("right quoin", SHAFT, at_end(0.9, True), 4, max_per={SHAFT: 1})
    r.extrude("right quoin", 0.18)
    openings(r, "window", SHAFT, field(1.6, 2.4, 1.6, 3.8), (1.3, 1.9), (1.2, 1.5), 0.25)
    r.at = (*ends, *r.at)
    r.place("sill", "window glass", along_bottom(0.14), 2, max_per={"window glass": 1})
    r.extrude("sill", 0.4)
    r.place("sash", "window glass", level_bar(0.08), 2, max_per={"window glass": 1})
    r.extrude("sash", 0.06)


def crown(r: Recorder) -> None:
    """Tall windows, a cornice, pilasters, and lucarnes on roofs."""
    r.place("top cornice", CROWN, band(0.0, 0.6), 4, max_per={CROWN: 1})
    r.extrude("top cornice", 0.4)
    r.place("top belt", CROWN, band(0.0, 0.4, from_top=False), 4, max_per={CROWN: 1})
    r.extrude("top belt", 0.25)
    r.place(
        "light",
        CROWN,
        field(0.9, 1.0, 0.9, 1.4, 3.0),
        5,
        size=(1.1, 1.0),
        gap=(0.9, 0.0),
        fit=("repeat", "scale"),
        max_per={CROWN: 1},
    )
    r.recess("light", 0.3, "light glass")
    r.place(
        "light bar",
        "light glass",
        field(0.0, 1.2, 0.0, 0.3, 0.5),
        3,
        size=(1.1, 0.16),
        gap=(0.0, 1.9),
        fit=("scale", "repeat"),
        max_per={"light glass": 1},
    )
    r.extrude("light bar", 0.12)
    r.place("light post", "light glass", upright_bar(0.08), 3, max_per={"light glass": 1})
    r.extrude("light post", 0.1)
    r.place("keystone", "light glass", band(0.0, 0.35), 3, max_per={"light glass": 1})
    r.extrude("keystone", 0.4)
    r.place("bulkhead door", "bulkhead wall", middle(0.9, 2.0), 3, max_per={"bulkhead wall": 1})
    r.recess("bulkhead door", 0.15, "bulkhead leaf")
    r.place("tank brace", "tank stand", level_bar(0.25), 3, max_per={"tank stand": 1})
    r.extrude("tank brace", 0.1)
