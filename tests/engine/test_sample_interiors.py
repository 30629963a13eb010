"""Furnished interiors on demand: a storey of a building that a tree has made, divided, and furnished by other trees."""

import sys
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
import shapely

from geoanalogy import InputError, Polygon
from geoanalogy.geometry.extrusion import extrude
from geoanalogy.geometry.frame import Frame

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT))
from sample_blends.interiors import __main__ as interiors  # noqa: E402
from sample_blends.interiors import furnishing  # noqa: E402
from sample_blends.interiors.storey import CORRIDOR, Storey  # noqa: E402


@pytest.fixture(scope="module")
def building():
    applied = interiors.condominium("plot 17", seed=7)
    return applied, next(e for e in applied if e.label == "block")


@pytest.fixture(scope="module")
def storey(building):
    return Storey.of(building[1], 3.35, building[0])


@pytest.fixture(scope="module")
def furnished(storey):
    return furnishing.furnish(storey, seed=7)


def hull(element):
    return shapely.MultiPoint(element.mesh.vertices[:, :2]).convex_hull


def test_a_storey_lies_inside_its_building(building, storey):
    _, block = building
    inside = shapely.Polygon(
        storey.frame.to_space([(0, 0), (storey.width, 0), (storey.width, storey.depth), (0, storey.depth)])[:, :2]
    )
    outline = shapely.Polygon(block.ring)
    assert outline.contains(inside) and outline.exterior.distance(inside) == pytest.approx(0.35)
    assert storey.frame.normal.tolist() == pytest.approx([0, 0, 1]) and storey.frame.origin[2] == 3.35


def test_rooms_line_a_corridor_without_touching(storey):
    rooms = [(label, shapely.box(*box)) for label, box, _ in storey.rooms()]
    corridor = shapely.box(*storey.corridor)
    assert {"living room", "bedroom", "bathroom", "kitchen"} == {label for label, _ in rooms}
    whole = shapely.box(0, 0, storey.width, storey.depth)
    shapes = [corridor, *(shape for _, shape in rooms)]
    for i, shape in enumerate(shapes):
        assert whole.buffer(1e-9).contains(shape)
        assert all(shape.distance(other) >= 0.1 for other in shapes[:i])
    assert all(shape.distance(corridor) == pytest.approx(0.12) for _, shape in rooms)
    assert storey.corridor[3] - storey.corridor[1] == pytest.approx(CORRIDOR - 0.12)


def test_every_room_but_bathrooms_has_a_window_and_all_have_doors(storey):
    scene = storey.plan()
    doors = [p.shape for p in scene.polygons if p.label == "door"]
    windows = [p.shape for p in scene.polygons if p.label == "window"]
    for room in scene.polygons:
        if room.label in ("living room", "bedroom", "bathroom"):
            assert sum(room.shape.buffer(1e-6).contains(d) for d in doors) == 1, room.id
            there = sum(room.shape.buffer(1e-6).contains(w) for w in windows)
            assert there == 0 if room.label == "bathroom" else there >= 1, room.id
    assert len(doors) == 2 * sum(p.label in ("living room", "bedroom", "bathroom") for p in scene.polygons)


def test_windows_are_those_of_the_facades_and_no_wall_ends_at_one(building, storey):
    applied, _ = building
    labels = ("window", "loggia")
    facades = [e for e in applied if e.label in labels and e.surface != "ground"]
    seen = [storey.frame.to_plane(e.frame.to_space(e.ring)) for e in facades]
    middles = sorted(
        (float(points[:, 0].mean()), bool(points[:, 1].mean() < 0))
        for points in seen
        if 0 < points[:, 2].mean() < 3.1 and points[:, 2].min() > 0
    )
    inside = [(a, b, front) for front, row in zip((True, False), storey.windows, strict=True) for a, b in row]
    assert len(middles) >= 8
    assert sorted(((a + b) / 2, front) for a, b, front in inside) == [(pytest.approx(x), front) for x, front in middles]
    assert Counter(front for label, _, front in storey.openings() if label == "window") <= Counter(
        front for _, _, front in inside
    )
    for _, (x0, _, x1, _), front in storey.rooms():
        assert all(not a < x < b for a, b, before in inside if before == front for x in (x0, x1))


