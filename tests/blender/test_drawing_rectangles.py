"""Drawing rectangles: lines of sight meet faces of every direction and kind; corners become examples."""

import bpy
import numpy as np
import pytest
from facades import DIRECTIONS, frame, outline, ring, street, wall
from flats import activate, bridge, everything, placed
from mathutils import Matrix, Vector

EXEC = "EXEC_DEFAULT"


def drawing():
    return bridge("rectangle_drawing")


def sight(where, x, y, away=7.0, aside=2.0):
    """A line of sight that meets a wall at x, y, not head-on."""
    eye = where @ Vector((x + aside, y - 1.0, away))
    return np.array(eye), np.array(where @ Vector((x, y, 0.0)) - eye)


def draw(sketch, where, start, end):
    assert sketch.press(*sight(where, *start))
    sketch.move(*sight(where, *end))
    return sketch.release()


def corners(where, item):
    """The corners of an object in a wall's coordinates."""
    bpy.context.view_layer.update()
    return np.array([where.inverted() @ item.matrix_world @ v.co for v in item.data.vertices])


@pytest.mark.parametrize("direction", DIRECTIONS)
@pytest.mark.parametrize("kind", ["mesh", "curve", "stroke"])
def test_a_rectangle_is_drawn_where_the_mouse_goes(direction, kind):
    where = frame(direction, at=(1.0, 2.0, 3.0))
    wall("house", where, kind=kind)
    sketch = drawing().Sketch(drawing().sites_to_draw_on(bpy.context))
    assert draw(sketch, where, (4.1, 3.2), (2.5, 5.9))
    (start, end, target) = sketch.done[0]
    assert target == 1.0
    (item,) = drawing().add_rectangles(bpy.context, [(start, end, target)], "window")
    low, high = corners(where, item).min(axis=0), corners(where, item).max(axis=0)
    assert low == pytest.approx((2.5, 3.2, 0.0), abs=1e-4)
    assert high == pytest.approx((4.1, 5.9, 0.0), abs=1e-4)
    assert item["ga_label"] == "window" and item["ga_drawn"] and item["ga_target"] == 1.0
    assert bpy.context.selected_objects == [item] and bpy.context.active_object == item


def test_the_nearest_face_is_drawn_on_and_the_smallest_there_gives_the_direction():
    near, far = frame("south"), frame("south", at=(0.0, 5.0, 0.0))
    wall("near", near)
    wall("far", far)
    turned = near @ Matrix.Translation((6.0, 3.0, 0.0)) @ Matrix.Rotation(0.3, 4, "Z")
    outline("sign", ring(0, 0, 2.0, 1.0), "sign", turned)
    grounds = drawing().sites_to_draw_on(bpy.context)
    face, point = drawing().face_in_sight(grounds, *sight(near, 1.0, 5.0))
    assert face.polygon.id == "near"
    assert tuple(near.inverted() @ Vector(point)) == pytest.approx((1.0, 5.0, 0.0), abs=1e-5)
    face, point = drawing().face_in_sight(grounds, *sight(turned, 0.5, 0.5))
    assert face.polygon.id == "sign"
    rectangle = drawing().rectangle_between(face, point, turned @ Vector((1.5, 0.9, 0.0)))
    assert (rectangle.angle, rectangle.width, rectangle.height) == pytest.approx((0.3, 1.0, 0.4), abs=1e-4)


def test_a_tall_wall_is_as_wide_as_it_is_level():
    where = frame("askew")
    outline("tower", ring(0, 0, 2.0, 30.0), "facade", where)
    face, point = drawing().face_in_sight(drawing().sites_to_draw_on(bpy.context), *sight(where, 0.5, 3.0))
    rectangle = drawing().rectangle_between(face, point, where @ Vector((1.5, 3.3, 0.0)))
    assert (rectangle.width, rectangle.height) == pytest.approx((1.0, 0.3), abs=1e-5)


def test_nothing_is_met_beside_and_behind_and_edge_on():
    where = frame("south")
    wall("house", where)
    grounds = drawing().sites_to_draw_on(bpy.context)
    eye, direction = sight(where, 1.0, 5.0)
    assert drawing().face_in_sight(grounds, eye, -direction) is None
    assert drawing().face_in_sight(grounds, *sight(where, 20.0, 5.0)) is None
    assert drawing().face_in_sight(grounds, (0.0, -3.0, 1.0), (1.0, 0.0, 0.0)) is None
    sketch = drawing().Sketch(grounds)
    assert not sketch.press(*sight(where, 20.0, 5.0))
    assert not sketch.dragging


def test_a_click_is_no_rectangle_and_the_last_one_can_be_taken_back():
    where = frame("east")
    wall("house", where)
    sketch = drawing().Sketch(drawing().sites_to_draw_on(bpy.context))
    before = everything()
    assert not draw(sketch, where, (1.0, 5.0), (1.0, 5.0))
    assert draw(sketch, where, (1.0, 5.0), (2.0, 5.5))
    sketch.target = 0.0
    assert draw(sketch, where, (3.0, 5.0), (4.0, 5.5))
    assert [target for *_, target in sketch.done] == [1.0, 0.0]
    sketch.press(*sight(where, 1.0, 1.0))
    sketch.take_back()
    assert not sketch.dragging and len(sketch.done) == 2
    sketch.take_back()
    assert len(sketch.done) == len(sketch.outlines) == 1
    sketch.take_back()
    sketch.take_back()
    assert sketch.done == []
    # Until it is finished, nothing of a sketch is in the scene.
    assert everything() == before


