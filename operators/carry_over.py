"""Carry what is selected over to all similar regions."""

import bpy
from bpy.props import BoolProperty

from ..geoanalogy.blender.counting import counted
from ..geoanalogy.blender.regions.recording import carry_steps
from ..geoanalogy.blender.regions.results import uncertain_results
from .edit import LongEdit, active_operation, needs_operations


class GEOANALOGY_OT_carry_over(LongEdit, bpy.types.Operator):
    """Carry the selected meshes, strokes, curves and objects from the query over to every region that was found"""

    bl_idname = "geoanalogy.carry_over"
    bl_label = "Carry Selected Over"

    only: BoolProperty(name="Nothing Else", description="Leave out what was carried over before")

    @classmethod
    def poll(cls, context):
        return needs_operations(cls, context)

    def steps(self, context):
        """Map every point, and show the copies."""
        node = active_operation(context)
        chosen = sorted(context.selected_objects, key=lambda item: item.name)
        count = yield from carry_steps(context, node, chosen, only=self.only)
        uncertain = len(uncertain_results(node))
        return f"Carried over to {counted(count, 'region')}" + (f", {uncertain} uncertain" if uncertain else "")


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_carry_over)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_carry_over)
