"""Drawings: one region painted, all similar ones painted; lines of every kind, on planes of every direction."""

import bpy
import numpy as np
import pytest
import shapely
from conftest import batch_command, run
from flats import activate, bed, engine, link, propagate, reload, results, rooms
from pictures import (
    EXEC,
    INNER,
    LEVEL,
    PLACES,
    RING,
    TILTED,
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
    mesh_drawing,
    moved,
    operations,
    patch,
    stroke_drawing,
    world_points,
)


def found_of(node):
    return bridge("regions.results").targets_found(node)


def truth(points, plane=LEVEL, height=0.0):
    """Where points of the query belong on the two other leaves."""
    return [in_space(moved(points, *place), plane, height) for place in PLACES[1:]]


def carry(*items, **settings):
    activate(*items)
    assert bpy.ops.geoanalogy.carry_over(EXEC, True, **settings) == {"FINISHED"}


@pytest.mark.parametrize("make", [curve_drawing, stroke_drawing, mesh_drawing])
@pytest.mark.parametrize("plane", [LEVEL, UPRIGHT, TILTED], ids=["level", "upright", "tilted"])
def test_lines_of_every_kind_are_read_on_every_plane(make, plane):
    make(all_leaves(), plane)
    # Meshes count where a collection is chosen.
    holder = bpy.data.collections.new("Drawing")
    for item in list(bpy.context.scene.collection.objects):
        holder.objects.link(item)
    bpy.context.scene.collection.children.link(holder)
    bpy.context.scene.geoanalogy.drawing = holder
    drawn = bridge("regions.drawings").read_drawn_lines(bpy.context)
    assert len(drawn.lines) == 9
    assert abs(abs(drawn.plane.normal @ plane[:3, 2]) - 1.0) < 1e-5
    assert max(drawn.plane.normal[2], -drawn.plane.normal[1], drawn.plane.normal[0]) > 0.5
    points = np.vstack([drawn.plane.to_world(np.column_stack([p, np.zeros(len(p))])) for p in drawn.lines])
    for line in all_leaves():
        gaps = np.linalg.norm(in_space(line, plane)[:, None] - points[None], axis=2).min(axis=1)
        assert gaps.max() < 1e-4
    assert sum(np.allclose(line[0], line[-1]) for line in drawn.lines) == 3


