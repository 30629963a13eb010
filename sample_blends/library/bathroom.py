"""Bathroom fixtures."""

from __future__ import annotations

import numpy as np

from ..plans.outlines import centred_rectangle, circle, ellipse, rounded
from .assets import asset
from .solids import Solid, at_height, box, cushion, cylinder, extruded, joined, lathe, loft, tube


@asset("bathtub", "furniture", centred_rectangle(0.78, 1.75))
def bathtub() -> Solid:
    """Bathtub, long across +X; its tap is at the -Y end, its wall behind -X."""
    outer = rounded(centred_rectangle(0.78, 1.75), 0.08, 5)
    inner = rounded(centred_rectangle(0.64, 1.58), 0.26, 5)
    rings = [
        at_height(outer * 0.985, 0.0),
        at_height(outer, 0.54),
        at_height(outer * 0.985, 0.56),
        at_height(inner * 1.01, 0.56),
        at_height(inner, 0.545),
        at_height(inner * (0.88, 0.92), 0.28),
        at_height(inner * (0.74, 0.82), 0.18),
    ]
    tub = loft(rings, "porcelain")
    water = extruded(inner * (0.9, 0.935), 0.25, 0.32, "water")
    tap = joined(
        (
            tube([(0.0, -0.84, 0.56), (0.0, -0.84, 0.68), (0.0, -0.8, 0.72), (0.0, -0.68, 0.7)], 0.016, "steel", 10),
            cylinder(0.022, 0.05, (0.09, -0.83, 0.56), "steel", 0.006, 12),
            cylinder(0.022, 0.05, (-0.09, -0.83, 0.56), "steel", 0.006, 12),
        )
    )
    towel = cushion((0.05, 0.36, 0.34), (0.375, 0.35, 0.24), "towel", 0.02)
    over = cushion((0.12, 0.36, 0.03), (0.34, 0.35, 0.56), "towel", 0.014)
    return joined((tub, water, tap, towel, over))


@asset("shower", "furniture", centred_rectangle(0.9, 0.9))
def shower() -> Solid:
    """Shower for a corner: walls behind -X and -Y, glass at +X and +Y."""
    tray = rounded(centred_rectangle(0.9, 0.9), 0.04, 3)
    well = rounded(centred_rectangle(0.8, 0.8), 0.06, 3)
    return joined(
        (
            loft(
                [at_height(tray, 0.0), at_height(tray, 0.1), at_height(well, 0.1), at_height(well * 0.97, 0.06)],
                "porcelain",
            ),
            cylinder(0.045, 0.006, (0.0, 0.0, 0.06), "steel", sides=16),
            box((0.012, 0.86, 1.85), (0.43, 0.0, 0.1), "glass", 0.0),
            box((0.86, 0.012, 1.85), (0.0, 0.43, 0.1), "glass", 0.0),
            box((0.025, 0.025, 1.88), (0.435, 0.435, 0.1), "steel", 0.004),
            box((0.025, 0.88, 0.025), (0.435, 0.0, 1.95), "steel", 0.004),
            box((0.88, 0.025, 0.025), (0.0, 0.435, 1.95), "steel", 0.004),
            tube([(-0.42, 0.0, 0.9), (-0.42, 0.0, 2.0), (-0.36, 0.0, 2.06), (-0.16, 0.0, 2.04)], 0.012, "steel", 8),
            lathe([(0.11, 0.0), (0.11, 0.012), (0.02, 0.05)], "steel", 20, (-0.14, 0.0, 1.98)),
            box((0.05, 0.2, 0.06), (-0.415, 0.0, 1.0), "steel", 0.015),
        )
    )


def _oval(length: float, width: float, x: float, z: float, count: int = 28) -> np.ndarray:
    """Egg-like outline: round at the front (+X), straighter at the back."""
    ring = ellipse(length, width, count)
    ring[:, 1] *= 1.0 - 0.12 * (ring[:, 0] < 0) * (ring[:, 0] / (length / 2)) ** 2
    return at_height(ring + np.array((x, 0.0)), z)


