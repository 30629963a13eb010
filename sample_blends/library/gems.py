"""Gems and ornaments of a crown, in true size: metres, so a ruby of 14 mm measures 0.014.

The local frame lies on the crown: +X is the ornament's upward direction (its pose), +Z points out of the gold.
"""

from __future__ import annotations

import numpy as np

from ..plans.outlines import centred_rectangle, circle, ellipse, inset, smoothed
from .assets import asset
from .solids import Solid, around, at_height, box, cylinder, ellipsoid, extruded, joined, lathe, loft, tube


def _bezel(outline: np.ndarray, height: float, thickness: float = 0.0009) -> Solid:
    """Gold setting around a stone, whose foot stands on the gold."""
    outer = inset(outline, -thickness)
    rings = [
        at_height(inset(outline, -1.6 * thickness), 0.0),
        at_height(outer, 0.4 * height),
        at_height(outer, height),
        at_height(inset(outline, -0.3 * thickness), height * 1.08),
        at_height(inset(outline, 0.5 * thickness), height * 0.95),
    ]
    return loft(rings, "gold")


def _brilliant(length: float, width: float, height: float, material: str, sides: int = 8) -> Solid:
    """Crown of a brilliant: table, star and kite facets down to the girdle; flat facets throughout."""
    table = circle(1.0, count=sides)
    girdle = circle(1.0, count=2 * sides)
    middle = circle(1.0, count=2 * sides)[1::2]
    scale = np.array((length / 2, width / 2))
    vertices = np.vstack(
        (
            at_height(table * 0.56 * scale, height),
            at_height(middle * 0.8 * scale, height * 0.68),
            at_height(girdle * scale, height * 0.16),
            at_height(girdle * scale, 0.0),
        )
    )
    upper, star, rim, foot = 0, sides, 2 * sides, 4 * sides
    faces: list[tuple[int, ...]] = [tuple(range(sides))]
    for i in range(sides):
        after, before = (i + 1) % sides, (i - 1) % sides
        faces.append((upper + i, star + i, upper + after))
        faces.append((upper + i, star + before, rim + 2 * i, star + i))
        faces.append((star + i, rim + 2 * i, rim + 2 * i + 1))
        faces.append((star + i, rim + 2 * i + 1, rim + (2 * i + 2) % (2 * sides)))
    for j in range(2 * sides):
        after = (j + 1) % (2 * sides)
        faces.append((foot + j, foot + after, rim + after, rim + j))
    return Solid(vertices, faces, [material] * len(faces))


RUBY = ellipse(0.0218, 0.0178, 28)


@asset("ruby", "crown", RUBY, sharp_angle=0.0)
def ruby() -> Solid:
    """Oval ruby in a bezel, long along +X."""
    stone = _brilliant(0.0175, 0.0135, 0.006, "ruby").moved(0.0, 0.0, 0.0022)
    beads = [
        ellipsoid((0.0008, 0.0008, 0.0008), (0.0101 * np.cos(t), 0.0081 * np.sin(t), 0.0006), "bright gold", 6, 4)
        for t in np.linspace(0, 2 * np.pi, 33)[:-1]
    ]
    return joined((_bezel(ellipse(0.0175, 0.0135, 28), 0.0032), stone, *beads))


EMERALD = centred_rectangle(0.017, 0.014)


@asset("emerald", "crown", EMERALD, sharp_angle=0.0)
def emerald() -> Solid:
    """Emerald in step cut, long along +X."""

    def octagon(length: float, width: float, cut: float) -> np.ndarray:
        a, b = length / 2, width / 2
        return np.array(
            [
                (a, -b + cut),
                (a, b - cut),
                (a - cut, b),
                (-a + cut, b),
                (-a, b - cut),
                (-a, -b + cut),
                (-a + cut, -b),
                (a - cut, -b),
            ]
        )

    steps = [
        (0.0136, 0.0106, 0.0),
        (0.0136, 0.0106, 0.0012),
        (0.0115, 0.0085, 0.003),
        (0.0092, 0.0062, 0.0042),
        (0.0075, 0.0045, 0.0046),
    ]
    stone = loft([at_height(octagon(length, width, 0.28 * width), z) for length, width, z in steps], "emerald").moved(
        0, 0, 0.0022
    )
    claws = [
        ellipsoid((0.0013, 0.0013, 0.0016), (sx * 0.0057, sy * 0.0042, 0.0036), "bright gold", 8, 6)
        for sx in (-1, 1)
        for sy in (-1, 1)
    ]
    return joined((_bezel(octagon(0.0138, 0.0108, 0.0028), 0.0032), stone, *claws))


@asset("diamond", "crown", circle(0.0065, count=24), sharp_angle=0.0)
def diamond() -> Solid:
    """Round brilliant in claws."""
    stone = _brilliant(0.0108, 0.0108, 0.0042, "diamond").moved(0.0, 0.0, 0.0024)
    claw = tube(
        [(0.0062, 0.0, 0.0), (0.006, 0.0, 0.003), (0.0047, 0.0, 0.0045)], (0.0009, 0.0007, 0.0006), "bright gold", 6
    )
    return joined((_bezel(circle(0.0054, count=24), 0.0028, 0.0007), stone, around(claw, 8)))


