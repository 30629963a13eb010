"""Corrections by hand: keys that mean the same result after a replay, and what becomes of the results."""

import dataclasses

import numpy as np
import pytest
from edits import bed, rooms
from hypothesis import given
from hypothesis import strategies as st
from shapes import L_ROOM
from strategies import places, similarities

from geoanalogy import InputError, OperationsTree, Polygon, Pose, Scene
from geoanalogy.operations.decisions import Decisions, Pin
from geoanalogy.operations.element import Element
from geoanalogy.operations.keys import distinct, find, from_parent, key_of, to_parent

ROOM = Polygon(L_ROOM, label="room", id="r@1", orientation=0.3)


def element(key, x=0.0, importance=1.0):
    return Element("chair", "Chair", key.rpartition("@")[0], Pose((x, 0.0)), None, "node", key, importance=importance)


# ------------------------------------------------------------------------------------------------ keys


@given(similarities(), places())
def test_a_key_stays_when_the_room_is_moved_turned_and_scaled(move, place):
    moved = Polygon(move(L_ROOM), id="r@1", orientation=0.3 + move.angle)
    there = move(place[None])[0]
    assert to_parent([there], moved) == pytest.approx(to_parent([place], ROOM), abs=1e-6)
    assert from_parent(to_parent([there], moved), moved)[0] == pytest.approx(there, abs=1e-6)
    assert find([key_of(tuple(place), ROOM)], [key_of(tuple(there), moved)])


def test_a_key_names_the_parent_and_the_place():
    assert key_of(tuple(ROOM.centroid), ROOM) == "r@1@0,0"


def test_keys_that_come_again_get_a_number():
    assert distinct(["a@0,0", "b@0,0", "a@0,0", "a@0,0"]) == ["a@0,0", "b@0,0", "a@0,0,2", "a@0,0,3"]


@pytest.mark.parametrize(
    ("wanted", "present", "found"),
    [
        (["a@10,10"], ["a@10,10", "a@11,10"], {"a@10,10": "a@10,10"}),
        (["a@10,10"], ["a@60,10", "a@20,10"], {"a@10,10": "a@20,10"}),
        (["a@10,10"], ["a@61,10"], {}),
        (["a@10,10"], ["b@10,10"], {}),
        (["a@10,10", "a@20,10"], ["a@19,10"], {"a@20,10": "a@19,10"}),
        (["a@10,10", "a@20,10"], ["a@12,10", "a@22,10"], {"a@10,10": "a@12,10", "a@20,10": "a@22,10"}),
        (["a@10,10,2"], ["a@10,10", "a@10,10,2"], {"a@10,10,2": "a@10,10,2"}),
    ],
)
def test_a_key_means_itself_or_the_nearest_result_of_its_parent(wanted, present, found):
    assert find(wanted, present) == found


# ------------------------------------------------------------------------------------------------ decisions


def test_accepting_and_rejecting_take_each_other_back():
    decisions = Decisions().accept("a").reject("b").accept("b").reject("a").accept("b")
    assert (decisions.accepted, decisions.rejected) == (("b",), ("a",))
    assert decisions.forget("a").forget("b") == Decisions()


def test_a_pin_is_taken_back_by_rejecting():
    pin = Pin("r@1", (0.0, 0.0))
    assert Decisions().reject("a").pin("a", pin) == Decisions(pinned={"a": pin})
    assert Decisions().pin("a", pin).reject("a") == Decisions(rejected=("a",))
    assert Decisions().pin("a", pin).forget("a") == Decisions()


def test_accepted_ones_come_in_and_rejected_ones_stay_out():
    proposed = [element("r@1@0,0"), element("r@1@200,0"), element("r@1@400,0")]
    decisions = Decisions(accepted=("r@1@402,1",), rejected=("r@1@1,1",))
    kept = decisions.apply(proposed, proposed[:2], None, Scene([ROOM]))
    assert [e.key for e in kept] == ["r@1@200,0", "r@1@400,0"]


