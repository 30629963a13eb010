"""Draw a generated city: ``python -m sample_blends.city.views CITY.blend --map NAME --output FOLDER``.

Places are in the coordinates of the map: the eye, what is in the middle of the picture, the lens in millimetres.
"""

from __future__ import annotations

import argparse
import math
from pathlib import Path

import bpy
import numpy as np
from mathutils import Vector

from ..haze import Haze, light

Point = tuple[float, float, float]

#: By map and view: eye, target, lens.
VIEWS: dict[str, dict[str, tuple[Point, Point, float]]] = {
    "bubenec": {
        "": ((-150.0, -420.0, 235.0), (10.0, -20.0, 0.0), 32.0),
        "_street": ((-4.0, -143.0, 2.4), (36.0, 22.0, 5.0), 24.0),
        "_houses": ((-130.0, -90.0, 30.0), (-20.0, -40.0, 0.0), 32.0),
    },
    "curves": {"": ((-180.0, -390.0, 170.0), (10.0, -20.0, 0.0), 34.0)},
    "closes": {"": ((-160.0, -390.0, 190.0), (20.0, -10.0, 0.0), 34.0)},
    "grid": {"": ((-190.0, -430.0, 190.0), (60.0, -10.0, 0.0), 34.0)},
}

#: Pixels of a picture, and samples per pixel.
SIZE, SAMPLES = (1280, 720), 12

#: Metres at which the haze takes 63 % of what is seen, hardly any of the nearest houses and all of the horizon; and how
#: many times as far as what is in the middle of the picture that is at least.
VISIBILITY, BEYOND = 1100.0, 4.5


def camera(scene: bpy.types.Scene, name: str, eye: Point, target: Point, lens: float) -> bpy.types.Object:
    """A camera that looks from one point to another."""
    data = bpy.data.cameras.new(name)
    data.lens, data.clip_end = lens, 5000.0
    made = bpy.data.objects.new(name, data)
    made.location = eye
    made.rotation_euler = Vector(np.subtract(target, eye)).to_track_quat("-Z", "Y").to_euler()
    scene.collection.objects.link(made)
    return made


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("file", type=Path)
    parser.add_argument("--map", choices=VIEWS, required=True)
    parser.add_argument("--output", type=Path, required=True, help="folder of the pictures")
    parser.add_argument("--only", help="this view alone")
    parser.add_argument("--quick", action="store_true", help="small pictures")
    arguments = parser.parse_args()
    bpy.ops.wm.open_mainfile(filepath=str(arguments.file.absolute()))
    scene = bpy.context.scene
    light(scene)
    haze = Haze()
    render = scene.render
    render.engine, scene.cycles.samples, scene.cycles.device = "CYCLES", SAMPLES, "CPU"
    scene.cycles.use_denoising = True
    render.resolution_x, render.resolution_y = SIZE
    render.resolution_percentage = 50 if arguments.quick else 100
    for view, (eye, target, lens) in VIEWS[arguments.map].items():
        if arguments.only in (None, view):
            scene.camera = camera(scene, f"View {view}", eye, target, lens)
            haze.reach(max(VISIBILITY, BEYOND * math.dist(eye, target)))
            render.filepath = str(arguments.output.absolute() / f"{arguments.map}{view}.png")
            bpy.ops.render.render(write_still=True)


if __name__ == "__main__":
    main()
