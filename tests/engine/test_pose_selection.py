"""Probabilistic selection (section 4.8): one example per scope, whatever the order of the scene."""

from collections import Counter

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapes import rectangle, ring

from geoanalogy import Cancelled, InputError, Polygon, Pose, Scene
from geoanalogy.poses.propagate import learn_pose
from geoanalogy.poses.selection import PoseChoice, choose, place_generator

CRATE = ring((-0.2, -0.2), (0.2, -0.2), (0.2, 0.2), (-0.2, 0.2))


def rooms(count, label="room"):
    return [Polygon(rectangle(4, 3, (5.0 * i, 0.0)), label=label, id=f"r{i}") for i in range(count)]


@pytest.fixture(scope="module")
def models():
    scene = Scene(rooms(1))
    return [learn_pose(scene, Pose((x, 0.2)), CRATE) for x in (0.3, 1.0)]


def test_a_generator_belongs_to_a_place_a_seed_and_a_purpose():
    room = rooms(2)
    turned = Polygon(np.roll(room[0].points, 2, axis=0), label="room", id="another name")

    def draw(*arguments):
        return place_generator(*arguments).random()

    assert draw(1, room[0], "choice") == draw(1, turned, "choice")
    different = [draw(1, room[0], "choice"), draw(1, room[1], "choice"), draw(2, room[0], "choice")]
    different += [draw(1, room[0], "scatter"), draw(1, rooms(1, "hall")[0], "choice")]
    assert len(set(different)) == 5


@given(st.lists(st.floats(0.1, 5.0), min_size=1, max_size=5), st.integers(0, 10**9))
@settings(max_examples=50)
def test_another_example_at_the_end_changes_a_choice_only_to_itself(weights, seed):
    scope = rooms(1)[0]
    before, after = choose(scope, weights, seed), choose(scope, [*weights, 1.0], seed)
    assert after in (before, len(weights))


def test_examples_are_chosen_in_proportion_to_their_weights():
    drawn = Counter(choose(room, [1.0, 3.0, 0.0], seed=4) for room in rooms(2000))
    assert drawn[2] == 0
    assert drawn[1] / 2000 == pytest.approx(0.75, abs=0.04)


def test_every_scope_has_matches_of_one_example_only(models):
    scene = Scene(rooms(12))
    choice = PoseChoice(models, seed=3)
    results = choice.place(scene)
    chosen = {p.id: choice.chosen_in(p) for p in scene.polygons}
    assert set(chosen.values()) == {0, 1}
    for i, found in enumerate(results):
        assert {r.parent.id for r in found} == {id for id, k in chosen.items() if k == i}
        assert np.diff([r.importance for r in found]).max() < 1e-3


def test_the_choice_does_not_depend_on_the_scenes_order(models):
    one, other = (
        {r.parent.id: i for i, found in enumerate(PoseChoice(models, seed=3).place(Scene(order))) for r in found}
        for order in (rooms(8), rooms(8)[::-1])
    )
    assert one == other


def test_another_seed_chooses_otherwise(models):
    picks = [[PoseChoice(models, seed=s).chosen_in(room) for room in rooms(12)] for s in (1, 2)]
    assert picks[0] != picks[1]


def test_a_scope_may_hold_several_parents(models):
    houses = [Polygon(rectangle(10, 3, (10.0 * i, 0.0)), label="house", id=f"h{i}") for i in range(6)]
    scene = Scene([*houses, *rooms(12)])
    results = PoseChoice(models, scope="house", seed=5).place(scene)
    per_house = {}
    for i, found in enumerate(results):
        for r in found:
            per_house.setdefault(scene.parent(r.parent.id).id, set()).add(i)
    assert len(per_house) == 6
    assert all(len(chosen) == 1 for chosen in per_house.values())
    assert set.union(*per_house.values()) == {0, 1}


def test_what_lies_in_no_scope_is_left_out(models):
    assert [len(found) for found in PoseChoice(models, scope="house").place(Scene(rooms(3)))] == [0, 0]


def test_a_choice_can_be_cancelled(models):
    with pytest.raises(Cancelled):
        PoseChoice(models).place(Scene(rooms(3)), progress=lambda *_: False)


@pytest.mark.parametrize("weights", [[-1.0, 2.0], [0.0, 0.0], [np.nan, 1.0]])
def test_weights_that_choose_nothing_are_refused(models, weights):
    with pytest.raises(InputError, match="the weights of a choice are not positive numbers"):
        PoseChoice(models, weights=weights)


def test_a_wrong_number_of_examples_or_weights_is_refused(models):
    with pytest.raises(InputError, match="there is no example to choose from"):
        PoseChoice([])
    with pytest.raises(InputError, match="there are 3 weights for 2 examples"):
        PoseChoice(models, weights=[1, 2, 3])
