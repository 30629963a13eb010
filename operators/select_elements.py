"""Divide what is of a label among branches of the tree."""

import bpy
from bpy.props import EnumProperty, IntProperty, StringProperty

from ..geoanalogy.blender import names
from ..geoanalogy.blender.tree.building import label_here, operation_steps
from ..geoanalogy.blender.tree.node_settings import WITHIN, weights_of
from ..geoanalogy.operations.selection import Selection
from .edit import LongEdit, needs_object_mode


class GEOANALOGY_OT_select_elements(LongEdit, bpy.types.Operator):
    """Divide everything of a label among sets at random; operations on one set leave the others alone"""

    bl_idname = "geoanalogy.select_elements"
    bl_label = "Divide"

    label: StringProperty(
        name="Label",
        description="Of what is divided; empty: that of the active object, else of the active operation",
        options={"SKIP_SAVE"},
    )
    weights: StringProperty(
        name="Weights",
        description="One number per set, with commas between them; one alone below 1: the share that is chosen",
        default="1, 1",
    )
    within: EnumProperty(name="Divide", items=WITHIN)
    seed: IntProperty(name="Seed", description="For another division", min=0)

    @classmethod
    def poll(cls, context):
        return needs_object_mode(cls, context)

    def steps(self, context):
        """Divide and record."""
        label, weights = label_here(context, self.label), weights_of(self.weights)
        operation = Selection(label=label, weights=weights, within=self.within, seed=self.seed)
        node, _ = yield from operation_steps(context, operation)
        return f"{node[names.COUNT]} divided among {len(weights)} sets"


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_select_elements)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_select_elements)
