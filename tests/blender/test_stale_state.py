"""What becomes stale in a file: names, hidden and linked things, parents, other scenes, and saves between undos."""

import math

import bpy
import numpy as np
import pytest
from flats import activate, bed, bridge, operations_tree, placed, propagate, reload, results, rooms

EXEC = "EXEC_DEFAULT"


def replay():
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}


def poses(items=None):
    return [row[2:] for row in placed(items)]


def same(a, b, tolerance=1e-4):
    return len(a) == len(b) and np.allclose(np.array(a), np.array(b), atol=tolerance)


def layer_collection(name, root=None):
    root = root or bpy.context.view_layer.layer_collection
    if root.collection.name == name:
        return root
    return next((c for child in root.children if (c := layer_collection(name, child))), None)


def test_everything_may_be_renamed():
    rooms()
    item = bed()
    node = propagate()
    before = poses()
    item.name = "Cot"
    bpy.context.scene.name = "Flat"
    operations_tree().name = "Furnishing"
    node.threshold = 1.0
    node.threshold = 0.5
    assert same(poses(), before)
    # A polygon's name is its id: a replay finds it under the other one.
    bpy.data.objects["room 1"].name = "guest room"
    replay()
    assert same(poses(), before)
    assert {i.data for i in results()} == {item.data}


def test_a_node_may_be_renamed():
    rooms()
    bed()
    node = propagate()
    before = poses()
    node.name = "sleeping"
    node.threshold = 1.0
    node.threshold = 0.5
    assert same(poses(), before)
    assert {i["ga_node"] for i in results("sleeping")} == {"sleeping"} and len(results("sleeping")) == len(before)
    activate(results()[0])
    assert bpy.ops.geoanalogy.reject(EXEC, True) == {"FINISHED"}
    assert len(results()) == len(before) - 1
    replay()
    assert len(results()) == len(before) - 1


def test_a_copied_node_leaves_the_results_to_the_other():
    rooms()
    bed()
    propagate()
    before = poses(results("bed"))
    tree = operations_tree()
    copy = tree.nodes.new(tree.nodes["bed"].bl_idname)
    for key, value in tree.nodes["bed"].items():
        copy[key] = value
    copy.name = "cot"
    assert same(poses(results("bed")), before) and results("cot") == []
    assert copy["called"] == "cot"


def test_an_example_that_is_deleted_in_the_view_stays_known_to_its_operation(tmp_path):
    rooms()
    item = bed()
    node = propagate()
    before = poses()
    world = tuple(map(tuple, item.matrix_world))
    assert bpy.ops.object.delete() == {"FINISHED"}
    assert bpy.context.scene.objects.get("Bed") is None
    node.threshold = 1.0
    node.threshold = 0.5
    # The example's own place is a result like the others now.
    every = poses()
    replay()
    assert same(poses(), every)
    assert len(every) == len(before) + 1 and same([p for p in every if p[3] > 4], before)
    assert any(np.allclose(p, np.ravel(world), atol=1e-5) for p in every)
    reload(tmp_path / "without.blend")
    replay()
    assert same(poses(), every)


@pytest.mark.parametrize("how", ["exclude", "hide_viewport", "holdout", "collection"])
@pytest.mark.parametrize("which", ["Plan", "Things", "GeoAnalogy"])
def test_hidden_collections_change_nothing(which, how):
    made = rooms()
    item = bed()
    for name, items in (("Plan", made), ("Things", [item])):
        holder = bpy.data.collections.new(name)
        bpy.context.scene.collection.children.link(holder)
        for one in items:
            bpy.context.scene.collection.objects.unlink(one)
            holder.objects.link(one)
    node = propagate()
    before = poses()
    if how == "collection":
        layer_collection(which).collection.hide_viewport = True
    else:
        setattr(layer_collection(which), how, True)
    bpy.context.view_layer.update()
    node.threshold = 1.0
    node.threshold = 0.5
    replay()
    layer_collection(which).exclude = False
    layer_collection(which).hide_viewport = False
    layer_collection(which).collection.hide_viewport = False
    assert same(poses(), before)


HIDDEN = ("disabled", "excluded", "disabled collection", "by eye")


