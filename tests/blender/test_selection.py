"""What is selected after an operator: what it made, and the results that were selected before it."""

import json

import bpy
import pytest
from flats import activate, bed, operations_tree, propagate, results, rooms, three_operations

EXEC = "EXEC_DEFAULT"


def selected():
    active = bpy.context.view_layer.objects.active
    return sorted(item["ga_key"] for item in bpy.context.selected_objects), active and active["ga_key"]


@pytest.fixture
def chosen():
    rooms(5)
    bed()
    propagate()
    activate(results()[2], results()[0])
    return selected()


@pytest.mark.parametrize("operator", ["accept", "forget_decisions", "replay"])
def test_results_stay_selected(chosen, operator):
    assert getattr(bpy.ops.geoanalogy, operator)(EXEC, True) == {"FINISHED"}
    assert selected() == chosen


def test_results_stay_selected_while_the_threshold_is_moved(chosen):
    operations_tree().nodes.active.threshold = 0.1
    assert selected() == chosen


def test_what_is_rejected_is_selected_no_longer(chosen):
    left = results()[1]["ga_key"]
    assert bpy.ops.geoanalogy.reject(EXEC, True) == {"FINISHED"}
    assert bpy.context.selected_objects == []
    assert left in [item["ga_key"] for item in results()]


def test_what_is_active_and_not_selected_stays_so(chosen):
    results()[2].select_set(False)
    before = selected()
    assert before[1] not in before[0]
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    assert selected() == before


def test_results_in_an_excluded_collection_are_selected_by_nobody(chosen):
    bpy.context.view_layer.layer_collection.children["GeoAnalogy"].exclude = True
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    assert bpy.context.selected_objects == []


def import_room(path, name="room", x=0, y=0):
    ring = [[x, y], [x + 4, y], [x + 4, y + 3], [x, y + 3], [x, y]]
    feature = {"type": "Feature", "properties": {"label": "room", "id": name}}
    feature["geometry"] = {"type": "Polygon", "coordinates": [ring]}
    path.write_text(json.dumps({"type": "FeatureCollection", "features": [feature]}))
    assert bpy.ops.geoanalogy.import_plan(EXEC, True, filepath=str(path)) == {"FINISHED"}


def test_plans_of_a_region_far_away_are_imported_beside_each_other(tmp_path):
    import_room(tmp_path / "west.geojson", "west", 456_000, 5_430_000)
    import_room(tmp_path / "east.geojson", "east", 462_000, 5_431_000)
    west, east = (bpy.data.objects[name].location for name in ("west", "east"))
    assert (east - west)[:] == pytest.approx((6000, 1000, 0), abs=0.01)
    assert west.length < 2000
    offset = bpy.context.scene.geoanalogy.plan["ga_offset"]
    assert (west.x - 2 + offset[0], west.y - 1.5 + offset[1]) == pytest.approx((456_000, 5_430_000), abs=0.01)


def test_what_is_imported_or_made_is_selected(tmp_path):
    other = bed()
    import_room(tmp_path / "plan.geojson")
    assert [item.name for item in bpy.context.selected_objects] == ["room"]
    assert bpy.context.active_object.name == "room"
    bpy.ops.curve.primitive_bezier_circle_add(radius=1.0, location=(8, 2, 0))
    activate(bpy.context.object)
    assert bpy.ops.geoanalogy.make_polygons(EXEC, label="pond") == {"FINISHED"}
    (pond,) = bpy.context.selected_objects
    assert (pond.type, pond["ga_label"], bpy.context.active_object) == ("MESH", "pond", pond)
    assert not other.select_get()


def test_another_operation_is_active_where_one_is_removed():
    first, second, third = three_operations()
    nodes = operations_tree().nodes
    for name, after in ((second, first), (first, third)):
        nodes.active = nodes[name]
        assert bpy.ops.geoanalogy.remove_operation(EXEC, True) == {"FINISHED"}
        assert nodes.active.name == after
    assert bpy.ops.geoanalogy.remove_operation(EXEC, True) == {"FINISHED"}
    assert len(nodes) == 0
