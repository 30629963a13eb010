"""A copy of the example's surroundings holds a copy of the example, whatever its shape (sections 4.3 to 4.5)."""

import numpy as np
import pytest
from pose_scenes import BED, BED_POSE, BEDROOM, L_DESK, best_in, furnished, gap, moved, scene_of
from shapes import (
    BAY_ROOM,
    BEVELLED_ROOM,
    CIRCLE,
    HOLED_ROOM,
    L_ROOM,
    NICHE_ROOM,
    STAR,
    TEARDROP,
    rectangle,
)
from strategies import Similarity

import geoanalogy as ga
from geoanalogy import Polygon, Pose, PoseOptions, PropagatedPose, Scene, propagate_pose
from geoanalogy.poses.model import TOGETHER
from geoanalogy.poses.results import PoseResults

#: Shapes that are no image of themselves, and a place inside.
SHAPES = {
    "L room": (L_ROOM, (1.2, 2.9)),
    "bevelled room": (BEVELLED_ROOM, (3.1, 2.2)),
    "bay room": (BAY_ROOM, (3.6, 1.9)),
    "teardrop": (TEARDROP, (0.3, 0.4)),
    "niche room": (NICHE_ROOM, (1.2, 2.5)),
    "circle": (CIRCLE, (0.9, 0.8)),
}
#: Shapes that are images of themselves: several places are equally good.
REGULAR = {"star": (STAR, (0.1, 0.4)), "square": (rectangle(2, 2), (0.6, 0.7))}
ELSEWHERE = Similarity(0.7, 1.0, (15.0, 2.0))
STOOL = np.array([(-0.12, -0.1), (0.12, -0.1), (0.12, 0.0), (0.0, 0.0), (0.0, 0.1), (-0.12, 0.1)])


@pytest.mark.parametrize("accumulation", ["footprint", "plane", "pose space"])
@pytest.mark.parametrize("name", SHAPES)
def test_the_copy_of_a_shape_holds_the_copy_of_the_pose(name, accumulation):
    outline, place = SHAPES[name]
    pose = Pose(place, 0.3)
    options = PoseOptions(accumulation=accumulation, cells=5_000)
    best = best_in(propagate_pose(scene_of([("room", outline)], ELSEWHERE), pose, STOOL, options), "room 1")
    assert best.importance == pytest.approx(1, abs=2e-3)
    away, turn = gap(best.pose, moved(pose, ELSEWHERE))
    assert away < 1e-3 * np.sqrt(Polygon(outline).area)
    assert turn < 5e-3


@pytest.mark.parametrize("name", REGULAR)
def test_a_shape_with_symmetries_has_several_copies(name):
    outline, place = REGULAR[name]
    pose = Pose(place, 0.3)
    results = propagate_pose(scene_of([("room", outline)], ELSEWHERE), pose, STOOL, PoseOptions(cells=5_000))
    perfect = [r for r in results if r.importance > 0.99]
    assert any(gap(r.pose, moved(pose, ELSEWHERE)) == pytest.approx((0, 0), abs=5e-3) for r in perfect)
    assert {r.parent.id for r in perfect} == {"room 0", "room 1"}
    assert len([r for r in perfect if r.parent.id == "room 1"]) > 1


@pytest.mark.parametrize("place", [(0.4, 1.8), (3.2, 1.0), (2.2, 2.6)])
def test_holes_stand_in_relations_too(place):
    """The courtyard is off the middle: only the copy of its surroundings has everything."""
    courtyard = rectangle(2, 1, (0.7, 1.1))
    there = Similarity(-1.1, 1.0, (12.0, 5.0))
    rooms = [
        Polygon(where(HOLED_ROOM), "room", f"room {k}", holes=[where(courtyard)])
        for k, where in enumerate((Similarity(), there))
    ]
    pose = Pose(place, 0.2)
    best = best_in(propagate_pose(Scene(rooms), pose, STOOL), "room 1")
    assert best.importance == pytest.approx(1, abs=2e-3)
    assert gap(best.pose, moved(pose, there)) == pytest.approx((0, 0), abs=5e-3)


def test_results_keep_out_of_holes():
    with_hole = Polygon(rectangle(4, 4, (10, 0)), "room", "b", holes=[rectangle(2, 2, (11, 1))])
    scene = Scene([Polygon(rectangle(4, 4), "room", "a"), with_hole])
    for r in propagate_pose(scene, Pose((2.0, 2.0)), STOOL, PoseOptions(threshold=0.01)):
        assert with_hole.shape.contains_properly(r.parent.shape.centroid) or r.parent.id in ("a", "b")
        if r.parent.id == "b":
            assert max(abs(r.pose.position[0] - 12), abs(r.pose.position[1] - 2)) > 1 - 0.15


