"""Placing by several examples: on walls of every direction, drawn in every way; learned, sifted, rejected, replayed."""

import bpy
import numpy as np
import pytest
from facades import (
    DIRECTIONS,
    examples,
    expected,
    frame,
    operation,
    outline,
    placement_node,
    points_on,
    ring,
    shift,
    sill,
    street,
    wall,
)
from flats import (
    activate,
    bed,
    box,
    bridge,
    everything,
    link,
    operations_tree,
    placed,
    propagate,
    reload,
    results,
    rooms,
)
from mathutils import Matrix, Vector

EXEC = "EXEC_DEFAULT"


def place(**settings):
    assert bpy.ops.geoanalogy.place(EXEC, True, **settings) == {"FINISHED"}
    return placement_node()


def sills_stand(facades, made, without=(), others=0):
    """Whether there is one sill below every window, and no others but so many."""
    wanted = [(where, corner) for where, corners in facades for corner in corners]
    assert len(made) <= len(wanted) - len(without) + others
    for k, (where, corner) in enumerate(wanted):
        low, high = expected(corner)
        fits = [
            item
            for item in made
            if np.allclose(points_on(where, item)[0], low, atol=0.02)
            and np.allclose(points_on(where, item)[1], high, atol=0.02)
        ]
        assert len(fits) == (k not in without), f"window {k}"


@pytest.mark.parametrize("second", DIRECTIONS)
@pytest.mark.parametrize("kind", ["mesh", "curve", "stroke"])
def test_sills_are_placed_on_walls_of_every_direction_drawn_in_every_way(second, kind):
    facades = street(("south", second), kind)
    made = examples(facades[0])
    node = place()
    assert node["count"] == 6 + 8 - 3
    sills_stand(facades, [*made, *results()])
    assert {item.data for item in results()} == {made[0].data}
    assert all("ga_key" in item for item in results())


def test_examples_may_lie_on_several_walls():
    facades = street(("askew", "east"))
    (one, corners), (other, far) = facades
    made = [sill("Sill 0", one, corners[0]), sill("Sill 1", other, far[6])]
    activate(*made)
    place()
    sills_stand(facades, [*made, *results()])


def test_a_wall_behind_another_of_the_same_direction_is_a_wall_of_its_own():
    facades = street(("south", "south"))
    third = frame("south", at=(2.0, 20.0, 1.0))
    facades.append((third, wall("back house", third, 3, 2)))
    made = examples(facades[0])
    place()
    sills_stand(facades, [*made, *results()])


def test_the_operation_holds_the_model_and_the_examples_belong_to_the_node():
    facades = street()
    made = examples(facades[0])
    node = place()
    stored = operation()
    assert len(stored.model.lesson.taught) == 3
    assert stored.mesh == made[0].name and stored.label == "sill" and stored.model.label == "facade"
    assert stored.size == pytest.approx((1.2, 0.15), abs=1e-6)
    kept = bridge("tree.store").placed_by(node)
    assert [one.item for one in kept if one.target is not None] == made
    rule = bridge("tree.learned").rule_of(node)
    assert any("below the window" in reason.text or "window" in reason.text for reason in rule)
    assert all(0 < reason.share <= 1 for reason in rule)


def test_the_threshold_sifts_without_computing():
    facades = street(("south", "east"))
    examples(facades[0])
    node = place()
    every = placed()
    evaluated = bridge("tree.evaluating").evaluations.evaluated
    scores = sorted(e.importance for e in bridge("tree.refresh").proposed_by(node) if not e.example)
    node.threshold = 1.0
    assert len(results()) == sum(s >= 1.0 for s in scores)
    node.threshold = 0.1
    assert len(results()) == len(scores)
    node.threshold = 0.5
    assert placed() == every
    assert bridge("tree.evaluating").evaluations.evaluated == evaluated


