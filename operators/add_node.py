"""Add an operation without examples in the node editor."""

import bpy
from bpy.props import EnumProperty, StringProperty

from ..geoanalogy.blender import names
from ..geoanalogy.blender.tree.new_nodes import KINDS, new_node
from .edit import Edit


class GEOANALOGY_OT_add_node(Edit, bpy.types.Operator):
    """Add an operation to the tree that is shown; link it, then press Apply"""

    bl_idname = "geoanalogy.add_node"
    bl_label = "Add Operation"

    kind: EnumProperty(name="Kind", items=[(kind, kind.capitalize(), text) for kind, text in KINDS.items()])
    label: StringProperty(name="Label", description="Of what it works on")

    @classmethod
    def poll(cls, context):
        space = context.space_data
        return space is not None and space.type == "NODE_EDITOR" and space.tree_type == names.TREE

    def edit(self, context):
        """Add it where the mouse is."""
        space = context.space_data
        if space.node_tree is None:
            space.node_tree = bpy.data.node_groups.new(f"{context.scene.name} operations", names.TREE)
            context.scene.geoanalogy.tree = space.node_tree
        node = new_node(space.node_tree, self.kind, self.label.strip() or context.scene.geoanalogy.rectangle_label)
        node.location = space.cursor_location
        return f"{node.name} added"

    def invoke(self, context, event):
        context.space_data.cursor_location_from_region(event.mouse_region_x, event.mouse_region_y)
        result = self.execute(context)
        if "FINISHED" in result:
            # It follows the mouse until a click; Esc removes it again.
            bpy.ops.node.translate_attach_remove_on_cancel("INVOKE_DEFAULT")
        return result


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_add_node)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_add_node)
