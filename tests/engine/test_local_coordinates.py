"""Local coordinate systems (section 4.7): exact inverses, correspondences, and groups taken to other polygons."""

import numpy as np
import pytest
import shapely
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from shapes import BAY_ROOM, BEVELLED_ROOM, CATALOGUE, CIRCLE, L_ROOM, STAR, UNIT_SQUARE, rectangle, regular, ring, star
from strategies import numbers, rings, similarities

from geoanalogy import InputError, Polygon, Pose, Scene
from geoanalogy.poses.correspondence import corresponding_arcs
from geoanalogy.poses.group_transfer import GroupObject, GroupTransfer
from geoanalogy.poses.local_coordinates import BoundarySystem, CornerSystem, Located
from geoanalogy.poses.local_mapping import LocalMapping, TransferOptions

LEAF = ring((-0.1, -0.05), (0.1, -0.05), (0.1, 0.05), (-0.1, 0.05))


def some_points(outline, seed=0, count=60, margin=0.3):
    """Points in and around a ring."""
    low, high = outline.min(axis=0) - margin, outline.max(axis=0) + margin
    return np.random.default_rng(seed).uniform(low, high, (count, 2))


def inside_of(polygon, points):
    return points[shapely.contains_xy(polygon.shape, *points.T)]


def moved(outline, by):
    return np.asarray(outline) + np.array(by)


def mapped(source, target, points, **options):
    return LocalMapping(Polygon(source, id="a"), Polygon(target, id="b"), TransferOptions(**options)).map(points)


# ------------------------------------------------------------------------------------------------ coordinates


def test_coordinates_in_a_square():
    system = BoundarySystem(Polygon(UNIT_SQUARE))
    at = system.locate([(0.5, 0.1), (0.9, 0.4), (0.3, -0.2)])
    assert at.arc == pytest.approx([0.5, 1.4, 0.3])
    assert at.distance == pytest.approx([0.1, 0.1, -0.2])


def test_points_are_built_on_the_inner_normal():
    system = BoundarySystem(Polygon(rectangle(4, 2)))
    at = Located(np.array([1.0, 4.5, 11.0]), np.array([0.5, 0.25, -0.5]), np.full(3, 0.5))
    assert system.points(at) == pytest.approx(np.array([(1, 0.5), (3.75, 0.5), (-0.5, 1)]))


def test_behind_a_reflex_corner_the_fan_is_told_apart():
    system = BoundarySystem(Polygon(L_ROOM))
    corner = np.array([3.0, 2.0])
    fan = corner + 0.5 * np.array([(np.cos(a), np.sin(a)) for a in np.radians([180, 225, 270])])
    at = system.locate(fan)
    assert at.arc == pytest.approx([9, 9, 9])
    assert at.distance == pytest.approx([0.5, 0.5, 0.5])
    assert system.points(at) == pytest.approx(fan)
    assert at.share[1] == pytest.approx(0.5)


def test_the_medial_axis_of_a_rectangle():
    system = BoundarySystem(Polygon(rectangle(4, 2)))
    depth = system.depth(np.array([0.0, 0.5, 2.0, 5.0]), np.full(4, 0.5))
    assert depth == pytest.approx([0, 0.5, 1.0, 1.0], abs=1e-5)


def test_beyond_the_medial_axis_nothing_is_reached():
    system = BoundarySystem(Polygon(rectangle(4, 2)))
    at = Located(np.array([0.5, 0.5, 2.0]), np.array([0.4, 0.6, -3.0]), np.full(3, 0.5))
    assert system.reached(at).tolist() == [True, False, True]


@given(rings(), st.integers(0, 100))
@settings(max_examples=60, deadline=None)
def test_the_boundarys_coordinates_determine_the_point(outline, seed):
    system = BoundarySystem(Polygon(outline))
    points = some_points(outline, seed)
    at = system.locate(points)
    assert system.points(at) == pytest.approx(points, abs=1e-6)
    assert system.reached(at).all()


