"""Step 3: propagating it."""

import bpy

from .base import SidebarPanel


class GEOANALOGY_PT_propagation(SidebarPanel, bpy.types.Panel):
    """Put the example wherever its surroundings are alike."""

    bl_idname = "GEOANALOGY_PT_propagation"
    bl_label = "3  Propagate"
    bl_order = 3

    def draw(self, context):
        layout = self.layout
        row = layout.row()
        row.scale_y = 1.4
        row.operator("geoanalogy.propagate", icon="PLAY")
        column = layout.column(align=True)
        row = column.row(align=True)
        row.operator("geoanalogy.array", icon="MOD_ARRAY")
        row.operator("geoanalogy.scatter", icon="STICKY_UVS_DISABLE")
        column.operator("geoanalogy.transfer", icon="MOD_LATTICE")
        column.operator("geoanalogy.choose", text="One of Several", icon="RNDCURVE")


def register():
    """Register the panel."""
    bpy.utils.register_class(GEOANALOGY_PT_propagation)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_PT_propagation)
