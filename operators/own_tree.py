"""Give the scene operations of its own, where it shares them with another scene."""

import bpy

from ..geoanalogy.blender.tree.sharing import own_tree
from .edit import Edit, needs_operations


class GEOANALOGY_OT_own_tree(Edit, bpy.types.Operator):
    """Copy the operations that other scenes share, with the scene's own copies of the examples"""

    bl_idname = "geoanalogy.own_tree"
    bl_label = "Make Operations Its Own"

    @classmethod
    def poll(cls, context):
        return needs_operations(cls, context)

    def edit(self, context):
        """Copy them."""
        return f"{own_tree(context.scene).name!r} belongs to {context.scene.name!r} alone"


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_own_tree)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_own_tree)
