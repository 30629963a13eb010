"""What the scripts of the scenes share: the plan as objects, the command line, saving and rendering."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

import bpy
import numpy as np

import geoanalogy as ga

from . import stage
from .edits.edit import AnyEdit
from .edits.recording import record, scene_of
from .library import ASSETS
from .library.meshes import add_asset, mesh_of
from .library.solids import sheet
from .plans.outlines import PlanPolygon

PLAN = "Plan"
PLACED = "Placed"
# The plan lies a little above the floors, so that its faces can be picked.
PLAN_HEIGHT = 0.004


def add_plan(scene: bpy.types.Scene, polygons: list[PlanPolygon], height: float = PLAN_HEIGHT) -> None:
    """Every polygon as a mesh of one face with its label, in the collection "Plan"; not rendered."""
    holder = stage.collection(scene, PLAN)
    for polygon in polygons:
        drawn = bpy.data.objects.new(polygon.id, mesh_of(polygon.id, sheet(polygon.ring, 0.0, "plan")))
        drawn.location.z = height
        drawn["ga_label"] = polygon.label
        drawn.display_type = "WIRE"
        drawn.hide_render = True
        holder.objects.link(drawn)


def recorded(polygons: list[PlanPolygon], edits: Sequence[AnyEdit]) -> list[ga.Element]:
    """What the edits place on a plan."""
    plan = scene_of(polygons)
    return record(plan, edits).apply(plan)


def add_elements(
    scene: bpy.types.Scene, elements: Iterable[ga.Element], height: Callable[[ga.Element], float] = lambda _: 0.0
) -> None:
    """An object for every element, in the collection "Placed"; ``height`` says how high it stands."""
    holder = stage.collection(scene, PLACED)
    for item in elements:
        at, angle = item.pose.position, item.pose.angle
        add_asset(ASSETS[item.mesh], holder, at, angle, height(item), mirrored=item.pose.mirrored, scale=item.scale)


def run(
    build: Callable[[bpy.types.Scene], np.ndarray],
    description: str,
    polygons: list[PlanPolygon],
    edits: Sequence[AnyEdit],
    show: Callable[[bpy.types.Scene, list[ga.Element]], None] = add_elements,
    **view: float,
) -> None:
    """Command line of a scene: build it in an empty file, then apply its edits, save and render as asked.

    ``build`` fills the scene and returns points (n, 3) that the camera must show, ``show`` adds what the edits have
    placed; ``view`` goes to :func:`.stage.camera`.
    """
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--output", type=Path, help="the .blend to write")
    parser.add_argument("--render", type=Path, help="the .png to write")
    parser.add_argument("--edits", action="store_true", help="apply the scene's edits, not only its empty plan")
    parser.add_argument("--width", type=int, default=1600)
    parser.add_argument("--height", type=int, default=1000)
    parser.add_argument("--samples", type=int, default=32)
    parser.add_argument("--plan-view", action="store_true", help="look straight down, without perspective")
    # Blender passes what follows "--"; with the bpy wheel, all arguments are ours.
    arguments = parser.parse_args(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else None)
    scene = stage.clear()
    points = build(scene)
    if arguments.edits:
        elements = recorded(polygons, edits)
        show(scene, elements)
        print(f"placed {len(elements)} objects by {len(edits)} edits")
    stage.settings(scene, arguments.width, arguments.height, arguments.samples)
    if arguments.plan_view:
        view = {**view, "elevation": 90.0, "lens": None}
    stage.camera(scene, points, **view)
    if arguments.render:
        stage.render(scene, arguments.render)
        print(f"rendered {arguments.render}")
    if arguments.output:
        bpy.ops.wm.save_as_mainfile(filepath=str(arguments.output.resolve()), compress=True)
        print(f"saved {arguments.output}")
