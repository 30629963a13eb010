"""Showing results again when what sifts them has changed."""

import bpy

from ...errors import InputError
from .. import names
from ..regions.results import show_targets
from ..regions.space_view import refresh_space
from . import node_tree
from .refresh import show
from .store import builds, tree_of, works_on_drawings
from .whole import show_whole


def show_again(context: bpy.types.Context, node: bpy.types.Node, *, unmoved: bool = False) -> None:
    """Show what a node's settings and decisions let pass, and what comes of it where solids are made of it.

    Parameters
    ----------
    context : bpy.types.Context
    node : bpy.types.Node
        Of the scene's tree.
    unmoved : bool
        Whether only the selection has changed, not where results stand.

    Raises
    ------
    InputError
        Where the ground cannot be read.
    """
    if works_on_drawings(node):
        show_targets(context.scene, node)
        refresh_space(context, node)
    elif builds(node.id_data):
        show_whole(context)
    else:
        show(context.scene, node, unmoved=unmoved)


def _show_sifted(node: bpy.types.Node) -> None:
    if tree_of(bpy.context.scene) != node.id_data:
        return
    node.pop(names.PROBLEM, None)
    try:
        show_again(bpy.context, node, unmoved=True)
    except InputError as error:
        node[names.PROBLEM] = str(error)


def _show_merged(tree: bpy.types.NodeTree) -> None:
    if tree_of(bpy.context.scene) != tree or not builds(tree):
        return
    try:
        show_whole(bpy.context)
    except InputError as error:
        tree[names.PROBLEM] = str(error)


def register():
    """Show results again when a setting that sifts them changes."""
    node_tree.on_sifted.append(_show_sifted)
    node_tree.on_merged.append(_show_merged)


def unregister():
    """No longer do so."""
    node_tree.on_merged.remove(_show_merged)
    node_tree.on_sifted.remove(_show_sifted)
