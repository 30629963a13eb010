"""Every kind of operation: what it places, what it reads, and that it is stored."""

import dataclasses
import json

import numpy as np
import pytest
from edits import BED, TABLE, placement, rooms
from shapely import Polygon as Shape
from shapes import rectangle, regular, ring

from geoanalogy import Example, InputError, OperationsTree, Polygon, Pose, Rectangle, Scene
from geoanalogy.operations.array_placement import ArrayPlacement
from geoanalogy.operations.choice_placement import ChoicePlacement
from geoanalogy.operations.group_placement import GroupPlacement
from geoanalogy.operations.node import Link, Node
from geoanalogy.operations.placing import Placing
from geoanalogy.operations.pose_placement import PosePlacement
from geoanalogy.operations.rectangle_placement import RectanglePlacement
from geoanalogy.operations.scatter_placement import ScatterPlacement
from geoanalogy.operations.table import OPERATIONS
from geoanalogy.poses.arrays import learn_array
from geoanalogy.poses.group_transfer import GroupObject, GroupTransfer, TransferOptions
from geoanalogy.poses.propagate import learn_pose
from geoanalogy.poses.scatter import ScatterModel, ScatterOptions

PLACING = [name for name, kind in OPERATIONS.items() if issubclass(kind, Placing)]

TREE = ring((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5))


def lawns(count=3):
    return [Polygon(rectangle(12, 8, (15.0 * i, 0.0)), label="lawn", id=f"lawn {i}") for i in range(count)]


def applied(operation, scene, seed=0, name="node"):
    return OperationsTree([Node(name, operation)]).apply(scene, seed)


@pytest.fixture(scope="module")
def operations():
    """One operation of every kind, learned from the first lawn."""
    scene = Scene(lawns())
    poses = [learn_pose(scene, Pose(p), TREE) for p in ((1, 1), (6, 1))]
    flowers = [GroupObject(Pose((2, 1), 0.3), TABLE), GroupObject(Pose((6, 4), 0.0))]
    return {
        "pose placement": PosePlacement(mesh="Tree", label="tree", model=poses[0], threshold=0.5),
        "array": ArrayPlacement(
            mesh="Tree", label="tree", model=learn_array(scene, Pose((2, 1)), Pose((9, 1)), 2.0, TREE)
        ),
        "local coordinates": GroupPlacement(
            meshes=("Rose", "Lily"), labels=("rose", "lily"), group=GroupTransfer(lawns()[0], flowers)
        ),
        "scatter": ScatterPlacement(
            mesh="Tree", label="tree", model=ScatterModel(poses[0], ScatterOptions(count=5)), seed=2
        ),
        "choice": ChoicePlacement(
            meshes=("Oak", "Elm"), label="tree", models=tuple(poses), max_per={"lawn": 1}, weights=(1.0, 2.0)
        ),
        "placement": RectanglePlacement.learned(
            [Example(scene, Rectangle(1, 1, 1, 1)), Example(scene, Rectangle(11, 1, 1, 1))],
            mesh="Tree",
            label="tree",
            size=(1.0, 1.0),
        ),
    }


def test_there_is_a_test_for_every_kind(operations):
    assert set(operations) == set(PLACING)
    assert all(kind.type == name for name, kind in OPERATIONS.items())


@pytest.mark.parametrize("kind", PLACING)
def test_every_kind_is_stored_and_gives_the_same_again(operations, kind):
    operation = operations[kind]
    plain = json.loads(json.dumps(operation.to_dict()))
    again = OPERATIONS[kind].from_dict(plain)
    assert again.to_dict() == operation.to_dict()
    assert applied(again, Scene(lawns()), 3) == applied(operation, Scene(lawns()), 3)


@pytest.mark.parametrize("kind", PLACING)
def test_every_kind_places_in_every_lawn_and_shows_its_example(operations, kind):
    elements = applied(operations[kind], Scene(lawns()), 3)
    assert {e.parent for e in elements} == {"lawn 0", "lawn 1", "lawn 2"}
    examples = [e for e in elements if e.example]
    assert {e.parent for e in examples} == {"lawn 0"}
    assert elements[0].example
    assert len({e.id for e in elements}) == len(elements)
    for e in elements:
        assert e.node == "node" and e.id == f"node/{e.key}"
        assert Shape(lawns()[int(e.parent[-1])].points).buffer(0.3).contains(Shape(e.ring)) if e.footprint else True


@pytest.mark.parametrize("kind", PLACING)
def test_no_kind_reads_what_stands_elsewhere(operations, kind):
    scene = Scene(lawns())
    more = scene.with_polygons([Polygon(rectangle(5, 5, (0.0, 30.0)), label="pond", id="pond")])
    tree = OperationsTree([Node("node", operations[kind])])
    one = tree.apply(scene)
    assert tree.apply(more) == one
    assert (tree.evaluations.evaluated, tree.evaluations.reused) == (1, 1)
    wider = [Polygon(p.points * (1, 1.1), label=p.label, id=p.id) if p.id == "lawn 2" else p for p in lawns()]
    tree.apply(Scene(wider))
    assert tree.evaluations.evaluated == 2


