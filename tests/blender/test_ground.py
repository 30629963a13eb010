"""Objects to polygons: meshes, curves and grease pencils, on any plane, with their labels."""

import math

import bpy
import numpy as np
import pytest
from flats import ROOM, box, bridge, engine, face, link
from mathutils import Euler, Matrix, Vector

SQUARE = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], float)


def shifted(ring, x, y=0.0):
    return np.asarray(ring, float) + np.array((x, y))


def read(**options):
    bpy.context.view_layer.update()
    return bridge("reading.ground").read_grounds(bpy.context.scene, bpy.context.evaluated_depsgraph_get(), **options)


def only():
    (ground,) = read()
    return ground.scene.polygons


def curve(name, rings, kind="POLY", cyclic=True, dimensions="3D", label="room"):
    data = bpy.data.curves.new(name, "CURVE")
    data.dimensions = dimensions
    for ring in rings:
        spline = data.splines.new(kind)
        points = spline.bezier_points if kind == "BEZIER" else spline.points
        points.add(len(ring) - 1)
        if kind == "BEZIER":
            for point, co in zip(points, ring, strict=True):
                point.co = (*co, 0.0)
                point.handle_left_type = point.handle_right_type = "VECTOR"
        else:
            points.foreach_set("co", np.column_stack([ring, np.zeros(len(ring)), np.ones(len(ring))]).ravel())
        spline.use_cyclic_u = cyclic
    return link(bpy.data.objects.new(name, data), label)


def strokes(name, rings, cyclic=False, label="room"):
    data = bridge("versions").grease_pencils().new(name)
    drawing = data.layers.new("Lines").frames.new(1).drawing
    drawing.add_strokes([len(ring) for ring in rings])
    points = np.vstack([np.column_stack([ring, np.zeros(len(ring))]) for ring in rings])
    drawing.attributes["position"].data.foreach_set("vector", points.astype(np.float32).ravel())
    for stroke in drawing.strokes:
        stroke.cyclic = cyclic
    return link(bpy.data.objects.new(name, data), label)


def same_ring(found, expected):
    """Whether two rings are one, wherever they begin."""
    found, expected = np.asarray(found), np.asarray(expected, float)
    if len(found) != len(expected):
        return False
    return any(np.allclose(np.roll(found, i, axis=0), expected, atol=1e-5) for i in range(len(found)))


def test_a_face_is_a_polygon_with_its_label_and_name():
    face("Kitchen", ROOM, "kitchen", at=(2.0, 1.0, 0.0))
    (polygon,) = only()
    assert (polygon.id, polygon.label) == ("Kitchen", "kitchen")
    assert same_ring(polygon.points, shifted(ROOM, 2, 1))


def test_faces_that_share_edges_are_one_polygon_or_one_each():
    mesh = bpy.data.meshes.new("two")
    mesh.from_pydata(
        [(0, 0, 0), (1, 0, 0), (2, 0, 0), (2, 1, 0), (1, 1, 0), (0, 1, 0)], [], [(0, 1, 4, 5), (1, 2, 3, 4)]
    )
    item = link(bpy.data.objects.new("two", mesh), "room")
    (joined,) = only()
    assert joined.area == pytest.approx(2.0)
    assert len(joined.points) == 6
    item["ga_faces"] = "each"
    left, right = only()
    assert (left.id, right.id) == ("two/0", "two/1")
    assert [p.area for p in (left, right)] == pytest.approx([1.0, 1.0])


def test_materials_label_faces():
    mesh = bpy.data.meshes.new("two")
    mesh.from_pydata(
        [(0, 0, 0), (1, 0, 0), (2, 0, 0), (2, 1, 0), (1, 1, 0), (0, 1, 0)], [], [(0, 1, 4, 5), (1, 2, 3, 4)]
    )
    for name in ("bath", None):
        material = bpy.data.materials.new("m")
        if name:
            material["ga_label"] = name
        mesh.materials.append(material)
    mesh.polygons[1].material_index = 1
    link(bpy.data.objects.new("two", mesh), "hall")["ga_faces"] = "each"
    assert [p.label for p in only()] == ["bath", "hall"]


def test_a_ring_of_faces_has_a_hole():
    outer = [(x, y, 0) for x, y in ((0, 0), (4, 0), (4, 4), (0, 4))]
    inner = [(x, y, 0) for x, y in ((1, 1), (3, 1), (3, 3), (1, 3))]
    mesh = bpy.data.meshes.new("court")
    mesh.from_pydata(outer + inner, [], [[i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i] for i in range(4)])
    link(bpy.data.objects.new("court", mesh), "walk")
    (polygon,) = only()
    assert polygon.area == pytest.approx(12.0)
    assert len(polygon.holes) == 1


