"""What every option of pose propagation does (sections 4.5 to 4.8)."""

import dataclasses
import json

import numpy as np
import pytest
import shapely
from pose_scenes import BED, BED_POSE, BEDROOM, L_DESK, best_in, furnished, gap, moved, scene_of
from shapes import rectangle, ring
from strategies import Similarity

import geoanalogy as ga
from geoanalogy import Polygon, Pose, PoseOptions, Scene, learn_pose, propagate_pose
from geoanalogy.poses.answering import SCALED_FACTOR
from geoanalogy.poses.arrangement import arrangement_of
from geoanalogy.poses.model import PoseModel
from geoanalogy.poses.scatter import ScatterModel, ScatterOptions
from geoanalogy.poses.validation import Validation

NEXT_DOOR = Similarity(0.6, 1.0, (9.0, 1.0))
ACCUMULATIONS = ("footprint", "plane", "pose space")


def propagate(scene, pose=BED_POSE, footprint=BED, **options):
    return propagate_pose(scene, pose, footprint, PoseOptions(**options))


# Relations


def test_only_the_chosen_relations_carry_results():
    results = propagate(scene_of(BEDROOM, NEXT_DOOR), relations=("segment distance", "corner distance"))
    best = best_in(results, "room 1")
    assert {s.relation for s in best.relations} == {"segment distance", "corner distance"}
    assert best.importance == pytest.approx(1, abs=1e-3)


@pytest.mark.parametrize("accumulation", ACCUMULATIONS)
def test_the_centroid_direction_can_count(accumulation):
    relations = ("boundary distance", "centroid direction")
    scene = scene_of(BEDROOM, NEXT_DOOR)
    best = best_in(propagate(scene, relations=relations, accumulation=accumulation), "room 1")
    away, turn = gap(best.pose, moved(BED_POSE, NEXT_DOOR))
    assert {s.relation for s in best.relations} == set(relations)
    assert best.importance == pytest.approx(1, abs=2e-3)
    assert (away, turn) == pytest.approx((0, 0), abs=5e-3)


def test_relation_weights_decide_what_the_object_follows():
    """A lamp between a desk and a sofa that stand farther apart next door goes where it is told to."""
    things = lambda shift: (  # noqa: E731
        ("room", rectangle(8, 4)),
        ("desk", rectangle(1.2, 0.6, (2, 2))),
        ("sofa", rectangle(0.8, 1.6, (3.6 + shift, 1.5))),
    )
    scene = Scene([*furnished(things(0), "a"), *furnished(things(2.0), "b", Similarity(shift=(20, 0)))])
    lamp = Pose((3.4, 2.3))
    beside = {}
    for label in ("desk", "sofa"):
        weights = {"room": 0, "desk": 0.1, "sofa": 0.1} | {label: 1.0}
        beside[label] = best_in(propagate(scene, lamp, None, relation_weights=weights), "b").pose.position[0]
    assert beside == pytest.approx({"desk": 20 + 3.4, "sofa": 20 + 3.4 + 2.0}, abs=0.05)


# Accumulation


@pytest.mark.parametrize("accumulation", ACCUMULATIONS)
@pytest.mark.parametrize("footprint", [BED, L_DESK, None], ids=["bed", "L", "point"])
def test_every_accumulation_finds_the_copy(accumulation, footprint):
    scene = scene_of(BEDROOM, NEXT_DOOR)
    best = best_in(propagate(scene, footprint=footprint, accumulation=accumulation), "room 1")
    away, turn = gap(best.pose, moved(BED_POSE, NEXT_DOOR))
    assert best.importance == pytest.approx(1, abs=2e-3)
    assert (away, turn) == pytest.approx((0, 0), abs=5e-3)


def test_pose_space_keeps_two_directions_at_one_place():
    """Figure 4.17: at one place the walls ask for one direction and the table for another."""
    room, pose = ("room", rectangle(8, 8)), Pose((4.0, 6.6))
    options = {"relations": ("segment distance", "segment arc length")}
    table = rectangle(1.6, 1.0, (3.5, 4.5))

    def turned(angle):
        return Similarity(angle)(table - pose.position) + pose.position

    things = [room, ("table", table)]
    elsewhere = [room, ("table", turned(1.0))]
    scene = Scene([*furnished(things, "a"), *furnished(elsewhere, "b", Similarity(shift=(20, 0)))])
    found = {}
    for accumulation in ("plane", "pose space"):
        results = [
            r.pose for r in propagate(scene, pose, None, accumulation=accumulation, **options) if r.parent.id == "b"
        ]
        found[accumulation] = [p.angle for p in results if gap(p, Pose((24.0, 6.6)))[0] < 0.02]
    assert len(found["plane"]) == 1
    assert sorted(np.round(np.mod(found["pose space"], 2 * np.pi), 2)) == [0.0, 1.0]