@given(rings(), st.integers(0, 100))
@settings(max_examples=60, deadline=None)
def test_the_corners_coordinates_determine_the_point(outline, seed):
    polygon = Polygon(outline)
    count = len(BoundarySystem(polygon).corner_arcs)
    assume(count)  # a circle has none
    system = CornerSystem(polygon, seed % count)
    points = some_points(outline, seed)
    assert system.points(*system.locate(points)) == pytest.approx(points, abs=1e-6)


def test_a_corner_that_is_not_there_is_refused():
    with pytest.raises(InputError, match="polygon 'a' has no corner 4; it has 4, counted from 0"):
        CornerSystem(Polygon(UNIT_SQUARE, id="a"), 4)


# ------------------------------------------------------------------------------------------------ correspondences


def test_corners_correspond_by_their_shape_however_the_ring_is_turned_and_numbered():
    for angle in np.linspace(0, 6, 7):
        c, s = np.cos(angle), np.sin(angle)
        turned = np.roll(L_ROOM @ np.array([[c, s], [-s, c]]), 2, axis=0)
        source, target = BoundarySystem(Polygon(L_ROOM)), BoundarySystem(Polygon(turned))
        own, other = corresponding_arcs(source, target, corners=True)
        assert source.places(own) @ np.array([[c, s], [-s, c]]) == pytest.approx(target.places(other))


def test_of_equal_shapes_the_orientation_decides():
    source = BoundarySystem(Polygon(UNIT_SQUARE, orientation=0.0))
    for quarter in range(4):
        target = BoundarySystem(Polygon(UNIT_SQUARE, orientation=quarter * np.pi / 2))
        other = corresponding_arcs(source, target, corners=True)[1]
        assert other == pytest.approx((np.arange(4) + quarter) % 4)


def test_a_stated_orientation_decides_against_the_shape():
    source = BoundarySystem(Polygon(L_ROOM, orientation=0.0))
    target = BoundarySystem(Polygon(L_ROOM, orientation=np.pi))
    assert not np.allclose(*corresponding_arcs(source, target, corners=True))


def test_polygons_of_different_numbers_of_corners_share_one_start():
    own, other = corresponding_arcs(BoundarySystem(Polygon(L_ROOM)), BoundarySystem(Polygon(BEVELLED_ROOM)), True)
    assert len(own) == len(other) == 1


def test_round_polygons_start_where_their_main_orientation_points():
    source = BoundarySystem(Polygon(CIRCLE, orientation=0.0))
    target = BoundarySystem(Polygon(CIRCLE, orientation=np.pi / 2))
    own, other = corresponding_arcs(source, target, corners=True)
    assert source.places(own)[0] == pytest.approx((2, 0))
    assert target.places(other)[0] == pytest.approx((0, 2), abs=1e-9)


# ------------------------------------------------------------------------------------------------ mappings


@pytest.mark.parametrize("distance", ["inscribed", "absolute", "depth"])
@pytest.mark.parametrize(("name", "outline"), [(name, outline) for name, outline, _, _ in CATALOGUE])
def test_a_polygon_is_mapped_onto_itself_by_the_identity(name, outline, distance):
    points = some_points(outline)
    to = mapped(outline, outline, points, distance=distance)
    assert to.points == pytest.approx(points, abs=1e-6)
    assert to.turn == pytest.approx(np.zeros(len(points)), abs=1e-6)
    assert to.reached.all()


@given(similarities(), st.sampled_from(["inscribed", "depth"]))
@settings(max_examples=30, deadline=None)
def test_a_pattern_follows_a_rotated_moved_and_scaled_copy(move, distance):
    points = inside_of(Polygon(L_ROOM), some_points(L_ROOM))
    to = mapped(L_ROOM, move(L_ROOM), points, distance=distance)
    assert to.points == pytest.approx(move(points), abs=1e-4 * move.scale)
    assert np.exp(1j * to.turn) == pytest.approx(np.full(len(points), np.exp(1j * move.angle)))


