"""Look at a face that is unlike the examples."""

import bpy
from bpy.props import BoolProperty, IntProperty

from ..geoanalogy.blender.reading.identity import object_of
from ..geoanalogy.blender.tree.learned import unfamiliar_of
from ..geoanalogy.blender.view import look_at
from ..geoanalogy.blender.writing.selection import select_only
from ..geoanalogy.errors import InputError
from .edit import Edit, active_operation, needs_operations


class GEOANALOGY_OT_show_face(Edit, bpy.types.Operator):
    """Look at this face; with Shift, select its object too"""

    bl_idname = "geoanalogy.show_face"
    bl_label = "Look at Face"

    index: IntProperty(name="Face", description="Its number in the list, the least familiar first", min=0)
    select: BoolProperty(name="Select", description="Select the object too that the face belongs to")

    @classmethod
    def poll(cls, context):
        return needs_operations(cls, context)

    def invoke(self, context, event):
        self.select = event.shift
        return self.execute(context)

    def edit(self, context):
        """Turn the view there."""
        faces = unfamiliar_of(active_operation(context))
        if self.index >= len(faces):
            raise InputError("the list has no such face; list the faces again")
        face = faces[self.index]
        context.scene.geoanalogy.unfamiliar_index = self.index
        if self.select:
            item = object_of(context.scene, face.name)
            if item is None:
                raise InputError(f"the face {face.name!r} has no object of its own; an operation has made it")
            select_only([item])
        look_at(context, face.ring)
        return f"{face.name}: novelty {face.novelty:.2f}"


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_show_face)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_show_face)
