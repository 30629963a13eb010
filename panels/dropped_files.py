"""Files that are dropped onto a 3D view: Blender asks where several of its importers, or ours, take one."""

import bpy


class OntoView:
    """What is imported where it is dropped onto a 3D view."""

    @classmethod
    def poll_drop(cls, context):
        return context.area is not None and context.area.type == "VIEW_3D"


class GEOANALOGY_FH_plan(OntoView, bpy.types.FileHandler):
    """A plan: labelled outlines."""

    bl_idname = "GEOANALOGY_FH_plan"
    bl_label = "Plan for GeoAnalogy"
    bl_import_operator = "geoanalogy.import_plan"
    bl_file_extensions = ".geojson;.json;.svg;.dxf"


class GEOANALOGY_FH_drawing(OntoView, bpy.types.FileHandler):
    """A drawing: lines in which regions are alike."""

    bl_idname = "GEOANALOGY_FH_drawing"
    bl_label = "Drawing for GeoAnalogy"
    bl_import_operator = "geoanalogy.import_drawing"
    bl_file_extensions = ".svg"


class GEOANALOGY_FH_tree(OntoView, bpy.types.FileHandler):
    """An operations tree."""

    bl_idname = "GEOANALOGY_FH_tree"
    bl_label = "Operations for GeoAnalogy"
    bl_import_operator = "geoanalogy.import_tree"
    bl_file_extensions = ".json"


CLASSES = (GEOANALOGY_FH_plan, GEOANALOGY_FH_drawing, GEOANALOGY_FH_tree)


def register():
    """Let Blender know what can be dropped."""
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    """Let it forget that."""
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
