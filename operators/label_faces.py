"""Make surfaces of faces."""

import bpy
from bpy.props import StringProperty

from ..geoanalogy.blender.counting import counted
from ..geoanalogy.blender.writing.face_labels import label_faces
from .edit import AsksForLabel, Edit


class GEOANALOGY_OT_label_faces(AsksForLabel, Edit, bpy.types.Operator):
    """Make surfaces of the selected faces of a mesh, of any direction: operations then work on them as on walls"""

    bl_idname = "geoanalogy.label_faces"
    bl_label = "Label Faces"

    label: StringProperty(name="Label", description="Such as facade or roof; empty: they are no surfaces any more")

    @classmethod
    def poll(cls, context):
        if context.mode not in ("OBJECT", "EDIT_MESH"):
            cls.poll_message_set("Go to Object Mode or Edit Mode first")
            return False
        return True

    def edit(self, context):
        """Label them."""
        label = self.label.strip()
        count = label_faces(context.active_object, label)
        return f"{counted(count, 'face')} {f'labelled {label!r}' if label else 'without a label'}"


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_label_faces)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_label_faces)