@pytest.mark.parametrize("accumulation", ACCUMULATIONS)
def test_results_do_not_move_with_the_number_of_cells(accumulation):
    scene = scene_of(BEDROOM, Similarity(0.6, 1.12, (9.0, 1.0)))
    poses = [
        best_in(propagate(scene, accumulation=accumulation, cells=cells), "room 1").pose
        for cells in (1_000, 8_000, 100_000)
    ]
    for pose in poses[1:]:
        away, turn = gap(pose, poses[0])
        assert away < 1e-3 * np.sqrt(20)
        assert turn < 1e-2


def test_direction_bins_only_find_directions():
    scene = scene_of(BEDROOM, NEXT_DOOR)
    coarse, fine = (
        best_in(propagate(scene, accumulation="pose space", direction_bins=bins), "room 1").pose for bins in (16, 180)
    )
    assert gap(coarse, fine) == pytest.approx((0, 0), abs=1e-2)


def test_wider_kernels_forgive_more():
    askew = [*BEDROOM[:3], ("wardrobe", Similarity(0.15, shift=(3.0, 3.0))(rectangle(1.8, 0.6)))]
    scene = Scene([*furnished(BEDROOM, "a"), *furnished(askew, "b", Similarity(0.2, 1.05, (9, 0)))])
    for option, narrow, wide in (("level_set_width", 0.01, 0.08), ("direction_width", 0.1, 0.5)):
        values = [best_in(propagate(scene, threshold=0.01, **{option: v}), "b").importance for v in (narrow, wide)]
        assert values[0] < values[1]


# Mirrored poses and symmetries


def test_a_mirrored_room_holds_mirrored_objects_only_on_request():
    mirror = Similarity(0.0, 1.0, (9.0, 6.0), mirrored=True)
    scene = scene_of(BEDROOM, mirror)
    pose = Pose((1.0, 3.5), 0.0)
    wanted = moved(pose, mirror)
    found = best_in(propagate(scene, pose, L_DESK, mirror=True), "room 1")
    assert found.mirrored and found.pose.mirrored
    assert found.importance == pytest.approx(1, abs=1e-3)
    assert gap(found.pose, wanted) == pytest.approx((0, 0), abs=5e-3)
    assert found.pose.to_scene(L_DESK) == pytest.approx(wanted.to_scene(L_DESK), abs=2e-2)
    for mirror in (None, False):
        results = propagate(scene, pose, L_DESK, mirror=mirror)
        assert not any(r.mirrored for r in results)
        assert best_in(results, "room 1").importance < 0.98


def test_an_object_that_is_its_own_mirror_image_may_always_be_mirrored():
    mirror = Similarity(0.0, 1.0, (9.0, 6.0), mirrored=True)
    scene = scene_of(BEDROOM, mirror)
    found = best_in(propagate(scene), "room 1")
    assert found.mirrored
    assert found.pose.to_scene(BED) == pytest.approx(mirror(BED_POSE.to_scene(BED)), abs=2e-2)
    assert best_in(propagate(scene, mirror=False), "room 1").importance < 0.98


def test_the_other_side_of_an_edge_needs_the_option():
    """A place beside a pool; seen through the symmetries of its edge, places in the water too."""
    edges = ["ladder", "side", "side", "side"]
    pool = Polygon(rectangle(4, 4, (4, 3)), "pool", parent="yard", segment_labels=edges)
    scene = Scene([Polygon(rectangle(12, 10), "yard", "yard"), pool])
    pose = Pose((5.4, 2.2), np.pi / 2)
    options = {
        "relations": ("segment distance", "segment arc length"),
        "relation_weights": {"yard": 0, "side": 0},
        "validate": False,
    }

    def found(wanted, mirrored, **more):
        results = propagate(scene, pose, None, **options, **more)
        return [r for r in results if r.mirrored == mirrored and gap(r.pose, wanted) == pytest.approx((0, 0), abs=1e-2)]

    half_turn, behind = Pose((6.6, 3.8), -np.pi / 2), Pose((5.4, 3.8), -np.pi / 2)
    assert found(half_turn, False, symmetries=True)
    assert found(behind, True, symmetries=True, mirror=True)
    assert not found(half_turn, False)
    assert not found(behind, True, mirror=True)


