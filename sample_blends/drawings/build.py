"""Draw a picture in Blender and record its edits: ``python -m sample_blends.drawings.build fish --output fish.blend``.

The .blend holds the lines as Bézier curves, the query, its image and the recorded operation of every edit, without the
results: replaying makes those.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

import bpy
import numpy as np
from scipy.ndimage import gaussian_filter1d

import geoanalogy.blender as bridge
from geoanalogy.command_line import leave
from geoanalogy.progress import run

from .. import stage
from .lines import Stroke
from .picture import Edit, Picture, painted
from .truth import FOUND, options_of, picture_of

#: Pixels of the longer side of a background, which is soft, and of a rendered picture.
BACKGROUND, RENDERED = 480, 1200

#: Custom property of a query with the outlines of all places where its edit belongs, as JSON.
PLACES = "places"

#: What the frame leaves of the sheet on each side, as a share of it: no edge of the paper shows.
CROPPED = 0.002

#: Widths of a pen at the ends of a line and where it is pressed most, as shares of the stroke's.
LIGHT, HEAVY = 0.4, 1.25

#: Depth of the paper below the lines, in sizes of the sheet: below all images.
PAPER = 0.05


def line_object(picture: Picture, holder: bpy.types.Collection) -> bpy.types.Object:
    """All lines of a picture as one curve of Bézier splines with a round pen."""
    curve = bpy.data.curves.new("Lines", "CURVE")
    curve.dimensions = "3D"
    curve.bevel_depth = picture.pen
    curve.bevel_resolution = 1
    for stroke in picture.strokes:
        spline = curve.splines.new("BEZIER")
        spline.bezier_points.add(len(stroke.points) - 1)
        left, right = stroke.handles()
        for key, points in (("co", stroke.points), ("handle_left", left), ("handle_right", right)):
            flat = np.column_stack([points, np.zeros(len(points))]).ravel()
            spline.bezier_points.foreach_set(key, flat.astype(np.float32))
        spline.bezier_points.foreach_set("radius", (stroke.width * pressure(stroke)).astype(np.float32))
        spline.use_cyclic_u = stroke.closed
        spline.resolution_u = 12
    curve.materials.append(flat_material("Ink", (*picture.ink, 1.0)))
    item = bpy.data.objects.new("Lines", curve)
    holder.objects.link(item)
    return item


def pressure(stroke: Stroke) -> np.ndarray:
    """How hard the pen is pressed at the points of a stroke: more in the middle of a line than at its ends, and going
    down more than going up.
    """
    path = np.vstack([stroke.points, stroke.points[:1]]) if stroke.closed else stroke.points
    run = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
    share = (run / max(run[-1], 1e-12))[: len(stroke.points)]
    if not stroke.closed:
        return LIGHT + (HEAVY - LIGHT) * np.sqrt(np.sin(np.pi * np.clip(share, 0.0, 1.0)).clip(0.0))
    heading = np.gradient(stroke.points, axis=0) if len(path) > 3 else np.zeros((len(share), 2))
    down = -heading[:, 1] / np.maximum(np.linalg.norm(heading, axis=1), 1e-12)
    return 1.0 + (HEAVY - 1.0) * gaussian_filter1d(down, 2.0, mode="wrap")


def flat_material(name: str, colour: tuple[float, float, float, float]) -> bpy.types.Material:
    """A material that shines in one colour, as flat as ink; sRGB, clear where alpha says."""
    made = bpy.data.materials.new(name)
    if made.node_tree is None:  # Blender before 5.0
        made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    light, clear, mix, output = (
        tree.nodes.new(f"ShaderNode{kind}") for kind in ("Emission", "BsdfTransparent", "MixShader", "OutputMaterial")
    )
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in colour[:3]]
    light.inputs["Color"].default_value = (*linear, 1.0)
    mix.inputs[0].default_value = colour[3]
    tree.links.new(clear.outputs[0], mix.inputs[1])
    tree.links.new(light.outputs[0], mix.inputs[2])
    tree.links.new(mix.outputs[0], output.inputs["Surface"])
    made.diffuse_color = colour
    return made


def image_of(name: str, rgba: np.ndarray) -> bpy.types.Image:
    """An image packed into the file as a PNG."""
    height, width = rgba.shape[:2]
    image = bpy.data.images.new(f"{name}.png", width, height, alpha=True)
    image.pixels.foreach_set(np.ascontiguousarray(rgba, dtype=np.float32).ravel())
    image.file_format = "PNG"
    image.pack()
    return image


def add_paper(picture: Picture, scene: bpy.types.Scene) -> None:
    """The background, below everything."""
    from geoanalogy.blender.regions.patches import image_material

    low, high = np.array(picture.low), np.array(picture.high)
    image = image_of("paper", painted(picture.background, low, high, BACKGROUND))
    mesh = bpy.data.meshes.new("Paper")
    (x0, y0), (x1, y1) = low, high
    mesh.from_pydata([(x0, y0, 0), (x1, y0, 0), (x1, y1, 0), (x0, y1, 0)], [], [(0, 1, 2, 3)])
    layer = mesh.uv_layers.new(name="UVMap")
    layer.uv.foreach_set("vector", np.array([0, 0, 1, 0, 1, 1, 0, 1], np.float32))
    material = image_material(image)
    material.node_tree.nodes["Image Texture"].interpolation = "Cubic"
    mesh.materials.append(material)
    item = bpy.data.objects.new("Paper", mesh)
    item.location.z = -PAPER * float(np.linalg.norm(high - low))
    stage.collection(scene, "Stage").objects.link(item)


def mistaken(edit: Edit, node: bpy.types.Node) -> list[bpy.types.Object]:
    """The results that an artist would reject: those that are none of the places where the edit belongs."""
    from geoanalogy.blender import names
    from geoanalogy.blender.regions.results import passing, targets_found
    from geoanalogy.blender.tree.store import engine_node

    wrong = set()
    for target in passing(engine_node(node).operation, targets_found(node)):
        there = [truth(np.asarray(edit.query)) for truth in edit.truth]
        off = [np.median(np.linalg.norm(target.outline[: len(t)] - t, axis=1)) for t in there]
        size = [np.linalg.norm(np.ptp(t, axis=0)) for t in there]
        if np.min(np.array(off) / size) >= FOUND:
            wrong.add(target.key)
    shown = (item for item in bpy.context.scene.objects if item.get(names.NODE) == node.name)
    return [item for item in shown if item[names.KEY] in wrong]


def record(edit: Edit) -> bpy.types.Node:
    """Make an edit as a user does: draw the query, find what is like it, lay the image."""
    from geoanalogy.blender.regions import queries as region_queries
    from geoanalogy.blender.regions import recording as region_recording
    from geoanalogy.blender.tree.corrections import decide

    context = bpy.context
    points = np.column_stack([edit.query, np.zeros(len(edit.query))])
    query = region_queries.add_query(context, [points], edit.closed, name=edit.name)
    query[PLACES] = json.dumps([np.round(truth(np.asarray(edit.query)), 4).tolist() for truth in edit.truth])
    steps = region_recording.region_steps(context, query, options_of(edit))
    node = run(steps)
    wrong = mistaken(edit, node)
    if wrong:
        decide(context, wrong, "reject")
    low, high = np.array(edit.region.bounds).reshape(2, 2)
    image = image_of(edit.name, painted(edit.paint, low, high, edit.pixels))
    run(region_recording.image_steps(context, node, image))
    return node


def build(picture: Picture) -> bpy.types.Scene:
    """An empty file filled with a picture and its edits."""
    scene = stage.clear()
    bridge.register()
    holder = stage.collection(scene, "Drawing")
    line_object(picture, holder)
    scene.geoanalogy.drawing = holder
    add_paper(picture, scene)
    for edit in picture.edits:
        node = record(edit)
        print(f"{picture.name}, {edit.name}: {node['count']} regions painted", flush=True)
    extent = np.array(picture.high) - picture.low
    width, height = np.round(RENDERED * extent / extent.max()).astype(int)
    stage.settings(scene, int(width), int(height), 32)
    scene.cycles.transparent_max_bounces = 64
    scene.cycles.use_denoising = False
    scene.view_settings.view_transform = "Standard"
    scene.view_settings.look = "None"
    scene.view_settings.exposure = 0.0
    corners = np.array([(*picture.low, 0.0), (*picture.high, 0.0)])
    stage.camera(scene, corners, elevation=90.0, lens=None, margin=-CROPPED)
    scene.world = bpy.data.worlds.new("Plain")
    return scene


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scene")
    parser.add_argument("--output", type=Path, required=True)
    parser.add_argument("--painted", type=Path, help="write the file with what has been found here too")
    arguments = parser.parse_args()
    from geoanalogy.blender import names
    from geoanalogy.blender.tree.store import drawing_nodes, tree_of
    from geoanalogy.blender.writing.instances import clear_results

    scene = build(picture_of(arguments.scene))
    if arguments.painted is not None:
        bpy.ops.wm.save_as_mainfile(filepath=str(arguments.painted.resolve()), compress=True, copy=True)
    clear_results(scene)
    for node in drawing_nodes(tree_of(scene)):
        node.pop(names.MATCHES, None)
    bpy.ops.outliner.orphans_purge(do_recursive=True)
    bpy.ops.wm.save_as_mainfile(filepath=str(arguments.output.resolve()), compress=True)
    print(f"saved {arguments.output}")
    leave(0)


if __name__ == "__main__":
    sys.exit(main())
