"""Reject the selected results."""

import bpy

from ..geoanalogy.blender import names
from ..geoanalogy.blender.tree.corrections import selected_results
from ..geoanalogy.blender.tree.placement_recording import rejected_steps
from ..geoanalogy.blender.tree.store import tree_of
from .edit import LongEdit, needs_operations


class GEOANALOGY_OT_reject(LongEdit, bpy.types.Operator):
    """Remove the selected results, and keep them from coming back; what was learned from examples is learned again"""

    bl_idname = "geoanalogy.reject"
    bl_label = "Reject"

    @classmethod
    def poll(cls, context):
        return needs_operations(cls, context)

    def steps(self, context):
        """Write the verdict; what is learned from it may take away others, so say how many are left."""
        items = selected_results(context)
        operations = {item[names.NODE] for item in items}
        count = yield from rejected_steps(context, items)
        nodes = tree_of(context.scene).nodes
        return f"{count} rejected, {sum(int(nodes[name].get(names.COUNT, 0)) for name in operations)} left"


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_reject)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_reject)
