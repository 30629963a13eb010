"""Draw a generated city: ``python -m sample_blends.city.views CITY.blend --map NAME --output FOLDER``.

Places are in the coordinates of the map: the eye, what is in the middle of the picture, the lens in millimetres.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import bpy
import numpy as np
from mathutils import Vector

Point = tuple[float, float, float]

#: By map and view: eye, target, lens.
VIEWS: dict[str, dict[str, tuple[Point, Point, float]]] = {
    "bubenec": {
        "": ((-150.0, -420.0, 235.0), (10.0, -20.0, 0.0), 32.0),
        "_street": ((-6.0, -150.0, 2.6), (36.0, 22.0, 5.0), 24.0),
        "_houses": ((-120.0, -160.0, 38.0), (-10.0, -60.0, 0.0), 35.0),
    },
    "curves": {"": ((-180.0, -390.0, 170.0), (10.0, -20.0, 0.0), 34.0)},
    "closes": {"": ((-160.0, -390.0, 190.0), (20.0, -10.0, 0.0), 34.0)},
    "grid": {"": ((-190.0, -430.0, 190.0), (60.0, -10.0, 0.0), 34.0)},
}

#: Pixels of a picture, and samples per pixel.
SIZE, SAMPLES = (1280, 720), 12

#: Sky from the horizon up, scene-linear, and its strength; sine of the angle above the horizon where it is bluest.
HORIZON, ZENITH, STRENGTH, BLUEST = (0.60, 0.79, 1.0), (0.16, 0.38, 0.85), 0.75, 0.25

#: Metres at which the haze takes 63 % of what is seen: hardly any of the nearest houses, and all of the horizon.
VISIBILITY = 1100.0

#: Strength of the sun, W/m².
SUN = 3.6


def camera(scene: bpy.types.Scene, name: str, eye: Point, target: Point, lens: float) -> bpy.types.Object:
    """A camera that looks from one point to another."""
    data = bpy.data.cameras.new(name)
    data.lens, data.clip_end = lens, 5000.0
    made = bpy.data.objects.new(name, data)
    made.location = eye
    made.rotation_euler = Vector(np.subtract(target, eye)).to_track_quat("-Z", "Y").to_euler()
    scene.collection.objects.link(made)
    return made


def light(scene: bpy.types.Scene) -> None:
    """A sky that is bright at the horizon, and a strong sun."""
    tree = scene.world.node_tree
    background = next(node for node in tree.nodes if node.type == "BACKGROUND")
    background.inputs["Strength"].default_value = STRENGTH
    coordinates, split = tree.nodes.new("ShaderNodeTexCoord"), tree.nodes.new("ShaderNodeSeparateXYZ")
    ramp = tree.nodes.new("ShaderNodeValToRGB")
    for element, colour, position in zip(ramp.color_ramp.elements, (HORIZON, ZENITH), (0.0, BLUEST), strict=True):
        element.color, element.position = (*colour, 1.0), position
    tree.links.new(coordinates.outputs["Generated"], split.inputs["Vector"])
    tree.links.new(split.outputs["Z"], ramp.inputs["Fac"])
    tree.links.new(ramp.outputs["Color"], background.inputs["Color"])
    for lamp in (o.data for o in scene.objects if o.type == "LIGHT"):
        lamp.energy = SUN


def veil(material: bpy.types.Material) -> None:
    """Let a material fade into the colour of the horizon with the square of the distance."""
    tree = material.node_tree
    output = next((node for node in tree.nodes if node.type == "OUTPUT_MATERIAL"), None) if tree else None
    if output is None or not output.inputs["Surface"].is_linked:
        return
    surface = output.inputs["Surface"].links[0].from_socket
    value = tree.nodes.new("ShaderNodeCameraData").outputs["View Distance"]
    for operation, amount in (("DIVIDE", VISIBILITY), ("POWER", 2.0), ("MULTIPLY", -1.0), ("EXPONENT", None)):
        node = tree.nodes.new("ShaderNodeMath")
        node.operation = operation
        tree.links.new(value, node.inputs[0])
        if amount is not None:
            node.inputs[1].default_value = amount
        value = node.outputs[0]
    haze, mix = tree.nodes.new("ShaderNodeEmission"), tree.nodes.new("ShaderNodeMixShader")
    haze.inputs["Color"].default_value, haze.inputs["Strength"].default_value = (*HORIZON, 1.0), STRENGTH
    tree.links.new(value, mix.inputs[0])
    tree.links.new(haze.outputs[0], mix.inputs[1])
    tree.links.new(surface, mix.inputs[2])
    tree.links.new(mix.outputs[0], output.inputs["Surface"])


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
    for material in bpy.data.materials:
        veil(material)
    render = scene.render
    render.engine, scene.cycles.samples, scene.cycles.device = "CYCLES", SAMPLES, "CPU"
    scene.cycles.use_denoising = True
    render.resolution_x, render.resolution_y = SIZE
    render.resolution_percentage = 50 if arguments.quick else 100
    for view, (eye, target, lens) in VIEWS[arguments.map].items():
        if arguments.only in (None, view):
            scene.camera = camera(scene, f"View {view}", eye, target, lens)
            render.filepath = str(arguments.output.absolute() / f"{arguments.map}{view}.png")
            bpy.ops.render.render(write_still=True)


if __name__ == "__main__":
    main()
