"""What the scripts of the scenes share: the plan as objects, the command line, saving and rendering."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

import bpy
import numpy as np

from geoanalogy.blender import names
from geoanalogy.blender.writing.instances import clear_results
from geoanalogy.command_line import leave

from . import stage
from .edits.edit import AnyEdit
from .edits.in_blender import make_edits
from .library.meshes import mesh_of
from .library.solids import sheet
from .plans.outlines import PlanPolygon

PLAN = "Plan"
EXAMPLES = "Examples"
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


def examples_and_results(scene: bpy.types.Scene) -> list[bpy.types.Object]:
    """Every object that an edit has put into the scene, the examples first."""
    results = [item for item in scene.objects if names.KEY in item]
    return [*(o for o in stage.collection(scene, EXAMPLES).objects if o.type == "MESH"), *results]


def run(
    build: Callable[[bpy.types.Scene], np.ndarray],
    description: str,
    edits: Sequence[AnyEdit],
    height: Callable[[AnyEdit], float] = lambda _: 0.0,
    finish: Callable[[bpy.types.Scene], None] = lambda _: None,
    picture: tuple[int, int] = (1600, 1000),
    **view: float,
) -> None:
    """Command line of a scene: build it in an empty file, then make its edits, save and render as asked.

    ``build`` fills the scene and returns points (n, 3) that the camera must show, ``height`` says how high the example
    of an edit stands, ``finish`` adds what follows from the edits, ``picture`` is the size of the picture in pixels;
    ``view`` goes to :func:`.stage.camera`.
    """
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--output", type=Path, help="the .blend to write")
    parser.add_argument("--render", type=Path, help="the .png to write")
    parser.add_argument("--edits", action="store_true", help="make the scene's edits, not only its empty plan")
    parser.add_argument(
        "--examples-only", action="store_true", help="save the edits without their results: replay makes them"
    )
    parser.add_argument("--width", type=int, default=picture[0])
    parser.add_argument("--height", type=int, default=picture[1])
    parser.add_argument("--samples", type=int, default=32)
    parser.add_argument("--plan-view", action="store_true", help="look straight down, without perspective")
    # Blender passes what follows "--"; with the bpy wheel, all arguments are ours.
    arguments = parser.parse_args(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else None)
    scene = stage.clear()
    points = build(scene)
    if arguments.edits:
        holder = stage.collection(scene, EXAMPLES)
        for node in make_edits(bpy.context, edits, holder, height):
            print(f"{node.name}: {len(examples_and_results(scene))} objects", flush=True)
        finish(scene)
    stage.settings(scene, arguments.width, arguments.height, arguments.samples)
    if arguments.plan_view:
        view = {**view, "elevation": 90.0, "lens": None}
    stage.camera(scene, points, **view)
    if arguments.render:
        stage.render(scene, arguments.render)
        print(f"rendered {arguments.render}")
    if arguments.output:
        if arguments.examples_only:
            clear_results(scene)
        bpy.ops.wm.save_as_mainfile(filepath=str(arguments.output.resolve()), compress=True)
        print(f"saved {arguments.output}")
    leave(0)
