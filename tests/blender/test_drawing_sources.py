"""Drawings: what of a scene counts as drawn, and how what is carried over keeps its own axes."""

import importlib
from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from flats import activate, everything, link, reload, results
from mathutils import Matrix
from pictures import (
    EXEC,
    INNER,
    PLACES,
    RING,
    UPRIGHT,
    all_leaves,
    bridge,
    curve_drawing,
    draw_query,
    find,
    image,
    in_space,
    leaf,
    leaves_found,
    moved,
    operations,
    patch,
    stroke_drawing,
    world_points,
)

#: Place, size and turn of a leaf that is drawn elsewhere than the others.
AWAY = ((-7.0, 2.0), 1.1, 1.3)


def drawn():
    """The lines that are read."""
    return bridge("regions.drawings").read_drawn_lines(bpy.context).lines


def holds(lines, wanted):
    """Whether all wanted lines are among those that are read, and no others."""
    near = lambda a, b: a.shape == b.shape and np.abs(a - b).max() < 1e-4  # noqa: E731
    return len(lines) == len(wanted) and all(any(near(a, b) for a in lines) for b in wanted)


def strokes_into(drawing, lines):
    """Add lines to a drawing of grease pencil."""
    drawing.add_strokes([len(line) for line in lines])
    points = np.vstack([in_space(line) for line in lines]).astype(np.float32)
    drawing.attributes["position"].data.foreach_set("vector", points.ravel())


@pytest.mark.parametrize("make", [curve_drawing, stroke_drawing])
def test_objects_that_are_moved_turned_and_scaled_are_read_where_they_lie(make):
    wanted = all_leaves()
    make(leaf())
    for place in PLACES[1:]:
        # Drawn flipped and half as wide; the object puts that right.
        frame = Matrix.Translation((*place[0], 0.0)) @ Matrix.Rotation(place[2], 4, "Z")
        shape = Matrix.Diagonal((2.0 * place[1], -place[1], 1.0, 1.0))
        make([line * (0.5, -1.0) for line in leaf()], np.array(frame @ shape), "More")
    assert holds(drawn(), wanted)
    draw_query(name="leaf")
    assert find()["count"] == 2


def test_strokes_of_several_objects_and_layers_are_one_drawing():
    stroke_drawing(leaf(*PLACES[0]))
    item = stroke_drawing(leaf(*PLACES[1]), name="Second")
    strokes_into(item.data.layers.new("Above").frames.new(bpy.context.scene.frame_current).drawing, leaf(*PLACES[2]))
    assert holds(drawn(), all_leaves())


def hide_layer(item):
    item.data.layers["Draft"].hide = True


def hide_group(item):
    group = item.data.layer_groups.new("Drafts")
    item.data.layers.move_to_layer_group(item.data.layers["Draft"], group)
    group.hide = True


def hide_outer_group(item):
    outer = item.data.layer_groups.new("All Drafts")
    inner = item.data.layer_groups.new("Drafts", parent_group=outer)
    item.data.layers.move_to_layer_group(item.data.layers["Draft"], inner)
    outer.hide = True


@pytest.mark.parametrize("hide", [hide_layer, hide_group, hide_outer_group])
def test_what_is_hidden_in_grease_pencil_is_not_drawn(hide):
    item = stroke_drawing(all_leaves())
    strokes_into(item.data.layers.new("Draft").frames.new(bpy.context.scene.frame_current).drawing, leaf(*AWAY))
    assert len(drawn()) == 12
    hide(item)
    assert holds(drawn(), all_leaves())


def test_what_is_hidden_in_grease_pencil_is_not_carried_over():
    leaves_found()
    item = stroke_drawing([INNER[2:12]], name="Hatch")
    strokes_into(item.data.layers.new("Draft").frames.new(bpy.context.scene.frame_current).drawing, [INNER[20:30]])
    hide_group(item)
    assert len(world_points(item)) == 10
    activate(item)
    assert bpy.ops.geoanalogy.carry_over(EXEC, True) == {"FINISHED"}
    near = [
        np.linalg.norm(world_points(made) - (*place[0], 0.0), axis=1).max() for made in results() for place in PLACES
    ]
    assert len(results()) == 2 and sorted(near)[1] < 2.0


