"""The sample drawings: small files of lines, queries, images and operations, which a replay paints."""

import bpy
import pytest
from conftest import ROOT
from flats import results
from pictures import EXEC, bridge, operations

FILES = sorted((ROOT / "sample_blends" / "drawings").glob("*.blend"))
#: Bytes that a sample may have.
LARGEST = 1_000_000


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
    images = [image for image in bpy.data.images if image.users]
    assert images and all(image.packed_file is not None for image in images)


def test_replaying_a_sample_paints_it():
    bpy.ops.wm.open_mainfile(filepath=str(ROOT / "sample_blends" / "drawings" / "butterflies.blend"))
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    assert len(results()) >= 5
    assert {item.type for item in results()} == {"MESH"}
