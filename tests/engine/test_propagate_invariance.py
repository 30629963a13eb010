"""Results follow the scene: moved, turned, scaled, mirrored, reordered, subdivided, on any grid."""

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st
from pose_scenes import BED, BED_POSE, BEDROOM, L_DESK, best_in, furnished, gap, moved
from shapes import BAY_ROOM, rectangle, ring
from strategies import Similarity, similarities

from geoanalogy import Polygon, Pose, PoseOptions, Scene, propagate_pose

#: The example's bedroom, one without a wardrobe but with a chest, and one without a window and with a bevel.
OTHERWISE = (*BEDROOM[:3], ("chest", rectangle(0.5, 1.0, (4.5, 2.0))))
BEVELLED = (("bedroom", ring((0, 0), (4, 0), (5, 1), (5, 4), (0, 4))), BEDROOM[3])
ROOMS = [
    *furnished(BEDROOM, "a"),
    *furnished(OTHERWISE, "b", Similarity(0.5, 1.0, (10, 2))),
    *furnished(BEVELLED, "c", Similarity(-0.8, 1.0, (-2, 10))),
]
#: 0.1 % of the room's size.
CLOSE = 1e-3 * np.sqrt(20)
#: That is a thirtieth of the level sets' half-width: what it may change the importance by.
SLACK = 0.035


def seen(polygons, pose=BED_POSE, footprint=BED, **options):
    """The best result of every room."""
    options = {"mirror": False, "cells": 10_000, "threshold": 0.05} | options
    results = propagate_pose(Scene(polygons), pose, footprint, PoseOptions(**options))
    return {room: best_in(results, room) for room in ("b", "c")}


def assert_follow(before, after, where=Similarity(), close=CLOSE):  # noqa: B008  (frozen)
    for room, result in before.items():
        away, turn = gap(after[room].pose, moved(result.pose, where))
        assert away <= close * where.scale, room
        assert turn <= 1e-2, room
        assert after[room].importance == pytest.approx(result.importance, abs=SLACK)
        assert after[room].pose.mirrored == moved(result.pose, where).mirrored
        assert after[room].scale == pytest.approx(result.scale)


def placed(polygon, where):
    return Polygon(where(polygon.points), polygon.label, polygon.id, [where(h) for h in polygon.holes], polygon.parent)


BEFORE = {"bed": seen(ROOMS), "L": seen(ROOMS, footprint=L_DESK)}
FOOTPRINTS = {"bed": BED, "L": L_DESK}


def few(count):
    """So many examples, not shrunk: each takes a while."""
    return settings(max_examples=count, deadline=None, phases=(Phase.explicit, Phase.reuse, Phase.generate))


names = st.sampled_from(["bed", "L"])


@given(similarities(scales=(0.05, 20.0)), names)
@few(12)
def test_results_follow_a_scene_that_is_moved_turned_and_scaled(where, name):
    after = seen([placed(p, where) for p in ROOMS], moved(BED_POSE, where), FOOTPRINTS[name] * where.scale)
    assert_follow(BEFORE[name], after, where)


#: Things at a wall: one with a notch, a thin one, and one without parallel sides.
AT_A_WALL = {
    "U": ring((-0.8, -0.5), (0.8, -0.5), (0.8, 0.5), (0.5, 0.5), (0.5, -0.2), (-0.5, -0.2), (-0.5, 0.5), (-0.8, 0.5)),
    "shelf": rectangle(1.6, 0.24, (-0.8, -0.12)),
    "wedge": ring((-0.8, -0.5), (0.8, -0.5), (-0.8, 0.5)),
}


@pytest.mark.parametrize("name", AT_A_WALL)
def test_in_no_direction_of_the_scene_the_best_place_is_lost(name):
    """Candidates lie up to three half-widths from the best place, in the wall or before it, as the grid happens to."""
    rng, outline = np.random.default_rng(5), AT_A_WALL[name]
    before = seen(ROOMS, footprint=outline)
    for _ in range(60):
        where = Similarity(float(rng.uniform(-np.pi, np.pi)), float(np.exp(rng.uniform(-2, 2))))
        after = seen([placed(p, where) for p in ROOMS], moved(BED_POSE, where), outline * where.scale)
        assert_follow(before, after, where)


