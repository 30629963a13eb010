"""The sample street: edits on two facades, replayed on the other six by its operations tree."""

import math
from collections import defaultdict

import bpy
import numpy as np
import pytest
from conftest import ROOT
from flats import bridge, placed
from mathutils import Vector

EXEC = "EXEC_DEFAULT"
STREET = ROOT / "sample_blends" / "street.blend"
SHOWN = ("house 1", "house 2")

#: Roundings of single precision, and what refining leaves.
NEAR = 0.03


@pytest.fixture(scope="module")
def street(installed):
    """By house and label, the boxes (x0, y0, x1, y1) on its facade; replayed from a file without results."""
    bpy.ops.wm.open_mainfile(filepath=str(STREET))
    assert not [item for item in bpy.context.scene.objects if "ga_key" in item]
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    return boxes_by_house()


def houses():
    return sorted((i for i in bpy.context.scene.objects if i.get("ga_label") == "facade"), key=lambda item: item.name)


def boxes_by_house():
    bpy.context.view_layer.update()
    operations = {node.name: node for node in bpy.context.scene.geoanalogy.tree.nodes}
    found = {house.name: defaultdict(list, size=tuple(house.dimensions[:2])) for house in houses()}
    aside = {item.name for item in bpy.data.collections["Aside"].objects}
    for item in bpy.context.scene.objects:
        if "ga_key" in item:
            label = bridge("tree.store").engine_node(operations[item["ga_node"]]).operation.label
        elif "ga_label" in item and "ga_drawn" not in item and item["ga_label"] != "facade" and item.name not in aside:
            label = item["ga_label"]
        else:
            continue
        house, box = where_is(item)
        found[house][label].append(box)
    return found


def where_is(item):
    """The facade that an object is on, and its box there; its back lies on the facade."""
    best = None
    for house in houses():
        to_wall = house.matrix_world.inverted() @ item.matrix_world
        corners = np.array([to_wall @ Vector(corner) for corner in item.bound_box])
        low, high = corners.min(axis=0), corners.max(axis=0)
        width, height = house.dimensions[0], house.dimensions[1]
        x, y = (low[:2] + high[:2]) / 2
        if abs(low[2]) < NEAR and 0 < x < width and 0 < y < height:
            assert best is None, f"{item.name} is on two facades"
            best = house.name, (low[0], low[1], high[0], high[1])
    assert best is not None, f"{item.name} is on no facade"
    return best


def overlap(a, b):
    return max(0.0, min(a[2], b[2]) - max(a[0], b[0])) * max(0.0, min(a[3], b[3]) - max(a[1], b[1]))


def test_every_house_has_one_door_on_the_ground(street):
    for of in street.values():
        ((x0, y0, x1, y1),) = of["door"]
        assert abs(y0) < NEAR
        assert (x1 - x0, y1 - y0) == pytest.approx((1.3, 2.6), abs=NEAR)
        assert x0 > 0.5 and x1 < of["size"][0] - 0.5


def test_every_house_has_its_bands_from_side_to_side(street):
    for of in street.values():
        width, height = of["size"]
        (ground,), (cornice,) = of["ground floor"], of["cornice"]
        assert ground[:3] == pytest.approx((0.0, 0.0, width), abs=NEAR)
        assert (cornice[0], cornice[2], cornice[3]) == pytest.approx((0.0, width, height), abs=NEAR)
        floors = sorted(of["floor"], key=lambda box: box[1])
        assert len(floors) == math.floor((height - 4.2) / 3.2)
        for box in floors:
            assert (box[0], box[2]) == pytest.approx((0.0, width), abs=NEAR)
        assert floors[0][1] >= ground[3] - NEAR and floors[-1][3] <= cornice[1] + NEAR


def test_windows_stand_in_rows_clear_of_the_corners(street):
    for of in street.values():
        rows = defaultdict(list)
        for box in of["window"]:
            assert (box[2] - box[0], box[3] - box[1]) == pytest.approx((1.1, 1.7), abs=2 * NEAR)
            assert box[0] > 0.7 and box[2] < of["size"][0] - 0.7
            (floor,) = [f for f in of["floor"] if f[1] <= box[1] and box[3] <= f[3]]
            assert box[1] - floor[1] == pytest.approx(0.95, abs=2 * NEAR)
            rows[floor].append(box[0])
        assert len(rows) == len(of["floor"])
        columns = [sorted(row) for row in rows.values()]
        assert len(columns[0]) >= 2
        for row in columns:
            assert row == pytest.approx(columns[0], abs=2 * NEAR), "windows stand above each other"


def test_every_window_has_its_sill_and_its_two_shutters(street):
    for of in street.values():
        for window in of["window"]:
            middle = (window[0] + window[2]) / 2
            below = [s for s in of["sill"] if abs(s[3] - window[1]) < NEAR and abs((s[0] + s[2]) / 2 - middle) < NEAR]
            assert len(below) == 1
            beside = [
                s for s in of["shutter"] if abs(s[1] - window[1]) < NEAR and abs((s[0] + s[2]) / 2 - middle) < 1.2
            ]
            left, right = sorted(beside)
            assert left[2] <= window[0] + NEAR and right[0] >= window[2] - NEAR
        assert len(of["sill"]) == len(of["window"])
        assert len(of["shutter"]) == 2 * len(of["window"])


def test_balconies_are_below_the_windows_of_the_first_floor_alone(street):
    for of in street.values():
        first = min(window[1] for window in of["window"])
        windows = [window for window in of["window"] if window[1] < first + 1.0]
        assert len(of["balcony"]) == len(windows)
        for window in windows:
            middle = (window[0] + window[2]) / 2
            assert [b for b in of["balcony"] if abs((b[0] + b[2]) / 2 - middle) < 0.1 and b[3] < window[1]]


def test_shops_fill_the_ground_floor_beside_the_door_each_below_its_awning(street):
    for of in street.values():
        (door,) = of["door"]
        assert of["shop window"]
        for shop in of["shop window"]:
            assert shop[0] > door[2] + 0.3 and shop[2] < of["size"][0] - 0.5
            middle = (shop[0] + shop[2]) / 2
            assert [a for a in of["awning"] if abs((a[0] + a[2]) / 2 - middle) < NEAR and a[1] >= shop[3] - NEAR]
        assert len(of["awning"]) == len(of["shop window"])
        (lamp,) = of["lamp"]
        assert door[2] - NEAR < lamp[0] < door[2] + 0.4


def test_nothing_overlaps(street):
    parts = ("window", "sill", "shutter", "door", "shop window", "awning", "balcony", "lamp", "cornice")
    for of in street.values():
        every = [(label, box) for label in parts for box in of[label]]
        for i, (one, a) in enumerate(every):
            for other, b in every[:i]:
                assert overlap(a, b) < 0.01, (one, other, a, b)


def test_few_examples_on_two_facades_teach_every_operation_and_a_replay_gives_the_identical_street():
    bpy.ops.wm.open_mainfile(filepath=str(STREET))
    assert len(houses()) == 8
    assert len({tuple(np.round(i.matrix_world.col[2], 3)) for i in houses()}) >= 4, "facades of several directions"
    for node in bpy.context.scene.geoanalogy.tree.nodes:
        examples = [one.item for one in bridge("tree.store").placed_by(node) if one.target is not None]
        assert 2 <= len(examples) <= 6
        assert {where_is(item)[0] for item in examples} <= set(SHOWN)
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    before = placed()
    assert len(before) > 400
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    assert placed() == before
