"""Importance: what the example asks, its weights, and the gradients that poses are refined with (sections 4.4, 4.5)."""

import dataclasses

import numpy as np
import pytest
import strategies
from hypothesis import given, settings
from hypothesis import strategies as st
from pose_scenes import BED, BED_POSE, BEDROOM, L_DESK, furnished, scene_of
from shapes import BAY_ROOM, L_ROOM, UNIT_SQUARE, rectangle
from strategies import Similarity

from geoanalogy import Polygon, Pose, PoseOptions, Scene, learn_pose
from geoanalogy.poses.arrangement import arrangement_of
from geoanalogy.poses.batch import Batch, importance_at
from geoanalogy.poses.candidates import Candidates
from geoanalogy.poses.explanation import explain
from geoanalogy.poses.importance import Importance
from geoanalogy.poses.matching import Sense, Symmetry, matching_accuracy, senses
from geoanalogy.poses.query import CONTEXT, FOOTPRINT_REACH, Query, footprint_samples
from geoanalogy.poses.refinement import refine
from geoanalogy.poses.rivals import Refined, Rivals
from geoanalogy.relations.elements import ElementType
from geoanalogy.relations.observation import Observation
from geoanalogy.relations.table import RELATIONS

PLAIN = Sense(False, (Symmetry.IDENTITY,))
EVERY_RELATION = tuple(name for name, row in RELATIONS.items() if row.directional is not None)


def importance_of(scene, pose, footprint=None, target="room 0", sense=PLAIN, scale=1.0, **options):
    """The importance in a room of an example in "room 0"."""
    source = arrangement_of(scene, scene.polygon("room 0"))
    query = Query(source, pose, footprint, PoseOptions(**options))
    return Importance(query, arrangement_of(scene, scene.polygon(target)), sense, scale)


def at(importance, pose):
    return float(importance_at(importance, np.array([pose.position]), np.array([pose.angle]))[0])


# What the example asks


def test_a_footprint_is_sampled_at_its_centre_sides_and_corners():
    samples = footprint_samples(L_DESK)
    expected = [(0, 0), (-0.8, 0), (0.8, 0), (0, -0.4), (0, 0.4), (-0.8, -0.4), (0.8, -0.4), (0.8, 0.4), (-0.8, 0.4)]
    assert samples == pytest.approx(np.array(expected))
    assert footprint_samples(None).tolist() == [[0.0, 0.0]]


def test_local_importance_inside_is_normalised_with_the_inscribed_circle():
    query = importance_of(Scene([Polygon(UNIT_SQUARE, id="room 0")]), Pose((0.25, 0.4)), threshold=0).query
    boundary = query.questions[ElementType.POLYGON]
    assert boundary.weight[0] == pytest.approx([1 - 0.25 / 0.5])
    walls = query.questions[ElementType.SEGMENT]
    away = dict(zip(walls.feature.tolist(), walls.weight[0].tolist(), strict=True))
    # The wall at y = 0 is 0.4 away, the one at x = 0 0.25; those opposite are beyond the inscribed radius.
    assert sorted(away.values()) == pytest.approx([1 - 0.4 / 0.5, 1 - 0.25 / 0.5])


def test_local_importance_outside_is_normalised_with_twice_the_enclosing_circle():
    polygons = [Polygon(rectangle(6, 6), id="room 0"), Polygon(rectangle(0.6, 0.8, (4, 4)), "bed", parent="room 0")]
    query = importance_of(Scene(polygons), Pose((3.5, 4.4))).query
    question = query.questions[ElementType.POLYGON]
    bed = question.weight[0][question.feature == 1]
    assert bed == pytest.approx([1 - 0.5 / (2 * 0.5)])


def test_samples_of_a_footprint_attend_to_what_is_near_and_the_centre_a_little_to_everything():
    scene = Scene([Polygon(rectangle(4, 4), id="room 0")])
    question = importance_of(scene, Pose((1.0, 2.0)), rectangle(1, 1, (-0.5, -0.5))).query.questions[
        ElementType.POLYGON
    ]
    weight = dict(zip(question.sample.tolist(), question.weight[0].tolist(), strict=True))
    assert weight[1] == pytest.approx(1 - 0.5 / (2 * FOOTPRINT_REACH))
    assert weight[0] == pytest.approx(CONTEXT * (1 - 1 / (4 * np.sqrt(2))))
    assert 2 not in weight  # 1.5 from the wall