@given(similarities(scales=(1.0, 1.0)))
@settings(max_examples=30, deadline=None)
def test_corner_coordinates_follow_a_rotated_copy(move):
    points = some_points(BEVELLED_ROOM)
    to = mapped(BEVELLED_ROOM, move(BEVELLED_ROOM), points, system="corner", distance="absolute")
    assert to.points == pytest.approx(move(points), abs=1e-6)
    assert np.exp(1j * to.turn) == pytest.approx(np.full(len(points), np.exp(1j * move.angle)))


def test_the_printed_mapping_keeps_the_distance_and_the_share_of_the_perimeter():
    to = mapped(rectangle(4, 2), rectangle(8, 4), [(1.0, 0.5)], distance="absolute", corners=False)
    assert to.points == pytest.approx(np.array([(2.0, 0.5)]))


def test_from_corner_to_corner_the_sides_correspond():
    points = [(1.0, 0.1), (3.9, 1.0), (2.0, 1.9), (0.1, 1.5)]
    source, target = Polygon(rectangle(4, 2), orientation=0.0), Polygon(rectangle(4, 10), orientation=0.0)
    to, arc = (LocalMapping(source, target, TransferOptions(distance="absolute", corners=c)) for c in (True, False))
    assert to.map(points).points == pytest.approx(np.array([(1.0, 0.1), (3.9, 5.0), (2.0, 9.9), (0.1, 7.5)]))
    assert arc.map(points).points[1] == pytest.approx((3.9, 5 * 28 / 12 - 4))


def test_without_a_stated_orientation_the_long_side_corresponds_to_the_long_side():
    to = mapped(rectangle(4, 2), rectangle(4, 10), [(2.0, 0.1)], distance="absolute")
    assert to.points[0] in (pytest.approx((3.9, 5.0)), pytest.approx((0.1, 5.0)))


def test_a_pattern_fits_a_bed_of_another_size():
    to = mapped(rectangle(4, 4), rectangle(2, 2), [(2.0, 1.0)])
    assert to.points == pytest.approx(np.array([(1.0, 0.5)]), abs=1e-4)


def test_what_a_narrow_bed_has_no_room_for_ends_on_its_medial_axis():
    to = mapped(rectangle(4, 4), rectangle(4, 1), [(2.0, 1.0), (2.0, 0.25)], distance="absolute")
    assert to.reached.tolist() == [False, True]
    assert to.points == pytest.approx(np.array([(2.0, 0.5), (2.0, 0.25)]), abs=1e-6)


@st.composite
def convex_rings(draw):
    """Convex rings of three to six corners, none of them smooth."""
    count = draw(st.integers(3, 6))
    gaps = np.array(draw(st.lists(numbers(0.6, 1.0), min_size=count, max_size=count)))
    angles = np.cumsum(gaps) * 2 * np.pi / gaps.sum()
    return draw(numbers(0.5, 5.0)) * np.stack([np.cos(angles), np.sin(angles)], axis=1)


@given(convex_rings(), convex_rings(), st.integers(0, 100), st.booleans())
@settings(max_examples=60, deadline=None)
def test_convex_interiors_are_mapped_onto_each_other_and_back(one, other, seed, corners):
    source, target = Polygon(one, id="a"), Polygon(other, id="b")
    mapping = LocalMapping(source, target, TransferOptions(distance="depth", corners=corners))
    points = inside_of(source, some_points(one, seed))
    to = mapping.map(points)
    assert to.reached.all()
    assert shapely.dwithin(target.shape, shapely.points(to.points), 1e-6).all()
    # Next to the medial axis and to a vertex rounding decides which side a point is nearest to.
    at = mapping.target.locate(to.points)
    depth = mapping.target.depth(at.arc, at.share)
    sure = (at.distance < 0.999 * depth) & (depth > 1e-3)
    assert mapping.inverse().map(to.points[sure]).points == pytest.approx(points[sure], abs=1e-4)


@given(st.lists(numbers(0.5, 2.0), min_size=2, max_size=2), st.integers(0, 100))
@settings(max_examples=30, deadline=None)
def test_star_shaped_beds_are_mapped_ray_by_ray(sizes, seed):
    source, target = (Polygon(star(5, size, 0.4 * size), id=str(i)) for i, size in enumerate(sizes))
    points = inside_of(source, some_points(source.points, seed))
    mapping = LocalMapping(source, target)
    to = mapping.map(points)
    assert to.points == pytest.approx(points * sizes[1] / sizes[0], abs=1e-4)
    assert mapping.inverse().map(to.points).points == pytest.approx(points, abs=1e-4)