def hide(name, how):
    """Hide what is in a collection, in one of the ways that Blender has."""
    if how == "excluded":
        layer_collection(name).exclude = True
    elif how == "disabled collection":
        bpy.data.collections[name].hide_viewport = True
    for item in bpy.data.collections[name].objects:
        if how == "disabled":
            item.hide_viewport = item.hide_render = True
        elif how == "by eye":
            item.hide_set(True)


@pytest.mark.parametrize("how", HIDDEN)
@pytest.mark.parametrize("which", [["Plan"], ["Things"], ["Plan", "Things"]], ids="+".join)
def test_what_is_hidden_stands_where_it_stood_when_the_file_is_opened_again(tmp_path, which, how):
    """Blender stores no world matrices, and evaluates nothing that is disabled or excluded."""
    made = rooms()
    holder = bpy.data.objects.new("holder", None)
    holder.location, holder.rotation_euler = (3, 1, 2), (0, 0, math.pi / 2)
    made.append(holder)
    item = bed()
    for name, items in (("Plan", made), ("Things", [item])):
        collection = bpy.data.collections.new(name)
        bpy.context.scene.collection.children.link(collection)
        for one in items:
            if one != holder:
                bpy.context.scene.collection.objects.unlink(one)
            collection.objects.link(one)
    for one in made[:-1]:
        one.location = one.location - holder.location
        one.location.rotate(holder.rotation_euler.to_matrix().inverted())
        one.rotation_euler = (0, 0, -math.pi / 2)
        one.parent = holder
    activate(item)
    propagate()
    before = poses()
    assert same(sorted(p[3] for p in before), [6.0, 11.0])
    for name in which:
        hide(name, how)
    transforms = [(o.name, tuple(o.location), tuple(o.scale)) for o in bpy.data.objects if "ga_key" not in o]
    reload(tmp_path / "hidden.blend")
    replay()
    assert same(poses(), before) and not any(i.hide_viewport or i.hide_render for i in results())
    assert [(o.name, tuple(o.location), tuple(o.scale)) for o in bpy.data.objects if "ga_key" not in o] == transforms


@pytest.mark.parametrize("scale", [(2, 2, 2), (2, 0.5, 1)])
def test_parents_that_are_scaled_and_turned_do_not_matter(scale):
    rooms()
    item = bed()
    propagate()
    before = poses()
    bpy.ops.geoanalogy.clear(EXEC, True)
    holder = bpy.data.objects.new("holder", None)
    bpy.context.scene.collection.objects.link(holder)
    holder.location, holder.rotation_euler, holder.scale = (3, 1, 2), (0, 0, math.pi / 2), scale
    bpy.context.view_layer.update()
    for one in [o for o in bpy.context.scene.objects if o != holder]:
        world = one.matrix_world.copy()
        one.parent = holder
        one.matrix_parent_inverse = holder.matrix_world.inverted()
        bpy.context.view_layer.update()
        assert np.allclose(np.array(one.matrix_world), np.array(world), atol=1e-5)
    activate(item)
    propagate()
    assert same(poses(), before)


def test_undo_after_a_save_keeps_what_was_saved_and_what_was_not(tmp_path):
    bpy.context.preferences.edit.use_global_undo = True
    rooms()
    bed()
    bpy.ops.ed.undo_push(message="furnished")
    propagate()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "a.blend"))
    before = placed()
    activate(results()[0])
    bpy.ops.ed.undo_push(message="selected")
    bpy.ops.geoanalogy.reject(EXEC, True)
    assert len(results()) < len(before)
    bpy.ops.ed.undo()
    assert placed() == before
    bpy.ops.ed.redo()
    assert len(results()) < len(before)
    bpy.ops.ed.undo()
    node = operations_tree().nodes.active
    node.threshold = 1.0
    assert not results()
    replay()
    reload(tmp_path / "b.blend")
    operations_tree().nodes.active.threshold = 0.5
    assert placed() == before


def linked_library(tmp_path):
    """A library with a bed, and an empty file with rooms."""
    rooms()
    bed()
    path = tmp_path / "library.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    return path


