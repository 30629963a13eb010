"""Where the best maximum of the importance may not be accepted, the object stands at the best place beside."""

import numpy as np
import pytest
import shapely

import geoanalogy as ga

SQUARE = np.array([(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)])


def box(x, wide, high, label):
    return ga.Polygon([(x, 0), (x + wide, 0), (x + wide, high), (x, high)], label=label, id=f"{label} at {x:g}")


def found(wide, high, pillar, **options):
    """Where a square from the corner of a large room answers in one hardly wider, with a pillar across either end."""
    ends = [box(10, pillar, high, "pillar"), box(10 + wide - pillar, pillar, high, "pillar")] if pillar else []
    scene = ga.Scene([box(0, 3, 4, "room"), box(10, wide, high, "room"), *ends])
    options = ga.PoseOptions(mirror=False, symmetries=False, **options)
    results = ga.propagate_pose(scene, ga.Pose((0.5, 0.5), np.pi / 2), SQUARE, options)
    return [p for p in results if p.parent.id == "room at 10"], [shapely.Polygon(e.points) for e in ends]


@pytest.mark.parametrize(("high", "pillar"), [(1.02, 0.15), (1.1, 0.15), (1.1, 0.25), (1.3, 0.25)])
def test_the_object_gives_way_to_what_stands_in_its_place(high, pillar):
    ends, pillars = found(2.0, high, pillar)
    # As near to the ends of the room, which are alike, as the pillars let it.
    assert sorted(e.pose.position[0] - 11 for e in ends) == pytest.approx([pillar - 0.5, 0.5 - pillar], abs=0.005)
    assert ends[0].importance == pytest.approx(ends[1].importance, abs=1e-3)
    for end in ends:
        assert end.importance < found(2.0, high, 0.0)[0][0].importance
        outline = shapely.Polygon(end.pose.to_scene(SQUARE))
        assert all(outline.intersection(p).area < 0.01 for p in pillars)
        assert outline.difference(shapely.box(10, 0, 12, high)).area < 0.01


#: No two corners or sides are alike, so that the one analogous place is much the best.
UNLIKE = np.array([(0.0, 0.0), (5.0, 0.0), (4.2, 3.0), (1.0, 3.6)])


def beside_a_pillar(reach):
    """The results in a room like the example's, where a pillar reaches into the object's place from the left."""
    pillar = ga.Polygon([(10.7, 0), (11 + reach, 0), (11 + reach, 1), (10.7, 1)], label="pillar", parent="there")
    rooms = [
        ga.Polygon(UNLIKE, label="room", id="here"),
        ga.Polygon(UNLIKE + np.array([10, 0]), label="room", id="there"),
    ]
    options = ga.PoseOptions(mirror=False, symmetries=False)
    results = ga.propagate_pose(ga.Scene([*rooms, pillar]), ga.Pose((1.5, 0.5), np.pi / 2), SQUARE, options)
    return [p for p in results if p.parent.id == "there"]


@pytest.mark.parametrize("reach", [0.1, 0.15, 0.2])
def test_the_object_gives_way_where_the_place_beside_is_better_than_all_that_are_free(reach):
    first, second = beside_a_pillar(reach)[:2]
    assert first.pose.position == pytest.approx((11.5 + reach, 0.5), abs=0.005)
    assert first.pose.angle == pytest.approx(np.pi / 2, abs=0.01)
    # What is free without giving way comes after it.
    assert np.hypot(second.pose.position[0] - 11.5, second.pose.position[1] - 0.5) > 1
    assert second.importance < first.importance < 1


def test_the_object_does_not_give_way_to_where_other_places_are_better():
    assert all(np.hypot(p.pose.position[0] - 11.5, p.pose.position[1] - 0.5) > 1 for p in beside_a_pillar(0.5))


def test_nothing_is_placed_where_there_is_no_room():
    assert found(2.0, 1.1, 0.8)[0] == []


def test_the_object_gives_way_only_as_far_as_the_threshold_allows():
    ends, _ = found(2.0, 1.1, 0.25)
    assert found(2.0, 1.1, 0.25, threshold=ends[0].importance + 0.01)[0] == []


def test_the_object_gives_way_only_where_intersections_are_rejected():
    results, (left, _) = found(2.0, 1.1, 0.25, validate=False)
    assert any(shapely.Polygon(p.pose.to_scene(SQUARE)).intersection(left).area > 0.1 for p in results)
