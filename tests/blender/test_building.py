"""Extrusion, boolean and selection in Blender, and examples drawn on what they make."""

import json
from pathlib import Path

import bpy
import pytest
from flats import bridge, engine, face, operations_tree
from houses import HEIGHT, SIZES, box_of, corners_of, houses, solids, volume_of, windows

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
    files, source, target = bridge("tree_files"), HOUSES / f"{name}.json", tmp_path / "out.json"
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
    (around,) = bridge("evaluating").read_surroundings(bpy.context)
    applied = engine("operations.tree").OperationsTree.load(HOUSES / "one-storey.json").apply(around.ground.scene)
    expected = sorted((e.label, e.key, round(e.solid.volume, 2)) for e in applied if e.solid and not e.absorbed_by)
    found = sorted((i["ga_label"], i["ga_key"], round(volume_of(i), 2)) for i in solids() if volume_of(i) > 1e-6)
    assert len(found) > 10
    assert [f[:2] for f in found] == [e[:2] for e in expected]
    assert [f[2] for f in found] == pytest.approx([e[2] for e in expected], abs=0.02)
