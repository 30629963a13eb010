"""Say how much the selected examples are wanted."""

import bpy
from bpy.props import FloatProperty

from ..geoanalogy.blender.counting import counted
from ..geoanalogy.blender.linked import require_editable
from ..geoanalogy.blender.rectangle_drawing import set_target
from ..geoanalogy.errors import InputError
from .edit import Edit, needs_object_mode


class GEOANALOGY_OT_set_target(Edit, bpy.types.Operator):
    """Say how much the selected examples are wanted: 1 for a place like this, 0 for never here"""

    bl_idname = "geoanalogy.set_target"
    bl_label = "Set Preference"

    target: FloatProperty(
        name="Preference", description="1 is wanted, 0 is not wanted", min=0.0, max=1.0, default=1.0, subtype="FACTOR"
    )

    @classmethod
    def poll(cls, context):
        return needs_object_mode(cls, context)

    def edit(self, context):
        """Write the preference."""
        if not context.selected_objects:
            raise InputError("nothing is selected; select the examples")
        require_editable(context.selected_objects)
        for item in context.selected_objects:
            set_target(item, round(self.target, 6))
        return f"{counted(len(context.selected_objects), 'example')} with the preference {self.target:.2f}"


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_set_target)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_set_target)