def test_a_mesh_of_edges_is_its_closed_lines():
    mesh = bpy.data.meshes.new("wire")
    mesh.from_pydata([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1), (3, 0), (2, 3), (1, 2)], [])
    link(bpy.data.objects.new("wire", mesh), "room")
    (polygon,) = only()
    assert polygon.area == pytest.approx(1.0)


def test_modifiers_of_drawn_meshes_count():
    item = face("half", SQUARE, "room")
    item.modifiers.new("Mirror", "MIRROR").use_axis = (True, False, False)
    (polygon,) = only()
    assert polygon.area == pytest.approx(2.0)


@pytest.mark.parametrize("kind", ["POLY", "BEZIER"])
def test_closed_splines_are_polygons(kind):
    curve("c", [SQUARE, shifted(SQUARE, 3)], kind)
    first, second = only()
    assert same_ring(first.points, SQUARE)
    assert same_ring(second.points, shifted(SQUARE, 3))


def test_a_bezier_circle_is_as_round_as_its_resolution():
    bpy.ops.curve.primitive_bezier_circle_add(radius=2.0)
    bpy.context.object["ga_label"] = "pond"
    bpy.context.object.data.resolution_u = 16
    (polygon,) = only()
    assert len(polygon.points) == 64
    assert np.hypot(*polygon.points.T) == pytest.approx(2.0, rel=1e-3)


def test_a_nurbs_circle_is_evaluated_as_blender_does():
    bpy.ops.curve.primitive_nurbs_circle_add(radius=2.0)
    item = bpy.context.object
    item["ga_label"] = "pond"
    count = len(bpy.data.curves), len(bpy.data.objects)
    (polygon,) = only()
    assert np.hypot(*polygon.points.T) == pytest.approx(2.0, rel=1e-3)
    assert (len(bpy.data.curves), len(bpy.data.objects)) == count


def test_splines_inside_a_filled_curve_are_holes():
    item = curve("c", [4 * SQUARE, SQUARE + 1], dimensions="2D")
    (polygon,) = only()
    assert polygon.area == pytest.approx(15.0)
    item.data.dimensions = "3D"
    assert [p.area for p in only()] == pytest.approx([16.0, 1.0])


def test_strokes_are_polygons_where_their_ends_meet():
    nearly = np.vstack([SQUARE, [(0.0, 0.01)]])
    strokes("s", [nearly, shifted(nearly, 3)])
    assert [p.area for p in only()] == pytest.approx([1.0, 1.0], abs=0.01)


def test_cyclic_strokes_are_polygons_and_hidden_layers_are_none():
    item = strokes("s", [SQUARE], cyclic=True)
    (polygon,) = only()
    assert same_ring(polygon.points, SQUARE)
    item.data.layers[0].hide = True
    with pytest.raises(engine().InputError, match="object 's' has no closed line"):
        read()


PLANES = [
    Matrix.Rotation(math.radians(90), 4, "X"),
    Matrix.Translation((3, -2, 5)) @ Euler((0.3, 1.1, -0.7)).to_matrix().to_4x4(),
]


@pytest.mark.parametrize("matrix", PLANES)
def test_shapes_on_any_plane_keep_their_form_and_share_a_frame(matrix):
    for i, item in enumerate([face("f", ROOM, "wall"), curve("c", [shifted(SQUARE, 1, 1)], label="window")]):
        item.matrix_world = matrix @ Matrix.Translation((0, 0, 0.001 * i))
    (ground,) = read()
    window, wall = ground.scene.polygons
    assert (window.area, wall.area) == pytest.approx((1.0, 12.0), rel=1e-5)
    assert ground.scene.parent("c").id == "f"
    back = ground.plane.to_world(np.column_stack([wall.points, np.zeros(4)]))
    expected = [matrix @ Vector((*p, 0)) for p in ROOM]
    gaps = np.linalg.norm(back[:, None] - np.array(expected)[None], axis=2)
    assert gaps.min(axis=1) == pytest.approx(0.0, abs=1e-5)


def test_level_planes_keep_world_coordinates_and_storeys_are_apart():
    face("ground floor", ROOM, "flat")
    face("rug", SQUARE, "rug", at=(1, 1, 0.01))
    face("upper floor", ROOM, "flat", at=(0, 0, 3.0))
    lower, upper = sorted(read(), key=lambda g: g.plane.origin[2])
    assert [p.id for p in lower.scene.polygons] == ["ground floor", "rug"]
    assert same_ring(upper.scene.polygons[0].points, ROOM)


def test_solid_objects_count_by_their_footprint():
    face("Room", ROOM, "room")
    box("Stove", (0.6, 0.6, 0.9), "stove", at=(1, 1, 0), turn=math.radians(90))
    polygons = {p.id: p for p in only()}
    assert polygons["Stove"].area == pytest.approx(0.36)
    assert polygons["Stove"].centroid == pytest.approx((1, 1))


