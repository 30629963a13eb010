"""The table of relationship functions: known values, slopes and invariances (sections 4.3, 4.7, 4.9 and 5.3)."""

import numpy as np
import pytest
import strategies
from hypothesis import given
from hypothesis import strategies as st
from shapes import (
    BAY_ROOM,
    CATALOGUE,
    CIRCLE,
    COURTYARD,
    HOLED_ROOM,
    L_ROOM,
    STAR,
    TEARDROP,
    UNIT_SQUARE,
    rectangle,
    ring,
)

from geoanalogy import Polygon
from geoanalogy.relations.elements import Elements, ElementType
from geoanalogy.relations.extraction import extract, extract_each
from geoanalogy.relations.observation import Observation
from geoanalogy.relations.sighting import Sighting
from geoanalogy.relations.table import (
    BOUNDARY_ANGLE,
    BOX_RELATIONS,
    CENTROID_ANGLE,
    CENTROID_DIRECTION,
    CORNER_ANGLE,
    FIXED_START_ARC_LENGTH,
    POSE_RELATIONS,
    RELATIONS,
    SEGMENT_ANGLE,
    Kind,
)


def observe(outline, *points, frame=0.0, **more):
    polygons = [outline] if isinstance(outline, Polygon) else [Polygon(outline, **more)]
    return Observation(Elements.of(polygons, frame), np.array(points, dtype=float).reshape(-1, 2))


def value(name, outline, *points, **more):
    """Values of a relation, shape (elements, points)."""
    return RELATIONS[name].value(observe(outline, *points, **more))


def degrees(directional, outline, *points):
    return np.degrees(directional.reference(observe(outline, *points))) % 360


# Distances


def test_boundary_distance_inside_outside_and_on_the_boundary():
    points = [(0.25, 0.5), (0.5, 0.5), (2, 0.5), (4, 5), (1, 0.3), (0, 0)]
    assert value("boundary distance", UNIT_SQUARE, *points)[0] == pytest.approx([0.25, 0.5, 1, 5, 0, 0])


def test_boundary_distance_knows_holes_and_reflex_corners():
    holed = Polygon(HOLED_ROOM, holes=[COURTYARD])
    assert value("boundary distance", holed, (2, 2), (2, 2.75), (0.1, 2))[0] == pytest.approx([0.5, 0.25, 0.1])
    assert value("boundary distance", L_ROOM, (3 - 0.3, 2 - 0.4))[0] == pytest.approx([0.5])


def test_segment_distance_per_wall():
    assert value("segment distance", UNIT_SQUARE, (0.25, 0.5), (4, 5)).T == pytest.approx(
        np.array([[0.5, 0.75, 0.5, 0.25], [np.hypot(3, 5), 5, 5, np.hypot(4, 4)]])
    )


def test_segment_distance_to_a_curve():
    distances = value("segment distance", CIRCLE, (0, 0), (5, 0), (0.5, 0))
    assert distances[0] == pytest.approx([2 * np.cos(np.pi / 64), 3, 1.5], abs=5e-3)


def test_corner_distance():
    assert value("corner distance", UNIT_SQUARE, (0.3, 0.4), (1, 0))[:, 0] == pytest.approx(
        np.hypot([0.3, 0.7, 0.7, 0.3], [0.4, 0.4, 0.6, 0.6])
    )
    assert value("corner distance", UNIT_SQUARE, (1, 0))[1] == 0


# Arc lengths


def test_segment_arc_length_is_a_share_that_stops_at_the_ends():
    shares = value("segment arc length", rectangle(4, 3), (1, 1), (-5, 1), (9, -7))
    # Lower wall to the right, right wall up, upper wall to the left, left wall down.
    assert shares.T == pytest.approx(np.array([[0.25, 1 / 3, 0.75, 2 / 3], [0, 1 / 3, 1, 2 / 3], [1, 0, 0, 1]]))


