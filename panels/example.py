"""Step 2: the object that is to be propagated."""

import bpy

from ..geoanalogy.blender import names
from .base import SidebarPanel, hint

#: Kinds of objects without an extent of their own.
POINTS = ("ARMATURE", "CAMERA", "LATTICE", "LIGHT", "LIGHT_PROBE", "SPEAKER")


class GEOANALOGY_PT_example(SidebarPanel, bpy.types.Panel):
    """Put an object where it belongs, and say what it is."""

    bl_idname = "GEOANALOGY_PT_example"
    bl_label = "2  Example"
    bl_order = 2

    def draw(self, context):
        layout = self.layout
        item = context.active_object
        if item is None:
            hint(layout, "Click the object to propagate")
            return
        if names.KEY in item:
            hint(layout, f"{item.name} is a result of {item[names.NODE]}")
            return
        layout.label(text=item.name, icon="OBJECT_DATA")
        if names.LABEL in item:
            layout.prop(item, f'["{names.LABEL}"]', text="Label")
        else:
            layout.operator("geoanalogy.set_label", text="Label It", icon="BOOKMARKS").target = "OBJECTS"
        own = "its own" if names.FOOTPRINT in item else "convex hull" if item.type not in POINTS else "none yet"
        layout.operator_menu_enum("geoanalogy.set_footprint", "kind", text=f"Footprint: {own}", icon="MOD_OUTLINE")


def register():
    """Register the panel."""
    bpy.utils.register_class(GEOANALOGY_PT_example)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_PT_example)
