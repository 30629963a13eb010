"""Propagate in every scope one of the selected objects, by lot."""

import bpy
from bpy.props import IntProperty, StringProperty

from ..geoanalogy.blender import names
from ..geoanalogy.blender.counting import counted
from ..geoanalogy.blender.pairs import read_pairs
from ..geoanalogy.blender.tree.recording import choice_steps
from ..geoanalogy.errors import InputError
from .edit import LongEdit, needs_object_mode
from .pose_settings import SiftedPoses


class GEOANALOGY_OT_choose(SiftedPoses, LongEdit, bpy.types.Operator):
    """Put one of the selected objects, chosen by lot, into every polygon like the one they are in"""

    bl_idname = "geoanalogy.choose"
    bl_label = "Propagate One of Several"

    scope: StringProperty(
        name="Scope",
        description="Label of the polygons that get one choice each; empty: the label of the example's polygon",
    )
    shares: StringProperty(
        name="Shares",
        description="How often objects are chosen in proportion to the others, 1 unless it is said, as in: oak 3, "
        "birch 1; 0 is never",
    )
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
            **self.sifting(),
        )
        return counted(node[names.COUNT], "result")

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
        for name in ("scope", "shares", "seed"):
            layout.prop(self, name)
        self.draw_sifting(layout)
        self.draw_pose_settings(layout)


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_choose)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_choose)
