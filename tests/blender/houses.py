"""Parcels, and houses that are built on them in Blender: drawn, extruded, with windows cut into their walls."""

import bpy
import numpy as np
from flats import bridge, face, operations_tree

EXEC = "EXEC_DEFAULT"

#: Width and depth of the parcels, in a row with 4 between them.
SIZES = ((12.0, 10.0), (15.0, 10.0), (13.0, 12.0), (18.0, 11.0))

HEIGHT = 3.0


def parcels(sizes=SIZES, label="parcel"):
    """Rectangular parcels side by side, and the lower left corner of each."""
    corners, x = [], 0.0
    for i, (w, d) in enumerate(sizes):
        face(f"parcel {i}", [(0, 0), (w, 0), (w, d), (0, d)], label, at=(x, 0.0, 0.0))
        corners.append((x, 0.0))
        x += w + 4.0
    bpy.context.view_layer.update()
    return corners


def draw(label, *corners):
    """Draw rectangles with the operator: two opposite corners in the world each; they are selected afterwards."""
    rows = [{"name": "", "start": a, "end": b, "target": 1.0} for a, b in corners]
    assert bpy.ops.geoanalogy.draw_rectangles(EXEC, True, rectangles=rows, label=label) == {"FINISHED"}


def place(**settings):
    """Learn from what is selected and place; the node."""
    assert bpy.ops.geoanalogy.place(EXEC, True, **settings) == {"FINISHED"}
    return operations_tree().nodes.active


def extrude(**settings):
    assert bpy.ops.geoanalogy.extrude(EXEC, True, **settings) == {"FINISHED"}
    return operations_tree().nodes.active


def combine(**settings):
    assert bpy.ops.geoanalogy.combine(EXEC, True, **settings) == {"FINISHED"}
    return operations_tree().nodes.active


def box_of(i, corners, sizes=SIZES):
    """Where the house of a parcel belongs: 2 from its sides and its back, 3 from its front."""
    (x, y), (w, d) = corners[i], sizes[i]
    return (x + 2.0, y + 3.0, 0.0), (x + w - 2.0, y + d - 2.0, 0.0)


def houses(corners=None, examples=(0, 1)):
    """Houses on all parcels, drawn on two of them, and extruded."""
    corners = corners or parcels()
    draw("house", *(box_of(i, corners) for i in examples))
    place(most=1, any_size=True)
    return corners, extrude(label="house", height=HEIGHT, side="wall", top="flat roof")


def windows(corners, examples=(0, 1)):
    """A window in the front wall of every house, drawn on two of them, 1.5 from the left corner; cut 0.2 deep."""
    boxes = []
    for i in examples:
        (x0, y0, _), _ = box_of(i, corners)
        boxes.append(((x0 + 1.5, y0, 1.0), (x0 + 2.7, y0, 2.2)))
    draw("window", *boxes)
    node = place(most=1)
    extrude(label="window", height=0.2, inwards=True, top="glass", side="reveal")
    combine(label="window", kind="subtract")
    return node


def solids(label=None):
    """The objects that show solids and outlines, in order."""
    found = bridge("writing.masses").masses_in(bpy.context.scene)
    return [item for item in found if label in (None, item["ga_label"])]


def corners_of(item):
    """The vertices of an object in the world, shape (n, 3)."""
    bpy.context.view_layer.update()
    points = np.array([v.co for v in item.data.vertices])
    matrix = np.array(item.matrix_world)
    return points @ matrix[:3, :3].T + matrix[:3, 3]


def volume_of(item):
    """The volume of an object's mesh; its normals point outwards where it is positive."""
    points = corners_of(item)
    item.data.calc_loop_triangles()
    a, b, c = (points[[t.vertices[k] for t in item.data.loop_triangles]] for k in range(3))
    return float(np.einsum("ij,ij->", np.cross(a, b), c) / 6)


def volumes(label="house"):
    """The volumes of the solids of a label, by their keys."""
    return {item["ga_key"]: round(volume_of(item), 3) for item in solids(label)}
