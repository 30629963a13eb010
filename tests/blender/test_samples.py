"""The sample scenes of chapter 4: their recorded operations, replayed from the .blend, furnish the whole plan."""

import bpy
import numpy as np
import pytest
import shapely
from conftest import ROOT
from flats import bridge

EXEC = "EXEC_DEFAULT"
#: Most operations and fewest objects of figures 4.10 to 4.12.
SCENES = {"apartment": (26, 160), "garden": (27, 617), "crowns": (10, 122)}

#: Shares of their area that may overlap: what the tolerances of the engine leave, and what lies under other things.
TOUCHING = 0.03
LIES_FLAT = {"bath mat", "flower bed", "group"}


@pytest.fixture(scope="module", params=SCENES)
def scene(request, installed):
    """A scene's name, opened without its results and replayed."""
    bpy.ops.wm.open_mainfile(filepath=str(ROOT / "sample_blends" / f"{request.param}.blend"))
    assert not placed()
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    bpy.context.view_layer.update()
    return request.param


@pytest.fixture(autouse=True)
def fresh_file():
    """In place of the one for all tests: these share a file, and change nothing in it."""


def placed():
    return [item for item in bpy.context.scene.objects if "ga_key" in item]


def examples():
    return [item for item in bpy.data.collections["Examples"].objects if item.type == "MESH"]


def operations():
    return bpy.context.scene.geoanalogy.tree.nodes


def standing():
    """Every object that was placed or is an example: (name of its asset, ring on the floor)."""
    nodes = {node.name: bridge("tree.store").engine_node(node).operation for node in operations()}
    for item in placed():
        label = getattr(nodes[item["ga_node"]], "label", "group")
        yield label, outline(item)
    for item in examples():
        yield item["ga_label"], outline(item)


def outline(item):
    corners = np.array([item.matrix_world @ v.co for v in item.data.vertices])[:, :2]
    return shapely.MultiPoint(corners).minimum_rotated_rectangle


def plan(label):
    return [outline(item) for item in bpy.data.collections["Plan"].objects if item.get("ga_label") == label]


def test_few_operations_make_many_objects(scene):
    most, fewest = SCENES[scene]
    assert len(operations()) <= most
    assert len(placed()) + len(examples()) >= fewest


def test_objects_share_the_meshes_of_their_examples(scene):
    drawn = {item.data.name for item in examples()}
    assert {item.data.name for item in placed()} <= drawn


def test_nothing_stands_in_a_doorway(scene):
    doors = plan("door")
    assert bool(doors) == (scene == "apartment")
    for label, ring in standing():
        for door in doors:
            assert ring.intersection(door).area <= TOUCHING * min(ring.area, door.area), label


def test_nothing_stands_in_anything_else(scene):
    things = [(label, ring) for label, ring in standing() if label not in LIES_FLAT and ring.area > 0]
    tree = shapely.STRtree([ring for _, ring in things])
    for i, (label, ring) in enumerate(things):
        for j in tree.query(ring):
            other, beside = things[j]
            if j > i and scene == "apartment":
                shared = ring.intersection(beside).area
                assert shared <= TOUCHING * min(ring.area, beside.area), (label, other)
