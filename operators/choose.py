"""Propagate in every scope one of the selected objects, by lot."""

import bpy
from bpy.props import FloatProperty, IntProperty, StringProperty

from ..geoanalogy.blender import names
from ..geoanalogy.blender.tree.recording import THRESHOLD, choice_steps
from .edit import LongEdit, needs_object_mode
from .pose_settings import PoseSettings


class GEOANALOGY_OT_choose(PoseSettings, LongEdit, bpy.types.Operator):
    """Put one of the selected objects, chosen by lot, into every polygon like the one they are in"""

    bl_idname = "geoanalogy.choose"
    bl_label = "Propagate One of Several"

    scope: StringProperty(
        name="Scope",
        description="Label of the polygons that get one choice each; empty: the label of the example's polygon",
    )
    threshold: FloatProperty(
        name="Threshold", description="Least importance of a result", min=0.0, max=1.0, default=THRESHOLD
    )
    most: IntProperty(name="At Most per Polygon", description="The example counted; 0 is any number", min=0, default=1)
    seed: IntProperty(name="Seed", description="For other choices", min=0)

    @classmethod
    def poll(cls, context):
        return needs_object_mode(cls, context)

    def steps(self, context):
        """Learn, choose, propagate and record."""
        node = yield from choice_steps(
            context,
            sorted(context.selected_objects, key=lambda item: item.name),
            self.pose_options(),
            scope=self.scope.strip() or None,
            seed=self.seed,
            threshold=round(self.threshold, 6),
            max_per={"": self.most} if self.most else None,
        )
        return f"{node[names.COUNT]} results"

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        for name in ("scope", "threshold", "most", "seed"):
            layout.prop(self, name)
        self.draw_pose_settings(layout)


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_choose)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_choose)
