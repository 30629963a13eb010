"""The sample drawings: small files of lines, queries, images and operations; a replay paints what is like the query."""

import json

import bpy
import numpy as np
import pytest
from conftest import ROOT
from flats import results
from pictures import EXEC, bridge, operations

FILES = sorted((ROOT / "sample_blends" / "drawings").glob("*.blend"))
#: Bytes that a sample may have.
LARGEST = 1_000_000
#: Distance from where something belongs, in sizes of the place, below which it lies there.
THERE = 0.1


def places_of(node):
    """The outlines of all places where an operation's edit belongs, which its query tells."""
    return [np.array(outline) for outline in json.loads(node["query_object"]["places"])]


def off(outline, place):
    """How far an outline lies from a place, in sizes of the place."""
    gaps = np.linalg.norm(outline[: len(place)] - place, axis=1)
    return float(np.median(gaps) / np.linalg.norm(np.ptp(place, axis=0)))


def test_there_are_sample_drawings():
    assert {"butterflies", "fish"} <= {path.stem for path in FILES}


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_a_sample_is_small_and_holds_operations_without_results(path):
    assert path.stat().st_size < LARGEST
    bpy.ops.wm.open_mainfile(filepath=str(path))
    nodes = bridge("tree.store").drawing_nodes(operations())
    assert nodes and results() == []
    for node in nodes:
        (patch,) = bridge("regions.results").contents_of(node)
        assert patch.name in bpy.context.scene.objects
        assert node["query_object"].name in bpy.context.scene.objects
        assert places_of(node)
    images = [image for image in bpy.data.images if image.users]
    assert images and all(image.packed_file is not None for image in images)


@pytest.mark.parametrize("name", ["corals", "flowers"])
def test_replaying_a_sample_paints_what_is_like_the_query_and_nothing_else(name):
    bpy.ops.wm.open_mainfile(filepath=str(ROOT / "sample_blends" / "drawings" / f"{name}.blend"))
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    for node in bridge("tree.store").drawing_nodes(operations()):
        operation = bridge("tree.store").engine_node(node).operation
        shown = bridge("regions.results").passing(operation, bridge("regions.results").targets_found(node))
        where = [[off(target.outline, place) for place in places_of(node)] for target in shown]
        assert np.array(where).min(axis=1).max() < THERE
        assert sorted(np.argmin(where, axis=1)) == list(range(len(places_of(node))))
        assert len(results(node.name)) == len(shown)
        assert {item.type for item in results(node.name)} == {"MESH"}
