"""Reject what does not pass the threshold."""

import bpy

from ..geoanalogy.blender.tree.corrections import reject_below
from .edit import Edit, active_operation, needs_operations


class GEOANALOGY_OT_reject_below(Edit, bpy.types.Operator):
    """Keep all results of the active operation below its threshold from coming back when it is lowered"""

    bl_idname = "geoanalogy.reject_below"
    bl_label = "Reject Below Threshold"

    @classmethod
    def poll(cls, context):
        return needs_operations(cls, context)

    def edit(self, context):
        """Write the verdicts."""
        return f"{reject_below(context, active_operation(context))} rejected"


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_reject_below)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_reject_below)
