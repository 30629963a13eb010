"""Taking results to other places of their rooms, through the installed extension."""

import math

import bpy
import pytest
from flats import (
    activate,
    bed,
    box,
    bridge,
    everything,
    face,
    operations_tree,
    placed,
    propagate,
    reload,
    results,
    rooms,
)

EXEC = "EXEC_DEFAULT"


def bare_rooms(count=3):
    """Rooms that are the same turned and mirrored: four places in each answer alike."""
    for i in range(count):
        face(f"room {i}", [(0, 0), (4, 0), (4, 3), (0, 3)], "bedroom", at=(5.0 * i, 0.0, 0.0))


def step(by=1):
    return bpy.ops.geoanalogy.next_place(EXEC, True, step=by)


def place_of(key):
    item = next(i for i in results() if i["ga_key"] == key)
    return tuple(round(v, 4) for v in (*item.location[:2], math.remainder(item.rotation_euler[2], 2 * math.pi)))


def test_all_places_of_a_room_follow_one_another_and_lead_back():
    bare_rooms()
    bed()
    propagate(most=1)
    every = placed()
    item = activate(results()[0])
    key = item["ga_key"]
    seen = [place_of(key)]
    for _ in range(3):
        assert step() == {"FINISHED"}
        assert len(results()) == len(every)
        # The one that was taken on stays selected, so that it can be taken on again.
        assert [i["ga_key"] for i in bpy.context.selected_objects] == [key]
        seen.append(place_of(key))
    corners = {(round(x, 3), round(y, 3)) for x, y, _ in seen}
    x0 = 5.0 * (1 if seen[0][0] < 10 else 2)
    assert corners == {(x0 + x, y) for x in (1.0, 3.0) for y in (0.5, 2.5)}
    assert evaluated_after(lambda: step(-1)) == 0
    assert place_of(key) == seen[2]
    while place_of(key) != seen[0]:
        assert step() == {"FINISHED"}
    assert placed() == every


def evaluated_after(work):
    """How many operations were computed meanwhile."""
    before = bridge("tree.evaluating").evaluations.evaluated
    assert work() == {"FINISHED"}
    return bridge("tree.evaluating").evaluations.evaluated - before


def test_a_result_stays_where_it_was_taken(tmp_path):
    bare_rooms()
    bed()
    propagate(most=1)
    key = activate(results()[1])["ga_key"]
    step()
    there = placed()
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    assert placed() == there
    reload(tmp_path / "f.blend")
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    assert [p[2:] for p in placed()] == [p[2:] for p in there]
    assert bpy.ops.geoanalogy.forget_decisions(EXEC, True) == {"FINISHED"}
    assert place_of(key) != next(tuple(p) for p in there)


def test_one_undo_step_takes_it_back():
    bare_rooms()
    bed()
    propagate(most=1)
    activate(*results())
    bpy.ops.ed.undo_push(message="selected")
    before = placed()
    assert step() == {"FINISHED"}
    after = placed()
    assert after != before
    bpy.ops.ed.undo()
    assert placed() == before
    bpy.ops.ed.redo()
    assert placed() == after


def test_where_another_result_stands_is_no_other_place():
    bare_rooms()
    bed()
    propagate(most=2)
    first, second = sorted((i for i in results() if i.location.x > 10), key=lambda i: i["ga_key"])
    key, other = first["ga_key"], second["ga_key"]
    still = place_of(other)
    activate(first)
    seen = []
    for _ in range(4):
        step()
        seen.append(place_of(key))
        assert place_of(other) == still
        # Of beds of 2 by 1 in the corners of a room of 4 by 3, those less than 1 apart would intersect.
        assert math.dist(seen[-1][:2], still[:2]) >= 1.0
    assert len(set(seen)) > 2


def test_rejected_places_are_passed_over():
    bare_rooms()
    bed()
    propagate(most=4)
    room = [i for i in results() if i.location.x > 10]
    unwanted = activate(room[1])
    gone = tuple(round(v, 3) for v in unwanted.location[:2])
    assert bpy.ops.geoanalogy.reject(EXEC, True) == {"FINISHED"}
    node = operations_tree().nodes.active
    node.most = 1
    left = activate(next(i for i in results() if i.location.x > 10))
    key = left["ga_key"]
    for _ in range(4):
        step()
        assert tuple(round(v, 3) for v in place_of(key)[:2]) != gone


def test_a_result_that_was_moved_by_hand_comes_to_the_best_place_first():
    bare_rooms()
    bed()
    propagate(most=1)
    item = activate(results()[0])
    key, best = item["ga_key"], place_of(item["ga_key"])
    item.location.x += 0.4
    assert bpy.ops.geoanalogy.accept(EXEC, True) == {"FINISHED"}
    assert place_of(key) != best
    step()
    assert place_of(key) == best


def test_what_has_no_other_place_is_said(capfd):
    rooms()
    bed()
    propagate(most=1, candidates=1)
    activate(results()[0])
    before = everything()
    with pytest.raises(RuntimeError, match="there is no other place for what is selected"):
        step()
    assert everything() == before


def test_only_propagated_results_know_other_places():
    bare_rooms()
    bed()
    bpy.ops.geoanalogy.array(EXEC, True, spacing=1.0)
    activate(results()[0])
    with pytest.raises(RuntimeError, match="was not placed by Propagate, which alone knows other places"):
        step()


def test_without_a_result_it_says_so():
    bare_rooms()
    activate(box("Bed", (2.0, 1.0, 0.5), "bed", at=(1.0, 2.5, 0.0)))
    propagate(most=1)
    with pytest.raises(RuntimeError, match="no result is selected"):
        step()


def test_results_of_one_room_that_are_taken_on_together_stay_apart():
    bare_rooms()
    bed()
    propagate(most=2)
    both = [i for i in results() if i.location.x > 10]
    keys = [i["ga_key"] for i in both]
    activate(*both)
    assert evaluated_after(step) == 0
    one, other = (place_of(key) for key in keys)
    assert math.dist(one[:2], other[:2]) >= 1.0
