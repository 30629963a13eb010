"""Extrusion, boolean and selection in Blender, and examples drawn on what they make."""

import json
import subprocess
from pathlib import Path

import bmesh
import bpy
import numpy as np
import pytest
from conftest import INSIDE_BLENDER, batch_command, run
from facades import frame, outline, ring
from flats import activate, box, bridge, engine, face, operations_tree
from houses import HEIGHT, SIZES, box_of, corners_of, draw, extrude, houses, parcels, place, solids, volume_of, windows
from mathutils import Vector

EXEC = "EXEC_DEFAULT"


def test_houses_are_extruded_on_all_parcels():
    corners, node = houses()
    assert node["count"] == 4
    made = solids("house")
    assert len(made) == 4
    for item in made:
        i = next(k for k, (x, _) in enumerate(corners) if x < item.matrix_world.translation.x < x + SIZES[k][0])
        (x0, y0, _), (x1, y1, _) = box_of(i, corners)
        points = corners_of(item)
        if i < 2:
            assert points.min(axis=0) == pytest.approx((x0, y0, 0.0), abs=1e-4)
            assert points.max(axis=0) == pytest.approx((x1, y1, HEIGHT), abs=1e-4)
        assert volume_of(item) > 0


def test_windows_drawn_on_a_wall_are_cut_into_every_wall_like_it():
    corners, _ = houses()
    before = {item.name: volume_of(item) for item in solids("house")}
    node = windows(corners)
    # Four walls of equal label: one window each.
    assert node["count"] == 16
    assert [k.from_node.name for k in operations_tree().nodes["subtract window"].inputs[0].links] == ["extrude window"]
    made = solids("house")
    assert solids("window") == []
    assert {item.name: before[item.name] - volume_of(item) for item in made} == pytest.approx(
        dict.fromkeys(before, 4 * 1.2 * 1.2 * 0.2), abs=1e-3
    )
    assert all({"glass", "reveal"} <= {slot.material.name for slot in item.material_slots} for item in made)


HOUSES = Path(__file__).resolve().parents[2] / "sample_blends" / "houses"


@pytest.mark.parametrize("name", ["one-storey", "condominium"])
def test_a_tree_from_a_file_becomes_a_node_group_and_comes_back_equal(name, tmp_path):
    face("plot", [(0, 0), (20, 0), (20, 24), (0, 24)], name)
    files, source, target = bridge("tree.files"), HOUSES / f"{name}.json", tmp_path / "out.json"
    tree = files.import_tree(bpy.context.scene, source)
    assert bpy.ops.geoanalogy.export_tree(EXEC, filepath=str(target)) == {"FINISHED"}
    assert json.loads(target.read_text()) == json.loads(
        json.dumps(engine("operations.tree").OperationsTree.load(source).to_dict())
    )
    assert len(tree.nodes) >= 45


def plots(name):
    """The plots that a type of house is applied to, as objects and as the engine's polygons."""
    scene = engine("formats.files").read_scene(HOUSES / "plots.geojson")
    chosen = [p for p in scene.polygons if p.label == name][:3]
    return bridge("plan_making").add_plan(bpy.context, engine().Scene(chosen), "plots")


def test_a_tree_applied_in_blender_gives_what_the_engine_gives():
    plots("one-storey")
    bpy.ops.geoanalogy.import_tree(EXEC, filepath=str(HOUSES / "one-storey.json"))
    assert bpy.ops.geoanalogy.apply(EXEC, True) == {"FINISHED"}
    (around,) = bridge("tree.evaluating").read_surroundings(bpy.context)
    applied = engine("operations.tree").OperationsTree.load(HOUSES / "one-storey.json").apply(around.ground.scene)
    expected = sorted((e.label, e.key, round(e.solid.volume, 2)) for e in applied if e.solid and not e.absorbed_by)
    found = sorted((i["ga_label"], i["ga_key"], round(volume_of(i), 2)) for i in solids() if volume_of(i) > 1e-6)
    assert len(found) > 10
    assert [f[:2] for f in found] == [e[:2] for e in expected]
    assert [f[2] for f in found] == pytest.approx([e[2] for e in expected], abs=0.02)


