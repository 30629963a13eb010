"""What cannot be done is said in one sentence, and the scene stays as it was."""

import math

import bpy
import pytest
from flats import (
    ROOM,
    activate,
    bed,
    box,
    bridge,
    everything,
    face,
    link,
    operations_tree,
    propagate,
    results,
    rooms,
    three_operations,
)

EXEC = "EXEC_DEFAULT"


def test_operators_say_why_they_are_greyed_out():
    ops = bpy.ops.geoanalogy
    for name in ("propagate", "array", "scatter"):
        with pytest.raises(RuntimeError, match="Click an object first"):
            getattr(ops, name)(EXEC)
    for name in ("replay", "clear", "accept", "reject", "reject_below", "forget_decisions", "explain"):
        with pytest.raises(RuntimeError, match="There are no operations yet"):
            getattr(ops, name)(EXEC)
    for name in ("remove_operation", "move_operation", "mute_operation"):
        with pytest.raises(RuntimeError, match="There are no operations yet"):
            getattr(ops, name)(EXEC)
    activate(face("a", ROOM))
    bpy.ops.object.mode_set(mode="EDIT")
    for name in ("set_label", "set_footprint", "make_polygons", "import_plan", "propagate", "transfer", "choose"):
        with pytest.raises(RuntimeError, match="Leave to Object Mode first"):
            getattr(ops, name)(EXEC)
    bpy.ops.object.mode_set(mode="OBJECT")


def nothing_selected():
    rooms()
    bed().select_set(False)


def no_label():
    rooms()
    del bed()["ga_label"]


def outside():
    rooms()
    bed().location = (50, 50, 0)


def empty_scene():
    bed()


def upright():
    rooms()
    bed().rotation_euler = (0, math.radians(90), 0)


def no_size():
    rooms()
    bed().scale = (0, 0, 0)


def no_extent():
    rooms()
    activate(link(bpy.data.objects.new("Point", None), "point"))


def a_result():
    rooms()
    bed()
    propagate()
    activate(results()[0])


def crossing_room():
    rooms()
    face("Knot", [(0, 0), (2, 2), (2, 0), (0, 1)], "room", at=(0, 10, 0))
    bed()


def bedroom_of(ring):
    rooms()
    face("Bad", ring, "bedroom", at=(0, 10, 0))
    bed()


def no_area():
    bedroom_of([(0, 0), (2, 2), (4, 4)])


def not_a_number():
    bedroom_of([(0, 0), (2, math.nan), (2, 2)])


def huge():
    bedroom_of([(0, 0), (3e38, 0), (3e38, 3e38), (0, 3e38)])


def open_curve():
    rooms()
    data = bpy.data.curves.new("Open", "CURVE")
    data.dimensions = "3D"
    spline = data.splines.new("POLY")
    spline.points.add(2)
    for knot, point in zip(spline.points, [(0, 10), (4, 10), (4, 13)], strict=True):
        knot.co = (*point, 0.0, 1.0)
    link(bpy.data.objects.new("Open", data), "bedroom")
    bed()


def nothing_labelled():
    rooms()
    for item in bpy.data.objects:
        del item["ga_label"]
    bed()


def newer():
    rooms()
    bed()
    propagate()["operation"]["schema"] = "geoanalogy.operations/99"


def damaged():
    rooms()
    bed()
    propagate()["operation"]["settings"]["threshold"] = "high"


def bad_footprint():
    rooms()
    bed()["ga_footprint"] = [0.0, 1.0, 2.0]


def ring_of_operations():
    three_operations()
    tree = operations_tree()
    # As a Blender without the add-on would link them.
    with bridge("tree.links").unwatched(tree):
        tree.links.new(tree.nodes[2].outputs[0], tree.nodes[0].inputs[0])


def two_ends():
    rooms()
    activate(bed(), *(link(bpy.data.objects.new("End", None)) for _ in range(2)))


def end_is_no_empty():
    rooms()
    activate(bed(), box("Stop", (1, 1, 1)))