def test_segment_arc_length_along_a_bay():
    # The ring's first vertex is a corner: the smooth run of both long walls and the bay comes first.
    straight_and_bay, left = value("segment arc length", BAY_ROOM, (1, 0.1), (6, 1.5), (1, 2.9))
    length = 6 + 32 * 2 * 1.5 * np.sin(np.pi / 64)
    assert straight_and_bay == pytest.approx([1 / length, 0.5, 1 - 1 / length])
    assert left == pytest.approx([2.9 / 3, 0.5, 0.1 / 3])


def test_closed_segments_wrap_and_open_ones_do_not():
    relation = RELATIONS["segment arc length"]
    assert relation.period(observe(CIRCLE).elements).tolist() == [1]
    assert relation.period(observe(UNIT_SQUARE).elements).tolist() == [np.inf] * 4
    # The teardrop's one segment ends where it starts, but at a corner.
    assert relation.period(observe(TEARDROP).elements).tolist() == [np.inf]


def test_fixed_start_arc_length_runs_once_round_each_ring():
    points = [(0.25, 0.1), (0.9, 0.5), (0.5, 0.9), (0.1, 0.5), (0.1, 0.04)]
    assert value("fixed-start arc length", UNIT_SQUARE, *points)[0] == pytest.approx(
        [0.0625, 0.375, 0.625, 0.875, 0.025]
    )
    # A start in the middle of a smooth segment makes no difference.
    shifted = value("fixed-start arc length", np.roll(BAY_ROOM, -10, axis=0), *points)
    original = value("fixed-start arc length", BAY_ROOM, *points)
    assert np.ptp((original - shifted) % 1) < 1e-9
    assert (shifted >= 0).all()
    assert (shifted < 1).all()


def test_fixed_start_arc_length_of_a_hole_is_its_own_share():
    holed = Polygon(HOLED_ROOM, holes=[COURTYARD])
    start = holed.holes[0][0]
    along = holed.holes[0][1] - start
    assert value("fixed-start arc length", holed, start + along / 2)[0] == pytest.approx(np.hypot(*along) / 2 / 6)
    assert value("fixed-start arc length", holed, (2, 0.1))[0] == pytest.approx(2 / 16)


# Angles


def test_corner_ratio_halves_the_opening():
    # Corner 0 of the square: from the left wall (1 down to the corner) to the lower wall.
    ratios = value("corner ratio", UNIT_SQUARE, (0, 0.5), (0.5, 0.5), (0.5, 0), (-1, -1))
    assert ratios[0] == pytest.approx([0, 0.5, 1, 1.5])


def test_corner_ratio_of_a_reflex_corner():
    # Corner 3 of the L at (3, 2): the opening of 270 degrees runs from the right (the wall that leads there) over the
    # bottom and the left to the top.
    ratios = value("corner ratio", L_ROOM, (4, 2), (3, 1), (2, 1), (2, 2), (3, 3), (4, 3))
    assert ratios[3] == pytest.approx([0, 1 / 3, 0.5, 2 / 3, 1, 1.5])


def test_corner_ratio_wraps_outside():
    just_before, just_after = value("corner ratio", UNIT_SQUARE, (-1e-6, 1), (1e-6, 1))[0]
    assert just_before == pytest.approx(2, abs=1e-5)
    assert just_after == pytest.approx(0, abs=1e-5)


def test_boundary_angle_follows_the_walls():
    # Counter-clockwise: the lower wall runs along x, the interior on its left.
    points = [(0.5, 0.1), (0.9, 0.5), (0.5, 0.9), (0.1, 0.5), (0.5, -3)]
    assert degrees(BOUNDARY_ANGLE, UNIT_SQUARE, *points)[0] == pytest.approx([0, 90, 180, 270, 0])


