"""How drawings are matched, from the sidebar: kept with the scene, undone, saved, and what each does."""

import bpy
import numpy as np
import pytest
from flats import activate, engine, link, reload, results
from pictures import (
    EXEC,
    INNER,
    RING,
    all_leaves,
    bridge,
    curve_drawing,
    draw_query,
    find,
    in_space,
    leaf,
    leaves_found,
    moved,
    operations,
    world_points,
)

#: Every setting of the sidebar, and another value than it has.
OTHERS = {
    "mirrored": False,
    "branches": True,
    "joint_tolerance": 0.6,
    "largest_scale": 3.0,
    "query_points": 70,
    "reach": 0.25,
    "smoothing_radius": 0.2,
    "neighbourhood": 2.5,
    "contrast": 0.4,
    "most": 1,
}


def matching():
    return bpy.context.scene.geoanalogy.matching


def stored(node):
    """The options that a node was recorded with."""
    return bridge("tree.store").engine_node(node).operation.options


def test_every_setting_of_the_engine_that_an_artist_needs_is_in_the_sidebar():
    assert set(OTHERS) == set(bridge("regions.settings").SETTINGS)
    plain = engine("regions.options").RegionOptions()
    for name, value in OTHERS.items():
        assert getattr(matching(), name) == pytest.approx(getattr(plain, name))
        assert value != getattr(plain, name)


@pytest.mark.parametrize("name", OTHERS)
def test_a_setting_of_the_sidebar_holds_for_the_next_query(name):
    curve_drawing(all_leaves())
    draw_query(name="leaf")
    setattr(matching(), name, OTHERS[name])
    assert getattr(stored(find()), name) == pytest.approx(OTHERS[name])


def test_what_the_redo_panel_changes_is_shown_in_the_sidebar():
    curve_drawing(all_leaves())
    draw_query(name="leaf")
    node = find(joint_tolerance=0.5)
    assert stored(node).joint_tolerance == 0.5 and matching().joint_tolerance == 0.5
    assert stored(find()).joint_tolerance == 0.5


def test_settings_are_undone_saved_and_opened_again(tmp_path):
    curve_drawing(all_leaves())
    draw_query(name="leaf")
    bpy.ops.ed.undo_push(message="before")
    for name, value in OTHERS.items():
        setattr(matching(), name, value)
    bpy.context.scene.geoanalogy.smoothing = 0.05
    bpy.ops.ed.undo_push(message="settings")
    bpy.ops.ed.undo()
    assert matching().most != OTHERS["most"] and bpy.context.scene.geoanalogy.smoothing == 0.0
    bpy.ops.ed.redo()
    reload(tmp_path / "settings.blend")
    assert {name: pytest.approx(getattr(matching(), name)) for name in OTHERS} == OTHERS
    assert bpy.context.scene.geoanalogy.smoothing == pytest.approx(0.05)
    node = find()
    for name, value in OTHERS.items():
        assert getattr(stored(node), name) == pytest.approx(value)
    reload(tmp_path / "found.blend")
    for name, value in OTHERS.items():
        assert getattr(stored(operations().nodes.active), name) == pytest.approx(value)


def test_without_mirrored_a_mirror_image_is_no_match():
    flipped = [line * (1.0, -1.0) + (7.0, 0.0) for line in leaf()]
    curve_drawing([*leaf(), *flipped])
    draw_query(name="leaf")
    mirrors = lambda: [t.mirrored for t in bridge("regions.results").targets_found(find())]  # noqa: E731
    assert mirrors()[0]
    matching().mirrored = False
    assert not any(mirrors())


def test_at_most_one_region():
    matching().most = 1
    node = leaves_found()
    node.threshold = 0.0
    assert len(results()) == 1


def arm(turn):
    """Two limbs, of which the outer one turns at the joint by an angle."""
    limb = np.array([(0.0, 0.25), (0.9, 0.2), (1.0, 0.32), (1.2, 0.14), (2.0, 0.12)])
    hand = np.array([(2.0, 0.12), (2.8, 0.2), (3.0, 0.42), (3.2, 0.2), (3.9, 0.3), (4.1, 0.0)])
    swing = lambda p: moved(p - (2.0, 0.0), (2.0, 0.0), 1.0, turn)  # noqa: E731
    return [limb, limb * (1, -0.7), swing(hand), swing(hand * (1, -1)), swing(hand * 0.3 + (2.2, -0.1))]