@pytest.mark.parametrize("kind", PLACING)
def test_only_chance_depends_on_the_seed(operations, kind):
    # Choices differ by lawn: a few seeds, for one that differs.
    random = kind in ("scatter", "choice")
    results = [applied(operations[kind], Scene(lawns()), seed) for seed in range(6 if random else 2)]
    assert all(r == results[0] for r in results) is not random
    assert OPERATIONS[kind].random is random


@pytest.mark.parametrize("kind", PLACING)
def test_a_setting_that_is_missing_unknown_or_damaged_is_named(operations, kind):
    plain = operations[kind].to_dict()
    with pytest.raises(InputError, match=f"the operation '{kind}' has no setting 'colour'; it may come from a newer"):
        OPERATIONS[kind].from_dict({**plain, "colour": 1})
    for name in plain:
        field = next(f for f in dataclasses.fields(OPERATIONS[kind]) if f.name == name)
        if field.default is dataclasses.MISSING and field.default_factory is dataclasses.MISSING:
            rest = {k: v for k, v in plain.items() if k != name}
            with pytest.raises(InputError, match=f"the operation '{kind}' lacks the setting '{name}'; record it again"):
                OPERATIONS[kind].from_dict(rest)
    with pytest.raises(InputError, match=f"the operation '{kind}' has settings that are no object"):
        OPERATIONS[kind].from_dict(None)
    with pytest.raises(InputError, match=f"the operation '{kind}' has a damaged setting 'decisions'; record it again"):
        OPERATIONS[kind].from_dict({**plain, "decisions": 3})


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("mesh", 3, "setting 'mesh': 3 is no text"),
        ("threshold", "high", "setting 'threshold': 'high' is no finite number"),
        ("threshold", float("nan"), "setting 'threshold': nan is no finite number"),
        ("max_per", {"room": 1.5}, "setting 'max_per': 1.5 is no whole number"),
        ("max_per", [1], "damaged setting 'max_per'"),
        ("spacing", True, "setting 'spacing': True is no finite number"),
    ],
)
def test_a_value_of_the_wrong_kind_is_refused(operations, name, value, message):
    with pytest.raises(InputError, match=message):
        PosePlacement.from_dict({**operations["pose placement"].to_dict(), name: value})


# ------------------------------------------------------------------------------------------------ pose placement


def test_the_threshold_lets_fewer_pass(operations):
    scene = Scene(lawns())
    operation = operations["pose placement"]
    counts = [len(applied(dataclasses.replace(operation, threshold=t), scene)) for t in (0.0, 0.5, 0.9, 1.1)]
    assert counts == sorted(counts, reverse=True) and counts[0] > counts[2] and counts[3] == 1


def test_at_most_so_many_per_parent_the_example_among_them(operations):
    scene = Scene(lawns())
    operation = dataclasses.replace(operations["pose placement"], max_per={"lawn": 2}, threshold=0.0)
    elements = applied(operation, scene)
    assert sorted(e.parent for e in elements) == [f"lawn {i}" for i in (0, 0, 1, 1, 2, 2)]


def test_a_spacing_thins_the_results(operations):
    scene = Scene(lawns())
    operation = dataclasses.replace(operations["pose placement"], spacing=5.0, threshold=0.0)
    elements = applied(operation, scene)
    for i in range(3):
        here = np.array([e.pose.position for e in elements if e.parent == f"lawn {i}"])
        gaps = np.hypot(*(here[:, None] - here).transpose(2, 0, 1)) + 99 * np.eye(len(here))
        assert gaps.min() >= 5.0


def test_results_of_one_operation_do_not_intersect():
    scene = Scene(rooms())
    elements = applied(placement(scene, (1.1, 0.6), BED, "bed", threshold=0.0, max_per={}), scene)
    assert len(elements) >= 6
    outlines = [Shape(e.ring) for e in elements]
    shared = [a.intersection(b).area for i, a in enumerate(outlines) for b in outlines[:i]]
    assert max(shared) <= 0.02 * outlines[0].area + 1e-9


def test_a_point_is_placed_but_later_operations_do_not_see_it():
    scene = Scene(rooms())
    operation = placement(scene, (1.0, 0.5), None, "lamp")
    layout = OperationsTree([Node("lamp", operation)]).layout(scene)
    assert len(layout.elements) == 3 and len(layout.scene) == 3
    assert layout.elements[0].ring is None and layout.elements[0].reach == 0.0


# ------------------------------------------------------------------------------------------------ the others


