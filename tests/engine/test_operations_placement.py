"""The placement by several examples as an operation: arrays, sifting, its examples, decisions, storage."""

import dataclasses
import json
import pickle

import numpy as np
import pytest
from placement_scenes import below, facade, overlap, polygon

import geoanalogy as ga
from geoanalogy import InputError, OperationsTree
from geoanalogy.operations.decisions import Decisions
from geoanalogy.operations.layout import Layout
from geoanalogy.operations.node import Link, Node
from geoanalogy.operations.rectangle_placement import RectanglePlacement, outline_of, placement_key, siblings

STREET = ga.Scene(facade(0, 4, 3) + facade(20, 5, 4, name="g") + facade(50, 2, 2, name="h"))
SHOWN = ("f 0 0", "f 2 1", "f 1 2", "f 3 0")
SIZE = (1.4, 0.2)


def sills(shown=SHOWN, **settings):
    given = {"mesh": "Sill", "label": "sill", "size": SIZE, **settings}
    return RectanglePlacement.learned([ga.Example(STREET, below(STREET, i)) for i in shown], **given)


def rectangle_of(element):
    return outline_of([element])


def applied(operation, scene=STREET):
    return OperationsTree([Node("sills", operation)]).apply(scene)


def test_a_sill_is_placed_below_every_window_and_the_examples_are_shown_as_examples():
    elements = applied(sills())
    examples = [e for e in elements if e.example]
    for e, id in zip(examples, SHOWN, strict=True):
        assert e.ring == pytest.approx(below(STREET, id).ring)
    windows = [p.id for p in STREET.polygons if p.label == "window"]
    for id in windows:
        assert sum(overlap(rectangle_of(e), below(STREET, id)) > 0.8 for e in elements) == 1
    assert len(elements) == len(windows)
    assert {e.parent for e in elements} == {"f", "g", "h"}


def test_a_stretched_object_fills_its_placement_exactly():
    narrow = sills(size=(0.7, 0.1))
    for one, other in zip(applied(sills()), applied(narrow), strict=True):
        assert other.stretch == pytest.approx(np.multiply(one.stretch, 2.0))
        assert other.ring == pytest.approx(one.ring)
        assert (other.pose, other.key, other.importance) == (one.pose, one.key, one.importance)
        assert other.reach == pytest.approx(np.hypot(*(one.ring[0] - one.pose.position)))


def test_a_repeated_object_keeps_its_size_and_its_distance_and_stays_in_its_placement():
    whole = {placement_key(e.key): rectangle_of(e) for e in applied(sills()) if not e.example}
    for e in (pots := [e for e in applied(sills(size=(0.3, 0.2), fit=("repeat", "scale"), gap=(0.1, 0.0)))]):
        assert e.example or e.stretch[0] == 1.0
    rows = {}
    for e in pots:
        if not e.example:
            rows.setdefault(placement_key(e.key), []).append(e)
    assert set(rows) == set(whole)
    for key, row in rows.items():
        # 1.4 wide: pots of 0.3 with 0.1 between fit three times, and are spread to both ends.
        assert len(row) == 3
        assert siblings(row[1].key, [e.key for e in pots]) == [e.key for e in row]
        x = sorted(e.pose.position[0] for e in row)
        assert np.diff(x).min() >= 0.4
        assert outline_of(row).ring == pytest.approx(whole[key].ring, abs=1e-9)


def test_the_threshold_sifts_without_computing_and_gives_what_the_model_gives_there():
    tree = OperationsTree([Node("sills", sills(("f 0 0", "f 2 1"), threshold=0.5))])
    low = tree.apply(STREET)
    for threshold in (0.3, 0.7, 0.9):
        operation = sills(("f 0 0", "f 2 1"), threshold=threshold)
        tree = tree.with_node(Node("sills", operation))
        scores = [e.importance for e in tree.apply(STREET) if not e.example]
        assert scores == pytest.approx([p.score for p in operation.model.place(STREET, threshold)])
    assert tree.evaluations.evaluated == 1
    assert tree.with_node(Node("sills", sills(("f 0 0", "f 2 1")))).apply(STREET) == low


def test_at_most_so_many_placements_per_parent_the_examples_and_all_of_an_array_counted():
    tree = OperationsTree([Node("pots", sills(size=(0.3, 0.2), fit=("repeat", "scale"), max_per={"facade": 6}))])
    kept = {}
    for e in tree.apply(STREET):
        kept.setdefault(e.parent, set()).add(placement_key(e.key))
    assert {parent: len(keys) for parent, keys in kept.items()} == {"f": 6, "g": 6, "h": 4}
    assert len([e for e in tree.apply(STREET) if e.parent == "g"]) == 6 * 4


