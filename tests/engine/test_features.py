"""Smooth segments and sharp corners (section 4.3)."""

import numpy as np
import pytest
import strategies
from hypothesis import given
from hypothesis import strategies as st
from shapes import (
    BAY_ROOM,
    BEVELLED_ROOM,
    CATALOGUE,
    CIRCLE,
    COURTYARD,
    HOLED_ROOM,
    L_ROOM,
    TEARDROP,
    UNIT_SQUARE,
    rectangle,
    regular,
)

from geoanalogy import Polygon
from geoanalogy.geometry.features import polygon_features, ring_features
from geoanalogy.geometry.persistence import sharp_vertices
from geoanalogy.tolerances import SMOOTH_TURN


@pytest.mark.parametrize(("name", "outline", "corners", "segments"), CATALOGUE, ids=[c[0] for c in CATALOGUE])
def test_catalogue(name, outline, corners, segments):
    found_segments, found_corners = polygon_features(Polygon(outline))
    assert (len(found_corners), len(found_segments)) == (corners, segments)


def test_smooth_limit_lies_between_octagon_and_dodecagon():
    assert np.cos(2 * np.pi / 8) < SMOOTH_TURN < np.cos(2 * np.pi / 12)
    assert sharp_vertices(regular(8)).all()
    assert not sharp_vertices(regular(12)).any()


def test_corners_of_an_angled_room():
    _, corners = polygon_features(Polygon(L_ROOM))
    assert [c.vertex.tolist() for c in corners] == L_ROOM.tolist()
    assert np.degrees([c.opening for c in corners]) == pytest.approx([90, 90, 90, 270, 90, 90])
    assert np.degrees([c.bisector for c in corners]) % 360 == pytest.approx([45, 135, 225, 225, 225, 315])


def test_corners_of_the_bevelled_room():
    _, corners = polygon_features(Polygon(BEVELLED_ROOM))
    assert np.degrees([c.opening for c in corners]) == pytest.approx([90, 90, 135, 135, 90])


def test_straight_segments():
    segments, _ = polygon_features(Polygon(L_ROOM))
    assert [s.length for s in segments] == [5, 2, 2, 2, 3, 4]
    assert [s.curvature for s in segments] == [0] * 6
    assert segments[0].vertices.tolist() == [[0, 0], [5, 0]]
    assert [s.ring_offset for s in segments] == [0, 5, 7, 9, 11, 14]
    assert not any(s.closed for s in segments)


def test_circle_is_one_closed_segment():
    (segment,), corners = polygon_features(Polygon(CIRCLE))
    assert not corners
    assert segment.closed
    assert segment.vertices[0].tolist() == segment.vertices[-1].tolist()
    assert segment.length == pytest.approx(64 * 2 * 2 * np.sin(np.pi / 64))
    assert segment.curvature == pytest.approx(2 * np.pi / segment.length)


def test_teardrop_is_one_open_segment_from_tip_to_tip():
    (segment,), (tip,) = polygon_features(Polygon(TEARDROP))
    assert not segment.closed
    assert segment.vertices[0].tolist() == segment.vertices[-1].tolist() == tip.vertex.tolist() == [-3, 0]
    # All turns but the tip's, which are those of the ring less it.
    assert segment.curvature * segment.length == pytest.approx(2 * np.pi - (np.pi - tip.opening))


def test_bay_runs_smoothly_into_its_walls():
    segments, corners = polygon_features(Polygon(BAY_ROOM))
    assert sorted(c.vertex.tolist() for c in corners) == [[0, 0], [0, 3]]
    bay = max(segments, key=lambda s: s.length)
    assert bay.length == pytest.approx(6 + 1.5 * np.pi, rel=1e-3)
    assert bay.curvature * bay.length == pytest.approx(np.pi)


def test_hole_turns_its_back():
    _, corners = polygon_features(Polygon(HOLED_ROOM, holes=[COURTYARD]))
    assert np.degrees([c.opening for c in corners]) == pytest.approx([90] * 4 + [270] * 4)
    assert sorted(c.vertex.tolist() for c in corners[4:]) == sorted(COURTYARD.tolist())


