"""The operations tree: order, replay, what is evaluated again, files (section 5.6)."""

import dataclasses
import json

import numpy as np
import pytest
from edits import BED, bed, placement, rooms, table
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import similarities

from geoanalogy import Cancelled, InputError, OperationsTree, Polygon, Pose, Scene
from geoanalogy.operations.node import Link, Node
from geoanalogy.operations.storage import SCHEMA, VERSION


@pytest.fixture(scope="module")
def chain():
    """A bed, then a night table beside it."""
    tree = OperationsTree([bed()])
    return tree.with_node(table(tree.layout(Scene(rooms()))))


def by_node(elements):
    found = {}
    for e in elements:
        found.setdefault(e.node, []).append(e)
    return found


# ------------------------------------------------------------------------------------------------ applying


def test_an_empty_tree_places_nothing():
    assert OperationsTree().apply(Scene(rooms())) == []


def test_every_room_gets_a_bed_and_a_table_beside_it(chain):
    placed = by_node(chain.apply(Scene(rooms())))
    beds, tables = (sorted(placed[node], key=lambda e: e.parent) for node in ("bed", "table"))
    assert [e.parent for e in beds] == [e.parent for e in tables] == ["bedroom 0", "bedroom 1", "bedroom 2"]
    for i, (one, other) in enumerate(zip(beds, tables, strict=True)):
        assert one.pose.position == pytest.approx((5 * i + 1.1, 0.6), abs=0.01)
        assert other.pose.position == pytest.approx((5 * i + 0.3, 1.4), abs=0.02)
        assert (one.mesh, one.label, one.surface, one.node) == ("Library bed", "bed", "ground", "bed")
        assert one.polygon.label == "bed" and one.polygon.id == one.id == f"bed/{one.key}"
        assert one.ring == pytest.approx(BED + one.pose.position, abs=0.01)


def test_the_example_is_an_element_where_its_room_is_in_the_scene(chain):
    first, *others = by_node(chain.apply(Scene(rooms())))["bed"]
    assert first.example and first.pose == Pose((1.1, 0.6)) and first.importance == 1.0
    assert not any(e.example for e in others)


def test_without_the_examples_room_there_are_results_only(chain):
    elements = chain.apply(Scene(rooms()[1:]))
    assert len(elements) == 4 and not any(e.example for e in elements)


def test_in_another_room_of_the_examples_name_there_is_no_example(chain):
    moved = [Polygon(p.points + (0, 20), label=p.label, id=p.id) for p in rooms()]  # noqa: RUF005
    elements = chain.apply(Scene(moved))
    assert not any(e.example for e in elements)
    assert len(by_node(elements)["bed"]) == 3


def test_single_precision_does_not_hide_the_example(chain):
    rounded = [Polygon(np.float32(p.points + 0.1) - np.float32(0.1), label=p.label, id=p.id) for p in rooms()]
    assert sum(e.example for e in chain.apply(Scene(rounded))) == 2


def test_later_operations_see_what_is_placed_upstream_and_no_more(chain):
    scene = Scene(rooms())
    ground = chain.layout(scene, "bed")
    assert [p.label for p in ground.scene.polygons] == ["bedroom"] * 3 + ["bed"] * 3
    beside = chain.with_node(Node("lamp", chain.node("table").operation))
    assert {p.label for p in beside.layout(scene, "lamp").scene.polygons} == {"bedroom", "table"}


def test_without_what_it_relates_to_an_operation_finds_less(chain):
    alone = OperationsTree([dataclasses.replace(chain.node("table"), inputs=())])
    scene = Scene(rooms()[1:])
    seen, unseen = (by_node(t.apply(scene)).get("table", []) for t in (chain, alone))
    assert len(seen) == 2
    assert max((e.importance for e in unseen), default=0.0) < min(e.importance for e in seen)


def test_a_muted_node_passes_on_what_comes_in(chain):
    muted = chain.with_node(dataclasses.replace(chain.node("bed"), muted=True))
    assert "bed" not in by_node(muted.apply(Scene(rooms())))
    assert muted.layout(Scene(rooms()), "bed").elements == ()
    last = chain.with_node(dataclasses.replace(chain.node("table"), muted=True))
    assert set(by_node(last.apply(Scene(rooms())))) == {"bed"}


