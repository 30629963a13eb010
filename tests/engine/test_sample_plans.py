"""The plans of the sample scenes, without Blender."""

from collections import Counter

import numpy as np
import pytest
import shapely

from sample_blends.plans import apartment, crowns, garden


def shapes(polygons):
    made = {polygon.id: shapely.Polygon(polygon.ring) for polygon in polygons}
    assert len(made) == len(polygons)
    for name, shape in made.items():
        assert shape.is_valid and shape.exterior.is_ccw, name
    return made


@pytest.mark.parametrize("plan", [apartment, garden, crowns])
def test_polygons_lie_in_their_parents(plan):
    polygons = plan.plan()
    made = shapes(polygons)
    for polygon in polygons:
        if polygon.parent is not None:
            assert made[polygon.id].difference(made[polygon.parent]).area < 1e-6 * made[polygon.id].area


def test_apartment_floor_has_rooms_of_every_kind():
    count = Counter(polygon.label for polygon in apartment.plan())
    assert (
        sum(count[label] for label in ("bedroom", "living room", "kitchen", "closet", "toilet", "bathroom", "hall"))
        >= 30
    )
    flats = {room.id.split()[0] for room in apartment.rooms()} - {"corridor", "stairwell"}
    assert len(flats) >= 6
    assert (
        min(count[label] for label in ("bedroom", "living room", "kitchen", "closet", "toilet", "bathroom", "hall"))
        >= 5
    )
    assert sum(len(room.ring) > 4 for room in apartment.rooms()) >= 10


def test_rooms_of_the_apartment_keep_a_wall_between_them():
    made = list(shapes(apartment.rooms()).values())
    for i, one in enumerate(made):
        for other in made[:i]:
            assert one.distance(other) > 1.99 * apartment.HALF_WALL


def test_every_room_of_the_apartment_can_be_reached_through_doors():
    reached = {"corridor", "stairwell"}
    doors = apartment.doors()
    for _ in doors:
        reached |= {room for door in doors for room in (door.room, door.other) if {door.room, door.other} & reached}
    assert reached == {room.id for room in apartment.rooms()}


def test_no_door_leaf_hits_another():
    leaves = [shapely.Polygon(p.ring) for p in apartment.plan() if p.label == "door" and p.id.endswith("leaf")]
    for i, one in enumerate(leaves):
        assert all(one.intersection(other).area < 1e-9 for other in leaves[:i])


def test_opening_outline_runs_into_the_room():
    door = next(d for d in apartment.doors() if d.room == "1 bathroom")
    ring = shapely.Polygon(door.outline(0.0, 0.5))
    assert ring.area == pytest.approx(0.5 * door.width)
    assert ring.exterior.is_ccw
    # The bathroom lies to the left of its door.
    assert door.angle == pytest.approx(np.pi) and ring.bounds[2] == pytest.approx(5 - apartment.HALF_WALL)


def test_garden_parcels_do_not_overlap_beyond_the_chords_of_arcs():
    polygons = garden.parcels()
    made = shapes(polygons)
    for i, one in enumerate(polygons):
        for other in polygons[:i]:
            if one.id not in (other.parent,) and other.id != one.parent:
                assert made[one.id].intersection(made[other.id]).area < 0.5
    assert Counter(polygon.label for polygon in polygons).keys() == {"way", "garden", "palace"}


@pytest.mark.parametrize("crown", crowns.CROWNS, ids=lambda crown: crown.id)
class TestCrowns:
    def test_outline_goes_once_around(self, crown):
        ring = crown.outline() - crown.origin
        assert np.ptp(ring[:, 0]) == pytest.approx(2 * np.pi * crown.radius)
        assert ring[:, 1].max() == pytest.approx(crown.height)
        # The two sides of the seam meet.
        rim = crown.rim()
        assert rim[0, 1] == pytest.approx(rim[-1, 1])
        assert np.allclose(crown.rolled(crown.origin + rim[:1]), crown.rolled(crown.origin + rim[-1:]))

    def test_every_peak_is_whole(self, crown):
        height = crown.rim()[:, 1]
        peaks = np.flatnonzero(np.isclose(height, crown.height))
        assert len(peaks) == crown.periods
        assert 0 < peaks[0] and peaks[-1] < len(height) - 1

    def test_frame_is_a_rotation_that_stands_on_the_surface(self, crown):
        at = np.add(crown.origin, (0.2, 0.04))
        placed = crown.frame(*at, direction=0.7, height=0.003)
        assert np.allclose(placed[:3, :3].T @ placed[:3, :3], np.eye(3))
        assert np.linalg.det(placed[:3, :3]) == pytest.approx(1.0)
        assert np.allclose(placed[:3, 3], crown.rolled(at[None], 0.003)[0])
        # Columns are the derivatives of the mapping: the pose's direction, and the way out.
        step = 1e-7
        ahead = crown.rolled((at + step * np.array((np.cos(np.pi / 2), np.sin(np.pi / 2))))[None])[0]
        up = (ahead - crown.rolled(at[None])[0]) / step
        upright = crown.frame(*at, direction=np.pi / 2)
        assert np.allclose(upright[:3, 0], up / np.linalg.norm(up), atol=1e-5)
        out = (crown.rolled(at[None], step)[0] - crown.rolled(at[None])[0]) / step
        assert np.allclose(placed[:3, 2], out, atol=1e-5)

    def test_lengths_along_the_base_are_true(self, crown):
        x = np.linspace(0.0, 0.1, 200)
        base = crown.rolled(np.column_stack((x, np.zeros(200))) + crown.origin)
        assert np.linalg.norm(np.diff(base, axis=0), axis=1).sum() == pytest.approx(0.1, rel=1e-4)


def test_crown_of_an_id():
    assert crowns.crown("ducal crown").periods == 6
