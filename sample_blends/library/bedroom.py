"""Bedroom furniture: beds, night table, wardrobe, chest of drawers, desk and its chair."""

from __future__ import annotations

import numpy as np

from ..plans.outlines import centred_rectangle, circle
from .assets import asset
from .solids import Solid, around, box, cushion, cylinder, extruded, joined, lathe, tube


def _bed(length: float, width: float, pillows: int, frame: str, duvet: str, throw: str) -> Solid:
    head = -length / 2
    parts = [
        box((0.06, width, 0.95), (head + 0.03, 0.0, 0.0), frame, 0.015),
        box((length - 0.06, width - 0.04, 0.2), (0.03, 0.0, 0.1), frame, 0.015),
        cushion((length - 0.1, width - 0.08, 0.22), (0.03, 0.0, 0.28), "mattress", 0.05),
        # The duvet hangs over the sides; its end is folded back below the pillows.
        cushion((length * 0.62, width - 0.02, 0.2), (length * 0.175, 0.0, 0.36), duvet, 0.07, puff=0.02),
        cushion((0.26, width - 0.01, 0.07), (-length * 0.1, 0.0, 0.545), "linen", 0.03),
        # The throw lies over the duvet's foot, puffed alike so that it stays above.
        cushion((0.45, width, 0.22), (length * 0.33, 0.0, 0.365), throw, 0.07, puff=0.04),
    ]
    breadth = (width - 0.14) / pillows
    for i in range(pillows):
        y = (i - (pillows - 1) / 2) * (breadth + 0.02)
        pillow = cushion((0.4, breadth - 0.04, 0.13), (0.0, 0.0, 0.0), "pillow", 0.06, puff=0.05).turned(-14, "y")
        parts.append(pillow.moved(head + 0.34, y, 0.53))
    for x in (head + 0.12, -head - 0.12):
        for y in (-width / 2 + 0.12, width / 2 - 0.12):
            parts.append(cylinder(0.035, 0.12, (x, y, 0.0), "black metal", sides=8))
    return joined(parts)


@asset("double bed", "furniture", centred_rectangle(2.1, 1.7), label="bed")
def double_bed() -> Solid:
    """Double bed; +X from the headboard to the foot."""
    return _bed(2.1, 1.7, 2, "walnut", "duvet", "throw")


@asset("single bed", "furniture", centred_rectangle(2.05, 0.98), label="bed")
def single_bed() -> Solid:
    """Single bed; +X from the headboard to the foot."""
    return _bed(2.05, 0.98, 1, "birch", "child duvet", "rust cloth")


def _drawers(
    depth: float, width: float, z0: float, z1: float, columns: int, rows: int, front: str, knob: str
) -> list[Solid]:
    """Drawer fronts with knobs on the front (+X) of a case of that depth."""
    parts = []
    breadth, height = width / columns, (z1 - z0) / rows
    for column in range(columns):
        y = (column - (columns - 1) / 2) * breadth
        for row in range(rows):
            z = z0 + row * height
            parts.append(box((0.022, breadth - 0.016, height - 0.014), (depth / 2, y, z + 0.007), front, 0.005))
            pull = cylinder(0.014, 0.025, (0.0, 0.0, 0.0), knob, sides=10).turned(90, "y")
            parts.append(pull.moved(depth / 2 + 0.01, y, z + height / 2))
    return parts


def _table_lamp(x: float, y: float, z: float) -> Solid:
    return joined(
        (
            lathe([(0.055, 0.0), (0.05, 0.015), (0.014, 0.03), (0.012, 0.2)], "brass", 16),
            lathe([(0.11, 0.18), (0.075, 0.34)], "lamp shade", 20),
        )
    ).moved(x, y, z)


@asset("night table", "furniture", centred_rectangle(0.42, 0.46))
def night_table() -> Solid:
    """Night table with a lamp and a book; +X is the drawers' side."""
    return joined(
        [
            box((0.38, 0.44, 0.38), (-0.015, 0.0, 0.12), "walnut", 0.008),
            box((0.41, 0.46, 0.025), (-0.005, 0.0, 0.5), "walnut", 0.008),
            *[cylinder(0.018, 0.12, (x, y, 0.0), "black metal", sides=8) for x in (-0.16, 0.14) for y in (-0.18, 0.18)],
            *(part.moved(-0.015) for part in _drawers(0.38, 0.43, 0.13, 0.49, 1, 2, "white lacquer", "brass")),
            _table_lamp(-0.06, 0.07, 0.525),
            box((0.13, 0.19, 0.03), (0.06, -0.1, 0.525), "book blue", 0.003),
            box((0.11, 0.16, 0.02), (0.06, -0.1, 0.555), "book red", 0.003).turned(8).moved(0.014, -0.01),
        ]
    )