@asset("toilet", "furniture", centred_rectangle(0.68, 0.4))
def toilet() -> Solid:
    """Toilet with its cistern at the wall (-X); the bowl points to +X."""
    bowl = loft(
        [
            _oval(0.34, 0.22, 0.02, 0.0),
            _oval(0.32, 0.2, 0.02, 0.12),
            _oval(0.46, 0.35, 0.09, 0.36),
            _oval(0.48, 0.37, 0.095, 0.4),
            _oval(0.36, 0.25, 0.1, 0.4),
            _oval(0.34, 0.23, 0.1, 0.37),
            _oval(0.2, 0.14, 0.09, 0.27),
        ],
        "porcelain",
    )
    seat = loft(
        [
            _oval(0.47, 0.365, 0.095, 0.402),
            _oval(0.47, 0.365, 0.095, 0.42),
            _oval(0.32, 0.22, 0.105, 0.424),
            _oval(0.31, 0.21, 0.105, 0.404),
        ],
        "white lacquer",
        bottom=False,
        top=False,
    )
    lid = loft([_oval(0.44, 0.36, 0.0, 0.0), _oval(0.44, 0.36, 0.0, 0.018)], "white lacquer")
    return joined(
        (
            bowl,
            seat,
            lid.moved(0.22).turned(-97, "y").moved(-0.12, 0.0, 0.42),
            _water_disc(0.22, 0.16, 0.1, 0.31),
            box((0.2, 0.26, 0.38), (-0.21, 0.0, 0.0), "porcelain", 0.03),
            cushion((0.18, 0.4, 0.36), (-0.25, 0.0, 0.4), "porcelain", 0.03),
            box((0.18, 0.4, 0.03), (-0.25, 0.0, 0.76), "porcelain", 0.012),
            cylinder(0.022, 0.012, (-0.25, 0.0, 0.79), "steel", 0.004, 14),
        )
    )


def _water_disc(length: float, width: float, x: float, z: float) -> Solid:
    return loft([_oval(length, width, x, z), _oval(length, width, x, z + 0.004)], "water")


@asset("bidet", "furniture", centred_rectangle(0.56, 0.37))
def bidet() -> Solid:
    """Bidet; its wall is behind -X."""
    bowl = loft(
        [
            _oval(0.32, 0.22, -0.02, 0.0),
            _oval(0.32, 0.2, -0.02, 0.12),
            _oval(0.54, 0.36, 0.0, 0.36),
            _oval(0.55, 0.37, 0.0, 0.39),
            _oval(0.42, 0.28, 0.04, 0.39),
            _oval(0.38, 0.24, 0.04, 0.33),
            _oval(0.2, 0.12, 0.04, 0.28),
        ],
        "porcelain",
    )
    tap = tube([(-0.21, 0.0, 0.39), (-0.21, 0.0, 0.47), (-0.17, 0.0, 0.5), (-0.1, 0.0, 0.47)], 0.013, "steel", 8)
    return joined(
        (
            bowl,
            tap,
            cylinder(0.014, 0.03, (-0.2, 0.07, 0.39), "steel", 0.004, 10),
            cylinder(0.014, 0.03, (-0.2, -0.07, 0.39), "steel", 0.004, 10),
            cylinder(0.02, 0.006, (0.04, 0.0, 0.281), "steel", sides=12),
        )
    )


