"""Remove the active operation."""

import bpy

from ..geoanalogy.blender.tree.editing import neighbour_of, remove_node
from ..geoanalogy.blender.tree.evaluating import mark_stale
from ..geoanalogy.blender.tree.store import builds, recorded_nodes
from ..geoanalogy.blender.tree.whole import show_whole
from ..geoanalogy.blender.writing.instances import clear_results
from ..geoanalogy.blender.writing.masses import clear_masses
from .edit import Edit, active_operation, needs_operations


class GEOANALOGY_OT_remove_operation(Edit, bpy.types.Operator):
    """Remove the active operation and its results; the example stays"""

    bl_idname = "geoanalogy.remove_operation"
    bl_label = "Remove Operation"

    @classmethod
    def poll(cls, context):
        return needs_operations(cls, context)

    def edit(self, context):
        """Remove it; what built on it builds on what it was built on."""
        node = active_operation(context)
        name = node.name
        tree = node.id_data
        whole = builds(tree)
        mark_stale(tree, node)
        clear_results(context.scene, [name])
        beside = neighbour_of(tree, node)
        remove_node(tree, node)
        if beside is not None:
            tree.nodes.active = beside
        if whole:
            clear_masses(context.scene)
        if whole and recorded_nodes(tree):
            return f"{name} removed; {show_whole(context).text}"
        return f"{name} removed; replay to bring what followed up to date"


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_remove_operation)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_remove_operation)