def test_joints_forgive_a_limb_that_turns():
    curve_drawing([*arm(0.0), *(moved(line, (0.0, 5.0)) for line in arm(1.1))])
    draw_query(np.array([(-0.3, -0.7), (4.4, -0.7), (4.4, 0.7), (-0.3, 0.7)]), name="arm")
    best = lambda: max(t.similarity for t in bridge("regions.results").targets_found(find()))  # noqa: E731
    stiff = best()
    matching().joint_tolerance = 1.0
    assert best() > stiff + 0.02


def test_noisy_lines_are_smoothed_before_they_are_matched():
    rng = np.random.default_rng(3)
    noisy = [line + rng.normal(0.0, 0.03, line.shape) for line in leaf((7.0, 1.0), 1.0, 0.6)]
    item = curve_drawing([*leaf(), *noisy])
    before = world_points(item)
    draw_query(name="leaf")
    best = lambda: max(t.similarity for t in bridge("regions.results").targets_found(find()))  # noqa: E731
    rough = best()
    bpy.context.scene.geoanalogy.smoothing = 0.12
    assert best() > rough
    assert np.array_equal(world_points(item), before)
    # The same again after a replay, which reads the scene.
    calm = bridge("regions.results").targets_found(operations().nodes.active)[0].similarity
    bpy.ops.geoanalogy.replay(EXEC, True)
    assert bridge("regions.results").targets_found(operations().nodes.active)[0].similarity == calm


def test_a_stroke_finds_the_same_thin_shape_and_carries_over(tmp_path):
    stalk = np.array([(0, 0), (0.4, 1.0), (-0.1, 1.9), (0.5, 2.6), (1.3, 2.9), (1.1, 2.2)], float)
    places = [((5.0, 0.5), 1.2, 0.4), ((9.0, 3.0), 0.8, -0.9)]
    curve_drawing([stalk, *(moved(stalk, *p) for p in places)])
    assert draw_query(stalk, mode="STROKE", name="stalk") == {"FINISHED"}
    node = find()
    assert node["count"] == 2 and stored(node).query_kind == "stroke"
    middles = np.array([world_points(item).mean(axis=0) for item in results()])
    for place in places:
        goal = in_space(moved(stalk, *place)).mean(axis=0)
        assert np.linalg.norm(middles - goal, axis=1).min() < 0.3
    node.threshold = 1.0
    reload(tmp_path / "stalk.blend")
    node = operations().nodes.active
    assert results() == []
    node.threshold = 0.0
    assert len(results()) >= 2


def test_points_without_evidence_say_so():
    # A third of the second leaf is not drawn: what lies there is extrapolated.
    rim, vein, twig = leaf((6.0, 0.0))
    ring, right = rim[:-1], rim[:-1, 0] > 5.8
    start = int(np.argmin(right))
    curve_drawing([*leaf(), np.roll(ring, -start, axis=0)[np.roll(right, -start)], vein[vein[:, 0] > 5.8], twig])
    draw_query(name="leaf")
    node = find(automatic=False, threshold=0.0)
    best = bridge("regions.results").targets_found(node)[0]
    assert best.coverage < 0.85
    dots = np.vstack([INNER, RING * 0.55])
    mesh = bpy.data.meshes.new("Dots")
    mesh.from_pydata(in_space(dots).tolist(), [], [])
    activate(link(bpy.data.objects.new("Dots", mesh)))
    assert bpy.ops.geoanalogy.carry_over(EXEC, True) == {"FINISHED"}
    (item,) = (i for i in results() if i["ga_key"] == best.key)
    values = np.array([v.value for v in item.data.attributes["ga_confidence"].data])
    assert values[dots[:, 0] > 0.4].mean() > values[dots[:, 0] < -0.4].mean() + 0.2
    assert item["ga_confidence"] == pytest.approx(values.mean(), abs=1e-3)
    assert item["ga_coverage"] == pytest.approx(best.coverage)
