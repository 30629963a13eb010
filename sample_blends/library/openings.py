"""Doors and windows, also in the sizes that a plan asks for."""

from __future__ import annotations

import numpy as np

from ..plans.outlines import arc, centred_rectangle
from .assets import asset
from .solids import Solid, box, cylinder, joined

DOOR_WIDTH = 0.9
WINDOW_WIDTH = 1.4
WALL = 0.12


def swing(width: float = DOOR_WIDTH, hinge: int = 1) -> np.ndarray:
    """Quarter disc that a leaf sweeps into +X: its threshold lies along y about the origin, its hinge at ±y."""
    sweep = arc((0.0, width / 2), width, 270.0, 360.0, 10)
    ring = np.vstack(((0.0, width / 2), sweep))
    return ring if hinge > 0 else (ring * (1.0, -1.0))[::-1]


def door_solid(
    width: float, height: float, wall: float, hinge: int = 1, cut: bool = False, opened: float = 78.0
) -> Solid:
    """Frame and open leaf in a wall of thickness ``wall`` whose face towards +X is at x = 0.

    ``cut`` leaves out the frame's head, for walls that are shown cut open.
    """
    post = 0.06
    parts = [
        box((wall + 0.04, post, height), (-wall / 2, side * (width / 2 - post / 2), 0.0), "white lacquer", 0.005)
        for side in (-1, 1)
    ]
    parts.append(box((wall, width, 0.012), (-wall / 2, 0.0, 0.0), "oak", 0.0))
    if not cut:
        parts.append(box((wall + 0.04, width, post), (-wall / 2, 0.0, height), "white lacquer", 0.005))
    leaf_width = width - 2 * post
    panels = [
        box((0.05, leaf_width - 0.24, 0.38 * height), (0.0, leaf_width / 2, z * height), "cream lacquer", 0.004)
        for z in (0.08, 0.54)
    ]
    leaf = [box((0.04, leaf_width, height - 0.02), (0.0, leaf_width / 2, 0.01), "white lacquer", 0.005), *panels]
    knob = cylinder(0.022, 0.16, (0.0, 0.0, -0.08), "brass", 0.006, 10).turned(90, "y")
    leaf.append(knob.moved(0.0, leaf_width - 0.07, min(1.02, height - 0.1)))
    # The leaf is built along +y from its hinge at the origin, then swung into +X about it.
    door = joined(leaf).turned(-(180.0 - opened)).moved(0.0, width / 2 - post, 0.0)
    parts.append(door if hinge > 0 else door.scaled(1.0, -1.0, 1.0))
    return joined(parts)


def window_solid(width: float, sill: float, height: float, wall: float, cut: bool = False) -> Solid:
    """Window in a wall of thickness ``wall`` whose inner face is at x = 0: sill, frame, mullion and panes."""
    frame, top = 0.07, height if cut else height - 0.07
    parts = [
        box((0.16, width + 0.08, 0.03), (0.02, 0.0, sill - 0.03), "white lacquer", 0.006),
        box((wall + 0.06, width, 0.04), (-wall / 2 - 0.03, 0.0, sill - 0.032), "sandstone", 0.004),
        box((0.07, width, frame), (-wall / 2, 0.0, sill), "white lacquer", 0.005),
        box((0.012, width, top - sill), (-wall / 2, 0.0, sill), "window glass", 0.0),
    ]
    for y in (-width / 2 + frame / 2, 0.0, width / 2 - frame / 2):
        parts.append(box((0.07, frame, top - sill), (-wall / 2, y, sill), "white lacquer", 0.005))
    if not cut:
        parts.append(box((0.07, width, frame), (-wall / 2, 0.0, top), "white lacquer", 0.005))
    return joined(parts)


@asset("door", "furniture", swing())
def door() -> Solid:
    """Door that opens into +X."""
    return door_solid(DOOR_WIDTH, 2.05, WALL)


@asset("window", "furniture", centred_rectangle(0.2, WINDOW_WIDTH))
def window() -> Solid:
    """Window; its room is on the +X side."""
    return window_solid(WINDOW_WIDTH, 0.85, 2.1, WALL)
