"""List the relations that carry the active result."""

import bpy

from ..geoanalogy.blender.tree.explanation import explain
from .edit import Edit, needs_operations


class GEOANALOGY_OT_explain(Edit, bpy.types.Operator):
    """List the relations that put the active result where it is"""

    bl_idname = "geoanalogy.explain"
    bl_label = "Why Here?"
    bl_options = {"REGISTER"}

    @classmethod
    def poll(cls, context):
        return needs_operations(cls, context)

    def edit(self, context):
        """Find out."""
        return f"{len(explain(context, context.active_object))} relations"


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_explain)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_explain)