# Scale


def test_lengths_in_proportion_to_the_room():
    doubled = Similarity(0.6, 2.0, (12.0, 1.0))
    scene = scene_of(BEDROOM, doubled)
    best = best_in(propagate(scene, scale="room"), "room 1")
    assert best.scale == pytest.approx(2)
    assert gap(best.pose, moved(BED_POSE, doubled)) == pytest.approx((0, 0), abs=1e-2)
    fixed = propagate(scene, scale="fixed")
    assert {r.scale for r in fixed} == {1.0}
    assert best_in(fixed, "room 1").importance < best.importance


def test_of_two_equal_answers_the_one_at_its_own_size_is_better():
    big = Similarity(0.0, 1.5, (12.0, 0.0))
    scene = Scene([*furnished(BEDROOM[:1], "a"), *furnished(BEDROOM[:1], "b", big)])
    # In a corner of a larger room its own size is met as well as the larger one.
    pose = Pose((1.0, 0.8), 0.0)
    best = best_in(propagate(scene, pose, relations=("corner distance", "corner ratio")), "b")
    assert best.scale == 1.0
    assert SCALED_FACTOR < best.importance <= 1 + 1e-9


# Labels and parents


def test_labels_restrict_rooms_and_things():
    kitchen = [("kitchen", BEDROOM[0][1]), *BEDROOM[1:]]
    scene = Scene([*furnished(BEDROOM, "a"), *furnished(kitchen, "b", NEXT_DOOR)])
    assert {r.parent.id for r in propagate(scene)} <= {"a"}
    free = best_in(propagate(scene, labels=False), "b")
    assert gap(free.pose, moved(BED_POSE, NEXT_DOOR)) == pytest.approx((0, 0), abs=1e-2)
    assert free.importance == pytest.approx(1, abs=1e-3)


def test_other_parents_may_answer_where_their_things_do():
    kitchen = [("kitchen", BEDROOM[0][1]), *BEDROOM[1:]]
    scene = Scene([*furnished(BEDROOM, "a"), *furnished(kitchen, "b", NEXT_DOOR)])
    pose, wanted = Pose((4.1, 3.1), -np.pi / 2), moved(Pose((4.1, 3.1), -np.pi / 2), NEXT_DOOR)
    best = best_in(propagate(scene, pose, None, other_parents=True), "b")
    assert gap(best.pose, wanted) == pytest.approx((0, 0), abs=2e-2)
    assert 0.1 < best.importance < 1
    assert {s.target for s in best.relations} == {"b wardrobe"}


def test_the_label_of_a_wall_decides_between_equal_walls():
    room = rectangle(4, 4)
    labels = ["", "window wall", "", ""]
    far = rectangle(4, 4, (10, 0))
    scene = Scene(
        [
            Polygon(room, "room", "a", segment_labels=labels),
            Polygon(far, "room", "b", segment_labels=[*labels[2:], *labels[:2]]),
        ]
    )
    best = best_in(propagate(scene, Pose((3.4, 2.0), np.pi), rectangle(0.6, 2, (-0.3, -1))), "b")
    assert gap(best.pose, Pose((10.6, 2.0), 0.0)) == pytest.approx((0, 0), abs=1e-2)


# Validation


def overlap(result, footprint, obstacle):
    outline = shapely.Polygon(result.pose.to_scene(footprint * result.scale))
    return outline.intersection(obstacle.shape).area / outline.area


def test_results_intersect_nothing_that_the_example_does_not():
    sofa = ("sofa", rectangle(1.6, 1.2, (0.6, 2.4)))
    scene = Scene([*furnished(BEDROOM, "a"), *furnished([*BEDROOM, sofa], "b", Similarity(shift=(9, 0)))])
    blocked, free = (best_in(propagate(scene, threshold=0.05, validate=v), "b") for v in (True, False))
    assert overlap(free, BED, scene.polygon("b sofa")) > 0.2
    assert overlap(blocked, BED, scene.polygon("b sofa")) < 0.02
    assert blocked.importance < free.importance