@asset("washbasin", "furniture", centred_rectangle(0.5, 0.68))
def washbasin() -> Solid:
    """Washbasin on a cupboard with a mirror on the wall behind it (-X)."""
    top = rounded(centred_rectangle(0.5, 0.68), 0.07, 4)
    oval = np.column_stack((ellipse(0.33, 0.48, len(top))[:, 0] + 0.03, ellipse(0.33, 0.48, len(top))[:, 1]))
    # Both rings start at their +X, +Y corner: the skin between them must not be twisted.
    start = int(
        np.argmin(np.abs(np.arctan2(oval[:, 1], oval[:, 0] - 0.03) - np.arctan2(top[0, 1], top[0, 0]) % (2 * np.pi)))
    )
    oval = np.roll(oval, -start, axis=0)
    bowl = loft(
        [
            at_height(top * 0.97, 0.78),
            at_height(top, 0.8),
            at_height(top, 0.87),
            at_height(top * 0.98, 0.88),
            at_height(oval, 0.88),
            at_height((oval - (0.03, 0.0)) * 0.92 + (0.03, 0.0), 0.84),
            at_height((oval - (0.03, 0.0)) * 0.55 + (0.03, 0.0), 0.81),
        ],
        "porcelain",
    )
    parts = [
        box((0.42, 0.6, 0.62), (-0.03, 0.0, 0.18), "oak", 0.008),
        box((0.36, 0.54, 0.18), (-0.05, 0.0, 0.0), "dark lacquer", 0.0),
        bowl,
        cylinder(0.02, 0.004, (0.03, 0.0, 0.811), "steel", sides=14),
        tube([(-0.19, 0.0, 0.88), (-0.19, 0.0, 1.0), (-0.15, 0.0, 1.03), (-0.06, 0.0, 0.99)], 0.014, "steel", 10),
        tube([(-0.19, 0.0, 1.0), (-0.21, 0.0, 1.06)], 0.008, "steel", 6),
        box((0.03, 0.62, 0.8), (-0.235, 0.0, 1.12), "white lacquer", 0.006),
        box((0.004, 0.56, 0.74), (-0.218, 0.0, 1.15), "mirror", 0.0),
        cylinder(0.03, 0.11, (-0.15, 0.27, 0.88), "petal pink", 0.006, 12),
        cylinder(0.028, 0.09, (-0.15, -0.27, 0.88), "glass", 0.0, 12),
    ]
    for y in (-0.147, 0.147):
        parts.append(box((0.018, 0.29, 0.58), (0.185, y, 0.2), "white lacquer", 0.006))
        parts.append(box((0.014, 0.012, 0.12), (0.2, y * 0.2, 0.5), "steel", 0.003))
    return joined(parts)


@asset("washing machine", "furniture", centred_rectangle(0.62, 0.6))
def washing_machine() -> Solid:
    """Washing machine; its door faces +X."""
    door = joined(
        (
            lathe([(0.2, 0.0), (0.2, 0.02), (0.165, 0.035), (0.15, 0.03)], "steel", 28),
            lathe([(0.15, 0.015), (0.12, 0.035), (0.0, 0.045)], "screen", 28),
        )
    )
    return joined(
        (
            box((0.58, 0.6, 0.86), (-0.02, 0.0, 0.0), "white lacquer", 0.012),
            door.turned(90, "y").moved(0.265, 0.0, 0.44),
            box((0.01, 0.16, 0.08), (0.27, -0.18, 0.745), "grey lacquer", 0.003),
            cylinder(0.035, 0.03, (0.0, 0.0, 0.0), "steel", 0.006, 16).turned(90, "y").moved(0.268, 0.05, 0.785),
            box((0.006, 0.12, 0.045), (0.271, 0.2, 0.765), "screen", 0.0),
            box((0.28, 0.32, 0.12), (-0.05, -0.05, 0.86), "towel", 0.03),
            box((0.27, 0.3, 0.06), (-0.05, -0.05, 0.98), "linen", 0.02),
        )
    )


@asset("bath mat", "furniture", centred_rectangle(0.52, 0.85))
def bath_mat() -> Solid:
    """Bath mat, long across +X."""
    return joined(
        (
            extruded(rounded(centred_rectangle(0.52, 0.85), 0.08, 5), 0.0, 0.016, "bath mat", 0.006),
            extruded(rounded(centred_rectangle(0.4, 0.73), 0.05, 5), 0.016, 0.02, "linen", 0.002),
            extruded(rounded(centred_rectangle(0.34, 0.67), 0.04, 5), 0.02, 0.023, "bath mat", 0.002),
        )
    )


@asset("laundry basket", "furniture", circle(0.23, count=24))
def laundry_basket() -> Solid:
    """Wicker basket with its lid ajar."""
    return joined(
        (
            lathe(
                [(0.18, 0.0), (0.22, 0.5), (0.23, 0.5), (0.23, 0.53), (0.2, 0.53), (0.19, 0.45), (0.0, 0.44)],
                "wicker",
                24,
            ),
            cushion((0.3, 0.26, 0.13), (0.0, 0.01, 0.44), "linen", 0.06, puff=0.04),
            cushion((0.2, 0.16, 0.1), (0.05, -0.05, 0.54), "coat blue", 0.045, puff=0.03),
        )
    )
