"""Delete all results."""

import bpy

from ..geoanalogy.blender import names
from ..geoanalogy.blender.tree.store import recorded_nodes, tree_of
from ..geoanalogy.blender.writing.instances import clear_results
from ..geoanalogy.blender.writing.masses import clear_masses
from .edit import Edit, needs_operations


class GEOANALOGY_OT_clear(Edit, bpy.types.Operator):
    """Delete all results; the operations stay, and Replay brings the results back"""

    bl_idname = "geoanalogy.clear"
    bl_label = "Clear Results"

    @classmethod
    def poll(cls, context):
        return needs_operations(cls, context)

    def edit(self, context):
        """Delete them."""
        clear_masses(context.scene)
        clear_results(context.scene)
        for node in recorded_nodes(tree_of(context.scene)):
            node[names.COUNT] = 0
        return "Results deleted"


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_clear)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_clear)
