"""Groups taken to other polygons: their marks, objects that are bent, walls, and results that are taken on."""

import bpy
import numpy as np
import pytest
from facades import frame, outline, ring, sill
from flats import ROOM, activate, box, bridge, face, link, operations_tree, placed, reload, results
from mathutils import Vector

EXEC = "EXEC_DEFAULT"

LARGE = [(10, 0), (18, 0), (18, 6), (10, 6)]


def transfer(**settings):
    assert bpy.ops.geoanalogy.transfer(EXEC, True, **settings) == {"FINISHED"}
    return operations_tree().nodes.active


def empty(name, at):
    item = link(bpy.data.objects.new(name, None))
    item.location = at
    return item


@pytest.mark.parametrize("system", ["boundary", "corner"])
def test_empties_mark_where_the_coordinates_of_a_group_start(system):
    """Two equal squares; the second one's mark is a quarter turn further round, and so is the group there."""
    square = [(0, 0), (4, 0), (4, 4), (0, 4)]
    for i in range(2):
        face(f"lawn {i}", square, "lawn", at=(6.0 * i, 0.0, 0.0))
    flower = box("Flower", (0.2, 0.2, 0.2), "flower", at=(1.0, 0.5, 0.0))
    marks = [empty("Start", (0.0, 0.0, 0.0))]
    if system == "boundary":
        marks.append(empty("There", (10.0, 0.0, 0.0)))
    activate(flower, *marks)
    settings = {"system": system, "distance": "absolute"}
    assert bpy.ops.geoanalogy.transfer(EXEC, True, **settings) == {"FINISHED"}
    (made,) = results()
    wanted = (9.5, 1.0, 0.0) if system == "boundary" else (7.0, 0.5, 0.0)
    assert tuple(made.location) == pytest.approx(wanted, abs=1e-3)
    options = bridge("tree.store").engine_node(operations_tree().nodes.active).operation.group.options
    assert (options.start, options.corner) == (((0.0, 0.0), None) if system == "boundary" else (None, 0))
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    assert tuple(results()[0].location) == pytest.approx(wanted, abs=1e-3)


def test_transfer_takes_a_group_to_rooms_of_another_shape():
    face("source", ROOM, "lawn")
    face("target", [(10, 0), (18, 0), (18, 6), (10, 6)], "lawn")
    flowers = [box(f"Flower {i}", (0.2, 0.2, 0.2), "flower", at=(x, y, 0)) for i, (x, y) in enumerate([(1, 1), (3, 2)])]
    activate(*flowers)
    assert bpy.ops.geoanalogy.transfer(EXEC, True) == {"FINISHED"}
    # Twice as large: the inscribed circle, the unit of distances, is twice as large too.
    assert sorted(tuple(np.round(i.location[:2], 2)) for i in results()) == [(12.0, 2.0), (16.0, 4.0)]
    assert {i.data for i in results()} == {flower.data for flower in flowers}


def test_transfer_takes_results_on():
    face("source", ROOM, "bed")
    face("target", [(10, 0), (18, 0), (18, 6), (10, 6)], "bed")
    lamp = activate(box("Lamp", (0.2, 0.2, 1.0), "lamp", at=(0.5, 0.5, 0)))
    assert bpy.ops.geoanalogy.scatter(EXEC, True, count=3) == {"FINISHED"}
    inside = [i for i in results() if i.location.x < 5]
    activate(*inside)
    assert bpy.ops.geoanalogy.transfer(EXEC, True) == {"FINISHED"}
    made = results(operations_tree().nodes.active.name)
    assert len(made) == len(inside)
    assert all(i.location.x > 9 and i.data == lamp.data for i in made)


def test_results_with_data_of_their_own_are_taken_on_too():
    face("source", ROOM, "bed")
    face("target", LARGE, "bed")
    lamp = activate(box("Lamp", (0.2, 0.2, 1.0), "lamp", at=(0.5, 0.5, 0)))
    assert bpy.ops.geoanalogy.scatter(EXEC, True, count=1) == {"FINISHED"}
    (inside,) = [i for i in results() if i.location.x < 5]
    inside.data = inside.data.copy()
    activate(inside)
    (made,) = results(transfer().name)
    assert made.data == lamp.data


