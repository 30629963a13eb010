"""Where no maximum of the importance may be accepted, the object stands at the best place beside."""

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
    (only,), pillars = found(2.0, high, pillar)
    # As near to the end of the room as the pillar lets it.
    assert only.pose.position[0] == pytest.approx(10 + pillar + 0.5, abs=0.005)
    assert only.importance < found(2.0, high, 0.0)[0][0].importance
    outline = shapely.Polygon(only.pose.to_scene(SQUARE))
    assert all(outline.intersection(p).area < 0.01 for p in pillars)
    assert outline.difference(shapely.box(10, 0, 12, high)).area < 0.01


def test_nothing_is_placed_where_there_is_no_room():
    assert found(2.0, 1.1, 0.8)[0] == []


def test_the_object_gives_way_only_as_far_as_the_threshold_allows():
    (only,), _ = found(2.0, 1.1, 0.25)
    assert found(2.0, 1.1, 0.25, threshold=only.importance + 0.01)[0] == []


def test_the_object_gives_way_only_where_intersections_are_rejected():
    results, (left, _) = found(2.0, 1.1, 0.25, validate=False)
    assert any(shapely.Polygon(p.pose.to_scene(SQUARE)).intersection(left).area > 0.1 for p in results)
