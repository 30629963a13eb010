"""Lay an image over the query and all similar regions."""

import bpy
from bpy.props import FloatProperty

from ..geoanalogy.blender.counting import counted
from ..geoanalogy.blender.regions.recording import image_steps
from ..geoanalogy.blender.regions.results import uncertain_results
from .edit import LongEdit, active_operation, needs_operations


class GEOANALOGY_OT_lay_image(LongEdit, bpy.types.Operator):
    """Lay the image over the query and over every region that was found, above the images that were laid before"""

    bl_idname = "geoanalogy.lay_image"
    bl_label = "Lay Image"

    width: FloatProperty(
        name="Width",
        description="How far the image reaches beside a stroke, as a share of its length; 0: as far as the match does",
        min=0.0,
        max=1.0,
    )

    @classmethod
    def poll(cls, context):
        return needs_operations(cls, context)

    def steps(self, context):
        """Make the patch, and carry it over."""
        node = active_operation(context)
        count = yield from image_steps(context, node, context.scene.geoanalogy.image, round(self.width, 6))
        uncertain = len(uncertain_results(node))
        return f"Laid over {counted(count + 1, 'region')}" + (f", {uncertain} uncertain" if uncertain else "")


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_lay_image)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_lay_image)