def test_a_result_of_an_operation_that_is_gone_is_not_taken_on():
    face("source", ROOM, "bed")
    face("target", LARGE, "bed")
    activate(box("Lamp", (0.2, 0.2, 1.0), "lamp", at=(0.5, 0.5, 0)))
    transfer()
    (made,) = results()
    made["ga_key"] = "nothing"
    activate(made)
    with pytest.raises(RuntimeError, match="is a result of nothing that is known here; replay the operations first"):
        transfer()


# ------------------------------------------------------------------------------------------------ bent objects


def radii(item):
    """Distances of an object's points from the middle of the round lawn."""
    bpy.context.view_layer.update()
    points = [item.matrix_world @ v.co for v in item.data.vertices] if item.type == "MESH" else []
    for spline in getattr(item.data, "splines", ()):
        points += [item.matrix_world @ Vector(p.co[:3]) for p in (spline.bezier_points or spline.points)]
    return np.array([np.hypot(p.x - 20, p.y) for p in points]), np.array([p.z for p in points])


def lawns():
    """A long lawn, and a round one of radius 2 about (20, 0)."""
    face("long", [(0, 0), (20, 0), (20, 2), (0, 2)], "lawn", at=(-30, 0, 0))
    turn = np.linspace(0, 2 * np.pi, 48, endpoint=False)
    face("round", np.column_stack([20 + 2 * np.cos(turn), 2 * np.sin(turn)]), "lawn")


def hedge(height=0.8, pieces=16):
    """A hedge along the edge of the long lawn, in many pieces."""
    x = np.linspace(-4, 4, pieces + 1)
    points = [(u, v, h) for u in x for v, h in ((-0.2, 0), (0.2, 0), (0.2, height), (-0.2, height))]
    sides = [
        [4 * i + k, 4 * i + (k + 1) % 4, 4 * i + 4 + (k + 1) % 4, 4 * i + 4 + k]
        for i in range(pieces)
        for k in range(4)
    ]
    mesh = bpy.data.meshes.new("Hedge")
    mesh.from_pydata(points, [], sides)
    item = link(bpy.data.objects.new("Hedge", mesh), "hedge")
    item.location = (-20, 0.5, 0.1)
    return item


def test_objects_keep_their_shape_or_are_bent(tmp_path):
    lawns()
    item = activate(hedge())
    transfer(distance="absolute")
    (kept,) = results()
    assert kept.data == item.data
    activate(item)
    node = transfer(distance="absolute", shape="outline")
    (bent,) = results()
    assert bent.data != item.data and item.data.users == 1
    away, height = radii(bent)
    wanted = 2 - np.where(np.array([v.co.y for v in item.data.vertices]) < 0, 0.3, 0.7)
    assert away == pytest.approx(wanted, abs=0.02)
    assert height == pytest.approx([0.1 + v.co.z for v in item.data.vertices], abs=1e-5)
    stored = bridge("tree.store").engine_node(node).operation.group.options
    assert stored.shape == "outline"
    every = placed()
    reload(tmp_path / "bent.blend")
    assert radii(results()[0])[0] == pytest.approx(away, abs=1e-6)
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    assert [row[2:] for row in placed()] == [row[2:] for row in every]
    assert radii(results()[0])[0] == pytest.approx(away, abs=1e-6)


