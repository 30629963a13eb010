"""Rows of parents that hold fewer examples than their share hold fewer placements."""

import copy

import numpy as np
import pytest
from placement_scenes import facade, polygon

import geoanalogy as ga
from geoanalogy.placements.siblings import RATE_POWER, UNSEEN, row_odds, standing_of

COLUMNS, ROWS = 4, 5


def windows_of(scene):
    return [p for p in scene.polygons if p.label == "window"]


def standings(scene, *ids):
    return [standing_of(scene, scene.polygon(id)) for id in ids]


def blind(scene, id, height):
    """The upper part of a window."""
    x0, _, x1, y1 = scene.polygon(id).bounds
    return ga.Rectangle((x0 + x1) / 2, y1 - height / 2, x1 - x0, height)


@pytest.fixture
def scene():
    return ga.Scene(facade(0, COLUMNS, ROWS))


def test_rows_without_examples_are_doubted_by_their_share(scene):
    found = row_odds(scene, "window", standings(scene, "f 0 2", "f 1 2", "f 2 2", "f 3 2"))
    empty = RATE_POWER * np.log(UNSEEN / (4 / ROWS + UNSEEN))
    assert found == pytest.approx({p.id: empty for p in windows_of(scene) if not p.id.endswith(" 2")})


def test_examples_in_every_row_say_nothing_against_any(scene):
    assert row_odds(scene, "window", standings(scene, *(f"f 0 {j}" for j in range(ROWS)))) == {}


def test_a_few_examples_say_little(scene):
    one = row_odds(scene, "window", standings(scene, "f 0 0"))
    three = row_odds(scene, "window", standings(scene, "f 0 0", "f 1 0", "f 2 0"))
    assert 0 > one["f 0 1"] > three["f 0 1"]


def test_nothing_is_said_about_facades_without_examples():
    street = ga.Scene([*facade(0, COLUMNS, ROWS), *facade(20, COLUMNS, ROWS, name="g")])
    found = row_odds(street, "window", standings(street, "f 0 0", "f 1 0", "f 2 0"))
    assert found and all(id.startswith("f ") for id in found)


def test_parents_that_nothing_holds_stand_nowhere():
    rooms = ga.Scene([polygon(4 * i, 0, 3, 3, "room", f"r{i}") for i in range(3)])
    assert standing_of(rooms, rooms.polygon("r0")) is None
    assert row_odds(rooms, "room", []) == {}


def test_rooms_of_one_storey_stand_in_one_row():
    rooms = [polygon(0, 0, 40, 20, "plan", "plan")]
    rooms += [polygon(1 + 6 * i, 1, 4, height, "room", f"r{i}") for i, height in enumerate((3, 9, 4, 8, 3))]
    plan = ga.Scene(rooms)
    assert row_odds(plan, "room", standings(plan, "r0", "r2")) == {}


def scores_by_row(scene, model):
    """Best score in each row of windows."""
    best = np.zeros(ROWS)
    for p in model.place(scene, threshold=0.01):
        row = int(p.parent.id.split()[2])
        best[row] = max(best[row], p.score)
    return best


def drawn(scene, ids):
    """Blinds of somewhat different heights in some windows."""
    return [ga.Example(scene, blind(scene, id, 0.6 + 0.07 * n)) for n, id in enumerate(ids)]


def test_blinds_of_one_row_are_meant_in_that_row_first(scene):
    row = scores_by_row(scene, ga.learn_placement(drawn(scene, ("f 0 1", "f 1 1", "f 2 1"))))
    spread = scores_by_row(scene, ga.learn_placement(drawn(scene, ("f 0 1", "f 1 2", "f 2 4"))))
    others = [0, 2, 3, 4]  # rows without an example
    assert (row[others] < row[1] - 0.1).all()
    assert row[others].max() < spread[[1, 2, 4]].min() - 0.1


def test_a_stored_model_knows_the_rows(scene):
    model = ga.learn_placement(drawn(scene, ("f 0 1", "f 1 1", "f 2 1")))
    plain = model.to_dict()
    assert scores_by_row(scene, ga.PlacementModel.from_dict(plain)) == pytest.approx(scores_by_row(scene, model))
    without = copy.deepcopy(plain)
    for example in without["examples"]:
        del example["standing"]
    rows = scores_by_row(scene, ga.PlacementModel.from_dict(without))
    assert rows[0] > scores_by_row(scene, model)[0]
