"""Select the examples of the active operation."""

import bpy

from ..geoanalogy.blender import names
from ..geoanalogy.blender.counting import counted
from ..geoanalogy.blender.tree.store import placed_by
from ..geoanalogy.errors import InputError
from .edit import Edit, active_operation, needs_operations


class GEOANALOGY_OT_select_examples(Edit, bpy.types.Operator):
    """Select the examples that the active operation was learned from, besides those that are selected now"""

    bl_idname = "geoanalogy.select_examples"
    bl_label = "Select Its Examples"

    @classmethod
    def poll(cls, context):
        return needs_operations(cls, context)

    def edit(self, context):
        """Select them; results are no examples."""
        node = active_operation(context)
        placed = placed_by(node)
        taught = [one for one in placed if one.target is not None] or placed
        items = [one.item for one in taught if one.item is not None and one.item.name in context.view_layer.objects]
        if not items:
            raise InputError(f"the examples of {node.name!r} are not in the scene; it was learned in another file")
        for item in context.selected_objects:
            if names.KEY in item:
                item.select_set(False)
        for item in items:
            item.select_set(True)
        if context.active_object is None or not context.active_object.select_get():
            context.view_layer.objects.active = items[0]
        return f"{counted(len(context.selected_objects), 'example')} selected"


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_select_examples)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_select_examples)
