"""Plots as plain numbers: those that the houses are recorded on, and those that they are then built on."""

from __future__ import annotations

import numpy as np

import geoanalogy as ga

#: The types of houses; the plots of each have its name as their label.
TYPES = ("one-storey", "two-storey", "condominium")

#: Width and depth of the plots that each type is recorded on.
RECORDED = {
    "one-storey": ((18, 26), (20, 24), (16, 28), (22, 27), (19, 22), (24, 25), (17, 24)),
    "two-storey": ((16, 26), (18, 24), (15, 28), (20, 27), (17, 23), (22, 25), (19, 30)),
    "condominium": ((26, 30), (32, 28), (28, 34), (36, 32), (30, 29), (40, 31), (34, 36)),
}

#: Edges of a plot from its left front corner on.
EDGES = ("street", "side", "garden", "side")


def plot(label: str, name: str, width: float, depth: float, x: float, y: float, angle: float) -> ga.Polygon:
    """A plot whose left front corner is at a point, its front running at an angle; the street is before it."""
    c, s = np.cos(angle), np.sin(angle)
    ring = np.array([(0, 0), (width, 0), (width, depth), (0, depth)], float) @ np.array([[c, s], [-s, c]]) + (x, y)
    return ga.Polygon(ring, label=label, id=name, orientation=angle, segment_labels=EDGES)


def recorded(label: str) -> ga.Scene:
    """The seven plots that a type is recorded on, side by side."""
    plots, x = [], 0.0
    for i, (width, depth) in enumerate(RECORDED[label]):
        plots.append(plot(label, f"example {i + 1}", width, depth, x, 0.0, 0.0))
        x += width + 4.0
    return ga.Scene(plots)


def quarter(seed: int = 1) -> ga.Scene:
    """Thirty other plots along a street that winds, ten of each type, of sizes between and beyond the recorded ones."""
    rng = np.random.default_rng(seed)
    plots = []
    for row in (0, 1):
        at, angle = np.array([0.0, -60.0 * row]), 0.0
        for i in range(15):
            label = TYPES[(i + row) % 3]
            widths, depths = np.array(RECORDED[label]).T
            width = round(float(rng.uniform(widths.min(), widths.max() * 1.05)), 2)
            depth = round(float(rng.uniform(depths.min(), depths.max())), 2)
            along = np.array([np.cos(angle), np.sin(angle)])
            name = f"plot {15 * row + i + 1:02d}"
            # The second row lies on the other side of its street.
            corner = at + width * along * row
            plots.append(plot(label, name, width, depth, float(corner[0]), float(corner[1]), angle + np.pi * row))
            at = at + (width + 4.0) * along
            angle += float(np.radians(rng.uniform(-2.5, 2.5)))
    return ga.Scene(plots)
