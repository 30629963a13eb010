"""Take back what was accepted and rejected."""

import bpy

from ..geoanalogy.blender.corrections import forget_all
from .edit import Edit, active_operation, needs_operations


class GEOANALOGY_OT_forget_decisions(Edit, bpy.types.Operator):
    """Take back everything accepted, rejected and moved of the active operation"""

    bl_idname = "geoanalogy.forget_decisions"
    bl_label = "Forget Decisions"

    @classmethod
    def poll(cls, context):
        return needs_operations(cls, context)

    def edit(self, context):
        """Take the verdicts back."""
        return f"{forget_all(context, active_operation(context))} decisions taken back"


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_forget_decisions)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_forget_decisions)