@pytest.mark.parametrize(
    ("settings", "options"),
    [
        ({"tau": 0.5}, {"tau": 0.5}),
        ({"mirrored": True}, {"mirrored": True}),
        ({"forbid_intersections": True}, {"forbid_intersections": True}),
        ({"overlap": 0.4}, {"allow_overlaps": 0.4}),
        ({"neighbours": 2}, {"neighbours": 2}),
        ({"between": False}, {"between": False}),
        ({"aspect_tolerance": 0.5}, {"aspect_tolerance": 0.5, "area_tolerance": 1.5}),
        ({"area_tolerance": 0.7}, {"area_tolerance": 0.7}),
        ({"any_size": True}, {"aspect_tolerance": np.inf, "area_tolerance": np.inf}),
    ],
    ids=lambda value: next(iter(value)),
)
def test_the_redo_panel_sets_the_engines_options_of_placements(settings, options):
    examples(street()[0])
    place(**settings)
    learned = operation().model.options
    for name, value in options.items():
        assert getattr(learned, name) == (pytest.approx(value) if isinstance(value, float) else value)


def test_what_no_example_intersects_can_be_forbidden():
    facades = street()
    first, corners = facades[0]
    examples(facades[0])
    # A sign hangs where one sill would be.
    x, y = corners[1]
    outline("sign", ring(x - 0.3, y - 0.4, 1.6, 0.3), "sign", first)

    def below_the_sign():
        low, _ = expected(corners[1])
        return [item for item in results() if np.allclose(points_on(first, item)[0], low, atol=0.1)]

    place(threshold=0.05)
    assert below_the_sign()
    place(threshold=0.05, forbid_intersections=True)
    assert results() and not below_the_sign()


def test_a_rejected_result_becomes_a_counter_example_and_stays_away():
    facades = street(("south", "east"))
    made = examples(facades[0])
    node = place()
    gone = results()[0]
    key = gone["ga_key"]
    activate(gone)
    assert bpy.ops.geoanalogy.reject(EXEC, True) == {"FINISHED"}
    taught = operation().model.lesson.taught
    assert [t.target for t in taught] == [1.0, 1.0, 1.0, 0.0]
    assert key not in {item["ga_key"] for item in results()}
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    assert key not in {item["ga_key"] for item in results()}
    assert operation().model.lesson.taught[3].rectangle == taught[3].rectangle
    assert bpy.ops.geoanalogy.forget_decisions(EXEC, True) == {"FINISHED"}
    assert len(operation().model.lesson.taught) == 3
    assert operations_tree().nodes.active == node
    sills_stand(facades, [*made, *results()])


def test_an_accepted_result_that_was_moved_stays_where_it_was_put():
    facades = street(("south", "east"))
    examples(facades[0])
    node = place()
    moved = results()[0]
    key = moved["ga_key"]
    moved.location.z += 0.25
    bpy.context.view_layer.update()
    there = moved.matrix_world.copy()
    activate(moved)
    assert bpy.ops.geoanalogy.accept(EXEC, True) == {"FINISHED"}
    for _ in range(2):
        (found,) = [item for item in results() if item["ga_key"] == key]
        bpy.context.view_layer.update()
        assert np.allclose(np.array(found.matrix_world), np.array(there), atol=1e-4)
        assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    node.threshold = 1.0
    assert key in {item["ga_key"] for item in results()}


def test_placing_is_one_step_of_undo_and_redo_brings_it_back():
    facades = street(("south", "east"))
    examples(facades[0])
    bpy.ops.ed.undo_push(message="scene")
    before = everything()
    place()
    after = everything(), placed()
    bpy.ops.ed.undo()
    assert everything() == before
    bpy.ops.ed.redo()
    assert (everything(), placed()) == after


def test_rejecting_is_one_step_of_undo():
    facades = street(("south", "east"))
    examples(facades[0])
    place()
    activate(results()[1])
    bpy.ops.ed.undo_push(message="selection")
    before = everything(), placed()
    bpy.ops.geoanalogy.reject(EXEC, True)
    assert placed() != before[1]
    bpy.ops.ed.undo()
    assert (everything(), placed()) == before


