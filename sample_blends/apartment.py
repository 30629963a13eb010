"""The empty apartment floor of figure 4.10: ``python sample_blends/apartment.py --output apartment.blend``."""

from __future__ import annotations

import sys
from pathlib import Path

import bpy
import numpy as np
import shapely

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from sample_blends import building, stage
from sample_blends.edits.apartment import EDITS
from sample_blends.library.meshes import add_solid
from sample_blends.library.openings import door_solid, window_solid
from sample_blends.library.regions import standing
from sample_blends.library.solids import Solid, box, joined, sheet
from sample_blends.plans import apartment as plan
from sample_blends.plans.outlines import rectangle

# The walls are cut open at this height, so that the rooms can be seen.
CUT = 1.3
WINDOW_SILL = 0.8
FLOORS = {
    "bedroom": "parquet",
    "living room": "dark parquet",
    "kitchen": "kitchen tiles",
    "bathroom": "bath tiles",
    "toilet": "toilet tiles",
    "closet": "closet boards",
    "hall": "hall stone",
    "corridor": "corridor carpet",
    "stairwell": "granite",
}
# Between corridor and stairwell there is no door.
_ARCHWAY = rectangle(20.3, 12 - 2 * plan.HALF_WALL, 24.7, 12 + 2 * plan.HALF_WALL)
_JOINT = 0.01


def _union(rings: list[np.ndarray]) -> shapely.Geometry:
    return shapely.unary_union([shapely.Polygon(ring) for ring in rings])


def walls() -> Solid:
    """All walls, cut at :data:`CUT`, with openings for doors and windows."""
    inside = shapely.unary_union(
        [shapely.Polygon(ring).buffer(1e-4, join_style="mitre") for ring in plan.centre_lines().values()]
    )
    shell = inside.buffer(plan.FACADE, join_style="mitre")
    thickness = plan.HALF_WALL + plan.FACADE
    solid = shell.difference(_union([room.ring for room in plan.rooms()]))
    doorways = [door.outline(-2 * plan.HALF_WALL - _JOINT, _JOINT) for door in plan.doors()]
    solid = solid.difference(_union([*doorways, _ARCHWAY]))
    panes = [window.outline(-thickness - _JOINT, _JOINT) for window in plan.windows()]
    panes += [_strip(line, -plan.FACADE - _JOINT, plan.HALF_WALL + _JOINT) for line in plan.bay_lines().values()]
    rim = shell.exterior

    def side(middle: np.ndarray) -> str:
        return "facade" if rim.distance(shapely.Point(middle)) < 1e-3 else "wall"

    above = solid.difference(_union(panes))
    return joined(
        (standing(solid, 0.0, WINDOW_SILL, side, "wall"), standing(above, WINDOW_SILL, CUT, side, "wall cut"))
    )


def _strip(line: np.ndarray, low: float, high: float) -> np.ndarray:
    """Ring between two offsets of a bay's line, without its ends."""
    near, far = (plan.offset_line(line, depth)[1:-1] for depth in (low, high))
    return np.vstack((near, far[::-1]))


def _bay_window(line: np.ndarray) -> Solid:
    glass = standing(
        shapely.Polygon(_strip(line, -0.1, -0.085)), WINDOW_SILL, CUT - 0.02, "window glass", "window glass"
    )
    sill = standing(
        shapely.Polygon(_strip(line, -plan.FACADE, plan.HALF_WALL + 0.1)),
        WINDOW_SILL,
        WINDOW_SILL + 0.03,
        "white lacquer",
        "white lacquer",
    )
    top = standing(shapely.Polygon(_strip(line, -0.13, -0.05)), CUT - 0.05, CUT, "white lacquer", "white lacquer")
    posts = [
        box((0.08, 0.08, CUT - WINDOW_SILL), (x, y, WINDOW_SILL), "white lacquer", 0.004)
        for x, y in plan.offset_line(line, -0.09)[1:-1:2]
    ]
    return joined((glass, sill, top, *posts))


def openings() -> Solid:
    """Leaves and frames of all doors and windows, in one piece."""
    made = []
    for door in plan.doors():
        leaf = door_solid(door.width, CUT - 0.02, 2 * plan.HALF_WALL, door.hinge, cut=True)
        made.append(leaf.turned(np.degrees(door.angle)).moved(*door.position))
    for window in plan.windows():
        pane = window_solid(window.width, WINDOW_SILL, CUT, plan.HALF_WALL + plan.FACADE, cut=True)
        made.append(pane.turned(np.degrees(window.angle)).moved(*window.position))
    made += [_bay_window(line) for line in plan.bay_lines().values()]
    return joined(made)


def stairs() -> Solid:
    """A flight up to a landing, and the lift beside it."""
    parts = []
    steps, run, rise = 9, 0.3, CUT / 9
    for i in range(steps):
        parts.append(box((1.9, run + 0.02, rise * (i + 1)), (21.2, 13.4 + run * i, 0.0), "marble", 0.008))
    parts.append(box((4.86, 17.94 - 16.0, CUT), (22.5, (17.94 + 16.0) / 2, 0.0), "marble", 0.008))
    for x in (20.3, 22.1):
        for i in range(0, steps, 2):
            parts.append(box((0.03, 0.03, 0.8), (x, 13.4 + run * i, rise * (i + 1)), "black metal", 0.0))
    parts.append(box((1.9, 1.9, CUT), (23.85, 14.6, 0.0), "grey lacquer", 0.01))
    parts.append(box((1.7, 1.7, 0.01), (23.85, 14.6, CUT), "wall cut", 0.0))
    for x in (23.5, 24.2):
        parts.append(box((0.66, 0.04, CUT - 0.1), (x, 13.64, 0.0), "steel", 0.006))
    return joined(parts)


def build(scene: bpy.types.Scene) -> np.ndarray:
    """Fill an empty scene; returns the points that a view must show."""
    holder = stage.collection(scene, "Building")
    add_solid("Walls", walls(), holder)
    add_solid("Doors and windows", openings(), holder)
    add_solid("Stairs", stairs(), holder)
    for room in plan.rooms():
        floor = add_solid(f"{room.id} floor", sheet(room.ring, 0.0, FLOORS[room.label]), holder)
        floor.hide_select = True
    slab = shapely.unary_union(
        [shapely.Polygon(ring).buffer(plan.FACADE, join_style="mitre") for ring in plan.centre_lines().values()]
    )
    add_solid("Slab", standing(slab.buffer(0.05, join_style="mitre"), -0.3, -0.005, "facade", "oak"), holder)
    building.add_plan(scene, plan.plan())
    stage.light(scene)
    corners = np.array([(x, y, z) for x, y in plan.outline() for z in (-0.3, CUT)])
    stage.ground(scene, corners, "pavement", z=-0.3)
    return corners


if __name__ == "__main__":
    building.run(build, __doc__, EDITS, elevation=58.0, lens=85.0, margin=0.02)
