"""Mute an operation, or let it speak again."""

import bpy
from bpy.props import StringProperty

from ..geoanalogy.blender.regions.results import show_targets
from ..geoanalogy.blender.tree.evaluating import mark_stale
from ..geoanalogy.blender.tree.showing import show_again
from ..geoanalogy.blender.tree.store import builds, works_on_drawings
from .edit import Edit, active_operation, needs_operations


class GEOANALOGY_OT_mute_operation(Edit, bpy.types.Operator):
    """Leave an operation out, or take it in again; replay to see what follows from it"""

    bl_idname = "geoanalogy.mute_operation"
    bl_label = "Mute Operation"

    operation: StringProperty(name="Operation", description="Its name; empty: the one that is active in the list")

    @classmethod
    def poll(cls, context):
        return needs_operations(cls, context)

    def edit(self, context):
        """Switch it over."""
        node = active_operation(context, self.operation)
        node.mute = not node.mute
        if works_on_drawings(node):
            show_targets(context.scene, node)
            return f"{node.name} {'muted' if node.mute else 'no longer muted'}"
        show_again(context, node)
        if not builds(node.id_data):
            mark_stale(node.id_data, node)
        return f"{node.name} {'muted' if node.mute else 'no longer muted'}"


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_mute_operation)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_mute_operation)
