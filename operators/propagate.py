"""Propagate the active object: put it wherever the surroundings are alike."""

import bpy
from bpy.props import FloatProperty, IntProperty, StringProperty

from ..geoanalogy.blender import names
from ..geoanalogy.blender.tree.recording import THRESHOLD, pose_steps
from .edit import LongEdit, needs_active_object, selected_active
from .pose_settings import MOST_OF, PoseSettings, most_per


class GEOANALOGY_OT_propagate(PoseSettings, LongEdit, bpy.types.Operator):
    """Put the active object wherever it would stand in the same relations to its surroundings"""

    bl_idname = "geoanalogy.propagate"
    bl_label = "Propagate"

    threshold: FloatProperty(
        name="Threshold", description="Least importance of a result", min=0.0, max=1.0, default=THRESHOLD
    )
    most: IntProperty(
        name="At Most",
        description="Most objects in every polygon like the example's, the example counted; 0 is any number",
        min=0,
        default=1,
    )
    most_of: StringProperty(name="In Others", description=MOST_OF)
    spacing: FloatProperty(
        name="Spacing",
        description="Least distance between two results; 0 is as near as they do not touch",
        min=0.0,
        subtype="DISTANCE",
    )

    @classmethod
    def poll(cls, context):
        return needs_active_object(cls, context)

    def steps(self, context):
        """Learn, propagate and record."""
        node = yield from pose_steps(
            context,
            selected_active(context),
            self.pose_options(),
            threshold=round(self.threshold, 6),
            max_per=most_per(self.most, self.most_of),
            spacing=self.spacing or None,
        )
        return f"{node[names.COUNT]} results"

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        for name in ("threshold", "most", "spacing"):
            layout.prop(self, name)
        if self.other_parents or not self.use_labels:
            layout.prop(self, "most_of")
        self.draw_pose_settings(layout)


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_propagate)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_propagate)
