"""Sifting results, and the list of operations: nothing is computed that need not be."""

import math

import bpy
import pytest
from flats import (
    activate,
    bed,
    box,
    bridge,
    everything,
    face,
    operations_tree,
    placed,
    propagate,
    reload,
    results,
    rooms,
    three_operations,
)

EXEC = "EXEC_DEFAULT"


# Sifting


def test_the_threshold_sifts_without_computing():
    rooms()
    # A room of another shape: its bed answers only part of the relations.
    face("hall", [(15, 0), (22, 0), (22, 5), (15, 5)], "bedroom")
    bed()
    node = propagate(most=0, threshold=0.1)
    every = placed()
    evaluated = bridge("tree.evaluating").evaluations.evaluated
    node.threshold = 0.95
    few = placed()
    assert 0 < len(few) < len(every)
    assert all(any(f[2:] == e[2:] for e in every) for f in few)
    node.threshold = 0.1
    assert placed() == every
    assert bridge("tree.evaluating").evaluations.evaluated == evaluated


def test_the_threshold_sifts_in_a_reopened_file(tmp_path):
    rooms()
    face("hall", [(15, 0), (22, 0), (22, 5), (15, 5)], "bedroom")
    bed()
    propagate(most=0, threshold=0.95)
    few = placed()
    reload(tmp_path / "f.blend")
    node = operations_tree().nodes.active
    node.threshold = 0.1
    assert len(results()) > len(few)
    node.threshold = 0.95
    assert placed() == few


def test_rejected_results_stay_away_and_come_back_when_forgotten(capfd):
    rooms()
    bed()
    propagate()
    every = placed()
    gone = activate(results()[0])
    key = gone["ga_key"]
    assert bpy.ops.geoanalogy.reject(EXEC, True) == {"FINISHED"}
    assert "1 rejected, 1 left" in "".join(capfd.readouterr())
    assert key not in [i["ga_key"] for i in results()]
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    assert key not in [i["ga_key"] for i in results()]
    assert bpy.ops.geoanalogy.forget_decisions(EXEC, True) == {"FINISHED"}
    assert placed() == every


def test_accepted_results_stay_whatever_the_threshold():
    rooms()
    face("hall", [(15, 0), (22, 0), (22, 5), (15, 5)], "bedroom")
    bed()
    node = propagate(most=0, threshold=0.1)
    worst = activate(results()[-1])
    key = worst["ga_key"]
    assert bpy.ops.geoanalogy.accept(EXEC, True) == {"FINISHED"}
    node.threshold = 0.99
    assert key in [i["ga_key"] for i in results()]


def test_a_moved_result_that_is_accepted_stays_where_it_is():
    rooms()
    bed()
    propagate()
    moved = activate(results()[0])
    key = moved["ga_key"]
    moved.location.y -= 1.0
    moved.rotation_euler[2] += 0.3
    there = moved.location.copy(), moved.rotation_euler[2]
    assert bpy.ops.geoanalogy.accept(EXEC, True) == {"FINISHED"}
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    kept = next(i for i in results() if i["ga_key"] == key)
    assert kept.location[:] == pytest.approx(there[0][:], abs=1e-5)
    assert math.remainder(kept.rotation_euler[2] - there[1], 2 * math.pi) == pytest.approx(0.0, abs=1e-5)


def test_reject_below_keeps_weak_results_away():
    rooms()
    face("hall", [(15, 0), (22, 0), (22, 5), (15, 5)], "bedroom")
    bed()
    node = propagate(most=0, threshold=0.95)
    few = placed()
    assert bpy.ops.geoanalogy.reject_below(EXEC, True) == {"FINISHED"}
    node.threshold = 0.1
    assert placed() == few


def test_explain_lists_the_relations_of_a_result():
    rooms()
    bed()
    propagate()
    item = activate(results()[0])
    assert bpy.ops.geoanalogy.explain(EXEC) == {"FINISHED"}
    reasons = bridge("tree.explanation").explanation_of(bpy.context.scene, item)
    assert sum(r.share for r in reasons) == pytest.approx(1.0, abs=0.01)
    assert any("bedroom" in r.text for r in reasons)
    bpy.ops.ed.undo_push(message="more")
    bpy.ops.ed.undo_push(message="still more")
    bpy.ops.ed.undo()
    assert bridge("tree.explanation").explanation_of(bpy.context.scene, bpy.data.objects[results()[0].name]) is None


