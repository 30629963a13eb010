"""The assets of the sample scenes, without Blender: sizes, footprints, materials."""

import numpy as np
import pytest
import shapely

from sample_blends.library import ASSETS
from sample_blends.library.palette import PALETTE
from sample_blends.library.solids import box, cushion, cylinder, dense_ball, dense_box, joined, tube
from sample_blends.plans.outlines import arc, circle, inset, mirrored, rectangle, rounded

# Leaves and frames may reach beyond the ground outline; nothing else by more than this share of its size.
OVERHANG = 0.09
BEYOND = {"door": 0.2, "window": 0.5, "pagoda": 0.15, "potted plant": 0.3, "broad-leaved tree": 0.12, "coat rack": 0.12}


def volume(solid):
    """Signed volume by the divergence theorem: positive where every face looks outwards."""
    total = 0.0
    for face in solid.faces:
        a = solid.vertices[face[0]]
        for i in range(1, len(face) - 1):
            b, c = solid.vertices[face[i]], solid.vertices[face[i + 1]]
            total += float(np.dot(a, np.cross(b, c))) / 6
    return total


@pytest.mark.parametrize("name", sorted(ASSETS))
def test_asset_stands_on_its_footprint(name):
    asset = ASSETS[name]
    solid = asset.solid()
    ring = shapely.Polygon(asset.footprint)
    assert ring.is_valid and ring.exterior.is_ccw
    size = np.ptp(asset.footprint, axis=0).max()
    # The origin is the centre of the footprint.
    middle = (asset.footprint.min(axis=0) + asset.footprint.max(axis=0)) / 2
    assert np.abs(middle).max() < 0.05 * size or name == "door"
    reach = shapely.MultiPoint(solid.vertices[:, :2]).convex_hull
    grown = ring.convex_hull.buffer(BEYOND.get(name, OVERHANG) * size)
    assert reach.difference(grown).area < 1e-9 * size**2
    if name != "window":
        assert abs(solid.vertices[:, 2].min()) < 0.025 * np.ptp(solid.vertices, axis=0).max()
    assert len(solid.faces) == len(solid.materials) <= 3000
    assert set(solid.materials) <= set(PALETTE)
    assert max(max(face) for face in solid.faces) < len(solid.vertices)


@pytest.mark.parametrize(
    ("solid", "expected"),
    [
        (box((2.0, 3.0, 4.0), (1.0, 1.0, 5.0), "oak", 0.0), 24.0),
        (box((2.0, 3.0, 4.0), (0.0, 0.0, 0.0), "oak", 0.1), 24.0 - 4 * 9 * 0.1**2 / 2 + 8 * 0.1**3 / 6 * 2),
        (cylinder(1.0, 2.0, (0.0, 0.0, 0.0), "oak", sides=400), 2 * np.pi),
        (dense_box((1.0, 2.0, 3.0), 0.3, "oak"), 6.0),
        (dense_ball(1.0, 40, (2.0, 0.0, 0.0), "oak"), 4 / 3 * np.pi),
        (tube([(0.0, 0.0, 0.0), (0.0, 3.0, 0.0), (0.0, 5.0, 0.0)], 0.5, "oak", 200), 5 * np.pi / 4),
    ],
)
def test_solids_enclose_their_volume(solid, expected):
    assert volume(solid) == pytest.approx(expected, rel=2e-3)


def test_solids_keep_their_volume_when_moved_turned_and_mirrored():
    pad = cushion((0.6, 0.4, 0.2), (0.0, 0.0, 0.0), "oak", 0.05, puff=0.02)
    expected = volume(pad)
    assert 0 < expected < 0.6 * 0.4 * 0.24
    assert volume(pad.turned(33, "x").turned(70).moved(3, 1, 2)) == pytest.approx(expected)
    assert volume(pad.scaled(-1.0, 1.0, 1.0)) == pytest.approx(expected)
    assert volume(joined((pad, pad.moved(5)))) == pytest.approx(2 * expected)


def test_inset_moves_every_edge_by_its_distance():
    ring = rectangle(0, 0, 4, 2)
    assert np.allclose(inset(ring, 0.5), rectangle(0.5, 0.5, 3.5, 1.5))
    assert np.allclose(inset(ring, np.array([0.5, 0.0, 0.0, 0.0])), rectangle(0, 0.5, 4, 2))
    assert shapely.Polygon(inset(circle(1.0, count=90), -0.5)).area == pytest.approx(1.5**2 * np.pi, rel=2e-3)


def test_rounded_corners_leave_out_what_the_arc_cuts():
    area = shapely.Polygon(rounded(rectangle(0, 0, 4, 2), 0.5, 60)).area
    assert area == pytest.approx(8 - (4 - np.pi) * 0.25, rel=1e-4)
    hollow = np.array([(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)], dtype=float)
    assert shapely.Polygon(rounded(hollow, 0.2, 60)).area == pytest.approx(
        5 - (5 - 1) * (1 - np.pi / 4) * 0.04, rel=1e-4
    )


def test_mirrored_ring_stays_counter_clockwise():
    ring = np.vstack(((0.0, 0.0), arc((0.0, 0.0), 1.0, 0, 80, 7)))
    image = shapely.Polygon(mirrored(ring, axis=2.0))
    assert image.exterior.is_ccw
    assert image.bounds[2] == pytest.approx(4.0)
    assert image.area == pytest.approx(shapely.Polygon(ring).area)
