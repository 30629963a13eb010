"""The edits of the sample street, without Blender: their examples, and the tree that they are recorded as."""

import json

import numpy as np
import pytest

import geoanalogy as ga
from geoanalogy.placements.arrays import element_array
from sample_blends.edits.recording import record, scene_of
from sample_blends.edits.street import EDITS, GAP, SHOWN, WINDOW, floor_foot, window_middle
from sample_blends.library.facades import PARTS
from sample_blends.library.palette import PALETTE
from sample_blends.plans.street import FLOOR, HOUSES, frames, house, plan


@pytest.fixture(scope="module")
def tree():
    return record(scene_of(plan()), EDITS)


@pytest.mark.parametrize("edit", EDITS, ids=lambda edit: edit.part)
def test_two_to_six_examples_lie_on_the_two_shown_facades(edit):
    assert 2 <= len(edit.wanted) <= 6
    assert {id for id, *_ in edit.wanted} == set(SHOWN)
    for id, x0, y0, x1, y1 in edit.wanted:
        assert -1e-6 <= x0 < x1 <= house(id).width + 1e-6
        assert -1e-6 <= y0 < y1 <= house(id).height + 1e-6


@pytest.mark.parametrize("name", PARTS)
def test_a_part_fills_its_size_and_stands_with_its_back_on_the_wall(name):
    part = PARTS[name]
    solid = part.solid()
    low, high = solid.vertices.min(axis=0), solid.vertices.max(axis=0)
    assert (high - low)[[0, 2]] == pytest.approx(part.size, abs=0.02)
    assert (high + low)[[0, 2]] == pytest.approx((0.0, 0.0), abs=0.02)
    assert high[1] == pytest.approx(0.0, abs=0.02) and low[1] < -0.05
    assert set(solid.materials) <= set(PALETTE)


def test_the_frames_of_the_facades_are_upright_and_look_at_the_street():
    for frame in frames().values():
        axes = frame[:3, :3]
        assert axes.T @ axes == pytest.approx(np.eye(3))
        assert np.linalg.det(axes) == pytest.approx(1.0)
        assert axes[:, 1] == pytest.approx((0.0, 0.0, 1.0)) and axes[1, 2] < -0.5


@pytest.mark.parametrize("id", SHOWN)
def test_the_middles_of_windows_are_those_of_the_row(id):
    x0 = 0.95
    row = ga.Rectangle(house(id).width / 2, 5.0, house(id).width - 2 * x0, WINDOW[1])
    found = element_array(row, WINDOW, ("repeat", "scale"), (GAP, 0.0))
    assert [window_middle(id, 0, i)[0] for i in range(len(found))] == pytest.approx([r.x for r in found])


def test_every_facade_is_dressed(tree):
    elements = tree.apply(scene_of(plan()))
    floors = {h.id: [e for e in elements if e.label == "floor" and e.parent == h.id] for h in HOUSES}
    for h in HOUSES:
        assert len(floors[h.id]) == h.floors
        feet = sorted(e.pose.position[1] - FLOOR / 2 for e in floors[h.id])
        assert feet == pytest.approx([floor_foot(h.id, i) for i in range(h.floors)], abs=0.05)
    doors = [e for e in elements if e.label == "door"]
    assert len(doors) == len(HOUSES)
    count = {label: sum(e.label == label for e in elements) for label in ("window", "sill", "shutter")}
    assert count["window"] == count["sill"] == count["shutter"] / 2 > 60


def test_the_tree_is_stored_and_places_the_same_again(tree):
    again = ga.OperationsTree.from_dict(json.loads(json.dumps(tree.to_dict())))
    scene = scene_of(plan())
    assert again.to_dict() == tree.to_dict()
    assert again.apply(scene) == tree.apply(scene)