@asset("wardrobe", "furniture", centred_rectangle(0.62, 1.8))
def wardrobe() -> Solid:
    """Wardrobe of three doors, the middle one a mirror; +X is the doors' side."""
    parts = [
        box((0.52, 1.76, 0.08), (-0.03, 0.0, 0.0), "dark lacquer", 0.0),
        box((0.58, 1.8, 2.0), (-0.02, 0.0, 0.08), "oak", 0.008),
        box((0.62, 1.8, 0.03), (0.0, 0.0, 2.08), "oak", 0.008),
    ]
    for i, finish in enumerate(("white lacquer", "mirror", "white lacquer")):
        y = (i - 1) * 0.595
        parts.append(box((0.022, 0.58, 1.9), (0.279, y, 0.13), "white lacquer", 0.006))
        if finish == "mirror":
            parts.append(box((0.006, 0.48, 1.74), (0.291, y, 0.21), "mirror", 0.0))
        side = 0.24 if i < 2 else -0.24
        parts.append(box((0.018, 0.016, 0.3), (0.298, y + side, 0.95), "brass", 0.004))
    return joined(parts)


@asset("chest", "furniture", centred_rectangle(0.48, 1.1))
def chest() -> Solid:
    """Chest of drawers with a vase; +X is the drawers' side."""
    vase = lathe([(0.05, 0.0), (0.085, 0.07), (0.08, 0.14), (0.035, 0.21), (0.05, 0.24)], "coat blue", 18)
    rng = np.random.default_rng(5)
    stems = []
    for _ in range(9):
        x, y = rng.uniform(-0.11, 0.11, 2)
        z = rng.uniform(0.36, 0.48)
        stems.append(tube([(0.0, 0.0, 0.22), (x * 0.5, y * 0.5, 0.32), (x, y, z)], 0.004, "leaf", 4))
        stems.append(lathe([(0.0, -0.01), (0.035, 0.0), (0.025, 0.025), (0.0, 0.03)], "petal pink", 7, (x, y, z)))
    return joined(
        [
            box((0.42, 1.06, 0.74), (-0.015, 0.0, 0.1), "oak", 0.008),
            box((0.48, 1.1, 0.03), (0.0, 0.0, 0.84), "oak", 0.008),
            box((0.36, 0.98, 0.1), (-0.02, 0.0, 0.0), "walnut", 0.0),
            *(part.moved(-0.015) for part in _drawers(0.42, 1.05, 0.12, 0.82, 2, 3, "cream lacquer", "brass")),
            joined([vase, *stems]).moved(-0.02, 0.33, 0.87),
            box((0.16, 0.22, 0.04), (0.0, -0.3, 0.87), "book green", 0.004).turned(0),
            box((0.14, 0.2, 0.035), (0.0, -0.3, 0.91), "book yellow", 0.004),
        ]
    )