def test_boundary_angle_turns_steadily_round_a_corner():
    # Outside a convex corner, and inside a reflex one.
    around = [(2, -1e-9), (2, -1), (1, -1), (1 + 1e-9, -1)]
    assert degrees(BOUNDARY_ANGLE, UNIT_SQUARE, *around)[0] == pytest.approx([90, 45, 0, 0], abs=1e-6)
    inside = [(3 - 1e-9, 1.5), (2.6, 1.6), (2.5, 2 - 1e-9)]
    assert degrees(BOUNDARY_ANGLE, L_ROOM, *inside)[0] == pytest.approx([180, 135, 90], abs=1e-6)


def test_boundary_angle_round_a_sharp_tip():
    tip = ring((0, 0), (10, -1), (10, 1))
    # From the upper side, which leads to the tip, round to the lower side that leaves it.
    directions = 90 + 5.71059314 + np.linspace(0, 180 - 2 * 5.71059314, 7)
    points = np.stack([np.cos(np.radians(directions)), np.sin(np.radians(directions))], axis=1)
    assert degrees(BOUNDARY_ANGLE, tip, *points)[0] == pytest.approx(directions + 90, abs=1e-6)


def test_boundary_angle_of_a_hole_has_the_interior_on_its_left():
    holed = Polygon(HOLED_ROOM, holes=[COURTYARD])
    assert degrees(BOUNDARY_ANGLE, holed, (2, 1.3), (2, 2.7))[0] == pytest.approx([180, 0])


def test_segment_angle_keeps_the_wall_beyond_its_ends():
    assert degrees(SEGMENT_ANGLE, UNIT_SQUARE, (-3, -1), (7, 0.5))[0] == pytest.approx([0, 0])


def test_segment_angle_on_a_curve_is_square_to_the_way_there():
    angles = np.radians([3, 100, 211])
    outside = 3 * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    assert degrees(SEGMENT_ANGLE, CIRCLE, *outside)[0] == pytest.approx(np.degrees(angles) + 90, abs=2)
    # Exactly so opposite a vertex.
    assert degrees(SEGMENT_ANGLE, CIRCLE, (5, 0))[0] == pytest.approx([90])


def test_corner_and_centroid_angles():
    assert degrees(CORNER_ANGLE, UNIT_SQUARE, (0.5, 0.5))[:, 0] == pytest.approx([45, 135, 225, 315])
    assert degrees(CENTROID_ANGLE, UNIT_SQUARE, (0.5, -2), (4, 0.5))[0] == pytest.approx([90, 180])


def test_centroid_direction_counts_from_the_main_orientation():
    turned = strategies.Similarity(np.radians(30))
    assert np.degrees(value("centroid direction", rectangle(4, 2), (2, -2))) == pytest.approx(90)
    assert np.degrees(value("centroid direction", turned(rectangle(4, 2)), turned(np.array([(2.0, -2.0)])))) == (
        pytest.approx(90)
    )
    assert np.degrees(value("centroid direction", rectangle(4, 2), (2, -2), orientation=np.pi / 2)) == pytest.approx(0)


# Boxes (chapter 5)


def test_box_coordinates():
    point = (1, 4)
    expected = {
        "box minimum x": 1,
        "box minimum y": 4,
        "box centre x": -1,
        "box centre y": 2.5,
        "box maximum x": -3,
        "box maximum y": 1,
        "box share x": 0.25,
        "box share y": 4 / 3,
    }
    assert {r.name: float(r.value(observe(rectangle(4, 3), point))[0, 0]) for r in BOX_RELATIONS} == pytest.approx(
        expected
    )


def test_boxes_are_taken_in_the_frame():
    turned = strategies.Similarity(np.radians(30), shift=(7.0, -2.0))
    for relation in BOX_RELATIONS:
        straight = relation.value(observe(L_ROOM, (1, 1)))
        assert relation.value(
            observe(turned(L_ROOM), turned(np.array([1.0, 1.0])), frame=np.radians(30))
        ) == pytest.approx(straight)


# The table as a whole


def test_every_relation_has_its_kind_and_a_partner_of_its_own_element():
    assert len(RELATIONS) == 5 + 2 + 8
    for relation in (*POSE_RELATIONS, CENTROID_DIRECTION, FIXED_START_ARC_LENGTH):
        assert relation.directional.element is relation.element
    assert all(r.directional is None for r in BOX_RELATIONS)
    assert {r.name for r in RELATIONS.values() if r.kind is Kind.ANGLE} == {"centroid direction"}


