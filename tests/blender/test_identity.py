"""Objects of the plan stay known to operations when they are renamed or copied."""

import bpy
import numpy as np
import pytest
from flats import ROOM, activate, bed, bridge, face, operations_tree, placed, propagate, reload, results, rooms

EXEC = "EXEC_DEFAULT"


def replay():
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}


def poses(items=None):
    return [row[2:] for row in placed(items)]


def ids():
    return bridge("reading.identity").ids_of(bpy.context.scene)


def decide(index, operator, **moved):
    """Accept or reject a result, and return its key."""
    item = activate(results()[index])
    for name, value in moved.items():
        setattr(item, name, value)
    key = item["ga_key"]
    assert getattr(bpy.ops.geoanalogy, operator)(EXEC, True) == {"FINISHED"}
    return key


def test_decisions_outlast_the_renaming_of_rooms(tmp_path):
    rooms(4)
    bed()
    node = propagate()
    gone = decide(1, "reject")
    moved = decide(0, "accept", location=results()[0].location * 1.01)
    before = poses()
    for room in [item for item in bpy.data.objects if item.get("ga_label") == "bedroom"]:
        room.name = f"guest {room.name}"
    node.threshold = 1.0
    assert [i["ga_key"] for i in results()] == [moved]
    node.threshold = 0.5
    assert np.allclose(poses(), before, atol=1e-4)
    for again in (replay, lambda: reload(tmp_path / "renamed.blend"), replay):
        again()
        assert np.allclose(poses(), before, atol=1e-4)
        assert gone not in [i["ga_key"] for i in results()] and moved in [i["ga_key"] for i in results()]


def test_the_renaming_of_a_room_is_no_change_of_the_plan():
    rooms()
    bed()
    propagate()
    evaluated = bridge("tree.evaluating").evaluations.evaluated
    bpy.data.objects["room 1"].name = "guest room"
    replay()
    assert bridge("tree.evaluating").evaluations.evaluated == evaluated


def test_a_new_object_of_the_former_name_is_another_one():
    rooms()
    bed()
    propagate()
    bpy.data.objects["room 1"].name = "guest room"
    face("room 1", ROOM, "bedroom", at=(20.0, 0.0, 0.0))
    assert ids()["guest room"] == "room 1" and ids()["room 1"] == "room 1.001"
    decide(0, "reject")
    replay()
    assert ids()["guest room"] == "room 1" and bpy.data.objects["room 1"]["ga_id"] == "room 1.001"


def test_copies_have_ids_of_their_own():
    rooms()
    bed()
    propagate()
    room = bpy.data.objects["room 1"]
    for i in range(2):
        copy = room.copy()
        copy.location.x = 20.0 + 5.0 * i
        bpy.context.scene.collection.objects.link(copy)
    assert {name: id for name, id in ids().items() if name.startswith("room 1")} == {
        name: name for name in ("room 1", "room 1.001", "room 1.002")
    }
    replay()
    assert [bpy.data.objects[name]["ga_id"] for name in ("room 1.001", "room 1.002")] == ["room 1.001", "room 1.002"]
    # From then on each keeps its own, also where the first is gone.
    room.name = "guest room"
    assert ids()["guest room"] == "room 1"
    bpy.data.objects.remove(room)
    assert ids()["room 1.001"] == "room 1.001"


def test_a_stated_parent_and_a_swing_are_found_by_their_names():
    made = rooms()
    house = face("House", [(-1, -1), (15, -1), (15, 4), (-1, 4)], "house")
    made[0]["ga_parent"] = "House"
    bed()
    propagate()
    house.name = made[0]["ga_parent"] = "Cottage"
    grounds = bridge("reading.ground").read_grounds(bpy.context.scene, bpy.context.evaluated_depsgraph_get())
    assert grounds[0].scene.polygon("room 0").parent == "House" == ids()["Cottage"]


def test_operations_stay_applied_to_selected_parcels_that_are_renamed():
    rooms()
    bed()
    propagate()
    activate(bpy.data.objects["room 1"])
    assert bpy.ops.geoanalogy.apply(EXEC, True, parcels="SELECTED") == {"FINISHED"}
    before = poses()
    assert len(before) == 1
    bpy.data.objects["room 1"].name = "guest room"
    replay()
    assert np.allclose(poses(), before, atol=1e-4)


@pytest.mark.parametrize("operator", ["propagate", "replay"])
def test_ids_are_undone_with_what_has_given_them(operator):
    rooms()
    bed()
    if operator == "replay":
        propagate()
        for item in bpy.data.objects:
            item.pop("ga_id", None)
    bpy.ops.ed.undo_push()
    assert getattr(bpy.ops.geoanalogy, operator)(EXEC, True) == {"FINISHED"}
    assert bpy.data.objects["room 1"]["ga_id"] == "room 1"
    bpy.ops.ed.undo()
    assert "ga_id" not in bpy.data.objects["room 1"]
    assert operator == "propagate" or operations_tree() is not None


def full_copy():
    bpy.ops.scene.new(type="FULL_COPY")
    return bpy.context.scene


def test_a_full_copy_of_a_scene_gets_operations_of_its_own():
    rooms()
    bed()
    propagate()
    first, before = bpy.context.scene, poses()
    sharers = bridge("tree.sharing").sharers
    with pytest.raises(RuntimeError, match="no other scene shares the operations of 'Scene'; they are its own already"):
        bpy.ops.geoanalogy.own_tree(EXEC, True)
    second = full_copy()
    assert sharers(second) == [first] and sharers(first) == [second]
    assert bpy.ops.geoanalogy.own_tree(EXEC, True) == {"FINISHED"}
    assert sharers(first) == sharers(second) == [] and first.geoanalogy.tree != second.geoanalogy.tree
    (entry,) = second.geoanalogy.tree.nodes["bed"]["examples"].values()
    assert entry["object"] == second.objects["Bed.001"]
    replay()
    assert np.allclose(poses(), before, atol=1e-4)
    # What is decided and moved in one scene leaves the other as it is.
    second.objects["Bed.001"].location.y -= 1.0
    replay()
    assert not np.allclose(poses(), before, atol=0.5)
    decide(0, "reject")
    assert len(poses()) == len(before) - 1
    bpy.context.window.scene = first
    assert np.allclose(poses(), before, atol=1e-4)
    replay()
    assert np.allclose(poses(), before, atol=1e-4)


def test_operations_of_its_own_are_undone():
    rooms()
    bed()
    propagate()
    full_copy()
    bpy.ops.ed.undo_push()
    assert bpy.ops.geoanalogy.own_tree(EXEC, True) == {"FINISHED"}
    bpy.ops.ed.undo()
    assert [tree.name for tree in bpy.data.node_groups] == ["Scene operations"]
    assert len(bridge("tree.sharing").sharers(bpy.context.scene)) == 1


def test_a_scene_without_copies_of_the_examples_keeps_what_was_learned():
    rooms()
    bed()
    tree = propagate().id_data
    bpy.context.window.scene = other = bpy.data.scenes.new("Other")
    other.geoanalogy.tree = tree
    rooms()
    assert bpy.ops.geoanalogy.own_tree(EXEC, True) == {"FINISHED"}
    replay()
    assert len(results()) == 3
