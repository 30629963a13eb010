"""Propagate in every scope one of the selected objects, by lot."""

import bpy
from bpy.props import FloatProperty, IntProperty, StringProperty

from ..geoanalogy.blender import names
from ..geoanalogy.blender.pairs import read_pairs
from ..geoanalogy.blender.tree.recording import THRESHOLD, choice_steps
from ..geoanalogy.errors import InputError
from .edit import LongEdit, needs_object_mode
from .pose_settings import MOST_OF, PoseSettings, most_per


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
    most: IntProperty(
        name="At Most",
        description="Most objects in every polygon like the example's, the example counted; 0 is any number",
        min=0,
        default=1,
    )
    shares: StringProperty(
        name="Shares",
        description="How often objects are chosen in proportion to the others, 1 unless it is said, as in: oak 3, "
        "birch 1; 0 is never",
    )
    spacing: FloatProperty(
        name="Spacing",
        description="Least distance between two results; 0 is as near as they do not touch",
        min=0.0,
        subtype="DISTANCE",
    )
    most_of: StringProperty(name="In Others", description=MOST_OF)
    seed: IntProperty(name="Seed", description="For other choices", min=0)

    @classmethod
    def poll(cls, context):
        return needs_object_mode(cls, context)

    def steps(self, context):
        """Learn, choose, propagate and record."""
        items = sorted(context.selected_objects, key=lambda item: item.name)
        node = yield from choice_steps(
            context,
            items,
            self.pose_options(),
            scope=self.scope.strip() or None,
            weights=self._weights(items),
            seed=self.seed,
            threshold=round(self.threshold, 6),
            max_per=most_per(self.most, self.most_of),
            spacing=self.spacing or None,
        )
        return f"{node[names.COUNT]} results"

    def _weights(self, items):
        """The share of every object; empty: equal shares."""
        shares = read_pairs(self.shares, "share")
        unknown = sorted(shares.keys() - {item.name for item in items})
        if unknown:
            raise InputError(f"the share of {unknown[0]!r} is given, but no such object is selected; check the name")
        return [shares.get(item.name, 1.0) for item in items] if shares else []

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        for name in ("scope", "shares", "seed", "threshold", "most", "spacing"):
            layout.prop(self, name)
        if self.other_parents or not self.use_labels:
            layout.prop(self, "most_of")
        self.draw_pose_settings(layout)


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_choose)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_choose)
