"""List the faces that are unlike the examples of the active operation."""

import bpy

from ..geoanalogy.blender.counting import counted
from ..geoanalogy.blender.tree.placement_recording import unfamiliar_again_steps
from .edit import LongEdit, active_operation, needs_operations


class GEOANALOGY_OT_list_unfamiliar(LongEdit, bpy.types.Operator):
    """List the faces that are unlike all examples, also those where nothing is placed: one more example helps there"""

    bl_idname = "geoanalogy.list_unfamiliar"
    bl_label = "Where to Add an Example"

    @classmethod
    def poll(cls, context):
        return needs_operations(cls, context)

    def steps(self, context):
        """Look at every face."""
        count = yield from unfamiliar_again_steps(context, active_operation(context))
        return f"{counted(count, 'face')} unlike the examples"


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_list_unfamiliar)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_list_unfamiliar)