def test_labels_come_from_the_object_its_collection_or_the_plans_collections():
    own, held, planned = (face(name, SQUARE, at=(2 * i, 0, 0)) for i, name in enumerate("abc"))
    labelled, plan, kitchen = (bpy.data.collections.new(n) for n in ("bath", "Plan", "kitchen"))
    for holder, parent in ((labelled, None), (plan, None), (kitchen, plan)):
        (parent or bpy.context.scene.collection).children.link(holder)
    labelled["ga_label"] = ""
    bpy.context.scene.geoanalogy.plan = plan
    labelled.objects.link(held)
    labelled.objects.link(own)
    kitchen.objects.link(planned)
    own["ga_label"] = "hall"
    assert [p.label for p in only()] == ["hall", "bath", "kitchen"]


def test_parents_orientations_and_segment_labels_come_from_properties():
    face("House", 10 * SQUARE, "house")
    room = face("Room", ROOM, "room", at=(20, 0, 0))
    room["ga_parent"] = "House"
    room["ga_orientation"] = 0.25
    room["ga_segment_labels"] = "door, , window,"
    room.rotation_euler[2] = math.radians(90)
    (ground,) = read()
    polygon = ground.scene.polygon("Room")
    assert ground.scene.parent("Room").id == "House"
    assert polygon.orientation == pytest.approx(0.25 + math.pi / 2)
    assert polygon.segment_labels == ("door", "", "window", "")


def test_a_door_is_validated_with_its_swing():
    face("Room", ROOM, "room")
    face("Door", SQUARE, "door")["ga_validation"] = "Swing"
    face("Swing", 1.5 * SQUARE)
    (ground,) = read()
    assert same_ring(ground.alternatives["Door"], 1.5 * SQUARE)
    assert [p.id for p in ground.scene.polygons] == ["Door", "Room"]


def test_results_and_named_objects_are_left_out():
    face("Room", ROOM, "room")
    box("Bed", (1, 1, 1), "bed", at=(1, 1, 0))
    (ground,) = read(without={"Bed"})
    assert [p.id for p in ground.scene.polygons] == ["Room"]


def bow_tie():
    return face("Knot", [(0, 0), (2, 2), (2, 0), (0, 1)], "room")


def flat_line():
    return curve("Line", [[(0, 0), (1, 0), (2, 0)]])


def not_a_number():
    item = face("Broken", ROOM, "room")
    item.data.vertices[2].co.x = math.nan
    return item


def far_away():
    return face("Far", 1e12 * SQUARE, "room")


def bent():
    item = curve("Bent", [2 * SQUARE])
    item.data.splines[0].points[2].co.z = 1.0
    return item


def branching():
    mesh = bpy.data.meshes.new("Fork")
    mesh.from_pydata([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1), (1, 2), (2, 0), (0, 3), (3, 2)], [])
    return link(bpy.data.objects.new("Fork", mesh), "room")


def unlabelled():
    item = face("Nameless", ROOM)
    plan = bpy.data.collections.new("Plan")
    bpy.context.scene.collection.children.link(plan)
    plan.objects.link(item)
    bpy.context.scene.geoanalogy.plan = plan
    return item


def lamp():
    return link(bpy.data.objects.new("Nothing", None), "room")


def no_swing():
    face("Door", ROOM, "door")["ga_validation"] = "Swing"


BAD = [
    (no_swing, "object 'Door' is to be validated as 'Swing', which is not there"),
    (lambda: curve("Open", [3 * SQUARE], cyclic=False), "spline 1 of object 'Open' is open: its ends are 3 apart"),
    (lambda: strokes("Open", [SQUARE]), "stroke 1 of layer 'Lines' of object 'Open' is open: its ends are 1 apart"),
    (bow_tie, "'Knot' crosses or touches itself"),
    (flat_line, "object 'Line' has no area"),
    (not_a_number, "object 'Broken' has a coordinate that is not finite"),
    (far_away, "'Far' lies more than"),
    (bent, "object 'Bent' is not flat"),
    (branching, "object 'Fork' has lines that branch"),
    (unlabelled, "object 'Nameless' of the plan has no label"),
    (lambda: None, "the scene has no labelled outlines"),
    (lambda: (face("Room", ROOM, "room"), lamp()), "object 'Nothing' has no extent on the plan"),
]


@pytest.mark.parametrize(("make", "message"), BAD, ids=[message.partition(":")[0] for _, message in BAD])
def test_what_cannot_be_used_is_named(make, message):
    make()
    with pytest.raises(engine().InputError, match=message):
        read()
