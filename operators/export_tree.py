"""Write the operations tree to a file."""

from pathlib import Path

import bpy
from bpy.props import StringProperty
from bpy_extras.io_utils import ExportHelper

from ..geoanalogy.blender.counting import counted
from ..geoanalogy.blender.tree.files import export_tree
from .edit import Edit, needs_operations


class GEOANALOGY_OT_export_tree(Edit, ExportHelper, bpy.types.Operator):
    """Write the operations tree to a JSON file, for other files and for the batch program"""

    bl_idname = "geoanalogy.export_tree"
    bl_label = "Export Operations"
    bl_options = {"REGISTER"}

    filename_ext = ".json"
    filter_glob: StringProperty(default="*.json", options={"HIDDEN"})

    @classmethod
    def poll(cls, context):
        return needs_operations(cls, context)

    def edit(self, context):
        """Write it."""
        path = Path(bpy.path.abspath(self.filepath))
        return f"{counted(export_tree(context.scene, path), 'operation')} written to {path.name}"


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_export_tree)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_export_tree)
