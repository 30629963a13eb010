"""Choose what the next operation builds on."""

import bpy
from bpy.props import EnumProperty, IntProperty

from ..geoanalogy.blender.tree.building import chosen_text
from ..geoanalogy.blender.tree.editing import build_on, open_outputs
from ..geoanalogy.blender.tree.store import ordered_nodes, tree_of
from ..geoanalogy.errors import InputError
from ..geoanalogy.operations.node import Link
from .edit import Edit, active_operation, needs_operations

WHAT = [
    ("ACTIVE", "Active Operation", "One output of the active operation, whether or not others follow it already"),
    ("MERGE", "All Branches", "All outputs that nothing follows: the next operation merges the branches"),
    ("LEAF", "Last in the List", "The active operation where nothing follows it, else the last one"),
]


class GEOANALOGY_OT_build_on(Edit, bpy.types.Operator):
    """Choose what the next operation builds on"""

    bl_idname = "geoanalogy.build_on"
    bl_label = "Build On"

    what: EnumProperty(name="What", items=WHAT, options={"SKIP_SAVE"})
    output: IntProperty(
        name="Set", description="Which set of a selection, from 1 on", min=1, default=1, options={"SKIP_SAVE"}
    )

    @classmethod
    def poll(cls, context):
        return needs_operations(cls, context)

    def edit(self, context):
        """Choose it."""
        tree = tree_of(context.scene)
        links = ()
        if self.what == "ACTIVE":
            node = active_operation(context)
            if self.output > len(node.outputs):
                raise InputError(f"{node.name!r} has {len(node.outputs)} sets; choose one of them")
            links = (Link(node.name, self.output - 1),)
        elif self.what == "MERGE":
            links = open_outputs(ordered_nodes(tree))
        build_on(tree, links)
        return f"The next operation builds on {chosen_text(tree)}"


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_build_on)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_build_on)
