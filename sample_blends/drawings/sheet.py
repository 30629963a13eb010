"""The query and what came of it, side by side: ``python -m sample_blends.drawings.sheet replayed.blend sheet.png``.

At the left the bare drawing with the first query in green and what was found in red; at the right the painted picture.
"""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path

import bpy
import numpy as np
import shapely

import geoanalogy.blender as bridge
from geoanalogy.command_line import leave
from geoanalogy.progress import run

from .. import stage

#: Colours of queries and targets over the drawing, one pair per operation.
PAIRS = (
    ((0.15, 0.65, 0.2, 0.45), (0.9, 0.15, 0.12, 0.4)),
    ((0.1, 0.6, 0.65, 0.5), (0.75, 0.2, 0.75, 0.4)),
    ((0.55, 0.6, 0.1, 0.5), (0.95, 0.5, 0.1, 0.45)),
)

#: Pixels between the two pictures.
GAP = 16


def add_fill(name: str, region: shapely.Geometry, plane: object, height: float, colour: tuple[float, ...]) -> None:
    """A region as a sheet of clear colour."""
    from geoanalogy.blender.regions.patches import triangulated

    from .build import flat_material

    corners, faces = triangulated(shapely.make_valid(region))
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(plane.to_world(np.column_stack([corners, np.full(len(corners), height)])), [], faces.tolist())
    mesh.materials.append(flat_material(name, colour))
    bpy.context.scene.collection.objects.link(bpy.data.objects.new(name, mesh))


def show_queries(scene: bpy.types.Scene) -> None:
    """The bare drawing, with queries and targets filled."""
    from geoanalogy.blender import names
    from geoanalogy.blender.regions.results import passing, targets_found
    from geoanalogy.blender.tree.store import drawing_nodes, engine_node, plane_of, tree_of

    from .build import flat_material

    for item in scene.objects:
        if item.type == "MESH":
            item.hide_render = True
    size = max(scene.objects["Paper"].dimensions)
    paper = scene.objects["Paper"].copy()
    paper.data = paper.data.copy()
    paper.data.materials[0] = flat_material("White", (1.0, 1.0, 1.0, 1.0))
    paper.hide_render = False
    scene.collection.objects.link(paper)
    for i, node in enumerate(drawing_nodes(tree_of(scene))):
        operation, plane = engine_node(node).operation, plane_of(node)
        green, red = PAIRS[i % len(PAIRS)]
        closed = node[names.QUERY_OBJECT].get(names.QUERY) == "region"
        for k, target in enumerate(passing(operation, targets_found(node))):
            outline = shapely.polygons(target.outline) if closed else stroke(target.outline, size)
            add_fill("target", outline, plane, -size * (2e-4 * k + 0.004 * i + 0.004), red)
        query = operation.region if closed else stroke(np.array(operation.query), size)
        add_fill("query", query, plane, -size * 0.003, green)


def stroke(line: np.ndarray, size: float) -> shapely.Geometry:
    """A stroke that can be seen."""
    return shapely.linestrings(line).buffer(0.006 * size)


def pixels_of(path: Path) -> np.ndarray:
    """A picture as an array (height, width, 4), bottom row first."""
    image = bpy.data.images.load(str(path))
    width, height = image.size
    values = np.empty(width * height * 4, np.float32)
    image.pixels.foreach_get(values)
    return values.reshape(height, width, 4)


def write(path: Path, pixels: np.ndarray) -> None:
    """An array as a PNG."""
    height, width = pixels.shape[:2]
    image = bpy.data.images.new("sheet", width, height, alpha=False)
    image.pixels.foreach_set(np.ascontiguousarray(pixels, np.float32).ravel())
    image.filepath_raw, image.file_format = str(path.resolve()), "PNG"
    image.save()


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("blend", type=Path)
    parser.add_argument("output", type=Path)
    parser.add_argument("--width", type=int, default=900, help="pixels of one picture")
    arguments = parser.parse_args()
    from geoanalogy.blender import names
    from geoanalogy.blender.tree.replay import replay_steps

    bridge.register()
    bpy.ops.wm.open_mainfile(filepath=str(arguments.blend.resolve()))
    scene = bpy.context.scene
    if not any(names.KEY in item for item in scene.objects):
        run(replay_steps(bpy.context))
    scene.render.resolution_percentage = round(100 * arguments.width / scene.render.resolution_x)
    with tempfile.TemporaryDirectory() as folder:
        right, left = Path(folder, "right.png"), Path(folder, "left.png")
        stage.render(scene, right)
        show_queries(scene)
        stage.render(scene, left)
        a, b = pixels_of(left), pixels_of(right)
    white = np.ones((a.shape[0], GAP, 4), np.float32)
    write(arguments.output, np.hstack([a, white, b]))
    print(f"wrote {arguments.output}")
    leave(0)


if __name__ == "__main__":
    main()
