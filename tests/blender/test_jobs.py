"""Long work while another window changes what it works on: it stops with a sentence, and touches nothing."""

import bpy
import pytest
from flats import activate, bed, box, bridge, everything, operations_tree, placed, propagate, results, rooms

EXEC = "EXEC_DEFAULT"


def begin():
    """A propagation of the active object that has taken its first steps."""
    job = bridge("jobs").Job(bridge("tree.recording").pose_steps(bpy.context, bpy.context.active_object))
    job.advance(0.0)
    assert not job.finished and bridge("jobs").at_work()
    return job


def stopped(job, message):
    """Whether the job says why it has stopped, and neither changes anything nor stands in the way any more."""
    before = everything()
    with pytest.raises(Exception, match=message):
        job.advance()
    assert everything() == before
    assert not bridge("jobs").at_work()
    assert bpy.ops.geoanalogy.propagate(EXEC, True) == {"FINISHED"}


def test_an_undo_stops_what_is_at_work():
    bpy.context.preferences.edit.use_global_undo = True
    rooms()
    item = bed()
    bpy.ops.ed.undo_push(message="bed")
    item.location.x += 0.1
    bpy.ops.ed.undo_push(message="moved")
    job = begin()
    bpy.ops.ed.undo()
    activate(bpy.data.objects["Bed"])
    stopped(job, "the scene was undone or exchanged while it was being worked on")


def test_another_file_stops_what_is_at_work(tmp_path):
    rooms()
    bed()
    path = str(tmp_path / "rooms.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    job = begin()
    bpy.ops.wm.open_mainfile(filepath=path)
    stopped(job, "the scene was undone or exchanged while it was being worked on")


def test_an_example_that_is_deleted_stops_what_is_at_work():
    rooms()
    box("Other", (1, 1, 1), "chest", at=(3.0, 2.0, 0.0))
    bed()
    job = begin()
    assert bpy.ops.object.delete() == {"FINISHED"}
    activate(bpy.data.objects["Other"])
    stopped(job, "something was added or deleted while the scene was being worked on")


def test_a_node_that_is_removed_stops_what_is_at_work():
    rooms()
    bed()
    propagate()
    job = begin()
    tree = operations_tree()
    tree.nodes.remove(tree.nodes.active)
    stopped(job, "an operation was removed while the tree was being worked on")


def test_what_is_moved_meanwhile_is_no_matter():
    rooms()
    item = bed()
    job = begin()
    item.location.z += 1.0
    while not job.finished:
        job.advance()
    assert results() and not bridge("jobs").at_work()


def test_operators_wait_for_what_is_at_work():
    rooms()
    bed()
    propagate()
    before = placed()
    job = begin()
    for name in ("propagate", "replay", "clear", "reject", "draw_rectangles", "find_regions", "remove_operation"):
        with pytest.raises(RuntimeError, match="Something is being worked on: wait for it, or stop it with Esc"):
            getattr(bpy.ops.geoanalogy, name)(EXEC)
    job.cancel()
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    assert placed() == before


def test_an_error_frees_the_way():
    jobs = bridge("jobs")

    def steps():
        yield 0.0, "reading"
        raise ValueError("broken")

    job = jobs.Job(steps())
    with pytest.raises(ValueError, match="broken"):
        job.advance(1.0)
    assert not jobs.at_work()