@pytest.mark.parametrize("slip", [-2e-3, -1e-12, 1e-12, 2e-3])
def test_a_hand_that_slips_into_the_wall_or_off_it_changes_little(slip):
    # The bed's head touches the wall above.
    (x, y), before = BED_POSE.position, BEFORE["bed"]
    after = seen(ROOMS, Pose((x, y + slip), BED_POSE.angle))
    for room, result in before.items():
        away, turn = gap(after[room].pose, result.pose)
        assert away <= abs(slip) + 1e-3 and turn <= 1e-2
        assert after[room].importance == pytest.approx(result.importance, abs=0.01)


@given(similarities(scales=(0.5, 2.0), mirrored=True), names)
@few(10)
def test_a_mirrored_scene_has_mirrored_results(where, name):
    # The example itself is mirrored then: its footprint is drawn in the mirrored frame.
    pose, footprint = moved(BED_POSE, where), FOOTPRINTS[name] * where.scale
    if where.mirrored:
        pose, footprint = Pose(pose.position, pose.angle), footprint * (1, -1)
    after = seen([placed(p, where) for p in ROOMS], pose, footprint)
    for room, result in BEFORE[name].items():
        away, turn = gap(after[room].pose, moved(result.pose, where))
        assert away <= CLOSE * where.scale
        assert turn <= 1e-2
        assert after[room].importance == pytest.approx(result.importance, abs=SLACK)


@given(st.permutations(range(len(ROOMS))), st.randoms(use_true_random=False), names)
@few(10)
def test_the_order_of_polygons_and_the_first_vertex_do_not_matter(order, random, name):
    polygons = []
    for i in order:
        p = ROOMS[i]
        points = np.roll(p.points, random.randrange(len(p.points)), axis=0)
        polygons.append(Polygon(points[:: random.choice((1, -1))], p.label, p.id, parent=p.parent))
    assert_follow(BEFORE[name], seen(polygons, footprint=FOOTPRINTS[name]))


@given(st.lists(st.floats(0.1, 0.9), min_size=1, max_size=3, unique=True), names)
@few(8)
def test_subdivided_edges_change_nothing(shares, name):
    def subdivided(ring):
        stops = np.sort(np.concatenate([[0.0], shares]))
        return (ring[:, None] + stops[:, None] * (np.roll(ring, -1, axis=0) - ring)[:, None]).reshape(-1, 2)

    polygons = [Polygon(subdivided(p.points), p.label, p.id, parent=p.parent) for p in ROOMS]
    assert_follow(BEFORE[name], seen(polygons, footprint=FOOTPRINTS[name]))


@given(st.integers(1_500, 150_000), names)
@few(8)
def test_a_refined_grid_moves_nothing(cells, name):
    assert_follow(BEFORE[name], seen(ROOMS, footprint=FOOTPRINTS[name], cells=cells))


@pytest.mark.parametrize("accumulation", ["footprint", "plane", "pose space"])
@given(st.tuples(st.floats(-0.5, 0.5), st.floats(-0.5, 0.5)))
@few(5)
def test_a_shifted_grid_moves_nothing(accumulation, shift):
    """The grid hangs on the parent's box: a bay that widens the box shifts it against the rest of the room."""
    from geoanalogy.poses import arrangement

    drawn = arrangement.Grid.__init__

    def shifted(self, polygon, spacing, margin):
        drawn(self, polygon, spacing, margin + spacing)
        self.origin = self.origin + np.array(shift) * spacing

    before = seen(ROOMS, accumulation=accumulation)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(arrangement.Grid, "__init__", shifted)
        after = seen(ROOMS, accumulation=accumulation)
    assert_follow(before, after)


@given(st.floats(0, 2 * np.pi), st.sampled_from(["footprint", "plane"]))
@few(8)
def test_curved_rooms_turn_with_their_results(angle, accumulation):
    room = (("bedroom", BAY_ROOM), ("door", rectangle(0.9, 0.9, (0.4, 0.0))))
    where, pose = Similarity(angle, 1.0, (9.0, 4.0)), Pose((3.4, 2.0), 1.2)
    scene = Scene([*furnished(room, "a"), *furnished(room, "b", where)])
    stool = np.array([(-0.2, -0.2), (0.2, -0.2), (0.2, 0.1), (0.0, 0.2), (-0.2, 0.2)])
    options = PoseOptions(accumulation=accumulation, cells=10_000)
    best = best_in(propagate_pose(scene, pose, stool, options), "b")
    assert gap(best.pose, moved(pose, where)) == pytest.approx((0, 0), abs=1e-2)