def cube(name="block", turn=(0.3, 0.2, 0.7)):
    """A cube of side 4, turned any way."""
    item = box(name, (4.0, 4.0, 4.0))
    item.location, item.rotation_euler = (30.0, 5.0, 2.0), turn
    bpy.context.view_layer.update()
    return activate(item)


def choose_faces(item, *indices):
    for face_ in item.data.polygons:
        face_.select = face_.index in indices


@pytest.mark.parametrize("edit_mode", [False, True])
def test_faces_of_any_direction_become_surfaces(edit_mode):
    item = cube()
    choose_faces(item, 1, 3)
    if edit_mode:
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="DESELECT")
        edited = bmesh.from_edit_mesh(item.data)
        edited.faces.ensure_lookup_table()
        edited.faces[1].select_set(True)
        edited.faces[3].select_set(True)
    assert bpy.ops.geoanalogy.label_faces(EXEC, True, label="facade") == {"FINISHED"}
    if edit_mode:
        bpy.ops.object.mode_set(mode="OBJECT")
    grounds = bridge("reading.ground").read_grounds(bpy.context.scene, bpy.context.evaluated_depsgraph_get())
    assert [len(ground.scene.polygons) for ground in grounds] == [1, 1]
    normals = [np.array(item.matrix_world)[:3, :3] @ np.array(item.data.polygons[i].normal) for i in (1, 3)]
    for ground in grounds:
        (polygon,) = ground.scene.polygons
        assert (polygon.label, polygon.area) == ("facade", pytest.approx(16.0, rel=1e-5))
        assert max(float(n @ ground.plane.normal) for n in normals) == pytest.approx(1.0, abs=1e-5)
    choose_faces(item, 1)
    bpy.ops.geoanalogy.label_faces(EXEC, True, label="")
    grounds = bridge("reading.ground").read_grounds(bpy.context.scene, bpy.context.evaluated_depsgraph_get())
    assert len(grounds) == 1


def test_operations_work_on_chosen_faces():
    item = cube()
    choose_faces(item, 1, 3)
    bpy.ops.geoanalogy.label_faces(EXEC, True, label="facade")
    node = extrude(label="facade", height=0.5)
    assert node["count"] == 2
    made = solids("facade")
    assert [volume_of(one) for one in made] == pytest.approx([8.0, 8.0], rel=1e-4)
    # They stand out of the cube, none into it.
    points = np.vstack([corners_of(one) for one in made])
    own = (points - np.array(item.location)) @ np.array(item.matrix_world)[:3, :3]
    assert (np.abs(own[:, :2]).max(axis=1) > 2.0 - 1e-4).any() or own[:, 2].max() > 4.0 - 1e-4
    assert not ((np.abs(own[:, :2]) < 1.9).all(axis=1) & (own[:, 2] > 0.1) & (own[:, 2] < 3.9)).any()


@pytest.mark.parametrize("kind", ["mesh", "curve", "stroke"])
@pytest.mark.parametrize("direction", ["askew", "sloped"])
def test_outlines_of_any_kind_and_direction_are_extruded_off_their_plane(kind, direction):
    where = frame(direction, at=(1.0, 2.0, 3.0))
    outline("sheet", ring(0, 0, 3.0, 2.0), "sheet", where, kind)
    extrude(label="sheet", height=0.5, side="edge", top="front")
    (made,) = solids("sheet")
    points = np.array([where.inverted() @ Vector(p) for p in corners_of(made)])
    assert points.min(axis=0) == pytest.approx((0.0, 0.0, 0.0), abs=1e-4)
    assert points.max(axis=0) == pytest.approx((3.0, 2.0, 0.5), abs=1e-4)


