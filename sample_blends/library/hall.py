"""Furniture of a hall."""

from __future__ import annotations

import numpy as np

from ..plans.outlines import centred_rectangle, circle
from .assets import asset
from .solids import Solid, around, box, cushion, cylinder, joined, lathe, tube


@asset("shoe cabinet", "furniture", centred_rectangle(0.32, 0.95))
def shoe_cabinet() -> Solid:
    """Cabinet with tilting doors, shoes and a bowl on it; +X is the doors' side."""
    parts = [
        box((0.27, 0.95, 0.82), (-0.02, 0.0, 0.06), "birch", 0.008),
        box((0.32, 0.95, 0.025), (0.0, 0.0, 0.88), "birch", 0.008),
        box((0.2, 0.88, 0.06), (-0.03, 0.0, 0.0), "dark lacquer", 0.0),
        lathe([(0.04, 0.0), (0.11, 0.05), (0.1, 0.05), (0.03, 0.012)], "coat blue", 18, (0.0, -0.25, 0.905)),
    ]
    for y in (-0.235, 0.235):
        for z in (0.08, 0.48):
            parts.append(box((0.02, 0.455, 0.385), (0.12, y, z), "white lacquer", 0.006))
            parts.append(box((0.016, 0.1, 0.014), (0.135, y, z + 0.32), "brass", 0.004))
    for y in (0.18, 0.29):
        parts.append(cushion((0.24, 0.08, 0.05), (0.0, y, 0.905), "coat red", 0.024))
        parts.append(cushion((0.1, 0.08, 0.06), (-0.06, y, 0.93), "coat red", 0.028))
    return joined(parts)


@asset("coat rack", "furniture", circle(0.3, count=24))
def coat_rack() -> Solid:
    """Standing rack with coats and a hat."""
    foot = tube([(0.0, 0.0, 0.14), (0.2, 0.0, 0.07), (0.28, 0.0, 0.0)], 0.018, "walnut", 8)
    hook = tube([(0.0, 0.0, 1.62), (0.12, 0.0, 1.66), (0.16, 0.0, 1.75)], 0.011, "walnut", 6)
    parts = [
        around(foot, 4, 45.0),
        cylinder(0.022, 1.78, (0.0, 0.0, 0.05), "walnut", sides=12),
        lathe([(0.0, 0.0), (0.035, 0.02), (0.0, 0.06)], "walnut", 12, (0.0, 0.0, 1.82)),
        around(hook, 4, 0.0),
    ]
    for turn, finish in ((0.0, "coat red"), (90.0, "coat tan"), (180.0, "coat blue")):
        coat = lathe([(0.13, 0.0), (0.15, 0.15), (0.11, 0.6), (0.12, 0.8), (0.03, 0.92)], finish, 12)
        folds = coat.vertices.copy()
        swing = 1 + 0.12 * np.sin(5 * np.arctan2(folds[:, 1], folds[:, 0]))
        folds[:, :2] *= swing[:, None]
        parts.append(
            Solid(folds, coat.faces, coat.materials).scaled(0.62, 1.0, 1.0).moved(0.13, 0.0, 0.74).turned(turn)
        )
    hat = lathe([(0.15, 0.0), (0.15, 0.008), (0.08, 0.02), (0.075, 0.11), (0.0, 0.12)], "coat tan", 18)
    parts.append(hat.turned(35, "x").moved(0.0, -0.17, 1.72))
    return joined(parts)


@asset("hall mirror", "furniture", centred_rectangle(0.3, 0.7), label="console")
def console() -> Solid:
    """Console with a tall mirror on the wall behind it (-X)."""
    return joined(
        [
            box((0.3, 0.7, 0.03), (0.0, 0.0, 0.8), "walnut", 0.006),
            box((0.26, 0.64, 0.12), (-0.01, 0.0, 0.68), "walnut", 0.006),
            *[
                tube([(x * 0.9, y * 0.97, 0.0), (x, y, 0.69)], (0.012, 0.018), "walnut", 8)
                for x in (-0.12, 0.1)
                for y in (-0.3, 0.3)
            ],
            box((0.03, 0.56, 1.0), (-0.13, 0.0, 0.95), "brass", 0.01),
            box((0.004, 0.5, 0.94), (-0.114, 0.0, 0.98), "mirror", 0.0),
            lathe([(0.04, 0.0), (0.06, 0.06), (0.03, 0.16), (0.04, 0.18)], "porcelain", 14, (0.02, 0.2, 0.83)),
        ]
    )
