"""Corners that persist: noisy boundaries lose their noise, clean ones nothing (figure 4.21)."""

import numpy as np
import pytest
import shapely
import shapes
import strategies
from hypothesis import given, settings
from hypothesis import strategies as st

from geoanalogy import Polygon
from geoanalogy.geometry import persistence
from geoanalogy.geometry.features import polygon_features
from geoanalogy.geometry.persistence import clear_ring, sharp_vertices
from geoanalogy.relations.elements import Elements
from geoanalogy.relations.observation import Observation
from geoanalogy.relations.table import RELATIONS, SEGMENT_ANGLE

#: In units of the square root of the area: a careful hand, a quick one, a sketch.
LEVELS = (0.005, 0.015, 0.03)

ROOMS = {
    "square": shapes.UNIT_SQUARE,
    "corridor": shapes.rectangle(5, 1.2),
    "L room": shapes.L_ROOM,
    "T room": shapes.ring((0, 0), (6, 0), (6, 2), (4, 2), (4, 5), (2, 5), (2, 2), (0, 2)),
    "attic": shapes.ring((0, 0), (5, 0), (4, 2), (1, 2)),
    "gable": shapes.ring((0, 0), (4, 0), (1, 3)),
}


def size(outline):
    return np.sqrt(shapely.Polygon(outline).area)


def stairs(steps):
    down = [(k + d, steps - k) for k in range(steps) for d in (0, 1)]
    return np.array([(0, 0), *[(x, y) for x, y in down], (steps, 0)], dtype=float)[::-1]


def gear(teeth):
    angles = 2 * np.pi * np.arange(4 * teeth) / (4 * teeth)
    radii = np.tile([1.0, 1.0, 0.93, 0.93], teeth)
    return np.stack([radii * np.cos(angles), radii * np.sin(angles)], axis=1)


# Clean rings


@pytest.mark.parametrize(
    "outline",
    [
        *[outline for _, outline, _, _ in shapes.CATALOGUE],
        shapes.comb(12),
        shapes.comb(40, width=1.0, depth=0.3),
        shapes.star(15),
        shapes.star(40, inner=0.95),
        stairs(20),
        stairs(60),
        gear(30),
        shapes.regular(24),
        shapes.regular(500),
        shapes.regular(200) * (3, 1),
        shapes.bay(200),
    ],
)
def test_clean_rings_stay_as_they_are(outline):
    clear = clear_ring(outline)
    assert clear.points is outline
    assert clear.noise == 0
    assert clear.sharp.tolist() == sharp_vertices(outline).tolist()


@pytest.mark.parametrize("low", [0.1, 0.5])
def test_rich_shapes_are_not_noisy(low):
    rng = np.random.default_rng(0)
    for count in rng.integers(24, 90, size=100):
        angles = 2 * np.pi * np.cumsum(gaps := rng.uniform(0.5, 1, size=count)) / gaps.sum()
        radii = rng.uniform(low, 1.0, size=count)
        outline = np.stack([radii * np.cos(angles), radii * np.sin(angles)], axis=1)
        assert clear_ring(outline).points is outline


def test_few_spikes_on_a_smooth_ring_are_no_noise():
    radii = np.ones(96)
    radii[::8] += np.random.default_rng(0).uniform(-0.2, 0.2, size=12)
    outline = shapes.regular(96) * radii[:, None]
    assert clear_ring(outline).points is outline


def test_small_rings_are_not_even_looked_at(monkeypatch):
    monkeypatch.setattr(persistence, "_spread_of_turns", None)
    clear_ring(shapes.NICHE_ROOM)
    clear_ring(shapes.COMB)


def test_many_niches_of_five_centimetres_stay():
    wall = [(x + d, y) for x in range(1, 30, 2) for d, y in ((0, 3), (0, 3.05), (1, 3.05), (1, 3))]
    room = np.array([(0, 0), (31, 0), (31, 3), *wall[::-1], (0, 3)], dtype=float)
    assert len(polygon_features(Polygon(room))[1]) == len(room)


# Noisy rings


def found(outline, level, spacing, seed, across=True):
    """The clear ring, or None where the drawing crosses itself."""
    noisy = shapes.drawn(outline, level, spacing, seed, across)
    return clear_ring(noisy) if shapely.Polygon(noisy).is_valid else None


