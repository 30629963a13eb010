"""Reject the selected results."""

import bpy

from ..geoanalogy.blender.corrections import decide, selected_results
from .edit import Edit, needs_operations


class GEOANALOGY_OT_reject(Edit, bpy.types.Operator):
    """Remove the selected results, and keep them from coming back"""

    bl_idname = "geoanalogy.reject"
    bl_label = "Reject"

    @classmethod
    def poll(cls, context):
        return needs_operations(cls, context)

    def edit(self, context):
        """Write the verdict."""
        return f"{decide(context, selected_results(context), 'reject')} rejected"


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_reject)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_reject)