def test_hidden_objects_count_only_in_the_collection_that_holds_the_drawing():
    curve_drawing(all_leaves())
    other = curve_drawing(leaf(*AWAY), name="Other")
    other.hide_set(True)
    assert holds(drawn(), all_leaves())
    holder = bpy.data.collections.new("Drawing")
    bpy.context.scene.collection.children.link(holder)
    holder.objects.link(other)
    bpy.context.scene.geoanalogy.drawing = holder
    assert holds(drawn(), leaf(*AWAY))


def test_the_frame_at_the_playhead_is_the_drawing(tmp_path):
    scene = bpy.context.scene
    item = stroke_drawing(all_leaves())
    second = item.data.layers["Ink"].frames.new(scene.frame_current + 9).drawing
    moved_on = [((3.0, -8.0), 0.9, -1.2)]
    strokes_into(second, [*leaf(), *all_leaves(moved_on)])
    draw_query(name="leaf")
    assert find()["count"] == 2
    scene.frame_set(scene.frame_current + 9)
    assert holds(drawn(), [*leaf(), *all_leaves(moved_on)])
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    assert operations().nodes.active["count"] == 1
    (made,) = results()
    assert (
        np.linalg.norm(world_points(made).mean(axis=0)[:2] - in_space(moved(RING, *moved_on[0])).mean(axis=0)[:2]) < 0.2
    )
    reload(tmp_path / "frames.blend")
    bpy.context.scene.frame_set(bpy.context.scene.frame_current - 9)
    bpy.ops.geoanalogy.replay(EXEC, True)
    assert operations().nodes.active["count"] == 2


def test_modifiers_draw_no_lines():
    item = curve_drawing(all_leaves())
    item.modifiers.new("Mirror", "MIRROR")
    other = stroke_drawing(leaf(*AWAY))
    other.modifiers.new("Mirror", "GREASE_PENCIL_MIRROR")
    assert holds(drawn(), [*all_leaves(), *leaf(*AWAY)])


def broken_stroke():
    item = stroke_drawing(all_leaves())
    item.data.layers[0].frames[0].drawing.attributes["position"].data[5].vector = (float("nan"), 0.0, 0.0)


def broken_mesh():
    curve_drawing(all_leaves())
    mesh = bpy.data.meshes.new("Strokes")
    mesh.from_pydata([(0.0, 0.0, 0.0), (1.0, float("inf"), 0.0)], [(0, 1)], [])
    holder = bpy.data.collections.new("Drawing")
    holder.objects.link(link(bpy.data.objects.new("Strokes", mesh)))
    bpy.context.scene.geoanalogy.drawing = holder


def far_away():
    stroke_drawing(all_leaves()).location.x = 1e9


def nowhere():
    stroke_drawing(all_leaves()).location.x = float("inf")


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (broken_stroke, "object 'Strokes' has a point that is not finite"),
        (broken_mesh, "object 'Strokes' has a point that is not finite"),
        (far_away, "object 'Strokes' has a point beyond"),
        (nowhere, "object 'Strokes' has a point beyond"),
    ],
)
def test_lines_that_cannot_be_used_are_named_and_nothing_changes(make, message):
    make()
    before = everything()
    with pytest.raises(RuntimeError, match=message):
        draw_query(name="leaf")
    assert everything() == before


def test_a_broken_point_in_what_is_carried_over_is_named_and_nothing_changes():
    leaves_found()
    item = stroke_drawing([INNER[2:12]], name="Hatch")
    item.data.layers[0].frames[0].drawing.attributes["position"].data[3].vector = (float("nan"), 0.0, 0.0)
    activate(item)
    before = everything()
    with pytest.raises(RuntimeError, match="object 'Hatch' has a point that is not finite"):
        bpy.ops.geoanalogy.carry_over(EXEC, True)
    assert everything() == before


