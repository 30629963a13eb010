"""Arrays as they are made by hand: with and without an end, whichever object was clicked last."""

import bpy
import pytest
from flats import activate, box, link, operations_tree, results, rooms
from mathutils import Matrix

EXEC = "EXEC_DEFAULT"


@pytest.fixture
def lamp():
    rooms(2)
    return box("Lamp", (0.2, 0.2, 1.0), "lamp", at=(0.5, 2.6, 0))


@pytest.fixture
def end():
    item = link(bpy.data.objects.new("End", None))
    item.location = (3.5, 2.6, 0)
    return item


def array(**settings):
    assert bpy.ops.geoanalogy.array(EXEC, True, mirror="NO", **settings) == {"FINISHED"}
    return sorted(tuple(round(v, 2) for v in item.location[:2]) for item in results())


def test_the_empty_may_be_clicked_last(lamp, end):
    activate(lamp, end)
    expected = array()
    activate(end, lamp)
    assert array() == expected
    assert [node.name for node in operations_tree().nodes] == ["lamp"]


def test_an_array_that_is_given_an_end_stays_the_same_operation(lamp, end):
    activate(lamp)
    all_round = array()
    activate(lamp, end)
    up_to_the_end = array()
    assert len(up_to_the_end) < len(all_round)
    assert [node.name for node in operations_tree().nodes] == ["lamp"]
    activate(lamp)
    assert array() == all_round
    assert len(operations_tree().nodes) == 1


def test_arrays_to_different_ends_are_different_operations(lamp, end):
    activate(lamp, end)
    array()
    other = link(bpy.data.objects.new("Other End", None))
    other.location = (0.5, 0.4, 0)
    activate(lamp, other)
    array(validate=False)
    assert len(operations_tree().nodes) == 2


def test_the_names_of_more_than_a_thousand_are_in_their_order(lamp):
    # Blender would go back over all that come later for each name that is out of order.
    lamp.data.transform(Matrix.Scale(0.01, 4))
    activate(lamp)
    assert len(array(spacing=0.01)) > 1000
    made = [item.name for item in results()]
    assert made == sorted(made) == [f"lamp {i:04d}" for i in range(1, len(made) + 1)]


def test_two_empties_are_no_array(end):
    rooms(2)
    other = link(bpy.data.objects.new("Other", None))
    activate(other, end)
    with pytest.raises(RuntimeError, match="object 'Other' has no label; say what it is in step 2"):
        bpy.ops.geoanalogy.array(EXEC, True)
