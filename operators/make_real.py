"""Make objects of one's own of results."""

import bpy

from ..geoanalogy.blender.counting import counted
from ..geoanalogy.blender.writing.making_real import make_real
from .edit import Edit, needs_operations


class GEOANALOGY_OT_make_real(Edit, bpy.types.Operator):
    """Turn results into objects of your own, with data of their own; the operations stay, without results"""

    bl_idname = "geoanalogy.make_real"
    bl_label = "Make Real"

    @classmethod
    def poll(cls, context):
        return needs_operations(cls, context)

    def edit(self, context):
        """Turn all of them."""
        return f"{counted(make_real(context.scene), 'object')} of your own"


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_make_real)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_make_real)