def test_a_fat_star_takes_the_pattern_of_a_slim_one_into_its_own_rays():
    slim, fat = star(5, 1.0, 0.4), star(5, 1.0, 0.7)
    points = inside_of(Polygon(slim), some_points(slim, count=300))
    to = mapped(slim, fat, points, distance="depth")
    assert to.reached.all()
    ray = [np.round(np.arctan2(p[:, 1], p[:, 0]) / (2 * np.pi / 5)) % 5 for p in (points, to.points)]
    assert (ray[0] == ray[1]).mean() > 0.97


def test_starts_given_by_hand_decide_what_corresponds():
    source, target = Polygon(rectangle(2, 2), id="a"), Polygon(rectangle(2, 2, (5, 0)), id="b")
    options = TransferOptions(distance="absolute", start=(0.0, 0.0), starts={"b": (7.0, 0.0)})
    mapping = LocalMapping(source, target, options)
    to = mapping.map([(0.5, 0.2)])
    assert to.points == pytest.approx(np.array([(6.8, 0.5)]))
    assert to.turn == pytest.approx([np.pi / 2])
    other = LocalMapping(source, Polygon(rectangle(2, 2, (5, 0)), id="c"), options)
    assert other.map([(0.5, 0.2)]).points == pytest.approx(np.array([(5.5, 0.2)]))


def test_starts_given_on_round_beds():
    source, target = Polygon(CIRCLE, id="a"), Polygon(moved(CIRCLE, (9, 0)), id="b")
    options = TransferOptions(start=(2.0, 0.0), starts={"b": (9.0, 2.0)})
    to = LocalMapping(source, target, options).map([(1.5, 0.01)])
    assert to.points == pytest.approx(np.array([(9.0, 1.5)]), abs=0.05)


def test_the_corner_nearest_to_the_group_is_the_origin_unless_one_is_chosen():
    source, target = Polygon(rectangle(4, 4), id="a"), Polygon(rectangle(6, 6), id="b")
    options = TransferOptions(system="corner", distance="absolute")
    near = LocalMapping(source, target, options, near=(3.5, 3.5)).map([(3.5, 3.0)])
    assert near.points == pytest.approx(np.array([(5.5, 5.0)]))
    options = TransferOptions(system="corner", distance="absolute", corner=0)
    assert LocalMapping(source, target, options).map([(3.5, 3.0)]).points == pytest.approx(np.array([(3.5, 3.0)]))


def test_a_corner_corresponds_to_the_likest_one_where_their_numbers_differ():
    options = TransferOptions(system="corner", distance="absolute")
    mapping = LocalMapping(Polygon(rectangle(4, 3)), Polygon(BEVELLED_ROOM), options, near=(0.5, 2.5))
    assert mapping.map([(0.5, 2.5)]).points == pytest.approx(np.array([(0.5, 2.5)]))


def test_what_leaves_the_target_is_not_reached_by_corner_coordinates():
    to = mapped(
        rectangle(4, 4), rectangle(2, 2), [(1.0, 1.0), (3.0, 1.0)], system="corner", distance="absolute", corner=0
    )
    assert to.reached.tolist() == [True, False]


def test_directions_keep_their_angle_to_the_boundary():
    mapping = LocalMapping(Polygon(rectangle(4, 2), id="a"), Polygon(regular(4, 2.0, (9, 9)), id="b"))
    pose, reached = mapping.pose(Pose((2.0, 0.1), 0.3, mirrored=True))
    system = BoundarySystem(Polygon(regular(4, 2.0, (9, 9))))
    at = system.locate([pose.position])
    assert reached and pose.mirrored
    assert np.exp(1j * (pose.angle - system.tangent(at.arc, at.share)[0])) == pytest.approx(np.exp(0.3j))