def far_from_each_other():
    rooms()
    activate(bed(), box("Other", (1, 1, 1), "bed", at=(6, 1, 0)))


def mark(at):
    item = link(bpy.data.objects.new("Mark", None))
    item.location = at
    return item


def two_marks():
    rooms()
    activate(bed(), mark((0, 0, 0)), mark((4, 0, 0)))


def mark_elsewhere():
    rooms()
    activate(bed(), mark((5, 0, 0)))


def mixed_group():
    a_result()
    activate(results()[0], bpy.data.objects["Bed"])


def nothing_at_all():
    pass


PROPAGATE = lambda **k: bpy.ops.geoanalogy.propagate(EXEC, True, **k)  # noqa: E731
REPLAY = lambda: bpy.ops.geoanalogy.replay(EXEC, True)  # noqa: E731
TRANSFER = lambda: bpy.ops.geoanalogy.transfer(EXEC, True)  # noqa: E731
ARRAY = lambda **k: bpy.ops.geoanalogy.array(EXEC, True, **k)  # noqa: E731
CASES = [
    (nothing_selected, PROPAGATE, "nothing is selected; select the object"),
    (no_label, PROPAGATE, "object 'Bed' has no label"),
    (outside, PROPAGATE, "object 'Bed': the example at x 50, y 50 lies outside every polygon"),
    (empty_scene, PROPAGATE, "the scene has no labelled outlines"),
    (upright, PROPAGATE, "object 'Bed' has its x axis upright"),
    (no_size, PROPAGATE, "object 'Bed' has no size, since its scale is 0"),
    (no_extent, PROPAGATE, "object 'Point' has no extent on the plan"),
    (a_result, PROPAGATE, "is a result of 'bed' itself; select the example"),
    (nothing_labelled, PROPAGATE, "the scene has no labelled outlines"),
    (no_area, PROPAGATE, "object 'Bad' has no area"),
    (not_a_number, PROPAGATE, "object 'Bad' has a coordinate that is not finite"),
    (huge, PROPAGATE, "polygon 'Bad' lies more than .* from the origin; move the scene near the origin"),
    (open_curve, PROPAGATE, "spline 1 of object 'Open' is open: its ends are 5 apart"),
    (crossing_room, PROPAGATE, "polygon 'Knot' crosses or touches itself"),
    (bad_footprint, PROPAGATE, "object 'Bed' has a footprint that is no list of x, y pairs"),
    (newer, REPLAY, "the operation 'bed' was saved by a newer version"),
    (newer, PROPAGATE, "the operation 'bed' was saved by a newer version"),
    (damaged, REPLAY, "'high' is no finite number"),
    (ring_of_operations, REPLAY, "the nodes form a circle"),
    (two_ends, ARRAY, "several objects mark the array's end"),
    (end_is_no_empty, ARRAY, "object 'Stop' is to mark the array's end, but is no empty"),
    (outside, ARRAY, "object 'Bed': the example at x 50"),
    (bed_in_rooms := lambda: (rooms(), bed()), lambda: ARRAY(spacing=0.0), "the spacing of the array is 0.0"),
    (
        bed_in_rooms,
        lambda: PROPAGATE(clearance="door"),
        "the clearance 'door' cannot be read; write a label and a number",
    ),
    (bed_in_rooms, lambda: PROPAGATE(clearance="door 1, 0.5"), "the clearance '0.5' cannot be read"),
    (bed_in_rooms, lambda: PROPAGATE(clearance="door -1"), "the clearance 'door -1' cannot be read"),
    (bed_in_rooms, lambda: PROPAGATE(weights="bed nan"), "the weight 'bed nan' cannot be read"),
    (bed_in_rooms, lambda: PROPAGATE(weights="bed 1, bed 2"), "the weight of 'bed' is given twice"),
    (nothing_at_all, TRANSFER, "nothing is selected; select the objects to transfer"),
    (far_from_each_other, TRANSFER, "select objects of one polygon"),
    (mixed_group, TRANSFER, "select either results or objects of your own"),
    (outside, TRANSFER, "object 'Bed' lies outside every polygon"),
    (two_marks, TRANSFER, "several empties mark the start of 'room 0'"),
    (mark_elsewhere, TRANSFER, "no empty marks the start of 'room 0'"),
    (bed_in_rooms, lambda: PROPAGATE(most_of="hall 1.5"), "the number of 'hall' is 1.5; give a whole number"),
    (bed_in_rooms, lambda: bpy.ops.geoanalogy.choose(EXEC, True, shares="Cot 1"), "no such object is selected"),
    (bed_in_rooms, lambda: bpy.ops.geoanalogy.choose(EXEC, True, shares="Bed 0"), "the weights of a choice"),
    (nothing_at_all, lambda: bpy.ops.geoanalogy.choose(EXEC, True), "nothing is selected"),
    (nothing_at_all, lambda: bpy.ops.geoanalogy.set_label(EXEC, True, label="x"), "nothing is selected"),
    (nothing_at_all, lambda: bpy.ops.geoanalogy.set_footprint(EXEC, True), "nothing is selected"),
    (nothing_at_all, lambda: bpy.ops.geoanalogy.make_polygons(EXEC, True), "nothing is selected"),
    (a_result, lambda: bpy.ops.geoanalogy.set_label(EXEC, True, label="x"), "is a result of 'bed'; change its example"),
    (a_result, lambda: bpy.ops.geoanalogy.set_footprint(EXEC, True), "is a result of 'bed'; change its example"),
    (
        bed_in_rooms,
        lambda: bpy.ops.geoanalogy.transfer(EXEC, True, system="corner", distance="depth"),
        "from a corner, distances cannot fill a polygon",
    ),
    (no_extent, lambda: bpy.ops.geoanalogy.set_footprint(EXEC, True, kind="outline"), "object 'Point' has no faces"),
    (
        lambda: activate(face("Knot", [(0, 0), (2, 2), (2, 0), (0, 1)])),
        lambda: bpy.ops.geoanalogy.make_polygons(EXEC, True),
        "polygon 'Knot' crosses or touches itself",
    ),
    (a_result, lambda: (activate(bpy.data.objects["Bed"]), bpy.ops.geoanalogy.accept(EXEC)), "no result is selected"),
    (a_result, lambda: (activate(bpy.data.objects["Bed"]), bpy.ops.geoanalogy.explain(EXEC)), "no result is active"),
]


