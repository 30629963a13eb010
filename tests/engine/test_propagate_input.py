"""Bad input to propagation is named, and no scene breaks it (sections 4.2 and 4.8)."""

import numpy as np
import pytest
import shapely
import strategies
from hypothesis import Phase, given, settings
from hypothesis import strategies as st
from pose_scenes import BED, BED_POSE, BEDROOM, L_DESK, scene_of
from shapes import L_ROOM, rectangle
from strategies import Similarity

import geoanalogy as ga
from geoanalogy import Polygon, Pose, PoseOptions, Scene, propagate_pose
from geoanalogy.poses.validation import JUTTING_SHARE
from geoanalogy.tolerances import TOUCHING_SHARE


def test_an_empty_scene_is_named():
    with pytest.raises(ga.InputError, match="the scene is empty; add polygons"):
        propagate_pose(Scene([]), Pose((0, 0)))


@pytest.mark.parametrize("footprint", [None, BED], ids=["point", "footprint"])
def test_an_example_outside_every_polygon_is_named(footprint):
    with pytest.raises(ga.InputError, match="the example at x 50, y -3 lies outside every polygon; put it into one"):
        propagate_pose(scene_of(BEDROOM), Pose((50, -3)), footprint)


@pytest.mark.parametrize("value", [float("nan"), float("inf"), -float("inf")])
def test_a_pose_that_is_not_finite_is_named(value):
    for position, angle in (((value, 0), 0.0), ((0, value), 0.0), ((0, 0), value)):
        with pytest.raises(ga.InputError, match="the pose has a position or angle that is not finite"):
            Pose(position, angle)


@pytest.mark.parametrize(("position", "angle"), [((1,), 0), ((1, 2, 3), 0), ("ab", 0), (5, 0), ((1, 2), None)])
def test_a_pose_that_is_no_pair_of_numbers_is_named(position, angle):
    with pytest.raises(ga.InputError, match="the pose's position is no pair of numbers, or its angle is none"):
        Pose(position, angle)


@pytest.mark.parametrize(
    ("footprint", "message"),
    [
        ([(0, 0), (1, 0)], "the footprint has 2 distinct vertices; a polygon needs at least three"),
        ([(0, 0), (1, 0), (2, 0)], "the footprint has no area"),
        ([(0, 0), (1, 1), (1, 0), (0, 1.5)], "the footprint crosses or touches itself"),
        ([(0, 0), (1, 0), (float("nan"), 1)], "the footprint has a coordinate that is not finite"),
        ([(0, 0, 0), (1, 0, 0), (1, 1, 0)], r"the footprint has an array of shape \(3, 3\)"),
        ("square", "the footprint has coordinates that are not numbers"),
        ([], "the footprint has an array of shape"),
    ],
)
def test_a_bad_footprint_is_named(footprint, message):
    with pytest.raises(ga.InputError, match=message):
        propagate_pose(scene_of(BEDROOM), BED_POSE, footprint)


def test_a_parent_that_is_not_there_is_named():
    scene = Scene([Polygon(rectangle(4, 4), "room", "a"), Polygon(rectangle(1, 1), "bed", "b", parent="attic")])
    with pytest.raises(ga.InputError, match="attic"):
        propagate_pose(scene, Pose((2, 2)))


def test_bad_input_leaves_the_scene_as_it_was():
    scene = scene_of(BEDROOM)
    before = scene.to_dict()
    for pose, footprint in ((Pose((99, 99)), None), (BED_POSE, [(0, 0), (1, 1)])):
        with pytest.raises(ga.InputError):
            propagate_pose(scene, pose, footprint)
    assert scene.to_dict() == before
    propagate_pose(scene, BED_POSE, BED)
    assert scene.to_dict() == before


def test_scenes_without_labels_are_one_kind():
    scene = Scene([Polygon(rectangle(4, 3)), Polygon(rectangle(4, 3, (10, 0)))])
    best = propagate_pose(scene, Pose((1.2, 0.8)), BED)[0]
    assert best.importance == pytest.approx(1, abs=1e-3)


def test_a_scene_without_another_good_place_has_no_results():
    scene = Scene([Polygon(L_ROOM, "room")])
    assert list(propagate_pose(scene, Pose((4.2, 0.6), 0.4), L_DESK * 0.5, PoseOptions(threshold=0.8))) == []


