"""Drawings: what cannot be done is said in one sentence, and the scene stays as it was."""

import bpy
import numpy as np
import pytest
from flats import activate, bed, everything, link, propagate, results, rooms
from pictures import EXEC, RING, all_leaves, curve_drawing, draw_query, image, leaf, leaves_found, patch


def nothing_drawn():
    pass


def leaves():
    curve_drawing(all_leaves())


def leaves_and_query():
    leaves()
    draw_query(name="leaf")


def query_outside():
    leaves()
    draw_query(RING + 100.0)


def one_straight_line():
    curve_drawing([np.array([(-1.0, 0.0), (1.0, 0.0)]), np.array([(5.0, 1.0), (9.0, 1.0)])])
    draw_query()


def query_across_itself():
    leaves()
    eight = np.stack([2.0 * np.sin(np.linspace(0, 6.2, 60)), np.sin(2 * np.linspace(0, 6.2, 60))], 1)
    draw_query(eight)


def point_that_is_no_number():
    leaves_and_query()
    item = curve_drawing([np.array([(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)])], name="Broken")
    item.data.splines[0].points[1].co[0] = float("nan")


def off_the_plane():
    leaves_and_query()
    curve_drawing(leaf((12.0, 3.0)), np.array([(1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 4), (0, 0, 0, 1)], float), "Above")


def query_deleted():
    leaves_and_query()
    bpy.context.scene.geoanalogy.query = None


def query_of_two_lines():
    leaves()
    ring = np.vstack([RING, RING[:1]])
    activate(curve_drawing([ring, ring * 0.5], name="Two"))


def mesh_active():
    leaves()
    activate(patch())


def found():
    leaves_found()


def found_and_image_missing():
    leaves_found()
    lost = bpy.data.images.new("lost", 4, 4)
    lost.source, lost.filepath = "FILE", "//nowhere.png"
    bpy.context.scene.geoanalogy.image = lost


def found_and_nothing_selected():
    leaves_found()
    for item in bpy.context.selected_objects:
        item.select_set(False)


def found_and_result_active():
    leaves_found()
    activate(results()[0])


def found_and_empty_mesh():
    leaves_found()
    activate(link(bpy.data.objects.new("Hollow", bpy.data.meshes.new("Hollow"))))


def drawing_erased():
    leaves_found()
    bpy.data.objects.remove(bpy.data.objects["Lines"])


DRAW = lambda points, **k: lambda: draw_query(points, **k)  # noqa: E731
FIND = lambda: bpy.ops.geoanalogy.find_regions(EXEC, True)  # noqa: E731
USE = lambda: bpy.ops.geoanalogy.use_as_query(EXEC, True)  # noqa: E731
CARRY = lambda: bpy.ops.geoanalogy.carry_over(EXEC, True)  # noqa: E731
LAY = lambda: bpy.ops.geoanalogy.lay_image(EXEC, True)  # noqa: E731
REPLAY = lambda: bpy.ops.geoanalogy.replay(EXEC, True)  # noqa: E731
CASES = [
    (nothing_drawn, DRAW(RING), "the scene has no drawing; draw with grease pencil or curves"),
    (nothing_drawn, FIND, "the scene has no drawing"),
    (leaves, DRAW(RING[:1]), "the query has no extent"),
    (leaves, DRAW(RING * 0.0), "the query has no extent"),
    (leaves, DRAW(RING * np.nan), "the query has a point that is not finite"),
    (leaves, DRAW(RING, mode="BRUSH"), "the brush has no radius"),
    (leaves, FIND, "there is no query; outline the region to look for"),
    (query_outside, FIND, "No line of the drawing lies in the query"),
    (one_straight_line, FIND, "The lines in the query are straight and match everywhere"),
    (query_across_itself, FIND, "The outline of the query region crosses itself"),
    (point_that_is_no_number, FIND, "object 'Broken' has a point that is not finite"),
    (off_the_plane, FIND, "lies off the plane of the drawing"),
    (query_deleted, FIND, "there is no query"),
    (leaves, USE, "nothing is selected; select the curve"),
    (query_of_two_lines, USE, "object 'Two' has 2 lines; a query is a single one"),
    (mesh_active, USE, "object 'Patch' is no line"),
    (found_and_result_active, USE, "is a result; select a line of your own"),
    (found_and_nothing_selected, CARRY, "nothing is selected; select what is painted on the query"),
    (found_and_result_active, CARRY, "is a result; select what is painted on the query"),
    (found_and_empty_mesh, CARRY, "object 'Hollow' has no points to carry over"),
    (found, LAY, "there is no image; choose one that is painted for the query"),
    (found_and_image_missing, LAY, "the image 'lost' cannot be read from '//nowhere.png'; choose one that is there"),
    (drawing_erased, REPLAY, "the scene has no drawing"),
]


@pytest.mark.parametrize(("make", "act", "message"), CASES, ids=[f"{i} {m[:30]}" for i, (_, _, m) in enumerate(CASES)])
def test_bad_input_is_named_and_leaves_the_scene_as_it_was(make, act, message):
    make()
    before = everything()
    with pytest.raises(RuntimeError, match=message):
        act()
    assert everything() == before


def test_only_operations_on_drawings_carry_over():
    rooms()
    bed()
    propagate()
    bpy.context.scene.geoanalogy.image = image()
    with pytest.raises(RuntimeError, match="the operation 'bed' works on no drawing"):
        bpy.ops.geoanalogy.lay_image(EXEC, True)


def test_a_damaged_svg_is_named(tmp_path):
    path = tmp_path / "broken.svg"
    path.write_text("<svg><path")
    before = everything()
    with pytest.raises(RuntimeError, match=r"broken\.svg"):
        bpy.ops.geoanalogy.import_drawing(EXEC, True, filepath=str(path))
    assert everything() == before
