"""Scenes as people have them: other units, sizes and names, shared data, parents that mirror, empty layers."""

import bpy
import numpy as np
import pytest
from flats import ROOM, activate, bed, box, bridge, face, link, placed, propagate, results, rooms
from mathutils import Matrix
from pictures import PLACES, RING, all_leaves, draw_query, find, operations, stroke_drawing, world_points

EXEC = "EXEC_DEFAULT"


def matrices():
    bpy.context.view_layer.update()
    return np.array([row[2:] for row in placed()]).reshape(-1, 4, 4)


def furnished(prepare=lambda: None):
    """Where beds are put, after something odd has been done to the scene."""
    rooms()
    bed()
    prepare()
    propagate()
    return matrices()


EXPECTED = np.array([[6.0, 2.5, 0.0], [11.0, 2.5, 0.0]])


@pytest.mark.parametrize(
    ("system", "scale"), [("METRIC", 0.01), ("METRIC", 1000.0), ("IMPERIAL", 1.0), ("IMPERIAL", 0.01), ("NONE", 1.0)]
)
def test_units_change_nothing(system, scale):
    units = bpy.context.scene.unit_settings
    units.system, units.scale_length = system, scale
    assert furnished()[:, :3, 3] == pytest.approx(EXPECTED, abs=1e-3)


def scale_everything(factor, shift=(0.0, 0.0, 0.0)):
    for item in bpy.context.scene.objects:
        item.data.transform(Matrix.Scale(factor, 4))
        item.location = item.location * factor
        item.location[0] += shift[0]
        item.location[1] += shift[1]


@pytest.mark.parametrize("factor", [1e-3, 1e-2, 100.0, 1e4])
def test_plans_may_be_tiny_or_large(factor):
    found = furnished(lambda: scale_everything(factor))
    assert found[:, :3, 3] / factor == pytest.approx(EXPECTED, abs=2e-3)


def test_plans_may_lie_far_from_the_origin():
    """At a thousand kilometres, single precision is six centimetres."""
    shift = np.array((1e6, -1e6, 0.0))
    found = furnished(lambda: scale_everything(1.0, shift))
    assert found[:, :3, 3] - shift == pytest.approx(EXPECTED, abs=0.2)


NAMES = (
    'Schlafzimmer für Gäste: Bett/Ä, 2 "groß"',
    "寝室 の ベッド",
    "غرفة",
    "🛏",
    "l" * 50 + "o" * 10,
    "a/0",
    "a@1,2",
    "%s{0}",
)


@pytest.mark.parametrize("name", NAMES)
def test_names_and_labels_of_all_scripts(name):
    def rename():
        for item in bpy.context.scene.objects:
            item["ga_label"] = f"{name} {item['ga_label']}"
            item.name = f"{name} {item.name}"[:60]

    assert furnished(rename)[:, :3, 3] == pytest.approx(EXPECTED, abs=1e-3)
    activate(results()[0])
    assert bpy.ops.geoanalogy.reject(EXEC, True) == {"FINISHED"}
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    assert matrices()[:, :3, 3] == pytest.approx(EXPECTED[1:], abs=1e-3)


def test_operations_on_long_labels_have_names_that_blender_keeps():
    free_id = bridge("tree.editing").free_id
    assert free_id(None, "寝" * 30) == "寝" * 21
    rooms()
    for i in range(2):
        activate(box(f"Bed {i}", (0.5, 0.5, 0.5), "b" * 80, at=(0.25 + i, 2.75, 0.0)))
        propagate()
    assert [node.name for node in operations().nodes] == ["b" * 63, "b" * 61 + " 2"]
    assert free_id(operations(), "b" * 70) == "b" * 61 + " 3"


def test_meshes_may_have_many_users():
    def share():
        for kind in ("room", "door"):
            for i in (1, 2):
                bpy.data.objects[f"{kind} {i}"].data = bpy.data.objects[f"{kind} 0"].data

    assert furnished(share)[:, :3, 3] == pytest.approx(EXPECTED, abs=1e-3)


def test_parents_may_mirror_turn_and_scale_the_plan():
    """What is seen counts, whatever it is composed of."""

    def hang():
        parent = link(bpy.data.objects.new("Parent", None))
        parent.matrix_world = (
            Matrix.Translation((3, 1, 2)) @ Matrix.Rotation(0.4, 4, "Z") @ Matrix.Diagonal((-2, 3, 1, 1))
        )
        bpy.context.view_layer.update()
        for item in [item for item in bpy.context.scene.objects if item.type == "MESH" and item.name != "Bed"]:
            there = item.matrix_world.copy()
            item.parent = parent
            item.matrix_parent_inverse = parent.matrix_world.inverted()
            item.matrix_world = there

    assert furnished(hang)[:, :3, 3] == pytest.approx(EXPECTED, abs=1e-3)


