"""Take a line that is there already as the query."""

import bpy

from ..geoanalogy.blender.regions.queries import use_as_query
from .edit import Edit, needs_object_mode, selected_active


class GEOANALOGY_OT_use_as_query(Edit, bpy.types.Operator):
    """Take the active curve or stroke as the query: closed round a region, open along a thin shape"""

    bl_idname = "geoanalogy.use_as_query"
    bl_label = "Use Selected"

    @classmethod
    def poll(cls, context):
        return needs_object_mode(cls, context)

    def edit(self, context):
        """Choose it."""
        closed = use_as_query(context, selected_active(context))
        return f"{context.scene.geoanalogy.query.name!r} is the {'region' if closed else 'stroke'} to look for"


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_use_as_query)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_use_as_query)