def test_bezier_splines_and_strokes_are_read_as_they_are_drawn():
    item = link(bpy.data.objects.new("Bow", bpy.data.curves.new("Bow", "CURVE")))
    spline = item.data.splines.new("BEZIER")
    spline.bezier_points.add(1)
    for point, co in zip(spline.bezier_points, ((0, 0, 0), (2, 0, 0)), strict=True):
        point.co = co
        point.handle_left = point.handle_right = (co[0], 1, 0)
    (line,) = bridge("regions.drawings").lines_of(item)
    assert len(line) == spline.resolution_u + 1
    assert line[len(line) // 2] == pytest.approx((1.0, 0.75, 0.0))


def test_edges_are_joined_to_lines_that_end_where_they_branch():
    joined = bridge("regions.drawings").joined_edges
    ring = np.array([(0, 1), (2, 1), (2, 3), (3, 0)])
    assert [sorted(set(line.tolist())) for line in joined(ring)] == [[0, 1, 2, 3]]
    assert joined(ring)[0][0] == joined(ring)[0][-1]
    fork = joined(np.array([(0, 1), (1, 2), (2, 3), (2, 4)]))
    assert sorted(len(line) for line in fork) == [2, 2, 3]


def test_similar_regions_are_found_and_outlined():
    node = leaves_found()
    assert node["count"] == 2 and len(results()) == 2
    assert {item.type for item in results()} == {"CURVE"}
    assert node.name == "leaf"
    middles = np.array([world_points(item).mean(axis=0) for item in results()])
    for ring in truth(RING):
        assert np.linalg.norm(middles - ring.mean(axis=0), axis=1).min() < 0.2


@pytest.mark.parametrize("plane", [LEVEL, UPRIGHT, TILTED], ids=["level", "upright", "tilted"])
def test_a_mesh_is_carried_over_with_all_that_it_has(plane):
    node = leaves_found(plane)
    painted = patch(plane, height=-0.3)
    carry(painted)
    assert node["count"] == len(results()) == 2
    for goal in truth(INNER, plane, -0.3):
        gaps = [np.linalg.norm(world_points(item) - goal, axis=1).max() for item in results()]
        assert min(gaps) < 0.12
    for item in results():
        assert item.data != painted.data
        assert [m.name for m in item.data.materials] == ["Paint"]
        assert [tuple(uv.uv) for uv in item.data.uv_layers[0].data] == [
            tuple(uv.uv) for uv in painted.data.uv_layers[0].data
        ]
        assert item.vertex_groups["tip"].weight(3) == pytest.approx(0.75)
        with pytest.raises(RuntimeError):
            item.vertex_groups["tip"].weight(1)
        values = [v.value for v in item.data.attributes["ga_confidence"].data]
        assert len(values) == len(INNER) and min(values) > 0.3
        assert 0.0 < item["ga_similarity"] <= 1.0


def test_a_mirrored_target_mirrors_what_is_carried_and_faces_the_same_way():
    flipped = [line * (1.0, -1.0) + (7.0, 0.0) for line in leaf()]
    curve_drawing([*leaf(), *flipped])
    draw_query(name="leaf")
    node = find()
    best = found_of(node)[0]
    assert best.mirrored
    carry(patch())
    (item,) = (i for i in results() if i["ga_key"] == best.key)
    assert np.abs(world_points(item) - in_space(INNER * (1.0, -1.0) + (7.0, 0.0))).max() < 0.12
    assert item.data.polygons[0].normal.z > 0.9


def test_an_image_is_laid_on_all_regions_below_the_lines():
    node = leaves_found()
    bpy.context.scene.geoanalogy.image = image()
    assert bpy.ops.geoanalogy.lay_image(EXEC, True) == {"FINISHED"}
    (query,) = (item for item in bpy.data.collections["Painted"].objects)
    assert node["count"] == len(results()) == 2
    size = 9.0
    for item in (query, *results()):
        assert item.data.materials[0].node_tree.nodes["Image Texture"].image == bpy.data.images["paint.png"]
        assert len(item.data.vertices) > 300
        assert all(p.normal.z > 0.9 for p in item.data.polygons)
        assert -0.05 * size < world_points(item)[:, 2].max() < 0.0
    uv = np.array([tuple(one.uv) for one in query.data.uv_layers[0].data])
    assert uv.min() == pytest.approx(0.0, abs=1e-4) and uv.max() == pytest.approx(1.0, abs=1e-4)
    area = sum(p.area for p in query.data.polygons)
    assert area == pytest.approx(np.pi * 1.9 * 1.5, rel=0.02)


def test_a_later_image_lies_above_an_earlier_one():
    leaves_found()
    for _ in range(2):
        bpy.context.scene.geoanalogy.image = image()
        bpy.ops.geoanalogy.lay_image(EXEC, True)
    first, second = sorted(bpy.data.collections["Painted"].objects, key=lambda item: item.name)
    assert world_points(second)[:, 2].min() > world_points(first)[:, 2].max()
    assert len(results()) == 4


@pytest.mark.parametrize("make", [curve_drawing, stroke_drawing])
def test_strokes_and_curves_stay_editable_and_grow_with_their_region(make):
    leaves_found()
    hatch = [INNER[2:12], INNER[20:30]]
    painted = make(hatch, name="Hatch")
    carry(painted)
    assert len(results()) == 2
    for item in results():
        assert item.type == painted.type
        near = min(PLACES[1:], key=lambda p: np.linalg.norm(world_points(item).mean(axis=0)[:2] - p[0]))
        goal = in_space(moved(np.vstack(hatch), *near))
        assert np.abs(world_points(item) - goal).max() < 0.15
        if make is stroke_drawing:
            drawing = item.data.layers[0].frames[0].drawing
            assert len(drawing.strokes) == 2
            trust = np.array([v.value for v in drawing.attributes["ga_confidence"].data])
            assert len(trust) == 20 and trust.min() > 0.3 and trust.max() <= 1.0
            thickness = np.array([v.value for v in drawing.attributes["radius"].data]) / 0.02
        else:
            assert [len(s.points) for s in item.data.splines] == [10, 10]
            thickness = np.array([p.radius for s in item.data.splines for p in s.points])
        # A line is as thick as its points say, times the size of its object.
        thickness *= np.array(item.matrix_world.to_scale()).mean()
        assert np.median(thickness) == pytest.approx(near[1], rel=0.15)


def test_anything_else_is_carried_as_it_stands():
    leaves_found()
    item = link(bpy.data.objects.new("Bud", None))
    item.location, item.rotation_euler = (0.4, 0.2, 0.5), (0.0, 0.0, 0.3)
    carry(item)
    assert len(results()) == 2
    for made in results():
        bpy.context.view_layer.update()
        at = np.array(made.matrix_world.translation)[:2]
        near = min(PLACES[1:], key=lambda p, at=at: np.linalg.norm(at - p[0]))
        goal = in_space(moved([(0.4, 0.2)], *near), height=0.5)[0]
        assert np.linalg.norm(np.array(made.matrix_world.translation) - goal) < 0.1
        turn = made.matrix_world.to_euler().z - 0.3 - near[2]
        assert abs((turn + np.pi) % (2 * np.pi) - np.pi) < 0.15
        assert made.matrix_world.to_scale().x == pytest.approx(near[1], rel=0.15)


def test_the_slider_sifts_without_matching_again(monkeypatch):
    node = leaves_found()
    carry(patch())
    monkeypatch.setattr(engine("operations.region_transfer").RegionTransfer, "find_steps", None)
    similarities = sorted(target.similarity for target in found_of(node))
    node.threshold = similarities[-1] - 1e-4
    assert node["count"] == len(results()) == 1
    kept = results()[0].name
    node.threshold = 0.0
    assert node["count"] == len(results()) == len(similarities)
    assert kept in {item.name for item in results()}
    node.threshold = 1.0
    assert node["count"] == len(results()) == 0


def test_what_is_rejected_stays_away_and_what_is_accepted_stays():
    node = leaves_found()
    second = results()[1].name
    activate(results()[0])
    assert bpy.ops.geoanalogy.reject(EXEC, True) == {"FINISHED"}
    assert [item.name for item in results()] == [second]
    activate(results()[0])
    assert bpy.ops.geoanalogy.accept(EXEC, True) == {"FINISHED"}
    node.threshold = 1.0
    assert [item.name for item in results()] == [second]
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    assert [item.name for item in results()] == [second]
    assert bpy.ops.geoanalogy.forget_decisions(EXEC, True) == {"FINISHED"}
    assert results() == []
    node.threshold = 0.9
    bpy.ops.geoanalogy.reject_below(EXEC, True)
    node.threshold = 0.0
    assert all(item["ga_similarity"] >= 0.9 for item in results())


def test_muted_cleared_and_removed():
    node = leaves_found()
    assert bpy.ops.geoanalogy.mute_operation(EXEC, True) == {"FINISHED"}
    assert results() == []
    bpy.ops.geoanalogy.mute_operation(EXEC, True)
    assert len(results()) == 2
    bpy.ops.geoanalogy.clear(EXEC, True)
    assert results() == [] and node["count"] == 0
    bpy.ops.geoanalogy.replay(EXEC, True)
    assert len(results()) == 2
    bpy.ops.geoanalogy.remove_operation(EXEC, True)
    assert results() == [] and len(operations().nodes) == 0


def test_undo_and_redo():
    curve_drawing(all_leaves())
    bpy.ops.ed.undo_push(message="drawing")
    draw_query(name="leaf")
    find()
    bpy.context.scene.geoanalogy.image = image()
    bpy.ops.ed.undo_push(message="image")
    bpy.ops.geoanalogy.lay_image(EXEC, True)
    assert {item.type for item in results()} == {"MESH"}
    bpy.ops.ed.undo()
    assert {item.type for item in results()} == {"CURVE"} and len(results()) == 2
    bpy.ops.ed.redo()
    assert {item.type for item in results()} == {"MESH"} and len(results()) == 2
    assert operations().nodes.active.threshold > 0.0


def test_the_threshold_acts_after_reopening(tmp_path):
    leaves_found()
    bpy.context.scene.geoanalogy.image = image()
    bpy.ops.geoanalogy.lay_image(EXEC, True)
    before = [np.round(world_points(item), 4).tolist() for item in results()]
    reload(tmp_path / "leaves.blend")
    node = operations().nodes[0]
    assert [np.round(world_points(item), 4).tolist() for item in results()] == before
    node.threshold = 1.0
    assert results() == []
    node.threshold = 0.0
    assert len(results()) >= 2
    again = [np.round(world_points(item), 4).tolist() for item in results()]
    assert all(points in again for points in before)


def test_replay_on_the_changed_drawing():
    node = leaves_found()
    carry(patch())
    before = len(results())
    curve_drawing(leaf((-6.0, 3.0), 1.1, 1.2), name="More")
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    assert len(results()) == before + 1 == node["count"]
    goal = in_space(moved(INNER, (-6.0, 3.0), 1.1, 1.2))
    assert min(np.abs(world_points(item) - goal).max() for item in results()) < 0.15


def test_replay_on_another_drawing(tmp_path):
    leaves_found()
    carry(patch())
    name = operations().name
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "leaves.blend"))
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    places = [((30.0, 2.0), 1.2, -0.6), ((34.0, 5.0), 0.9, 2.0)]
    stroke_drawing(all_leaves(places), UPRIGHT)
    with bpy.data.libraries.load(str(tmp_path / "leaves.blend")) as (source, wanted):
        wanted.node_groups = [n for n in source.node_groups if n == name]
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    assert len(results()) == 2
    for place in places:
        goal = in_space(moved(INNER, *place), UPRIGHT)
        assert min(np.linalg.norm(world_points(item) - goal, axis=1).max() for item in results()) < 0.4