def test_a_replay_and_a_reopened_file_give_the_identical_scene(tmp_path):
    facades = street(("askew", "east"))
    examples(facades[0])
    place()
    before = everything(), placed()
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    assert (everything(), placed()) == before
    reload(tmp_path / "street.blend")
    assert (everything(), placed()) == before
    bpy.ops.geoanalogy.clear(EXEC, True)
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    assert placed() == before[1]


def test_a_moved_example_is_learned_again():
    facades = street()
    made = examples(facades[0])
    place()
    for item in made:
        item.location.z -= 0.3
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    low, _ = expected(facades[1][1][0])
    heights = sorted(points_on(facades[1][0], item)[0][1] for item in results())
    assert any(h == pytest.approx(low[1] - 0.3, abs=0.02) for h in heights)


def test_a_deleted_example_is_no_example_any_more():
    facades = street()
    made = examples(facades[0], 4)
    place()
    bpy.data.objects.remove(made.pop(1))
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    assert len(operation().model.lesson.taught) == 3
    sills_stand(facades, [*made, *results()], others=4)


def test_another_example_is_learned_from_in_the_same_operation():
    facades = street()
    made = examples(facades[0])
    node = place()
    made.append(sill("Sill 3", *[(p, c[5]) for p, c in facades][1]))
    activate(*made)
    assert place().name == node.name
    assert len(operations_tree().nodes) == 1
    assert len(operation().model.lesson.taught) == 4
    sills_stand(facades, [*made, *results()])


def test_a_wall_that_is_moved_takes_its_sills_along():
    facades = street(("south", "east"))
    made = examples(facades[0])
    place()
    turned = frame("askew", at=(20.0, -3.0, 2.0))
    for item in bpy.context.scene.objects:
        if item.name.startswith("villa"):
            item.matrix_world = turned
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    sills_stand([facades[0], (turned, facades[1][1])], [*made, *results()])


def test_an_appended_tree_places_on_the_walls_of_another_file(tmp_path):
    facades = street(("south", "east"))
    examples(facades[0])
    place()
    name = operations_tree().name
    source = tmp_path / "style.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(source))
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    others = street(("askew", "sloped"))
    with bpy.data.libraries.load(str(source)) as (_, wanted):
        wanted.node_groups = [name]
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    sills_stand(others, results())
    # The examples stayed behind: a result can be rejected, but not learned from.
    gone = activate(results()[3])["ga_key"]
    before = {item["ga_key"] for item in results()}
    assert bpy.ops.geoanalogy.reject(EXEC, True) == {"FINISHED"}
    assert {item["ga_key"] for item in results()} == before - {gone}
    assert len(operation().model.lesson.taught) == 3


def test_sills_are_stretched_to_windows_of_other_widths():
    facades = street()
    placed_, corners = facades[0]
    made = [sill(f"Sill {i}", placed_, corners[i]) for i in range(2)]
    # A wide window, and a wide sill below it: the width goes with the window.
    for item in list(bpy.context.scene.objects):
        if item.name == "house window 2":
            bpy.data.objects.remove(item)
    outline("house window 2", ring(6.6, 0.9, 1.8, 1.4), "window", placed_)
    wide = sill("Sill 2", placed_, (6.6, 0.9))
    wide.matrix_world = wide.matrix_world @ shift(0.4)
    wide.scale.x = 2.0 / 1.2
    made.append(wide)
    bpy.data.objects.remove(bpy.data.objects["villa window 1"])
    outline("villa window 1", ring(3.4, 0.9, 2.2, 1.4), "window", facades[1][0])
    activate(*made)
    place()
    boxes = [points_on(facades[1][0], item) for item in results()]
    below = [b for b in boxes if 3.0 < b[0][0] < 3.6 and b[1][1] < 0.9 and b[0][1] > 0.6]
    assert len(below) == 1
    assert below[0][0][0] == pytest.approx(3.3, abs=0.05) and below[0][1][0] == pytest.approx(5.7, abs=0.05)
    # Its depth is its own.
    assert below[0][1][2] == pytest.approx(0.2, abs=1e-5)


