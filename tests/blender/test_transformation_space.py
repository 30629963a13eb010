"""The view of the transformation space: every correspondence in five plots, in the colour of its match (appendix B)."""

import bpy
import numpy as np
import pytest
from flats import bed, engine, everything, propagate, reload, results, rooms
from pictures import (
    EXEC,
    LEVEL,
    TILTED,
    bridge,
    curve_drawing,
    draw_query,
    find,
    in_space,
    leaves_found,
    moved,
    operations,
)

PLOTS, CORNERS = 5, 6


def show():
    assert bpy.ops.geoanalogy.show_transformations(EXEC, True) == {"FINISHED"}
    return view()


def view(node="leaf"):
    return bridge("regions.space_view").space_collection(bpy.context.scene, node)


def shown(kind):
    """The objects of the view whose names say what they are."""
    return sorted((item for item in view().objects if item.name.startswith(f"leaf {kind}")), key=lambda i: i.name)


def attribute(item, name, key="value", width=1):
    data = item.data.attributes[name].data
    values = np.empty(len(data) * width, bool if name == "mirrored" else np.float32 if name != "match" else np.int32)
    data.foreach_get(key, values)
    return values.reshape(-1, width) if width > 1 else values


@pytest.mark.parametrize("plane", [LEVEL, TILTED], ids=["level", "tilted"])
def test_every_correspondence_is_shown_with_what_is_known_of_it(plane):
    node = leaves_found(plane)
    holder = show()
    (points,) = shown("correspondences")
    count = len(points.data.vertices)
    assert count == holder["count"] > 100
    match = attribute(points, "match")
    assert sorted(set(match.tolist())) == [0, 1, 2] and node["count"] == 2
    weight = attribute(points, "confidence")
    assert holder["inliers"].to_list() == pytest.approx(
        [(match > 0).mean(), weight[match > 0].sum() / weight.sum()], rel=1e-4
    )
    assert weight.max() == pytest.approx(1.0) and weight.min() > 0.0
    # Moving a query point by its translation leads to its target.
    at = np.array([v.co[:] for v in points.data.vertices])
    gap = attribute(points, "target", "vector", 3) - at - attribute(points, "translation", "vector", 3)
    assert np.abs(gap).max() < 1e-4
    # The best leaf is larger and turned as it was drawn.
    sizes = {round(float(np.median(attribute(points, "scale")[match == k])), 1) for k in (1, 2)}
    assert sizes == {1.3, 0.8}
    assert not attribute(points, "mirrored")[match > 0].any()
    # The query lies round the origin of the drawing's plane.
    world = at @ np.array(points.matrix_world)[:3, :3].T + np.array(points.matrix_world)[:3, 3]
    assert np.linalg.norm(world - in_space([(0.2, 0.0)], plane), axis=1).max() < 2.2


def test_each_match_is_an_object_of_one_colour_in_all_plots():
    leaves_found()
    show()
    match = attribute(shown("correspondences")[0], "match")
    for k, item in enumerate(shown("match"), 1):
        assert len(item.data.vertices) == PLOTS * CORNERS * (match == k).sum()
        assert len(item.data.materials) == 1
    (rest,) = shown("of no match")
    assert len(rest.data.vertices) == PLOTS * CORNERS * (match == 0).sum()
    colours = [tuple(item.data.materials[0].diffuse_color) for item in shown("match")]
    assert len(set(colours)) == 2
    greys = [m.diffuse_color[0] for m in rest.data.materials]
    assert greys == sorted(greys, reverse=True) and len(greys) == 4
    # A match is a cluster: in the plot of translations and rotation it is far smaller than the plot.
    edge = np.ptp([v.co.z for v in shown("axes")[0].data.splines[1].points])
    for item in shown("match"):
        points = np.array([v.co[:] for v in item.data.vertices])[: (match == 1).sum()]
        assert np.ptp(points, axis=0).max() < 0.5 * edge


def test_it_lies_beside_the_drawing_and_is_neither_drawn_nor_rendered():
    leaves_found()
    right = max(v.co.x for s in bpy.data.objects["Lines"].data.splines for v in s.points)
    before = len(bridge("regions.drawings").read_drawn_lines(bpy.context).lines)
    show()
    assert all(item.hide_render for item in view().objects)
    for item in [*shown("match"), *shown("axes")]:
        assert min((item.matrix_world @ v.co.to_3d()).x for v in corners_of(item)) > right
    assert len(bridge("regions.drawings").read_drawn_lines(bpy.context).lines) == before


def corners_of(item):
    return item.data.vertices if item.type == "MESH" else [p for s in item.data.splines for p in s.points]


def test_the_threshold_colours_it_anew_without_matching_again(monkeypatch):
    node = leaves_found()
    show()
    monkeypatch.setattr(engine("operations.region_transfer").RegionTransfer, "find_steps", None)
    similarities = sorted(item["ga_similarity"] for item in results())
    before = view()["inliers"].to_list()
    node.threshold = similarities[0] + 1e-4
    assert len(shown("match")) == 1
    assert view()["inliers"].to_list()[0] < before[0]
    node.threshold = 1.0
    assert shown("match") == [] and view()["inliers"].to_list() == [0.0, 0.0]
    node.threshold = similarities[0] - 1e-4
    assert view()["inliers"].to_list() == pytest.approx(before)


def test_showing_again_leaves_nothing_behind_and_keeps_what_a_user_has_put_there():
    leaves_found()
    show()
    own = bpy.data.objects.new("Note", None)
    view().objects.link(own)
    count = len(view().objects)
    data = len(bpy.data.meshes), len(bpy.data.curves), len(bpy.data.materials)
    show()
    assert len(view().objects) == count and own.name in view().objects
    assert (len(bpy.data.meshes), len(bpy.data.curves), len(bpy.data.materials)) == data


def test_undo_redo_save_and_reload(tmp_path):
    bpy.ops.ed.undo_push(message="nothing")
    leaves_found()
    show()
    count = len(view().objects)
    bpy.ops.ed.undo()
    assert view() is None
    bpy.ops.ed.redo()
    assert len(view().objects) == count
    reload(tmp_path / "space.blend")
    assert len(view().objects) == count
    (points,) = shown("correspondences")
    before = attribute(points, "scale").tolist()
    # What was found is not in the file: it is found again.
    show()
    assert attribute(shown("correspondences")[0], "scale").tolist() == before
    assert operations().nodes.active.name == "leaf"


def marks():
    """Short marks of one size, and the same elsewhere: an engine that lays them over one another as a whole."""
    rng = np.random.default_rng(4)
    spots = rng.uniform(-1.0, 1.0, (40, 2))
    turns = rng.uniform(0.0, np.pi, 40)
    dashes = [s + 0.03 * np.outer((-1, 0, 1), (np.cos(t), np.sin(t))) for s, t in zip(spots, turns, strict=True)]
    return [*dashes, *(moved(dash, (5.0, 0.0)) for dash in dashes)]


def test_marks_have_none():
    curve_drawing(marks())
    draw_query(1.3 * np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]), name="marks")
    find()
    before = everything()
    with pytest.raises(RuntimeError, match="'marks' has no transformation space: its query holds short marks"):
        bpy.ops.geoanalogy.show_transformations(EXEC, True)
    assert everything() == before


def test_operations_on_polygons_have_none():
    rooms()
    bed()
    propagate()
    with pytest.raises(RuntimeError, match="the operation 'bed' works on no drawing"):
        bpy.ops.geoanalogy.show_transformations(EXEC, True)