def test_a_facade_without_windows_has_a_hall(storey):
    rooms = [shapely.box(*box) for _, box, _ in storey.rooms()]
    (hall,) = (shapely.box(*box) for box in storey.halls())
    assert hall.bounds[0] > 6 and hall.bounds[2] < storey.width - 6  # the staircase, in the middle of the front
    assert hall.intersects(shapely.box(*storey.corridor)) and all(hall.distance(room) >= 0.1 for room in rooms)


def test_stairs_rise_in_a_hall_up_to_the_cut(storey):
    steps = list(furnishing.stairs(storey))
    (hall,) = [box for box in storey.halls() if box[2] - box[0] <= furnishing.STAIRCASE]
    assert len(steps) == 7
    for k, step in enumerate(steps):
        low, high = step.vertices.min(axis=0), step.vertices.max(axis=0)
        assert low[2] == 0.0 and high[2] == pytest.approx(0.17 * (k + 1)) and high[2] <= furnishing.CUT
        assert shapely.box(*hall).covers(shapely.box(*low[:2], *high[:2]))
        assert shapely.box(*storey.corridor).distance(shapely.box(*low[:2], *high[:2])) > 1.0


def test_rooms_are_furnished_by_what_was_recorded_elsewhere(storey, furnished):
    furniture, kitchens = furnished
    assert furniture.problems == kitchens.problems == ()
    wanted = Counter(label for label, _, _ in storey.rooms())
    found = Counter(e.label for e in furniture)
    assert found["bed"] == wanted["bedroom"] and found["wardrobe"] == wanted["bedroom"]
    assert found["sofa"] == found["television"] == wanted["living room"]
    assert found["washbasin"] == found["toilet"] == wanted["bathroom"]
    cooking = Counter(e.label for e in kitchens)
    assert cooking["sink"] == cooking["hob"] == cooking["door"] == cooking["kitchen"] == wanted["kitchen"]


def test_furniture_stands_in_its_room_clear_of_doors_and_of_each_other(storey, furnished):
    scene = storey.plan()
    leaves = [p.shape for p in scene.polygons if p.label == "door"]
    standing = [(e, hull(e)) for e in furnished[0] if e.label != "bath mat"]
    for i, (e, shape) in enumerate(standing):
        room = scene.polygon(e.parent)
        assert shape.difference(room.shape).area <= 0.02 * shape.area, e.id
        assert all(shape.intersection(leaf).area <= 0.03 for leaf in leaves), e.id
        if e.label != "coffee table":
            assert all(
                shape.intersection(its).area <= 0.05 for other, its in standing[:i] if other.label != "coffee table"
            )


def test_the_building_is_opened_above_the_storey(building, storey):
    _, block = building
    mesh = furnishing.opened(block, storey)
    assert mesh.vertices[:, 2].max() == pytest.approx(3.35 + furnishing.CUT)
    middle = storey.frame.to_space([(storey.width / 2, storey.depth / 2)])[0]
    tops = mesh.vertices[mesh.faces].mean(axis=1)
    inside = np.abs(tops[:, 2] - 3.35) < 1e-6
    assert inside.any() and np.hypot(*(tops[inside, :2].mean(axis=0) - middle[:2])) < storey.width / 2


def test_meshes_are_cut_closed_at_a_height():
    box = extrude(Polygon([(0, 0), (2, 0), (2, 1), (0, 1)]), 3.0).mesh
    low = furnishing.below(box, 1.25)
    a, b, c = (low.vertices[low.faces[:, k]] for k in range(3))
    assert np.einsum("ij,ij->", np.cross(a, b), c) / 6 == pytest.approx(2.5)
    assert "wall cut" in {low.materials[i] for i in low.material_index}
    assert furnishing.below(box, 4.0) is box
    assert furnishing.below(box.placed(Frame((0, 0, 2.0))), 1.25) is None


def test_buildings_that_cannot_be_divided_are_refused(building):
    _, block = building
    small = block.changed(stretch=(5.0, 5.0))
    with pytest.raises(InputError, match="inside; choose a larger building"):
        Storey.of(small, 0.0)
    with pytest.raises(InputError, match="has no rectangular outline"):
        Storey.of(block.changed(footprint=((0.0, 0.0), (9.0, 0.0), (0.0, 9.0))), 0.0)
    with pytest.raises(InputError, match="there is no plot 'plot 01' for a condominium"):
        interiors.condominium("plot 01", seed=7)
