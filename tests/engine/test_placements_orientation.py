"""The frames of placements: by the parent, or by its nearest segment."""

import numpy as np
import pytest
from placement_scenes import facade, polygon

import geoanalogy as ga
from geoanalogy.placements.examples import Orientation, orientation_of


def test_rectangles_askew_by_the_same_angle_come_back_askew():
    scene = ga.Scene(
        [polygon(0, 0, 6, 6, "room", "a"), polygon(8, 0, 6, 6, "room", "b"), polygon(16, 0, 6, 6, "room", "c")]
    )
    tilted = [ga.Example(scene, ga.Rectangle(x, 3, 2, 1, 0.5)) for x in (3, 11)]
    model = ga.learn_placement(tilted)
    assert model.orientation == Orientation(False, pytest.approx(0.5))
    best = max((p for p in model.place(scene, threshold=0) if p.parent.id == "c"), key=lambda p: p.score)
    r = best.rectangle
    assert (r.x, r.y, r.width, r.height, r.angle) == pytest.approx((19, 3, 2, 1, 0.5))


def hexagon(x, turn=0.2):
    at = turn + np.arange(6) * np.pi / 3
    return np.stack([x + 5 * np.cos(at), 5 * np.sin(at)], axis=1)


def along_edge(ring, i):
    """A rectangle against an edge, its width along it."""
    a, b = ring[i], ring[(i + 1) % 6]
    angle = np.arctan2(*(b - a)[::-1])
    middle = (a + b) / 2 + 0.6 * np.array([-np.sin(angle), np.cos(angle)])
    return ga.Rectangle(*middle, 2.0, 0.8, angle)


def test_rectangles_along_different_edges_take_the_direction_of_the_nearest_segment():
    rings = hexagon(0), hexagon(20)
    scene = ga.Scene([ga.Polygon(r, "hall", f"h{i}") for i, r in enumerate(rings)])
    shown = [along_edge(rings[0], 0), along_edge(rings[0], 1), along_edge(rings[0], 3)]
    model = ga.learn_placement([ga.Example(scene, r) for r in shown])
    assert model.orientation.by_segment
    found = [p.rectangle for p in model.place(scene)]
    for i in range(6):
        want = along_edge(rings[1], i)
        nearest = min(found, key=lambda r, w=want: np.hypot(r.x - w.x, r.y - w.y))
        assert np.hypot(nearest.x - want.x, nearest.y - want.y) < 0.1
        assert abs((nearest.angle - want.angle + np.pi) % (2 * np.pi) - np.pi) < 1e-6
        assert nearest.width > nearest.height


def test_what_is_drawn_nearly_parallel_is_meant_parallel():
    scene = ga.Scene(facade(0, 3, 2))
    drawn = [ga.Example(scene, ga.Rectangle(2, 3.2, 1, 0.3, a)) for a in (0.02,)]
    assert orientation_of(drawn, [scene.polygon("f")]) == Orientation()
