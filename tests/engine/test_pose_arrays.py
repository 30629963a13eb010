"""Arrays along offset boundaries (section 4.8): where they run, how objects turn, and when there is none."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapes import CIRCLE, HOLED_ROOM, UNIT_SQUARE, rectangle, regular, ring
from strategies import similarities

from geoanalogy import InputError, Polygon, Pose, Scene
from geoanalogy.poses.arrays import ArrayModel, ArrayOptions, learn_array
from geoanalogy.poses.offset_path import MOST_OBJECTS, align, offset_paths
from geoanalogy.poses.results import PoseResults, PropagatedPose

BUSH = ring((-0.2, -0.2), (0.2, -0.2), (0.2, 0.2), (-0.2, 0.2))


def garden(number, corner=(0.0, 0.0), fountain=None, size=20.0):
    """A square garden, and perhaps a fountain in it."""
    found = [Polygon(rectangle(size, size, corner), label="garden", id=f"garden {number}")]
    if fountain is not None:
        outline = np.array(fountain[0]) + corner
        found.append(Polygon(regular(64, fountain[1], outline), label="fountain", id=f"fountain {number}"))
    return found


def positions(array):
    return np.array([p.position for p in array.poses])


def answer(model, scene, results):
    """Make a model answer with given (parent id, x, y) or (parent id, x, y, mirrored), all of importance 0.9."""
    poses = [
        PropagatedPose(Pose((x, y), 0.0, bool(flag)), 0.9, scene.polygon(parent)) for parent, x, y, *flag in results
    ]

    def steps(_):
        yield 0.0, "answering"
        return PoseResults(poses)

    model.steps = steps


def own(start, end, spacing, footprint=None, scene=None, **options):
    """The array that starts with the example, by default in a garden without anything else."""
    scene = scene or Scene(garden(1))
    model = learn_array(scene, start, end, spacing, footprint, array_options=ArrayOptions(**options))
    for each in (model.start, model.end):
        if each is not None:
            answer(each, scene, [])
    (array,) = model.place(scene)
    assert array.example
    return array


def row(target_starts, target_ends, spacing=2.0, options=None, second=None):
    """The arrays of a second garden where starts and ends are as given; the example is in the first one."""
    scene = Scene([*garden(1), *(second or garden(2, (30.0, 0.0)))])
    model = learn_array(scene, Pose((3, 1)), Pose((17, 1)), spacing, BUSH, array_options=options)
    answer(model.start, scene, target_starts)
    answer(model.end, scene, target_ends)
    return [a for a in model.place(scene) if not a.example]


# ------------------------------------------------------------------------------------------------ offset paths


def test_inside_a_square_the_offset_is_a_smaller_square():
    (path,) = offset_paths(Polygon(rectangle(4, 4)), 1.0, True, "round")
    assert path.length == pytest.approx(8)
    assert path.distance((1, 2)) == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize(("corners", "length"), [("round", 4 + 2 * math.pi), ("mitre", 12)])
def test_outside_a_square_corners_are_round_or_mitred(corners, length):
    (path,) = offset_paths(Polygon(UNIT_SQUARE), 1.0, False, corners)
    assert path.length == pytest.approx(length, rel=1e-4)


def test_a_path_runs_as_the_boundary_does():
    for inside in (True, False):
        (path,) = offset_paths(Polygon(UNIT_SQUARE), 0.25, inside, "round")
        x, y = path.vertices.T
        assert np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)) > 0


def test_a_hole_has_a_path_of_its_own():
    paths = offset_paths(Polygon(HOLED_ROOM, holes=[rectangle(2, 1, (1.0, 1.5))]), 0.25, True, "round")
    assert sorted(p.length for p in paths) == pytest.approx([6 + 0.5 * math.pi, 14], rel=1e-4)


def test_where_a_polygon_is_nowhere_that_wide_there_is_no_path():
    assert offset_paths(Polygon(UNIT_SQUARE), 0.6, True, "round") == []


def test_the_nearest_boundary_counts_and_of_equal_ones_the_first():
    one, other = Polygon(rectangle(1, 1), id="one"), Polygon(rectangle(1, 1, (3, 0)), id="other")
    at = align((2.5, 0.5), [one, other])
    assert (at.polygon.id, at.offset, at.inside) == ("other", 0.5, False)
    assert align((2, 0.5), [one, other]).polygon.id == "one"
    assert align((0.5, 0.9), [one, other]).inside


# ------------------------------------------------------------------------------------------------ where arrays run


def test_the_example_runs_along_its_own_offset_boundary():
    array = own(Pose((3, 1)), Pose((17, 1)), 2.0, BUSH)
    assert array.polygon.id == array.parent.id == "garden 1"
    assert positions(array) == pytest.approx(np.array([(x, 1) for x in range(3, 18, 2)]))
    assert {p.angle for p in array.poses} == {0.0}


def test_the_rest_of_the_way_stays_empty_unless_the_spacing_is_made_even():
    fixed, even = (own(Pose((3, 1)), Pose((17, 1)), 3.0, even=e) for e in (False, True))
    assert positions(fixed)[:, 0] == pytest.approx([3, 6, 9, 12, 15])
    assert positions(even)[:, 0] == pytest.approx([3, 5.8, 8.6, 11.4, 14.2, 17])


def test_round_a_corner_objects_keep_their_direction_relative_to_the_path():
    array = own(Pose((15, 1), 0.3), Pose((19, 5)), 2.0, BUSH)
    assert positions(array) == pytest.approx(np.array([(15, 1), (17, 1), (19, 1), (19, 3), (19, 5)]))
    quarter = np.pi / 2
    assert [p.angle for p in array.poses] == pytest.approx([0.3, 0.3, 0.3 + quarter / 2, 0.3 + quarter, 0.3 + quarter])


def test_a_start_at_a_corner_takes_the_direction_in_which_the_path_leaves():
    array = own(Pose((1, 1)), Pose((19, 1)), 6.0)
    assert [p.angle for p in array.poses] == pytest.approx([0.0] * 4)


def test_the_end_is_projected_onto_the_offset_boundary():
    array = own(Pose((3, 1)), Pose((9, 2.5)), 2.0)
    assert positions(array) == pytest.approx(np.array([(3, 1), (5, 1), (7, 1), (9, 1)]))


@pytest.mark.parametrize(
    ("way", "count", "second"), [("shorter", 8, (5, 1)), ("left", 8, (5, 1)), ("right", 30, (1, 1))]
)
def test_the_way_round_can_be_chosen(way, count, second):
    array = own(Pose((3, 1)), Pose((17, 1)), 2.0, way=way)
    assert len(array.poses) == count
    assert array.poses[1].position == pytest.approx(second)


@given(similarities(scales=(0.5, 2.0)))
@settings(max_examples=25, deadline=None)
def test_arrays_follow_rotated_moved_and_scaled_gardens(move):
    plain = own(Pose((3, 1), 0.2), Pose((19, 9)), 2.0)
    moved = Scene([Polygon(move(p.points), label=p.label, id=p.id) for p in garden(1)])
    start, end = (Pose(tuple(move(np.array([p]))[0]), 0.2 + move.angle) for p in ((3, 1), (19, 9)))
    array = own(start, end, 2.0 * move.scale, scene=moved)
    assert positions(array) == pytest.approx(move(positions(plain)), abs=1e-6)
    turned = [np.exp(1j * (p.angle - q.angle - move.angle)) for p, q in zip(array.poses, plain.poses, strict=True)]
    assert turned == pytest.approx([1] * len(turned), abs=1e-6)


# ------------------------------------------------------------------------------------------------ all round


@pytest.mark.parametrize("end", [None, Pose((13, 10))])
def test_bushes_stand_all_round_a_fountain(end):
    scene = Scene(garden(1, fountain=((10, 10), 2.0)))
    (array,) = learn_array(scene, Pose((13, 10)), end, 1.0, BUSH).place(scene)
    assert array.closed and array.polygon.label == "fountain"
    assert len(array.poses) == math.floor(6 * math.pi)
    assert np.hypot(*(positions(array) - (10, 10)).T) == pytest.approx([3.0] * 18, abs=0.01)
    gaps = np.hypot(*np.diff(positions(array), axis=0).T)
    assert gaps == pytest.approx([2 * 3 * math.sin(1 / 6)] * 17, abs=0.01)


def test_all_round_an_even_spacing_leaves_no_gap():
    scene = Scene(garden(1, fountain=((10, 10), 2.0)))
    (array,) = learn_array(scene, Pose((13, 10)), None, 1.0, array_options=ArrayOptions(even=True)).place(scene)
    closed = positions(array)
    gaps = np.hypot(*(np.roll(closed, -1, axis=0) - closed).T)
    assert len(array.poses) == 19
    assert gaps == pytest.approx([gaps[0]] * 19, rel=2e-3)


@pytest.mark.parametrize(("way", "y"), [("left", 1), ("right", -1), ("shorter", 1)])
def test_all_round_the_way_is_the_boundarys_unless_chosen(way, y):
    scene = Scene(garden(1, fountain=((10, 10), 2.0)))
    options = ArrayOptions(way=way)
    (array,) = learn_array(scene, Pose((13, 10)), None, 1.0, array_options=options).place(scene)
    assert np.sign(array.poses[1].position[1] - 10) == y
    assert array.poses[1].angle == pytest.approx(y / 3 % (2 * np.pi), abs=0.03)


def test_bushes_stand_round_the_fountains_of_other_gardens_once_each():
    scene = Scene([g for i in range(3) for g in garden(i, (30.0 * i, 0.0), ((8, 9), 2.0))])
    model = learn_array(scene, Pose((11, 9)), None, 1.0, BUSH)
    answer(model.start, scene, [("garden 1", 41, 9), ("garden 1", 38, 6), ("garden 2", 71, 9), ("garden 0", 8, 6)])
    arrays = model.place(scene)
    assert [a.polygon.id for a in arrays] == ["fountain 0", "fountain 1", "fountain 2"]
    for i, array in enumerate(arrays):
        assert positions(array) - (30.0 * i, 0) == pytest.approx(positions(arrays[0]))


def test_a_fountain_of_another_size_has_bushes_at_the_starts_distance():
    scene = Scene([*garden(0, fountain=((8, 9), 2.0)), *garden(1, (30.0, 0.0), ((10, 10), 4.0))])
    model = learn_array(scene, Pose((11, 9)), None, 1.0, BUSH)
    answer(model.start, scene, [("garden 1", 45.5, 10)])
    array = model.place(scene)[1]
    assert np.hypot(*(positions(array) - (40, 10)).T) == pytest.approx([5.5] * 34, abs=0.02)


def test_inside_a_pond_reeds_stand_along_its_shore():
    scene = Scene([Polygon(CIRCLE, label="pond", id="pond")])
    (array,) = learn_array(scene, Pose((1.5, 0)), None, 0.5).place(scene)
    assert np.hypot(*positions(array).T) == pytest.approx([1.5] * len(array.poses), abs=0.01)
    assert len(array.poses) == math.floor(3 * math.pi / 0.5)


# ------------------------------------------------------------------------------------------------ other places


def test_starts_and_ends_propagate_into_an_equal_garden():
    lawns = [
        Polygon(rectangle(20, 12, (x, y)), label="lawn", id=f"lawn {i}")
        for i, (x, y) in enumerate([(0.0, 0.0), (30.0, 5.0)])
    ]
    scene = Scene(lawns)
    arrays = learn_array(scene, Pose((2, 1)), Pose((16, 1)), 2.0, BUSH).place(scene)
    wanted = np.array([(32 + x, 6) for x in range(0, 15, 2)])
    copies = [a for a in arrays if a.parent.id == "lawn 1" and len(a.poses) == len(wanted)]
    gaps = [np.abs(positions(a) - wanted).max() for a in copies]
    assert min(gaps) < 1e-2
    assert copies[int(np.argmin(gaps))].importance > 0.99


def test_an_array_with_starts_and_ends_elsewhere():
    (array,) = row([("garden 2", 33, 1)], [("garden 2", 41.0, 1)])
    assert positions(array) == pytest.approx(np.array([(x, 1) for x in range(33, 42, 2)]))
    assert array.importance == 0.9


def test_start_and_end_nearest_to_different_polygons_make_no_array():
    second = garden(2, (30.0, 0.0), ((10, 10), 2.0))
    assert row([("garden 2", 33, 1)], [("garden 2", 40, 7)], second=second) == []


def test_start_and_end_on_different_sides_make_no_array():
    bed = Polygon(rectangle(18, 2, (31.0, 5.0)), label="garden", id="bed")
    second = [*garden(2, (30.0, 0.0)), bed]
    assert row([("garden 2", 33, 4.5)], [("bed", 41, 5.5)], second=second) == []
    assert len(row([("garden 2", 33, 4.5)], [("garden 2", 41, 4.5)], second=second)) == 1


def test_a_boundary_of_another_label_makes_no_array():
    second = garden(2, (30.0, 0.0), ((10, 10), 2.0))
    assert row([("garden 2", 43, 10)], [("garden 2", 37, 10)], second=second) == []


def test_start_and_end_on_parts_of_the_offset_boundary_that_are_not_joined_make_no_array():
    hall = ring(
        (30, 0), (38, 0), (38, 3), (42, 3), (42, 0), (50, 0), (50, 8), (42, 8), (42, 4), (38, 4), (38, 8), (30, 8)
    )
    second = [Polygon(hall, label="garden", id="garden 2")]
    assert row([("garden 2", 33, 1)], [("garden 2", 47, 1)], second=second) == []
    assert len(row([("garden 2", 33, 1)], [("garden 2", 37, 1)], second=second)) == 1


def test_of_several_ends_the_nearest_to_the_start_is_taken():
    (array,) = row([("garden 2", 33, 1)], [("garden 2", 45, 1), ("garden 2", 39, 1), ("garden 2", 49, 5)])
    assert array.poses[-1].position == pytest.approx((39, 1))


def test_an_end_serves_the_start_that_is_nearest_to_it():
    (array,) = row([("garden 2", 33, 1), ("garden 2", 37, 1)], [("garden 2", 45, 1)])
    assert array.poses[0].position == pytest.approx((37, 1))


def test_an_end_in_the_starts_own_place_is_another_arrays():
    (array,) = row([("garden 2", 33, 1)], [("garden 2", 33, 1), ("garden 2", 39, 1)])
    assert array.poses[-1].position == pytest.approx((39, 1))


def test_mirrored_arrays_run_the_other_way():
    (array,) = row([("garden 2", 47, 1, True)], [("garden 2", 41, 1, True)])
    assert positions(array) == pytest.approx(np.array([(x, 1) for x in (47, 45, 43, 41)]))
    assert all(p.mirrored for p in array.poses)
    assert np.cos([p.angle for p in array.poses]) == pytest.approx([-1] * 4)


def test_where_only_one_of_start_and_end_is_mirrored_there_is_no_array():
    assert row([("garden 2", 47, 1, True)], [("garden 2", 41, 1)]) == []


def test_a_threshold_keeps_weak_starts_out():
    assert row([("garden 2", 33, 1)], [("garden 2", 41, 1)], options=ArrayOptions(threshold=0.95)) == []


def test_much_weaker_ends_do_not_cut_an_array_short():
    scene = Scene([*garden(1), *garden(2, (30.0, 0.0))])
    model = learn_array(scene, Pose((3, 1)), Pose((17, 1)), 2.0)
    answer(model.start, scene, [("garden 2", 33, 1)])
    parent = scene.polygon("garden 2")
    ends = [PropagatedPose(Pose((x, 1)), importance, parent) for x, importance in ((45, 0.9), (39, 0.5))]
    model.end.steps = lambda _: _returned(PoseResults(ends))
    (array,) = [a for a in model.place(scene) if not a.example]
    assert array.poses[-1].position == pytest.approx((45, 1))


def _returned(results):
    yield 0.0, "answering"
    return results


def test_no_array_runs_where_a_better_one_does():
    arrays = row([("garden 2", 33, 1), ("garden 2", 35, 1)], [("garden 2", 43, 1), ("garden 2", 34, 1)], spacing=1.0)
    assert len(arrays) == 2
    overlapping = row([("garden 2", 33, 1), ("garden 2", 33, 1.2)], [("garden 2", 43, 1), ("garden 2", 41, 1)])
    assert len(overlapping) == 1


@pytest.mark.parametrize(("validate", "count"), [(True, 6), (False, 8)])
def test_objects_that_would_stand_in_something_else_are_left_out(validate, count):
    gate = Polygon(rectangle(3, 2, (8.2, 0.0)), label="gate", id="gate")
    scene = Scene([*garden(1), gate])
    options = ArrayOptions(validate=validate)
    model = learn_array(scene, Pose((3, 1)), Pose((17, 1)), 2.0, BUSH, array_options=options)
    array = next(a for a in model.place(scene) if a.example)
    assert len(array.poses) == count


# ------------------------------------------------------------------------------------------------ storing, bad input


@pytest.mark.parametrize("end", [None, Pose((17, 1))])
def test_a_stored_model_gives_the_same_arrays(end):
    scene = Scene(garden(1))
    model = learn_array(scene, Pose((3, 1)), end, 2.0, BUSH, array_options=ArrayOptions(even=True))
    again = ArrayModel.from_dict(model.to_dict())
    assert [a.poses for a in again.place(scene)] == [a.poses for a in model.place(scene)]
    assert again.to_dict() == model.to_dict()


@pytest.mark.parametrize(
    ("start", "end", "spacing", "message"),
    [
        ((3, 1), (17, 1), 0.0, "the spacing of the array is 0.0; give a finite positive number"),
        ((3, 1), (17, 1), math.nan, "the spacing of the array is nan; give a finite positive number"),
        ((3, 1), (13, 10), 1.0, "nearest to a polygon labelled 'garden' and its end to a polygon labelled 'fountain'"),
        ((12.5, 10), (9, 10), 1.0, "on different sides of the boundary of a polygon labelled 'fountain'"),
    ],
)
def test_an_example_that_is_no_array_is_refused(start, end, spacing, message):
    scene = Scene([*garden(1, fountain=((10, 10), 2.0))])
    with pytest.raises(InputError, match=message):
        learn_array(scene, Pose(start), Pose(end), spacing)


def test_an_example_whose_ends_no_path_joins_is_refused():
    dumb_bell = ring(
        (0, 0), (8, 0), (8, 3), (12, 3), (12, 0), (20, 0), (20, 8), (12, 8), (12, 4), (8, 4), (8, 8), (0, 8)
    )
    scene = Scene([Polygon(dumb_bell, label="hall", id="hall")])
    with pytest.raises(InputError, match="no path along the boundary of a polygon labelled 'hall' joins"):
        learn_array(scene, Pose((3, 1)), Pose((17, 1)), 1.0)


def test_a_start_and_an_end_at_two_of_a_kind_are_refused_by_their_label():
    beds = [Polygon(ring((x, 2), (x + 2, 2), (x + 2, 4), (x, 4)), label="bed", id=f"bed/hall@{x},0") for x in (2, 12)]
    scene = Scene([Polygon(ring((0, 0), (20, 0), (20, 8), (0, 8)), label="hall", id="hall"), *beds])
    with pytest.raises(InputError, match="nearest to a polygon labelled 'bed' and its end to another one; move them"):
        learn_array(scene, Pose((3, 1.9)), Pose((13, 1.9)), 1.0)


def test_starts_and_ends_at_what_has_no_label_are_refused_too():
    scene = Scene([*garden(1), Polygon(regular(64, 2.0, (10, 10)))])
    with pytest.raises(InputError, match="different sides of the boundary of a polygon without a label"):
        learn_array(scene, Pose((12.5, 10)), Pose((9, 10)), 1.0)


def test_a_mistyped_spacing_is_refused():
    scene = Scene(garden(1))
    with pytest.raises(InputError, match=f"more than {MOST_OBJECTS} objects; give a larger spacing"):
        learn_array(scene, Pose((3, 1)), Pose((17, 1)), 1e-3).place(scene)


@pytest.mark.parametrize("name", ["corners", "way"])
def test_an_unknown_option_is_refused(name):
    with pytest.raises(InputError, match=f"the option {name} is 'square'; choose from"):
        ArrayOptions(**{name: "square"})


@pytest.mark.parametrize(
    ("damage", "message"),
    [
        ({"start": None}, "record the operation again"),
        ({"spacing": None}, "record the operation again"),
        ({"options": {"colour": 1}}, "colour is no option of arrays; it may come from a newer version"),
    ],
)
def test_a_damaged_model_is_refused(damage, message):
    plain = learn_array(Scene(garden(1)), Pose((3, 1)), None, 2.0).to_dict()
    with pytest.raises(InputError, match=message):
        ArrayModel.from_dict({**plain, **damage})


@given(st.floats(0.5, 6.0), st.booleans())
@settings(max_examples=25, deadline=None)
def test_neighbours_keep_the_spacing_along_a_straight_path(spacing, even):
    array = own(Pose((3, 1)), Pose((17, 1)), spacing, even=even)
    gaps = np.diff(positions(array)[:, 0])
    assert gaps == pytest.approx([14 / max(1, round(14 / spacing)) if even else spacing] * len(gaps))
    last = positions(array)[-1, 0]
    assert last == pytest.approx(17) if even else 17 - spacing < last < 17 + 1e-4