def test_an_array_places_every_object_of_its_row(operations):
    elements = applied(operations["array"], Scene(lawns()))
    own = np.array([e.pose.position for e in elements if e.parent == "lawn 0" and e.pose.position[1] < 2])
    assert own == pytest.approx(np.array([(2, 1), (4, 1), (6, 1), (8, 1)]))
    assert [e.example for e in elements[:4]] == [True, False, False, False]
    weak = dataclasses.replace(operations["array"], threshold=1.1)
    assert [e.example for e in applied(weak, Scene(lawns()))] == [True]


def test_bushes_round_a_fountain_that_an_operation_has_placed():
    scene = Scene(lawns())
    fountain = Node("fountain", placement(scene, (6, 4), regular(32, 1.5), "fountain", max_per={"lawn": 1}))
    tree = OperationsTree([fountain])
    layout = tree.layout(scene)
    model = learn_array(layout.scene, Pose((8.5, 4)), None, 1.0, TABLE)
    bushes = Node("bushes", ArrayPlacement(mesh="Bush", label="bush", model=model), (Link("fountain"),))
    elements = tree.with_node(bushes).apply(scene)
    for i in range(3):
        centre = next(e.pose.position for e in elements if e.node == "fountain" and e.parent == f"lawn {i}")
        ring_of = np.array([e.pose.position for e in elements if e.node == "bushes" and e.parent == f"lawn {i}"])
        assert len(ring_of) >= 15
        assert np.hypot(*(ring_of - centre).T) == pytest.approx([2.5] * len(ring_of), abs=0.1)


def test_a_group_is_taken_to_every_lawn_and_is_its_own_example(operations):
    elements = applied(operations["local coordinates"], Scene(lawns()))
    assert [(e.parent, e.label, e.mesh) for e in elements] == [
        (f"lawn {i}", label, mesh) for i in range(3) for label, mesh in (("rose", "Rose"), ("lily", "Lily"))
    ]
    for e in elements:
        i = int(e.parent[-1])
        assert e.pose.position == pytest.approx((15 * i + 2, 1) if e.label == "rose" else (15 * i + 6, 4), abs=1e-4)
    others = applied(dataclasses.replace(operations["local coordinates"], own=False), Scene(lawns()))
    assert {e.parent for e in others} == {"lawn 1", "lawn 2"}


def test_what_a_lawn_has_no_room_for_is_left_out_unless_everything_is_wanted(operations):
    narrow = Polygon(rectangle(12, 1, (0.0, 20.0)), label="lawn", id="lawn 9")
    scene = Scene([*lawns(1), narrow])
    group = operations["local coordinates"].group
    absolute = GroupTransfer(group.source, group.objects, TransferOptions(distance="absolute"))
    operation = dataclasses.replace(operations["local coordinates"], group=absolute)
    assert "lawn 9" not in {e.parent for e in applied(operation, scene)}
    there = [e for e in applied(dataclasses.replace(operation, everything=True), scene) if e.parent == "lawn 9"]
    assert [e.importance for e in there] == [0.0, 0.0]
    assert [e.pose.position[1] for e in there] == pytest.approx([20.5, 20.5], abs=1e-4)


def test_a_scatter_draws_anew_for_its_own_seed(operations):
    scene = Scene(lawns())
    drawn = [applied(dataclasses.replace(operations["scatter"], seed=s), scene) for s in (0, 1)]
    assert [len(d) for d in drawn] == [16, 16]
    assert drawn[0] != drawn[1]


def test_a_choice_places_one_of_its_objects_per_lawn(operations):
    scene = Scene(lawns(12))
    elements = [e for e in applied(operations["choice"], scene) if not e.example]
    assert len({e.parent for e in elements}) == len(elements) == 11
    assert {e.mesh for e in elements} == {"Oak", "Elm"}
    for e in elements:
        x = e.pose.position[0] - scene.polygon(e.parent).centroid[0]
        assert abs(x) == pytest.approx(5 if e.mesh == "Oak" else 0, abs=0.1)


def test_a_choice_by_house_reads_the_houses(operations):
    operation = dataclasses.replace(operations["choice"], scope="garden")
    around = Polygon(rectangle(60, 20, (-2.0, -2.0)), label="garden", id="garden")
    scene = Scene([*lawns(), around])
    tree = OperationsTree([Node("node", operation)])
    assert len({e.mesh for e in tree.apply(scene) if not e.example}) == 1
    tree.apply(Scene([*lawns(), Polygon(around.points * 1.2, label="garden", id="garden")]))
    assert tree.evaluations.evaluated == 2


@pytest.mark.parametrize(
    ("kind", "change", "message"),
    [
        ("choice", {"meshes": ("Oak",)}, "there are 1 library objects for 2 examples; give one per example"),
        ("choice", {"weights": (1.0,)}, "there are 1 weights for 2 examples"),
        ("local coordinates", {"labels": ()}, "there are 2 library objects and 0 labels for 2 objects of the group"),
    ],
)
def test_numbers_that_do_not_fit_are_refused(operations, kind, change, message):
    with pytest.raises(InputError, match=message):
        dataclasses.replace(operations[kind], **change)
