"""Propagate the active object: put it wherever the surroundings are alike."""

import bpy

from ..geoanalogy.blender import names
from ..geoanalogy.blender.counting import counted
from ..geoanalogy.blender.tree.recording import pose_steps
from .edit import LongEdit, needs_active_object, selected_active
from .pose_settings import SiftedPoses


class GEOANALOGY_OT_propagate(SiftedPoses, LongEdit, bpy.types.Operator):
    """Put the active object wherever it would stand in the same relations to its surroundings"""

    bl_idname = "geoanalogy.propagate"
    bl_label = "Propagate"

    @classmethod
    def poll(cls, context):
        return needs_active_object(cls, context)

    def steps(self, context):
        """Learn, propagate and record."""
        node = yield from pose_steps(
            context,
            selected_active(context),
            self.pose_options(),
            **self.sifting(),
        )
        return counted(node[names.COUNT], "result")

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        self.draw_sifting(layout)
        self.draw_pose_settings(layout)


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_propagate)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_propagate)