def test_drawn_examples_are_filled_where_no_objects_stand():
    filled = applied(sills(fill=[True] * 4, size=(0.3, 0.2), fit=("repeat", "scale")))
    assert not any(e.example for e in filled)
    for id in SHOWN:
        inside = [e for e in filled if e.parent == "f" and overlap(rectangle_of(e), below(STREET, id)) > 0]
        assert len(inside) == 4
        assert outline_of(inside).ring == pytest.approx(below(STREET, id).ring)


def test_some_examples_may_stand_and_others_be_filled():
    found = applied(sills(fill=[False, True, False, True]))
    standing = [e for e in found if e.example]
    assert [overlap(rectangle_of(e), below(STREET, id)) for e, id in zip(standing, SHOWN[::2], strict=True)] == [
        pytest.approx(1.0),
        pytest.approx(1.0),
    ]
    assert len(found) == len(applied(sills()))


def test_an_example_given_twice_counts_once():
    twice = [ga.Example(STREET, below(STREET, i)) for i in (*SHOWN, SHOWN[0])]
    operation = RectanglePlacement.learned(
        twice, mesh="Sill", label="sill", size=SIZE, fill=[True, False, False, True, True]
    )
    assert operation.fill == (True, False, False, True)


def test_preferences_grade_the_examples_that_are_filled():
    targets = dict(zip(SHOWN, (1.0, 0.6, 1.0, 0.0), strict=True))
    examples = [ga.Example(STREET, below(STREET, i), t) for i, t in targets.items()]
    operation = RectanglePlacement.learned(examples, mesh="Sill", label="sill", size=SIZE, fill=[True] * 4)
    found = applied(operation)
    for id, target in targets.items():
        scores = [e.importance for e in found if overlap(rectangle_of(e), below(STREET, id)) > 0.5]
        assert scores == ([target] if target else [])


def test_examples_are_known_again_where_a_replay_differs_in_the_last_bit():
    operation = sills()
    nudged = [
        p if p.label == "facade" else ga.Polygon(p.points * (1 + 1e-13), label=p.label, id=p.id)
        for p in STREET.polygons
    ]
    before, after = applied(operation), applied(operation, ga.Scene(nudged))
    assert [e.key for e in after if e.example] == [e.key for e in before if e.example]
    assert len(after) == len(before)


def test_in_another_scene_there_are_no_examples():
    elsewhere = ga.Scene([ga.Polygon(p.points + np.array([0, 7]), label=p.label, id=p.id) for p in STREET.polygons])
    elements = applied(sills(), elsewhere)
    assert not any(e.example for e in elements)
    assert len(elements) == sum(p.label == "window" for p in STREET.polygons)


def test_rejected_results_stay_away_by_their_keys():
    found = applied(sills())
    gone = next(e for e in found if not e.example)
    after = applied(sills(decisions=Decisions(rejected=(gone.key,))))
    assert {e.key for e in found} - {e.key for e in after} == {gone.key}


def test_a_later_operation_places_on_what_an_earlier_one_has_placed():
    first = Node("sills", sills())
    seen = OperationsTree([first]).layout(STREET).scene
    sill = next(p for p in seen.polygons if p.label == "sill" and p.id.startswith("sills/f@"))
    others = [p for p in seen.polygons if p.label == "sill" and p.id != sill.id][:1]
    pots = [ga.Rectangle(float(p.bounds[0]) + 0.3, float(p.bounds[1]) - 0.15, 0.3, 0.3) for p in (sill, *others)]
    examples = [ga.Example(seen, r) for r in pots]
    pot = RectanglePlacement.learned(examples, mesh="Pot", label="pot", size=(0.3, 0.3))
    tree = OperationsTree([first, Node("pots", pot, (Link("sills"),))])
    found = [e for e in tree.apply(STREET) if e.label == "pot"]
    assert {e.parent for e in found} == {"f", "g", "h"}
    assert len(found) == sum(e.label == "sill" for e in tree.apply(STREET))


def test_novelty_is_kept_with_the_results():
    found = [e for e in applied(sills()) if not e.example]
    placed = sills().model.place(STREET)
    assert [e.novelty for e in found] == pytest.approx([p.novelty for p in placed])


def test_it_reads_its_parents_and_all_below_them():
    more = STREET.with_polygons([polygon(0, -30, 8, 8, "pond", "pond"), polygon(1, -29, 1, 1, "window", "drowned")])
    read = {p.id for p in sills().reads(Layout(more))}
    assert read == {p.id for p in STREET.polygons}


