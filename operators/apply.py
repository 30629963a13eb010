"""Apply the operations tree, as it was learned, to the scene or to some of its parcels."""

import bpy
from bpy.props import EnumProperty

from ..geoanalogy.blender.tree.parcels import apply_steps, selected_parcels
from .edit import LongEdit, needs_operations

PARCELS = [
    ("KEEP", "As Before", "To what it was applied to before"),
    ("ALL", "All", "To everything"),
    ("SELECTED", "Selected", "To the selected parcels, with what lies in them"),
    ("MORE", "Selected Too", "To the selected parcels, and to what it was applied to before"),
]


class GEOANALOGY_OT_apply(LongEdit, bpy.types.Operator):
    """Apply all operations as they were learned, whatever has become of their examples"""

    bl_idname = "geoanalogy.apply"
    bl_label = "Apply"

    parcels: EnumProperty(name="Parcels", items=PARCELS, options={"SKIP_SAVE"})

    @classmethod
    def poll(cls, context):
        return needs_operations(cls, context)

    def steps(self, context):
        """Evaluate what has changed, and show everything anew."""
        chosen = {"KEEP": None, "ALL": []}.get(self.parcels)
        if self.parcels in ("SELECTED", "MORE"):
            chosen = selected_parcels(context)
        shown = yield from apply_steps(context, chosen, more=self.parcels == "MORE")
        return shown.text


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_apply)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_apply)
