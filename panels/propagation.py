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
        grid = layout.grid_flow(columns=2, align=True, even_columns=True)
        grid.operator("geoanalogy.array", icon="MOD_ARRAY")
        grid.operator("geoanalogy.scatter", icon="STICKY_UVS_DISABLE")
        grid.operator("geoanalogy.transfer", text="Group", icon="MOD_LATTICE")
        grid.operator("geoanalogy.choose", text="One of Several", icon="RNDCURVE")


def register():
    """Register the panel."""
    bpy.utils.register_class(GEOANALOGY_PT_propagation)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_PT_propagation)