def test_constant_local_importance_attends_to_every_feature():
    query = importance_of(scene_of(BEDROOM), BED_POSE, local_importance="constant").query
    assert all((q.weight == 1).all() for q in query.questions.values())
    assert len(query.questions[ElementType.CORNER].feature) == 16


def test_relation_weights_multiply_by_relation_and_by_label():
    plain = importance_of(scene_of(BEDROOM), BED_POSE, BED).query.questions[ElementType.SEGMENT]
    weights = {"wardrobe": 3.0, "segment arc length": 0.5}
    stressed = importance_of(scene_of(BEDROOM), BED_POSE, BED, relation_weights=weights).query
    question = stressed.questions[ElementType.SEGMENT]
    wardrobe = stressed.arrangement.elements.segment_polygon[question.feature] == 3
    assert wardrobe.any()
    for k, relation in enumerate(question.relations):
        factor = 0.5 if relation.name == "segment arc length" else 1.0
        assert question.weight[k][wardrobe] == pytest.approx(3 * factor * plain.weight[k][wardrobe])
        assert question.weight[k][~wardrobe] == pytest.approx(factor * plain.weight[k][~wardrobe])


def test_the_level_sets_are_as_wide_as_the_share_of_the_room_says():
    assert importance_of(scene_of(BEDROOM), BED_POSE, level_set_width=0.1).query.width == pytest.approx(
        0.1 * np.sqrt(20)
    )


# Which features answer


def accuracy(first, second, element):
    """I_m of the features of two rooms without members."""
    scene = Scene([Polygon(first, "room", "room 0"), Polygon(second, "room", "room 1")])
    one, other = (arrangement_of(scene, scene.polygon(f"room {k}")) for k in (0, 1))
    return matching_accuracy(one, other, element, PoseOptions())


FAR_AWAY = np.array([20.0, 0.0])


def test_polygons_are_compared_by_area():
    assert accuracy(rectangle(2, 2), rectangle(4, 4, FAR_AWAY), ElementType.POLYGON).item() == pytest.approx(0.25)


def test_segments_are_compared_by_length_and_curvature():
    bay = BAY_ROOM + FAR_AWAY
    own = accuracy(BAY_ROOM, bay, ElementType.SEGMENT)
    assert np.diag(own) == pytest.approx([1, 1])
    # The straight wall of 3 has no curvature, the one with the half round has.
    assert own[0, 1] == own[1, 0] == 0


def test_corners_of_equal_opening_match_fully():
    corners = accuracy(UNIT_SQUARE, L_ROOM + FAR_AWAY, ElementType.CORNER)
    # The L's reflex corner differs by half a turn.
    assert sorted(corners[0]) == pytest.approx([0.0] + [1.0] * 5)


def test_other_labels_never_match_unless_labels_do_not_count():
    scene = scene_of(BEDROOM, Similarity(shift=(10, 0)))
    one, other = (arrangement_of(scene, scene.polygon(f"room {k}")) for k in (0, 1))
    labelled = matching_accuracy(one, other, ElementType.POLYGON, PoseOptions())
    assert labelled == pytest.approx(np.eye(4))
    free = matching_accuracy(one, other, ElementType.POLYGON, PoseOptions(labels=False))
    assert (free[1:, 1:] > 0).all()
    # Parents answer to parents only: what surrounds a pose is no thing beside it.
    assert (free[0, 1:] == 0).all() and (free[1:, 0] == 0).all()
    constant = matching_accuracy(
        one, other, ElementType.POLYGON, PoseOptions(labels=False, matching_accuracy="constant")
    )
    assert set(constant.ravel()) == {0.0, 1.0}


def test_mirrored_poses_are_tried_where_the_footprint_is_its_own_mirror_image_or_on_request():
    def tried(footprint, mirror):
        return [s.mirrored for s in senses(importance_of(scene_of(BEDROOM), BED_POSE, footprint, mirror=mirror).query)]

    assert tried(BED, None) == [False, True]
    assert tried(L_DESK, None) == [False]
    assert tried(None, None) == [False]
    assert tried(L_DESK, True) == [False, True]
    assert tried(BED, False) == [False]