@pytest.mark.parametrize(("away", "expected"), [(0.0, False), (0.3, False), (0.5, True), (0.9, True)])
def test_a_pose_is_hopeless_that_hits_something_deeper_than_it_may_move(away, expected):
    """A bed 1.6 wide that reaches `away` into a wardrobe, or through a wall, and may move by 0.4."""
    scene = Scene([Polygon(rectangle(8, 6), "room", "r"), Polygon(rectangle(2, 2, (5, 0)), "wardrobe", parent="r")])
    model = learn_pose(scene, Pose((1.5, 3)), BED, PoseOptions())
    target = arrangement_of(scene, scene.polygon("r"))
    validation = Validation(target, model.pose, BED, model.options)
    at_wardrobe, at_wall = (4 + away, 1.0), (3.0, 0.8 - away)
    places = np.array([at_wardrobe, at_wall])
    poses = (np.zeros(2, dtype=np.intp), places, np.zeros(2), np.zeros(2, dtype=bool), np.ones(2), 0.4)
    assert validation.hopeless([target], *poses).tolist() == [expected, expected]
    free = Validation(target, model.pose, BED, dataclasses.replace(model.options, validate=False))
    assert not free.hopeless([target], *poses).any()


@pytest.mark.parametrize(("away", "expected"), [(0.0, False), (0.3, False), (0.5, True)])
def test_a_thin_object_may_move_out_of_a_wall_by_more_than_its_depth(away, expected):
    """A shelf 0.2 deep that is `away` deep in a wall, or in a wardrobe, and may move by 0.4."""
    shelf = rectangle(1, 0.2, (-0.5, -0.1))
    scene = Scene([Polygon(rectangle(8, 6), "room", "r"), Polygon(rectangle(2, 2, (5, 0)), "wardrobe", parent="r")])
    model = learn_pose(scene, Pose((1.5, 3)), shelf, PoseOptions())
    target = arrangement_of(scene, scene.polygon("r"))
    validation = Validation(target, model.pose, shelf, model.options)
    places = np.array([(3.0, 0.1 - away), (6.0, 2.1 - away)])
    poses = (np.zeros(2, dtype=np.intp), places, np.zeros(2), np.zeros(2, dtype=bool), np.ones(2), 0.4)
    assert validation.hopeless([target], *poses).tolist() == [expected, expected]


@pytest.mark.parametrize("slack", [0.05, 0.2, 0.6])
def test_what_stands_in_a_notch_is_not_hit(slack):
    """A U with a column between its arms, which are 0.3 wide; moved by 0.35 an arm is on the column."""
    desk = ring((-0.8, -0.5), (0.8, -0.5), (0.8, 0.5), (0.5, 0.5), (0.5, -0.2), (-0.5, -0.2), (-0.5, 0.5), (-0.8, 0.5))
    scene = Scene(
        [Polygon(rectangle(8, 6), "room", "r"), Polygon(rectangle(0.6, 0.6, (3.7, 2.9)), "column", parent="r")]
    )
    model = learn_pose(scene, Pose((1.5, 3)), desk, PoseOptions())
    target = arrangement_of(scene, scene.polygon("r"))
    validation = Validation(target, model.pose, desk, model.options)
    places = np.array([(4.0, 3.0), (4.35, 3.0)])
    poses = (np.zeros(2, dtype=np.intp), places, np.zeros(2), np.zeros(2, dtype=bool), np.ones(2), slack)
    assert validation.hopeless([target], *poses).tolist() == [False, slack < 0.1]


def test_poses_in_several_rooms_are_hopeless_or_not_each_in_its_own():
    """A bed 1.6 wide and 2 long, mirrored, twice as large, and in a room where its place is taken."""
    rooms = [Polygon(rectangle(8, 6, (x, 0)), "room", f"r{x}") for x in (0, 10)]
    scene = Scene([*rooms, Polygon(rectangle(2, 2, (15, 0)), "wardrobe", parent="r10")])
    model = learn_pose(scene, Pose((1.5, 3)), BED, PoseOptions())
    targets = [arrangement_of(scene, room) for room in rooms]
    validation = Validation(targets[0], model.pose, BED, model.options)
    which, x = np.array([0, 0, 0, 1, 1]), np.array([6.0, 6, 6, 16, 12])
    mirrored, scale = np.array([False, True, False, False, True]), np.array([1.0, 1, 2, 1, 1])
    poses = (which, np.column_stack([x, np.full(5, 1.0)]), np.zeros(5), mirrored, scale, 0.1)
    assert validation.hopeless(targets, *poses).tolist() == [False, False, True, True, False]


