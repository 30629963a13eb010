"""Import a drawing from a file."""

import bpy
from bpy.props import FloatProperty, StringProperty

from ..geoanalogy.blender.counting import counted
from ..geoanalogy.blender.regions.drawings import add_lines
from ..geoanalogy.formats.files import read_drawing
from .edit import FileImport, chosen_file, needs_object_mode


class GEOANALOGY_OT_import_drawing(FileImport, bpy.types.Operator):
    """Import the lines of an SVG file into the drawing"""

    bl_idname = "geoanalogy.import_drawing"
    bl_label = "Import Drawing"

    filter_glob: StringProperty(default="*.svg", options={"HIDDEN"})
    scale: FloatProperty(name="Scale", description="Scene units per unit of the file", min=1e-6, default=1.0)

    @classmethod
    def poll(cls, context):
        return needs_object_mode(cls, context)

    def edit(self, context):
        """Read the file, and add its lines."""
        path = chosen_file(self.filepath)
        lines = read_drawing(path)
        add_lines(context, [self.scale * line for line in lines], path.stem)
        return counted(len(lines), "line")


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_import_drawing)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_import_drawing)
