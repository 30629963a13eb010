"""Polygons: canonical form, measures, and what is refused."""

import numpy as np
import pytest
import shapely
import strategies
from hypothesis import given
from hypothesis import strategies as st
from shapes import BAY_ROOM, BEVELLED_ROOM, CIRCLE, COURTYARD, DOOR, HOLED_ROOM, L_ROOM, UNIT_SQUARE, rectangle

from geoanalogy import InputError, Polygon
from geoanalogy.geometry.polygon import signed_area


def test_ring_is_counter_clockwise_from_its_first_vertex():
    for given_ring in (L_ROOM, np.roll(L_ROOM[::-1], 1, axis=0)):
        assert Polygon(given_ring).points.tolist() == L_ROOM.tolist()
    assert signed_area(L_ROOM) == 16.0
    assert signed_area(L_ROOM[::-1]) == -16.0


def test_arrays_cannot_be_written():
    polygon = Polygon(HOLED_ROOM, holes=[COURTYARD])
    for ring in polygon.rings:
        with pytest.raises(ValueError, match="read-only"):
            ring[0] = 0.0


@given(strategies.with_repeated_vertices())
def test_repeated_vertices_change_nothing(pair):
    outline, repeated = pair
    assert np.array_equal(Polygon(repeated).points, Polygon(outline).points)


@given(strategies.simple_rings(), st.data())
def test_edges_keep_their_labels(outline, data):
    labels = [f"wall {i}" for i in range(len(outline))]
    repeats = data.draw(st.lists(st.integers(1, 3), min_size=len(outline), max_size=len(outline)))
    # A repeated vertex adds edges without length before the edge that leaves it.
    long_labels = [
        name for label, count in zip(labels, repeats, strict=True) for name in ["none"] * (count - 1) + [label]
    ]
    repeated = np.repeat(outline, repeats, axis=0)
    plain = Polygon(outline, segment_labels=labels)
    assert Polygon(repeated, segment_labels=long_labels).segment_labels == plain.segment_labels
    closed = np.vstack([repeated, repeated[:1]])
    assert Polygon(closed, segment_labels=long_labels).segment_labels == plain.segment_labels
    assert Polygon(closed, segment_labels=[*long_labels, "none"]).segment_labels == plain.segment_labels


@given(strategies.simple_rings())
def test_turned_round_every_edge_keeps_its_label(outline):
    def edges(polygon):
        ends = np.roll(polygon.points, -1, axis=0)
        return {
            frozenset([tuple(a), tuple(b)]): label
            for a, b, label in zip(polygon.points, ends, polygon.segment_labels, strict=True)
        }

    labels = [str(i) for i in range(len(outline))]
    turned = Polygon(outline[::-1], segment_labels=labels[-2::-1] + labels[-1:])
    assert edges(turned) == edges(Polygon(outline, segment_labels=labels))


def test_measures():
    room = Polygon(HOLED_ROOM, holes=[COURTYARD])
    assert room.area == 14.0
    assert room.size == np.sqrt(14.0)
    assert signed_area(room.holes[0]) == -2.0
    assert room.holes[0].tolist() == [[1, 1.5], [1, 2.5], [3, 2.5], [3, 1.5]]
    assert room.bounds.tolist() == [0.0, 0.0, 4.0, 4.0]
    assert room.centroid == pytest.approx([2.0, 2.0])
    assert Polygon(rectangle(4, 2)).inscribed_radius == pytest.approx(1.0, rel=0.01)
    assert Polygon(rectangle(4, 3)).enclosing_radius == pytest.approx(2.5)
    # Centres of the parts 5 by 2 and 3 by 2, weighted 10 to 6.
    assert Polygon(L_ROOM).centroid == pytest.approx([(10 * 2.5 + 6 * 1.5) / 16, (10 * 1 + 6 * 3) / 16])


@given(strategies.rings(), strategies.similarities(mirrored=True))
def test_measures_follow_similarity_transforms(outline, similarity):
    polygon, moved = Polygon(outline), Polygon(similarity(outline))
    k = similarity.scale
    assert moved.area == pytest.approx(k * k * polygon.area, rel=1e-6)
    assert moved.centroid == pytest.approx(similarity(polygon.centroid), abs=1e-6 * max(1, k))
    assert moved.enclosing_radius == pytest.approx(k * polygon.enclosing_radius, rel=1e-6)


@pytest.mark.parametrize("degrees", [-40, -10, 0, 3, 30, 44])
@pytest.mark.parametrize(
    "outline", [rectangle(4, 3), L_ROOM, BEVELLED_ROOM, BAY_ROOM], ids=["rect", "L", "bevel", "bay"]
)
def test_main_orientation_turns_with_the_polygon(outline, degrees):
    turned = strategies.Similarity(np.radians(degrees))(outline)
    assert np.degrees(Polygon(turned).main_orientation) == pytest.approx(degrees, abs=0.5)


