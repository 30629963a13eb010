"""The stage that all scenes share: sun, soft sky, ground, cameras that frame what there is, render settings."""

from __future__ import annotations

import math
from pathlib import Path

import bpy
import numpy as np
from mathutils import Matrix

from .library.meshes import add_solid
from .library.solids import sheet
from .plans.outlines import rectangle

# The sun stands to the left behind the viewer's back, so that shadows fall to the right and away.
SUN_TURN, SUN_HEIGHT = math.radians(-125.0), math.radians(48.0)
SKY = ((0.0, (0.20, 0.19, 0.18)), (0.48, (0.62, 0.58, 0.52)), (0.55, (0.86, 0.88, 0.92)), (1.0, (0.38, 0.55, 0.85)))


def clear() -> bpy.types.Scene:
    """An empty file of metric scale and its scene."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.unit_settings.system = "METRIC"
    return scene


def collection(scene: bpy.types.Scene, name: str) -> bpy.types.Collection:
    """The scene's collection of that name, made at its first use."""
    existing = scene.collection.children.get(name)
    if existing is not None:
        return existing
    made = bpy.data.collections.new(name)
    scene.collection.children.link(made)
    return made


def light(scene: bpy.types.Scene, sun: float = 3.6, sky: float = 0.65, softness: float = 4.0) -> None:
    """Sun of a strength in W/m² and an angular size in degrees, and a sky that is bright at the horizon."""
    lamp = bpy.data.lights.new("Sun", "SUN")
    lamp.energy = sun
    lamp.angle = math.radians(softness)
    lamp.color = (1.0, 0.95, 0.88)
    stand = bpy.data.objects.new("Sun", lamp)
    stand.rotation_euler = (0.0, math.pi / 2 - SUN_HEIGHT, SUN_TURN + math.pi)
    stand.rotation_mode = "XYZ"
    direction = np.array(
        (math.cos(SUN_HEIGHT) * math.cos(SUN_TURN), math.cos(SUN_HEIGHT) * math.sin(SUN_TURN), math.sin(SUN_HEIGHT))
    )
    stand.matrix_world = _looking(-direction, np.zeros(3))
    collection(scene, "Stage").objects.link(stand)

    world = bpy.data.worlds.new("Sky")
    scene.world = world
    if world.node_tree is None:  # Blender before 5.0
        world.use_nodes = True
    tree = world.node_tree
    tree.nodes.clear()
    output = tree.nodes.new("ShaderNodeOutputWorld")
    background = tree.nodes.new("ShaderNodeBackground")
    background.inputs["Strength"].default_value = sky
    coordinates = tree.nodes.new("ShaderNodeTexCoord")
    split = tree.nodes.new("ShaderNodeSeparateXYZ")
    half = tree.nodes.new("ShaderNodeMath")
    half.operation = "MULTIPLY_ADD"
    half.inputs[1].default_value = half.inputs[2].default_value = 0.5
    ramp = tree.nodes.new("ShaderNodeValToRGB")
    elements = ramp.color_ramp.elements
    while len(elements) < len(SKY):
        elements.new(0.5)
    for element, (position, colour) in zip(elements, SKY, strict=True):
        element.position = position
        element.color = (*colour, 1.0)
    tree.links.new(coordinates.outputs["Generated"], split.inputs["Vector"])
    tree.links.new(split.outputs["Z"], half.inputs[0])
    tree.links.new(half.outputs[0], ramp.inputs["Fac"])
    tree.links.new(ramp.outputs["Color"], background.inputs["Color"])
    tree.links.new(background.outputs["Background"], output.inputs["Surface"])


def softbox(scene: bpy.types.Scene, position: np.ndarray, target: np.ndarray, size: float, power: float) -> None:
    """A square lamp of a size in metres and a power in watts that shines on a target."""
    lamp = bpy.data.lights.new("Softbox", "AREA")
    lamp.size = size
    lamp.energy = power
    stand = bpy.data.objects.new("Softbox", lamp)
    stand.matrix_world = _looking(np.asarray(target, dtype=float) - position, np.asarray(position, dtype=float))
    collection(scene, "Stage").objects.link(stand)


def ground(scene: bpy.types.Scene, points: np.ndarray, finish: str, margin: float = 60.0, z: float = -0.02) -> None:
    """A wide plane below everything."""
    (x0, y0), (x1, y1) = points[:, :2].min(axis=0) - margin, points[:, :2].max(axis=0) + margin
    add_solid("Ground", sheet(rectangle(x0, y0, x1, y1), z, finish), collection(scene, "Stage"))


