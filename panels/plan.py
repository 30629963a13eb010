"""Step 1: the plan."""

import bpy

from ..geoanalogy.blender import names
from .base import SidebarPanel, hint


class GEOANALOGY_PT_plan(SidebarPanel, bpy.types.Panel):
    """Import a plan, or label what is drawn."""

    bl_idname = "GEOANALOGY_PT_plan"
    bl_label = "1  Plan"
    bl_order = 1

    def draw(self, context):
        layout = self.layout
        layout.prop(context.scene.geoanalogy, "plan", text="Plan")
        column = layout.column(align=True)
        column.operator("geoanalogy.import_plan", icon="IMPORT")
        column.operator("geoanalogy.make_polygons", icon="MESH_DATA")
        column = layout.column(align=True)
        column.operator("geoanalogy.set_label", text="Label Selected", icon="BOOKMARKS").target = "OBJECTS"
        column.operator(
            "geoanalogy.set_label", text="Label Collection", icon="OUTLINER_COLLECTION"
        ).target = "COLLECTION"
        column.operator("geoanalogy.label_faces", icon="FACESEL")
        if context.mode == "EDIT_MESH":
            hint(layout, "Select faces and label them: walls, roofs; all else is done in Object Mode")
        elif context.scene.geoanalogy.plan is None and not _has_labels(context.scene):
            hint(layout, "Import a plan, or draw faces and closed curves, and label what they are: room, door, facade")


def _has_labels(scene):
    """Whether anything is labelled: an object, or some of its faces."""
    if any(names.LABEL in item for item in scene.objects):
        return True
    labelled = {material for material in bpy.data.materials if names.LABEL in material}
    return (
        any(slot.material in labelled for item in scene.objects for slot in item.material_slots) if labelled else False
    )


def register():
    """Register the panel."""
    bpy.utils.register_class(GEOANALOGY_PT_plan)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_PT_plan)