@asset("desk", "furniture", centred_rectangle(0.72, 1.5))
def desk() -> Solid:
    """Desk with a screen, keyboard and lamp; +X is the sitter's side."""
    return joined(
        [
            box((0.72, 1.5, 0.03), (0.0, 0.0, 0.71), "oak", 0.006),
            box((0.6, 0.4, 0.58), (0.02, -0.5, 0.13), "white lacquer", 0.008),
            *(part.moved(0.02, -0.5) for part in _drawers(0.6, 0.38, 0.14, 0.7, 1, 3, "white lacquer", "steel")),
            box((0.5, 0.34, 0.13), (0.0, -0.5, 0.0), "dark lacquer", 0.0),
            box((0.05, 0.05, 0.71), (-0.3, 0.69, 0.0), "black metal", 0.004),
            box((0.05, 0.05, 0.71), (0.3, 0.69, 0.0), "black metal", 0.004),
            box((0.55, 0.03, 0.06), (0.0, 0.69, 0.62), "black metal", 0.004),
            # screen, keyboard, mouse, papers
            box((0.18, 0.24, 0.012), (-0.2, 0.1, 0.74), "black metal", 0.004),
            box((0.03, 0.05, 0.14), (-0.23, 0.1, 0.75), "black metal", 0.004),
            box((0.025, 0.58, 0.34), (-0.2, 0.1, 0.84), "black metal", 0.006),
            box((0.004, 0.55, 0.31), (-0.186, 0.1, 0.855), "screen image", 0.0),
            box((0.13, 0.4, 0.018), (0.1, 0.1, 0.74), "grey lacquer", 0.004),
            cushion((0.1, 0.06, 0.03), (0.1, 0.38, 0.74), "grey lacquer", 0.014),
            box((0.29, 0.21, 0.006), (0.14, -0.3, 0.74), "paper", 0.0).turned(0),
            tube([(-0.26, -0.62, 0.75), (-0.26, -0.62, 1.08), (-0.1, -0.52, 1.2)], 0.012, "brass", 8),
            cylinder(0.07, 0.015, (-0.26, -0.62, 0.74), "brass", 0.004, 16),
            lathe([(0.085, -0.02), (0.03, 0.06)], "lamp shade", 16).moved(-0.1, -0.52, 1.15),
        ]
    )


@asset("office chair", "furniture", circle(0.34, count=24), label="office chair")
def office_chair() -> Solid:
    """Swivel chair; +X is where the sitter looks."""
    foot = joined(
        (
            tube([(0.03, 0.0, 0.09), (0.27, 0.0, 0.06)], (0.025, 0.018), "black metal", 8),
            lathe([(0.02, 0.0), (0.026, 0.012), (0.02, 0.05)], "plastic", 8, (0.27, 0.0, 0.0)),
        )
    )
    back = (
        cushion((0.09, 0.46, 0.52), (0.0, 0.0, 0.0), "charcoal cloth", 0.045).turned(-10, "y").moved(-0.22, 0.0, 0.56)
    )
    arms = [
        part
        for side in (-1, 1)
        for part in (
            tube([(0.0, side * 0.2, 0.45), (0.0, side * 0.27, 0.5), (0.0, side * 0.27, 0.66)], 0.014, "black metal", 8),
            cushion((0.26, 0.06, 0.03), (0.02, side * 0.27, 0.66), "plastic", 0.014),
        )
    ]
    return joined(
        [
            around(foot, 5, 36.0),
            cylinder(0.035, 0.36, (0.0, 0.0, 0.07), "steel", sides=14),
            cushion((0.48, 0.5, 0.1), (0.02, 0.0, 0.43), "charcoal cloth", 0.045, puff=0.015),
            tube([(-0.12, 0.0, 0.43), (-0.27, 0.0, 0.5), (-0.27, 0.0, 0.75)], 0.02, "black metal", 8),
            back,
            *arms,
        ]
    )


@asset("rug", "furniture", centred_rectangle(1.7, 2.4))
def rug() -> Solid:
    """Woven rug with a border and a medallion; +X across its short side."""
    diamond = np.array([(0.42, 0.0), (0.0, 0.72), (-0.42, 0.0), (0.0, -0.72)])
    inner = [
        extruded(diamond, 0.008, 0.0135, "rug border"),
        extruded(diamond * 0.7, 0.008, 0.0145, "rug field"),
        extruded(diamond * 0.35, 0.008, 0.0155, "rug ground"),
    ]
    corners = [
        extruded(centred_rectangle(0.16, 0.16, (sx * 0.5, sy * 0.82)), 0.008, 0.0135, "rug field")
        for sx in (-1, 1)
        for sy in (-1, 1)
    ]
    fringe = [
        box((0.02, 0.05, 0.006), (x, sy * 1.175, 0.0), "rug field", 0.0)
        for x in np.linspace(-0.8, 0.8, 25)
        for sy in (-1, 1)
    ]
    return joined(
        [
            box((1.7, 2.3, 0.01), (0.0, 0.0, 0.0), "rug border", 0.003),
            box((1.5, 2.1, 0.0015), (0.0, 0.0, 0.01), "rug field", 0.0),
            box((1.38, 1.98, 0.0025), (0.0, 0.0, 0.01), "rug ground", 0.0),
            *inner,
            *corners,
            *fringe,
        ]
    )
