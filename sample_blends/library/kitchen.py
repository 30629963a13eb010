"""Kitchen furniture: modules of one depth that stand in a row along a wall."""

from __future__ import annotations

from ..plans.outlines import centred_rectangle, circle, rounded
from .assets import asset
from .solids import Solid, at_height, box, cylinder, joined, lathe, loft, tube

DEPTH = 0.62
HEIGHT = 0.9


def _case(width: float, finish: str = "sage lacquer") -> list[Solid]:
    return [
        box((0.52, width, 0.1), (-0.04, 0.0, 0.0), "dark lacquer", 0.0),
        box((0.57, width - 0.004, HEIGHT - 0.14), (-0.025, 0.0, 0.1), finish, 0.004),
    ]


def _worktop(width: float, finish: str = "worktop") -> list[Solid]:
    return [
        box((DEPTH, width, 0.04), (0.0, 0.0, HEIGHT - 0.04), finish, 0.006),
        box((0.015, width, 0.08), (-DEPTH / 2 + 0.008, 0.0, HEIGHT), finish, 0.003),
    ]


def _doors(width: float, count: int, drawers: bool = False) -> list[Solid]:
    parts = []
    breadth = width / count
    for i in range(count):
        y = (i - (count - 1) / 2) * breadth
        top = HEIGHT - 0.05
        if drawers:
            parts.append(box((0.02, breadth - 0.01, 0.17), (0.27, y, top - 0.175), "sage lacquer", 0.006))
            parts.append(box((0.02, 0.16, 0.014), (0.285, y, top - 0.08), "brass", 0.004))
            top -= 0.185
        parts.append(box((0.02, breadth - 0.01, top - 0.125), (0.27, y, 0.12), "sage lacquer", 0.006))
        parts.append(box((0.02, 0.16, 0.014), (0.285, y, top - 0.07), "brass", 0.004))
    return parts


@asset("kitchen counter", "furniture", centred_rectangle(DEPTH, 1.2), label="counter")
def kitchen_counter() -> Solid:
    """Worktop over a cupboard, with a board, a loaf and a jar; +X is the cook's side."""
    return joined(
        [
            *_case(1.2),
            *_worktop(1.2),
            *_doors(1.2, 2, drawers=True),
            box((0.26, 0.4, 0.02), (0.04, 0.2, HEIGHT), "birch", 0.006).turned(0),
            lathe([(0.0, 0.0), (0.05, 0.02), (0.055, 0.06), (0.03, 0.1), (0.0, 0.11)], "wicker", 12)
            .scaled(1.0, 2.2, 0.8)
            .moved(0.04, 0.2, HEIGHT + 0.02),
            cylinder(0.06, 0.2, (-0.16, -0.38, HEIGHT), "terracotta", 0.01, 16),
            cylinder(0.05, 0.15, (-0.16, -0.22, HEIGHT), "porcelain", 0.01, 16),
            tube([(-0.16, -0.38, HEIGHT + 0.2), (-0.13, -0.42, HEIGHT + 0.36)], 0.01, "birch", 6),
            tube([(-0.16, -0.38, HEIGHT + 0.2), (-0.19, -0.36, HEIGHT + 0.38)], 0.01, "oak", 6),
        ]
    )


@asset("stove", "furniture", centred_rectangle(DEPTH, 0.6))
def stove() -> Solid:
    """Cooker with four rings and a pot; the oven door faces +X."""
    rings = [
        cylinder(radius, 0.004, (x, y, HEIGHT + 0.004), "hot ring", sides=24)
        for x, y, radius in ((-0.13, -0.14, 0.09), (-0.13, 0.14, 0.075), (0.13, -0.14, 0.075), (0.13, 0.14, 0.09))
    ]
    pot = joined(
        (
            lathe([(0.085, 0.0), (0.09, 0.01), (0.09, 0.12), (0.095, 0.125), (0.0, 0.14)], "steel", 22),
            cylinder(0.014, 0.03, (0.0, 0.0, 0.138), "plastic", 0.004, 10),
            tube([(0.0, 0.085, 0.1), (0.0, 0.13, 0.1)], 0.012, "plastic", 6),
            tube([(0.0, -0.085, 0.1), (0.0, -0.13, 0.1)], 0.012, "plastic", 6),
        )
    )
    knobs = [
        cylinder(0.02, 0.03, (0.0, 0.0, 0.0), "plastic", 0.004, 12).turned(90, "y").moved(0.28, y, 0.82)
        for y in (-0.21, -0.13, 0.0, 0.13, 0.21)
    ]
    return joined(
        [
            box((0.52, 0.6, 0.1), (-0.04, 0.0, 0.0), "dark lacquer", 0.0),
            box((0.58, 0.596, HEIGHT - 0.12), (-0.015, 0.0, 0.1), "steel", 0.008),
            box((DEPTH, 0.6, 0.024), (0.0, 0.0, HEIGHT - 0.02), "hob", 0.006),
            *rings,
            pot.moved(-0.13, -0.14, HEIGHT + 0.008),
            box((0.016, 0.52, 0.5), (0.28, 0.0, 0.2), "steel", 0.008),
            box((0.006, 0.42, 0.32), (0.287, 0.0, 0.26), "screen", 0.0),
            tube([(0.3, -0.22, 0.73), (0.3, 0.22, 0.73)], 0.011, "steel", 8),
            *knobs,
        ]
    )


