"""Pictures of a scene: by its camera, or from above where it has none."""

from pathlib import Path

import bpy
import numpy as np
from mathutils import Matrix

from ...errors import InputError

#: Samples per pixel of a scene that was not set up for Cycles.
SAMPLES = 16

#: Part of the frame that is left free round the scene.
MARGIN = 0.04


def draw_picture(scene: bpy.types.Scene, path: Path) -> None:
    """Render a scene to a PNG, by Cycles on the processor.

    Parameters
    ----------
    scene : bpy.types.Scene
        Its settings are as before afterwards.
    path : Path

    Raises
    ------
    OSError
        Where the picture cannot be written.
    """
    lent: list[bpy.types.ID] = []
    render, image = scene.render, scene.render.image_settings
    before = (scene.camera, scene.world, render.engine, render.filepath, image.file_format)
    samples = scene.cycles.samples
    try:
        if scene.camera is None:
            lent += _camera_above(scene)
        if scene.world is None:
            lent.append(_plain_world(scene))
        if render.engine != "CYCLES":
            render.engine = "CYCLES"
            scene.cycles.samples = SAMPLES
        scene.cycles.device = "CPU"
        image.file_format = "PNG"
        render.filepath = str(path)
        bpy.ops.render.render(write_still=True, scene=scene.name)
    except RuntimeError as error:
        raise OSError(f"cannot write {path}: {str(error).strip()}") from None
    finally:
        scene.camera, scene.world, render.engine, render.filepath, image.file_format = before
        scene.cycles.samples = samples
        bpy.data.batch_remove(lent)


def _camera_above(scene: bpy.types.Scene) -> list[bpy.types.ID]:
    """A camera straight above everything that is rendered, and a sun."""
    depsgraph = bpy.context.evaluated_depsgraph_get()
    boxes = [
        np.array(i.object.bound_box) @ np.array(i.matrix_world)[:3, :3].T + np.array(i.matrix_world)[:3, 3]
        for i in depsgraph.object_instances
        if not i.object.hide_render and i.object.type in ("MESH", "CURVE", "SURFACE", "FONT", "META")
    ]
    if not boxes:
        raise InputError(f"the scene {scene.name!r} has nothing to render; add a camera and something it can see")
    points = np.vstack(boxes)
    low, high = points.min(axis=0), points.max(axis=0)
    aspect = scene.render.resolution_x / scene.render.resolution_y
    camera = bpy.data.cameras.new("From above")
    camera.type = "ORTHO"
    width = max(high[0] - low[0], (high[1] - low[1]) * aspect) * (1 + 2 * MARGIN)
    camera.ortho_scale = float(width if aspect >= 1 else width / aspect)
    rise = float(np.linalg.norm(high - low)) + 1.0
    camera.clip_end = float(high[2] - low[2]) + 2 * rise
    stand = bpy.data.objects.new("From above", camera)
    stand.matrix_world = Matrix.Translation((*((low + high) / 2)[:2], high[2] + rise))
    lamp = bpy.data.lights.new("From above", "SUN")
    lamp.energy = 3.0
    sun = bpy.data.objects.new("Sun from above", lamp)
    sun.rotation_euler = (0.6, 0.3, 0.0)
    for item in (stand, sun):
        scene.collection.objects.link(item)
    scene.camera = stand
    return [stand, sun, camera, lamp]


def _plain_world(scene: bpy.types.Scene) -> bpy.types.World:
    """A soft sky, or what no lamp reaches would be black."""
    world = bpy.data.worlds.new("From above")
    world.color = (0.8, 0.82, 0.85)
    scene.world = world
    return world