def test_a_replay_gives_the_identical_elements(chain):
    again = OperationsTree.from_dict(json.loads(json.dumps(chain.to_dict())))
    assert again.apply(Scene(rooms()), seed=5) == chain.apply(Scene(rooms()), seed=5)


@given(similarities(scales=(1.0, 1.0)))
@settings(max_examples=6, deadline=None)
def test_a_moved_scene_has_the_moved_elements(move):
    tree = OperationsTree([bed()])
    scene = Scene([Polygon(move(p.points), label=p.label, id=p.id) for p in rooms(2)])
    elements = tree.apply(scene)
    wanted = [move(np.array([(5 * i + 1.1, 0.6)]))[0] for i in range(2)]
    assert len(elements) == 2
    for e in elements:
        # A rectangle fits onto itself turned by half: either corner is right.
        twin = [2 * scene.polygon(e.parent).centroid - w for w in wanted]
        assert min(np.hypot(*(np.array(e.pose.position) - w)) for w in [*wanted, *twin]) < 0.05


def test_the_order_of_independent_nodes_does_not_matter():
    scene = Scene([*rooms(2), *rooms(2, "kitchen", 5.0)])
    one = Node("bed", bed(scene).operation)
    other = Node("stove", placement(scene, (0.4, 5.4), BED * 0.3, "stove"))
    merged = Node("chair", placement(scene, (2.0, 1.0), BED * 0.2, "chair"), (Link("stove"), Link("bed")))
    swapped = dataclasses.replace(merged, inputs=merged.inputs[::-1])
    orders = [(one, other, merged), (merged, other, one), (other, swapped, one)]
    results = [OperationsTree(order).apply(scene, seed=1) for order in orders]
    assert all(r == results[0] for r in results)
    assert [node.id for node in OperationsTree([merged, other, one]).nodes] == ["bed", "stove", "chair"]


def test_what_reaches_a_leaf_on_two_ways_is_there_once(chain):
    lamp = Node("lamp", placement(chain.layout(Scene(rooms())).scene, (3, 2), BED * 0.2, "lamp"), (Link("bed"),))
    elements = chain.with_node(lamp).apply(Scene(rooms()))
    assert len({e.id for e in elements}) == len(elements)
    assert set(by_node(elements)) == {"bed", "table", "lamp"}


def test_leaves_are_what_nothing_takes_its_input_from(chain):
    assert chain.leaves == ("table",)
    assert chain.with_node(Node("lamp", chain.node("table").operation)).leaves == ("lamp", "table")


def test_the_stepper_tells_its_progress_and_can_be_cancelled(chain):
    told = []
    chain_again = OperationsTree(chain.nodes)
    chain_again.apply(Scene(rooms()), progress=lambda fraction, text: told.append((fraction, text)) or True)
    fractions = [fraction for fraction, _ in told]
    assert fractions == sorted(fractions) and 0 <= fractions[0] and fractions[-1] < 1
    assert {"bed", "table"} <= {text for _, text in told}
    with pytest.raises(Cancelled):
        chain_again.apply(Scene(rooms()), progress=lambda *_: False)


# ------------------------------------------------------------------------------------------------ evaluated again


def counted(tree, scene, seed=0):
    """How many nodes an application evaluates."""
    before = tree.evaluations.evaluated
    tree.apply(scene, seed)
    return tree.evaluations.evaluated - before