def test_a_mirrored_room_is_a_mirror_image():
    rooms(2)
    bed()
    for name in ("room 1", "door 1"):
        bpy.data.objects[name].scale.x = -1.0
        bpy.data.objects[name].location.x = 12.0
    bpy.context.view_layer.update()
    propagate(mirror="YES")
    (found,) = matrices()
    assert found[:3, 3] == pytest.approx((11.0, 2.5, 0.0), abs=1e-3)


def test_an_outline_in_edit_mode_counts_as_it_is_edited():
    rooms()
    bed()
    room = activate(bpy.data.objects["room 2"])
    bpy.ops.object.mode_set(mode="EDIT")
    with pytest.raises(RuntimeError, match="Leave to Object Mode first"):
        bpy.ops.geoanalogy.propagate(EXEC)
    bpy.ops.object.mode_set(mode="OBJECT")
    assert room.mode == "OBJECT"
    activate(bpy.data.objects["Bed"])
    propagate()
    assert matrices()[:, :3, 3] == pytest.approx(EXPECTED, abs=1e-3)


def pencil(layers):
    """A grease pencil with a closed stroke round each of these rings, on a layer each; none: an empty layer."""
    pencils = bpy.data.grease_pencils if bpy.app.version >= (5, 0, 0) else bpy.data.grease_pencils_v3
    data = pencils.new("Sketch")
    for i, ring in enumerate(layers):
        layer = data.layers.new(f"layer {i}")
        if ring is None:
            continue
        drawing = layer.frames.new(1).drawing
        if len(ring):
            drawing.add_strokes([len(ring)])
            for point, (x, y) in zip(drawing.strokes[0].points, ring, strict=True):
                point.position = (x, y, 0.0)
            drawing.strokes[0].cyclic = True
    return link(bpy.data.objects.new("Sketch", data), "bedroom")


@pytest.mark.parametrize("lock", [False, True])
def test_layers_may_be_empty_or_locked(lock):
    face("room 0", ROOM, "bedroom")
    item = pencil([None, [(x + 5.0, y) for x, y in ROOM], []])
    for layer in item.data.layers:
        layer.lock = lock
    bed()
    propagate()
    assert matrices()[:, :3, 3] == pytest.approx(EXPECTED[:1], abs=1e-3)


def test_a_grease_pencil_without_strokes_is_named():
    rooms()
    pencil([None, []])
    bed()
    with pytest.raises(
        RuntimeError, match="object 'Sketch' has no closed line; draw its outline, or take its label away"
    ):
        bpy.ops.geoanalogy.propagate(EXEC, True)


@pytest.mark.parametrize("factor", [1e-3, 1.0, 1e3])
def test_drawings_may_be_tiny_or_large(factor):
    stroke_drawing(all_leaves())
    item = bpy.context.scene.objects["Strokes"]
    item.scale = (factor,) * 3
    bpy.context.view_layer.update()
    draw_query(points=RING * factor, name="leaf")
    find()
    found = np.array([world_points(item).mean(axis=0)[:2] for item in results()]) / factor
    places = np.array([at for at, *_ in PLACES[1:]], float)
    assert len(found) == 2 and operations() is not None
    assert np.abs(found[:, None] - places[None]).max(axis=2).min(axis=1).max() < 1.0


def test_an_example_that_is_hidden_is_named_by_what_is_selected():
    rooms()
    item = bed()
    item.hide_set(True)
    with pytest.raises(RuntimeError, match=r"nothing is selected; select the object to propagate"):
        bpy.ops.geoanalogy.propagate(EXEC, True)
    assert bridge("tree.store").tree_of(bpy.context.scene) is None


def test_a_scaled_example_is_repeated_as_it_is():
    rooms()
    item = activate(box("Bed", (1.0, 0.5, 0.5), "bed", at=(1.0, 2.5, 0.0)))
    item.scale = (2.0, 2.0, 1.0)
    propagate()
    found = matrices()
    assert found[:, :3, 3] == pytest.approx(EXPECTED, abs=1e-3)
    assert [np.linalg.norm(m[:3, :3], axis=0) for m in found] == [pytest.approx((2.0, 2.0, 1.0), abs=1e-4)] * 2


def test_a_plan_inside_a_collection_instance_is_told_and_used_once_it_is_real():
    made = rooms(2)
    flat = bpy.data.collections.new("Flat")
    for item in made:
        bpy.context.scene.collection.objects.unlink(item)
        flat.objects.link(item)
    instance = link(bpy.data.objects.new("Linked Flat", None))
    instance.instance_type, instance.instance_collection = "COLLECTION", flat
    bed()
    with pytest.raises(RuntimeError, match="the plan is inside the collection instance 'Linked Flat', where nothing"):
        propagate()
    activate(instance)
    bpy.ops.object.duplicates_make_real()
    activate(bpy.data.objects["Bed"])
    propagate()
    assert len(results()) == 1