def test_results_stay_inside_as_far_as_the_example_does():
    narrow = [("bedroom", rectangle(5, 1.2)), ("door", rectangle(0.9, 0.9, (3.7, 0.0)))]
    scene = Scene([*furnished(BEDROOM, "a"), *furnished(narrow, "b", Similarity(shift=(9, 0)))])
    assert not [r for r in propagate(scene, threshold=0.01, scale="fixed") if r.parent.id == "b"]
    assert [r for r in propagate(scene, threshold=0.01, scale="fixed", validate=False) if r.parent.id == "b"]


def test_an_example_that_straddles_its_parent_may_do_so_elsewhere():
    scene = scene_of(BEDROOM, NEXT_DOOR)
    # A sill: half of it in the wall.
    sill, pose = rectangle(0.4, 1.5, (-0.2, -0.75)), Pose((2.0, 0.0), np.pi / 2)
    best = best_in(propagate(scene, pose, sill), "room 1")
    assert gap(best.pose, moved(pose, NEXT_DOOR)) == pytest.approx((0, 0), abs=1e-2)
    assert overlap(best, sill, scene.polygon("room 1")) == pytest.approx(0.5, abs=0.03)


def test_a_door_keeps_its_swing_free():
    """Without its swing the door lets the chest stand behind it."""
    room = ("room", rectangle(5, 4))
    leaf = [room, ("door", rectangle(0.9, 0.1, (0.5, 0.0)))]
    chest, pose = rectangle(0.8, 0.4, (-0.4, -0.2)), Pose((1.0, 0.55), np.pi / 2)
    scene = Scene([*furnished(leaf[:1], "a"), *furnished(leaf, "b", Similarity(shift=(9, 0)))])
    swing = {"b door": [(9.5, 0), (10.4, 0), (10.4, 0.9), (9.5, 0.9)]}
    inside = lambda results: [  # noqa: E731
        r for r in results if r.parent.id == "b" and gap(r.pose, Pose((10.0, 0.55)))[0] < 0.1
    ]
    options = dict(threshold=0.05, relations=("segment distance", "segment arc length", "corner distance"))
    assert inside(propagate(scene, pose, chest, **options))
    kept = propagate(scene, pose, chest, alternative_geometry=swing, **options)
    assert not inside(kept)
    area = shapely.Polygon(swing["b door"])
    for r in kept:
        assert shapely.Polygon(r.pose.to_scene(chest)).intersection(area).area < 0.02 * 0.32


def test_alternative_geometry_counts_at_the_example_too():
    """Who stands in the swing of a door at home may do so elsewhere."""
    chest, pose = rectangle(0.6, 0.4, (-0.3, -0.2)), Pose((4.0, 0.5), 0.0)
    leaf = [BEDROOM[0], ("door", rectangle(0.9, 0.1, (3.7, 0.0)))]
    scene = scene_of(leaf, Similarity(shift=(9, 0)))
    swing = {f"room {k} door": rectangle(0.9, 0.9, (3.7 + 9 * k, 0)).tolist() for k in (0, 1)}
    best = best_in(propagate(scene, pose, chest, alternative_geometry=swing), "room 1")
    assert gap(best.pose, Pose((13.0, 0.5))) == pytest.approx((0, 0), abs=1e-2)


def test_clearance_widens_obstacles():
    sofa = ("sofa", rectangle(0.5, 1.0, (2.6, 1.9)))
    scene = Scene([*furnished(BEDROOM, "a"), *furnished([*BEDROOM, sofa], "b", Similarity(shift=(9, 0)))])

    def distances(**options):
        results = [r for r in propagate(scene, threshold=0.01, scale="fixed", **options) if r.parent.id == "b"]
        return [shapely.Polygon(r.pose.to_scene(BED)).distance(scene.polygon("b sofa").shape) for r in results]

    assert min(distances()) == pytest.approx(0.2, abs=0.01)
    assert min(distances(clearance={"sofa": 0.15})) == pytest.approx(0.2, abs=0.01)
    assert min(distances(clearance={"sofa": 0.4}), default=1.0) > 0.35
    assert min(distances(clearance={"chair": 0.4})) == pytest.approx(0.2, abs=0.01)


# How many


CHAIR = rectangle(0.4, 0.4, (-0.2, -0.2))
ROUND_ROOM = ("room", rectangle(6, 6))