def test_an_edited_query_is_read_again():
    node = leaves_found()
    query = bpy.context.scene.geoanalogy.query
    query.location.x += 100.0
    bpy.ops.geoanalogy.replay(EXEC, True)
    # Out there it goes round nothing: the lines that it was recorded with are found where they were.
    assert node["count"] == 2
    query.location = (6.0, 1.0, 0.0)
    query.scale = (1.5, 1.5, 1.0)
    bpy.ops.geoanalogy.replay(EXEC, True)
    middles = [world_points(item).mean(axis=0)[:2] for item in results()]
    assert min(np.linalg.norm(m - np.array((6.0, 1.0))) for m in middles) > 2.0


def test_what_is_edited_after_carrying_over_is_said():
    node = leaves_found()
    painted = patch()
    carry(painted)
    painted.data.clear_geometry()
    painted.data.from_pydata([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [], [(0, 1, 2)])
    node.threshold = 0.0
    assert "has been edited; replay" in node["problem"]
    bpy.ops.geoanalogy.replay(EXEC, True)
    assert "problem" not in node
    assert {len(item.data.vertices) for item in results()} == {3}


def test_matches_of_little_evidence_say_so(monkeypatch):
    node = leaves_found()
    carry(patch())
    module = bridge("regions.results")
    best, second = found_of(node)[:2]
    assert not best.uncertain and module.uncertain_results(node) == []
    # A demand that lies between the two: the one with less evidence is a guess then.
    least = [min(target.coverage, target.confidence) for target in (best, second)]
    monkeypatch.setattr(module, "UNCERTAIN", sum(least) / 2)
    node.threshold = node.threshold - 1e-3
    assert len(module.uncertain_results(node)) == 1
    monkeypatch.setattr(module, "UNCERTAIN", 1.1)
    node.threshold = node.threshold - 1e-3
    assert module.uncertain_results(node) == [item.name for item in results()]


def test_the_brush_makes_a_region_of_all_its_strokes():
    curve_drawing(all_leaves())
    first = in_space([(-1.0, 0.3), (1.6, 0.3)]).tolist()
    second = in_space([(-1.0, -0.6), (1.6, -0.6)]).tolist()
    points = [{"name": "", "co": tuple(p), "first": i == 0} for s in (first, second) for i, p in enumerate(s)]
    assert bpy.ops.geoanalogy.draw_query(EXEC, True, mode="BRUSH", points=points, radius=0.7) == {"FINISHED"}
    query = bpy.context.scene.geoanalogy.query
    low, high = world_points(query)[:, :2].min(axis=0), world_points(query)[:, :2].max(axis=0)
    assert np.allclose(low, (-1.7, -1.3), atol=0.05) and np.allclose(high, (2.3, 1.0), atol=0.05)
    assert query["ga_query"] == "region"
    assert find()["count"] == 2


def test_a_lasso_that_crosses_itself_where_it_ends_is_untangled():
    curve_drawing(all_leaves())
    # It begins inside, and ends a bit beyond its start, outside.
    turn = np.linspace(0.0, 2.15 * np.pi, 80)
    size = np.linspace(0.96, 1.04, 80)[:, None]
    lasso = (0.2, 0.0) + size * np.stack([1.9 * np.cos(turn), 1.5 * np.sin(turn)], 1)
    draw_query(lasso, name="leaf")
    points = world_points(bpy.context.scene.geoanalogy.query)[:, :2]
    assert shapely.polygons(points).is_valid
    assert shapely.polygons(points).area == pytest.approx(np.pi * 1.9 * 1.5, rel=0.05)
    assert find()["count"] == 2


def test_a_small_dab_beside_the_brushed_region_is_left_out():
    curve_drawing(all_leaves())
    points = [(-0.6, 0.0), (0.9, 0.0), (1.1, 0.1), (2.2, 3.0)]
    strokes = [{"name": "", "co": (*p, 0.0), "first": i in (0, 3)} for i, p in enumerate(points)]
    bpy.ops.geoanalogy.draw_query(EXEC, True, mode="BRUSH", points=strokes[:3], radius=1.2)
    alone = world_points(bpy.context.scene.geoanalogy.query)
    with pytest.raises(RuntimeError, match="the brush has painted 2 regions apart from each other"):
        bpy.ops.geoanalogy.draw_query(EXEC, True, mode="BRUSH", points=strokes, radius=1.2)
    dab = [dict(one, co=(one["co"][0] * 20, one["co"][1], 0.0)) for one in strokes[:3]] + strokes[3:]
    bpy.ops.geoanalogy.draw_query(EXEC, True, mode="BRUSH", points=dab, radius=1.2)
    assert world_points(bpy.context.scene.geoanalogy.query)[:, 1].max() < alone[:, 1].max() + 0.1


def test_a_stroke_along_a_thin_shape():
    curve_drawing(all_leaves())
    line = np.stack([np.linspace(-0.8, 1.4, 20), 0.2 * np.linspace(-0.8, 1.4, 20) ** 2], 1)
    draw_query(line, mode="STROKE", name="vein")
    assert bpy.context.scene.geoanalogy.query["ga_query"] == "stroke"
    node = find(reach=0.5)
    assert node["operation"]["settings"]["options"]["query_kind"] == "stroke"
    assert node["count"] >= 1


def test_a_line_that_is_there_becomes_the_query():
    curve_drawing(all_leaves())
    ring = curve_drawing([np.vstack([RING, RING[:1]])], name="Ring")
    activate(ring)
    assert bpy.ops.geoanalogy.use_as_query(EXEC, True) == {"FINISHED"}
    assert bpy.context.scene.geoanalogy.query == ring and ring["ga_query"] == "region"
    assert find()["count"] == 2
    activate(stroke_drawing([RING[:20]], name="Arc"))
    bpy.ops.geoanalogy.use_as_query(EXEC, True)
    assert bpy.context.scene.geoanalogy.query["ga_query"] == "stroke"


def test_two_operations_stand_in_a_chain_beside_operations_on_polygons():
    leaves_found()
    draw_query(moved(RING, *PLACES[1]), name="other")
    find()
    rooms()
    bed()
    propagate()
    tree = operations()
    assert [(k.from_node.name, k.to_node.name) for k in tree.links] == [("leaf", "other")]
    count = len(results())
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    assert len(results()) == count
    assert [n.name for n in bridge("tree.store").drawing_nodes(tree)] == ["leaf", "other"]
    assert [n.name for n in bridge("tree.store").operation_nodes(tree)] == ["bed"]


def test_finding_again_records_the_same_operation_anew():
    node = leaves_found()
    activate(results()[0])
    bpy.ops.geoanalogy.reject(EXEC, True)
    again = find(mirrored=False)
    assert again == node and len(operations().nodes) == 1
    assert again["operation"]["settings"]["options"]["mirrored"] == 0
    assert len(results()) == 1


def test_an_svg_becomes_a_drawing(tmp_path):
    path = tmp_path / "leaves.svg"
    shapes = "".join(
        f'<path fill="none" d="M {" L ".join(f"{x} {10 - y}" for x, y in line)}"/>' for line in all_leaves()
    )
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="-5 -5 20 15">{shapes}</svg>')
    assert bpy.ops.geoanalogy.import_drawing(EXEC, True, filepath=str(path), scale=2.0) == {"FINISHED"}
    (item,) = bpy.context.scene.geoanalogy.drawing.objects
    assert len(item.data.splines) == 9
    widths = [np.ptp([p.co.x for p in s.points]) for s in item.data.splines]
    assert max(widths) == pytest.approx(2.0 * max(np.ptp(line[:, 0]) for line in all_leaves()), rel=1e-3)


def test_replay_by_the_batch_program(tmp_path):
    leaves_found()
    bpy.context.scene.geoanalogy.image = image()
    bpy.ops.geoanalogy.lay_image(EXEC, True)
    wanted = sorted(np.round(world_points(item), 3).tolist() for item in results())
    bpy.ops.geoanalogy.clear(EXEC, True)
    source, output = tmp_path / "leaves.blend", tmp_path / "replayed.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(source))
    done = run(batch_command("--quiet", "replay", str(source), "--output", str(output)), tmp_path)
    assert done.returncode == 0, done.stderr
    assert "1 operations replayed, 2 objects made" in done.stdout
    bpy.ops.wm.open_mainfile(filepath=str(output))
    assert sorted(np.round(world_points(item), 3).tolist() for item in results()) == wanted
    assert all(item.data.materials[0].name == "paint.png" for item in results())