@pytest.mark.parametrize("kind", ["POLY", "BEZIER"])
def test_curves_are_bent_with_their_handles(kind):
    lawns()
    curve = bpy.data.curves.new("Border", "CURVE")
    spline = curve.splines.new(kind)
    x = np.linspace(-4, 4, 9)
    path = [*((u, -0.2) for u in x), *((u, 0.2) for u in x[::-1])]
    points = spline.points if kind == "POLY" else spline.bezier_points
    points.add(len(path) - 1)
    for point, (u, v) in zip(points, path, strict=True):
        point.co = (u, v, 0.0, 1.0) if kind == "POLY" else (u, v, 0.0)
        if kind == "BEZIER":
            point.handle_left_type = point.handle_right_type = "FREE"
            point.handle_left, point.handle_right = (u, v, 0.0), (u, v, 0.0)
    spline.use_cyclic_u = True
    item = link(bpy.data.objects.new("Border", curve), "border")
    item.location = (-20, 0.5, 0)
    activate(item)
    transfer(distance="absolute", shape="outline")
    (bent,) = results()
    assert bent.data != curve
    assert radii(bent)[0] == pytest.approx([2 - (0.3 if v < 0 else 0.7) for _, v in path], abs=0.02)
    if kind == "BEZIER":
        assert all((p.handle_left - p.co).length < 1e-5 for p in bent.data.splines[0].bezier_points)


def test_shape_keys_are_bent_too():
    lawns()
    item = activate(hedge())
    item.shape_key_add(name="Basis")
    tall = item.shape_key_add(name="Tall")
    for point in tall.data:
        point.co.z *= 2
    transfer(distance="absolute", shape="outline")
    (bent,) = results()
    blocks = bent.data.shape_keys.key_blocks
    low, high = (np.array([p.co[:] for p in blocks[name].data]) for name in ("Basis", "Tall"))
    assert high[:, :2] == pytest.approx(low[:, :2], abs=1e-6) and high[:, 2] == pytest.approx(2 * low[:, 2], abs=1e-5)
    assert np.ptp(low[:, 1]) > 0.5  # 0.4 as it was made


def test_the_data_of_bent_results_go_with_them():
    lawns()
    activate(hedge())
    transfer(distance="absolute", shape="outline")
    for _ in range(3):
        assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    assert sorted(m.name for m in bpy.data.meshes if m.name.startswith("Hedge")) == ["Hedge", "Hedge.001"]
    assert bpy.ops.geoanalogy.clear(EXEC, True) == {"FINISHED"}
    assert [m.name for m in bpy.data.meshes if m.name.startswith("Hedge")] == ["Hedge"]


def test_bent_results_made_real_are_ones_own():
    lawns()
    activate(hedge())
    transfer(distance="absolute", shape="outline")
    (bent,) = results()
    own = bent.data
    assert bpy.ops.geoanalogy.make_real(EXEC, True) == {"FINISHED"}
    assert bent.data == own and "ga_key" not in own
    assert bpy.ops.geoanalogy.clear(EXEC, True) == {"FINISHED"}
    assert bent.data == own


def test_a_group_taken_to_an_equal_polygon_is_not_bent():
    for i in range(2):
        face(f"bed {i}", ROOM, "bed", at=(6.0 * i, 0.0, 0.0))
    flower = activate(box("Flower", (0.2, 0.3, 0.2), "flower", at=(1.0, 0.5, 0.0)))
    transfer(shape="outline")
    assert [i.data for i in results()] == [flower.data]


# ------------------------------------------------------------------------------------------------ walls


def test_groups_on_walls_stay_upright():
    """By their likeness alone, the long sides of a tall wall would correspond to those of a wide one."""
    outline("wide", ring(0, 0, 6.0, 2.5), "wall", frame("south"))
    outline("tall", ring(0, 0, 2.5, 6.0), "wall", frame("south", at=(8.0, 0.0, 0.0)))
    activate(sill("Lamp", frame("south"), (0.5, 0.4), label="lamp"))
    transfer(distance="absolute")
    (made,) = results()
    bpy.context.view_layer.update()
    assert (made.matrix_world.to_3x3() @ Vector((0, 0, 1))).normalized().z == pytest.approx(1.0, abs=1e-3)
    assert 8.0 < made.matrix_world.translation.x < 9.0 and 0.0 < made.matrix_world.translation.z < 1.0
    assert bridge("tree.store").engine_node(operations_tree().nodes.active).operation.group.options.upright
