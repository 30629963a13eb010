"""Operations in a .blend: saved, reopened, appended, undone, and kept by a Blender without the add-on."""

import json
import os
import subprocess
import sys
from pathlib import Path

import bpy
import pytest
from conftest import INSIDE_BLENDER
from flats import activate, bed, box, bridge, engine, everything, operations_tree, placed, reload, results, rooms

EXEC = "EXEC_DEFAULT"


def two_operations():
    rooms()
    bed()
    bpy.ops.geoanalogy.propagate(EXEC, True, most=2)
    activate(box("Table", (0.4, 0.4, 0.4), "night table", at=(0.2, 1.75, 0)))
    bpy.ops.geoanalogy.propagate(EXEC, True)
    return operations_tree()


@pytest.mark.parametrize(
    "plain",
    [
        {"a": 1, "b": 0.1, "c": True, "d": "text", "e": [1.0, 2.0], "f": {"g": [0.1]}},
        {"none": None, "empty": {}, "list": [], "mixed": [1, "a", None], "nested": [[1.0], [2.0]], "whole": [1, 2]},
        {"long": {"k" * 80: 1}, "big": 2**40, "mark": "json:no", "blank": {"": 1}, "accents": {"Küche": "Spüle"}},
    ],
)
def test_plain_data_comes_back_from_custom_properties(plain):
    conversion = bridge("tree.plain")
    item = bpy.data.objects.new("carrier", None)
    item["data"] = {key: conversion.to_property(value) for key, value in plain.items()}
    assert conversion.from_property(item["data"]) == plain


def test_the_stored_tree_is_the_engines():
    tree = two_operations()
    store = bridge("tree.store")
    stored = store.engine_tree(store.ordered_nodes(tree))
    assert [(n.id, n.operation.type, [k.node for k in n.inputs]) for n in stored.nodes] == [
        ("bed", "pose placement", []),
        ("night table", "pose placement", ["bed"]),
    ]
    again = engine("operations.tree").OperationsTree.from_dict(stored.to_dict())
    assert again.to_dict() == stored.to_dict()


def test_the_stored_tree_applied_by_the_engine_is_what_stands_there():
    tree = two_operations()
    store, evaluating = bridge("tree.store"), bridge("tree.evaluating")
    (around,) = evaluating.read_surroundings(bpy.context)
    elements = store.engine_tree(store.ordered_nodes(tree)).apply(around.ground.scene, tree.seed)
    expected = [(e.node, e.key, *e.pose.position) for e in elements if not e.example]
    found = [(i["ga_node"], i["ga_key"], *i.location[:2]) for i in results()]
    assert [f[:2] for f in found] == [e[:2] for e in expected]
    for f, e in zip(found, expected, strict=True):
        assert f[2:] == pytest.approx(e[2:], abs=1e-5)


def test_a_file_reopened_is_as_it_was_and_can_be_worked_on(tmp_path):
    two_operations()
    before = everything(), placed()
    reload(tmp_path / "flat.blend")
    assert (everything(), placed()) == before
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    assert (everything(), placed()) == before
    activate(box("Rug", (0.5, 0.5, 0.01), "rug", at=(2.5, 1.5, 0)))
    assert bpy.ops.geoanalogy.propagate(EXEC, True) == {"FINISHED"}
    assert [k.from_node.name for k in operations_tree().nodes["rug"].inputs[0].links] == ["night table"]


def test_a_file_saved_without_the_add_on_loses_nothing(tmp_path):
    two_operations()
    before = everything(), placed()
    source, target, said = (tmp_path / name for name in ("in.blend", "out.blend", "said.json"))
    bpy.ops.wm.save_as_mainfile(filepath=str(source))
    script = str(Path(__file__).with_name("without_the_add_on.py"))
    command = (
        [bpy.app.binary_path, "--background", "--python", script, "--"] if INSIDE_BLENDER else [sys.executable, script]
    )
    profile = tmp_path / "profile"
    profile.mkdir()
    environment = {**os.environ, "BLENDER_USER_RESOURCES": str(profile)}
    subprocess.run([*command, source, target, said], env=environment, check=True, timeout=300)
    assert json.loads(said.read_text()) == {
        "registered": False,
        "types": ["pose placement", "pose placement"],
        "links": 1,
        "objects": sorted(i.name for i in results()),
    }
    bpy.ops.wm.open_mainfile(filepath=str(target))
    assert (everything(), placed()) == before
    bpy.ops.geoanalogy.replay(EXEC, True)
    assert (everything(), placed()) == before


