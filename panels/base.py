"""What all panels of the sidebar share."""

import textwrap

import bpy

from ..geoanalogy.blender import names
from ..geoanalogy.blender.tree.node_settings import stored_settings
from ..geoanalogy.blender.tree.store import is_building, is_propagation


class SidebarPanel:
    """A panel in the sidebar of the 3D view, under "GeoAnalogy"."""

    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "GeoAnalogy"


#: Width of the sidebar that is not text (icon and margins), and of a letter on average, in pixels at a scale of 1.
MARGIN, LETTER = 64.0, 6.4

#: Letters in a line at least, however narrow the sidebar is.
NARROW = 16


def lines_of(text: str) -> list[str]:
    """A sentence in lines that the region is wide enough for."""
    context = bpy.context
    width = context.region.width / context.preferences.system.ui_scale if context.region else 0.0
    return textwrap.wrap(text, max(NARROW, int((width - MARGIN) / LETTER)))


def paragraph(layout: bpy.types.UILayout, text: str, icon: str = "NONE") -> None:
    """Draw a sentence, in as many lines as it takes."""
    column = layout.column(align=True)
    column.scale_y = 0.85
    for i, line in enumerate(lines_of(text)):
        column.label(text=line, icon="BLANK1" if i and icon != "NONE" else icon)


def hint(layout: bpy.types.UILayout, text: str, icon: str = "INFO") -> None:
    """Draw a sentence in small type."""
    column = layout.column()
    column.active = False
    paragraph(column, text, icon)


def share(layout: bpy.types.UILayout, text: str, part: float) -> None:
    """Draw a bar with what it measures; where that is too long for the bar, above it."""
    lines = lines_of(text)
    if len(lines) > 1:
        paragraph(layout, text)
    layout.progress(factor=part, type="BAR", text=f"{part:.2f}" if len(lines) > 1 else text)


def sifting(layout: bpy.types.UILayout, node: bpy.types.Node, done: str) -> None:
    """Draw how much an operation has done, what sifts it, what is decided by hand, and what is wrong with it."""
    layout.label(text=f"{node.name}: {int(node.get(names.COUNT, 0))} {done}", icon="OUTLINER_OB_GROUP_INSTANCE")
    if "threshold" in stored_settings(node):
        column = layout.column(align=True)
        column.prop(node, "threshold", slider=True)
        column.operator("geoanalogy.reject_below", icon="TRASH")
    if not is_building(node):
        row = layout.row(align=True)
        row.operator("geoanalogy.accept", icon="CHECKMARK")
        row.operator("geoanalogy.reject", icon="X")
        row.operator("geoanalogy.forget_decisions", text="", icon="LOOP_BACK")
    if is_propagation(node):
        row = layout.row(align=True)
        row.operator("geoanalogy.next_place", text="", icon="TRIA_LEFT").step = -1
        row.operator("geoanalogy.next_place", icon="TRIA_RIGHT").step = 1
    problem = node.get(names.PROBLEM)
    if problem:
        paragraph(layout, problem, "ERROR")