@asset("fridge", "furniture", centred_rectangle(0.66, 0.64))
def fridge() -> Solid:
    """Fridge over a freezer; the doors face +X."""
    return joined(
        (
            box((0.58, 0.6, 0.06), (-0.03, 0.0, 0.0), "dark lacquer", 0.0),
            box((0.6, 0.64, 1.8), (-0.03, 0.0, 0.05), "white lacquer", 0.012),
            box((0.05, 0.64, 0.66), (0.295, 0.0, 0.06), "white lacquer", 0.014),
            box((0.05, 0.64, 1.1), (0.295, 0.0, 0.74), "white lacquer", 0.014),
            tube([(0.335, -0.25, 0.3), (0.335, -0.25, 0.66)], 0.012, "steel", 8),
            tube([(0.335, -0.25, 0.82), (0.335, -0.25, 1.35)], 0.012, "steel", 8),
            box((0.004, 0.1, 0.14), (0.321, 0.12, 1.35), "book yellow", 0.0),
            box((0.004, 0.08, 0.08), (0.321, -0.02, 1.48), "book red", 0.0),
        )
    )


@asset("sink", "furniture", centred_rectangle(DEPTH, 0.9))
def sink() -> Solid:
    """Kitchen sink with a drainer and a tap; +X is the washer's side."""
    basin = rounded(centred_rectangle(0.4, 0.4), 0.06, 5)
    rim = rounded(centred_rectangle(0.44, 0.44), 0.07, 5)
    bowl = loft(
        [
            at_height(rim, HEIGHT),
            at_height(rim, HEIGHT + 0.006),
            at_height(basin, HEIGHT + 0.006),
            at_height(basin, HEIGHT + 0.0052),
            at_height(basin * 0.84, HEIGHT + 0.0046),
        ],
        "steel",
    ).moved(0.02, 0.2, 0.0)
    grooves = [
        box((0.34, 0.012, 0.005), (0.02, y, HEIGHT + 0.005), "grey lacquer", 0.0)
        for y in (-0.34, -0.28, -0.22, -0.16, -0.1)
    ]
    water = joined(
        (
            loft([at_height(basin * 0.84, HEIGHT + 0.005), at_height(basin * 0.8, HEIGHT + 0.0055)], "water"),
            cylinder(0.025, 0.003, (0.0, 0.0, HEIGHT + 0.0055), "black metal", sides=12),
        )
    ).moved(0.02, 0.2, 0.0)
    tap = joined(
        (
            cylinder(0.026, 0.03, (-0.23, 0.2, HEIGHT), "steel", 0.006, 14),
            tube(
                [
                    (-0.23, 0.2, HEIGHT + 0.02),
                    (-0.23, 0.2, HEIGHT + 0.24),
                    (-0.19, 0.2, HEIGHT + 0.3),
                    (-0.1, 0.2, HEIGHT + 0.3),
                    (-0.07, 0.2, HEIGHT + 0.24),
                ],
                0.014,
                "steel",
                10,
            ),
            tube([(-0.23, 0.23, HEIGHT + 0.06), (-0.22, 0.29, HEIGHT + 0.09)], 0.008, "steel", 6),
        )
    )
    drainer = box((0.46, 0.4, 0.005), (0.02, -0.22, HEIGHT), "steel", 0.002)
    plates = [
        lathe(
            [(0.05, 0.0), (0.11, 0.012), (0.11, 0.016), (0.0, 0.006)],
            "porcelain",
            20,
            (0.02, -0.25, HEIGHT + 0.006 + 0.014 * i),
        )
        for i in range(3)
    ]
    return joined([*_case(0.9), *_worktop(0.9), *_doors(0.9, 2), bowl, water, drainer, *grooves, tap, *plates])


@asset("dishwasher", "furniture", centred_rectangle(DEPTH, 0.6))
def dishwasher() -> Solid:
    """Dishwasher under a worktop; its door faces +X."""
    return joined(
        [
            *_case(0.6, "grey lacquer"),
            *_worktop(0.6),
            box((0.02, 0.59, 0.6), (0.27, 0.0, 0.12), "steel", 0.006),
            box((0.022, 0.59, 0.12), (0.27, 0.0, 0.73), "steel", 0.006),
            box((0.004, 0.2, 0.035), (0.282, 0.1, 0.775), "screen", 0.0),
            tube([(0.295, -0.22, 0.68), (0.295, 0.22, 0.68)], 0.011, "steel", 8),
            lathe(
                [(0.05, 0.0), (0.075, 0.1), (0.08, 0.18), (0.05, 0.22), (0.0, 0.23)], "steel", 16, (-0.05, 0.1, HEIGHT)
            ),
            tube(
                [(-0.05, 0.18, HEIGHT + 0.16), (-0.05, 0.25, HEIGHT + 0.12), (-0.05, 0.18, HEIGHT + 0.06)],
                0.009,
                "plastic",
                6,
            ),
        ]
    )


@asset("kitchen table", "furniture", circle(0.45, count=32), label="kitchen table")
def kitchen_table() -> Solid:
    """Small round table with two cups."""
    cup = lathe([(0.03, 0.0), (0.042, 0.07), (0.038, 0.07), (0.025, 0.012)], "porcelain", 14)
    saucer = lathe([(0.03, 0.0), (0.07, 0.012), (0.0, 0.006)], "porcelain", 18)
    return joined(
        (
            cylinder(0.45, 0.03, (0.0, 0.0, 0.72), "white lacquer", 0.008, 36),
            lathe([(0.24, 0.0), (0.23, 0.02), (0.05, 0.05), (0.035, 0.1), (0.035, 0.68), (0.12, 0.72)], "birch", 24),
            joined((saucer, cup.moved(0.0, 0.0, 0.008))).moved(0.2, 0.05, 0.75),
            joined((saucer, cup.moved(0.0, 0.0, 0.008))).moved(-0.18, -0.1, 0.75),
            lathe([(0.05, 0.0), (0.07, 0.05), (0.04, 0.12), (0.05, 0.14)], "coat blue", 14, (0.0, 0.2, 0.75)),
        )
    )
