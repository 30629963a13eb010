"""What all panels of the sidebar share."""

import bpy


class SidebarPanel:
    """A panel in the sidebar of the 3D view, under "GeoAnalogy"."""

    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "GeoAnalogy"


def hint(layout: bpy.types.UILayout, text: str, icon: str = "INFO") -> None:
    """Draw a sentence in small type."""
    row = layout.row()
    row.active = False
    row.label(text=text, icon=icon)