@pytest.mark.parametrize("name", RELATIONS)
def test_shapes_for_several_polygons_and_for_none(name):
    relation = RELATIONS[name]
    for outlines in ([UNIT_SQUARE, CIRCLE, L_ROOM], [CIRCLE], []):
        seen = Observation(Elements.of([Polygon(o) for o in outlines]), np.random.default_rng(0).normal(size=(7, 2)))
        expected = (seen.elements.count(relation.element), 7)
        assert relation.value(seen).shape == expected
        assert relation.slope(seen).shape == expected
        if relation.directional is not None:
            assert relation.directional.reference(seen).shape == expected
        if relation.period is not None:
            assert relation.period(seen.elements).shape == expected[:1]


@pytest.mark.parametrize("name", RELATIONS)
def test_polygons_do_not_see_each_other(name):
    outlines = [UNIT_SQUARE, CIRCLE + 5, L_ROOM, STAR - 3]
    points = np.random.default_rng(1).normal(scale=4, size=(50, 2))
    relation = RELATIONS[name]
    together = relation.value(Observation(Elements.of([Polygon(o) for o in outlines]), points))
    alone = [relation.value(Observation(Elements.of([Polygon(o)]), points)) for o in outlines]
    assert np.array_equal(together, np.concatenate(alone))


def test_inside_counts_the_boundary_and_not_the_hole():
    seen = observe(Polygon(HOLED_ROOM, holes=[COURTYARD]), (0.5, 0.5), (2, 2), (0, 2), (1, 2), (5, 5))
    assert seen.inside.tolist() == [[True, False, True, True, False]]


@pytest.mark.parametrize("outline", [c[1] for c in CATALOGUE], ids=[c[0] for c in CATALOGUE])
@pytest.mark.parametrize("name", RELATIONS)
def test_slope_is_the_length_of_the_gradient(name, outline):
    relation = RELATIONS[name]
    polygon = Polygon(outline)
    low, high = polygon.points.min(axis=0) - 1, polygon.points.max(axis=0) + 1
    points = np.random.default_rng(2).uniform(low, high, size=(400, 2))
    elements = Elements.of([polygon], frame=0.2)

    def at(shift):
        return relation.value(Observation(elements, points + shift))

    h = 1e-6
    middle = at((0, 0))
    period = np.inf if relation.period is None else relation.period(elements)[:, None]
    ahead = [_wrapped(at(step) - middle, period) / h for step in ((h, 0), (0, h))]
    behind = [_wrapped(middle - at(step), period) / h for step in ((-h, 0), (0, -h))]
    # Where the gradient jumps (a medial axis, the end of a segment, the discontinuity of an arc) there is no slope.
    smooth = np.maximum(*(np.abs(a - b) for a, b in zip(ahead, behind, strict=True))) < 1e-2
    if relation.element is ElementType.CORNER:
        smooth &= Observation(elements, points).corner[0] > 0.1
    assert smooth.sum() >= 0.9 * smooth.size
    slope = relation.slope(Observation(elements, points))
    assert slope[smooth] == pytest.approx(np.hypot(*ahead)[smooth], abs=2e-3)
    uphill = relation.uphill(Observation(elements, points))
    up = uphill.real * ahead[0] + uphill.imag * ahead[1]
    assert up[smooth] == pytest.approx(np.hypot(*ahead)[smooth], abs=2e-3)


