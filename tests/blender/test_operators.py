"""Every operator: its result is the engine's, it can be undone, and bad input leaves the scene as it was."""

import math

import bpy
import numpy as np
import pytest
from facades import frame, outline, ring, sill
from flats import (
    ROOM,
    activate,
    bed,
    box,
    bridge,
    engine,
    everything,
    face,
    link,
    operations_tree,
    placed,
    propagate,
    reload,
    results,
    rooms,
)
from mathutils import Vector

EXEC = "EXEC_DEFAULT"


def engine_results(item, **options):
    """What the engine itself says about an object among the labelled ones."""
    bpy.context.view_layer.update()
    depsgraph = bpy.context.evaluated_depsgraph_get()
    (ground,) = bridge("reading.ground").read_grounds(bpy.context.scene, depsgraph, {item.name})
    footprints = bridge("reading.footprints")
    pose = footprints.pose_of(item, ground.plane)
    ring = footprints.footprint_of(item, ground.plane, depsgraph)
    learned = engine("poses.propagate").learn_pose(
        ground.scene, pose, ring, engine("poses.options").PoseOptions(scale="fixed", threshold=0.1, **options)
    )
    return learned.place(ground.scene)


def poses_of(items):
    return [(*i.location[:2], i.rotation_euler[2]) for i in items]


def same_poses(found, expected):
    found, expected = np.array(found), np.array(expected)
    assert found.shape == expected.shape
    assert found[:, :2] == pytest.approx(expected[:, :2], abs=1e-5)
    assert np.exp(1j * found[:, 2]) == pytest.approx(np.exp(1j * expected[:, 2]), abs=1e-5)


# Labels, footprints, polygons, import


def test_set_label_labels_objects_collections_and_takes_labels_away():
    items = [face("a", ROOM), face("b", ROOM, at=(5, 0, 0))]
    activate(*items)
    assert bpy.ops.geoanalogy.set_label(EXEC, label=" bedroom ") == {"FINISHED"}
    assert [item["ga_label"] for item in items] == ["bedroom", "bedroom"]
    assert bpy.ops.geoanalogy.set_label(EXEC, label="") == {"FINISHED"}
    assert [item.get("ga_label") for item in items] == [None, None]
    holder = bpy.data.collections.new("flats")
    bpy.context.scene.collection.children.link(holder)
    bpy.context.view_layer.active_layer_collection = bpy.context.view_layer.layer_collection.children["flats"]
    assert bpy.ops.geoanalogy.set_label(EXEC, label="flat", target="COLLECTION") == {"FINISHED"}
    assert holder["ga_label"] == "flat"


def test_set_label_is_undone():
    activate(face("a", ROOM))
    bpy.ops.ed.undo_push(message="scene")
    bpy.ops.geoanalogy.set_label(EXEC, True, label="bedroom")
    bpy.ops.ed.undo()
    assert "ga_label" not in bpy.data.objects["a"]
    bpy.ops.ed.redo()
    assert bpy.data.objects["a"]["ga_label"] == "bedroom"


@pytest.mark.parametrize(("kind", "area"), [("hull", 3.5), ("outline", 3.0), ("box", 4.0)])
def test_set_footprint_takes_hull_outline_or_box(kind, area):
    rooms()
    corner = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
    sofa = activate(face("Sofa", corner, "sofa", at=(1, 1, 0)))
    sofa.rotation_euler[2] = math.radians(90)
    sofa.scale = (1.0, 1.0, 2.0)
    assert bpy.ops.geoanalogy.set_footprint(EXEC, kind=kind) == {"FINISHED"}
    polygon = engine().Polygon(np.array(sofa["ga_footprint"].to_list()).reshape(-1, 2))
    assert polygon.area == pytest.approx(area, rel=1e-4)
    ring = bridge("reading.footprints").footprint_of(
        sofa, bridge("reading.planes").Plane(), bpy.context.evaluated_depsgraph_get()
    )
    assert engine().Polygon(ring).centroid == pytest.approx(polygon.centroid, abs=1e-5)
    assert bpy.ops.geoanalogy.set_footprint(EXEC, kind="none") == {"FINISHED"}
    assert "ga_footprint" not in sofa