def test_every_room_gets_its_copy_best_first():
    places = [Similarity(k * 0.9, 1.0, (12.0 * (k + 1), 3.0 * k)) for k in range(4)]
    results = propagate_pose(scene_of(BEDROOM, *places), BED_POSE, BED)
    first = results[:4]
    assert {r.parent.id for r in first} == {"room 1", "room 2", "room 3", "room 4"}
    for r in first:
        where = places[int(r.parent.id[-1]) - 1]
        assert gap(r.pose, moved(BED_POSE, where)) == pytest.approx((0, 0), abs=1e-2)
    values = [round(r.importance, 4) for r in results]
    assert values == sorted(values, reverse=True)


# The example


@pytest.mark.parametrize("accumulation", ["footprint", "plane", "pose space"])
def test_the_example_is_no_result_while_another_place_in_its_room_may_be(accumulation):
    scene = scene_of([("room", rectangle(4, 4))])
    pose = Pose((0.8, 0.6), 0.0)
    results = propagate_pose(scene, pose, STOOL, PoseOptions(accumulation=accumulation))
    assert all(gap(r.pose, pose)[0] > 0.1 for r in results)
    corner = Pose((3.2, 3.4), np.pi)
    assert any(gap(r.pose, corner) == pytest.approx((0, 0), abs=1e-2) and r.importance > 0.99 for r in results)


def test_the_examples_place_in_another_room_of_the_same_form_is_a_result():
    scene = scene_of(BEDROOM, Similarity(shift=(10, 0)))
    assert best_in(propagate_pose(scene, BED_POSE, BED), "room 1").importance == pytest.approx(1, abs=1e-3)


def test_the_parent_is_the_smallest_polygon_that_holds_the_footprint():
    polygons = [*furnished(BEDROOM, "room 0"), Polygon(rectangle(3, 3, (0.5, 0.9)), "rug", "rug")]
    rug = [Polygon(rectangle(3, 3, (10, 0)), "rug", "other rug")]
    scene = Scene([*polygons, *rug])
    # Its centre is on the rug, but a part of it is not.
    assert ga.learn_pose(scene, Pose((1.2, 2.0)), BED).parent.id == "room 0"
    assert ga.learn_pose(scene, Pose((1.2, 2.0)), None).parent.id == "rug"
    assert ga.learn_pose(scene, Pose((2.0, 2.0)), BED).parent.id == "rug"


# Results


def result(x, importance, parent, label="room", angle=0.0, scale=1.0):
    return PropagatedPose(Pose((x, 0.0), angle), importance, Polygon(rectangle(9, 9), label, parent), scale)


LISTED = PoseResults(
    [
        result(0.0, 0.9, "a"),
        result(0.5, 0.8, "a"),
        result(0.2, 0.7, "b", "hall"),
        result(2.0, 0.6, "a"),
        result(4.0, 0.3, "b", "hall"),
    ],
    rectangle(0.8, 0.4, (-0.4, -0.2)),
)


def kept(results):
    return [r.importance for r in results]


def test_results_are_a_sequence():
    assert len(LISTED) == 5
    assert LISTED[0].importance == 0.9
    assert kept(LISTED[1:3]) == [0.8, 0.7]
    assert isinstance(LISTED[1:3], PoseResults)
    assert repr(LISTED) == "PoseResults(5 poses)"
    assert not LISTED[0].mirrored


def test_above_keeps_those_of_at_least_an_importance():
    assert kept(LISTED.above(0.6)) == [0.9, 0.8, 0.7, 0.6]
    assert kept(LISTED.above(2.0)) == []


def test_max_per_counts_in_every_parent_of_the_label():
    assert kept(LISTED.max_per("room", 2)) == [0.9, 0.8, 0.7, 0.3]
    assert kept(LISTED.max_per("hall", 1)) == [0.9, 0.8, 0.7, 0.6]
    assert kept(LISTED.max_per("hall", 1).max_per("room", 1)) == [0.9, 0.7]
    assert kept(LISTED.max_per("room", 0)) == [0.7, 0.3]


def test_apart_keeps_better_ones_in_every_parent():
    assert kept(LISTED.apart(0.5)) == [0.9, 0.8, 0.7, 0.6, 0.3]
    assert kept(LISTED.apart(1.0)) == [0.9, 0.7, 0.6, 0.3]
    assert kept(LISTED.apart(4.5)) == [0.9, 0.7]


def test_disjoint_keeps_what_can_be_placed_together():
    assert kept(LISTED.disjoint()) == [0.9, 0.7, 0.6, 0.3]
    # Sharing an edge is touching; a larger object needs more room.
    side_by_side = [result(0.0, 0.9, "a"), result(0.8, 0.8, "a")]
    assert kept(PoseResults(side_by_side, LISTED._footprint).disjoint()) == [0.9, 0.8]
    larger = [side_by_side[0], result(0.8, 0.8, "a", scale=1.5)]
    assert kept(PoseResults(larger, LISTED._footprint).disjoint()) == [0.9]
    assert kept(PoseResults(LISTED[:], None).disjoint()) == kept(LISTED)