def test_features_extracted_together_are_those_of_each_polygon():
    """Corners, labels, smooth vertices, holes and stated orientations: what is plain is evaluated all at once."""
    labelled = Polygon(L_ROOM, segment_labels=["door", *[""] * (len(L_ROOM) - 1)], orientation=0.3)
    turned = [
        Polygon(rectangle(3, 2) @ np.array([[np.cos(t), np.sin(t)], [-np.sin(t), np.cos(t)]]) + t) for t in (1, 2)
    ]
    smooth = Polygon([(0, 0), (2, 0), (4, 0.2), (4, 3), (0, 3)])
    others = [Polygon(UNIT_SQUARE, label="a"), Polygon(CIRCLE), Polygon(STAR), Polygon(HOLED_ROOM, holes=[COURTYARD])]
    polygons = [*turned, labelled, smooth, *others]
    found = dict(extract_each(polygons))
    assert list(found) != polygons  # those that are plain come last
    for polygon in polygons:
        alone = extract([polygon])
        assert found[polygon].keys() == alone.keys()
        assert found[polygon].pop("segment_label") == alone.pop("segment_label")
        for name, values in alone.items():
            assert found[polygon][name].shape == values.shape
            assert found[polygon][name] == pytest.approx(values, abs=1e-12), name


@pytest.mark.parametrize("name", [n for n, r in RELATIONS.items() if r not in BOX_RELATIONS])
def test_a_sighting_sees_of_each_pair_what_an_observation_does(name):
    """Of rings with sharp, smooth and reflex vertices and with holes, from inside, outside and the very vertices."""
    relation = RELATIONS[name]
    outlines = [UNIT_SQUARE, CIRCLE + 5, L_ROOM, STAR - 3]
    polygons = [*(Polygon(o) for o in outlines), Polygon(HOLED_ROOM, holes=[COURTYARD])]
    elements = Elements.joined([Elements.of(polygons[:2]), Elements.of(polygons[2:])])
    rng = np.random.default_rng(4)
    points = np.concatenate([rng.normal(scale=4, size=(40, 2)), L_ROOM, STAR - 3])
    seen = Observation(elements, points)
    feature = rng.integers(0, elements.count(relation.element), 300)
    point = rng.integers(0, len(points), 300)
    chosen = elements.take(relation.element, feature)
    one = Sighting(chosen, relation.element, *points[point].T)
    functions = (relation.value, relation.slope, relation.uphill, relation.directional.reference)
    for function in functions:
        expected = np.broadcast_to(function(seen), (len(relation.value(seen)), len(points)))[feature, point]
        assert function(one).shape == (300, 1)
        assert function(one)[:, 0] == pytest.approx(expected, abs=1e-9, nan_ok=True)
    if relation.element is not ElementType.CORNER:
        nearest = "boundary" if relation.element is ElementType.POLYGON else "segment"
        assert np.array_equal(getattr(one, nearest).left[:, 0], getattr(seen, nearest).left[feature, point])


def _wrapped(difference, period):
    """The difference of two values that are equal where a period lies between them (inf: none)."""
    span = np.where(np.isinf(period), 1.0, period)
    return np.where(np.isinf(period), difference, difference - np.round(difference / span) * span)


PLACES = st.lists(strategies.places(), min_size=1, max_size=4).map(np.array)
OUTLINES = st.one_of(strategies.simple_rings(), st.sampled_from([L_ROOM, BAY_ROOM, CIRCLE, STAR, TEARDROP]))


def _clear(outline, points):
    """Whether no point lies where two places of the boundary are equally near, or on a corner or its edges' lines."""
    seen = observe(outline, *points)
    distances = np.sort(seen._edges[1], axis=0)
    ratio = RELATIONS["corner ratio"].value(seen)
    centre = seen.centroid[0]
    return (
        (distances[0] > 1e-4).all()
        and (np.abs(distances[1] - distances[0]) > 1e-6).all()
        and (np.abs(ratio - np.round(ratio)) > 1e-6).all()
        and (centre > 1e-4).all()
        and not _between_two_places(seen)
    )