def test_make_polygons_makes_a_face_of_every_spline():
    bpy.ops.curve.primitive_bezier_circle_add(radius=2.0, location=(1, 2, 0))
    activate(bpy.context.object)
    assert bpy.ops.geoanalogy.make_polygons(EXEC, label="pond") == {"FINISHED"}
    plan = bpy.context.scene.geoanalogy.plan
    (made,) = plan.objects
    assert (made.type, made["ga_label"], len(made.data.polygons)) == ("MESH", "pond", 1)
    assert made.data.polygons[0].area == pytest.approx(math.pi * 4, rel=0.01)
    assert tuple(made.location) == pytest.approx((1, 2, 0), abs=1e-3)


def test_a_label_goes_over_to_the_polygons_that_are_made():
    bpy.ops.curve.primitive_bezier_circle_add(radius=2.0)
    drawn = bpy.context.object
    drawn["ga_label"] = "pond"
    activate(drawn)
    assert bpy.ops.geoanalogy.make_polygons(EXEC) == {"FINISHED"}
    (made,) = bpy.context.scene.geoanalogy.plan.objects
    assert made["ga_label"] == "pond"
    # The line does not count beside it.
    assert "ga_label" not in drawn


GEOJSON = """{"type": "FeatureCollection", "features": [
 {"type": "Feature", "properties": {"label": "house", "id": "h"}, "geometry": {"type": "Polygon", "coordinates":
  [[[0, 0], [9, 0], [9, 9], [0, 9], [0, 0]], [[4, 4], [5, 4], [5, 5], [4, 5], [4, 4]]]}},
 {"type": "Feature", "properties": {"label": "room", "id": "r", "parent": "h", "orientation": 0.5,
  "segment_labels": ["door", "", "", ""]}, "geometry": {"type": "Polygon", "coordinates":
  [[[1, 1], [3, 1], [3, 3], [1, 3], [1, 1]]]}}]}"""


def test_import_plan_keeps_what_the_file_says(tmp_path):
    path = tmp_path / "plan.geojson"
    path.write_text(GEOJSON)
    assert bpy.ops.geoanalogy.import_plan(EXEC, filepath=str(path)) == {"FINISHED"}
    bpy.context.view_layer.update()
    (ground,) = bridge("reading.ground").read_grounds(bpy.context.scene, bpy.context.evaluated_depsgraph_get())
    read = engine("formats.files").read_scene(path)
    for polygon in read.polygons:
        found = ground.scene.polygon(polygon.id)
        assert (found.label, found.parent, found.segment_labels) == (
            polygon.label,
            polygon.parent,
            polygon.segment_labels,
        )
        assert found.area == pytest.approx(polygon.area, rel=1e-6)
        assert found.centroid == pytest.approx(polygon.centroid, abs=1e-5)
        assert found.orientation == (None if polygon.orientation is None else pytest.approx(polygon.orientation))


# Propagation


def test_propagate_places_what_the_engine_says():
    rooms()
    item = bed()
    expected = [p for p in engine_results(item) if p.importance >= 0.5 and p.parent.id != "room 0"]
    best = {}
    for p in expected:
        best.setdefault(p.parent.id, p)
    node = propagate()
    found = results()
    same_poses(poses_of(found), [(*p.pose.position, p.pose.angle) for p in best.values()])
    assert {i.data for i in found} == {item.data}
    assert [i["ga_node"] for i in found] == [node.name] * len(found)
    assert node["count"] == len(found) == 2
    assert bpy.context.selected_objects == [item]


def test_results_stand_like_the_example():
    rooms()
    item = bed()
    item.location.z = 0.25
    item.scale = (1.0, 1.2, 0.5)
    item.rotation_euler = (0.0, 0.1, 0.0)
    propagate()
    for found in results():
        assert found.location.z == pytest.approx(0.25)
        assert tuple(found.scale) == pytest.approx((1.0, 1.2, 0.5))
        assert found.rotation_euler[1] == pytest.approx(0.1)


def test_mirrored_results_have_a_negative_y_scale():
    face("left", [(0, 0), (4, 0), (4, 3), (0, 3)], "room")
    face("left door", [(0, 0), (0.9, 0), (0.9, 0.9), (0, 0.9)], "door")
    face("right", [(5, 0), (9, 0), (9, 3), (5, 3)], "room")
    face("right door", [(8.1, 0), (9, 0), (9, 0.9), (8.1, 0.9)], "door")
    wedge = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.2), (-0.5, 0.5)]
    activate(face("Wedge", wedge, "wedge", at=(3.3, 2.4, 0.1)))
    propagate(mirror="YES")
    (found,) = results()
    assert found.scale[1] == pytest.approx(-1.0)
    assert found.location[:] == pytest.approx((5.7, 2.4, 0.1), abs=1e-3)
    assert found.matrix_world.determinant() < 0