def test_max_per_candidates_and_threshold_limit_the_results():
    scene = scene_of([ROUND_ROOM], Similarity(0.3, 1.0, (12, 0)))
    every = propagate(scene, Pose((1, 1), 0.4), CHAIR)
    per_room = {room: sum(r.parent.id == room for r in every) for room in ("room 0", "room 1")}
    assert min(per_room.values()) >= 2
    assert len(propagate(scene, Pose((1, 1), 0.4), CHAIR, max_per={"room": 1})) == 2
    assert len(propagate(scene, Pose((1, 1), 0.4), CHAIR, max_per={"hall": 1})) == len(every)
    assert len(propagate(scene, Pose((1, 1), 0.4), CHAIR, candidates=1)) == 2
    high = propagate(scene, Pose((1, 1), 0.4), CHAIR, threshold=0.9)
    assert 0 < len(high) <= len(every)
    assert all(r.importance >= 0.9 for r in high)
    assert all(r.importance >= PoseOptions().threshold for r in every)


def test_spacing_is_the_least_distance_of_results():
    scene = scene_of([ROUND_ROOM, ("table", rectangle(2, 1, (2, 2.5)))])
    for spacing in (0.3, 1.55):
        results = propagate(scene, Pose((3, 2.2), 1.57), CHAIR, spacing=spacing, mirror=True, threshold=0.05)
        assert len(results)
        for i, r in enumerate(results):
            assert all(gap(r.pose, other.pose)[0] >= spacing for other in results[:i])
            assert gap(r.pose, Pose((3, 2.2)))[0] >= spacing


# Constant weights (figure 4.13)


def test_constant_importance_and_accuracy_make_every_relation_count_alike():
    scene = scene_of(BEDROOM, NEXT_DOOR)
    for options in ({"local_importance": "constant"}, {"matching_accuracy": "constant"}):
        best = best_in(propagate(scene, accumulation="plane", **options), "room 1")
        assert gap(best.pose, moved(BED_POSE, NEXT_DOOR)) == pytest.approx((0, 0), abs=1e-2)
    best = best_in(propagate(scene, accumulation="plane", local_importance="constant"), "room 1")
    assert [s.weight for s in best.relations] == pytest.approx(
        [best.relations[0].weight] * len(best.relations), rel=0.02
    )


# Storing


OTHER_THAN_DEFAULT = dict(
    relations=("corner distance", "corner ratio"),
    threshold=0.33,
    accumulation="plane",
    cells=4_000,
    direction_bins=60,
    level_set_width=0.04,
    direction_width=0.3,
    mirror=True,
    upright=True,
    symmetries=True,
    scale="fixed",
    labels=False,
    other_parents=True,
    local_importance="constant",
    matching_accuracy="constant",
    relation_weights={"wardrobe": 2.0},
    validate=False,
    alternative_geometry={"room 0 door": [[3.7, 0.0], [4.6, 0.0], [4.6, 0.9]]},
    clearance={"door": 0.2},
    max_per={"bedroom": 2},
    spacing=0.5,
    candidates=5,
)


def test_every_option_is_stored():
    assert set(OTHER_THAN_DEFAULT) == {f.name for f in dataclasses.fields(PoseOptions)}
    options = PoseOptions(**OTHER_THAN_DEFAULT)
    plain = json.loads(json.dumps(options.to_dict()))
    assert set(plain) == set(OTHER_THAN_DEFAULT)
    assert PoseOptions.from_dict(plain) == options
    assert PoseOptions().to_dict() == {}
    assert PoseOptions.from_dict({}) == PoseOptions()


@pytest.mark.parametrize("footprint", [None, L_DESK], ids=["point", "footprint"])
def test_a_stored_model_places_the_same(footprint):
    hole = Polygon(rectangle(8, 8), "hall", "hall", holes=[rectangle(2, 2, (3, 3))])
    scene = scene_of(BEDROOM, NEXT_DOOR).with_polygons([hole])
    model = learn_pose(scene, BED_POSE, footprint, PoseOptions(threshold=0.2, max_per={"bedroom": 2}))
    plain = json.loads(json.dumps(model.to_dict()))
    again = PoseModel.from_dict(plain)
    assert again.to_dict() == plain
    expected, found = model.place(scene), again.place(scene)
    assert len(found) == len(expected) > 0
    for p, q in zip(expected, found, strict=True):
        assert (p.pose, p.importance, p.parent.id, p.relations) == (q.pose, q.importance, q.parent.id, q.relations)