def test_only_what_changed_is_evaluated_again():
    scene = Scene([*rooms(), *rooms(label="kitchen", y=5.0)])
    tree = OperationsTree([bed(scene)])
    tree = tree.with_node(table(tree.layout(scene)))
    stove = Node("stove", placement(scene, (0.4, 5.4), BED * 0.3, "stove"), (Link("table"),))
    tree = tree.with_node(stove)
    tree.apply(scene)
    assert counted(tree, scene) == 0
    # Another threshold, decisions and muting only sift.
    operation = dataclasses.replace(stove.operation, threshold=0.7)
    assert counted(tree.with_node(dataclasses.replace(stove, operation=operation)), scene) == 0
    # The stove stands in kitchens: what is in bedrooms does not reach it.
    fewer = dataclasses.replace(tree.node("table").operation, threshold=2.0)
    assert counted(tree.with_node(dataclasses.replace(tree.node("table"), operation=fewer)), scene) == 0
    # The table stands beside beds.
    without = dataclasses.replace(tree.node("bed").operation, threshold=2.0)
    assert counted(tree.with_node(dataclasses.replace(tree.node("bed"), operation=without)), scene) == 1
    # A moved example: its own node, and what sees its results.
    other = placement(scene, (1.3, 0.6), BED, "bed")
    assert counted(tree.with_node(dataclasses.replace(tree.node("bed"), operation=other)), scene) == 2
    # A wall of a kitchen.
    wider = [
        Polygon(p.points * (1, 1.01), label=p.label, id=p.id) if p.label == "kitchen" else p for p in scene.polygons
    ]
    assert counted(tree, Scene(wider)) == 1
    # Nothing here is left to chance.
    assert counted(tree, scene, seed=9) == 0


def test_a_renamed_node_is_evaluated_for_its_new_name():
    scene = Scene(rooms())
    tree = OperationsTree([bed()])
    tree.apply(scene)
    renamed = OperationsTree([dataclasses.replace(tree.node("bed"), id="bed.001")], tree.evaluations)
    assert {e.node for e in renamed.apply(scene)} == {"bed.001"}


# ------------------------------------------------------------------------------------------------ files


def test_a_saved_tree_loads_as_it_was(chain, tmp_path):
    path = tmp_path / "house.json"
    chain.save(path)
    loaded = OperationsTree.load(path)
    assert loaded.to_dict() == chain.to_dict()
    assert json.loads(path.read_text())["schema"] == f"{SCHEMA}/{VERSION}" == "geoanalogy.operations/1"
    assert [p.name for p in tmp_path.iterdir()] == ["house.json"]
    assert loaded.apply(Scene(rooms())) == chain.apply(Scene(rooms()))


def test_links_and_muting_are_stored(chain):
    tree = chain.with_node(dataclasses.replace(chain.node("table"), muted=True, inputs=(Link("bed"), Link("bed", 0))))
    again = OperationsTree.from_dict(tree.to_dict())
    assert again.node("table").muted and again.node("table").inputs == (Link("bed"), Link("bed"))
    assert Node.from_dict({**tree.node("table").to_dict(), "inputs": [{"node": "bed", "output": 3}]}).inputs == (
        Link("bed", 3),
    )


def test_where_saving_fails_the_file_stays(chain, tmp_path, monkeypatch):
    path = tmp_path / "house.json"
    path.write_text("what was there")
    with pytest.raises(InputError, match=r"house.json cannot be written: .*; choose another place"):
        chain.save(tmp_path / "missing" / "house.json")

    def fail(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.replace", fail)
    with pytest.raises(InputError, match=r"house.json cannot be written: No space left on device"):
        chain.save(path)
    assert path.read_text() == "what was there"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "house.json is damaged or cut off at line 1"),
        ('{"schema": "geoanalogy.operations/1", "nodes": [', "house.json is damaged or cut off at line 1"),
        ("[]", "house.json is no operations tree; choose a file that GeoAnalogy has saved"),
        ('{"schema": "other/1"}', "house.json is no operations tree"),
        ('{"schema": 1}', "house.json is no operations tree"),
        ('{"schema": "geoanalogy.operations/' + "9" * 5000 + '"}', "house.json was saved by a newer version"),
        ('{"schema": 1' + "0" * 5000 + "}", "house.json is no JSON text"),
        ('{"schema": "geoanalogy.operations/2", "nodes": []}', "saved by a newer version of GeoAnalogy .*update"),
        ('{"schema": "geoanalogy.operations/0", "nodes": []}', "house.json is damaged: it has no list of nodes"),
        ('{"schema": "geoanalogy.operations/1"}', "house.json is damaged: it has no list of nodes"),
        ('{"schema": "geoanalogy.operations/1", "nodes": [{}]}', "house.json: a node has no id; give it one"),
        (
            '{"schema": "geoanalogy.operations/1", "nodes": [{"id": "a", "type": "weld"}]}',
            "node 'a' is of the unknown type 'weld'; it may come from a newer version, known are pose placement",
        ),
        (
            '{"schema": "geoanalogy.operations/1", "nodes": [{"id": "a", "type": "pose placement"}]}',
            "node 'a': the operation 'pose placement' lacks the setting '",
        ),
        ("[" * 100_000, "house.json is no JSON text"),
        ("\x00", "house.json is damaged or cut off at line 1"),
    ],
)
def test_a_bad_file_is_refused_in_one_sentence(tmp_path, text, message):
    path = tmp_path / "house.json"
    path.write_text(text)
    with pytest.raises(InputError, match=message):
        OperationsTree.load(path)