def test_the_mirrored_twin_of_a_tilted_object_is_its_mirror_image():
    instances, planes = bridge("writing.instances"), bridge("reading.planes")
    item = box("Ramp", (1.0, 0.5, 0.3), "ramp")
    item.rotation_euler = (0.2, -0.3, 0.4)
    item.scale = (1.0, 2.0, 3.0)
    bpy.context.view_layer.update()
    level = planes.Plane()
    own = bridge("reading.footprints").pose_of(item, level)
    rest = bridge("reading.footprints").rest_of(item, own, level)
    pose = engine("poses.pose").Pose((2.0, 1.0), 0.7, mirrored=True)
    element = engine("operations.element").Element("ramp", "Ramp", "r", pose, None, "ramp", "r@0,0", scale=1.5)
    one = bridge("tree.store").Placed("Ramp", item, rest)
    assert instances.write_results(bpy.context.scene, "ramp", [(element, level)], [one]) == 1
    (found,) = results()
    bpy.context.view_layer.update()
    c, s = math.cos(0.7), math.sin(0.7)
    frame = np.array([(c, -s, 0, 2), (s, c, 0, 1), (0, 0, 1, 0), (0, 0, 0, 1)])
    expected = frame @ np.diag((1.5, -1.5, 1.5, 1.0)) @ rest
    corners = np.column_stack([np.array(item.bound_box), np.ones(8)])
    there = {tuple(p) for p in np.round((np.array(found.matrix_world) @ corners.T).T[:, :3], 3) + 0.0}
    # A negative y scale shows the mesh mirrored about its own x axis: a box is its own mirror image.
    assert there == {tuple(p) for p in np.round((expected @ corners.T).T[:, :3], 3) + 0.0}
    assert found.scale[1] == pytest.approx(-3.0)


def test_propagate_again_records_the_same_operation_anew():
    rooms()
    item = bed()
    node = propagate()
    item.location.x += 0.5
    assert propagate(threshold=0.3).name == node.name
    assert len(operations_tree().nodes) == 1
    assert results()[0].location.x == pytest.approx(item.location.x + 5.0, abs=1e-3)


def test_operations_build_on_each_other():
    rooms()
    item = bed()
    first = propagate()
    table = activate(box("Table", (0.4, 0.4, 0.4), "night table", at=(0.2, 1.75, 0)))
    second = propagate()
    assert [link.from_node.name for link in second.inputs[0].links] == [first.name]
    offset = np.subtract(table.location, item.location)
    for i, near in zip(results(second.name), results(first.name), strict=True):
        assert np.subtract(i.location, near.location) == pytest.approx(offset, abs=1e-2)


def test_children_of_the_example_come_along():
    rooms()
    item = bed()
    pillow = link(bpy.data.objects.new("Pillow", item.data))
    pillow.parent = item
    pillow.location = (0.5, 0.0, 0.5)
    pillow.scale = (0.1, 0.1, 0.1)
    propagate()
    bpy.context.view_layer.update()
    beds = [i for i in results() if i.parent is None]
    assert len(beds) == 2
    for made in beds:
        (child,) = made.children
        assert child.matrix_world.translation == made.matrix_world @ pillow.location


@pytest.mark.parametrize(
    ("settings", "options"),
    [
        ({"mirror": "NO"}, {"mirror": False}),
        ({"accumulation": "plane"}, {"accumulation": "plane"}),
        ({"validate": False}, {"validate": False}),
        ({"use_labels": False}, {"labels": False}),
        ({"symmetries": True}, {"symmetries": True}),
        ({"scale": "room"}, {"scale": "room"}),
        ({"relations": {"corner ratio"}}, {"relations": ("corner ratio",)}),
        ({"level_set_width": 0.1}, {"level_set_width": 0.1}),
        ({"clearance": "door 0.9, coffee table: 0.3"}, {"clearance": {"door": 0.9, "coffee table": 0.3}}),
        ({"other_parents": True}, {"other_parents": True}),
        ({"local_importance": "constant"}, {"local_importance": "constant"}),
        ({"matching_accuracy": "constant"}, {"matching_accuracy": "constant"}),
        ({"direction_width": 0.5}, {"direction_width": 0.5}),
        ({"cells": 20_000}, {"cells": 20_000}),
        ({"direction_bins": 36}, {"direction_bins": 36}),
        ({"candidates": 5}, {"candidates": 5}),
        ({"weights": "chair = 0, corner distance 2,"}, {"relation_weights": {"chair": 0.0, "corner distance": 2.0}}),
    ],
    ids=lambda value: next(iter(value)),
)
def test_the_redo_panel_sets_the_engines_options(settings, options):
    rooms(2)
    bed()
    node = propagate(**settings)
    learned = bridge("tree.store").engine_node(node).operation.model.options
    for name, value in options.items():
        assert getattr(learned, name) == (pytest.approx(value) if isinstance(value, float) else value)