def pots(facades):
    """A pot that stands aside, and boxes for rows of it drawn below four windows of the first wall."""
    pot = sill("Pot", frame("level", at=(-20, -20, 0)), (0, 0), label="pot")
    pot.data = pot.data.copy()
    pot.data.transform(Matrix.Diagonal((0.25, 1.0, 1.0, 1.0)))
    pot.matrix_world = Matrix.Translation((-20, -20, 0))
    bpy.context.scene.geoanalogy.element = pot
    placed_, corners = facades[0]
    drawn = []
    for x, y in (corners[k] for k in (0, 4, 2, 3)):
        ends = [placed_ @ Vector(p) for p in ((x - 0.1, y - 0.2, 0), (x + 1.1, y - 0.05, 0))]
        drawn.append({"name": "", "start": ends[0], "end": ends[1], "target": 1.0})
    assert bpy.ops.geoanalogy.draw_rectangles(EXEC, True, rectangles=drawn, label="pot") == {"FINISHED"}
    return pot


@pytest.mark.parametrize("direction", ["south", "askew"])
def test_drawn_rectangles_are_filled_with_rows_of_an_object_that_stands_aside(direction):
    facades = street((direction, "east"))
    pot = pots(facades)
    place(along="repeat", gap=(0.1, 0.0))
    # 1.2 wide: pots of 0.3 with at least 0.1 between them fit three times, below 14 windows.
    assert len(results()) == 14 * 3
    assert {item.data for item in results()} == {pot.data}
    for wall_, corners in facades:
        for corner in corners:
            boxes = [points_on(wall_, item) for item in results()]
            x0, y0 = corner[0] - 0.1, corner[1] - 0.2
            row = [
                b for b in boxes if abs(b[0][1] - y0) < 0.02 and abs(b[0][2]) < 0.02 and x0 - 0.02 <= b[0][0] < x0 + 1.2
            ]
            assert sorted(b[0][0] - x0 for b in row) == pytest.approx([0.0, 0.45, 0.9], abs=0.02)
            assert all(b[1][0] - b[0][0] == pytest.approx(0.3, abs=1e-4) for b in row)
    before = placed()
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    assert placed() == before


def test_rejecting_one_of_a_row_rejects_the_row():
    facades = street(("south", "east"))
    pots(facades)
    place(along="repeat", gap=(0.1, 0.0))
    one = next(item for item in results() if item.location.x > 12)
    activate(one)
    assert bpy.ops.geoanalogy.reject(EXEC, True) == {"FINISHED"}
    counter = operation().model.lesson.taught[4]
    assert counter.target == 0.0
    assert (counter.rectangle.width, counter.rectangle.height) == pytest.approx((1.2, 0.15), abs=0.02)


def test_an_operation_of_one_example_and_one_of_several_build_on_each_other():
    """A pose on the street's ground between two placements: each passes on what the other has placed."""
    facades = street(("south", "east"))
    ground = outline(
        "lot", [(-30, -30, 0), (40, -30, 0), (40, -2, 0), (-30, -2, 0)], "lot", frame("level", at=(0, 0, 0))
    )
    ground.matrix_world = Matrix.Identity(4)
    made = examples(facades[0])
    first = place()
    activate(box("Tree", (1.0, 1.0, 3.0), "tree", at=(-10.0, -20.0, 0.0)))
    assert bpy.ops.geoanalogy.propagate(EXEC, True, threshold=0.2, most=0) == {"FINISHED"}
    tree = operations_tree().nodes.active
    more = [
        sill(f"Ledge {i}", p, (c[0], c[1] - 0.3), label="ledge")
        for i, (p, c) in enumerate([(facades[0][0], facades[0][1][0]), (facades[0][0], facades[0][1][4])])
    ]
    activate(*more)
    last = place(name="ledges")
    assert [k.from_node.name for k in last.inputs[0].links] == [tree.name]
    assert [k.from_node.name for k in tree.inputs[0].links] == [first.name]
    # The ledges are learned beside the sills, which come through the operation on the ground.
    assert len(results("ledges")) == 12
    before = placed()
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    assert placed() == before
    sills_stand(facades, [*made, *results(first.name)])