# What a pose is worth


@pytest.mark.parametrize("accumulation", ["footprint", "plane", "pose space"])
@pytest.mark.parametrize("footprint", [None, L_DESK], ids=["point", "footprint"])
def test_the_example_itself_meets_every_relation(accumulation, footprint):
    importance = importance_of(
        scene_of(BEDROOM), BED_POSE, footprint, accumulation=accumulation, relations=EVERY_RELATION
    )
    assert at(importance, BED_POSE) == pytest.approx(1, abs=1e-12)
    assert importance.bound == pytest.approx(1, abs=1e-12)


@given(
    st.builds(Pose, st.tuples(strategies.numbers(0.3, 4.7), strategies.numbers(0.3, 3.7)), strategies.numbers(-4, 4)),
    st.sampled_from([None, BED, L_DESK]),
)
@settings(max_examples=40)
def test_no_pose_is_worth_more_than_the_bound(pose, footprint):
    scene = Scene([*furnished(BEDROOM, "room 0"), *furnished(BEDROOM[:3], "room 1", Similarity(0.3, 0.8, (9, 2)))])
    importance = importance_of(scene, pose, footprint, "room 1")
    rng = np.random.default_rng(3)
    position = rng.uniform(scene.polygon("room 1").bounds[:2], scene.polygon("room 1").bounds[2:], (60, 2))
    values = importance_at(importance, position, rng.uniform(0, 2 * np.pi, 60))
    assert (values >= 0).all()
    assert values.max() <= importance.bound + 1e-9
    assert importance.bound <= 1 + 1e-9


def test_importance_falls_off_with_distance_and_with_turn():
    importance = importance_of(scene_of(BEDROOM), BED_POSE, BED)
    steps = np.linspace(0, importance.width, 6)
    away = importance_at(
        importance, np.array(BED_POSE.position) + np.outer(steps, (0.6, 0.8)), np.full(6, BED_POSE.angle)
    )
    assert (np.diff(away) < 0).all()
    turned = importance_at(importance, np.tile(BED_POSE.position, (6, 1)), BED_POSE.angle + np.linspace(0, 0.3, 6))
    assert (np.diff(turned) < 0).all()


def test_a_place_on_the_other_side_of_a_boundary_is_no_answer():
    table = Polygon(rectangle(2, 2, (2, 2)), "table", "t", parent="room 0")
    scene = Scene([Polygon(rectangle(6, 6), "room", "room 0"), table])
    importance = importance_of(scene, Pose((3, 1.5)), relations=("boundary distance",), relation_weights={"room": 0})
    beside, within = importance_at(importance, np.array([(3, 1.5), (3, 2.5)]), np.zeros(2))
    assert beside == pytest.approx(1)
    assert within == 0


@pytest.mark.parametrize("footprint", [None, L_DESK], ids=["point", "footprint"])
@pytest.mark.parametrize("scale", [1.0, 1.3])
def test_the_shares_of_the_relations_add_up_to_the_importance(footprint, scale):
    scene = scene_of(BEDROOM, Similarity(0.4, 1.3, (12, 1)))
    importance = importance_of(scene, BED_POSE, footprint, "room 1", scale=scale)
    centre = Similarity(0.4, 1.3, (12, 1))(np.array([BED_POSE.position]))
    rng = np.random.default_rng(0)
    for position in centre + rng.normal(0, 0.1, (5, 2)):
        angle = BED_POSE.angle + 0.4 + rng.normal(0, 0.05)
        shares = explain(importance, position, angle)
        total = sum(s.weight for s in shares)
        assert total == pytest.approx(float(importance_at(importance, position[None], np.array([angle]))[0]), abs=1e-9)
        assert 0 < total < 1 + 1e-9
        assert [s.weight for s in shares] == sorted((s.weight for s in shares), reverse=True)
        assert {s.source.partition(" ")[0] for s in shares} == {"room"}
        assert all(s.source.replace("room 0", "room 1") == s.target for s in shares)
        assert {s.relation for s in shares} <= set(EVERY_RELATION)


# Gradients


def own_entries(importance, element):
    """Which entries pair a feature of the example with itself."""
    a = importance.answers[element]
    size = np.diff(np.append(a.pair_start, len(a.target)))
    return np.repeat(a.source_feature == a.target_feature, size)