def test_a_stored_model_knows_its_surroundings_without_their_scene():
    scene = scene_of(BEDROOM, NEXT_DOOR)
    model = PoseModel.from_dict(learn_pose(scene, BED_POSE, BED).to_dict())
    elsewhere = Scene(furnished(BEDROOM, "far", NEXT_DOOR))
    best = best_in(model.place(elsewhere), "far")
    assert gap(best.pose, moved(BED_POSE, NEXT_DOOR)) == pytest.approx((0, 0), abs=1e-2)
    assert best.importance == pytest.approx(1, abs=1e-3)


# Bad options


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"relations": ("boundary distance", "colour")}, "no relation of poses is called colour; choose from boundary"),
        ({"relations": ("box centre x",)}, "no relation of poses is called box centre x"),
        ({"relations": ()}, "no relation of poses is called nothing"),
        ({"cells": 0}, "the option cells is 0; give a whole number from 1 on"),
        ({"direction_bins": 3}, "the option direction_bins is 3; give a whole number from 4 on"),
        ({"candidates": 0}, "the option candidates is 0; give a whole number from 1 on"),
        ({"level_set_width": 0.0}, r"the option level_set_width is 0\.0; give a positive number"),
        ({"level_set_width": float("nan")}, "the option level_set_width is nan; give a positive number"),
        ({"direction_width": -1.0}, r"the option direction_width is -1\.0; give a positive number"),
        ({"accumulation": "volume"}, "the option accumulation is 'volume'; choose from footprint, plane, pose space"),
        ({"scale": "metres"}, "the option scale is 'metres'; choose from fixed, room"),
        ({"local_importance": "none"}, "the option local_importance is 'none'; choose from distance, constant"),
        ({"matching_accuracy": 1}, "the option matching_accuracy is 1; choose from features, constant"),
        ({"relations": "corner distance"}, "the option relations is 'corner distance'; give a list of names"),
        ({"relations": (3,)}, "no relation of poses is called 3; choose from boundary"),
        ({"threshold": 1.1}, "the option threshold is 1.1; give a number from 0 to 1"),
        ({"threshold": float("nan")}, "the option threshold is nan; give a number from 0 to 1"),
        ({"cells": 2.5}, "the option cells is 2.5; give a whole number"),
        ({"candidates": "many"}, "the option candidates is 'many'; give a whole number"),
        ({"level_set_width": 1e300}, "the option level_set_width is 1e.300; give a positive number up to 10"),
        ({"mirror": "no"}, "the option mirror is 'no'; give True or False"),
        ({"labels": None}, "the option labels is None; give True or False"),
        ({"spacing": -1}, "the option spacing is -1; give a finite number from 0 on"),
        ({"clearance": {"door": -0.5}}, "the option clearance of 'door' is -0.5; give a finite number"),
        ({"clearance": 0.5}, "the option clearance is 0.5, which is no Mapping; give a width per label"),
        ({"relation_weights": {"bed": float("inf")}}, "the option relation_weights of 'bed' is inf; give a finite"),
        ({"max_per": {"room": 1.5}}, "the option max_per of 'room' is 1.5; give a whole number from 0 on"),
        ({"alternative_geometry": {"door": [(0, 0), (1, 1)]}}, "of 'door' is .*; give the three or more vertices"),
        ({"alternative_geometry": {"door": [(0, 0), (1, 1), (0, float("nan"))]}}, "'door' have a coordinate that is"),
    ],
)
def test_bad_options_are_named(options, message):
    with pytest.raises(ga.InputError, match=message):
        PoseOptions(**options)


def test_options_take_the_numbers_of_numpy_and_are_stored_as_plain_data():
    options = PoseOptions(
        relations=["corner distance"],
        cells=2e4,
        candidates=np.int64(3),
        threshold=np.float32(0.25),
        mirror=np.bool_(True),
        max_per={"room": np.int32(2)},
        alternative_geometry={"door": np.array([(0, 0), (1, 0), (1, 1)])},
    )
    assert PoseOptions.from_dict(json.loads(json.dumps(options.to_dict()))) == options
    assert (options.cells, options.threshold, options.mirror) == (20_000, 0.25, True)


def test_an_option_of_a_newer_version_is_named():
    with pytest.raises(ga.InputError, match=r"curvature, warp is no option of pose propagation.*newer version"):
        PoseOptions.from_dict({"warp": 1, "threshold": 0.2, "curvature": True})


