"""The other places of a result: which there are, and going from one to the next."""

import dataclasses

import pytest

from geoanalogy import Polygon, Pose, Scene
from geoanalogy.operations.decisions import Decisions, Pin
from geoanalogy.operations.element import Element
from geoanalogy.operations.other_places import other_places, taken_on

ROOM = Polygon([(0, 0), (10, 0), (10, 4), (0, 4)], label="room", id="r")
SQUARE = ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5))


def chair(x, key=None, parent="r", footprint=SQUARE, **changed):
    key = f"{parent}@{round(1000 * x)},0" if key is None else key
    return Element("chair", "Chair", parent, Pose((x, 1.0)), footprint, "node", key, **changed)


PLACES = [chair(1.0), chair(3.0), chair(5.0), chair(7.0)]


def keys(elements):
    return [e.key for e in elements]


def test_the_places_are_those_of_the_same_polygon_best_first():
    elsewhere, on_a_wall, example = chair(2.0, parent="q"), chair(8.0, surface="wall"), chair(9.0, example=True)
    proposed = [elsewhere, PLACES[1], on_a_wall, PLACES[0], example, PLACES[2]]
    assert other_places(PLACES[0], proposed, [], [], None) == [PLACES[1], PLACES[0], PLACES[2]]


def test_what_another_one_stands_in_or_too_near_is_no_place():
    standing = [PLACES[0], chair(3.4, key="r@moved")]
    assert other_places(PLACES[0], PLACES, standing, [], None) == [PLACES[0], PLACES[2], PLACES[3]]
    assert other_places(PLACES[0], PLACES, standing, [], 1.7) == [PLACES[0], PLACES[3]]
    # What stands in another polygon, or on another surface, is not in the way.
    apart = [dataclasses.replace(standing[1], parent="q"), dataclasses.replace(standing[1], surface="wall")]
    assert other_places(PLACES[0], PLACES, apart, [], 1.7) == PLACES


def test_a_result_does_not_come_home_to_where_another_has_been_taken():
    away = taken_on(Decisions(), PLACES[0], PLACES, ROOM, 1)
    standing = [dataclasses.replace(PLACES[0], pose=PLACES[1].pose), chair(1.2, key="r@taken")]
    places = other_places(PLACES[0], PLACES, standing, [], None)
    assert places == PLACES[1:]
    back = taken_on(away, PLACES[0], places, ROOM, -1)
    assert back.pinned[PLACES[0].key] == Pin.of(PLACES[3].pose, ROOM)


def test_rejected_places_are_left_out_by_what_they_mean():
    assert other_places(PLACES[0], PLACES, [], ["r@3002,1", "q@5000,0"], None) == [PLACES[0], PLACES[2], PLACES[3]]


@pytest.mark.parametrize(
    ("steps", "x"),
    [
        ([1], 5.0),
        ([1, 1], 7.0),
        ([1, 1, 1], 1.0),
        ([-1], 1.0),
        ([-1, -1], 7.0),
        ([2], 7.0),
        ([-3], 5.0),
        ([1, -1], 3.0),
    ],
)
def test_places_follow_one_another_and_begin_again(steps, x):
    own, decisions = PLACES[1], Decisions()
    for step in steps:
        decisions = taken_on(decisions, own, PLACES, ROOM, step)
    (stands,) = decisions.apply(PLACES, [own], None, Scene([ROOM]))
    assert stands.pose.position == pytest.approx((x, 1.0)) and stands.key == own.key
    assert (decisions == Decisions()) == (x == 3.0)


def test_places_that_differ_in_mirroring_alone_are_two():
    twin = dataclasses.replace(PLACES[0], key="r@1000,0,2", pose=Pose((1.0, 1.0), mirrored=True))
    once = taken_on(Decisions(), PLACES[0], [PLACES[0], twin], ROOM, 1)
    assert once.pinned[PLACES[0].key].mirrored
    assert taken_on(once, PLACES[0], [PLACES[0], twin], ROOM, 1) == Decisions()


def test_what_was_accepted_at_its_own_place_stays_accepted():
    decisions = Decisions().accept(PLACES[0].key)
    there = taken_on(decisions, PLACES[0], PLACES, ROOM, 1)
    assert there.pinned and taken_on(there, PLACES[0], PLACES, ROOM, -1) == decisions


@pytest.mark.parametrize(("step", "x"), [(1, 1.0), (2, 3.0), (-1, 7.0)])
def test_from_none_of_its_places_it_comes_to_the_first_or_the_last(step, x):
    pinned = Decisions().pin(PLACES[2].key, Pin.of(Pose((5.5, 2.0)), ROOM))
    decisions = taken_on(pinned, PLACES[2], PLACES, ROOM, step)
    assert decisions.pinned[PLACES[2].key] == Pin.of(Pose((x, 1.0)), ROOM)


def test_without_another_place_there_is_nothing_to_decide():
    assert taken_on(Decisions(), PLACES[0], PLACES[:1], ROOM, 1) is None


def test_decisions_follow_the_keys_that_results_have_now():
    pin = Pin("r", (0.1, 0.0))
    decisions = Decisions(("r@0,0",), ("r@200,0", "q@0,0"), {"r@400,0": pin})
    now = decisions.following(["r@2,0", "r@201,3", "r@399,0"])
    assert now == Decisions(("r@2,0",), ("r@201,3", "q@0,0"), {"r@399,0": pin})
    # Pinned again by its present key, a result is pinned once.
    again = now.pin("r@399,0", Pin("r", (0.2, 0.0)))
    assert list(again.pinned) == ["r@399,0"]
