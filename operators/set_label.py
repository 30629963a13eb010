"""Say what the selected objects are."""

import bpy
from bpy.props import EnumProperty, StringProperty

from ..geoanalogy.blender import names
from ..geoanalogy.blender.plan_making import set_label
from .edit import AsksForLabel, Edit, needs_object_mode


class GEOANALOGY_OT_set_label(AsksForLabel, Edit, bpy.types.Operator):
    """Say what kind of thing the selected objects are; only things of the same label are compared"""

    bl_idname = "geoanalogy.set_label"
    bl_label = "Set Label"

    label: StringProperty(name="Label", description="Such as bedroom, bed, door; empty takes the label away")
    target: EnumProperty(
        name="Of",
        items=[
            ("OBJECTS", "Selected Objects", "The selected objects themselves"),
            ("COLLECTION", "Active Collection", "All objects in the active collection that have no label of their own"),
        ],
    )

    asked = ("target",)

    @classmethod
    def poll(cls, context):
        return needs_object_mode(cls, context)

    def invoke(self, context, event):
        item = context.active_object if self.target == "OBJECTS" else context.collection
        self.label = "" if item is None else str(item.get(names.LABEL, ""))
        return super().invoke(context, event)

    def edit(self, context):
        """Write the label."""
        if self.target == "COLLECTION":
            items = [] if context.collection == context.scene.collection else [context.collection]
        else:
            items = context.selected_objects
        count = set_label(items, self.label)
        return f"{count} labelled {self.label!r}" if self.label.strip() else f"{count} without a label"


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_set_label)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_set_label)