def test_a_drawing_of_a_million_points_is_matched():
    share = np.linspace(0.0, 2.0 * np.pi, 120_000)
    for place in PLACES:
        rim = np.stack(
            [1.2 * np.cos(share) + 0.3 * np.cos(2 * share), 0.7 * np.sin(share) + 0.25 * np.cos(share) ** 2], 1
        )
        rings = [rim * size for size in (1.0, 0.6, 0.3)]
        stroke_drawing([moved(ring, *place) for ring in rings], name="Dense")
    assert sum(map(len, drawn())) > 1_000_000
    draw_query(name="leaf")
    node = find()
    assert node["count"] == 2
    middles = np.array([world_points(item).mean(axis=0)[:2] for item in results()])
    for place in PLACES[1:]:
        assert np.linalg.norm(middles - moved(RING, *place).mean(axis=0), axis=1).min() < 0.2


def test_a_mirroring_modifier_acts_on_the_copies_as_on_the_original():
    curve_drawing(all_leaves())
    draw_query(name="leaf")
    find()
    # The upper half of a square on a turned object; a modifier makes the lower one.
    half = patch(points=np.array([(-0.5, 0.0), (0.5, 0.0), (0.5, 0.5), (-0.5, 0.5)]))
    half.matrix_world = Matrix.Translation((0.1, 0.1, 0.0)) @ Matrix.Rotation(0.5, 4, "Z")
    mirror = half.modifiers.new("Mirror", "MIRROR")
    mirror.use_axis = (False, True, False)
    activate(half)
    assert bpy.ops.geoanalogy.carry_over(EXEC, True) == {"FINISHED"}
    whole = shown_points(half)
    assert len(whole) > 4
    for place in PLACES[1:]:
        goal = in_space(moved(whole[:, :2], *place))
        gaps = [np.linalg.norm(shown_points(item)[:, None] - goal, axis=2).min(axis=0).max() for item in results()]
        assert min(gaps) < 0.12


def shown_points(item):
    """The vertices of a mesh in the world, as its modifiers leave them."""
    bpy.context.view_layer.update()
    shown = item.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return np.array([item.matrix_world @ v.co for v in shown.data.vertices])


def test_the_origin_of_a_copy_lies_where_that_of_the_original_belongs():
    leaves_found()
    painted = patch()
    painted.data.transform(Matrix.Translation((-0.5, 0.2, 0.0)))
    painted.location = (0.5, -0.2, 0.0)
    activate(painted)
    bpy.ops.geoanalogy.carry_over(EXEC, True)
    for place in PLACES[1:]:
        goal = np.array((*moved([(0.5, -0.2)], *place)[0], 0.0))
        made = min(results(), key=lambda item: np.linalg.norm(np.array(item.matrix_world.translation) - goal))
        assert np.linalg.norm(np.array(made.matrix_world.translation) - goal) < 0.1
        assert made.matrix_world.to_scale().x == pytest.approx(place[1], rel=0.15)
        turn = made.matrix_world.to_euler().z - place[2]
        assert abs((turn + np.pi) % (2 * np.pi) - np.pi) < 0.15


def test_what_is_scaled_flat_is_carried_over_flat():
    leaves_found()
    painted = patch()
    painted.data.vertices[3].co.z = 0.7
    painted.scale.z = 0.0
    activate(painted)
    assert bpy.ops.geoanalogy.carry_over(EXEC, True) == {"FINISHED"}
    for place in PLACES[1:]:
        goal = in_space(moved(INNER, *place))
        assert min(np.linalg.norm(world_points(item) - goal, axis=1).max() for item in results()) < 0.12


def test_a_single_point_is_carried_over():
    leaves_found()
    mesh = bpy.data.meshes.new("Dot")
    mesh.from_pydata([(0.3, 0.1, 0.2)], [], [])
    activate(link(bpy.data.objects.new("Dot", mesh)))
    assert bpy.ops.geoanalogy.carry_over(EXEC, True) == {"FINISHED"}
    for place in PLACES[1:]:
        goal = in_space(moved([(0.3, 0.1)], *place), height=0.2)[0]
        assert min(np.linalg.norm(world_points(item)[0] - goal) for item in results()) < 0.1


def test_images_are_undone_redone_and_laid_in_layers(tmp_path):
    leaves_found()
    bpy.context.scene.geoanalogy.image = image()
    bpy.ops.ed.undo_push(message="found")
    bpy.ops.geoanalogy.lay_image(EXEC, True)
    bpy.ops.geoanalogy.lay_image(EXEC, True)
    heights = lambda: sorted(round(float(world_points(i)[:, 2].max()), 6) for i in results())  # noqa: E731
    both = heights()
    assert len(both) == 4
    bpy.ops.ed.undo()
    assert len(heights()) == 2 and len(bpy.data.collections["Painted"].objects) == 1
    bpy.ops.ed.redo()
    assert heights() == both
    reload(tmp_path / "layers.blend")
    assert heights() == both
    bpy.ops.geoanalogy.replay(EXEC, True)
    assert heights() == both


