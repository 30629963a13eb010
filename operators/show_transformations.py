"""Show the transformation space of what was found."""

import bpy

from ..geoanalogy.blender.regions.space_view import space_steps
from .edit import LongEdit, active_operation, needs_operations


class GEOANALOGY_OT_show_transformations(LongEdit, bpy.types.Operator):
    """Plot all correspondences of the active operation beside the drawing, those of each match in a colour"""

    bl_idname = "geoanalogy.show_transformations"
    bl_label = "Show Transformation Space"

    @classmethod
    def poll(cls, context):
        return needs_operations(cls, context)

    def steps(self, context):
        """Plot them."""
        space = yield from space_steps(context, active_operation(context))
        return (
            f"{len(space.match)} correspondences, {space.inliers:.1%} of a match"
            f" ({space.weighted_inliers:.1%} by confidence)"
        )


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_show_transformations)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_show_transformations)
