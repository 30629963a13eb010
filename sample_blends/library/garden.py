"""Fountains, statues, pavilions and the furniture of a palace garden."""

from __future__ import annotations

import numpy as np

from ..plans.outlines import centred_rectangle, circle
from .assets import asset
from .solids import Solid, around, at_height, box, cylinder, ellipsoid, extruded, joined, lathe, legs, loft, slab, tube


def _jet(start: tuple[float, float], end: tuple[float, float], steps: int = 9, radius: float = 0.035) -> Solid:
    """Arc of water in the plane y = 0 from (x, z) to (x, z)."""
    t = np.linspace(0.0, 1.0, steps)
    x = start[0] + (end[0] - start[0]) * t
    z = start[1] + (end[1] - start[1]) * t + 4 * 0.45 * t * (1 - t)
    path = np.column_stack((x, np.zeros(steps), z))
    return tube(path, radius * (0.6 + 0.7 * t), "spray", 5)


@asset("fountain", "garden", circle(2.5, count=40))
def fountain() -> Solid:
    """Fountain of two bowls in a round basin."""
    basin = lathe(
        [(2.5, 0.0), (2.5, 0.12), (2.38, 0.16), (2.36, 0.5), (2.46, 0.56), (2.44, 0.64), (2.16, 0.64), (2.14, 0.3)],
        "sandstone",
        40,
    )
    water = lathe([(2.15, 0.3), (2.15, 0.48), (0.0, 0.485)], "water", 40)
    column = lathe(
        [
            (0.62, 0.3),
            (0.6, 0.6),
            (0.36, 0.7),
            (0.24, 0.95),
            (0.3, 1.3),
            (0.5, 1.42),
            (1.1, 1.6),
            (1.2, 1.72),
            (1.16, 1.75),
            (1.02, 1.66),
            (0.0, 1.65),
        ],
        "marble",
        28,
    )
    upper_water = cylinder(1.06, 0.02, (0.0, 0.0, 1.68), "water", sides=28)
    top = lathe(
        [
            (0.2, 1.65),
            (0.14, 1.9),
            (0.16, 2.1),
            (0.5, 2.28),
            (0.56, 2.36),
            (0.5, 2.36),
            (0.12, 2.3),
            (0.1, 2.5),
            (0.16, 2.6),
            (0.0, 2.75),
        ],
        "marble",
        22,
    )
    return joined(
        (
            basin,
            water,
            column,
            upper_water,
            top,
            around(_jet((1.14, 1.74), (1.8, 0.5)), 10),
            around(_jet((0.52, 2.36), (0.92, 1.7), radius=0.025), 8, 20.0),
            tube([(0.0, 0.0, 2.7), (0.0, 0.0, 3.1), (0.0, 0.0, 3.4)], (0.05, 0.07, 0.02), "spray", 6),
        )
    )


@asset("small fountain", "garden", circle(1.1, count=28), label="small fountain")
def small_fountain() -> Solid:
    """Low basin with a single jet."""
    return joined(
        (
            lathe(
                [(1.1, 0.0), (1.1, 0.1), (1.02, 0.14), (1.0, 0.38), (1.08, 0.46), (0.9, 0.46), (0.88, 0.25)],
                "granite",
                28,
            ),
            lathe([(0.89, 0.25), (0.89, 0.36), (0.0, 0.365)], "water", 28),
            lathe([(0.2, 0.3), (0.14, 0.5), (0.22, 0.66), (0.3, 0.72), (0.24, 0.72), (0.0, 0.7)], "marble", 18),
            around(_jet((0.05, 0.75), (0.62, 0.38), radius=0.028), 8),
            tube([(0.0, 0.0, 0.7), (0.0, 0.0, 1.3), (0.0, 0.0, 1.55)], (0.04, 0.05, 0.015), "spray", 6),
        )
    )


