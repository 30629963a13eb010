"""Step 5: the operations, in the order in which they build on each other."""

import bpy

from ..geoanalogy.blender import names
from ..geoanalogy.blender.counting import counted
from ..geoanalogy.blender.tree.evaluating import parcels_of
from ..geoanalogy.blender.tree.node_tree import ICONS
from ..geoanalogy.blender.tree.sharing import sharers
from ..geoanalogy.blender.tree.store import builds, drawing_nodes, ordered_nodes, tree_of
from .base import SidebarPanel, hint, paragraph


class GEOANALOGY_UL_operations(bpy.types.UIList):
    """Operations with what they have placed, and a switch that mutes them."""

    bl_idname = "GEOANALOGY_UL_operations"

    def draw_item(self, context, layout, data, item, icon, active_data, active_property, index=0, flt_flag=0):
        operation = item.get(names.OPERATION)
        row = layout.row(align=True)
        row.active = not item.mute
        if not hasattr(operation, "items"):
            row.label(text=item.name, icon="QUESTION")
            return
        row.label(text=item.label or item.name, icon=ICONS.get(operation.get("type"), "NODE"))
        if item.get(names.STALE):
            row.label(text="", icon="FILE_REFRESH")
        count = row.row()
        count.alignment = "RIGHT"
        count.label(text=str(int(item.get(names.COUNT, 0))))
        switch = row.operator(
            "geoanalogy.mute_operation", text="", icon="HIDE_ON" if item.mute else "HIDE_OFF", emboss=False
        )
        switch.operation = item.name

    def filter_items(self, context, data, property):
        nodes = list(getattr(data, property))
        rank = {node.name: i for i, node in enumerate([*ordered_nodes(data), *drawing_nodes(data)])}
        shown = [self.bitflag_filter_item if node.name in rank else 0 for node in nodes]
        others = iter(range(len(rank), len(nodes)))
        order = [rank[node.name] if node.name in rank else next(others) for node in nodes]
        return shown, order


class GEOANALOGY_PT_operations(SidebarPanel, bpy.types.Panel):
    """The recorded operations, which can be replayed."""

    bl_idname = "GEOANALOGY_PT_operations"
    bl_label = "5  Operations"
    bl_order = 5

    def draw(self, context):
        layout = self.layout
        scene = context.scene
        tree = tree_of(scene)
        layout.template_ID(scene.geoanalogy, "tree")
        row = layout.row(align=True)
        row.operator("geoanalogy.import_tree", text="Import", icon="IMPORT")
        row.operator("geoanalogy.export_tree", text="Export", icon="EXPORT")
        if tree is None:
            hint(layout, "None recorded yet")
            return
        others = sharers(scene)
        if others:
            hint(layout, f"Shared with {others[0].name}: what is changed here changes there", "LINKED")
            layout.operator("geoanalogy.own_tree", text="Make Its Own", icon="DUPLICATE")
        row = layout.row()
        row.template_list("GEOANALOGY_UL_operations", "", tree, "nodes", tree, "active_index", rows=4, sort_lock=True)
        side = row.column(align=True)
        side.operator("geoanalogy.move_operation", text="", icon="TRIA_UP").direction = "UP"
        side.operator("geoanalogy.move_operation", text="", icon="TRIA_DOWN").direction = "DOWN"
        side.separator()
        side.operator("geoanalogy.remove_operation", text="", icon="REMOVE")
        if names.PROBLEM in tree:
            paragraph(layout, str(tree[names.PROBLEM]), "ERROR")
        layout.prop(tree, "seed")
        row = layout.row(align=True)
        row.scale_y = 1.2
        row.operator("geoanalogy.replay", icon="FILE_REFRESH")
        row.operator("geoanalogy.clear", text="Clear", icon="TRASH")
        row = layout.row(align=True)
        row.operator("geoanalogy.apply", icon="PLAY").parcels = "ALL"
        row.operator("geoanalogy.apply", text="To Selected").parcels = "SELECTED"
        parcels = parcels_of(tree)
        if parcels:
            hint(layout, f"Applied to {counted(len(parcels), 'parcel')} only")
        if builds(tree):
            layout.prop(tree, "merged")
        layout.operator("geoanalogy.make_real", icon="OBJECT_DATA")


def register():
    """Register list and panel."""
    bpy.utils.register_class(GEOANALOGY_UL_operations)
    bpy.utils.register_class(GEOANALOGY_PT_operations)


def unregister():
    """Unregister them."""
    bpy.utils.unregister_class(GEOANALOGY_PT_operations)
    bpy.utils.unregister_class(GEOANALOGY_UL_operations)
