"""Probabilistic placement (section 4.8): the importance as a distribution that poses are drawn from."""

import math

import numpy as np
import pytest
import shapely
from scipy.spatial.distance import pdist
from shapes import L_ROOM, rectangle, ring

from geoanalogy import InputError, Polygon, Pose, PoseOptions, Scene
from geoanalogy.poses.arrangement import arrangement_of
from geoanalogy.poses.propagate import learn_pose
from geoanalogy.poses.scatter import ScatterModel, ScatterOptions, importance_field

TREE = ring((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5))


def gardens(count=2):
    found = [Polygon(rectangle(20, 20, (30.0 * i, 0.0)), label="garden", id=f"g{i}") for i in range(count)]
    return found + [Polygon(rectangle(4, 4, (30.0 * i + 8, 8.0)), label="palace", id=f"p{i}") for i in range(count)]


@pytest.fixture(scope="module")
def model():
    return learn_pose(Scene(gardens()), Pose((3, 3), 0.4), TREE)


def drawn(model, seed=0, scene=None, **options):
    return ScatterModel(model, ScatterOptions(**options)).place(scene or Scene(gardens()), seed)


def positions(results):
    return np.array([r.pose.position for r in results])


def test_the_field_is_greatest_where_the_example_stands(model):
    field = importance_field(model, arrangement_of(Scene(gardens()), gardens()[0]))
    best = field.positions[np.argmax(field.importance)]
    corner = np.abs(best - 10) - 7
    assert corner == pytest.approx([0, 0], abs=0.5)
    assert 0 <= field.importance.min() and field.importance.max() <= 1 + 1e-6


def test_the_field_has_no_cell_outside_or_in_an_obstacle(model):
    scene = Scene(gardens())
    field = importance_field(model, arrangement_of(scene, scene.polygon("g1")), cells=2500)
    assert len(field.positions) == pytest.approx(2500 * (1 - 16 / 400), rel=0.03)
    assert shapely.intersects_xy(scene.polygon("g1").shape, *field.positions.T).all()
    assert not shapely.contains_xy(scene.polygon("p1").shape, *field.positions.T).any()


def test_every_garden_gets_the_count(model):
    results = drawn(model, count=15)
    assert [sum(r.parent.id == id for r in results) for id in ("g0", "g1")] == [15, 15]
    assert {r.scale for r in results} == {1.0}


@pytest.mark.parametrize(("density", "count"), [(0.05, 20), (0.0314, 13), (0.0, 0)])
def test_a_density_is_a_count_per_area(model, density, count):
    area = gardens()[0].area
    assert round(density * area) == count
    assert len(drawn(model, density=density)) == 2 * count


def test_objects_keep_their_distance_stay_inside_and_off_the_palace(model):
    scene = Scene(gardens())
    results = drawn(model, count=40, spacing=1.6, directions="random")
    for id, other in (("g0", "p0"), ("g1", "p1")):
        here = [r for r in results if r.parent.id == id]
        assert pdist(positions(here)).min() >= 1.6
        outlines = shapely.polygons([r.pose.to_scene(TREE) for r in here])
        assert shapely.area(shapely.intersection(outlines, scene.polygon(id).shape)).min() > 0.96
        assert shapely.area(shapely.intersection(outlines, scene.polygon(other).shape)).max() < 0.03
    near = np.hypot(*(positions([r for r in results if r.parent.id == "g0"]) - (3, 3)).T)
    assert near.min() >= 1.6  # the example stands there


def test_without_a_spacing_the_footprints_extent_keeps_them_apart(model):
    results = [r for r in drawn(model, count=60) if r.parent.id == "g1"]
    assert pdist(positions(results)).min() >= 1.0


def test_where_there_is_no_more_room_fewer_are_drawn(model):
    results = drawn(model, count=1000, spacing=4.0)
    assert 10 < len(results) / 2 < 40


def test_the_same_seed_draws_the_same_whatever_the_scenes_order(model):
    one = drawn(model, seed=7, count=10)
    other = drawn(model, seed=7, count=10, scene=Scene(gardens()[::-1]))
    assert {r.pose for r in one} == {r.pose for r in other}
    assert {r.pose for r in one} != {r.pose for r in drawn(model, seed=8, count=10)}


