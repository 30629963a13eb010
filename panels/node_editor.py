"""The node editor of operations trees: its Add menu, its header and its sidebar."""

import bpy

from ..geoanalogy.blender import names
from ..geoanalogy.blender.counting import counted
from ..geoanalogy.blender.tree.evaluating import evaluations
from ..geoanalogy.blender.tree.new_nodes import KINDS
from ..geoanalogy.blender.tree.node_tree import ICONS
from ..geoanalogy.blender.tree.store import builds
from .base import paragraph


def _shows_tree(context: bpy.types.Context) -> bool:
    space = context.space_data
    return space is not None and space.type == "NODE_EDITOR" and space.tree_type == names.TREE


def draw_add_menu(self, context):
    """Draw the operations that need no examples."""
    if not _shows_tree(context):
        return
    self.layout.operator_context = "INVOKE_DEFAULT"
    for kind in KINDS:
        self.layout.operator("geoanalogy.add_node", text=kind.capitalize(), icon=ICONS[kind]).kind = kind


def draw_header(self, context):
    """Draw what is done with the whole tree, and what is wrong with it."""
    tree = context.space_data.node_tree if _shows_tree(context) else None
    if tree is None:
        return
    row = self.layout.row(align=True)
    row.operator("geoanalogy.apply", icon="PLAY")
    row.operator("geoanalogy.replay", text="", icon="FILE_REFRESH")
    if names.PROBLEM in tree:
        self.layout.label(text=str(tree[names.PROBLEM]), icon="ERROR")


class GEOANALOGY_PT_tree(bpy.types.Panel):
    """The tree that is shown, and how long its operations took."""

    bl_idname = "GEOANALOGY_PT_tree"
    bl_label = "Operations Tree"
    bl_space_type = "NODE_EDITOR"
    bl_region_type = "UI"
    bl_category = "GeoAnalogy"

    @classmethod
    def poll(cls, context):
        return _shows_tree(context) and context.space_data.node_tree is not None

    def draw(self, context):
        layout = self.layout
        tree = context.space_data.node_tree
        if names.PROBLEM in tree:
            paragraph(layout, str(tree[names.PROBLEM]), "ERROR")
        layout.prop(tree, "seed")
        if builds(tree):
            layout.prop(tree, "merged")
        seconds = sum(float(node.get(names.SECONDS, 0.0)) for node in tree.nodes)
        layout.label(text=f"{counted(len(tree.nodes), 'operation')}, {seconds:.2f} s", icon="TIME")
        if builds(tree):
            layout.label(text=f"{evaluations.hit_rate:.0%} of all surfaces were known", icon="COPYDOWN")
        row = layout.row(align=True)
        row.operator("geoanalogy.import_tree", text="Import", icon="IMPORT")
        row.operator("geoanalogy.export_tree", text="Export", icon="EXPORT")
        node = tree.nodes.active
        if node is not None and node.get(names.PROBLEM):
            layout.label(text=node.name)
            paragraph(layout, str(node[names.PROBLEM]), "ERROR")


def register():
    """Register the panel, and add to Blender's own menu and header."""
    bpy.utils.register_class(GEOANALOGY_PT_tree)
    bpy.types.NODE_MT_add.append(draw_add_menu)
    bpy.types.NODE_HT_header.append(draw_header)


def unregister():
    """Take all of it back."""
    bpy.types.NODE_HT_header.remove(draw_header)
    bpy.types.NODE_MT_add.remove(draw_add_menu)
    bpy.utils.unregister_class(GEOANALOGY_PT_tree)
