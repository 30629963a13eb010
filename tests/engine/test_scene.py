"""Scenes: names, look-up by place, and what is refused."""

import numpy as np
import pytest
import strategies
from hypothesis import given
from shapes import COURTYARD, HOLED_ROOM, L_ROOM, UNIT_SQUARE, rectangle

from geoanalogy import InputError, Polygon, Scene

ROOM = Polygon(rectangle(4, 3), label="bedroom", id="r1")
BED = Polygon(rectangle(2, 1), label="bed", id="b1")


def test_unnamed_polygons_are_named_without_touching_them():
    unnamed = Polygon(UNIT_SQUARE)
    scene = Scene([unnamed, Polygon(L_ROOM, id="polygon 0"), Polygon(L_ROOM)])
    assert [p.id for p in scene.polygons] == ["polygon 1", "polygon 0", "polygon 2"]
    assert unnamed.id is None
    assert Scene([BED]).polygons[0] is BED


def test_repeated_ids_are_numbered():
    names = ["bed", "bed", "bed.001", "bed", "{}", "{}"]
    scene = Scene([Polygon(UNIT_SQUARE, id=name) for name in names])
    assert [p.id for p in scene.polygons] == ["bed", "bed.002", "bed.001", "bed.003", "{}", "{}.001"]


def test_scenes_of_unnamed_polygons_can_be_joined():
    left, right = Scene([Polygon(UNIT_SQUARE)]), Scene([Polygon(L_ROOM)])
    joined = left.with_polygons(right.polygons)
    assert [p.id for p in joined.polygons] == ["polygon 0", "polygon 0.001"]
    assert len(left) == 1
    assert repr(joined) == "Scene(2 polygons)"


def test_polygon_by_id():
    assert Scene([ROOM, BED]).polygon("b1") is BED
    with pytest.raises(InputError, match="no polygon 'b2'; it has 2 polygons, check the id"):
        Scene([ROOM, BED]).polygon("b2")


def test_a_subset_is_in_the_order_of_the_scene():
    scene = Scene([ROOM, BED, Polygon(UNIT_SQUARE, id="lamp")])
    assert [p.id for p in scene.subset(["lamp", str(ROOM.id), "lamp"])] == [ROOM.id, "lamp"]


@pytest.mark.parametrize(
    ("point", "expected"),
    [((1, 0.5), BED), ((3, 2), ROOM), ((0, 0), BED), ((4, 3), ROOM), ((2, 1), BED), ((4.1, 3), None)],
)
def test_parent_of_a_point_is_the_smallest_polygon(point, expected):
    assert Scene([ROOM, BED]).parent_of(point) is expected


def test_a_point_in_a_hole_is_outside():
    scene = Scene([Polygon(HOLED_ROOM, holes=[COURTYARD])])
    assert scene.parent_of((2, 2)) is None
    assert scene.parent_of((1, 1.5)) is scene.polygons[0]
    assert Scene([]).parent_of((0, 0)) is None


def test_parent_of_a_shape_holds_a_share_of_it():
    scene = Scene([ROOM, BED])
    juts_out = rectangle(1, 1, (1.1, 0))
    assert scene.parent_of_shape(juts_out, 0.95) is ROOM
    assert scene.parent_of_shape(juts_out, 0.85) is BED
    assert scene.parent_of_shape(rectangle(1, 1, (3.5, 0)), 0.95) is None
    assert Scene([]).parent_of_shape(juts_out, 0.95) is None


def test_an_object_with_a_stated_parent_is_no_place():
    counter = Polygon(rectangle(2, 1), id="counter", parent="r1")
    under_it = rectangle(0.5, 0.5)
    assert Scene([ROOM, counter]).parent_of_shape(under_it, 0.95) is ROOM
    sink = Polygon(rectangle(0.2, 0.2), id="sink", parent="counter")
    assert Scene([ROOM, counter, sink]).parent_of_shape(under_it, 0.95) is counter


def test_bounds():
    assert Scene([ROOM, Polygon(rectangle(1, 1, (-2, 7)))]).bounds.tolist() == [-2, 0, 4, 8]
    with pytest.raises(InputError, match="the scene is empty; add polygons first"):
        _ = Scene([]).bounds


def test_only_polygons_make_a_scene():
    with pytest.raises(
        InputError, match=r"made of polygons, not of ndarray; wrap the ring in Polygon\(points, label=…\)"
    ):
        Scene([UNIT_SQUARE])


def test_offset_is_kept():
    scene = Scene([ROOM], offset=(5e6, -3e6))
    assert scene.with_polygons([BED]).offset == (5e6, -3e6)
    assert scene.to_dict() == {"polygons": [ROOM.to_dict()], "offset": [5e6, -3e6]}
    assert Scene([ROOM]).to_dict() == {"polygons": [ROOM.to_dict()]}


@given(strategies.places(reach=5.0), strategies.similarities(scales=(0.5, 2.0)))
def test_parents_of_points_move_with_the_scene(place, similarity):
    on_an_edge = np.abs(np.subtract.outer(place, [0, 1, 2, 3, 4])).min() < 1e-6
    if on_an_edge:
        return
    moved = Scene([Polygon(similarity(p.points), p.label, p.id) for p in (ROOM, BED)])
    before, after = Scene([ROOM, BED]).parent_of(place), moved.parent_of(similarity(place))
    assert (before and before.id) == (after and after.id)