@given(similarities(scales=(0.5, 2.0)), st.booleans(), places())
def test_a_pinned_result_moves_with_its_room(move, mirrored, place):
    pose = Pose(tuple(place), 0.7, mirrored)
    pin = Pin.from_dict(Pin.of(pose, ROOM, 1.5).to_dict())
    there = pin.pose(Polygon(move(L_ROOM), id="r@1", orientation=0.3 + move.angle))
    assert there.position == pytest.approx(tuple(move(place[None])[0]), abs=1e-6)
    assert np.exp(1j * there.angle) == pytest.approx(np.exp(1j * (0.7 + move.angle)))
    assert (there.mirrored, pin.scale) == (mirrored, 1.5)


def test_a_pinned_result_stands_where_it_was_put_even_when_it_is_no_longer_found():
    proposed = [element("r@1@0,0")]
    pose = Pose((1.0, 1.0), 0.5)
    decisions = Decisions().pin("r@1@3,0", Pin.of(pose, ROOM))
    (moved,) = decisions.apply(proposed, proposed, None, Scene([ROOM]))
    assert moved.pose.position == pytest.approx(pose.position) and moved.key == "r@1@0,0"
    template = element("r@1@900,0", x=9.0)
    (kept,) = decisions.apply([], [], template, Scene([ROOM]))
    assert kept.pose.position == pytest.approx(pose.position) and (kept.key, kept.parent) == ("r@1@3,0", "r@1")
    assert decisions.apply([], [], None, Scene([ROOM])) == []
    assert decisions.apply([], [], template, Scene([])) == []


@pytest.mark.parametrize("damage", [{"parent": None}, {"position": [1]}, {"position": ["x", 0]}, {"scale": []}])
def test_a_damaged_pin_is_refused(damage):
    plain = {**Pin("r", (0.0, 0.0)).to_dict(), **damage}
    if damage.get("parent", 0) is None:
        del plain["parent"]
    with pytest.raises(InputError, match="a pinned result has no parent or no position; pin it again"):
        Pin.from_dict(plain)


def test_decisions_are_stored_as_far_as_there_are_any():
    decisions = Decisions(("a",), ("b",), {"c": Pin("r", (0.1, 0.2), 0.3, True, 2.0)})
    assert Decisions.from_dict(decisions.to_dict()) == decisions
    assert Decisions().to_dict() == {}


# ------------------------------------------------------------------------------------------------ in a tree


def decided(tree, decisions):
    node = tree.node("bed")
    operation = dataclasses.replace(node.operation, decisions=decisions)
    return tree.with_node(dataclasses.replace(node, operation=operation))


def test_decisions_survive_a_replay_after_a_wall_was_moved():
    tree = OperationsTree([bed()])
    scene = Scene(rooms())
    _, first, second = sorted(tree.apply(scene), key=lambda e: e.parent)
    pose = Pose((7.0, 1.5), 1.0)
    pin = Pin.of(pose, scene.polygon(first.parent))
    tree = decided(tree, Decisions().pin(first.key, pin).reject(second.key))
    assert [(e.parent, e.pose.position) for e in tree.apply(scene) if not e.example] == [
        (first.parent, pytest.approx(pose.position))
    ]
    wider = Scene([Polygon(p.points * (1, 1.05), label=p.label, id=p.id) for p in rooms()])
    moved = [e for e in tree.apply(wider) if e.parent != "bedroom 0"]
    assert [e.parent for e in moved] == [first.parent]
    assert moved[0].pose.position == pytest.approx((7.0, 1.575), abs=0.05)


def test_a_rejected_results_place_stays_empty_and_an_accepted_one_passes_every_limit():
    tree = OperationsTree([bed(threshold=0.0, max_per={})])
    scene = Scene(rooms())
    every = [e for e in tree.apply(scene) if e.parent == "bedroom 1"]
    assert len(every) > 1
    one = OperationsTree([bed(max_per={"bedroom": 1})])
    best, other = every[0], every[-1]
    rejected = decided(one, Decisions().reject(best.key)).apply(scene)
    assert not [e for e in rejected if e.parent == "bedroom 1"]
    swapped = decided(one, Decisions().reject(best.key).accept(other.key)).apply(scene)
    assert [e.key for e in swapped if e.parent == "bedroom 1"] == [other.key]