@pytest.mark.parametrize("size", [1e-3, 1e5])
def test_tiny_and_huge_rooms_are_rooms(size):
    where = Similarity(0.3, size, (1e6, -2e5))
    things = [(label, where(outline)) for label, outline in BEDROOM]
    scene = scene_of(things, Similarity(0.0, 1.0, (8 * size, 0)))
    results = propagate_pose(scene, Pose(where(np.array([BED_POSE.position]))[0], BED_POSE.angle + 0.3), BED * size)
    assert results[0].importance == pytest.approx(1, abs=1e-2)


# Whatever is drawn

OPTIONS = st.fixed_dictionaries(
    {},
    optional={
        "accumulation": st.sampled_from(["footprint", "plane", "pose space"]),
        "mirror": st.sampled_from([None, True, False]),
        "symmetries": st.booleans(),
        "scale": st.sampled_from(["fixed", "room"]),
        "labels": st.booleans(),
        "other_parents": st.booleans(),
        "threshold": st.sampled_from([0.0, 0.1, 0.5]),
        "local_importance": st.sampled_from(["distance", "constant"]),
        "matching_accuracy": st.sampled_from(["features", "constant"]),
        "spacing": st.sampled_from([None, 0.5]),
        "relations": st.lists(
            st.sampled_from([*PoseOptions().relations, "centroid direction", "fixed-start arc length"]),
            min_size=1,
            max_size=3,
            unique=True,
        ).map(tuple),
    },
)
LABELS = ["room", "bed", "door", ""]


@st.composite
def rooms(draw, k):
    """A room and up to three members, which may jut out, overlap or be slivers."""
    where = Similarity(draw(strategies.numbers(-3, 3)), draw(strategies.numbers(0.3, 3)), (12.0 * k, 0.0))
    outline = draw(st.one_of(strategies.simple_rings(8), strategies.catalogue_rings()))
    drawn = [Polygon(where(outline), "room", f"room {k}")]
    for i in range(draw(st.integers(0, 3))):
        small = Similarity(draw(strategies.numbers(-3, 3)), 0.3, draw(st.tuples(*[strategies.numbers(-2, 2)] * 2)))
        ring = draw(st.one_of(strategies.simple_rings(6), strategies.slivers()))
        parent = draw(st.sampled_from([None, f"room {k}"]))
        drawn.append(Polygon(where(small(ring)), draw(st.sampled_from(LABELS)), f"thing {k} {i}", parent=parent))
    return drawn


@given(
    rooms(0),
    rooms(1),
    strategies.places(2.0),
    strategies.numbers(-4, 4),
    st.sampled_from([None, BED * 0.2, L_DESK * 0.3, rectangle(0.5, 0.01)]),
    OPTIONS,
)
@settings(max_examples=40, deadline=None, phases=(Phase.explicit, Phase.reuse, Phase.generate))
def test_whatever_is_drawn_gives_valid_results_or_a_clear_error(first, second, place, angle, footprint, options):
    scene = Scene([*first, *second])
    pose = Pose(place, angle)
    given_options = PoseOptions(cells=2_000, **options)
    try:
        model = ga.learn_pose(scene, pose, footprint, given_options)
        results = model.place(scene)
    except ga.InputError as error:
        assert str(error)
        return
    values = [r.importance for r in results]
    assert np.isfinite(values).all()
    assert all(given_options.threshold <= v <= 1 + 1e-6 for v in values)
    assert (np.diff(values) <= 1e-4).all()
    for r in results:
        assert r.parent in scene.polygons
        assert given_options.mirror or not r.mirrored or given_options.mirror is None
        if footprint is None:
            assert shapely.intersects_xy(r.parent.shape, *r.pose.position)
            continue
        example = shapely.Polygon(pose.to_scene(footprint))
        outline = shapely.Polygon(r.pose.to_scene(footprint * r.scale))
        inside = outline.intersection(r.parent.shape).area / outline.area
        assert inside >= example.intersection(model.parent.shape).area / example.area - JUTTING_SHARE - 1e-6
        allowed = {
            m.label
            for m in scene.members_of(model.parent.id)
            if example.intersection(m.shape).area > TOUCHING_SHARE * min(example.area, m.area)
        }
        for m in scene.members_of(r.parent.id):
            shared = outline.intersection(m.shape).area
            assert m.label in allowed or shared <= TOUCHING_SHARE * min(outline.area, m.area) * (1 + 1e-6)