def _looking(direction: np.ndarray, position: np.ndarray, up: tuple[float, float, float] = (0.0, 0.0, 1.0)) -> Matrix:
    """Placement of a camera or a lamp (it looks along its -Z)."""
    back = -direction / np.linalg.norm(direction)
    right = np.cross(up, back)
    if np.linalg.norm(right) < 1e-9:  # straight down: the picture's up is the plan's y
        right = np.array((1.0, 0.0, 0.0))
    right /= np.linalg.norm(right)
    above = np.cross(back, right)
    placed = np.eye(4)
    placed[:3, 0], placed[:3, 1], placed[:3, 2], placed[:3, 3] = right, above, back, position
    return Matrix(placed.tolist())


def camera(
    scene: bpy.types.Scene,
    points: np.ndarray,
    elevation: float = 52.0,
    turn: float = -90.0,
    lens: float | None = 70.0,
    margin: float = 0.04,
    name: str = "Camera",
) -> bpy.types.Object:
    """A camera that frames all ``points`` (n, 3), and makes it the scene's.

    ``elevation`` and ``turn`` (degrees) say where the camera stands: 90 is straight above, a turn of -90 is before the
    plan's lower edge. ``lens`` in millimetres, None for an orthographic view. Set the resolution first: it gives the
    shape of the frame.
    """
    e, a = math.radians(elevation), math.radians(turn)
    towards = np.array((math.cos(e) * math.cos(a), math.cos(e) * math.sin(a), math.sin(e)))
    placed = np.array(_looking(-towards, np.zeros(3)))
    right, above = placed[:3, 0], placed[:3, 1]
    x, y, z = points @ right, points @ above, points @ towards
    aspect = scene.render.resolution_x / scene.render.resolution_y
    data = bpy.data.cameras.new(name)
    depth = float(z.max() - z.min())
    if lens is None:
        data.type = "ORTHO"
        centre = np.array(((x.min() + x.max()) / 2, (y.min() + y.max()) / 2))
        size = max(float(np.ptp(x)), float(np.ptp(y)) * aspect) * (1 + 2 * margin)
        data.ortho_scale = size if aspect >= 1 else size / aspect
        distance = depth + size
    else:
        data.lens = lens
        half = (
            np.array((1.0, 1.0 / aspect) if aspect >= 1 else (aspect, 1.0))
            * data.sensor_width
            / 2
            / lens
            / (1 + 2 * margin)
        )
        # Of the lines of sight along the frame's four sides, the outermost points decide; the camera stands where
        # those of opposite sides meet, and further back for the pair that meets nearer.
        reach = [((c + z * h).max(), (c - z * h).min()) for c, h in ((x, half[0]), (y, half[1]))]
        centre = np.array([(high + low) / 2 for high, low in reach])
        distance = max((high - low) / 2 / h for (high, low), h in zip(reach, half, strict=True))
    position = centre[0] * right + centre[1] * above
    position = position + (distance + (float(z.max()) if lens is None else 0.0)) * towards
    data.clip_start, data.clip_end = 1e-3 * max(1.0, distance), 20.0 * distance + 100.0
    stand = bpy.data.objects.new(name, data)
    stand.matrix_world = _looking(-towards, position)
    collection(scene, "Stage").objects.link(stand)
    scene.camera = stand
    return stand


def settings(scene: bpy.types.Scene, width: int = 1600, height: int = 1000, samples: int = 48) -> None:
    """Cycles on the processor, few samples, always the same noise, cleaned where the build can."""
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = samples
    scene.cycles.use_adaptive_sampling = True
    scene.cycles.seed = 0
    scene.cycles.max_bounces = 6
    scene.cycles.caustics_reflective = scene.cycles.caustics_refractive = False
    scene.cycles.use_denoising = _can_denoise(scene)
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "PNG"
    scene.view_settings.view_transform = "AgX"
    scene.view_settings.look = "AgX - Medium High Contrast"
    scene.view_settings.exposure = 0.15


def _can_denoise(scene: bpy.types.Scene) -> bool:
    try:
        scene.cycles.denoiser = "OPENIMAGEDENOISE"
    except TypeError:  # a build without it does not offer the choice
        return False
    return True


def render(scene: bpy.types.Scene, path: str | Path) -> None:
    """Render the scene's camera to a PNG."""
    scene.render.filepath = str(Path(path).resolve())
    bpy.ops.render.render(write_still=True, scene=scene.name)
