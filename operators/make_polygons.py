"""Make polygons of drawn lines."""

import bpy
from bpy.props import StringProperty

from ..geoanalogy.blender.counting import counted
from ..geoanalogy.blender.plan_making import polygons_from_lines
from .edit import AsksForLabel, Edit, needs_object_mode


class GEOANALOGY_OT_make_polygons(AsksForLabel, Edit, bpy.types.Operator):
    """Make a labelled polygon of every closed curve, stroke or face of the selected objects"""

    bl_idname = "geoanalogy.make_polygons"
    bl_label = "Make Polygons"

    label: StringProperty(name="Label", description="Of the polygons; empty: that of the object they are made from")

    @classmethod
    def poll(cls, context):
        return needs_object_mode(cls, context)

    def edit(self, context):
        """Make the polygons."""
        return counted(len(polygons_from_lines(context, context.selected_objects, self.label)), "polygon")


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_make_polygons)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_make_polygons)