def missed(importance, position, angle):
    """The misses of one pose per type of element."""
    rows = Batch([importance]).rows(np.zeros(1, dtype=int))
    return {r.element: r.misses(np.reshape(position, (1, 2)), np.array([angle]), uphill=True) for r in rows}


@pytest.mark.parametrize("name", EVERY_RELATION)
def test_misses_grow_uphill_at_one_unit_per_unit_and_not_across(name):
    """Numerical derivatives on the level set, where the example stands."""
    things = (("room", BAY_ROOM), ("table", rectangle(0.7, 0.5, (1.2, 1.0))))
    scene, element, step, checked = scene_of(things), RELATIONS[name].element, 1e-6, 0
    for place in np.random.default_rng(5).uniform((0.2, 0.2), (3.8, 2.8), (12, 2)):
        importance = importance_of(scene, Pose(place, 0.2), relations=(name,), local_importance="constant")
        own = own_entries(importance, element)
        here = missed(importance, place, 0.2)[element]
        assert here.place[0, own] == pytest.approx(0, abs=1e-9)
        feature = importance.answers[element].target[own]
        seen = Observation(importance.target.elements, place[None])
        sloping = np.broadcast_to(RELATIONS[name].slope(seen), RELATIONS[name].value(seen).shape)[feature, 0] > 0
        for k in np.flatnonzero(sloping):
            up = here.uphill[0, own][k]
            assert abs(up) == pytest.approx(1)
            for way, growth in ((up, 1.0), (1j * up, 0.0)):
                ahead = step * np.array([way.real, way.imag])
                there, back = (missed(importance, place + s * ahead, 0.2)[element].place[0, own][k] for s in (1, -1))
                assert (there - back) / (2 * step) == pytest.approx(growth, abs=1e-3)
                checked += 1
    assert checked >= 24


def test_turns_wrap_around():
    importance = importance_of(scene_of(BEDROOM), Pose(BED_POSE.position, 3.1))
    for element, misses in missed(importance, BED_POSE.position, -3.1).items():
        own = misses.turn[:, own_entries(importance, element)]
        assert own == pytest.approx(np.full(own.shape, 2 * np.pi - 6.2), abs=1e-9)


@pytest.mark.parametrize("footprint", [None, BED, L_DESK], ids=["point", "bed", "L"])
def test_refinement_leads_back_to_the_example(footprint):
    importance = importance_of(scene_of(BEDROOM), BED_POSE, footprint)
    rng = np.random.default_rng(2)
    start = BED_POSE.position + rng.uniform(-1, 1, (8, 2)) * importance.width
    candidates = Candidates(start, BED_POSE.angle + rng.uniform(-0.08, 0.08, 8), np.ones(8))
    refined = refine([importance], [candidates])
    position, angle, value = refined.position, refined.angle, refined.value
    best = int(np.argmax(value))
    assert value[best] == pytest.approx(1, abs=1e-4)
    assert position[best] == pytest.approx(np.array(BED_POSE.position), abs=1e-3 * np.sqrt(20))
    assert angle[best] == pytest.approx(BED_POSE.angle, abs=1e-3)
    assert value == pytest.approx(importance_at(importance, position, angle))


@pytest.mark.parametrize("share", [0.0, 0.3])
def test_of_a_footprint_only_segments_and_what_polygons_are_to_its_centre_ask_for_directions(share):
    importance = importance_of(scene_of(BEDROOM), BED_POSE, BED)
    batch = Batch([importance]).strongest(share)
    for rows in batch.rows(np.zeros(2, dtype=np.intp)):
        sample = np.tile(importance.answers[rows.element].strongest(share).sample, 2)
        expected = {ElementType.SEGMENT: sample >= 0, ElementType.POLYGON: sample == 0}.get(rows.element, sample < 0)
        assert np.array_equal(rows.directed, expected)


