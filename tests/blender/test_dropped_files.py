"""Files that are dropped onto a 3D view: which importers take them, and that none asks for a file then."""

import bpy
import pytest
from flats import bed, propagate, rooms

RING = "[[0,0],[4,0],[4,3],[0,3],[0,0]]"
SQUARE = f'{{"properties":{{"label":"room"}},"type":"Feature","geometry":{{"type":"Polygon","coordinates":[{RING}]}}}}'
SVG = '<svg xmlns="http://www.w3.org/2000/svg" width="4" height="3"><rect class="room" width="4" height="3"/></svg>'


def handlers(suffix):
    """The importers of this add-on that take files of a suffix."""
    found = [getattr(bpy.types, name) for name in dir(bpy.types) if name.startswith("GEOANALOGY_FH_")]
    return sorted(one.bl_import_operator for one in found if suffix in one.bl_file_extensions.split(";"))


@pytest.mark.parametrize(
    ("suffix", "names"),
    [
        (".geojson", ["plan"]),
        (".dxf", ["plan"]),
        (".svg", ["drawing", "plan"]),
        (".json", ["plan", "tree"]),
        (".blend", []),
    ],
)
def test_what_can_be_dropped(suffix, names):
    assert handlers(suffix) == [f"geoanalogy.import_{name}" for name in names]


@pytest.mark.parametrize(("name", "text"), [("plan.geojson", SQUARE), ("plan.svg", SVG)])
def test_a_plan_that_is_dropped_is_read_at_once(tmp_path, name, text):
    (tmp_path / name).write_text(text)
    assert bpy.ops.geoanalogy.import_plan("INVOKE_DEFAULT", True, filepath=str(tmp_path / name)) == {"FINISHED"}
    assert [item["ga_label"] for item in bpy.context.selected_objects] == ["room"]


def test_lines_and_operations_that_are_dropped_are_read_at_once(tmp_path):
    (tmp_path / "lines.svg").write_text(SVG)
    drawing = str(tmp_path / "lines.svg")
    assert bpy.ops.geoanalogy.import_drawing("INVOKE_DEFAULT", True, filepath=drawing) == {"FINISHED"}
    rooms()
    bed()
    propagate()
    tree = str(tmp_path / "tree.json")
    assert bpy.ops.geoanalogy.export_tree("EXEC_DEFAULT", filepath=tree) == {"FINISHED"}
    assert bpy.ops.geoanalogy.import_tree("INVOKE_DEFAULT", True, filepath=tree) == {"FINISHED"}


@pytest.mark.parametrize("name", ["plan", "drawing", "tree"])
def test_what_was_dropped_last_is_not_read_again_by_the_button(name):
    operator = getattr(bpy.ops.geoanalogy, f"import_{name}").get_rna_type()
    assert operator.properties["filepath"].is_skip_save


def test_a_dropped_file_that_cannot_be_read_is_refused(tmp_path):
    (tmp_path / "plan.geojson").write_text("{}")
    with pytest.raises(RuntimeError, match=r"plan\.geojson"):
        bpy.ops.geoanalogy.import_plan("INVOKE_DEFAULT", True, filepath=str(tmp_path / "plan.geojson"))
