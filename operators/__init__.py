"""The operators: each reads the selection, calls the engine and writes the result."""

from ..geoanalogy.blender.registration import register_in_order, unregister_in_order

MODULES = (
    ".set_label",
    ".set_footprint",
    ".make_polygons",
    ".import_plan",
    ".propagate",
    ".choose",
    ".array",
    ".transfer",
    ".scatter",
    ".set_target",
    ".draw_rectangles",
    ".place",
    ".extrude",
    ".combine",
    ".select_elements",
    ".build_on",
    ".apply",
    ".make_real",
    ".import_tree",
    ".export_tree",
    ".add_node",
    ".label_faces",
    ".draw_query",
    ".use_as_query",
    ".import_drawing",
    ".find_regions",
    ".lay_image",
    ".carry_over",
    ".show_transformations",
    ".accept",
    ".next_place",
    ".reject",
    ".reject_below",
    ".forget_decisions",
    ".explain",
    ".list_unfamiliar",
    ".show_face",
    ".select_examples",
    ".replay",
    ".clear",
    ".remove_operation",
    ".move_operation",
    ".mute_operation",
    ".own_tree",
)


def register():
    """Register the operators, in the order of `MODULES`."""
    register_in_order(__package__, MODULES)


def unregister():
    """Unregister them, last first."""
    unregister_in_order(__package__, MODULES)
