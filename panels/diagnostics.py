"""Which versions run, for whoever reports a problem."""

import platform

import bpy

from ..geoanalogy.blender.versions import library_versions
from .base import SidebarPanel


class GEOANALOGY_PT_diagnostics(SidebarPanel, bpy.types.Panel):
    """Versions of Blender, Python and the libraries."""

    bl_idname = "GEOANALOGY_PT_diagnostics"
    bl_label = "Diagnostics"
    bl_options = {"DEFAULT_CLOSED"}
    bl_order = 7

    def draw(self, context):
        column = self.layout.column(align=True)
        column.label(text=f"Blender {bpy.app.version_string}")
        column.label(text=f"Python {platform.python_version()}")
        for name, version in library_versions():
            column.label(text=f"{name} {version}")


def register():
    """Register the panel."""
    bpy.utils.register_class(GEOANALOGY_PT_diagnostics)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_PT_diagnostics)
