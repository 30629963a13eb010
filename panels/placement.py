"""Step 3 with several examples: rectangles drawn or objects chosen, what is wanted and what is not."""

import bpy

from ..geoanalogy.blender import names
from .base import SidebarPanel, hint

#: Examples that are listed.
MOST_LISTED = 6


class GEOANALOGY_PT_placement(SidebarPanel, bpy.types.Panel):
    """Learn a rule from several examples, and fill every place that follows it."""

    bl_idname = "GEOANALOGY_PT_placement"
    bl_label = "From Several Examples"
    bl_parent_id = "GEOANALOGY_PT_propagation"

    def draw(self, context):
        layout = self.layout
        settings = context.scene.geoanalogy
        layout.prop(settings, "element", text="Place")
        row = layout.row(align=True)
        row.prop(settings, "rectangle_label", text="")
        row.operator("geoanalogy.draw_rectangles", text="Draw", icon="SELECT_SET")
        self._draw_examples(context, layout)
        row = layout.row()
        row.scale_y = 1.4
        row.operator("geoanalogy.place", icon="PLAY")

    def _draw_examples(self, context, layout):
        items = sorted((i for i in context.selected_objects if names.KEY not in i), key=lambda item: item.name)
        if not items:
            hint(layout, "Select or draw the examples")
            return
        column = layout.column(align=True)
        for item in items[:MOST_LISTED]:
            if names.TARGET in item:
                column.prop(item, f'["{names.TARGET}"]', text=item.name, slider=True)
            else:
                column.label(text=item.name, icon="CHECKMARK")
        if len(items) > MOST_LISTED:
            hint(column, f"and {len(items) - MOST_LISTED} more", "NONE")
        row = layout.row(align=True)
        row.operator("geoanalogy.set_target", text="Wanted").target = 1.0
        row.operator("geoanalogy.set_target", text="Not Wanted").target = 0.0


def register():
    """Register the panel."""
    bpy.utils.register_class(GEOANALOGY_PT_placement)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_PT_placement)
