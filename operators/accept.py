"""Accept the selected results."""

import bpy

from ..geoanalogy.blender.tree.corrections import decide, selected_results
from .edit import Edit, needs_operations


class GEOANALOGY_OT_accept(Edit, bpy.types.Operator):
    """Keep the selected results whatever the threshold; those that were moved stay where they are"""

    bl_idname = "geoanalogy.accept"
    bl_label = "Accept"

    @classmethod
    def poll(cls, context):
        return needs_operations(cls, context)

    def edit(self, context):
        """Write the verdict."""
        return f"{decide(context, selected_results(context), 'accept')} accepted"


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_accept)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_accept)
