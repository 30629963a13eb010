"""What is told of one thing, and of several."""

import bpy
import pytest
from flats import bed, bridge, engine, operations_tree, propagate, rooms


@pytest.mark.parametrize(
    ("count", "told"), [(0, "0 results"), (1, "1 result"), (2, "2 results"), (1000, "1000 results")]
)
def test_one_is_not_told_as_several(count, told):
    assert bridge("counting").counted(count, "result") == told


def test_a_replay_of_one_operation_with_one_result_is_told_so():
    rooms(2)
    bed()
    propagate()
    report = engine("progress").run(bridge("tree.replay").replay_steps(bpy.context))
    assert report.text == "1 operation, 1 result"
    assert operations_tree().nodes.active["count"] == 1