def test_linked_plans_and_examples_are_used_as_they_are(tmp_path):
    path = linked_library(tmp_path)
    with bpy.data.libraries.load(str(path), link=True) as (there, here):
        here.objects = list(there.objects)
    for item in here.objects:
        bpy.context.scene.collection.objects.link(item)
    activate(bpy.data.objects["Bed"])
    node = propagate()
    before = poses()
    assert len(before) == 2 and all(i.library is None and i.data.library is not None for i in results())
    node.threshold = 1.0
    node.threshold = 0.5
    assert same(poses(), before)
    reload(tmp_path / "user.blend")
    replay()
    assert same(poses(), before)


@pytest.mark.parametrize(
    ("operator", "settings", "kind"),
    [
        ("set_label", {"label": "sofa"}, "object"),
        ("set_footprint", {"kind": "box"}, "object"),
        ("label_faces", {"label": "side"}, "mesh"),
        ("set_target", {}, "object"),
    ],
)
def test_linked_objects_are_not_edited(tmp_path, operator, settings, kind):
    path = linked_library(tmp_path)
    with bpy.data.libraries.load(str(path), link=True) as (_, here):
        here.objects = ["Bed"]
    bpy.context.scene.collection.objects.link(here.objects[0])
    item = activate(here.objects[0])
    before = dict(item.items())
    with pytest.raises(RuntimeError, match=f"{kind} 'Bed' is linked from another file; make it local"):
        getattr(bpy.ops.geoanalogy, operator)(EXEC, True, **settings)
    assert dict(item.items()) == before


@pytest.mark.parametrize(
    ("operator", "settings"), [("set_label", {"label": "sofa"}), ("set_footprint", {"kind": "box"}), ("set_target", {})]
)
def test_overrides_are_not_edited(tmp_path, operator, settings):
    """What is written to them is gone when the file is opened again."""
    path = linked_library(tmp_path)
    with bpy.data.libraries.load(str(path), link=True) as (_, here):
        here.objects = ["Bed"]
    bpy.context.scene.collection.objects.link(here.objects[0])
    item = activate(here.objects[0].override_create(remap_local_usages=True))
    before = dict(item.items())
    with pytest.raises(RuntimeError, match="object 'Bed' overrides one of another file"):
        getattr(bpy.ops.geoanalogy, operator)(EXEC, True, **settings)
    assert dict(item.items()) == before


def test_overrides_are_propagated(tmp_path):
    path = linked_library(tmp_path)
    with bpy.data.libraries.load(str(path), link=True) as (_, here):
        here.objects = ["Bed"]
    rooms()
    bpy.context.scene.collection.objects.link(here.objects[0])
    activate(here.objects[0].override_create(remap_local_usages=True))
    propagate()
    before = poses()
    assert len(before) == 2
    reload(tmp_path / "user.blend")
    replay()
    assert same(poses(), before)


def test_results_come_back_with_a_library_that_was_missing(tmp_path):
    path = linked_library(tmp_path)
    with bpy.data.libraries.load(str(path), link=True) as (_, here):
        here.objects = ["Bed"]
    bpy.context.scene.collection.objects.link(here.objects[0])
    rooms()
    activate(bpy.data.objects["Bed"])
    propagate()
    before = poses()
    file = tmp_path / "user.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(file))
    path.rename(tmp_path / "elsewhere.blend")
    bpy.ops.wm.open_mainfile(filepath=str(file))
    replay()
    assert len(results()) >= len(before) and operations_tree().nodes.active.get("problem") is None
    bpy.ops.wm.save_as_mainfile(filepath=str(file))
    (tmp_path / "elsewhere.blend").rename(path)
    bpy.ops.wm.open_mainfile(filepath=str(file))
    replay()
    assert same(poses(), before)


def test_an_object_of_the_same_name_in_a_library_is_another_one(tmp_path):
    path = linked_library(tmp_path)
    rooms()
    with bpy.data.libraries.load(str(path), link=True) as (_, here):
        here.objects = ["Bed"]
    theirs = here.objects[0]
    own = bed()
    bpy.context.scene.collection.objects.link(theirs)
    assert own.name == theirs.name and own.library is None
    theirs.location.x += 5.0
    activate(theirs)
    propagate()
    assert {i.data for i in results()} == {theirs.data}
    is_here = bridge("linked").is_here
    assert is_here(own, bpy.context.scene) and is_here(theirs, bpy.context.scene)
    bpy.context.scene.collection.objects.unlink(own)
    assert not is_here(own, bpy.context.scene) and is_here(theirs, bpy.context.scene)
