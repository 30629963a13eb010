"""What a scene needs to be looked at: a ground, a sun, a sky, and cameras that see everything."""

import math

import bpy
import numpy as np
from mathutils import Matrix
from numpy.typing import NDArray

from .shading import material

Array = NDArray[np.float64]

#: Direction that the light comes from: from the left, behind who stands before the front.
SUN = np.array([-0.45, -0.65, 0.75])

#: W/m² of the sun, its angular size in radians, and the strength and colour of the sky.
SUNSHINE, SOFTNESS, SKY, SKY_COLOUR = 2.8, math.radians(2.0), 0.5, (0.62, 0.76, 1.0, 1.0)

#: Where the cameras stand: their names, and their directions in plan in radians from the x axis.
VIEWS = {"From the front": math.radians(-78.0), "From behind": math.radians(102.0)}

#: How high the cameras look from, radians above the horizon, and their lens in millimetres.
RISE, LENS = math.radians(30.0), 60.0

#: Width of the picture in pixels, and its least and greatest height in proportion.
WIDTH, LOWEST, TALLEST = 1600, 0.25, 0.75

#: Part of the picture that is left free round everything.
MARGIN = 0.03

#: How far the ground reaches beyond everything, in proportion to the size of that.
REACH = 4.0


def furnish(
    scene: bpy.types.Scene, holder: bpy.types.Collection, points: Array, depth: float, finish: str = "ground"
) -> None:
    """Put ground, sun, sky and cameras round what stands in a scene.

    Parameters
    ----------
    scene : bpy.types.Scene
        Gets a world, its first camera, and a picture in proportion to what that sees.
    holder : bpy.types.Collection
        Of the new objects.
    points : ndarray of shape (n, 3)
        Outermost points of all that is to be seen.
    depth : float
        How far the ground lies below the origin, scene units.
    finish : str
        Material of the ground.
    """
    low, high = points.min(axis=0), points.max(axis=0)
    reach = REACH * max(float((high - low).max()), 1.0)
    (x0, y0), (x1, y1) = low[:2] - reach, high[:2] + reach
    z = min(float(low[2]), 0.0) - depth
    plane = bpy.data.meshes.new("Ground")
    plane.from_pydata([(x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z)], [], [(0, 1, 2, 3)])
    plane.materials.append(material(finish))
    holder.objects.link(bpy.data.objects.new("Ground", plane))

    lamp = bpy.data.lights.new("Sun", "SUN")
    lamp.energy, lamp.angle, lamp.color = SUNSHINE, SOFTNESS, (1.0, 0.95, 0.88)
    sun = bpy.data.objects.new("Sun", lamp)
    sun.matrix_world = _facing(SUN, high)
    holder.objects.link(sun)

    scene.world = bpy.data.worlds.new("Sky")
    if scene.world.node_tree is None:  # Blender before 5.0
        scene.world.use_nodes = True
    background = next(node for node in scene.world.node_tree.nodes if node.type == "BACKGROUND")
    background.inputs["Color"].default_value = SKY_COLOUR
    background.inputs["Strength"].default_value = SKY

    scene.view_settings.look = "AgX - Medium High Contrast"
    proportion = _proportion(points)
    scene.render.resolution_x, scene.render.resolution_y = WIDTH, round(WIDTH * proportion)
    cameras = [_camera(name, turn, points, proportion) for name, turn in VIEWS.items()]
    for camera in cameras:
        holder.objects.link(camera)
    scene.camera = cameras[0]


def _facing(back: Array, position: Array) -> Matrix:
    """Placement of a camera or a lamp, which shine and look along their -z, by the direction of their z."""
    back = back / np.linalg.norm(back)
    right = np.cross((0.0, 0.0, 1.0), back)
    right /= np.linalg.norm(right)
    placed = np.eye(4)
    placed[:3] = np.column_stack([right, np.cross(back, right), back, position])
    return Matrix(placed.tolist())


def _backwards(turn: float) -> Array:
    return np.array([math.cos(RISE) * math.cos(turn), math.cos(RISE) * math.sin(turn), math.sin(RISE)])


def _proportion(points: Array) -> float:
    """Height of a picture that the first camera's view fills, in proportion to its width."""
    axes = np.array(_facing(_backwards(next(iter(VIEWS.values()))), np.zeros(3)))[:3, :2]
    wide, high = np.ptp(points @ axes, axis=0)
    return float(np.clip(high / max(wide, 1e-9), LOWEST, TALLEST))


def _camera(name: str, turn: float, points: Array, proportion: float) -> bpy.types.Object:
    """A camera in whose picture all points lie."""
    back = _backwards(turn)
    right, above = np.array(_facing(back, np.zeros(3)))[:3, :2].T
    z = points @ back
    data = bpy.data.cameras.new(name)
    data.lens = LENS
    slope = data.sensor_width / 2 / LENS / (1 + 2 * MARGIN)
    # Of the lines of sight along the four sides of the picture, the outermost points decide. The camera stands where
    # those of two opposite sides meet, and further back for the pair that meets nearer.
    centre, distance = np.zeros(3), 1.0
    for axis, h in ((right, slope), (above, slope * proportion)):
        c = points @ axis
        most, least = float((c + z * h).max()), float((c - z * h).min())
        centre += (most + least) / 2 * axis
        distance = max(distance, (most - least) / 2 / h)
    away = distance - float(z.min())
    data.clip_start, data.clip_end = 1e-3 * max(away, 1.0), 20.0 * away + 100.0
    camera = bpy.data.objects.new(name, data)
    camera.matrix_world = _facing(back, centre + distance * back)
    return camera
