"""The recorded kitchens: what their tree holds, and what it builds in rooms that it was not recorded in."""

import json
import sys
from collections import Counter, defaultdict
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import shapely

from geoanalogy import OperationsTree, Polygon, Scene, read_scene
from geoanalogy.operations.rectangle_placement import RectanglePlacement

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT))
from sample_blends.kitchens import rooms  # noqa: E402
from sample_blends.library import ASSETS  # noqa: E402
from sample_blends.library.fittings import FITTINGS  # noqa: E402

KITCHENS = ROOT / "sample_blends" / "kitchens"
ONCE = ("tall", "dishwasher", "window", "side window", "hood", "oven", "fridge", "sink", "hob", "door", "door handle")


@pytest.fixture(scope="module")
def tree():
    return OperationsTree.load(KITCHENS / "kitchens.json")


@pytest.fixture(scope="module")
def built(tree):
    """The sixteen rooms, and what is built in them."""
    scene = read_scene(KITCHENS / "rooms.geojson")
    return scene, tree.apply(scene, seed=7)


def room_of(element, scene):
    return next(p for p in scene.polygons if p.id == element.parent or p.id in element.surface or p.id in element.id)


def plan(element):
    """What stands below an element, in plan."""
    points = element.place.to_space(element.solid.vertices) if element.solid is not None else corners(element)
    return shapely.MultiPoint(points[:, :2]).convex_hull


def corners(element):
    return element.frame.to_space(element.ring)


def shapes_on(applied):
    found = defaultdict(list)
    for e in applied.layout.elements:
        if e.owner:
            found[e.surface].append((e, shapely.Polygon(e.ring)))
    return found.values()


def test_the_rooms_are_those_of_the_script():
    for name, made, count in (("examples", rooms.recorded(), 9), ("rooms", rooms.built(), 16)):
        stored = read_scene(KITCHENS / f"{name}.geojson")
        assert len(made.polygons) == count
        for a, b in zip(stored.polygons, made.polygons, strict=True):
            assert (a.id, a.label, a.segment_labels) == (b.id, b.label, b.segment_labels)
            assert a.points == pytest.approx(b.points)
        outlines = [p.shape.buffer(0.12) for p in made.polygons]
        assert len(shapely.STRtree(outlines).query(outlines, predicate="intersects")[0]) == count
        assert all(p.segment_labels[0] == "door" and p.segment_labels.count("door") == 1 for p in made.polygons)
    shapes = {tuple(np.round(np.ptp(p.points, axis=0), 3)) for p in rooms.recorded().polygons}
    assert shapes.isdisjoint(tuple(np.round(np.ptp(p.points, axis=0), 3)) for p in rooms.built().polygons)
    assert {len(p.points) for p in rooms.built().polygons} == {4, 5, 6}


def test_the_tree_takes_many_operations_of_a_few_examples_each(tree):
    assert len(tree.nodes) >= 85
    taught = [len(n.operation.model.lesson.taught) for n in tree.nodes if isinstance(n.operation, RectanglePlacement)]
    assert len(taught) >= 40 and min(taught) >= 2 and max(taught) <= 6
    kinds = Counter(n.operation.type for n in tree.nodes)
    assert kinds["extrusion"] >= 20 and kinds["boolean"] >= 15 and kinds["selection"] >= 3
    assert kinds["pose placement"] >= 1
    used = {m for n in tree.nodes if (m := getattr(n.operation, "mesh", ""))}
    assert len(used) >= 15 and used <= {*FITTINGS, *ASSETS}


def test_every_room_becomes_a_kitchen(built):
    scene, applied = built
    assert applied.problems == ()
    counts = defaultdict(Counter)
    for e in applied:
        counts[room_of(e, scene).id][e.label] += 1
    assert len(counts) == len(scene.polygons)
    for room, found in counts.items():
        assert {label: found[label] for label in ONCE} == dict.fromkeys(ONCE, 1), room
        assert found["chair"] <= 4 * found["table"] and found["cabinet door"] + found["drawers"] >= 2, room
    solids = [e for e in applied if e.solid is not None and not e.absorbed_by]
    assert all(e.solid.is_closed for e in solids)


def test_nothing_overlaps_on_a_surface(built):
    _, applied = built
    whole = {"sill", "upright", "crossbar"}  # bars cross, and stand on sills
    for elements in shapes_on(applied):
        parts = [(e, shape) for e, shape in elements if e.label.split()[-1] not in whole]
        for i, (e, shape) in enumerate(parts):
            for other, its in parts[:i]:
                under = 0.07 if {e.label, other.label} == {"chair", "table"} else 0.01  # chairs are pushed in
                assert shape.intersection(its).area <= under, (e.id, other.id)


