"""Move the active operation in the order."""

import bpy
from bpy.props import EnumProperty

from ..geoanalogy.blender import names
from ..geoanalogy.blender.tree.editing import follower_of, swap_with_source
from ..geoanalogy.blender.tree.evaluating import mark_stale
from .edit import Edit, active_operation, needs_operations


class GEOANALOGY_OT_move_operation(Edit, bpy.types.Operator):
    """Move the active operation before or behind its neighbour; replay to see the difference"""

    bl_idname = "geoanalogy.move_operation"
    bl_label = "Move Operation"

    direction: EnumProperty(name="Direction", items=[("UP", "Up", "Earlier"), ("DOWN", "Down", "Later")])

    @classmethod
    def poll(cls, context):
        return needs_operations(cls, context)

    def edit(self, context):
        """Swap it with its neighbour."""
        node = active_operation(context)
        later = node if self.direction == "UP" else follower_of(node)
        swap_with_source(node.id_data, later)
        first = node if self.direction == "UP" else later
        first[names.STALE] = True
        mark_stale(node.id_data, first)
        return f"{node.name} moved {self.direction.lower()}; replay to see the difference"


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_move_operation)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_move_operation)