def test_muting_passes_on_what_comes_in():
    facades = street()
    examples(facades[0])
    node = place()
    assert bpy.ops.geoanalogy.mute_operation(EXEC, True) == {"FINISHED"}
    bpy.ops.geoanalogy.replay(EXEC, True)
    assert results() == []
    node.mute = False
    bpy.ops.geoanalogy.replay(EXEC, True)
    assert len(results()) == 11


def test_why_here_lists_the_relations_of_a_result():
    facades = street()
    examples(facades[0])
    place()
    activate(results()[0])
    assert bpy.ops.geoanalogy.explain(EXEC, True) == {"FINISHED"}
    reasons = bridge("tree.explanation").explanation_of(bpy.context.scene, results()[0])
    assert any("window" in reason.text for reason in reasons)


def tower_and_shed(at=40.0):
    """Two walls that are like no house: a window far up on one, none on the other."""
    there = frame("south", at=(at, 0.0, 0.0))
    outline("tower", ring(0, 0, 3.0, 30.0), "facade", there)
    outline("tower window", ring(1.0, 20.0, 0.6, 3.0), "window", there)
    shed = frame("east", at=(at + 20.0, 0.0, 0.0))
    outline("shed", ring(0, 0, 4.0, 3.0), "facade", shed)
    return there, shed


def unfamiliar():
    return bridge("tree.learned").unfamiliar_of(placement_node())


def test_faces_that_are_unlike_the_examples_are_listed_also_where_nothing_is_placed():
    facades = street()
    there, shed = tower_and_shed()
    examples(facades[0])
    node = place(threshold=0.9)
    faces = unfamiliar()
    assert {face.name for face in faces} == {"tower", "shed"}
    assert [face.novelty for face in faces] == sorted((face.novelty for face in faces), reverse=True)
    assert all(0.4 <= face.novelty <= 1.0 for face in faces)
    counts = bridge("tree.learned").placed_on(node)
    assert "shed" not in counts and counts["house"] == 6
    of = {face.name: face for face in faces}
    corners = {"tower": (there, (3.0, 30.0)), "shed": (shed, (4.0, 3.0))}
    for name, (placed_, (width, height)) in corners.items():
        points = np.array([placed_.inverted() @ Vector(point) for point in of[name].ring])
        assert np.ptp(points, axis=0) == pytest.approx((width, height, 0.0), abs=1e-5)
        assert points.min(axis=0) == pytest.approx((0.0, 0.0, 0.0), abs=1e-5)
    for item in results()[:3]:
        assert 0 <= bridge("tree.learned").novelty_of(item, node) <= 1
    assert bridge("tree.learned").novelty_of(bpy.data.objects["house"], node) is None


def test_an_example_on_an_unfamiliar_face_takes_it_from_the_list():
    facades = street()
    there, _ = tower_and_shed()
    made = examples(facades[0])
    place()
    more = sill("Sill 9", there, (0.8, 20.0))
    activate(more)
    assert bpy.ops.geoanalogy.select_examples(EXEC, True) == {"FINISHED"}
    assert {item.name for item in bpy.context.selected_objects} == {item.name for item in (*made, more)}
    place()
    assert {face.name for face in unfamiliar()} == {"shed"}
    assert len(operation().model.lesson.taught) == 4


