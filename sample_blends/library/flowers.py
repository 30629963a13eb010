"""Flower beds, single flowers and the ornaments that stand in beds."""

from __future__ import annotations

import numpy as np

from ..plans.outlines import arc, centred_rectangle, circle, inset, rounded
from .assets import asset
from .solids import Solid, at_height, cards, cylinder, ellipsoid, extruded, joined, lathe, loft, tube

KERB = 0.18


def bed_solid(outline: np.ndarray) -> Solid:
    """Bed of an outline: a stone kerb around raised soil under a carpet of low leaves."""
    inner = inset(outline, KERB)
    kerb = loft(
        [
            at_height(outline, 0.0),
            at_height(outline, 0.16),
            at_height(inset(outline, 0.02), 0.18),
            at_height(inner, 0.18),
            at_height(inner, 0.06),
        ],
        "kerb",
        top=False,
    )
    centre = inner.mean(axis=0)
    soil = loft(
        [
            at_height(inner, 0.1),
            at_height(centre + 0.9 * (inner - centre), 0.16),
            at_height(centre + 0.4 * (inner - centre), 0.2),
        ],
        "soil",
        bottom=False,
    )
    return joined((kerb, soil))


ROUND_BED = circle(1.9, count=40)
RECTANGULAR_BED = centred_rectangle(5.0, 2.8)
# A rectangle with hollowed corners, as old parterres have it.
HOLLOW_BED = np.vstack(
    [
        arc((sx * 2.9, sy * 1.6), 0.9, start, start - 90.0, 7)
        for sx, sy, start in ((1, 1, 270), (-1, 1, 0), (-1, -1, 90), (1, -1, 180))
    ]
)
# A piece of a ring about a round place of 11 metres' radius; its hollow side looks to +X.
RING_CENTRE = 13.067
RING_BED = np.vstack((arc((RING_CENTRE, 0.0), 14.8, 158.0, 202.0, 21), arc((RING_CENTRE, 0.0), 12.2, 202.0, 158.0, 21)))


@asset("round flower bed", "garden", ROUND_BED, label="flower bed")
def round_bed() -> Solid:
    """Round bed."""
    return bed_solid(ROUND_BED)


@asset("rectangular flower bed", "garden", RECTANGULAR_BED, label="flower bed")
def rectangular_bed() -> Solid:
    """Rectangular bed, long along +X."""
    return bed_solid(RECTANGULAR_BED)


@asset("hollow flower bed", "garden", HOLLOW_BED, label="flower bed")
def hollow_bed() -> Solid:
    """Rectangular bed with hollowed corners, long along +X."""
    return bed_solid(HOLLOW_BED)


@asset("ring flower bed", "garden", RING_BED, label="flower bed")
def ring_bed() -> Solid:
    """Bed bent about a round place at +X."""
    return bed_solid(RING_BED)


def _clump(petal: str, seed: int, blossoms: int = 9, tall: float = 0.4, spread: float = 0.25) -> Solid:
    rng = np.random.default_rng(seed)
    parts = []
    for i in range(blossoms):
        turn = np.radians(137.5 * i)
        reach = spread * np.sqrt((i + 0.3) / blossoms)
        x, y = reach * np.cos(turn), reach * np.sin(turn)
        z = tall * float(rng.uniform(0.8, 1.1)) * (1.05 - 0.5 * (reach / spread) ** 2 * 0.5)
        parts.append(tube([(0.4 * x, 0.4 * y, 0.0), (x, y, z)], 0.008, "leaf", 4))
        size = float(rng.uniform(0.075, 0.1))
        # Six petals in a shallow cup about a heart.
        star = circle(1.0, count=12) * np.where(np.arange(12) % 2, 0.55, 1.0)[:, None]
        cup = loft([at_height(star * size * 0.25, -0.01), at_height(star * size, 0.028)], petal, top=True)
        heart = ellipsoid((size * 0.32, size * 0.32, 0.018), (0.0, 0.0, 0.032), "petal heart", 6, 3)
        lean = joined((cup, heart)).turned(float(-25 * x / spread * -1), "y").turned(float(-25 * y / spread), "x")
        parts.append(lean.moved(x, y, z))
    count = 40
    turn, reach = rng.uniform(0, 2 * np.pi, count), spread * np.sqrt(rng.uniform(0.05, 1.1, count))
    centres = np.column_stack((reach * np.cos(turn), reach * np.sin(turn), rng.uniform(0.08, 0.55 * tall, count)))
    normals = np.column_stack((np.cos(turn), np.sin(turn), np.full(count, 1.0)))
    parts.append(cards(centres, normals, rng.uniform(0.07, 0.12, count), "leaf", rng))
    return joined(parts)


FLOWER = circle(0.31, count=16)


@asset("red flower", "garden", FLOWER, label="flower")
def red_flower() -> Solid:
    """Clump of red flowers."""
    return _clump("petal red", 1)


@asset("yellow flower", "garden", FLOWER, label="flower")
def yellow_flower() -> Solid:
    """Clump of yellow flowers."""
    return _clump("petal yellow", 2, tall=0.36)


@asset("white flower", "garden", FLOWER, label="flower")
def white_flower() -> Solid:
    """Clump of white flowers."""
    return _clump("petal white", 3, tall=0.33)


@asset("violet flower", "garden", FLOWER, label="flower")
def violet_flower() -> Solid:
    """Clump of violet flowers."""
    return _clump("petal violet", 4, tall=0.46)


@asset("pink flower", "garden", FLOWER, label="flower")
def pink_flower() -> Solid:
    """Clump of pink flowers."""
    return _clump("petal pink", 5, tall=0.4)


@asset("topiary spiral", "garden", circle(0.36, count=20), label="topiary")
def topiary_spiral() -> Solid:
    """Box clipped into a spiral."""
    turns = np.linspace(0.0, 2 * np.pi * 3.25, 60)
    rise = turns / turns[-1]
    radius = 0.26 * (1 - rise) + 0.02
    path = np.column_stack((radius * np.cos(turns) * 0.7, radius * np.sin(turns) * 0.7, 0.16 + 1.25 * rise))
    spiral = tube(path, 0.14 * (1 - 0.75 * rise), "box leaf", 8).roughened(0.012, 8)
    return joined(
        (
            spiral,
            cylinder(0.04, 1.2, (0.0, 0.0, 0.0), "bark", sides=8, top=0.02),
            ellipsoid((0.07, 0.07, 0.07), (0.0, 0.0, 1.46), "box leaf", 8, 6),
        )
    )


@asset("flower urn", "garden", circle(0.42, count=24), label="urn")
def flower_urn() -> Solid:
    """Stone urn full of flowers."""
    urn = lathe(
        [
            (0.3, 0.0),
            (0.3, 0.1),
            (0.16, 0.16),
            (0.1, 0.26),
            (0.14, 0.34),
            (0.36, 0.5),
            (0.4, 0.66),
            (0.42, 0.7),
            (0.36, 0.7),
            (0.3, 0.64),
            (0.0, 0.62),
        ],
        "sandstone",
        24,
    )
    return joined((urn, _clump("petal red", 6, 12, 0.32, 0.3).moved(0.0, 0.0, 0.64)))


@asset("box hedge", "garden", centred_rectangle(1.2, 0.5), label="hedge")
def low_hedge() -> Solid:
    """Piece of clipped box hedge, long along +X."""
    outline = rounded(centred_rectangle(1.2, 0.5), 0.08, 3)
    return extruded(outline, 0.0, 0.5, "box leaf", 0.06)
