"""Take the selected results to another of their places."""

import bpy

from ..geoanalogy.blender.tree.corrections import selected_results, take_on
from ..geoanalogy.errors import InputError
from .edit import Edit, needs_operations


class GEOANALOGY_OT_next_place(Edit, bpy.types.Operator):
    """Take the selected results to the next best place in their room, and after the last back to the best"""

    bl_idname = "geoanalogy.next_place"
    bl_label = "Next Place"

    step: bpy.props.IntProperty(
        name="Places Further", description="How many places further; negative goes back", default=1
    )

    @classmethod
    def description(cls, context, properties):
        """Say which way it goes."""
        if properties.step < 0:
            return "Take the selected results back to the better place in their room, and from the best to the last"
        return cls.__doc__

    @classmethod
    def poll(cls, context):
        return needs_operations(cls, context)

    def edit(self, context):
        """Pin them there."""
        taken, left = take_on(context, selected_results(context), self.step)
        if left and not taken:
            raise InputError(
                "there is no other place for what is selected; let more Candidates be kept in More Options of step 2, "
                "or move it by hand and press Accept"
            )
        return f"{taken} taken to another place" + (f", {left} without any other" if left else "")


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_next_place)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_next_place)