def test_main_orientation_stated_or_without_preference():
    assert Polygon(rectangle(4, 3), orientation=1.25).main_orientation == 1.25
    assert Polygon(strategies.Similarity(0.3)(CIRCLE)).main_orientation == 0.0


@pytest.mark.parametrize(
    ("points", "message"),
    [
        ([], r"shape \(0,\); give vertices as an array of shape \(n, 2\)"),
        (None, r"shape \(\)|not numbers|not finite"),
        ("abc", "coordinates that are not numbers"),
        ([(0, 0), (1, 0), (1,)], "coordinates that are not numbers"),
        ([(0, 0), (10**400, 0), (0, 1)], "coordinates that are not numbers"),
        ([(0, 0, 0), (1, 0, 0), (1, 1, 0)], r"shape \(3, 3\)"),
        ([(0, 0), (1, 0)], "2 distinct vertices; a polygon needs at least three"),
        ([(1, 1)] * 5, "1 distinct vertex; a polygon needs at least three"),
        ([(0, 0), (1, 0), (1, np.nan)], r"not finite \(NaN or infinity\); correct or delete that vertex"),
        ([(0, 0), (1, 0), (1, np.inf)], "not finite"),
        ([(0, 0), (2e9, 0), (2e9, 2e9)], r"more than 1e\+09 units from the origin; move the scene near the origin"),
        ([(0, 0), (1, 0), (2, 0)], "no area; give a ring that encloses one"),
        (
            [(0, 0), (2, 2), (2, 0), (0, 3)],
            r"crosses or touches itself near x 1\.2, y 1\.2; redraw it as a simple ring",
        ),
        ([(0, 0), (4, 0), (4, 2), (2, 0), (0, 2)], "crosses or touches itself near x 2, y 0"),
    ],
)
def test_rings_that_are_refused(points, message):
    with pytest.raises(InputError, match=message):
        Polygon(points, label="room", id="r1")


def test_messages_name_the_polygon():
    with pytest.raises(InputError, match=r"^polygon 'r1' has no area"):
        Polygon([(0, 0), (1, 0), (2, 0)], id="r1")
    with pytest.raises(InputError, match=r"^a polygon labelled 'room' has no area"):
        Polygon([(0, 0), (1, 0), (2, 0)], label="room")
    with pytest.raises(InputError, match=r"^hole 0 of polygon 'r1' has no area"):
        Polygon(UNIT_SQUARE, id="r1", holes=[[(0, 0), (1, 0), (2, 0)]])


def test_loops_that_cancel_out_cross_and_are_no_line():
    with pytest.raises(InputError, match="crosses or touches itself near x 1, y 1"):
        Polygon([(0, 0), (2, 2), (2, 0), (0, 2)])


@pytest.mark.parametrize(
    "holes",
    [[rectangle(1, 1, (5, 5))], [rectangle(2, 2, (3, 3))], [COURTYARD, rectangle(1, 1, (1.5, 2))], [HOLED_ROOM]],
    ids=["outside", "across", "overlapping", "everything"],
)
def test_holes_that_are_refused(holes):
    with pytest.raises(
        InputError, match="hole that leaves its outline or meets another hole; move or delete that hole"
    ):
        Polygon(HOLED_ROOM, holes=holes)


@pytest.mark.parametrize("count", [3, 6])
def test_wrong_number_of_segment_labels(count):
    with pytest.raises(InputError, match=f"{count} segment labels for 4 edges; give one per edge"):
        Polygon(UNIT_SQUARE, segment_labels=["wall"] * count)


@pytest.mark.parametrize("orientation", [np.nan, np.inf])
def test_orientation_must_be_finite(orientation):
    with pytest.raises(
        InputError, match=r"the orientation (nan|inf), which is not finite; give radians or leave it out"
    ):
        Polygon(UNIT_SQUARE, orientation=orientation)


def test_label_is_text_and_may_be_missing():
    assert Polygon(UNIT_SQUARE).label == ""
    assert Polygon(UNIT_SQUARE, label=None).label == ""
    assert Polygon(UNIT_SQUARE, label=0).label == "0"


@given(strategies.rings(), strategies.similarities())
def test_plain_data_makes_the_same_polygon(outline, similarity):
    labels = ["door", *[""] * (len(outline) - 1)]
    polygon = Polygon(similarity(outline), "room", "r1", parent="flat", orientation=0.5, segment_labels=labels)
    again = Polygon(**polygon.to_dict())
    assert np.array_equal(again.points, polygon.points)
    assert again.to_dict() == polygon.to_dict()


def test_plain_data_leaves_defaults_out():
    assert Polygon(DOOR, label="door").to_dict() == {"points": DOOR.tolist(), "label": "door", "id": None}


@given(strategies.rings())
def test_shape_is_the_polygon(outline):
    polygon = Polygon(outline)
    assert shapely.area(polygon.shape) == pytest.approx(polygon.area, rel=1e-9)
    assert repr(polygon) == f"Polygon({len(polygon.points)} vertices, label='', id=None)"