@asset("pearl", "crown", circle(0.0048, count=24))
def pearl() -> Solid:
    """Pearl on a gold cup."""
    return joined(
        (
            lathe([(0.0046, 0.0), (0.0034, 0.0008), (0.0036, 0.0018)], "gold", 18),
            ellipsoid((0.0045, 0.0045, 0.0045), (0.0, 0.0, 0.0052), "pearl", 20, 14),
        )
    )


def _lily() -> np.ndarray:
    """Outline of a fleur-de-lis of height 1 along +X, about its middle."""
    half = np.array(
        [
            (-0.50, 0.05), (-0.44, 0.11), (-0.36, 0.09), (-0.24, 0.05), (-0.17, 0.07), (-0.18, 0.17),
            (-0.26, 0.24), (-0.27, 0.33), (-0.17, 0.40), (-0.04, 0.41), (0.07, 0.36), (0.12, 0.28),
            (0.10, 0.20), (0.05, 0.19), (0.04, 0.25), (-0.03, 0.28), (-0.09, 0.24), (-0.10, 0.14),
            (-0.06, 0.09), (0.06, 0.12), (0.18, 0.15), (0.28, 0.13), (0.38, 0.08), (0.50, 0.0),
        ]
    )  # fmt: skip
    # Counter-clockwise: up the right side (y < 0) from the foot, down the left.
    right = half[:-1] * (1.0, -1.0)
    return smoothed(np.vstack((right, half[-1:], half[:-1][::-1])), 1)


LILY_FOOTPRINT = np.array(
    [
        (-0.0165, -0.004),
        (-0.0085, -0.0135),
        (0.002, -0.0138),
        (0.0165, 0.0),
        (0.002, 0.0138),
        (-0.0085, 0.0135),
        (-0.0165, 0.004),
    ]
)


@asset("fleur-de-lis", "crown", LILY_FOOTPRINT, label="ornament")
def fleur_de_lis() -> Solid:
    """Gold lily, its tip along +X, bound by a band with a small pearl."""
    outline = _lily() * (0.034, 0.034)
    body = loft(
        [at_height(outline, 0.0), at_height(outline, 0.0022), at_height(inset(outline, 0.0007), 0.0029)],
        "bright gold",
    )
    band = box((0.0034, 0.0105, 0.0046), (-0.0047, 0.0, 0.0), "gold", 0.0009)
    rib = tube(
        [(-0.001, 0.0, 0.0028), (0.007, 0.0, 0.0034), (0.0155, 0.0, 0.0026)], (0.0009, 0.0011, 0.0003), "gold", 6
    )
    return joined((body, band, rib, ellipsoid((0.0016, 0.0016, 0.0016), (-0.0047, 0.0, 0.005), "pearl", 12, 8)))


@asset("gold cross", "crown", centred_rectangle(0.025, 0.025), label="ornament")
def gold_cross() -> Solid:
    """Cross with flared arms, its head along +X, a ruby in its middle."""
    arm = np.array([(0.0022, -0.0022), (0.0125, -0.0052), (0.0115, 0.0), (0.0125, 0.0052), (0.0022, 0.0022)])
    arms = around(extruded(arm, 0.0, 0.0032, "bright gold", 0.0007), 4)
    heart = joined(
        (
            cylinder(0.0042, 0.0036, (0.0, 0.0, 0.0), "gold", 0.0006, 20),
            _brilliant(0.006, 0.006, 0.003, "ruby").moved(0, 0, 0.0034),
        )
    )
    return joined((arms, heart))


@asset("gold band", "crown", centred_rectangle(0.022, 0.02), label="band", sharp_angle=30.0)
def gold_band() -> Solid:
    """Piece of a goldsmith's band with a leaf scroll, 20 mm long across +X."""
    rims = [tube([(x, -0.01, 0.0012), (x, 0.01, 0.0012)], 0.0013, "bright gold", 8) for x in (-0.0096, 0.0096)]
    beads = [
        ellipsoid((0.0009, 0.0009, 0.0009), (x, -0.01 + 0.00125 + 0.0025 * i, 0.0014), "bright gold", 8, 6)
        for x in (-0.0074, 0.0074)
        for i in range(8)
    ]
    # A tendril that runs on from piece to piece, with a curl on either side of its middle.
    y = np.linspace(-0.01, 0.01, 25)
    stem = np.column_stack((0.0036 * np.sin(y * 100 * np.pi), y, np.full(25, 0.0015)))
    turn = np.linspace(0.0, 1.6 * np.pi, 16)
    curl = np.column_stack(
        (0.0026 * (1 - 0.1 * turn) * np.cos(turn), 0.0026 * (1 - 0.1 * turn) * np.sin(turn), np.full(16, 0.0015))
    )
    spiral = tube(curl, np.linspace(0.0007, 0.0005, 16), "bright gold", 6)
    leaf = loft(
        [at_height(ellipse(0.0052, 0.0024, 14), 0.001), at_height(ellipse(0.003, 0.0009, 14), 0.0024)], "bright gold"
    )
    return joined(
        [
            box((0.02, 0.02, 0.0012), (0.0, 0.0, 0.0), "gold", 0.0),
            *rims,
            *beads,
            tube(stem, 0.0008, "bright gold", 6),
            spiral.moved(-0.0018, 0.005),
            spiral.turned(180).moved(0.0018, -0.005),
            leaf.turned(30).moved(0.0042, 0.0015),
            leaf.turned(30).moved(-0.0042, -0.0015),
        ]
    )