def stored():
    return learn_pose(scene_of(BEDROOM), BED_POSE, BED).to_dict()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"source": None}, "the stored pose model lacks or garbles"),
        ({"position": None}, "the stored pose model lacks or garbles .*iterable"),
        ({"position": [1.0]}, "the pose's position is no pair of numbers"),
        ({"position": [1.0, float("nan")]}, "not finite"),
        ({"angle": "north"}, "the pose's position is no pair of numbers, or its angle is none"),
        ({"parent": "attic"}, "the scene has no polygon 'attic'"),
        ({"footprint": [[0, 0], [1, 1]]}, "the footprint has 2 distinct vertices"),
        ({"options": {"warp": 1}}, "warp is no option"),
        ({"options": None}, "options of pose propagation is None, which is no Mapping; give names and values"),
    ],
)
def test_a_garbled_model_is_named(change, message):
    with pytest.raises(ga.InputError, match=message):
        PoseModel.from_dict(stored() | change)


@pytest.mark.parametrize("missing", ["source", "parent", "position", "angle", "mirrored", "footprint", "options"])
def test_a_model_that_lacks_something_is_named(missing):
    plain = stored()
    del plain[missing]
    with pytest.raises(ga.InputError, match=f"the stored pose model lacks or garbles '{missing}'"):
        PoseModel.from_dict(plain)


def test_a_polygon_of_a_model_from_a_newer_version_is_named():
    plain = stored()
    plain["source"]["polygons"][0]["height"] = 3
    with pytest.raises(ga.InputError, match=r"the stored pose model lacks or garbles .*height"):
        PoseModel.from_dict(plain)


def test_rings_of_alternative_geometry_may_be_rough():
    crossing = {"room 0 door": ring((3.7, 0), (4.6, 0.9), (4.6, 0), (3.7, 0.9)).tolist()}
    assert propagate(scene_of(BEDROOM), alternative_geometry=crossing) is not None


@pytest.mark.parametrize("accumulation", ACCUMULATIONS)
@pytest.mark.parametrize("mirror", [False, True])
def test_what_hangs_on_a_wall_stays_upright_where_that_is_asked_for(accumulation, mirror):
    """Of a wall's four corners, two would have the lamp upside down; a tall wall would have it on its side."""
    sizes = {"a": (0.0, 6.0, 3.0), "b": (10.0, 6.0, 3.0), "tall": (20.0, 3.0, 6.0)}
    rings = {id: [(x, 0), (x + w, 0), (x + w, h), (x, h)] for id, (x, w, h) in sizes.items()}
    scene = ga.Scene([ga.Polygon(ring, label="wall", id=id) for id, ring in rings.items()])
    lamp = [(-0.3, -0.2), (0.3, -0.2), (0.3, 0.1), (-0.3, 0.2)]
    options = {"scale": "fixed", "threshold": 0.9, "accumulation": accumulation, "mirror": mirror}

    def places(**more):
        found = ga.propagate_pose(scene, ga.Pose((1.0, 2.5), 0.0), lamp, ga.PoseOptions(**options, **more))
        return {(p.parent.id, *np.round(p.pose.position, 2)) for p in found if p.mirrored == mirror}, found

    free, _ = places()
    assert ("tall", 22.5, 1.0) in free if mirror else ("b", 15.0, 0.5) in free
    upright, found = places(upright=True)
    assert upright == ({("a", 5.0, 2.5), ("b", 15.0, 2.5)} if mirror else {("b", 11.0, 2.5)})
    for p in found:
        ups = p.pose.to_scene([(0.0, 1.0), (0.0, 0.0)])
        assert ups[0, 1] - ups[1, 1] == pytest.approx(1.0, abs=1e-3)


def test_scattered_things_hang_upright_too():
    ring = [(0, 0), (6, 0), (6, 3), (0, 3)]
    scene = ga.Scene([ga.Polygon(np.add(ring, (x, 0)), label="wall", id=f"w{x}") for x in (0, 10)])
    pose, lamp = ga.Pose((1.0, 2.5), 0.0), [(-0.1, -0.1), (0.1, -0.1), (0.1, 0.1), (-0.1, 0.1)]

    def ups(upright):
        model = learn_pose(scene, pose, lamp, ga.PoseOptions(scale="fixed", upright=upright))
        found = ScatterModel(model, ScatterOptions(count=15)).place(scene, seed=1)
        return [np.diff(p.pose.to_scene([(0.0, 0.0), (0.0, 1.0)]), axis=0)[0, 1] for p in found]

    assert min(ups(False)) < 0.0
    assert len(ups(True)) == 30 and min(ups(True)) > 0.7
