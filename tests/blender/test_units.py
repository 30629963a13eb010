"""Scenes whose unit is no metre: what an option is at first is as large there, as Blender's own new objects are."""

import importlib
from types import SimpleNamespace

import bpy
import pytest
from conftest import ADDON
from flats import activate, box, bridge, operations_tree, results, rooms
from mathutils import Matrix

CENTIMETRES = 0.01


@pytest.fixture
def lamp():
    """A lamp in rooms that are drawn in centimetres."""
    bpy.context.scene.unit_settings.scale_length = CENTIMETRES
    lamp = box("Lamp", (0.2, 0.2, 1.0), "lamp", at=(0.5, 2.6, 0))
    for item in [*rooms(2), lamp]:
        item.data.transform(Matrix.Scale(100, 4))
        item.location *= 100
    return activate(lamp)


class Invoked:
    """An operator as a button calls it: without a window, Blender would call its `execute`."""

    def __init__(self, name, **given):
        kind = getattr(bpy.ops.geoanalogy, name).get_rna_type()
        self.in_metres = importlib.import_module(f"{ADDON}.operators.{name}").__dict__[kind.identifier].in_metres
        for option in self.in_metres:
            setattr(self, option, given.get(option, kind.properties[option].default))
        self.properties = SimpleNamespace(is_property_set=given.__contains__)

    def invoke(self):
        importlib.import_module(f"{ADDON}.operators.edit").LongEdit.invoke(self, bpy.context, None)
        return self

    def execute(self, context):
        assert context is bpy.context


def test_a_button_puts_lamps_a_metre_apart(lamp):
    spacing = Invoked("array").invoke().spacing
    assert spacing == pytest.approx(100.0)
    assert bpy.ops.geoanalogy.array("EXEC_DEFAULT", True, mirror="NO", spacing=spacing) == {"FINISHED"}
    assert 10 < len(results()) < 40


@pytest.mark.parametrize(
    ("operator", "option", "expected"), [("extrude", "height", 300.0), ("scatter", "density", 1e-5)]
)
def test_a_button_means_metres_until_something_is_given(operator, option, expected):
    bpy.context.scene.unit_settings.scale_length = CENTIMETRES
    assert getattr(Invoked(operator).invoke(), option) == pytest.approx(expected)
    assert getattr(Invoked(operator, **{option: 7.0}).invoke(), option) == 7.0
    bpy.context.scene.unit_settings.scale_length = 1.0
    assert getattr(Invoked(operator).invoke(), option) == pytest.approx({"height": 3.0, "density": 0.1}[option])


def test_a_node_that_is_added_has_three_metres_too(lamp):
    assert bpy.ops.geoanalogy.extrude("EXEC_DEFAULT", True, label="bedroom") == {"FINISHED"}
    assert bridge("tree.new_nodes").new_node(operations_tree(), "extrusion", "door").height == pytest.approx(300.0)
