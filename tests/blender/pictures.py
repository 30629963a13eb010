"""Small drawings for the tests of Blender's side: leaves with a vein and a twig, and what is painted on them."""

import importlib

import bpy
import numpy as np
from conftest import ADDON
from flats import link
from mathutils import Matrix

TURN = np.linspace(0.0, 2.0 * np.pi, 60)
RING = np.stack([0.2 + 1.9 * np.cos(TURN), 1.5 * np.sin(TURN)], 1)[:-1]
PLACES = [((0.0, 0.0), 1.0, 0.0), ((6.0, 1.0), 1.3, 0.8), ((1.0, 6.0), 0.8, 2.5)]
INNER = RING * 0.4
EXEC = "EXEC_DEFAULT"

#: Planes that an illustrator draws on: from above, from the front, and tilted.
LEVEL = np.eye(4)
UPRIGHT = np.array([(1, 0, 0, 3), (0, 0, -1, 2), (0, 1, 0, 1), (0, 0, 0, 1)], float)
TILTED = np.array(Matrix.Translation((1, -2, 4)) @ Matrix.Rotation(0.7, 4, "X") @ Matrix.Rotation(0.4, 4, "Y"))


def leaf(at=(0.0, 0.0), scale=1.0, angle=0.0):
    """A lopsided leaf: its rim, which repeats its first point, a vein and a twig."""
    rim = np.stack([1.2 * np.cos(TURN) + 0.3 * np.cos(2 * TURN), 0.7 * np.sin(TURN) + 0.25 * np.cos(TURN) ** 2], 1)
    rim[-1] = rim[0]
    vein = np.stack([np.linspace(-0.8, 1.4, 12), 0.2 * np.linspace(-0.8, 1.4, 12) ** 2], 1)
    twig = np.array([(0.2, 0.0), (0.5, 0.3), (0.6, 0.5)])
    return [moved(line, at, scale, angle) for line in (rim, vein, twig)]


def moved(points, at=(0.0, 0.0), scale=1.0, angle=0.0):
    turn = np.array([(np.cos(angle), -np.sin(angle)), (np.sin(angle), np.cos(angle))])
    return scale * np.asarray(points) @ turn.T + at


def in_space(points, plane=LEVEL, height=0.0):
    """Points of a plane in the world."""
    flat = np.asarray(points, float)
    return np.column_stack([flat, np.full(len(flat), height)]) @ plane[:3, :3].T + plane[:3, 3]


def all_leaves(places=PLACES):
    return [line for place in places for line in leaf(*place)]


def curve_drawing(lines, plane=LEVEL, name="Lines"):
    """Lines as the splines of a curve."""
    item = bpy.data.objects.new(name, bridge("regions.drawings").line_curve(name, [in_space(line) for line in lines]))
    item.matrix_world = Matrix(plane.tolist())
    return link(item)


def stroke_drawing(lines, plane=LEVEL, name="Strokes"):
    """Lines as grease-pencil strokes."""
    pencils = bpy.data.grease_pencils if bpy.app.version >= (5, 0, 0) else bpy.data.grease_pencils_v3
    data = pencils.new(name)
    drawing = data.layers.new("Ink").frames.new(bpy.context.scene.frame_current).drawing
    drawing.add_strokes([len(line) for line in lines])
    points = np.vstack([in_space(line) for line in lines]).astype(np.float32)
    drawing.attributes["position"].data.foreach_set("vector", points.ravel())
    radius = drawing.attributes.get("radius") or drawing.attributes.new("radius", "FLOAT", "POINT")
    radius.data.foreach_set("value", np.full(len(points), 0.02, np.float32))
    item = bpy.data.objects.new(name, data)
    item.matrix_world = Matrix(plane.tolist())
    return link(item)


def mesh_drawing(lines, plane=LEVEL, name="Edges"):
    """Lines as the edges of a mesh; closed ones as faces."""
    points, edges, faces = [], [], []
    for line in lines:
        first, closed = len(points), np.allclose(line[0], line[-1])
        own = line[:-1] if closed else line
        points += in_space(own).tolist()
        if closed:
            faces.append(list(range(first, first + len(own))))
        else:
            edges += [(first + i, first + i + 1) for i in range(len(own) - 1)]
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points, edges, faces)
    item = bpy.data.objects.new(name, mesh)
    item.matrix_world = Matrix(plane.tolist())
    return link(item)


def draw_query(points=RING, mode="LASSO", plane=LEVEL, **settings):
    """Draw a query by the operator."""
    given = [{"name": "", "co": tuple(p), "first": i == 0} for i, p in enumerate(in_space(points, plane).tolist())]
    return bpy.ops.geoanalogy.draw_query(EXEC, True, mode=mode, points=given, **settings)


def find(**settings):
    """Find similar regions, and return the operation."""
    assert bpy.ops.geoanalogy.find_regions(EXEC, True, **settings) == {"FINISHED"}
    return operations().nodes.active


def leaves_found(plane=LEVEL, make=curve_drawing):
    """A drawing of three leaves with the two others found; the operation."""
    make(all_leaves(), plane)
    draw_query(plane=plane, name="leaf")
    return find()


def patch(plane=LEVEL, points=INNER, height=0.0, name="Patch"):
    """A mesh of one face with UVs, a material and a vertex group, on the query."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(in_space(points, plane, height).tolist(), [], [list(range(len(points)))])
    mesh.uv_layers.new(name="UVMap").uv.foreach_set("vector", (points / 4 + 0.5).ravel().astype(np.float32))
    mesh.materials.append(bpy.data.materials.new("Paint"))
    item = link(bpy.data.objects.new(name, mesh))
    item.vertex_groups.new(name="tip").add([0, 3], 0.75, "REPLACE")
    return item


def image(size=16):
    """A picture with alpha, packed."""
    made = bpy.data.images.new("paint.png", size, size, alpha=True)
    made.pixels.foreach_set(np.tile(np.array((0.8, 0.3, 0.1, 0.5), np.float32), size * size))
    made.pack()
    return made


def operations():
    return bpy.context.scene.geoanalogy.tree


def bridge(name):
    return importlib.import_module(f"{ADDON}.geoanalogy.blender.{name}")


def world_points(item):
    """The points of a mesh, a curve or a grease pencil in the world."""
    bpy.context.view_layer.update()
    return bridge("regions.contents").points_of(item)