@pytest.mark.parametrize(
    ("prepare", "message"),
    [
        (lambda: face("plain", [(0, 0), (1, 0), (1, 1)]), "no mesh is active"),
        (lambda: (choose_faces(cube()), None), "no face of 'block' is selected"),
        (lambda: (houses(), activate(solids()[0])), "is a result of 'house' itself, whose faces are surfaces already"),
    ],
)
def test_what_cannot_become_a_surface_is_told(prepare, message):
    prepare()
    with pytest.raises(RuntimeError, match=message):
        bpy.ops.geoanalogy.label_faces(EXEC, True, label="facade")


def test_an_object_on_a_wall_is_learned_from_and_placed_on_walls_like_it():
    corners, _ = houses()
    (x0, y0, _), _ = box_of(0, corners)
    lamp = activate(box("Lamp", (0.2, 0.2, 0.4), "lamp", at=(x0 + 1.0, y0 - 0.1, 2.0)))
    assert bpy.ops.geoanalogy.propagate(EXEC, True, threshold=0.3) == {"FINISHED"}
    made = [i for i in bpy.context.scene.objects if i.get("ga_node") == "lamp"]
    # A wall is as high above its middle as below it, but every wall has one as high as the example.
    assert sum(abs(item.matrix_world.translation.z - 2.0) < 0.01 for item in made) >= 4
    boxes = {k: box_of(k, corners) for k in (0, 1)}
    for item in made:
        at = item.matrix_world.translation
        assert item.data == lamp.data
        # None stands inside a house.
        for low, high in boxes.values():
            assert not all(a + 0.05 < v < b - 0.05 for a, v, b in zip(low[:2], at[:2], high[:2], strict=True))


def test_walls_that_face_the_street_are_called_so():
    corners = parcels()
    for i in range(len(SIZES)):
        bpy.data.objects[f"parcel {i}"]["ga_segment_labels"] = "street,,,"
    houses(corners)
    for item in solids("house"):
        names = [slot.material.name for slot in item.material_slots]
        front = names.index("street wall")
        assert [p.normal.y for p in item.data.polygons if p.material_index == front] == pytest.approx([-1.0, -1.0])


def test_heights_are_drawn_for_every_house_and_depend_on_the_seed():
    corners = parcels()
    draw("house", *(box_of(i, corners) for i in (0, 1)))
    place(most=1, any_size=True)
    extrude(label="house", height=3.0, factor=(0.5, 2.0))
    first = [item.dimensions.z for item in solids("house")]
    assert len({round(h, 3) for h in first}) == 4 and all(1.5 <= h <= 6.0 for h in first)
    operations_tree().seed = 5
    bpy.ops.geoanalogy.apply(EXEC, True)
    assert [item.dimensions.z for item in solids("house")] != pytest.approx(first)
    operations_tree().seed = 0
    bpy.ops.geoanalogy.apply(EXEC, True)
    assert [item.dimensions.z for item in solids("house")] == pytest.approx(first)


def test_nodes_show_how_long_they_took_and_can_be_added():
    _, node = houses()
    assert node["seconds"] > 0
    tree = operations_tree()
    made = bridge("tree.new_nodes").new_node(tree, "selection", "house")
    assert made["stale"] and made.works_on == "house" and made.weights == "1, 1"
    made.weights = "1, 2, 3"
    assert [socket.name for socket in made.outputs] == ["Set 1", "Set 2", "Set 3"]
    made.weights = "1, two"
    assert made["problem"] == "the weights '1, two' are no numbers; give one per set, with commas between them"
    made.within = "parent"
    made.works_on = "flat roof"
    tree.links.new(tree.nodes["extrude house"].outputs[0], made.inputs[0])
    assert bpy.ops.geoanalogy.apply(EXEC, True) == {"FINISHED"}
    assert made["count"] == 4 and "stale" not in made
    combined = bridge("tree.new_nodes").new_node(tree, "boolean", "house")
    combined.combination, combined.target = "subtract", "siblings"
    operation = bridge("tree.store").engine_node(combined).operation
    assert (operation.kind, operation.target) == ("subtract", "siblings")