def test_the_list_of_unfamiliar_faces_is_undone_saved_and_made_anew_after_a_replay(tmp_path):
    facades = street()
    tower_and_shed()
    examples(facades[0])
    bpy.ops.ed.undo_push(message="before")
    place()
    listed = unfamiliar()
    bpy.ops.ed.undo()
    assert operations_tree() is None or not operations_tree().nodes
    bpy.ops.ed.redo()
    assert unfamiliar() == listed
    reload(tmp_path / "street.blend")
    assert unfamiliar() == listed
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    assert unfamiliar() == ()
    bpy.data.objects.remove(bpy.data.objects["shed"])
    assert bpy.ops.geoanalogy.list_unfamiliar(EXEC, True) == {"FINISHED"}
    assert [(face.name, face.novelty) for face in unfamiliar()] == [
        (face.name, pytest.approx(face.novelty)) for face in listed if face.name == "tower"
    ]


def test_a_face_of_the_list_is_clicked():
    facades = street()
    tower_and_shed()
    examples(facades[0])
    place()
    names_ = [face.name for face in unfamiliar()]
    assert bpy.ops.geoanalogy.show_face(EXEC, True, index=1) == {"FINISHED"}
    assert bpy.context.scene.geoanalogy.unfamiliar_index == 1
    assert bpy.ops.geoanalogy.show_face(EXEC, True, index=0, select=True) == {"FINISHED"}
    assert [item.name for item in bpy.context.selected_objects] == [names_[0]]
    before = everything()
    with pytest.raises(RuntimeError, match="the list has no such face; list the faces again"):
        bpy.ops.geoanalogy.show_face(EXEC, True, index=7)
    assert everything() == before


def test_unfamiliar_faces_are_outlined_while_they_are_wanted():
    shown = bridge("unfamiliar_faces")
    assert list(shown.shapes()) == []
    facades = street()
    tower_and_shed()
    examples(facades[0])
    place()
    assert [shape.points for shape in shown.shapes()] == [face.ring for face in unfamiliar()]
    assert all(shape.closed and shape.colour == shown.UNFAMILIAR for shape in shown.shapes())
    assert bpy.ops.geoanalogy.show_face(EXEC, True, index=1) == {"FINISHED"}
    assert [shape.colour for shape in shown.shapes()] == [shown.UNFAMILIAR, shown.CLICKED]
    bpy.context.scene.geoanalogy.show_unfamiliar = False
    assert list(shown.shapes()) == []
    bpy.context.scene.geoanalogy.show_unfamiliar = True
    bpy.context.window.scene = bpy.data.scenes.new("Other")
    assert list(shown.shapes()) == []


def test_unfamiliar_faces_are_listed_of_placements_alone():
    rooms()
    bed()
    propagate()
    before = everything()
    with pytest.raises(RuntimeError, match="was not learned from several examples"):
        bpy.ops.geoanalogy.list_unfamiliar(EXEC, True)
    assert everything() == before
    assert bpy.ops.geoanalogy.select_examples(EXEC, True) == {"FINISHED"}
    assert [item.name for item in bpy.context.selected_objects] == ["Bed"]


def bad_nothing():
    activate(bpy.data.objects["house"])
    bpy.data.objects["house"].select_set(False)


def bad_outside():
    activate(sill("Lost", frame("south", at=(0, 0, 50)), (1.0, 0.9)))


def bad_label():
    activate(link(bpy.data.objects.new("Plain", sill("S", frame("south"), (1.0, 0.9)).data)))
    bpy.context.active_object.matrix_world = frame("south") @ shift(2.0)


def bad_targets():
    for item in examples((frame("south"), [(1.0, 0.9), (4.0, 0.9), (7.0, 0.9), (1.0, 3.9), (4.0, 3.9)])):
        item["ga_target"] = 0.0


def bad_preference():
    examples((frame("south"), [(1.0, 0.9), (4.0, 0.9), (7.0, 0.9), (1.0, 3.9), (4.0, 3.9)]))[1]["ga_target"] = 2.0


def bad_twice():
    one, two = (sill(f"Twin {i}", frame("south"), (1.0, 0.9)) for i in range(2))
    two["ga_target"] = 0.5
    activate(one, two)