@asset("statue", "garden", centred_rectangle(1.0, 1.0))
def statue() -> Solid:
    """Draped figure on a plinth; she looks to +X."""
    turn = np.linspace(0.0, 2 * np.pi, 33)[:-1]

    def section(x: float, width: float, depth: float, z: float, fold: float) -> np.ndarray:
        wave = 1.0 + fold * np.sin(9 * turn + 3 * z)
        return at_height(np.column_stack((x + depth / 2 * wave * np.cos(turn), width / 2 * wave * np.sin(turn))), z)

    robe = loft(
        [
            section(0.0, 0.62, 0.56, 1.2, 0.09),
            section(0.0, 0.52, 0.46, 1.6, 0.1),
            section(0.01, 0.42, 0.36, 2.05, 0.07),
            section(0.0, 0.3, 0.24, 2.32, 0.03),
            section(0.02, 0.36, 0.27, 2.52, 0.02),
            section(0.01, 0.46, 0.26, 2.68, 0.01),
            section(0.0, 0.2, 0.16, 2.78, 0.0),
            section(0.01, 0.13, 0.13, 2.86, 0.0),
        ],
        "marble",
    )
    head = joined(
        (
            ellipsoid((0.115, 0.1, 0.145), (0.03, 0.0, 2.98), "marble", 16, 10),
            ellipsoid((0.09, 0.09, 0.09), (-0.07, 0.0, 3.04), "marble", 12, 8),
            ellipsoid((0.025, 0.02, 0.035), (0.14, 0.0, 2.96), "marble", 8, 6),
        )
    )
    raised = tube(
        [(0.0, 0.2, 2.64), (0.14, 0.33, 2.55), (0.26, 0.28, 2.86), (0.28, 0.26, 3.02)],
        (0.07, 0.055, 0.045, 0.03),
        "marble",
        10,
    )
    hanging = tube(
        [(0.0, -0.2, 2.64), (0.03, -0.31, 2.4), (0.16, -0.26, 2.16), (0.2, -0.22, 2.1)],
        (0.07, 0.055, 0.045, 0.03),
        "marble",
        10,
    )
    torch = lathe(
        [(0.02, 0.0), (0.03, 0.2), (0.06, 0.24), (0.06, 0.28), (0.03, 0.36), (0.0, 0.46)],
        "bright gold",
        10,
        (0.29, 0.26, 2.92),
    )
    plinth = [
        slab(1.0, 1.0, 0.0, 0.14, "granite", 0.02),
        slab(0.84, 0.84, 0.14, 0.24, "granite", 0.03),
        slab(0.7, 0.7, 0.24, 1.04, "granite", 0.012),
        slab(0.84, 0.84, 1.04, 1.14, "granite", 0.03),
        slab(0.74, 0.74, 1.14, 1.2, "granite", 0.02),
        box((0.012, 0.42, 0.3), (0.352, 0.0, 0.5), "brass", 0.004),
    ]
    return joined((robe, head, raised, hanging, torch, *plinth))


def _roof(sides: int, radius: float, z: float, rise: float, finish: str) -> Solid:
    """Curved hipped roof whose corners turn up."""
    rings = []
    angles = np.radians(360.0 / sides * np.arange(sides * 4) / 4)
    spike = np.cos(np.pi / sides) / np.cos(angles % (2 * np.pi / sides) - np.pi / sides)
    corner = (spike.max() - spike) / (spike.max() - spike.min())  # 0 at the corners of the polygon
    for t in np.linspace(0.0, 1.0, 7):
        r = radius * (1 - t) ** 1.5 + 0.1
        lift = 0.3 * (1 - corner) ** 2 * (1 - t) ** 4
        height = z + rise * (1 - (1 - t) ** 0.75 * (1 - 0.25 * t)) + lift
        rings.append(np.column_stack((r * spike * np.cos(angles), r * spike * np.sin(angles), height)))
    eaves = rings[0] - (0.0, 0.0, 0.09)
    return loft([eaves * (0.9, 0.9, 1.0), eaves, *rings], finish)


