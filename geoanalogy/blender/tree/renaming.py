"""Nodes that a user renames: their results, which carry the name of their node, follow."""

import bpy

from .. import names
from . import node_tree
from .store import tree_of


def follow_names(tree: bpy.types.NodeTree) -> None:
    """Give results the names that their nodes have now.

    Parameters
    ----------
    tree : bpy.types.NodeTree
    """
    present = {node.name for node in tree.nodes}
    for node in tree.nodes:
        before = node.get(names.CALLED)
        if before == node.name:
            continue
        # Where there still is a node of that name, this one is a copy of it, without results.
        if before is not None and before not in present:
            for scene in bpy.data.scenes:
                if tree_of(scene) == tree:
                    _rename(scene, before, node.name)
        node[names.CALLED] = node.name


def _rename(scene: bpy.types.Scene, before: str, name: str) -> None:
    for held in (*scene.collection.children_recursive, *scene.objects):
        if held.get(names.NODE) == before:
            held[names.NODE] = name
    for holder in scene.collection.children_recursive:
        if holder.get(names.NODE) == name and holder.name == before:
            holder.name = name


def register():
    """Look at names whenever a tree changes."""
    node_tree.on_linked.append(follow_names)


def unregister():
    """No longer do so."""
    node_tree.on_linked.remove(follow_names)
