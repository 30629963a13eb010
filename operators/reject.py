"""Reject the selected results."""

import bpy

from ..geoanalogy.blender.tree.corrections import selected_results
from ..geoanalogy.blender.tree.placement_recording import rejected_steps
from .edit import LongEdit, needs_operations


class GEOANALOGY_OT_reject(LongEdit, bpy.types.Operator):
    """Remove the selected results, and keep them from coming back; what was learned from examples is learned again"""

    bl_idname = "geoanalogy.reject"
    bl_label = "Reject"

    @classmethod
    def poll(cls, context):
        return needs_operations(cls, context)

    def steps(self, context):
        """Write the verdict."""
        count = yield from rejected_steps(context, selected_results(context))
        return f"{count} rejected"


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_reject)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_reject)
