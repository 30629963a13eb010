"""Give the selected objects footprints of their own."""

import bpy
from bpy.props import EnumProperty, FloatProperty

from ..geoanalogy.blender.plan_making import SQUARE, take_footprints
from ..geoanalogy.errors import InputError
from .edit import Edit, needs_object_mode


class GEOANALOGY_OT_set_footprint(Edit, bpy.types.Operator):
    """Say what ground the selected objects take up"""

    bl_idname = "geoanalogy.set_footprint"
    bl_label = "Set Footprint"

    kind: EnumProperty(
        name="Shape",
        items=[
            ("hull", "Convex Hull", "The convex hull of all points, as it is now"),
            ("outline", "Outline", "The exact outline of the faces seen from above"),
            ("box", "Box", "The box along the object's own axes"),
            ("square", "Square", "A square about the origin, for what has no extent: a light, an empty"),
            ("none", "Automatic", "None of its own: the convex hull of whatever the object is at the time"),
        ],
    )

    size: FloatProperty(name="Size", description="Side of the square", min=1e-4, default=SQUARE, subtype="DISTANCE")

    @classmethod
    def poll(cls, context):
        return needs_object_mode(cls, context)

    def edit(self, context):
        """Take the footprints."""
        if not context.selected_objects:
            raise InputError("nothing is selected; select the objects that need a footprint")
        take_footprints(context, context.selected_objects, self.kind, self.size)
        return f"{len(context.selected_objects)} footprints"

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "kind")
        if self.kind == "square":
            layout.prop(self, "size")


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_set_footprint)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_set_footprint)
