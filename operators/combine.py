"""Merge or subtract what has been extruded."""

import bpy
from bpy.props import EnumProperty, StringProperty

from ..geoanalogy.blender.tree.building import label_here, operation_steps
from ..geoanalogy.blender.tree.node_settings import KINDS, TARGETS
from ..geoanalogy.operations.boolean import Boolean
from .edit import LongEdit, needs_operations


class GEOANALOGY_OT_combine(LongEdit, bpy.types.Operator):
    """Merge solids of a label with what they stand on or intersect, or cut them out of it"""

    bl_idname = "geoanalogy.combine"
    bl_label = "Combine"

    label: StringProperty(
        name="Label",
        description="Of the solids; empty: that of the active object, else of the active operation",
        options={"SKIP_SAVE"},
    )
    kind: EnumProperty(name="Kind", items=KINDS)
    target: EnumProperty(name="With", items=TARGETS)

    @classmethod
    def poll(cls, context):
        return needs_operations(cls, context)

    def steps(self, context):
        """Combine, show and record."""
        operation = Boolean(label=label_here(context, self.label), kind=self.kind, target=self.target)
        _, shown = yield from operation_steps(context, operation)
        return shown.text


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_combine)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_combine)