def test_an_appended_tree_brings_its_examples_and_furnishes_another_plan(tmp_path):
    two_operations()
    name = operations_tree().name
    source = tmp_path / "style.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(source))
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    for item in rooms(4):
        item.location.y += 20.0
    with bpy.data.libraries.load(str(source)) as (_, wanted):
        wanted.node_groups = [name]
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    beds = results("bed")
    assert {i.data.name for i in beds} == {"Bed"}
    assert {int(i.location.x // 5) for i in beds} == {0, 1, 2, 3}
    assert all(i.location.y > 20 for i in results())
    assert results("night table")


def test_a_scene_of_its_own_has_operations_of_its_own():
    two_operations()
    other = bpy.data.scenes.new("Other")
    bpy.context.window.scene = other
    rooms(2)
    bed()
    assert bpy.ops.geoanalogy.propagate(EXEC, True) == {"FINISHED"}
    assert len(operations_tree().nodes) == 1
    assert {len(t.nodes) for t in bpy.data.node_groups} == {1, 2}


def test_undo_and_redo_keep_tree_and_results_together():
    rooms()
    bed()
    bpy.ops.ed.undo_push(message="scene")
    states = [(everything(), placed())]
    bpy.ops.geoanalogy.propagate(EXEC, True)
    states.append((everything(), placed()))
    activate(results()[0])
    bpy.ops.ed.undo_push(message="selection")
    bpy.ops.geoanalogy.reject(EXEC, True)
    states.append((everything(), placed()))
    bpy.ops.ed.undo()
    bpy.ops.ed.undo()
    bpy.ops.ed.undo()
    assert (everything(), placed()) == states[0]
    for state in states[1:]:
        bpy.ops.ed.redo()
        if state is states[2]:
            bpy.ops.ed.redo()
        assert (everything(), placed()) == state
    bpy.ops.geoanalogy.replay(EXEC, True)
    assert placed() == states[2][1]


def test_removing_an_example_leaves_its_results_and_a_replay_still_works():
    two_operations()
    bpy.data.objects.remove(bpy.data.objects["Table"])
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    assert results("night table") == []
    assert results("bed")


def test_a_job_is_advanced_in_slices_and_cancelled_between_two():
    jobs = bridge("jobs")
    taken = []

    def steps():
        for i in range(5):
            taken.append(i)
            yield i / 5, f"step {i}"
        return "done"

    job = jobs.Job(steps())
    job.advance(0.0)
    assert (job.fraction, job.text, job.finished) == (0.0, "step 0", False)
    while not job.finished:
        job.advance(0.0)
    assert (job.result, taken) == ("done", [0, 1, 2, 3, 4])
    other = jobs.Job(steps())
    other.advance(0.0)
    other.cancel()
    assert taken[5:] == [0]


def test_a_propagation_that_is_cancelled_halfway_changes_nothing():
    rooms(6)
    item = bed()
    before = everything()
    steps = bridge("tree.recording").pose_steps(bpy.context, item)
    for _ in range(4):
        next(steps)
    steps.close()
    assert everything() == before


def test_every_scene_has_collections_of_its_own_whatever_blender_calls_them():
    holders = bridge("holders")
    first, second = bpy.context.scene, bpy.data.scenes.new("Other")
    one, other = (holders.ensure_holder(scene.collection, "plot") for scene in (first, second))
    assert (one.name, other.name) == ("plot", "plot.001")
    assert holders.ensure_holder(second.collection, "plot") == other
    holders.ensure_holder(second.collection, "plot.old")
    assert holders.ensure_holder(first.collection, "plot") == one and len(second.collection.children) == 2
    told = holders.ensure_holder_with(second.collection, "ga_node", "bed", "Beds")
    told.name = "Renamed"
    assert holders.ensure_holder_with(second.collection, "ga_node", "bed") == told
    assert holders.holder_with(first.collection, "ga_node", "bed") is None