@asset("pagoda", "garden", circle(2.3, count=6))
def pagoda() -> Solid:
    """Six-sided pavilion of two roofs; +X is a corner."""
    hexagon = circle(1.0, count=6)
    pillars = around(cylinder(0.12, 2.4, (1.62, 0.0, 0.4), "tile red", 0.02, 12), 6)
    rail = joined(
        (
            box((0.06, 1.5, 0.07), (1.42, 0.0, 1.15), "tile red"),
            box((0.06, 1.5, 0.06), (1.42, 0.0, 0.6), "tile red"),
            *(box((0.04, 0.04, 0.5), (1.42, y, 0.62), "tile red", 0.0) for y in (-0.5, -0.25, 0.0, 0.25, 0.5)),
        )
    )
    rails = joined(rail.turned(30.0 + 60.0 * i) for i in range(6) if i != 3)
    return joined(
        (
            extruded(hexagon * 2.3, 0.0, 0.2, "granite", 0.03),
            extruded(hexagon * 2.0, 0.2, 0.4, "granite", 0.03),
            pillars,
            rails,
            extruded(hexagon * 1.78, 2.75, 2.95, "tile red"),
            _roof(6, 2.15, 2.95, 1.1, "tile green"),
            extruded(hexagon * 0.85, 3.7, 4.4, "tile red"),
            around(box((0.04, 0.5, 0.36), (0.74, 0.0, 3.95), "lantern light", 0.0), 6, 30.0),
            _roof(6, 1.25, 4.4, 1.0, "tile green"),
            lathe([(0.12, 5.3), (0.16, 5.45), (0.06, 5.55), (0.12, 5.68), (0.0, 6.05)], "bright gold", 14),
        )
    )


@asset("bench", "garden", centred_rectangle(0.66, 1.8))
def bench() -> Solid:
    """Park bench; +X is where the sitters look."""
    parts = []
    for x in (-0.1, 0.0, 0.1, 0.2, 0.29):
        parts.append(box((0.08, 1.7, 0.035), (x, 0.0, 0.42), "oak", 0.008))
    for i, z in enumerate((0.56, 0.68, 0.8)):
        parts.append(box((0.03, 1.7, 0.09), (-0.2 - 0.03 * i, 0.0, z), "oak", 0.008))
    for y in (-0.76, 0.76):
        parts.append(tube([(0.3, y, 0.0), (0.27, y, 0.2), (0.28, y, 0.42), (0.24, y, 0.64)], 0.03, "black metal", 8))
        parts.append(tube([(-0.28, y, 0.0), (-0.18, y, 0.4), (-0.3, y, 0.92)], 0.03, "black metal", 8))
        parts.append(tube([(0.27, y, 0.4), (-0.2, y, 0.4)], 0.025, "black metal", 6))
        parts.append(tube([(0.26, y, 0.64), (-0.25, y, 0.66)], 0.028, "black metal", 6))
    return joined(parts)


@asset("lantern", "garden", circle(0.3, count=20))
def lantern() -> Solid:
    """Lamp post with one lantern."""
    cage = lathe([(0.11, 2.6), (0.19, 3.05)], "lantern light", 6)
    bars = around(tube([(0.115, 0.0, 2.6), (0.2, 0.0, 3.05)], 0.013, "black metal", 5), 6)
    return joined(
        (
            lathe(
                [
                    (0.3, 0.0),
                    (0.3, 0.08),
                    (0.16, 0.16),
                    (0.14, 0.5),
                    (0.07, 0.6),
                    (0.05, 2.4),
                    (0.09, 2.5),
                    (0.13, 2.58),
                    (0.13, 2.62),
                ],
                "black metal",
                16,
            ),
            cage,
            bars,
            lathe([(0.25, 3.04), (0.2, 3.1), (0.08, 3.28), (0.03, 3.32), (0.0, 3.45)], "black metal", 12),
        )
    )


@asset("garden table", "garden", circle(1.1, count=28), label="garden table")
def garden_table() -> Solid:
    """Round iron table with three chairs."""
    chair = joined(
        (
            cylinder(0.22, 0.03, (0.0, 0.0, 0.44), "white lacquer", 0.008, 18),
            legs(0.28, 0.28, 0.44, 0.014, "white lacquer"),
            tube(
                [(0.17, -0.16, 0.45), (0.22, -0.18, 0.8), (0.23, 0.0, 0.92), (0.22, 0.18, 0.8), (0.17, 0.16, 0.45)],
                0.018,
                "white lacquer",
                7,
            ),
            tube([(0.19, 0.0, 0.46), (0.22, 0.0, 0.9)], 0.014, "white lacquer", 6),
        )
    ).moved(0.8)
    return joined(
        (
            cylinder(0.5, 0.03, (0.0, 0.0, 0.72), "white lacquer", 0.008, 28),
            lathe([(0.26, 0.0), (0.24, 0.03), (0.04, 0.08), (0.04, 0.72)], "white lacquer", 14),
            around(chair, 3, 30.0),
        )
    )
