"""What stands before doors and windows: fronts of openings, and what places in them are worth."""

import numpy as np
import pytest
import shapely
from hypothesis import given
from pose_scenes import furnished, gap
from shapes import rectangle, ring
from strategies import Similarity, similarities

import geoanalogy as ga
from geoanalogy.poses.fronts import IN_THE_WAY, Fronts

ROOM = rectangle(5, 4)
L_ROOM = ring((0, 0), (6, 0), (6, 3), (3.1, 3), (3.1, 4), (0, 4))
CHEST = rectangle(1.6, 0.8, (-0.8, -0.4))

#: (room, opening, what has to stay free: x0, y0, x1, y1)
OPENINGS = {
    "a leaf in the wall": (ROOM, rectangle(0.9, 0.1, (3, -0.1)), (3, 0, 3.9, 0.9)),
    "a leaf in the room": (ROOM, rectangle(0.9, 0.1, (3, 0)), (3, 0, 3.9, 1.0)),
    "a sill across the wall": (ROOM, rectangle(0.2, 1.5, (-0.1, 1)), (0, 1, 1.6, 2.5)),
    "a passage as wide as the room": (ROOM, rectangle(5, 0.2, (0, 3.8)), (0, 0, 5, 4)),
    "a door beside a corner": (ROOM, rectangle(0.1, 0.8, (4.9, 0)), (4.1, 0, 5, 0.8)),
    "a window of one arm before the other": (L_ROOM, rectangle(1.0, 0.1, (4, 2.9)), (4, 1.9, 5, 3)),
}
THINGS = {
    "a wardrobe": rectangle(1.8, 0.6, (3.2, 3.4)),
    "a pillar": rectangle(0.3, 0.3, (0, 0)),
    "a screen": rectangle(2.0, 0.1, (1.5, 2)),
    "a wall that juts out": rectangle(0.1, 1.5, (2.5, 2.5)),
    "a wall beyond": rectangle(2.0, 0.1, (1, -0.5)),
}


def fronts(room, *members):
    polygons = [ga.Polygon(m, label) for label, m in members]
    return Fronts.of(ga.Polygon(room, "room"), polygons)


@pytest.mark.parametrize("name", OPENINGS)
@given(where=similarities(mirrored=True))
def test_before_an_opening_its_width_stays_free(name, where):
    room, opening, box = OPENINGS[name]
    found = fronts(where(room), ("door", where(opening)))
    wanted = shapely.Polygon(where(shapely.get_coordinates(shapely.box(*box))[:4]))
    assert found.labels == ("door",)
    assert found.areas == pytest.approx([wanted.area], rel=1e-5)
    assert found.shapes[0].symmetric_difference(wanted).area < 1e-5 * wanted.area


@pytest.mark.parametrize("thing", THINGS)
def test_what_is_thick_or_stands_free_is_no_opening(thing):
    assert len(fronts(ROOM, ("door", THINGS[thing]))) == 0


def test_a_place_is_worth_less_the_more_it_covers_beyond_what_is_usual():
    found = fronts(ROOM, ("door", rectangle(1.0, 0.1, (3, 0))), ("window", rectangle(1.0, 0.1, (1, 3.9))))
    outlines = shapely.box([0, 3, 3, 3, 1], [0, 0, 0, 0, 3], [2, 3.1, 3.2, 4, 2], [1, 1.1, 1.1, 1.1, 4])
    share = (1 - IN_THE_WAY) / 0.25
    assert found.passable(outlines, {}) == pytest.approx([1, 1 - 0.1 * share, 1 - 0.2 * share, IN_THE_WAY, IN_THE_WAY])
    usual = found.covered_by(outlines[2])
    assert usual == pytest.approx({"door": 0.2, "window": 0.0})
    assert found.passable(outlines, usual) == pytest.approx([1, 1, 1, IN_THE_WAY, IN_THE_WAY])


def chests(*members, **options):
    """A chest in the left lower corner of a room without openings, propagated to one that has some."""
    scene = ga.Scene(
        [*furnished([("room", ROOM)], "a"), *furnished([("room", ROOM), *members], "b", Similarity(shift=(9, 0)))]
    )
    options = ga.PoseOptions(relations=("segment distance", "corner distance"), scale="fixed", **options)
    found = ga.propagate_pose(scene, ga.Pose((0.8, 0.4), np.pi), CHEST, options)
    return [p for p in found if p.parent.id == "b"]


def corner(p):
    """Whether a place is at the left and whether it is below."""
    x, y = p.pose.position
    return bool(x < 11.5), bool(y < 2)


def test_what_is_in_the_way_of_a_door_comes_after_what_is_not():
    door = ("door", rectangle(0.9, 0.1, (0.8, -0.1)))
    free, behind = chests(), chests(door, threshold=0.01)
    assert corner(free[0]) == (True, True)
    assert corner(behind[0]) != (True, True)
    before = next(p for p in behind if gap(p.pose, free[0].pose)[0] < 0.01)
    assert before.importance == pytest.approx(IN_THE_WAY * free[0].importance, rel=1e-3)
    assert sum(s.weight for s in before.relations) == pytest.approx(before.importance)


def test_the_free_place_is_kept_where_only_one_is_wanted():
    door = ("door", rectangle(0.9, 0.1, (0.8, -0.1)))
    (only,) = chests(door, max_per={"room": 1})
    assert corner(only) != (True, True)


def test_fronts_do_not_count_where_nothing_is_validated():
    door = ("door", rectangle(0.9, 0.1, (0.8, -0.1)))
    values = {corner(p): p.importance for p in chests(door, threshold=0.01, validate=False)[::-1]}
    assert values[True, True] == pytest.approx(max(values.values()))


def test_results_that_fall_below_the_threshold_are_left_out():
    door = ("door", rectangle(0.9, 0.1, (0.8, -0.1)))
    before = next(p for p in chests(door, threshold=0.01) if corner(p) == (True, True))
    left = chests(door, threshold=before.importance + 0.01)
    assert left
    assert all(corner(p) != (True, True) for p in left)


def test_an_example_before_a_window_has_its_copies_before_windows():
    window = ("window", rectangle(1.8, 0.1, (0.2, 0)))
    rooms = [[("room", ROOM), window]] * 2
    scene = ga.Scene([p for k, r in enumerate(rooms) for p in furnished(r, f"room {k}", Similarity(shift=(9 * k, 0)))])
    best = next(p for p in ga.propagate_pose(scene, ga.Pose((1.1, 0.6), 0.0), CHEST) if p.parent.id == "room 1")
    assert best.importance == pytest.approx(1, abs=1e-3)
    assert best.pose.position == pytest.approx((10.1, 0.6), abs=5e-3)