def test_a_garden_draws_the_same_whatever_the_others_are(model):
    alone = drawn(model, seed=7, count=10, scene=Scene([gardens()[1], gardens()[3]]))
    assert [r.pose for r in alone] == [r.pose for r in drawn(model, seed=7, count=10) if r.parent.id == "g1"]


def test_likely_places_are_drawn_more_often_and_a_sharper_distribution_keeps_to_them(model):
    scene = Scene([gardens()[1], gardens()[3]])
    mean = {}
    for sharpness in (0.0, 1.0, 8.0):
        options = {"count": 25, "sharpness": sharpness, "spacing": 0.0}
        values = [r.importance for seed in range(4) for r in drawn(model, seed, scene, **options)]
        mean[sharpness] = np.mean(values)
    assert mean[0.0] + 0.05 < mean[1.0] < mean[8.0] - 0.05


def test_a_wider_kernel_spreads_the_objects(model):
    scene = Scene([gardens()[1], gardens()[3]])

    def off(width):
        places = np.vstack([positions(drawn(model, s, scene, count=20, width=width, sharpness=4.0)) for s in range(4)])
        gaps = np.abs(places - (40, 10))
        return np.abs(gaps - 7).min(axis=1).mean()

    assert off(0.02) < 0.7 * off(0.3)


def test_directions_are_the_strongest_level_sets_or_any(model):
    results = drawn(model, count=30)
    relative = np.array([(r.pose.angle - 0.4) % (np.pi / 2) for r in results if not r.mirrored])
    # Near a corner the direction towards it may be the strongest.
    assert np.median(np.minimum(relative, np.pi / 2 - relative)) < 1e-3
    anywhere = np.array([r.pose.angle for r in drawn(model, count=60, directions="random")])
    assert np.histogram(anywhere, bins=4, range=(0, 2 * np.pi))[0].min() > 10


def test_objects_without_footprint_are_scattered_over_any_shape():
    scene = Scene([Polygon(L_ROOM, label="lawn", id="a"), Polygon(L_ROOM[::-1] * (-1, 1), label="lawn", id="b")])
    daisy = learn_pose(scene, Pose((1, 1)), None, PoseOptions(mirror=True))
    results = drawn(daisy, scene=scene, count=50)
    for id in "ab":
        here = positions([r for r in results if r.parent.id == id])
        assert len(here) == 50
        assert shapely.intersects_xy(scene.polygon(id).shape, *here.T).all()


def test_a_stored_scatter_draws_the_same(model):
    scatter = ScatterModel(model, ScatterOptions(count=5, sharpness=2.0))
    again = ScatterModel.from_dict(scatter.to_dict())
    assert again.to_dict() == scatter.to_dict()
    assert [r.pose for r in again.place(Scene(gardens()), 3)] == [r.pose for r in scatter.place(Scene(gardens()), 3)]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({}, "either a count per parent or a density"),
        ({"count": 3, "density": 1.0}, "either a count per parent or a density"),
        ({"count": -1}, "the option count is -1; give a whole number from 0 on"),
        ({"density": math.nan}, "the option density is nan; give a finite number from 0 on"),
        ({"count": 1, "spacing": -1.0}, "the option spacing is -1.0; give a finite number from 0 on"),
        ({"count": 1, "width": 0.0}, "the option width is 0.0; give a finite positive number"),
        ({"count": 1, "directions": "north"}, "the option directions is 'north'; choose from best, random"),
    ],
)
def test_options_that_make_no_sense_are_refused(options, message):
    with pytest.raises(InputError, match=message):
        ScatterOptions(**options)


def test_a_damaged_scatter_is_refused(model):
    plain = ScatterModel(model, ScatterOptions(count=5)).to_dict()
    with pytest.raises(InputError, match="the stored scatter lacks or garbles 'model'; record the operation again"):
        ScatterModel.from_dict({"options": plain["options"]})