def _between_two_places(seen):
    """Whether a point has two places that are nearest on one segment: rounding chooses between them."""
    along, distance = seen._edges
    e = seen.elements
    place = e.edge_start[:, None] + (along / e.edge_length[:, None])[..., None] * e.edge_vector[:, None]
    for segment in range(len(e.segment_length)):
        own = e.edge_segment == segment
        tied = distance[own] <= distance[own].min(axis=0) + 1e-6
        first = place[own][tied.argmax(axis=0), np.arange(len(seen.points))]
        if (np.abs(place[own] - first).max(axis=2) > 1e-5)[tied].any():
            return True
    return False


@given(OUTLINES, PLACES, strategies.similarities(scales=(0.2, 5.0)))
def test_relations_follow_similarity_transforms(outline, points, similarity):
    """Lengths scale, shares and angles stay, and reference directions turn with the polygon."""
    k = similarity.scale
    if not _clear(outline, points):
        return
    seen = observe(outline, *points, orientation=0.4, frame=0.1)
    moved = observe(
        similarity(outline), *similarity(points), orientation=0.4 + similarity.angle, frame=0.1 + similarity.angle
    )
    tolerance = 1e-6
    for relation in RELATIONS.values():
        factor = k if relation.kind is Kind.LENGTH else 1.0
        before, after = relation.value(seen), relation.value(moved)
        period = np.inf if relation.period is None else relation.period(seen.elements)[:, None]
        assert np.abs(_wrapped(after - factor * before, period)).max(initial=0) < tolerance * max(1, factor), (
            relation.name
        )
        if relation.directional is not None:
            turned = relation.directional.reference(moved) - relation.directional.reference(seen) - similarity.angle
            if relation.element is not ElementType.SEGMENT:  # of segments the other end may be as near
                assert np.abs(np.exp(1j * turned) - 1).max(initial=0) < 1e-5, relation.directional.name


@given(OUTLINES, PLACES, st.integers(0, 70), st.booleans())
def test_relations_do_not_depend_on_how_the_ring_was_drawn(outline, points, shift, reverse):
    if not _clear(outline, points):
        return
    drawn = np.roll(outline, shift, axis=0)
    drawn = drawn[::-1] if reverse else drawn
    seen, other = observe(outline, *points), observe(drawn, *points)
    for relation in RELATIONS.values():
        if relation is FIXED_START_ARC_LENGTH:
            continue
        before, after = relation.value(seen), relation.value(other)
        if relation.name == "segment arc length" and seen.elements.segment_closed.any():
            before = after = np.zeros(0)  # a smooth ring has no start of its own
        assert sorted(after.ravel()) == pytest.approx(sorted(before.ravel()), abs=1e-9), relation.name


@pytest.mark.parametrize("outline", [UNIT_SQUARE, L_ROOM, STAR], ids=["square", "L", "star"])
def test_edges_out_of_reach_are_never_the_nearest(outline):
    rng = np.random.default_rng(4)
    points, reach = rng.uniform(-1, 3, (200, 2)), rng.uniform(0, 0.5, 200)
    elements = Elements.of([Polygon(outline)]).take(ElementType.POLYGON, np.zeros(200, dtype=np.intp))
    kept = Sighting(elements, ElementType.POLYGON, *points.T).reachable_edges(reach)
    assert 200 < kept.sum() < len(kept)
    fewer = elements.take(ElementType.POLYGON, np.arange(200), kept)
    way = rng.uniform(0, 2 * np.pi, 200)
    there = points + reach[:, None] * np.column_stack([np.cos(way), np.sin(way)])
    before, after = (Sighting(e, ElementType.POLYGON, *there.T).boundary for e in (elements, fewer))
    assert np.array_equal(before.distance, after.distance)
    assert np.array_equal(before.tangent, after.tangent)


@given(OUTLINES, PLACES)
def test_boundary_is_the_nearest_segment(outline, points):
    seen = observe(outline, *points)
    assert np.array_equal(seen.segment.distance.min(axis=0), seen.boundary.distance[0])
    assert (seen.segment.arc <= seen.elements.segment_length[:, None] * (1 + 1e-12)).all()
    assert (value("corner distance", outline, *points) >= seen.boundary.distance - 1e-9).all()