def test_thinning_results_computes_nothing_again(monkeypatch):
    results = propagate_pose(scene_of(BEDROOM, ELSEWHERE), BED_POSE, BED)
    from geoanalogy.poses.rows import Rows

    def never(*_arguments, **_options):
        raise AssertionError("computed again")

    monkeypatch.setattr(Rows, "misses", never)
    thinned = results.above(0.2).max_per("bedroom", 1).apart(0.5).disjoint()
    assert 0 < len(thinned) <= len(results)
    assert set(map(id, thinned)) <= set(map(id, results))


# Progress


def test_progress_grows_and_names_what_is_done():
    told = []
    scene = scene_of(BEDROOM, *(Similarity(shift=(10 * k, 0)) for k in range(1, 6)))
    propagate_pose(scene, BED_POSE, BED, progress=lambda fraction, text: told.append((fraction, text)) or True)
    fractions = [f for f, _ in told]
    assert len(told) >= 6
    assert fractions == sorted(fractions)
    assert fractions[0] == 0
    assert fractions[-1] < 1
    assert all("bedroom" in text for _, text in told)


@pytest.mark.parametrize("after", [1, 3])
def test_returning_false_cancels(after):
    told = []

    def progress(fraction, text):
        told.append(fraction)
        return len(told) < after

    scene = scene_of(BEDROOM, *(Similarity(shift=(10 * k, 0)) for k in range(1, 6)))
    with pytest.raises(ga.Cancelled):
        propagate_pose(scene, BED_POSE, BED, progress=progress)
    assert len(told) == after


def test_the_same_scene_gives_the_same_results_with_and_without_memory():
    scene = scene_of(BEDROOM, ELSEWHERE, Similarity(0.2, 0.9, (0, 12)))
    first = propagate_pose(scene, BED_POSE, L_DESK)
    again = propagate_pose(scene, BED_POSE, L_DESK)
    fresh = propagate_pose(scene_of(BEDROOM, ELSEWHERE, Similarity(0.2, 0.9, (0, 12))), BED_POSE, L_DESK)
    for other in (again, fresh):
        assert [(r.pose, r.importance, r.parent.id) for r in other] == [
            (r.pose, r.importance, r.parent.id) for r in first
        ]


def test_memory_forgets_what_is_least_used_and_results_stay():
    scene = scene_of(BEDROOM, ELSEWHERE)
    first = propagate_pose(scene, BED_POSE, BED)
    scene.memory.limit = 1
    again = propagate_pose(scene, BED_POSE, BED)
    assert len(scene.memory) == 1
    assert [r.pose for r in again] == [r.pose for r in first]


def test_relations_of_a_result_name_its_own_room():
    results = propagate_pose(scene_of(BEDROOM, ELSEWHERE), BED_POSE, BED)
    best = best_in(results, "room 1")
    assert sum(s.weight for s in best.relations) == pytest.approx(best.importance, abs=1e-6)
    assert {s.target for s in best.relations} <= {"room 1", *(f"room 1 {m}" for m, _ in BEDROOM[1:])}
    assert best.relations[0].weight >= best.relations[-1].weight > 0


def test_many_rooms_are_not_remembered_at_once():
    scene = scene_of(BEDROOM, *(Similarity(shift=(10 * (k % 8), 10 * (k // 8))) for k in range(1, 64)))
    scene.memory.limit = 2 << 20
    held, largest = [], []

    def progress(_fraction, _text):
        sizes = [a.nbytes for a in scene.memory._kept.values()]
        held.append(sum(sizes))
        largest.append(max(sizes, default=0))
        return True

    results = propagate_pose(scene, BED_POSE, BED, PoseOptions(cells=200_000, candidates=1), progress)
    assert {r.parent.id for r in results} >= {f"room {k}" for k in range(1, 64)}
    assert max(held) <= scene.memory.limit + TOGETHER * max(largest)
    assert max(held) < 64 * max(largest) / 2


@pytest.mark.parametrize("turn", np.linspace(0.3, 6.0, 5))
def test_what_stands_in_line_with_other_edges_is_copied_exactly(turn):
    """A night table against the wall that the bed's edge lies on: the line's two sides are the same there."""
    things = (
        ("bedroom", rectangle(5, 4)),
        ("bed", rectangle(2, 1.6, (0.0, 1.5))),
        ("door", rectangle(0.9, 0.9, (4, 0))),
    )
    where = Similarity(turn, 1.0, (12.0, 3.0))
    table = rectangle(0.5, 0.4, (-0.25, -0.2))
    pose = Pose((0.25, 1.1), 0.0)
    best = best_in(propagate_pose(scene_of(things, where), pose, table), "room 1")
    assert gap(best.pose, moved(pose, where)) == pytest.approx((0, 0), abs=1e-3)
    assert best.importance == pytest.approx(1, abs=1e-3)