def test_queries_and_regions_are_seen_as_coloured_lines():
    node = leaves_found()
    query = node["query_object"]
    size = bridge("regions.drawings").read_drawn_lines(bpy.context).size
    for item in (query, *results()):
        (material,) = item.data.materials
        assert 0.0 < item.data.bevel_depth < 0.005 * size
        assert (material.diffuse_color[1] > material.diffuse_color[0]) == (item == query)
        assert item.hide_render and item.show_in_front
    assert len({item.data.materials[0] for item in results()}) == 1
    before = len(bpy.data.materials)
    draw_query(name="again")
    find()
    assert len(bpy.data.materials) == before


def sketch_of(mode):
    """A query that is being drawn on an upright drawing, and what it shows of points of the drawing's plane."""
    stroke_drawing(all_leaves(), UPRIGHT)
    plane = bridge("regions.drawings").read_drawn_lines(bpy.context).plane
    sketch = bridge("regions.sketch").QuerySketch(plane, mode)
    return sketch, lambda points: [np.array(p) for p in in_space(points, UPRIGHT)]


def test_the_mouse_is_followed_on_the_plane_of_the_drawing():
    sketch, place = sketch_of("STROKE")
    (point,) = place([(1.5, 0.5)])
    eye = np.array((4.0, -30.0, 8.0))
    assert sketch.sight(eye, point - eye) == pytest.approx(point)
    assert sketch.sight(eye, (1.0, 0.0, 0.0)) is None


@pytest.mark.parametrize(("mode", "shown"), [("LASSO", 4), ("STROKE", 3)])
def test_of_a_lasso_and_a_stroke_the_last_drag_counts(mode, shown):
    sketch, place = sketch_of(mode)
    for drag in ([(0, 0), (1, 0), (1, 1)], [(5, 5), (6, 5), (6, 6), (6, 6)]):
        first, *others = place(np.array(drag, float))
        sketch.press(first)
        for point in others:
            sketch.move(point)
    (line,) = sketch.outlines()
    assert len(line) == shown and line[:3] == pytest.approx(np.array(place([(5, 5), (6, 5), (6, 6)])))
    sketch.take_back()
    assert sketch.outlines() == []
    sketch.take_back()


def test_the_brush_adds_up_and_takes_back():
    sketch, place = sketch_of("BRUSH")
    assert sketch.outlines() == []
    sketch.radius = 0.5
    for drag in ([(0, 0), (3, 0)], [(0, 0.6), (3, 0.6)], [(0, 5), (3, 5)]):
        first, second = place(np.array(drag, float))
        sketch.press(first)
        sketch.move(second)
    assert len(sketch.outlines()) == 2
    sketch.take_back()
    (ring,) = sketch.outlines()
    low, high = np.array(place([(-0.5, -0.5), (3.5, 1.1)]))
    assert ring.min(axis=0) == pytest.approx(np.minimum(low, high), abs=0.05)
    assert ring.max(axis=0) == pytest.approx(np.maximum(low, high), abs=0.05)


@pytest.mark.parametrize("kind", ["MOUSEMOVE", "INBETWEEN_MOUSEMOVE"])
def test_every_move_of_the_mouse_counts_where_the_window_takes_long_to_draw(addon, kind):
    """Blender calls those in between that a slow window has missed by another name."""
    operator = importlib.import_module(f"{addon.__name__}.operators.draw_query").GEOANALOGY_OT_draw_query
    followed = []
    drawing = SimpleNamespace(
        is_shown=lambda context: True,
        _area=SimpleNamespace(tag_redraw=lambda: None),
        _dragging=True,
        _drag=lambda context, event: followed.append(event.type),
    )
    event = SimpleNamespace(type=kind, value="NOTHING")
    assert operator.modal(drawing, bpy.context, event) == {"RUNNING_MODAL"} and followed == [kind]