@pytest.mark.parametrize("system", ["boundary", "corner"])
def test_a_mapping_and_its_inverse_undo_each_other(system):
    options = TransferOptions(system=system, distance="absolute")
    mapping = LocalMapping(Polygon(L_ROOM), Polygon(L_ROOM * (1.4, 1.2)), options)
    points = some_points(L_ROOM, margin=0.0)
    to = mapping.map(points)
    kept = to.reached
    assert kept.sum() > 20
    assert mapping.inverse().map(to.points[kept]).points == pytest.approx(points[kept], abs=1e-6)


# ------------------------------------------------------------------------------------------------ groups


def beds():
    return [
        Polygon(BAY_ROOM, label="bed", id="bed 1"),
        Polygon(moved(BAY_ROOM, (10, 0)), label="bed", id="bed 2"),
        Polygon(moved(STAR, (0, 9)), label="bed", id="bed 3"),
        Polygon(rectangle(2, 2, (20, 0)), label="path", id="path"),
    ]


FLOWERS = [
    GroupObject(Pose((0.5, 0.3), 0.2), LEAF),
    GroupObject(Pose((3.8, 1.5), 1.0), None),
    GroupObject(Pose((1.0, 2.8), -1.0, mirrored=True), LEAF),
]


@pytest.mark.parametrize("shape", ["rigid", "outline"])
def test_a_group_is_taken_to_every_polygon_of_its_label(shape):
    scene = Scene(beds())
    group = GroupTransfer(scene.polygon("bed 1"), FLOWERS, TransferOptions(shape=shape))
    moved = group.place(scene)
    assert [(m.parent.id, m.index) for m in moved] == [(f"bed {b}", i) for b in (2, 3) for i in range(3)]
    for m, o in zip(moved, FLOWERS, strict=False):
        assert m.pose.position == pytest.approx((o.pose.position[0] + 10, o.pose.position[1]), abs=1e-4)
        assert m.pose.angle == pytest.approx(o.pose.angle) and m.pose.mirrored == o.pose.mirrored
        assert (m.footprint is None) == (o.footprint is None)
        if o.footprint is not None:
            same = LEAF if shape == "rigid" else group.outlines[m.index]
            assert m.footprint == pytest.approx(same, abs=1e-4)
        assert m.reached


def test_an_outline_is_bent_with_its_bed():
    straight, bent = Polygon(rectangle(20, 2), label="bed", id="a"), Polygon(CIRCLE, label="bed", id="b")
    hedge = rectangle(8, 0.4, (-4, -0.2))
    group = [GroupObject(Pose((10.0, 0.5)), hedge)]
    rigid, outline = (
        GroupTransfer(straight, group, TransferOptions(shape=s, distance="absolute")) for s in ("rigid", "outline")
    )
    assert rigid.to(bent)[0].footprint == pytest.approx(hedge)
    (found,) = outline.to(bent)
    away = np.hypot(*found.pose.to_scene(found.footprint).T)
    # Its long sides are arcs, though only their ends were given.
    assert len(away) > 30
    assert away == pytest.approx(2 - np.interp(outline.outlines[0][:, 1], (-0.2, 0.2), (0.3, 0.7)), abs=0.01)


def test_an_outline_that_comes_apart_is_not_reached():
    source, target = Polygon(rectangle(6, 6), label="bed", id="a"), Polygon(rectangle(6, 1), label="bed", id="b")
    rug = ring((-1, -1), (1, -1), (1, 1), (-1, 1))
    options = TransferOptions(shape="outline", distance="absolute")
    (moved,) = GroupTransfer(source, [GroupObject(Pose((3, 1.2)), rug)], options).to(target)
    assert not moved.reached


