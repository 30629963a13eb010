"""Operations that several scenes share, as full copies of a scene do, and making them a scene's own."""

import re

import bpy

from ...errors import InputError
from .. import names
from .store import require_operations, tree_of

#: What Blender puts behind the name of a copy.
NUMBER = re.compile(r"\.\d{3,}$")


def sharers(scene: bpy.types.Scene) -> list[bpy.types.Scene]:
    """The other scenes with the same operations.

    Parameters
    ----------
    scene : bpy.types.Scene

    Returns
    -------
    list of bpy.types.Scene
        What is done to an operation in one of them is done in all.
    """
    tree = scene.geoanalogy.tree
    return [other for other in bpy.data.scenes if tree and other != scene and other.geoanalogy.tree == tree]


def own_tree(scene: bpy.types.Scene) -> bpy.types.NodeTree:
    """Give a scene a copy of the operations that it shares.

    Parameters
    ----------
    scene : bpy.types.Scene

    Returns
    -------
    bpy.types.NodeTree
        Its examples are the scene's own: copies, by their names, of those that are not in the scene. Where there is no
        such copy, they stay as they are, and the operations as they were learned.

    Raises
    ------
    InputError
        Where the scene has no operations, or no other scene shares them.
    """
    require_operations(scene)
    if not sharers(scene):
        raise InputError(f"no other scene shares the operations of {scene.name!r}; they are its own already")
    tree = tree_of(scene).copy()
    tree.name = f"{scene.name} operations"
    tree.use_fake_user = True
    for node in tree.nodes:
        for kept in (names.EXAMPLES, names.CONTENTS):
            for entry in (node.get(kept) or {}).values():
                if entry.get("object") is not None:
                    entry["object"] = _own(entry["object"], scene)
        if node.get(names.QUERY_OBJECT) is not None:
            node[names.QUERY_OBJECT] = _own(node[names.QUERY_OBJECT], scene)
    scene.geoanalogy.tree = tree
    return tree


def _own(item: bpy.types.Object, scene: bpy.types.Scene) -> bpy.types.Object:
    """An object of a scene: the given one, or the copy of it that is the nearest."""
    if scene in item.users_scene:
        return item
    name = NUMBER.sub("", item.name)
    copies = [
        other
        for other in scene.objects
        if NUMBER.sub("", other.name) == name and other.type == item.type and names.KEY not in other
    ]
    place = item.matrix_world.translation
    return min(copies, key=lambda other: (other.matrix_world.translation - place).length, default=item)