def test_an_outline_is_stretched_over_the_placements():
    diamond = ((0.5, 0.0), (0.0, 0.5), (-0.5, 0.0), (0.0, -0.5))
    whole, cut = applied(sills()), applied(sills(outline=diamond))
    assert len(whole) == len(cut) > 4
    for a, b in zip(whole, cut, strict=True):
        assert b.polygon.area == pytest.approx(a.polygon.area / 2)
        assert b.polygon.bounds == pytest.approx(a.polygon.bounds)


def test_it_is_stored_with_its_model_and_gives_the_same_again():
    corner = ((0.5, -0.5), (0.5, 0.5), (-0.5, -0.5))
    more = {"fit": ("repeat", "scale"), "gap": (0.1, 0.0), "outline": corner}
    operation = sills(threshold=0.4, fill=[True, False, True, True], **more)
    tree = OperationsTree([Node("sills", operation)])
    again = OperationsTree.from_dict(json.loads(json.dumps(tree.to_dict())))
    assert again.to_dict() == tree.to_dict()
    assert again.apply(STREET) == tree.apply(STREET)


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"size": (0.0, 0.2)}, "has no area"),
        ({"gap": (-1.0, 0.0)}, "the distance along the width is -1.0; give a number that is not negative"),
        ({"fit": ("repeat", "wrap")}, "the fit along the height is 'wrap'; choose 'scale', 'repeat' or 'divide'"),
        ({"outline": ((0.5, 0.0), (-0.5, 0.0))}, "the outline is no ring; give at least three corners"),
        (
            {"outline": ((0.0, 0.5), (0.5, -0.5), (-0.5, -0.5))},
            "no ring; give at least three corners, counter-clockwise",
        ),
        ({"fill": (True,)}, "4 polygons and 1 signs to fill for 4 examples"),
        ({"grounds": ()}, "0 polygons and 0 signs to fill for 4 examples; give one of each per example"),
    ],
)
def test_settings_that_cannot_be_are_refused_at_once(settings, message):
    good = sills()
    given = {"mesh": "Sill", "label": "sill", "model": good.model, "grounds": good.grounds, "size": SIZE}
    with pytest.raises(InputError, match=message):
        RectanglePlacement(**{**given, **settings})


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("size", [1.0], "damaged setting 'size'"),
        ("fit", ["scale", "wrap"], "setting 'fit': 'wrap' is not among scale, repeat"),
        ("grounds", [["f", "left", 0, 1, 1]], "setting 'grounds': 'left' is no finite number"),
        ("model", {"schema": "geoanalogy.placement/99"}, "setting 'model': this is no stored placement model"),
    ],
)
def test_a_damaged_setting_is_named(name, value, message):
    with pytest.raises(InputError, match=message):
        RectanglePlacement.from_dict({**sills().to_dict(), name: value})


def test_moving_one_example_evaluates_only_what_depends_on_it():
    gardens = [polygon(20.0 * i, -20, 8 + i, 9, "garden", f"garden {i}") for i in range(3)]
    scene = ga.Scene([*STREET.polygons, *gardens])
    shed = [ga.Example(scene, ga.Rectangle(20.0 * i + 2, -18, 2, 2)) for i in range(2)]
    pot = [ga.Example(scene, ga.Rectangle(r.x, r.y - 0.3, 0.3, 0.3)) for r in (below(scene, i) for i in SHOWN[:2])]

    def sill(moved):
        shown = [below(scene, i) for i in SHOWN]
        shown[1] = ga.Rectangle(shown[1].x, shown[1].y - moved, shown[1].width, shown[1].height)
        examples = [ga.Example(scene, r) for r in shown]
        return Node("sills", RectanglePlacement.learned(examples, mesh="Sill", label="sill", size=SIZE))

    pots = Node("pots", RectanglePlacement.learned(pot, mesh="Pot", label="pot", size=(0.3, 0.3)), (Link("sills"),))
    sheds = Node("sheds", RectanglePlacement.learned(shed, mesh="Shed", label="shed", size=(2, 2)), (Link("pots"),))
    tree = OperationsTree([sill(0.0), pots, sheds])
    tree.apply(scene)
    before = tree.evaluations.evaluated
    assert before == 3
    tree.with_node(sill(0.0)).apply(scene)
    assert tree.evaluations.evaluated == before
    # The pots stand on facades, where sills are; the sheds in gardens, where nothing has changed.
    tree.with_node(sill(0.05)).apply(scene)
    assert tree.evaluations.evaluated == before + 2


def test_elements_that_come_from_another_process_are_equal_and_carry_nothing_derived():
    element = applied(sills())[0]
    assert {element: 1}[element] == 1 and element.id and element.polygon is not None
    copied = pickle.loads(pickle.dumps(element))
    assert copied == element and copied.id == element.id
    assert set(pickle.loads(pickle.dumps(element)).__dict__) == {f.name for f in dataclasses.fields(element)}
