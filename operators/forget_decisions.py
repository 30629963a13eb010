"""Take back what was accepted and rejected."""

import bpy

from ..geoanalogy.blender.regions.decisions import forget_regions
from ..geoanalogy.blender.tree.placement_recording import forgotten_steps
from ..geoanalogy.blender.tree.store import works_on_drawings
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
        node = active_operation(context)
        if works_on_drawings(node):
            return f"{forget_regions(context, node)} decisions taken back"
        count = yield from forgotten_steps(context, node)
        return f"{count} decisions taken back"


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_forget_decisions)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_forget_decisions)
