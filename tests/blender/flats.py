"""Small scenes for the tests of Blender's side: rooms in a row and furniture to put there."""

import importlib

import bpy
import numpy as np
from conftest import ADDON

ROOM = [(0, 0), (4, 0), (4, 3), (0, 3)]


def bridge(name):
    """A module of the bridge, from the installed extension."""
    return importlib.import_module(f"{ADDON}.geoanalogy.blender.{name}")


def engine(name=""):
    """A module of the engine, from the installed extension."""
    return importlib.import_module(f"{ADDON}.geoanalogy{'.' + name if name else ''}")


def link(item, label=None):
    bpy.context.scene.collection.objects.link(item)
    if label is not None:
        item["ga_label"] = label
    return item


def face(name, ring, label=None, at=(0.0, 0.0, 0.0)):
    """A mesh with one face."""
    mesh = bpy.data.meshes.new(name)
    points = [(*p, 0.0)[:3] for p in ring]
    mesh.from_pydata(points, [], [list(range(len(points)))])
    item = link(bpy.data.objects.new(name, mesh), label)
    item.location = at
    return item


def box(name, size, label=None, at=(0.0, 0.0, 0.0), turn=0.0):
    """A box that stands on its origin, centred in x and y."""
    x, y, z = size[0] / 2, size[1] / 2, size[2]
    low = [(-x, -y), (x, -y), (x, y), (-x, y)]
    points = [(*p, 0.0) for p in low] + [(*p, z) for p in low]
    mesh = bpy.data.meshes.new(name)
    sides = [[i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i] for i in range(4)]
    mesh.from_pydata(points, [], [[3, 2, 1, 0], [4, 5, 6, 7], *sides])
    item = link(bpy.data.objects.new(name, mesh), label)
    item.location = at
    item.rotation_euler[2] = turn
    return item


def rooms(count=3, label="bedroom"):
    """Rooms of 4 by 3 with a door each, which tells their corners apart."""
    made = []
    for i in range(count):
        made.append(face(f"room {i}", ROOM, label, at=(5.0 * i, 0.0, 0.0)))
        made.append(face(f"door {i}", [(3, 0), (3.9, 0), (3.9, 0.9), (3, 0.9)], "door", at=(5.0 * i, 0.0, 0.0)))
    return made


def bed():
    """A bed in the first room, selected and active."""
    return activate(box("Bed", (2.0, 1.0, 0.5), "bed", at=(1.0, 2.5, 0.0)))


def activate(*items):
    """Select these objects and no others; the first is active."""
    for other in bpy.context.view_layer.objects:
        other.select_set(False)
    for item in items:
        item.select_set(True)
    bpy.context.view_layer.objects.active = items[0]
    return items[0]


def operations_tree():
    return bpy.context.scene.geoanalogy.tree


def results(node=None):
    """The results in the scene, in order; those of one operation, where it is named."""
    outer = next((c for c in bpy.context.scene.collection.children if c.name.startswith("GeoAnalogy")), None)
    holders = [] if outer is None else [c for c in outer.children if node in (None, c["ga_node"])]
    return [item for holder in holders for item in holder.objects]


def placed(items=None):
    """Names and places of results, for comparing."""
    bpy.context.view_layer.update()
    return [
        (i.name, i.data.name if i.data else None, *np.array(i.matrix_world).ravel().tolist())
        for i in (results() if items is None else items)
    ]


def everything():
    """All there is in the file that a failed operator might have changed."""
    bpy.context.view_layer.update()
    objects = sorted(
        (o.name, *np.array(o.matrix_world).ravel().tolist(), *map(str, o.items())) for o in bpy.data.objects
    )
    nodes = [
        (t.name, n.name, str(n["operation"].to_dict()), n.mute, [(k.from_node.name, k.to_node.name) for k in t.links])
        for t in bpy.data.node_groups
        for n in t.nodes
        if "operation" in n
    ]
    data = sorted(f"{kind}/{d.name}" for kind in ("meshes", "curves", "collections") for d in getattr(bpy.data, kind))
    return objects, nodes, data


def reload(path):
    """Save to a file and open it again."""
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    bpy.ops.wm.open_mainfile(filepath=str(path))


def propagate(**settings):
    """Propagate the active object, and return its operation."""
    assert bpy.ops.geoanalogy.propagate("EXEC_DEFAULT", True, **settings) == {"FINISHED"}
    return operations_tree().nodes.active


def three_operations():
    """A bed and two boxes, propagated one after the other; the names of the operations in order."""
    rooms()
    bed()
    propagate()
    for i, x in enumerate((0.2, 1.0)):
        activate(box(f"Box {i}", (0.3, 0.3, 0.3), f"box {i}", at=(x, 1.7, 0)))
        propagate()
    return [node.name for node in bridge("tree.store").ordered_nodes(operations_tree())]