def test_change_of_label_ends_a_segment_but_makes_no_corner():
    wall = np.insert(rectangle(6, 3), 1, [(2.0, 0.0), (3.0, 0.0)], axis=0)
    segments, corners = ring_features(wall, ("", "door", "", "", "", ""))
    assert len(corners) == 4
    assert [(s.label, s.length) for s in segments] == [("", 2), ("door", 1), ("", 3), ("", 3), ("", 6), ("", 3)]


def test_label_round_a_whole_smooth_ring():
    segments, _ = ring_features(CIRCLE, ("glass",) * 64)
    assert [(s.label, s.closed) for s in segments] == [("glass", True)]


@given(strategies.rings(), st.integers(0, 70))
def test_features_do_not_depend_on_the_first_vertex(outline, shift):
    segments, corners = ring_features(outline)
    shifted_segments, shifted_corners = ring_features(np.roll(outline, shift, axis=0))
    assert sorted(map(_corner, corners)) == sorted(map(_corner, shifted_corners))
    assert np.array(sorted(map(_segment, segments))) == pytest.approx(np.array(sorted(map(_segment, shifted_segments))))


def _corner(corner):
    return (*corner.vertex, corner.opening, corner.bisector)


def _segment(segment):
    ends = (0.0, 0.0) if segment.closed else tuple(segment.vertices[0] + segment.vertices[-1])
    return (*ends, segment.length, segment.curvature)


@given(strategies.rings(), strategies.similarities())
def test_features_follow_similarity_transforms(outline, similarity):
    turns = np.abs(_turns(outline))
    if np.abs(turns - np.arccos(SMOOTH_TURN)).min() < 1e-6:
        return  # on the limit itself rounding decides
    segments, corners = ring_features(outline)
    moved_segments, moved_corners = ring_features(similarity(outline))
    assert len(moved_segments) == len(segments)
    for corner, moved in zip(corners, moved_corners, strict=True):
        assert moved.vertex == pytest.approx(similarity(corner.vertex))
        assert moved.opening == pytest.approx(corner.opening, abs=1e-6)
        assert np.exp(1j * moved.bisector) == pytest.approx(np.exp(1j * (corner.bisector + similarity.angle)), abs=1e-6)
    for segment, moved in zip(segments, moved_segments, strict=True):
        assert moved.length == pytest.approx(similarity.scale * segment.length)
        assert moved.curvature == pytest.approx(segment.curvature / similarity.scale, abs=1e-6 / segment.length)


@given(strategies.rings())
def test_segments_and_corners_make_up_the_ring(outline):
    segments, corners = ring_features(outline)
    lengths = np.hypot(*(np.roll(outline, -1, axis=0) - outline).T)
    assert sum(s.length for s in segments) == pytest.approx(lengths.sum())
    turned_in_segments = sum(s.curvature * s.length for s in segments)
    turned_in_corners = sum(abs(np.pi - c.opening) for c in corners)
    assert turned_in_segments + turned_in_corners == pytest.approx(np.abs(_turns(outline)).sum(), abs=1e-6)


def _turns(outline):
    steps = np.roll(outline, -1, axis=0) - outline
    before = np.roll(steps, 1, axis=0)
    return np.arctan2(before[:, 0] * steps[:, 1] - before[:, 1] * steps[:, 0], (before * steps).sum(axis=1))


def test_mirrored_ring_has_mirrored_corners():
    _, corners = polygon_features(Polygon(L_ROOM))
    _, mirrored = polygon_features(Polygon(L_ROOM * (-1, 1)))
    assert sorted(c.opening for c in mirrored) == pytest.approx(sorted(c.opening for c in corners))
    assert sorted((-c.vertex[0], c.vertex[1]) for c in mirrored) == sorted(tuple(c.vertex) for c in corners)


def test_unit_square_openings_halve_towards_the_centre():
    _, corners = polygon_features(Polygon(UNIT_SQUARE))
    for corner in corners:
        towards = np.array([0.5, 0.5]) - corner.vertex
        assert np.exp(1j * corner.bisector) == pytest.approx(complex(*towards) / np.hypot(*towards))
