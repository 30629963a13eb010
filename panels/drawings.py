"""Drawings: one region painted, all similar ones painted."""

import bpy

from ..geoanalogy.blender import names
from ..geoanalogy.blender.regions.results import uncertain_results
from ..geoanalogy.blender.regions.settings import SETTINGS
from ..geoanalogy.blender.regions.space_view import space_collection
from ..geoanalogy.blender.tree.store import tree_of, works_on_drawings
from .base import SidebarPanel, hint, sifting

#: Results that are listed.
MOST_LISTED = 3


class GEOANALOGY_PT_drawings(SidebarPanel, bpy.types.Panel):
    """Outline one region of a drawing, find all that are like it, and paint them at once."""

    bl_idname = "GEOANALOGY_PT_drawings"
    bl_label = "Drawings"
    bl_order = 6
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout = self.layout
        settings = context.scene.geoanalogy
        column = layout.column(align=True)
        column.label(text="Drawing")
        row = column.row(align=True)
        row.prop(settings, "drawing", text="")
        row.operator("geoanalogy.import_drawing", text="", icon="IMPORT")
        column.prop(settings, "smoothing")
        column = layout.column(align=True)
        column.label(text="Query")
        row = column.row(align=True)
        for mode, text in (("LASSO", "Lasso"), ("BRUSH", "Brush"), ("STROKE", "Stroke")):
            row.operator("geoanalogy.draw_query", text=text).mode = mode
        row = column.row(align=True)
        row.prop(settings, "query", text="")
        # The field has a pipette of its own.
        row.operator("geoanalogy.use_as_query", text="", icon="RESTRICT_SELECT_OFF")
        row = layout.row()
        row.scale_y = 1.4
        row.operator("geoanalogy.find_regions", icon="VIEWZOOM")
        self._draw_found(context, layout)

    def _draw_found(self, context, layout):
        tree = tree_of(context.scene)
        node = tree.nodes.active if tree is not None else None
        if node is None or not works_on_drawings(node):
            hint(layout, "Nothing found yet")
            return
        sifting(layout, node, "regions")
        self._draw_result(context, layout, node)
        column = layout.column(align=True)
        column.label(text="Carry Over")
        column.template_ID(context.scene.geoanalogy, "image", open="image.open")
        column.operator("geoanalogy.lay_image", icon="IMAGE_DATA")
        column.operator("geoanalogy.carry_over", icon="DUPLICATE")
        layout.operator("geoanalogy.show_transformations", text="Transformation Space", icon="GRAPH")
        view = space_collection(context.scene, node.name)
        if view is not None:
            plain, weighted = view[names.INLIERS]
            hint(layout, f"{view[names.COUNT]} correspondences, {plain:.1%} of a match ({weighted:.1%} by confidence)")

    def _draw_result(self, context, layout, node):
        guesses = uncertain_results(node)
        if guesses:
            text = ", ".join(guesses[:MOST_LISTED]) + (" …" if len(guesses) > MOST_LISTED else "")
            hint(layout, f"Uncertain: {text}", "ERROR")
        item = context.active_object
        if item is None or names.SIMILARITY not in item or item.get(names.NODE) != node.name:
            return
        box = layout.box()
        box.label(text=item.name, icon="VIEWZOOM")
        shown = (("Similarity", names.SIMILARITY), ("Coverage", names.COVERAGE), ("Confidence", names.CONFIDENCE))
        for text, key in shown:
            value = float(item.get(key, 0.0))
            box.progress(factor=value, type="BAR", text=f"{text}  {value:.2f}")


class GEOANALOGY_PT_matching(SidebarPanel, bpy.types.Panel):
    """How the query is matched."""

    bl_idname = "GEOANALOGY_PT_matching"
    bl_label = "Matching"
    bl_parent_id = "GEOANALOGY_PT_drawings"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        for name in SETTINGS:
            layout.prop(context.scene.geoanalogy.matching, name)


CLASSES = (GEOANALOGY_PT_drawings, GEOANALOGY_PT_matching)


def register():
    """Register the panels."""
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    """Unregister them."""
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