def test_objects_on_walls_are_examples_and_stand_there_once():
    corners, _ = houses()
    shutters = []
    for i in (0, 1):
        (x0, y0, _), _ = box_of(i, corners)
        shutters.append(box(f"Shutter {i}", (0.4, 0.06, 1.2), "shutter", at=(x0 + 1.0, y0 - 0.03, 1.0)))
        if i:
            shutters[1].data = shutters[0].data
    activate(*shutters)
    node = place(most=1)
    made = [i for i in bpy.context.scene.objects if i.get("ga_node") == node.name]
    bpy.context.view_layer.update()
    # One on each of sixteen walls; two of them are the examples themselves.
    assert len(made) == 14 and {item.data for item in made} == {shutters[0].data}
    places = [tuple(np.round(item.matrix_world.translation, 3)) for item in [*made, *shutters]]
    assert len(set(places)) == 16
    assert {round(item.matrix_world.translation.z, 3) for item in made} == {1.0}
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    again = [i for i in bpy.context.scene.objects if i.get("ga_node") == node.name]
    assert sorted(tuple(np.round(i.matrix_world.translation, 3)) for i in again) == sorted(places[:14])


def test_walls_are_drawn_on_where_the_mouse_goes():
    corners, _ = houses()
    drawing = bridge("rectangle_drawing")
    sites = drawing.sites_to_draw_on(bpy.context)
    (x0, y0, _), (_, y1, _) = box_of(0, corners)
    eye = np.array([x0 + 1.0, y0 - 8.0, 2.5])
    sketch = drawing.Sketch(sites)
    assert sketch.press(eye, np.array([x0 + 1.5, y0, 1.0]) - eye)
    sketch.move(eye, np.array([x0 + 2.7, y0, 2.2]) - eye)
    assert sketch.release()
    ((start, end, _),) = sketch.done
    assert start == pytest.approx((x0 + 1.5, y0, 1.0), abs=1e-4)
    assert end == pytest.approx((x0 + 2.7, y0, 2.2), abs=1e-4)
    # Through the wall nothing is met but the wall; beside the house, the parcel.
    face_, point = drawing.face_in_sight(sites, eye, np.array([x0 + 3.0, y1, 1.0]) - eye)
    assert face_.polygon.label == "wall" and point[1] == pytest.approx(y0, abs=1e-6)
    face_, point = drawing.face_in_sight(sites, (x0 - 1.0, y0 - 1.0, 5.0), (0.0, 0.0, -1.0))
    assert face_.polygon.label == "parcel"
    face_, point = drawing.face_in_sight(sites, (x0 + 1.0, y0 + 1.0, 9.0), (0.0, 0.0, -1.0))
    assert face_.polygon.label == "flat roof" and point[2] == pytest.approx(HEIGHT)


def test_the_command_and_the_batch_program_build_what_the_sidebar_builds(tmp_path):
    corners, _ = houses()
    windows(corners)
    built = sum(volume_of(item) for item in solids("house"))
    (around,) = bridge("tree.evaluating").read_surroundings(bpy.context)
    tree, plan = tmp_path / "house.json", tmp_path / "parcels.geojson"
    engine().write_scene(around.ground.scene, plan)
    bpy.ops.geoanalogy.export_tree(EXEC, filepath=str(tree))
    assert bridge("command")._commands
    arguments = ["--quiet", "apply", "--tree", str(tree), "--parcels", str(plan), "--output"]
    assert engine("command_line").main([*arguments, str(tmp_path / "command.blend")]) == 0
    arguments.append(str(tmp_path / "batch.blend"))
    if INSIDE_BLENDER:
        bpy.ops.wm.save_userpref()
        command = [bpy.app.binary_path, "--background", "--command", "geoanalogy", *arguments]
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=300)
    else:
        done = run(batch_command(*arguments), tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    volumes = []
    for name in ("command.blend", "batch.blend"):
        bpy.ops.wm.open_mainfile(filepath=str(tmp_path / name))
        bpy.context.view_layer.update()
        masses = [o for o in bpy.data.objects if o.type == "MESH" and o.get("ga_label") == "house"]
        volumes.append(sum(volume_of(o) for o in masses))
    assert volumes == pytest.approx([built, built], rel=1e-5)