# The list of operations


def test_replay_gives_the_identical_scene():
    three_operations()
    before = everything(), placed()
    for _ in range(2):
        assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
        assert (everything(), placed()) == before
    assert bpy.ops.geoanalogy.clear(EXEC, True) == {"FINISHED"}
    assert results() == []
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    assert (everything(), placed()) == before


def test_replay_follows_a_moved_example_and_what_builds_on_it():
    rooms()
    item = bed()
    propagate()
    activate(box("Table", (0.4, 0.4, 0.4), "night table", at=(0.2, 1.75, 0)))
    propagate()
    item.location.x += 0.25
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    assert results("bed")[0].location.x == pytest.approx(item.location.x + 5.0, abs=1e-3)


def test_what_a_user_puts_into_our_collections_stays():
    three_operations()
    own = bpy.data.objects.new("Mine", None)
    bpy.data.collections["bed"].objects.link(own)
    bpy.ops.geoanalogy.replay(EXEC, True)
    bpy.ops.geoanalogy.clear(EXEC, True)
    assert bpy.data.collections["bed"].objects[:] == [bpy.data.objects["Mine"]]


def test_remove_takes_an_operation_out_of_the_chain():
    names = three_operations()
    tree = operations_tree()
    tree.nodes.active = tree.nodes[names[1]]
    assert bpy.ops.geoanalogy.remove_operation(EXEC, True) == {"FINISHED"}
    assert results(names[1]) == []
    last = tree.nodes[names[2]]
    assert [link.from_node.name for link in last.inputs[0].links] == [names[0]]
    assert last["stale"]
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    assert "stale" not in last


def test_move_changes_the_order():
    names = three_operations()
    tree = operations_tree()
    tree.nodes.active = tree.nodes[names[2]]
    ordered = bridge("tree.store").ordered_nodes
    assert bpy.ops.geoanalogy.move_operation(EXEC, True, direction="UP") == {"FINISHED"}
    assert [n.name for n in ordered(tree)] == [names[0], names[2], names[1]]
    assert bpy.ops.geoanalogy.move_operation(EXEC, True, direction="DOWN") == {"FINISHED"}
    assert [n.name for n in ordered(tree)] == names
    with pytest.raises(RuntimeError, match="not one operation follows"):
        bpy.ops.geoanalogy.move_operation(EXEC, True, direction="DOWN")
    tree.nodes.active = tree.nodes[names[0]]
    with pytest.raises(RuntimeError, match="it is the first already"):
        bpy.ops.geoanalogy.move_operation(EXEC, True, direction="UP")


def test_mute_hides_results_and_brings_them_back():
    names = three_operations()
    tree = operations_tree()
    tree.nodes.active = tree.nodes[names[1]]
    before = placed(results(names[1]))
    assert bpy.ops.geoanalogy.mute_operation(EXEC, True) == {"FINISHED"}
    assert results(names[1]) == []
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    assert results(names[1]) == []
    assert bpy.ops.geoanalogy.mute_operation(EXEC, True) == {"FINISHED"}
    assert placed(results(names[1])) == before


def test_the_eye_of_a_row_mutes_the_operation_of_that_row():
    names = three_operations()
    tree = operations_tree()
    tree.nodes.active = tree.nodes[names[0]]
    assert bpy.ops.geoanalogy.mute_operation(EXEC, True, operation=names[1]) == {"FINISHED"}
    assert [node.mute for node in map(tree.nodes.get, names)] == [False, True, False]
    assert results(names[1]) == [] and results(names[0]) and tree.nodes.active.name == names[0]
    with pytest.raises(RuntimeError, match="there is no operation 'sofa'; click one in the list of step 5"):
        bpy.ops.geoanalogy.mute_operation(EXEC, True, operation="sofa")