@pytest.mark.parametrize("level", LEVELS)
@pytest.mark.parametrize("name", ROOMS)
def test_rooms_keep_their_corners_and_straight_walls(name, level):
    outline = ROOMS[name]
    kept = []
    for spacing in (0.015, 0.04):
        for seed in range(5):
            for across in (True, False):
                clear = found(outline, level, spacing, seed, across)
                if clear is None:
                    continue
                corners = clear.points[clear.sharp]
                right = len(corners) == len(outline)
                kept.append(right)
                if right:
                    apart = np.hypot(*(outline[:, None] - corners).transpose(2, 0, 1)).min(axis=1) / size(outline)
                    assert apart.max() < 4 * level + 0.01
                    assert np.median(apart) < 1.5 * level + 0.005
                    openings = [c.opening for c in polygon_features(Polygon(corners))[1]]
                    true = [c.opening for c in polygon_features(Polygon(outline))[1]]
                    order = np.hypot(*(outline[:, None] - corners).transpose(2, 0, 1)).argmin(axis=1)
                    off = np.abs(np.degrees(np.array(openings)[order] - true))
                    assert np.median(off) < 1 + 500 * level
                    assert off.max() < 2 + 1200 * level
                    assert clear.noise == pytest.approx(level * size(outline), rel=0.35)
    assert len(kept) >= 3  # the others cross themselves
    assert np.mean(kept) >= 0.9


@pytest.mark.parametrize("level", LEVELS)
@pytest.mark.parametrize("spacing", [0.01, 0.03, 0.08])
def test_circles_stay_smooth(level, spacing):
    for seed in range(3):
        clear = found(shapes.regular(256), level, spacing, seed)
        if clear is not None:
            assert clear.noise > 0
            assert not clear.sharp.any()
            assert np.hypot(*clear.points.T) == pytest.approx(1, abs=2 * level)


@pytest.mark.parametrize("level", LEVELS[:2])
@pytest.mark.parametrize(("outline", "corners"), [(shapes.bay(), 2), (shapes.TEARDROP, 1)], ids=["bay", "teardrop"])
def test_bays_stay_smooth(outline, corners, level):
    kept = [
        clear.sharp.sum() == corners
        for spacing in (0.01, 0.02, 0.04)
        for seed in range(4)
        if (clear := found(outline, level, spacing, seed)) is not None
    ]
    assert np.mean(kept) >= 0.9


def test_features_larger_than_the_noise_stay():
    chimney = shapes.ring((0, 0), (4, 0), (4, 3), (2.4, 3), (2.4, 2.5), (1.6, 2.5), (1.6, 3), (0, 3))
    for seed in range(5):
        assert found(chimney, 0.005, 0.02, seed).sharp.sum() == 8


def test_a_jog_shorter_than_the_spacing_is_a_step():
    jog = shapes.ring((0, 0), (6, 0), (6, 3.4), (3, 3.4), (3, 3), (0, 3))
    kept = [found(jog, 0.008, spacing, seed).sharp.sum() == 6 for spacing in (0.03, 0.09) for seed in range(8)]
    assert np.mean(kept) >= 0.9


def test_one_noisy_wall_among_clean_ones():
    wall = np.linspace((4.0, 3.0), (0.0, 3.0), 60, endpoint=False)
    wall[1:, 1] += np.random.default_rng(0).normal(scale=0.03, size=59)
    clear = clear_ring(np.vstack([[(0.0, 0.0), (4, 0)], wall, [(0.0, 3.0)]]))
    corners = clear.points[clear.sharp]
    assert sorted(map(tuple, corners.round())) == [(0, 0), (0, 3), (4, 0), (4, 3)]


def test_what_no_few_pieces_explain_stays():
    rng = np.random.default_rng(0)
    angles = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    burr = np.stack([np.cos(angles), np.sin(angles)], axis=1) * rng.uniform(0.4, 1.0, size=(60, 1))
    assert clear_ring(burr).points is burr


# Invariance


@given(strategies.similarities(), st.sampled_from([0.005, 0.02]), st.integers(0, 300))
@settings(max_examples=15)
def test_corners_follow_similarity_transforms_and_any_start(similarity, level, shift):
    noisy = shapes.drawn(shapes.L_ROOM, level, 0.03, seed=3)
    moved = np.roll(similarity(noisy), shift, axis=0)
    clear, other = clear_ring(noisy), clear_ring(moved)
    expected = similarity(clear.points[clear.sharp])
    assert clear.sharp.sum() == other.sharp.sum() == 6
    apart = np.hypot(*(expected[:, None] - other.points[other.sharp]).transpose(2, 0, 1))
    assert apart.min(axis=0).max() < 1e-6 * similarity.scale
    assert other.noise == pytest.approx(similarity.scale * clear.noise, rel=1e-6)