@pytest.mark.parametrize("system", ["boundary", "corner"])
@pytest.mark.parametrize("wall", [rectangle(2, 5, (10, 0)), [(10, 0), (13, 0), (13, 3), (11.5, 4), (10, 3)]])
def test_what_is_taken_to_other_walls_stays_upright(system, wall):
    wide, other = Polygon(rectangle(5, 2), label="wall", id="a"), Polygon(wall, label="wall", id="b")
    lamp = GroupObject(Pose((0.5, 0.3), 0.1), LEAF)
    to = {
        upright: GroupTransfer(wide, [lamp], TransferOptions(system, "absolute", upright=upright)).to(other)[0].pose
        for upright in (True, False)
    }
    # Of the boundary's coordinates, one runs in proportion: the lamp is at the lower left all the same.
    assert to[True].position == pytest.approx((10.5, 0.3), abs=1e-6 if system == "corner" else 0.31)
    assert to[True].angle == pytest.approx(0.1)
    if len(wall) == 4:  # otherwise, long sides correspond to long ones
        assert abs(np.cos(to[False].angle - 0.1)) == pytest.approx(0.0, abs=1e-6)


def test_round_walls_correspond_from_their_right_on():
    round_, other = (Polygon(regular(64, 2.0, (x, 0.0), 0.3), label="wall", id=str(x)) for x in (0, 10))
    lamp = GroupObject(Pose((1.2, 0.4)))
    (to,) = GroupTransfer(round_, [lamp], TransferOptions(upright=True)).to(other)
    assert to.pose.position == pytest.approx((11.2, 0.4), abs=1e-3) and to.pose.angle == 0.0


def test_the_source_is_no_target_but_its_copy_elsewhere_is():
    scene = Scene(beds())
    group = GroupTransfer(scene.polygon("bed 1"), FLOWERS)
    assert [p.id for p in group.targets(scene)] == ["bed 2", "bed 3"]
    elsewhere = Scene([Polygon(moved(BAY_ROOM, (10, 0)), label="bed", id="bed 1")])
    assert [p.id for p in group.targets(elsewhere)] == ["bed 1"]


@pytest.mark.parametrize(
    "options",
    [
        TransferOptions(),
        TransferOptions(system="corner", distance="absolute", corner=1, shape="outline"),
        TransferOptions(corners=False, start=(0.0, 1.0), starts={"bed 2": (10.0, 1.0)}, upright=True),
    ],
)
def test_a_stored_group_is_the_same_group(options):
    scene = Scene(beds()[:2])
    group = GroupTransfer(scene.polygon("bed 1"), FLOWERS, options)
    again = GroupTransfer.from_dict(group.to_dict())
    assert again.options == options and again.to_dict() == group.to_dict()
    assert [m.pose for m in again.place(scene)] == [m.pose for m in group.place(scene)]


# ------------------------------------------------------------------------------------------------ bad input


@pytest.mark.parametrize("name", ["system", "distance", "shape"])
def test_an_unknown_option_is_refused(name):
    with pytest.raises(InputError, match=f"the option {name} is 'mean value'; choose from"):
        TransferOptions(**{name: "mean value"})


def test_options_that_contradict_each_other_are_refused():
    with pytest.raises(InputError, match="a corner has no depth; choose inscribed or absolute"):
        TransferOptions(system="corner", distance="depth")
    with pytest.raises(InputError, match="starts are given without the source's start"):
        TransferOptions(starts={"b": (0.0, 0.0)})


def test_a_round_bed_has_no_corner():
    with pytest.raises(InputError, match="polygon 'b' has no corner; choose the boundary's coordinates instead"):
        mapped(UNIT_SQUARE, CIRCLE, [(0.5, 0.5)], system="corner")


def test_an_empty_group_is_refused():
    with pytest.raises(InputError, match="the group has no objects; select those"):
        GroupTransfer(Polygon(UNIT_SQUARE), [])


@pytest.mark.parametrize(
    ("damage", "message"),
    [
        ({"objects": None}, "record the operation again"),
        ({"objects": [{}]}, "lacks or garbles 'position'"),
        ({"options": {"colour": 1}}, "colour is no option of transfers; it may come from a newer version"),
    ],
)
def test_a_damaged_group_is_refused(damage, message):
    plain = GroupTransfer(Polygon(UNIT_SQUARE, id="a"), FLOWERS).to_dict()
    with pytest.raises(InputError, match=message):
        GroupTransfer.from_dict({**plain, **damage})
