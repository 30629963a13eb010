"""The weighted straight skeleton: areas, ridges, events, random outlines."""

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapes import rectangle, regular, ring
from strategies import simple_rings

from geoanalogy import InputError
from geoanalogy.geometry.polygon import signed_area
from geoanalogy.geometry.roof import Roof, gable_edges
from geoanalogy.geometry.skeleton import straight_skeleton

L_SHAPE = ring((0, 0), (10, 0), (10, 6), (5, 6), (5, 12), (0, 12))
T_SHAPE = ring((0, 0), (4, 0), (4, 4), (8, 4), (8, 0), (12, 0), (12, 8), (0, 8))
CROSS = ring((1, 0), (2, 0), (2, 1), (3, 1), (3, 2), (2, 2), (2, 3), (1, 3), (1, 2), (0, 2), (0, 1), (1, 1))
COURT = [rectangle(10, 10), rectangle(2, 2, (4, 4))[::-1]]


def swept(skeleton):
    """Area of all faces and of what is left, in plan."""
    loops = [loop for _, _, loops in skeleton.faces for loop in loops] + skeleton.tops
    return sum(signed_area(skeleton.points[loop]) for loop in loops)


def test_the_ridge_of_a_rectangle_is_where_it_must_be():
    skeleton = straight_skeleton([rectangle(10, 6)])
    assert skeleton.times.max() == pytest.approx(3)
    top = skeleton.points[skeleton.times > 2.9]
    assert sorted(map(tuple, np.round(top, 9))) == [(3.0, 3.0), (7.0, 3.0)]
    areas = [signed_area(skeleton.points[loops[0]]) for _, _, loops in skeleton.faces]
    assert areas == pytest.approx([21, 9, 21, 9])


def test_a_square_and_a_cross_fold_up_at_one_moment():
    assert len(straight_skeleton([rectangle(6, 6)]).points) == 5
    cross = straight_skeleton([CROSS])
    assert cross.times.max() == pytest.approx(0.5) and len(cross.points) == 12 + 5
    round_ = straight_skeleton([regular(24)])
    assert len(round_.points) == 25


@pytest.mark.parametrize("rings", [[L_SHAPE], [T_SHAPE], [CROSS], COURT, [regular(7, 3.0)]])
def test_the_faces_cover_the_outline(rings):
    whole = shapely.Polygon(rings[0], rings[1:]).area
    assert swept(straight_skeleton(rings)) == pytest.approx(whole)
    stopped = straight_skeleton(rings, stop=0.3)
    assert swept(stopped) == pytest.approx(whole) and stopped.times.max() == pytest.approx(0.3)
    left = sum(signed_area(stopped.points[loop]) for loop in stopped.tops)
    assert left == pytest.approx(shapely.Polygon(rings[0], rings[1:]).buffer(-0.3, join_style="mitre").area)


def test_a_hole_and_its_outline_meet_half_way():
    skeleton = straight_skeleton(COURT)
    assert skeleton.times.max() == pytest.approx(2.0)


def test_marks_divide_faces():
    skeleton = straight_skeleton([rectangle(10, 6)], marks=[1.0])
    stages = {stage: [edge for edge, s, _ in skeleton.faces if s == stage] for stage in (0, 1)}
    assert stages == {0: [0, 1, 2, 3], 1: [0, 1, 2, 3]}
    assert swept(skeleton) == pytest.approx(60)


def test_edges_that_stay_carry_gables():
    skeleton = straight_skeleton([rectangle(10, 6)], np.array([1.0, 0.0, 1.0, 0.0]))
    top = skeleton.points[skeleton.times > 2.9]
    assert sorted(map(tuple, np.round(top, 9))) == [(0.0, 3.0), (10.0, 3.0)]
    assert swept(skeleton) == pytest.approx(60)


def test_different_speeds_move_the_ridge():
    skeleton = straight_skeleton([rectangle(10, 6)], np.array([2.0, 1.0, 1.0, 1.0]))
    assert skeleton.points[skeleton.times.argmax()][1] == pytest.approx(4.0)


def test_a_skeleton_that_cannot_close_says_so():
    with pytest.raises(InputError, match="the roof does not close; give fewer gables or another pitch"):
        straight_skeleton([rectangle(10, 6)], np.zeros(4))


@given(simple_rings(14))
@settings(max_examples=60, deadline=None)
def test_the_faces_of_any_outline_cover_it(outline):
    skeleton = straight_skeleton([outline])
    assert swept(skeleton) == pytest.approx(signed_area(outline), rel=1e-6)
    assert (skeleton.times >= 0).all()


@given(st.lists(st.tuples(*(st.integers(0, 8),) * 2, *(st.integers(2, 7),) * 2), min_size=1, max_size=5))
@settings(max_examples=60, deadline=None)
def test_the_faces_of_right_angled_outlines_cover_them(boxes):
    union = shapely.union_all([shapely.box(x, y, x + w, y + h) for x, y, w, h in boxes])
    for part in shapely.get_parts(union):
        plain = shapely.orient_polygons(shapely.simplify(part, 0.0))
        rings = [shapely.get_coordinates(r)[:-1] for r in (plain.exterior, *plain.interiors)]
        if len({tuple(p) for r in rings for p in r}) < sum(map(len, rings)):
            continue  # boxes that touch in a corner
        assert swept(straight_skeleton(rings)) == pytest.approx(plain.area)


def test_gables_stand_on_the_narrow_ends():
    assert gable_edges([rectangle(10, 6)]).tolist() == [False, True, False, True]
    assert gable_edges([rectangle(6, 6)]).sum() == 2
    assert gable_edges([L_SHAPE]).tolist() == [False, True, False, False, True, False]
    assert gable_edges([regular(8)]).sum() == 0


def test_heights_of_a_mansard_break():
    roof = Roof("mansard", np.radians(45.0), np.radians(60.0), break_height=np.sqrt(3.0))
    assert roof.turn == pytest.approx(1.0)
    assert roof.heights(np.array([0.0, 0.5, 1.0, 2.0])) == pytest.approx(
        [0, np.sqrt(3) / 2, np.sqrt(3), np.sqrt(3) + 1]
    )
    assert Roof("hip", np.radians(45.0), rise=2.0).stop == pytest.approx(2.0)
    assert Roof("mansard", np.radians(45.0), np.radians(60.0), np.sqrt(3.0), rise=np.sqrt(3) + 1).stop == pytest.approx(
        2
    )


@pytest.mark.parametrize(
    ("settings_", "message"),
    [
        ({"pitch": 0.0}, "the roof's pitch is 0 radians; give an angle between 0 and a quarter turn"),
        ({"lower_pitch": 1.6}, "the roof's lower pitch is 1.6 radians; give an angle between 0 and a quarter turn"),
        ({"break_height": -1.0}, "the roof's break height is -1; give a positive length"),
        ({"rise": 0.0}, "the roof's rise is 0; give a positive length"),
        ({"overhang": -0.5}, "the roof's overhang is -0.5; give 0 or a positive length"),
    ],
)
def test_a_roof_that_cannot_be_is_refused(settings_, message):
    with pytest.raises(InputError, match=message):
        Roof("hip", **settings_)