def test_cabinets_and_tables_leave_each_other_and_the_door_room(built):
    scene, applied = built
    for room in scene.polygons:
        there = [e for e in applied if room_of(e, scene) is room]
        runs = [plan(e) for e in there if e.label.endswith(" run") or e.label == "tall"]
        for i, run in enumerate(runs):
            assert all(run.intersection(other).area <= 1e-3 for other in runs[:i]), room.id
            assert run.difference(room.shape.buffer(0.001)).area <= 1e-3
            # Against a wall all along: within two centimetres.
            assert run.intersection(room.shape.exterior.buffer(0.02)).area >= 0.9 * 0.02 * np.sqrt(run.area), room.id
        (door,) = (corners(e) for e in there if e.label == "door")
        a, b = door[:, :2].min(axis=0), door[:, :2].max(axis=0)
        way = shapely.LineString([a, b]).buffer(0.85, cap_style="flat").intersection(room.shape)
        assert all(run.intersection(way).area <= 1e-3 for run in runs), room.id
        for e in there:
            if e.label in ("table", "chair"):
                assert plan(e).difference(room.shape).area <= 1e-6, e.id
                assert all(plan(e).intersection(run).area <= 1e-3 for run in runs), e.id
                assert plan(e).intersection(way).area <= 0.02, e.id


def test_appliances_are_where_a_cook_needs_them(built):
    scene, applied = built
    for room in scene.polygons:
        there = defaultdict(list)
        for e in applied:
            if room_of(e, scene) is room:
                there[e.label].append(corners(e))
        (hood,), (hob,), (oven,), (sink,) = (there[label] for label in ("hood", "hob", "oven", "sink"))
        assert hob[:, 2] == pytest.approx(0.9) and sink[:, 2] == pytest.approx(0.9)
        assert oven[:, 2].min() == pytest.approx(0.1, abs=0.02) and hood[:, 2].min() >= 1.4
        middle = np.array([hood.mean(axis=0), hob.mean(axis=0), oven.mean(axis=0)])[:, :2]
        assert np.hypot(*(middle[1] - middle[0])) <= 0.45 and np.hypot(*(middle[1] - middle[2])) <= 0.45, room.id
        assert np.hypot(*(hob.mean(axis=0) - sink.mean(axis=0))[:2]) >= 0.6, room.id
        for window in there["window"]:
            assert window[:, 2].min() >= 1.0
        for door in there["door"]:
            assert door[:, 2].min() == pytest.approx(0.0, abs=0.005) and 1.9 <= door[:, 2].max() <= 2.1


def test_walls_look_into_the_room_and_fronts_away_from_walls(built):
    scene, applied = built
    for e in applied:
        if e.label in ("dishwasher", "oven", "fridge", "hood", "window", "door"):
            middle, room = corners(e).mean(axis=0), room_of(e, scene)
            ahead = shapely.Point((middle + 0.3 * e.frame.normal)[:2])
            assert room.shape.contains(ahead), e.id


def test_kitchens_differ_and_chairs_face_their_tables(built):
    scene, applied = built
    runs = Counter(e.label for e in applied if e.label in ("back run", "single run"))
    assert min(runs["back run"], runs["single run"]) >= 2
    assert len({e.mesh for e in applied.layout.elements if e.label == "hood"}) == 2
    tables = {room_of(e, scene).id: plan(e) for e in applied if e.label == "table"}
    assert len(tables) >= 10
    for e in applied:
        if e.label == "chair":
            ahead = corners(e).mean(axis=0) + 0.5 * e.place.axes[0]
            assert tables[room_of(e, scene).id].buffer(0.05).contains(shapely.Point(ahead[:2])), e.id


def test_a_turned_room_gets_the_same_kitchen(tree, built):
    scene, applied = built
    room = scene.polygons[1]
    c, s = np.cos(2.0), np.sin(2.0)
    ring = room.points @ np.array([[c, s], [-s, c]]) + (30.0, -12.0)
    turned = Polygon(
        ring, room.label, room.id, orientation=room.main_orientation + 2.0, segment_labels=room.segment_labels
    )
    again = tree.apply(Scene([turned]), seed=7)
    assert again.problems == ()
    here = Counter(e.label for e in applied if room_of(e, scene) is room)
    assert Counter(e.label for e in again) == here
    parapet = {e.label: e.solid.volume for e in applied if e.label == "kitchen" and room_of(e, scene) is room}
    assert {e.label: e.solid.volume for e in again if e.label == "kitchen"} == pytest.approx(parapet)


def test_the_tree_is_plain_and_complete(tree):
    again = OperationsTree.from_dict(json.loads(json.dumps(tree.to_dict())))
    assert again.to_dict() == tree.to_dict()
    assert (KITCHENS / "kitchens.json").stat().st_size <= 1_500_000


def test_no_fitting_takes_the_name_of_an_asset_of_the_same_library():
    assert set(FITTINGS).isdisjoint(ASSETS)


def test_fittings_lie_on_their_surface_and_fill_their_place():
    for name, fitting in FITTINGS.items():
        vertices = fitting.solid().vertices
        assert vertices[:, 2].min() >= 0.0, name
        assert np.ptp(vertices[:, :2], axis=0) == pytest.approx(fitting.size, rel=0.5, abs=0.16), name
        assert replace(fitting, name="other").size == fitting.size
