"""Facades for the tests of placements: walls of any direction, with windows, drawn as meshes, curves or strokes."""

import bpy
import numpy as np
from flats import activate, bridge, link
from mathutils import Euler, Matrix, Vector

#: Turns of a wall about its lower left corner: facing the viewer, along other directions, sloped, lying down.
DIRECTIONS = {
    "south": (np.pi / 2, 0.0, 0.0),
    "east": (np.pi / 2, 0.0, np.pi / 2),
    "askew": (np.pi / 2, 0.0, 2.3),
    "sloped": (1.1, 0.0, -0.6),
    "level": (0.0, 0.0, 0.4),
}

WINDOW = (1.0, 1.4)


def frame(direction="south", at=(0.0, 0.0, 0.0)):
    """From a wall's own coordinates (x along it, y up, z towards the viewer) to the world."""
    return Matrix.Translation(at) @ Euler(DIRECTIONS[direction]).to_matrix().to_4x4()


def ring(x, y, width, height):
    return [(x, y, 0.0), (x + width, y, 0.0), (x + width, y + height, 0.0), (x, y + height, 0.0)]


def outline(name, points, label, placed, kind="mesh"):
    """A closed outline as an object of a kind, with its points in its own coordinates."""
    if kind == "mesh":
        data = bpy.data.meshes.new(name)
        data.from_pydata(points, [], [list(range(len(points)))])
    elif kind == "curve":
        data = bpy.data.curves.new(name, "CURVE")
        data.dimensions = "3D"
        spline = data.splines.new("POLY")
        spline.points.add(len(points) - 1)
        for knot, point in zip(spline.points, points, strict=True):
            knot.co = (*point, 1.0)
        spline.use_cyclic_u = True
    else:
        kinds = bpy.data.grease_pencils_v3 if hasattr(bpy.data, "grease_pencils_v3") else bpy.data.grease_pencils
        data = kinds.new(name)
        drawing = data.layers.new("Lines").frames.new(1).drawing
        drawing.add_strokes([len(points)])
        stroke = drawing.strokes[0]
        stroke.cyclic = True
        for knot, point in zip(stroke.points, points, strict=True):
            knot.position = point
    item = link(bpy.data.objects.new(name, data), label)
    item.matrix_world = placed
    return item


def wall(name, placed, columns=3, rows=2, kind="mesh"):
    """A facade with rows of windows, 3 by 3 each, and the windows' lower left corners on it."""
    outline(name, ring(0, 0, 3.0 * columns, 3.0 * rows), "facade", placed, kind)
    corners = [(3.0 * i + 1.0, 3.0 * j + 0.9) for j in range(rows) for i in range(columns)]
    for k, (x, y) in enumerate(corners):
        outline(f"{name} window {k}", ring(x, y, *WINDOW), "window", placed, kind)
    return corners


def sill(name, placed, corner, size=(1.2, 0.15), label="sill"):
    """A sill below a window: a box whose origin is the middle of its back, its front towards the viewer."""
    x, y = size[0] / 2, size[1] / 2
    mesh = bpy.data.meshes.get("Sill") or bpy.data.meshes.new("Sill")
    if not mesh.vertices:
        back = [(-x, 0.0, -y), (x, 0.0, -y), (x, 0.0, y), (-x, 0.0, y)]
        front = [(px, -0.2, pz) for px, _, pz in back]
        sides = [[i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i] for i in range(4)]
        mesh.from_pydata(back + front, [], [[0, 1, 2, 3], [7, 6, 5, 4], *sides])
    item = link(bpy.data.objects.new(name, mesh), label)
    item.matrix_world = placed @ on_wall(corner)
    return item


def on_wall(corner, size=(1.2, 0.15)):
    """Where a sill belongs below the window with that corner, in the wall's coordinates: its z is the wall's y."""
    turn = Matrix.Rotation(-np.pi / 2, 4, "X")
    return Matrix.Translation((corner[0] + 0.5, corner[1] - 0.05 - size[1] / 2, 0.0)) @ turn


def shift(along):
    return Matrix.Translation((along, 0.0, 0.0))


def street(directions=("south", "south"), kind="mesh"):
    """Two facades, the second wider; where each stands, and the windows' corners on it."""
    first = frame(directions[0])
    second = frame(directions[1], at=(14.0, 9.0, 0.0))
    return [(first, wall("house", first, 3, 2, kind)), (second, wall("villa", second, 4, 2, kind))]


def examples(first, count=3):
    """Sills below some windows of the first house, selected."""
    placed, corners = first
    made = [sill(f"Sill {i}", placed, corners[k]) for i, k in enumerate((0, 4, 2, 3)[:count])]
    activate(*made)
    return made


def points_on(placed, item):
    """The box of an object in a wall's coordinates: least and greatest x, y, z."""
    bpy.context.view_layer.update()
    to_wall = placed.inverted() @ item.matrix_world
    corners = np.array([to_wall @ Vector(v.co) for v in item.data.vertices])
    return corners.min(axis=0), corners.max(axis=0)


def expected(corner, size=(1.2, 0.15)):
    """The box of a sill below a window."""
    x, y = corner[0] + 0.5, corner[1] - 0.05
    return (x - size[0] / 2, y - size[1], 0.0), (x + size[0] / 2, y, 0.2)


def placement_node():
    """The operation that is active."""
    return bpy.context.scene.geoanalogy.tree.nodes.active


def operation():
    """The engine's operation of the active node."""
    return bridge("tree.store").engine_node(placement_node()).operation
