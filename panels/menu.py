"""The Object menu of the 3D view: what is in a menu is found by Blender's search, what is in a panel is not."""

import bpy

#: Operators in groups, in the order of the sidebar's steps.
GROUPS = (
    ("import_plan", "make_polygons", "set_label", "set_footprint", "label_faces"),
    ("propagate", "array", "scatter", "transfer", "choose"),
    ("draw_rectangles", "place"),
    ("extrude", "combine", "select_elements"),
    ("accept", "next_place", "reject", "reject_below", "forget_decisions", "explain", "list_unfamiliar"),
    ("replay", "apply", "clear", "make_real", "own_tree", "import_tree", "export_tree"),
    ("import_drawing", "draw_query", "use_as_query", "find_regions", "lay_image", "carry_over", "show_transformations"),
)


class GEOANALOGY_MT_object(bpy.types.Menu):
    """All that the sidebar offers."""

    bl_idname = "GEOANALOGY_MT_object"
    bl_label = "GeoAnalogy"

    def draw(self, context):
        # Long operators show their progress and can be stopped only where they are invoked.
        self.layout.operator_context = "INVOKE_DEFAULT"
        for i, group in enumerate(GROUPS):
            if i:
                self.layout.separator()
            for name in group:
                self.layout.operator(f"geoanalogy.{name}")


def _draw(self, context):
    self.layout.separator()
    self.layout.menu(GEOANALOGY_MT_object.bl_idname)


def register():
    """Add the menu to that of objects."""
    bpy.utils.register_class(GEOANALOGY_MT_object)
    bpy.types.VIEW3D_MT_object.append(_draw)


def unregister():
    """Take it away."""
    bpy.types.VIEW3D_MT_object.remove(_draw)
    bpy.utils.unregister_class(GEOANALOGY_MT_object)