@pytest.mark.parametrize(("make", "act", "message"), CASES, ids=[f"{i} {m[:30]}" for i, (_, _, m) in enumerate(CASES)])
def test_bad_input_is_named_and_leaves_the_scene_as_it_was(make, act, message):
    make()
    before = everything()
    with pytest.raises(RuntimeError, match=message):
        act()
    assert everything() == before


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("plan.geojson", '{"type": "FeatureCollection", "features": [', "plan.geojson"),
        ("plan.svg", "<svg><rect", "plan.svg"),
        ("plan.dxf", "0\nSECTION\n2\nENTITIES\nnonsense", "plan.dxf"),
        ("plan.txt", "hello", "plan.txt"),
        ("empty.geojson", '{"type": "FeatureCollection", "features": []}', "empty"),
    ],
)
def test_a_malformed_plan_is_named_and_leaves_the_scene_as_it_was(tmp_path, name, text, message):
    path = tmp_path / name
    path.write_text(text)
    before = everything()
    with pytest.raises(RuntimeError, match=message):
        bpy.ops.geoanalogy.import_plan(EXEC, True, filepath=str(path))
    assert everything() == before
    with pytest.raises(RuntimeError, match="nowhere"):
        bpy.ops.geoanalogy.import_plan(EXEC, True, filepath=str(tmp_path / "nowhere.geojson"))


@pytest.mark.parametrize("operator", ["import_plan", "import_tree", "import_drawing"])
def test_a_file_browser_in_which_nothing_was_clicked_is_named(tmp_path, operator):
    with pytest.raises(RuntimeError, match="no file is chosen; click one in the file browser"):
        getattr(bpy.ops.geoanalogy, operator)(EXEC, True, filepath=f"{tmp_path}/")
