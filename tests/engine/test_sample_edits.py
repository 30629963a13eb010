"""The edits of the sample scenes: their examples, without propagating them."""

import numpy as np
import pytest
import shapely

import geoanalogy as ga
from sample_blends.edits import apartment as apartment_edits
from sample_blends.edits import crowns as crown_edits
from sample_blends.edits import garden as garden_edits
from sample_blends.edits.edit import ArrayEdit, Edit, GroupEdit, ScatterEdit
from sample_blends.edits.recording import record, scene_of
from sample_blends.library import ASSETS
from sample_blends.plans import apartment, crowns, garden

SCENES = {
    "apartment": (apartment, apartment_edits.EDITS, 26),
    "garden": (garden, garden_edits.EDITS, 27),
    "crowns": (crowns, crown_edits.EDITS, 10),
}
# What an example may lie on: its seat or table, or the window it stands at.
MAY_OVERLAP = {("desk", "window")}


def examples(edits):
    """(asset, pose) of everything that is put by hand."""
    for edit in edits:
        places = edit.items if isinstance(edit, GroupEdit) else [(edit.asset, edit.place)]
        for asset, (x, y, angle) in places:
            yield asset, ga.Pose((x, y), float(np.radians(angle)))


@pytest.mark.parametrize("name", SCENES)
def test_scene_has_no_more_edits_than_the_thesis_needed(name):
    _, edits, most = SCENES[name]
    assert 0 < len(edits) <= most
    assert {type(edit) for edit in edits} <= {Edit, ArrayEdit, ScatterEdit, GroupEdit}


@pytest.mark.parametrize("name", SCENES)
def test_examples_stand_free(name):
    plan, edits, _ = SCENES[name]
    polygons = plan.plan()
    shapes = [(p.label, shapely.Polygon(p.ring)) for p in polygons]
    standing = []
    for asset, pose in examples(edits):
        ring = shapely.Polygon(pose.to_scene(ASSETS[asset].footprint))
        holding = [shape for _, shape in shapes if shape.intersection(ring).area > 0.95 * ring.area]
        assert holding, (asset, pose)
        for label, shape in shapes:
            if label in ("door", "window") and (asset, label) not in MAY_OVERLAP:
                assert shape.intersection(ring).area < 0.01 * ring.area, (asset, label)
        for other, shape in standing:
            if ASSETS[other].label != "flower bed":
                assert shape.intersection(ring).area < 0.02 * min(ring.area, shape.area), (asset, other)
        standing.append((asset, ring))


def test_recorded_edits_make_a_chain_that_is_stored_and_read():
    plan = scene_of(apartment.plan())
    edits = apartment_edits.EDITS[14:16]
    tree = record(plan, edits)
    assert [node.operation.mesh for node in tree.nodes] == ["fridge", "sink"]
    assert [len(node.inputs) for node in tree.nodes] == [0, 1]
    placed = tree.apply(plan)
    kitchens = {polygon.id for polygon in apartment.plan() if polygon.label == "kitchen"}
    for asset in ("fridge", "sink"):
        assert {element.parent for element in placed if element.mesh == asset} == kitchens
    again = ga.OperationsTree.from_dict(tree.to_dict()).apply(plan)
    assert [element.pose for element in again] == [element.pose for element in placed]
