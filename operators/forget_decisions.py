"""Take back what was accepted and rejected."""

import bpy

from ..geoanalogy.blender.tree.placement_recording import forgotten_steps
from .edit import LongEdit, active_operation, needs_operations


class GEOANALOGY_OT_forget_decisions(LongEdit, bpy.types.Operator):
    """Take back everything accepted, rejected and moved of the active operation"""

    bl_idname = "geoanalogy.forget_decisions"
    bl_label = "Forget Decisions"

    @classmethod
    def poll(cls, context):
        return needs_operations(cls, context)

    def steps(self, context):
        """Take the verdicts back."""
        count = yield from forgotten_steps(context, active_operation(context))
        return f"{count} decisions taken back"


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_forget_decisions)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_forget_decisions)
