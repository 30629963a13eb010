"""Step 3 in three dimensions: extrude, merge, subtract, divide."""

import bpy

from ..geoanalogy.blender.tree.building import chosen_text
from ..geoanalogy.blender.tree.store import tree_of
from .base import SidebarPanel, hint


class GEOANALOGY_PT_building(SidebarPanel, bpy.types.Panel):
    """Make solids of outlines; their faces are surfaces that other operations work on."""

    bl_idname = "GEOANALOGY_PT_building"
    bl_label = "Build"
    bl_parent_id = "GEOANALOGY_PT_propagation"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout = self.layout
        grid = layout.grid_flow(columns=2, align=True, even_columns=True)
        grid.operator("geoanalogy.extrude", icon="MOD_SOLIDIFY")
        grid.operator("geoanalogy.select_elements", text="Divide", icon="UV_SYNC_SELECT")
        grid.operator("geoanalogy.combine", text="Merge", icon="SELECT_EXTEND").kind = "merge"
        grid.operator("geoanalogy.combine", text="Subtract", icon="SELECT_SUBTRACT").kind = "subtract"
        tree = tree_of(context.scene)
        if tree is None:
            return
        hint(layout, f"The next one builds on {chosen_text(tree)}", "NODETREE")
        row = layout.row(align=True)
        node = tree.nodes.active
        count = len(node.outputs) if node is not None else 0
        for output in range(1, count + 1):
            choice = row.operator(
                "geoanalogy.build_on", text=f"Set {output}" if count > 1 else "Active", icon="FORWARD"
            )
            choice.what, choice.output = "ACTIVE", output
        row = layout.row(align=True)
        row.operator("geoanalogy.build_on", text="All Branches", icon="AUTOMERGE_ON").what = "MERGE"
        row.operator("geoanalogy.build_on", text="", icon="LOOP_BACK").what = "LEAF"


def register():
    """Register the panel."""
    bpy.utils.register_class(GEOANALOGY_PT_building)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_PT_building)