def test_a_file_that_is_not_there_or_no_text_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"house.json cannot be read: No such file or directory; check the path"):
        OperationsTree.load(tmp_path / "house.json")
    (tmp_path / "house.json").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(InputError, match=r"house\.json is no JSON text"):
        OperationsTree.load(tmp_path / "house.json")


@given(st.data())
@settings(max_examples=60, deadline=None)
def test_a_damaged_tree_is_refused_or_read_but_never_breaks(chain, data):
    plain = json.loads(json.dumps(chain.to_dict()))
    at, path = plain, []
    while isinstance(at, dict | list) and at and len(path) < data.draw(st.integers(1, 8)):
        keys = sorted(at) if isinstance(at, dict) else list(range(len(at)))
        path.append((at, data.draw(st.sampled_from(keys))))
        at = path[-1][0][path[-1][1]]
    holder, key = path[-1]
    holder[key] = data.draw(st.sampled_from([None, 1, -1.5, "x", [], {}, [[]], True, 1e300]))
    try:
        OperationsTree.from_dict(plain)
    except InputError as error:
        assert len(str(error)) > 10


# ------------------------------------------------------------------------------------------------ bad trees


def test_a_circle_of_nodes_is_refused(chain):
    operation = chain.node("bed").operation
    nodes = [Node("a", operation, (Link("c"),)), Node("b", operation, (Link("a"),)), Node("c", operation, (Link("b"),))]
    with pytest.raises(InputError, match="the nodes form a circle through 'a'; remove one of its links"):
        OperationsTree([chain.node("bed"), *nodes])
    with pytest.raises(InputError, match="the nodes form a circle through 'a'"):
        OperationsTree([Node("a", operation, (Link("a"),))])


@pytest.mark.parametrize(
    ("links", "message"),
    [
        ((Link("sofa"),), "node 'table' has the input 'sofa', which is not in the tree; relink it"),
        ((Link("bed", 2),), "node 'table' asks for output 2 of node 'bed', which has 1; relink it"),
    ],
)
def test_a_link_to_nothing_is_refused(chain, links, message):
    with pytest.raises(InputError, match=message):
        chain.with_node(dataclasses.replace(chain.node("table"), inputs=links))


def test_two_nodes_of_one_name_are_refused(chain):
    with pytest.raises(InputError, match="several nodes are called 'bed'; give each node an id of its own"):
        OperationsTree([chain.node("bed"), chain.node("bed")])


def test_a_node_that_is_not_there_is_named(chain):
    with pytest.raises(InputError, match="the tree has no node 'sofa'; it has 2 nodes, check the id"):
        chain.node("sofa")


def test_an_error_in_an_operation_names_its_node(chain):
    class Failing(type(chain.node("bed").operation)):
        def propose(self, layout, node, seed):
            yield 0.0, "failing"
            raise InputError("there is no room; build one")

    plain = chain.node("bed").operation
    failing = Failing(mesh="x", label="x", model=plain.model)
    with pytest.raises(InputError, match="node 'a': there is no room; build one"):
        OperationsTree([Node("a", failing)]).apply(Scene(rooms()))
