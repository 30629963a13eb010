"""Files that are dropped onto a 3D view: which importers take them, and that none asks for a file then."""

import importlib
from types import SimpleNamespace

import bpy
import pytest
from conftest import ADDON


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


class Invoked:
    """An importer as a drop calls it: without a window, Blender would call its `execute`."""

    def __init__(self, given):
        self.properties = SimpleNamespace(is_property_set=lambda name: given and name == "filepath")

    def invoke(self):
        return importlib.import_module(f"{ADDON}.operators.edit").FileImport.invoke(self, bpy.context, None)

    def execute(self, context):
        return {"FINISHED"}


def test_what_is_dropped_comes_with_its_path():
    assert Invoked(True).invoke() == {"FINISHED"}
    with pytest.raises(TypeError):  # Blender's own helper for the file browser takes operators only
        Invoked(False).invoke()


@pytest.mark.parametrize("name", ["plan", "drawing", "tree"])
def test_what_was_dropped_last_is_not_read_again_by_the_button(name):
    operator = getattr(bpy.ops.geoanalogy, f"import_{name}").get_rna_type()
    assert operator.properties["filepath"].is_skip_save