def test_a_rectangle_that_is_dragged_beyond_its_face_goes_on_in_its_plane():
    where = frame("askew")
    wall("house", where)
    sketch = drawing().Sketch(drawing().sites_to_draw_on(bpy.context))
    sketch.press(*sight(where, 8.0, 5.0))
    sketch.move(*sight(where, 11.0, 7.0))
    ring_, rectangle = sketch.current()
    assert (rectangle.width, rectangle.height) == pytest.approx((3.0, 2.0), abs=1e-4)
    assert np.abs([(where.inverted() @ Vector(p)).z for p in ring_]).max() < 1e-5


def test_what_was_drawn_before_is_no_face():
    where = frame("south")
    wall("house", where)
    ends = where @ Vector((1, 5, 0)), where @ Vector((2, 6, 0))
    drawing().add_rectangles(bpy.context, [(*ends, 1.0)], "example")
    face = drawing().face_at(drawing().sites_to_draw_on(bpy.context), where @ Vector((1.5, 5.5, 0.0)))
    assert face.polygon.id == "house"


def rows(where, *boxes):
    """Rectangles as the operator takes them."""
    return [
        {"name": "", "start": where @ Vector((x, y, 0)), "end": where @ Vector((x + w, y + h, 0)), "target": t}
        for x, y, w, h, t in boxes
    ]


def test_the_operator_is_one_step_of_undo_for_all_its_rectangles():
    where = frame("east")
    wall("house", where)
    bpy.ops.ed.undo_push(message="scene")
    before = everything()
    drawn = rows(where, (1, 5, 1, 0.5, 1.0), (4, 5, 1, 0.5, 0.3), (7, 5, 1, 0.5, 0.0))
    assert bpy.ops.geoanalogy.draw_rectangles(EXEC, True, rectangles=drawn, label="sign") == {"FINISHED"}
    made = sorted((i for i in bpy.data.objects if "ga_drawn" in i), key=lambda item: item.name)
    assert [item["ga_target"] for item in made] == pytest.approx([1.0, 0.3, 0.0])
    after = everything()
    bpy.ops.ed.undo()
    assert everything() == before
    bpy.ops.ed.redo()
    assert everything() == after


def test_without_a_label_of_its_own_it_takes_the_panels():
    where = frame("south")
    wall("house", where)
    bpy.context.scene.geoanalogy.rectangle_label = "shutter"
    assert bpy.ops.geoanalogy.draw_rectangles(EXEC, True, rectangles=rows(where, (1, 5, 1, 0.5, 1.0))) == {"FINISHED"}
    assert bpy.context.active_object["ga_label"] == "shutter"


def test_rectangles_alone_are_examples_of_a_rectangle():
    facades = street(("south", "east"))
    where, windows = facades[0]
    drawn = rows(where, *((x - 0.1, y - 0.25, 1.2, 0.15, 1.0) for x, y in (windows[k] for k in (0, 4, 2, 3))))
    bpy.ops.geoanalogy.draw_rectangles(EXEC, True, rectangles=drawn, label="mark")
    assert bpy.ops.geoanalogy.place(EXEC, True) == {"FINISHED"}
    made = [item for item in bpy.context.scene.objects if "ga_key" in item]
    assert len(made) == 14 - 4
    before = placed()
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    assert placed() == before


@pytest.mark.parametrize(
    ("boxes", "label", "message"),
    [
        ([], "sign", "no rectangle was drawn; drag one across a labelled face"),
        ([(1, 5, 1, 1, 1.0)], " ", "the rectangles have no label; say what they are before drawing them"),
        ([(1, 5, 1, 1, 1.0), (50, 5, 1, 1, 1.0)], "sign", "there is no labelled face here; label the face in step 1"),
        ([(1, 5, 0, 1, 1.0)], "sign", "the rectangle has no area; drag from one corner to the opposite one"),
    ],
)
def test_what_cannot_be_drawn_is_told_and_changes_nothing(boxes, label, message):
    where = frame("askew")
    wall("house", where)
    before = everything()
    with pytest.raises(RuntimeError, match=message):
        bpy.ops.geoanalogy.draw_rectangles(EXEC, True, rectangles=rows(where, *boxes), label=label)
    assert everything() == before


def test_there_must_be_something_labelled():
    activate(outline("plain", ring(0, 0, 3, 3), None, frame("south")))
    with pytest.raises(RuntimeError, match="the scene has no labelled outlines"):
        bpy.ops.geoanalogy.draw_rectangles(EXEC, True, rectangles=rows(frame("south"), (1, 1, 1, 1, 1.0)), label="a")