@pytest.mark.parametrize(("promise", "left"), [(0.5, [0, 2]), (0.9, [0, 1, 2])])
def test_candidates_that_cannot_stand_are_left_out_unless_they_promise_most(promise, left):
    importance = importance_of(scene_of(BEDROOM), BED_POSE, BED)
    batch = Batch([importance])
    rivals = Rivals([importance], batch, np.ones(1), lambda _, poses, slack: poses.position[:, 0] > slack)
    poses = Refined(np.zeros(3, dtype=np.intp), np.array([(3.0, 1), (1, 1), (4, 1)]), np.zeros(3), np.ones(3))
    poses = dataclasses.replace(poses, value=np.array([0.8, promise, 0.4]))
    assert rivals.standing(poses, 2.0).tolist() == left
    assert Rivals([importance], batch, np.ones(1)).standing(poses, 2.0).tolist() == [0, 1, 2]


def test_of_candidates_of_one_sense_at_one_place_the_best_is_kept():
    """The second is in the other sense, the third too low, the fourth elsewhere, the last one beside it."""
    scene = scene_of(BEDROOM)
    mirrored = Sense(True, (Symmetry.ACROSS,))
    both = [importance_of(scene, BED_POSE, BED), importance_of(scene, BED_POSE, BED, sense=mirrored)]
    rivals = Rivals(both, Batch(both), np.ones(2))
    x = np.array([1, 1 + 0.05 * both[0].width, 2, 3, 3 + 0.05 * both[0].width])
    poses = Refined(np.array([0, 1, 1, 1, 1]), np.column_stack([x, np.ones(5)]), np.zeros(5), np.zeros(5))
    poses = dataclasses.replace(poses, value=np.array([0.9, 0.8, 0.1, 0.7, 0.6]))
    assert rivals.leading(poses, 24, 0.25).tolist() == [0, 1, 3]
    assert rivals.in_turn(poses, 1).tolist() == [[0, 1, -1, -1, -1]]


def test_the_example_does_not_outshine_the_other_places_of_its_room():
    importance = importance_of(scene_of(BEDROOM), BED_POSE, BED)
    batch = Batch([importance])
    poses = Refined(np.zeros(3, dtype=np.intp), np.array([(1.0, 1), (2, 1), (3, 1)]), np.zeros(3), np.ones(3))
    poses = dataclasses.replace(poses, value=np.array([1.0, 0.3, 0.1]))
    assert Rivals([importance], batch, np.ones(1)).leading(poses, 12, 0.4).tolist() == [0]
    rivals = Rivals([importance], batch, np.ones(1), is_example=lambda _, poses: poses.value == 1.0)
    assert rivals.leading(poses, 12, 0.4).tolist() == [1]


def test_an_example_that_nothing_holds_is_worth_nothing():
    scene = Scene(
        [Polygon(rectangle(100, 100), "room", "room 0"), Polygon(rectangle(9, 9, (200, 0)), "room", "room 1")]
    )
    muted = PoseOptions(relations=("corner distance",), relation_weights={"corner distance": 0.0})
    model = learn_pose(scene, Pose((50, 50)), options=muted)
    assert model.query.total == 0
    assert list(model.place(scene)) == []


def test_importances_side_by_side_are_what_they_are_alone():
    """In rooms of other sizes, in both senses and at two scales: nothing of one leaks into another."""
    scene = scene_of(BEDROOM, Similarity(0.4, 1.3, (12, 1)), Similarity(-1.0, 0.8, (0, 12)))
    source = arrangement_of(scene, scene.polygon("room 0"))
    query = Query(source, BED_POSE, L_DESK, PoseOptions(mirror=True))
    rooms = [arrangement_of(scene, scene.polygon(f"room {k}")) for k in (2, 0, 1)]
    several = [Importance(query, room, sense, scale) for room in rooms for sense in senses(query) for scale in (1, 1.2)]
    rng = np.random.default_rng(3)
    which = np.sort(rng.integers(0, len(several), 60))
    low, high = (np.array([r.parent.bounds[side] for r in rooms]) for side in (slice(0, 2), slice(2, 4)))
    room = np.array([rooms.index(several[k].target) for k in which])
    position, angle = rng.uniform(low[room], high[room]), rng.uniform(0, 2 * np.pi, 60)
    together = Batch(several).importance(which, position, angle)
    alone = [importance_at(several[k], p[None], a[None])[0] for k, p, a in zip(which, position, angle, strict=True)]
    assert together == pytest.approx(np.array(alone), abs=1e-12)
    assert np.ptp(together) > 0.1