def test_most_and_spacing_limit_what_is_shown():
    rooms(2)
    box("Nothing else", (0.1, 0.1, 0.1))
    activate(box("Chair", (0.4, 0.4, 0.8), "chair", at=(0.5, 0.5, 0)))
    propagate(most=0, threshold=0.2, mirror="YES")
    many = len(results())
    propagate(most=2, threshold=0.2, mirror="YES")
    assert len(results()) < many
    propagate(most=0, threshold=0.2, mirror="YES", spacing=3.0)
    centres = np.array([i.location[:2] for i in results()])
    gaps = np.linalg.norm(centres[:, None] - centres[None], axis=2)
    same_room = (centres[:, None, 0] // 5) == (centres[None, :, 0] // 5)
    assert gaps[same_room & (gaps > 0)].min(initial=9.0) >= 3.0


def test_rooms_of_another_label_get_results_where_they_are_asked_for():
    for i, label in enumerate(("office", "office", "study")):
        face(f"room {i}", ROOM, label, at=(5.0 * i, 0.0, 0.0))
        box(f"desk {i}", (1.6, 0.8, 0.7), "desk", at=(5.0 * i + 2.0, 2.0, 0))
    activate(box("Chair", (0.4, 0.4, 0.9), "chair", at=(2.0, 1.3, 0), turn=math.pi / 2))
    settings = {"threshold": 0.2, "mirror": "NO", "weights": "office 0"}
    propagate(**settings)
    assert [i.location.x for i in results()] == pytest.approx([7.0], abs=0.02)
    propagate(other_parents=True, **settings)
    assert {round(i.location.x) for i in results()} >= {7, 12}
    propagate(other_parents=True, most_of="study 0", **settings)
    assert [i.location.x for i in results()] == pytest.approx([7.0], abs=0.02)


def test_what_is_propagated_on_walls_hangs_upright_and_that_is_kept(tmp_path):
    """By its surroundings alone, a lamp in a corner could hang upside down in the opposite one."""
    for i, direction in enumerate(("south", "south", "south")):
        outline(f"wall {i}", ring(0, 0, 6.0, 3.0), "wall", frame(direction, at=(8.0 * i, 0.0, 0.0)))
    activate(sill("Lamp", frame("south"), (0.5, 2.5), label="lamp"))
    propagate(most=0, threshold=0.6)
    assert len(results()) >= 5

    def upright():
        bpy.context.view_layer.update()
        return [(i.matrix_world.to_3x3() @ Vector((0, 0, 1))).z for i in results()]

    assert min(upright()) == pytest.approx(1.0, abs=1e-3)
    every = placed()
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    reload(tmp_path / "walls.blend")
    assert placed() == every and min(upright()) > 0.999


def test_shares_say_how_often_each_of_several_is_chosen():
    rooms(6)
    small = box("Cot", (1.0, 0.6, 0.5), "bed", at=(1.0, 2.5, 0.0))
    activate(bed(), small)
    assert bpy.ops.geoanalogy.choose(EXEC, True, shares="Bed 0") == {"FINISHED"}
    assert {i.data for i in results()} == {small.data}
    assert bpy.ops.geoanalogy.choose(EXEC, True, shares="Cot 0, Bed 2") == {"FINISHED"}
    assert {i.data for i in results()} == {bpy.data.objects["Bed"].data}


def test_results_stay_clear_of_a_doors_swing():
    rooms(2)
    box_size, place = (0.6, 0.6, 0.5), (2.6, 0.4, 0)
    face("swing 1", [(2, 0), (3.9, 0), (3.9, 0.9), (2, 0.9)], at=(5.0, 0.0, 0.0))
    activate(box("Trunk", box_size, "trunk", at=place))
    propagate(mirror="NO")
    assert [i.location.x for i in results()] == pytest.approx([7.6], abs=0.01)
    bpy.data.objects["door 1"]["ga_validation"] = "swing 1"
    propagate(mirror="NO")
    assert not [i for i in results() if i.location.x == pytest.approx(7.6, abs=0.05)]


def test_clearance_keeps_results_away_from_a_label():
    rooms(2)
    face("rug 1", [(0.8, 0.8), (1.4, 0.8), (1.4, 1.4), (0.8, 1.4)], "rug", at=(5.0, 0.0, 0.0))
    activate(box("Trunk", (0.6, 0.6, 0.5), "trunk", at=(0.4, 0.4, 0)))

    propagate(mirror="NO")
    assert [i.location.x for i in results()] == pytest.approx([5.4], abs=0.01)
    propagate(mirror="NO", clearance="rug 0.5")
    assert not [i for i in results() if i.location.x == pytest.approx(5.4, abs=0.1) and i.location.y < 0.7]


def test_a_weight_of_zero_mutes_a_label():
    """A chair between table and desk; in the other room they stand apart (figure 4.19)."""
    for i, desk in enumerate([(3.5, 1.5), (3.5, 0.5)]):
        face(f"room {i}", ROOM, "room", at=(5.0 * i, 0.0, 0.0))
        box(f"table {i}", (0.8, 0.8, 0.7), "table", at=(5.0 * i + 2.0, 1.5, 0))
        box(f"desk {i}", (0.6, 0.6, 0.7), "desk", at=(5.0 * i + desk[0], desk[1], 0))
    activate(box("Chair", (0.4, 0.4, 0.9), "chair", at=(2.9, 1.5, 0)))
    propagate(weights="table 0")
    (at_desk,) = results()
    assert tuple(at_desk.location) == pytest.approx((7.9, 0.5, 0), abs=0.02)
    propagate(weights="desk 0")
    (at_table,) = results()
    assert math.dist(at_table.location, (7.0, 1.5, 0)) == pytest.approx(0.9, abs=0.02)


def test_propagate_is_one_step_of_undo():
    rooms()
    bed()
    bpy.ops.ed.undo_push(message="scene")
    before = everything()
    propagate()
    after = placed()
    bpy.ops.ed.undo()
    assert everything() == before
    bpy.ops.ed.redo()
    assert placed() == after
    assert operations_tree().nodes.active["count"] == len(after)


# The other operations


def test_array_fills_the_way_to_the_empty_in_every_like_room():
    rooms(2)
    tree = box("Lamp", (0.2, 0.2, 1.0), "lamp", at=(0.5, 2.6, 0))
    end = link(bpy.data.objects.new("End", None))
    end.location = (3.5, 2.6, 0)
    activate(tree, end)
    assert bpy.ops.geoanalogy.array(EXEC, True, spacing=1.0, mirror="NO") == {"FINISHED"}
    found = np.array([i.location[:2] for i in results()])
    own, other = found[found[:, 0] < 4.5], found[found[:, 0] > 4.5]
    assert {(1.5, 2.6), (2.5, 2.6), (3.5, 2.6)} <= {tuple(p) for p in np.round(own, 2)}
    assert {(5.5, 2.6), (6.5, 2.6), (7.5, 2.6), (8.5, 2.6)} <= {tuple(p) for p in np.round(other, 2)}


def test_scatter_draws_so_many_and_another_seed_draws_others():
    rooms(2)
    activate(box("Plant", (0.2, 0.2, 0.2), "plant", at=(2, 2, 0)))
    assert bpy.ops.geoanalogy.scatter(EXEC, True, count=5) == {"FINISHED"}
    first = placed()
    assert len([p for p in results() if p.location.x > 4.5]) == 5
    assert bpy.ops.geoanalogy.scatter(EXEC, True, count=5, seed=1) == {"FINISHED"}
    assert placed() != first
    assert bpy.ops.geoanalogy.scatter(EXEC, True, count=5, seed=0) == {"FINISHED"}
    assert placed() == first


def test_choose_places_one_of_several_in_every_room():
    rooms(8)
    red = box("Red", (2.0, 1.0, 0.5), "bed", at=(1.0, 2.5, 0))
    blue = box("Blue", (2.0, 1.0, 0.5), "bed", at=(6.0, 2.5, 0))
    activate(red, blue)
    assert bpy.ops.geoanalogy.choose(EXEC, True, mirror="NO") == {"FINISHED"}
    per_room = {}
    for i in results():
        per_room.setdefault(int(i.location.x // 5), []).append(i.data.name)
    assert all(len(names) == 1 for names in per_room.values())
    assert {n for names in per_room.values() for n in names} == {"Red", "Blue"}