def bad_askew():
    first = sill("Askew", frame("south"), (1.0, 0.9))
    first.matrix_world = first.matrix_world @ Matrix.Rotation(0.4, 4, "X")
    activate(first)


def bad_nan():
    first = sill("Nowhere", frame("south"), (1.0, 0.9))
    first.location.x = float("nan")
    activate(first)


def bad_flat():
    first = sill("Flat", frame("south"), (1.0, 0.9))
    first.scale.z = 0.0
    activate(first)


def bad_empty():
    activate(link(bpy.data.objects.new("Nothing", None), "sill"))


def bad_result():
    examples((frame("south"), [(1.0, 0.9), (4.0, 0.9), (7.0, 0.9), (1.0, 3.9), (4.0, 3.9)]))
    place()
    activate(results()[0])


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (bad_nothing, "nothing is selected; select the examples, or draw some"),
        (bad_outside, "object 'Lost' lies on no labelled face; put it on one, or label the face"),
        (bad_label, "object 'Plain' has no label; say what it is"),
        (bad_targets, "all examples have the target 0"),
        (bad_preference, "object 'Sill 1' has the preference 2.0; give a number from 0 to 1"),
        (bad_twice, "is given twice, with the targets 1 and 0.5; keep one of them"),
        (bad_askew, "object 'Askew' stands askew on the face and cannot be stretched; turn it parallel"),
        (bad_nan, "object 'Nowhere' has a location that is not finite; clear its transform"),
        (bad_flat, "object 'Flat' has no extent on the face; turn it"),
        (bad_empty, "object 'Nothing' has no extent; choose an object that can be seen"),
        (bad_result, "is a result of 'sill' itself; select the example, or one of your own"),
    ],
    ids=lambda value: getattr(value, "__name__", ""),
)
def test_what_cannot_be_used_is_told_in_one_sentence_and_changes_nothing(make, message):
    street()
    make()
    before = repr(everything())
    with pytest.raises(RuntimeError, match=message):
        bpy.ops.geoanalogy.place(EXEC, True)
    assert repr(everything()) == before


def test_a_placement_that_is_cancelled_halfway_changes_nothing():
    facades = street()
    made = examples(facades[0])
    before = everything()
    steps = bridge("tree.placement_recording").placement_steps(bpy.context, made)
    for _ in range(2):
        next(steps)
    steps.close()
    assert everything() == before


def test_the_redo_panel_sets_the_engines_options():
    facades = street()
    examples(facades[0])
    place(tau=0.4, any_size=True, threshold=0.6, most=3, along="repeat", gap=(0.2, 0.1))
    options = operation().model.options
    assert (options.tau, options.aspect_tolerance, options.area_tolerance) == (0.4, np.inf, np.inf)
    assert (operation().threshold, operation().max_per, operation().fit) == (0.6, {"facade": 3}, ("repeat", "scale"))
    assert operation().gap == pytest.approx((0.2, 0.1))


def test_preferences_are_set_for_the_selection():
    facades = street()
    made = examples(facades[0])
    assert bpy.ops.geoanalogy.set_target(EXEC, True, target=0.25) == {"FINISHED"}
    assert [item["ga_target"] for item in made] == [0.25] * 3
    assert made[0].id_properties_ui("ga_target").as_dict()["max"] == 1.0
    made[0]["ga_target"] = 1.0
    place()
    assert [t.target for t in operation().model.lesson.taught] == [1.0, 0.25, 0.25]


def test_walls_a_hands_breadth_apart_have_planes_of_their_own():
    facades = []
    for i, back in enumerate((0.0, 0.3, 0.1)):
        where = frame("south", at=(10.0 * i, back, 0.0))
        facades.append((where, wall(f"house {i}", where, 3, 2)))
    made = examples(facades[0])
    place()
    # On its own wall, not on that of its neighbour.
    sills_stand(facades, [*made, *results()])