def test_the_same_ring_gives_the_same_again():
    noisy = shapes.drawn(shapes.L_ROOM, 0.02, 0.03, seed=3)
    assert np.array_equal(clear_ring(noisy).points, clear_ring(noisy.copy()).points)


@given(st.integers(0, 150))
@settings(max_examples=20)
def test_the_first_vertex_stays_in_its_place(shift):
    noisy = np.roll(shapes.drawn(shapes.UNIT_SQUARE, 0.01, 0.03, seed=1), shift, axis=0)
    assert np.hypot(*(clear_ring(noisy).points[0] - noisy[0])) < 0.05


# What is carried over


def test_labels_stay_with_their_walls():
    noisy = shapes.drawn(shapes.rectangle(4, 3), 0.005, 0.02, seed=0)
    x, y = noisy.T
    labels = tuple("door" if a > 3.9 and 1 <= b < 2 else "" for a, b in zip(x, y, strict=True))
    segments, corners = polygon_features(Polygon(noisy, segment_labels=labels))
    assert len(corners) == 4
    door = [s for s in segments if s.label == "door"]
    assert len(door) == 1
    assert door[0].length == pytest.approx(1, abs=0.12)
    assert door[0].vertices[:, 0] == pytest.approx(4, abs=0.05)
    assert len(segments) == 6
    assert [s.label for s in polygon_features(Polygon(noisy, segment_labels=["w"] * len(noisy)))[0]] == ["w"] * 4


def test_a_label_that_ends_at_a_corner_ends_at_the_corner():
    noisy = shapes.drawn(shapes.rectangle(4, 3), 0.005, 0.02, seed=0)
    first_wall = round(4 / (0.02 * size(shapes.rectangle(4, 3))))
    labels = ["glass" if k < first_wall else "" for k in range(len(noisy))]
    segments, _ = polygon_features(Polygon(noisy, segment_labels=labels))
    assert sorted(s.label for s in segments) == ["", "", "", "glass"]


def test_holes_lose_their_noise_too():
    room = Polygon(
        shapes.drawn(shapes.rectangle(6, 5), 0.005, 0.02, seed=0),
        holes=[shapes.drawn(shapes.rectangle(2, 1, (2, 2)), 0.01, 0.04, seed=1)],
    )
    _, corners = polygon_features(room)
    assert np.degrees([c.opening for c in corners]) == pytest.approx([90] * 4 + [270] * 4, abs=8)


def test_main_orientation_does_not_tremble():
    turned = strategies.Similarity(np.radians(20))(shapes.rectangle(5, 3))
    for level in LEVELS:
        noisy = Polygon(shapes.drawn(turned, level, 0.03, seed=0))
        assert np.degrees(noisy.main_orientation) == pytest.approx(20, abs=1 + 60 * level)


@pytest.mark.parametrize("level", LEVELS)
def test_relations_are_those_of_the_clean_room(level):
    room = shapes.L_ROOM
    points = np.array([(1.0, 1.0), (4.3, 0.7), (1.5, 3.2), (2.5, 1.5), (7.0, 5.0)])
    clean = Observation(Elements.of([Polygon(room)]), points)
    noisy = Observation(Elements.of([Polygon(shapes.drawn(room, level, 0.03, seed=5))]), points)
    deviation = level * size(room)
    assert noisy.boundary.distance == pytest.approx(clean.boundary.distance, abs=2 * deviation)
    # The corners in the order of the clean room.
    order = np.hypot(*(room[:, None] - noisy.elements.corner_vertex).transpose(2, 0, 1)).argmin(axis=1)
    assert sorted(order) == list(range(6))
    for name in ("corner distance", "corner ratio"):
        value = RELATIONS[name].value
        assert value(noisy)[order] == pytest.approx(value(clean), abs=4 * deviation)
    walls = np.array([noisy.elements.edge_start[noisy.elements.edge_segment == k][0] for k in range(6)])
    order = np.hypot(*(room[:, None] - walls).transpose(2, 0, 1)).argmin(axis=1)
    # A wall that is turned a little moves the place that is nearest to a far point.
    beside = clean.segment.between & (clean.segment.distance < 1.6)
    assert beside.any(axis=1).all()
    for name, bound in (("segment distance", 4 * deviation), ("segment arc length", 0.02 + 3 * level)):
        value = RELATIONS[name].value
        assert value(noisy)[order][beside] == pytest.approx(value(clean)[beside], abs=bound)
    turned = (SEGMENT_ANGLE.reference(noisy)[order] - SEGMENT_ANGLE.reference(clean))[beside]
    assert np.abs(np.degrees(np.angle(np.exp(1j * turned)))).max() < 2 + 300 * level
