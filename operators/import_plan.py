"""Import a plan from a file."""

import bpy
from bpy.props import FloatProperty, StringProperty

from ..geoanalogy.blender.counting import counted
from ..geoanalogy.blender.plan_making import add_plan
from ..geoanalogy.formats.files import read_scene
from .edit import FileImport, chosen_file, needs_object_mode


class GEOANALOGY_OT_import_plan(FileImport, bpy.types.Operator):
    """Import labelled outlines from a GeoJSON, SVG or DXF file"""

    bl_idname = "geoanalogy.import_plan"
    bl_label = "Import Plan"

    filter_glob: StringProperty(default="*.geojson;*.json;*.svg;*.dxf", options={"HIDDEN"})
    label: StringProperty(
        name="Label From",
        description="Where the file keeps the labels: a property (GeoJSON), an attribute (SVG), layer or block (DXF); "
        "empty: the usual place",
    )
    scale: FloatProperty(name="Scale", description="Scene units per unit of the file", min=1e-6, default=1.0)

    @classmethod
    def poll(cls, context):
        return needs_object_mode(cls, context)

    def edit(self, context):
        """Read the file, and add its polygons to the plan."""
        path = chosen_file(self.filepath)
        scene = read_scene(path, label=self.label.strip() or None, scale=self.scale)
        return counted(len(add_plan(context, scene, path.stem)), "polygon")


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_import_plan)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_import_plan)
