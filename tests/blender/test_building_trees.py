"""The tree of what is built: files, branches, links that are changed, parcels, and what is evaluated again."""

import json
from pathlib import Path

import bpy
import pytest
from flats import activate, bridge, everything, face, operations_tree, reload
from houses import (
    HEIGHT,
    box_of,
    draw,
    extrude,
    houses,
    parcels,
    place,
    solids,
    volume_of,
    volumes,
    windows,
)

EXEC = "EXEC_DEFAULT"
HOUSES = Path(__file__).resolve().parents[2] / "sample_blends" / "houses"


def heights():
    """The heights of the solids that houses have become."""
    return sorted(item.dimensions.z for item in solids("house") if item.dimensions.z > 0.01)


def links():
    return [(k.from_node.name, k.to_node.name) for k in operations_tree().links]


def test_a_circle_is_refused_when_it_is_linked():
    corners, _ = houses()
    windows(corners)
    tree = operations_tree()
    before = links()
    tree.links.new(tree.nodes["subtract window"].outputs[0], tree.nodes["house"].inputs[0])
    assert links() == before
    assert tree["problem"] == (
        "'subtract window' cannot be linked to 'house', which it builds on itself: the nodes would form a circle; link "
        "it to a later one"
    )
    assert bpy.ops.geoanalogy.apply(EXEC, True) == {"FINISHED"}
    assert "problem" not in tree


def test_what_was_refused_is_told_for_a_while():
    corners, _ = houses()
    windows(corners)
    tree = operations_tree()
    told = bridge("tree.links")

    def refuse():
        tree.links.new(tree.nodes["subtract window"].outputs[0], tree.nodes["house"].inputs[0])
        return tree["problem"]

    told.let_go(tree.name, refuse())
    assert "problem" not in tree
    told.let_go(tree.name, "another")
    told.let_go("no tree", "another")
    refuse()
    told.let_go(tree.name, "another")
    assert "problem" in tree
    tree.nodes["extrude house"].height = 2 * HEIGHT
    assert "problem" not in tree


def test_a_node_that_is_rewired_or_edited_is_marked_and_evaluated_anew():
    houses()
    tree = operations_tree()
    node = tree.nodes["extrude house"]
    high = volumes()
    node.height = 2 * HEIGHT
    assert node["stale"] and node.height == 2 * HEIGHT
    assert bpy.ops.geoanalogy.apply(EXEC, True) == {"FINISHED"}
    assert volumes() == pytest.approx({key: 2 * v for key, v in high.items()}, rel=1e-5)
    assert "stale" not in node
    tree.links.remove(tree.links[0])
    assert node["stale"]
    assert bpy.ops.geoanalogy.apply(EXEC, True) == {"FINISHED"}
    # Without its input, it knows of no houses.
    assert node["count"] == 0
    assert all(volume_of(item) == 0 for item in solids())


def test_what_a_node_cannot_be_is_told_at_the_node():
    houses()
    node = operations_tree().nodes["extrude house"]
    node.height = -1.0
    assert node["problem"] == "the height is -1; give a positive one"
    assert node.height == HEIGHT
    node.pitch = 3.0
    assert node["problem"] == "the roof's pitch is 3 radians; give an angle between 0 and a quarter turn"
    node.roof = "gable"
    assert "problem" not in node and node.roof == "gable"
    assert bpy.ops.geoanalogy.apply(EXEC, True) == {"FINISHED"}
    assert all("gable" in [s.material.name for s in item.material_slots] for item in solids("house"))


def test_a_muted_operation_is_left_out_at_once():
    corners, _ = houses()
    whole = volumes()
    windows(corners)
    cut = volumes()
    tree = operations_tree()
    tree.nodes.active = tree.nodes["subtract window"]
    assert bpy.ops.geoanalogy.mute_operation(EXEC, True) == {"FINISHED"}
    assert volumes() == whole and len(solids("window")) == 16
    assert bpy.ops.geoanalogy.mute_operation(EXEC, True) == {"FINISHED"}
    assert volumes() == cut


def test_branches_divide_the_houses_and_are_merged_again():
    corners = parcels()
    draw("house", *(((x + 2, 3, 0), (x + 8, 8, 0)) for x, _ in corners[:2]))
    place(most=1)
    assert bpy.ops.geoanalogy.select_elements(EXEC, True, label="house", weights="1, 1", within="parent") == {
        "FINISHED"
    }
    tree = operations_tree()
    assert [socket.name for socket in tree.nodes.active.outputs] == ["Set 1", "Set 2"]
    extrude(label="house", height=3.0)
    assert bpy.ops.geoanalogy.build_on(EXEC, True, what="MERGE") == {"FINISHED"}
    low = len(heights())
    assert 0 < low < 4
    # What is still flat when the branches meet is extruded higher.
    node = extrude(label="house", height=6.0)
    assert {k.from_node.name for k in node.inputs[0].links} == {"select house", "extrude house"}
    assert node["count"] == 4 - low
    assert heights() == pytest.approx([3.0] * low + [6.0] * (4 - low))
    assert json.loads(tree.get("build_on", "[]")) == []


def test_the_second_set_of_a_selection_can_be_built_on():
    corners = parcels()
    draw("house", *(((x + 2, 3, 0), (x + 8, 8, 0)) for x, _ in corners[:2]))
    place(most=1)
    bpy.ops.geoanalogy.select_elements(EXEC, True, label="house", weights="0, 1")
    with pytest.raises(RuntimeError, match="'select house' has 2 sets; choose one of them"):
        bpy.ops.geoanalogy.build_on(EXEC, True, what="ACTIVE", output=3)
    assert bpy.ops.geoanalogy.build_on(EXEC, True, what="ACTIVE", output=2) == {"FINISHED"}
    assert extrude(label="house", height=3.0)["count"] == 4


def test_a_tree_is_applied_to_selected_parcels():
    houses()
    every = volumes()
    activate(bpy.data.objects["parcel 1"], bpy.data.objects["parcel 3"])
    assert bpy.ops.geoanalogy.apply(EXEC, True, parcels="SELECTED") == {"FINISHED"}
    chosen = {key: v for key, v in every.items() if key.startswith(("parcel 1", "parcel 3"))}
    assert len(chosen) == 2 and volumes() == chosen
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    assert volumes() == chosen
    activate(bpy.data.objects["parcel 0"])
    assert bpy.ops.geoanalogy.apply(EXEC, True, parcels="MORE") == {"FINISHED"}
    assert len(volumes()) == 3
    assert bpy.ops.geoanalogy.apply(EXEC, True, parcels="ALL") == {"FINISHED"}
    assert volumes() == every
    activate(solids()[0])
    with pytest.raises(RuntimeError, match="no parcel is selected; select labelled outlines of the plan"):
        bpy.ops.geoanalogy.apply(EXEC, True, parcels="SELECTED")


def test_moving_one_example_evaluates_only_what_depends_on_it():
    corners, _ = houses()
    windows(corners)
    evaluations = bridge("tree.evaluating").evaluations
    bpy.ops.geoanalogy.replay(EXEC, True)
    counts = evaluations.evaluated, evaluations.surfaces_evaluated
    bpy.ops.geoanalogy.replay(EXEC, True)
    assert (evaluations.evaluated, evaluations.surfaces_evaluated) == counts
    example = next(i for i in bpy.data.objects if i.name.startswith("window rectangle"))
    example.location.z += 0.2
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    # The windows, their extrusion and the boolean; not the houses and theirs.
    assert evaluations.evaluated - counts[0] == 3


def test_trees_grow_onto_each_other(tmp_path):
    corners, _ = houses()
    windows(corners)
    whole, tree = volumes(), operations_tree()
    assert bpy.ops.geoanalogy.export_tree(EXEC, filepath=str(tmp_path / "house.json")) == {"FINISHED"}
    plain = json.loads((tmp_path / "house.json").read_text())
    assert all("rectangle" not in node["settings"].get("mesh", "") for node in plain["nodes"])
    mass, facade = plain["nodes"][:2], plain["nodes"][2:]
    facade[0]["inputs"] = []
    for name, nodes in (("mass", mass), ("facade", facade)):
        (tmp_path / f"{name}.json").write_text(json.dumps({**plain, "nodes": nodes}))
    assert bpy.ops.geoanalogy.import_tree(EXEC, True, filepath=str(tmp_path / "mass.json")) == {"FINISHED"}
    assert operations_tree() != tree and len(operations_tree().nodes) == 2
    assert bpy.ops.geoanalogy.import_tree(
        EXEC, True, filepath=str(tmp_path / "facade.json"), grow=True, prefix="north "
    ) == {"FINISHED"}
    assert ("extrude house", "north window") in links()
    assert bpy.ops.geoanalogy.apply(EXEC, True) == {"FINISHED"}
    assert volumes() == whole


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('{"schema": "geoanalogy.operations/1", "nodes": [{"id"', "tree.json is damaged or cut off at line 1"),
        ('{"schema": "geoanalogy.operations/99", "nodes": []}', "tree.json was saved by a newer version"),
        ('{"nodes": []}', "tree.json is no operations tree"),
        (
            '{"schema": "geoanalogy.operations/1", "nodes": [{"id": "a", "type": "boolean", "inputs": ["a"], '
            '"settings": {"label": "x"}}]}',
            "the nodes form a circle through 'a'",
        ),
        (
            '{"schema": "geoanalogy.operations/1", "nodes": [{"id": "' + 70 * "a" + '", "type": "boolean", '
            '"settings": {"label": "x"}}]}',
            "has a name of more than 63 letters; shorten it",
        ),
    ],
)
def test_a_file_that_holds_no_tree_changes_nothing(text, message, tmp_path):
    houses()
    (tmp_path / "tree.json").write_text(text)
    before = everything()
    with pytest.raises(RuntimeError, match=message):
        bpy.ops.geoanalogy.import_tree(EXEC, True, filepath=str(tmp_path / "tree.json"))
    assert everything() == before


def test_trees_of_the_same_names_cannot_grow_onto_each_other(tmp_path):
    houses()
    bpy.ops.geoanalogy.export_tree(EXEC, filepath=str(tmp_path / "house.json"))
    before = everything()
    with pytest.raises(RuntimeError, match="several nodes are called 'extrude house'"):
        bpy.ops.geoanalogy.import_tree(EXEC, True, filepath=str(tmp_path / "house.json"), grow=True)
    assert everything() == before


@pytest.mark.parametrize(
    ("operator", "settings", "message"),
    [
        ("extrude", {"label": "house", "height": 0.0}, "the height is 0; give a positive one"),
        ("extrude", {"label": "house", "height": -2.0}, "the height is -2; give a positive one"),
        ("extrude", {"label": "house", "factor": (0.0, 1.0)}, "the random multiplier goes down to 0"),
        (
            "extrude",
            {"label": "parcel", "roof": "hip", "walls": 0.2},
            "is left flat: a room of walls is open above; leave out its roof",
        ),
        (
            "extrude",
            {"label": "castle"},
            "nothing there has the label 'castle'; there are base, flat roof, house, parcel, wall",
        ),
        ("combine", {"label": "castle"}, "nothing there has the label 'castle'"),
        ("combine", {"label": "house"}, "what has the label 'house' stands on nothing that an operation has made"),
        ("combine", {"label": "house", "target": "siblings"}, "no solid with the label 'house' meets others"),
        ("select_elements", {"label": "castle"}, "nothing there has the label 'castle'"),
        ("select_elements", {"label": "house", "weights": "1, x"}, "the weights '1, x' are no numbers"),
        ("select_elements", {"label": "house", "weights": "0, 0"}, "give one positive number per set"),
    ],
)
def test_what_cannot_be_built_is_told_and_changes_nothing(operator, settings, message):
    houses()
    before = everything()
    with pytest.raises(RuntimeError, match=message):
        getattr(bpy.ops.geoanalogy, operator)(EXEC, True, **settings)
    assert everything() == before


def test_without_an_active_object_what_the_active_operation_placed_is_meant():
    houses()
    bpy.context.view_layer.objects.active = None
    assert bridge("tree.building").label_here(bpy.context, "") == "house"
    assert bridge("tree.building").label_here(bpy.context, " facade ") == "facade"


def test_a_label_must_be_given_by_name_by_an_object_or_by_an_operation():
    parcels()
    bpy.context.view_layer.objects.active = None
    with pytest.raises(RuntimeError, match="nothing says what is meant; type a label, or click an object that has one"):
        bpy.ops.geoanalogy.extrude(EXEC, True)
    activate(bpy.data.objects["parcel 0"])
    # The parcels themselves are extruded, and become elements of their label.
    assert extrude(height=0.1)["count"] == 4
    assert len(solids("parcel")) == 4


def test_a_parcel_that_cannot_be_used_is_left_out_and_named():
    houses()
    every = volumes()
    face("parcel 9", [(100, 0), (110, 10), (110, 0), (100, 10)], "parcel")
    face("parcel 10", [(130, 0), (130.00001, 0), (130.00001, 0.00001)], "parcel")
    plan = bpy.data.collections.new("plan")
    bpy.context.scene.collection.children.link(plan)
    bpy.context.scene.geoanalogy.plan = plan
    nameless = face("parcel 11", [(140, 0), (150, 0), (150, 10)])
    bpy.context.scene.collection.objects.unlink(nameless)
    plan.objects.link(nameless)
    report = bridge("tree.whole").show_whole(bpy.context)
    assert volumes() == every
    assert any("'parcel 9'" in p and p.endswith("it is left out") for p in report.problems)
    assert any("'parcel 11' of the plan has no label" in p for p in report.problems)
    assert operations_tree().nodes["extrude house"]["count"] == 4
    assert bpy.ops.geoanalogy.apply(EXEC, True) == {"FINISHED"}


def test_undo_redo_save_and_reload_keep_what_is_built(tmp_path):
    bpy.ops.ed.undo_push(message="empty")
    corners, _ = houses()
    windows(corners)
    built = volumes()
    bpy.ops.ed.undo()
    assert len(solids("window")) == 16 and "subtract window" not in operations_tree().nodes
    bpy.ops.ed.redo()
    assert volumes() == built
    reload(tmp_path / "houses.blend")
    assert volumes() == built
    assert bpy.ops.geoanalogy.replay(EXEC, True) == {"FINISHED"}
    assert volumes() == built
    combine_again = bpy.ops.geoanalogy.extrude(EXEC, True, label="parcel", height=0.2)
    assert combine_again == {"FINISHED"} and volumes() == built


def test_removing_an_operation_shows_what_is_left():
    corners, _ = houses()
    whole = volumes()
    windows(corners)
    tree = operations_tree()
    for name in ("subtract window", "extrude window", "window"):
        tree.nodes.active = tree.nodes[name]
        assert bpy.ops.geoanalogy.remove_operation(EXEC, True) == {"FINISHED"}
    assert volumes() == whole and solids("window") == []
    for name in ("extrude house", "house"):
        tree.nodes.active = tree.nodes[name]
        assert bpy.ops.geoanalogy.remove_operation(EXEC, True) == {"FINISHED"}
    assert solids() == []


def test_a_solid_is_extruded_in_one_step_of_undo():
    corners = parcels()
    draw("house", *(box_of(i, corners) for i in (0, 1)))
    place(most=1, any_size=True)
    bpy.ops.ed.undo_push(message="placed")
    before = everything()
    extrude(label="house", height=HEIGHT)
    after = everything()
    bpy.ops.ed.undo()
    assert everything() == before
    bpy.ops.ed.redo()
    assert everything() == after


def test_what_is_done_to_nodes_in_the_node_editor_is_seen():
    corners, _ = houses()
    whole = volumes()
    windows(corners)
    tree = operations_tree()
    cut = tree.nodes["subtract window"]
    cut.mute = True
    assert cut["stale"]
    assert bpy.ops.geoanalogy.apply(EXEC, True) == {"FINISHED"}
    assert "stale" not in cut and volumes() == whole and len(solids("window")) == 16
    for name in ("subtract window", "extrude window", "window"):
        tree.nodes.remove(tree.nodes[name])
    assert bpy.ops.geoanalogy.apply(EXEC, True) == {"FINISHED"}
    assert volumes() == whole and solids("window") == []
    assert not [i for i in bpy.context.scene.objects if i.get("ga_node") == "window"]
    # A reroute between two nodes changes nothing.
    link = next(k for k in tree.links if k.to_node.name == "extrude house")
    source = link.from_socket
    tree.links.remove(link)
    reroute = tree.nodes.new("NodeReroute")
    tree.links.new(source, reroute.inputs[0])
    tree.links.new(reroute.outputs[0], tree.nodes["extrude house"].inputs[0])
    assert bpy.ops.geoanalogy.apply(EXEC, True) == {"FINISHED"}
    assert volumes() == whole
    bridge("tree.links").check_links(tree)
    assert bridge("tree.links").circle_in(tree) == []


def test_an_appended_tree_builds_in_another_file(tmp_path):
    corners, _ = houses()
    windows(corners)
    built, name = sorted(volumes().values()), operations_tree().name
    activate(bpy.data.objects["parcel 1"])
    bpy.ops.geoanalogy.apply(EXEC, True, parcels="SELECTED")
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "style.blend"))
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    for i, _ in enumerate(parcels()):
        bpy.data.objects[f"parcel {i}"].name = f"plot {i}"
    with bpy.data.libraries.load(str(tmp_path / "style.blend")) as (_, wanted):
        wanted.node_groups = [name]
    # The parcels that it was restricted to are not here: it is applied to all.
    assert bpy.ops.geoanalogy.apply(EXEC, True) == {"FINISHED"}
    assert sorted(volumes().values()) == pytest.approx(built, rel=1e-4)


@pytest.fixture
def asked(monkeypatch):
    """The names of the nodes that are asked what they propose, in order."""
    kind = bridge("tree.evaluating").TimedEvaluations
    names, proposal = [], kind.proposal

    def told(self, node, layout, seed):
        names.append(node.id)
        return (yield from proposal(self, node, layout, seed))

    monkeypatch.setattr(kind, "proposal", told)
    return names


def test_a_slider_asks_only_what_follows_its_node_and_only_while_something_changes(asked):
    corners, _ = houses()
    node = windows(corners)
    node.threshold = 0.4
    high = volumes()
    asked.clear()
    node.threshold = 1.0
    assert asked == ["window", "extrude window", "subtract window"]
    assert volumes() != high
    asked.clear()
    node.threshold = 0.999
    assert asked == ["window"]
    node.threshold = 0.4
    assert volumes() == high
    bridge("tree.evaluating").evaluations.clear()
    assert bpy.ops.geoanalogy.apply(EXEC, True) == {"FINISHED"}
    assert volumes() == high


def test_what_was_moved_or_relabelled_is_read_again(asked):
    houses()
    low = volumes()
    bpy.data.objects["parcel 3"].scale.x = 1.2
    asked.clear()
    assert bpy.ops.geoanalogy.apply(EXEC, True) == {"FINISHED"}
    assert asked == ["house", "extrude house"]
    assert volumes() != low and len(volumes()) == len(low)
    bpy.data.objects["parcel 3"]["ga_label"] = "meadow"
    assert bpy.ops.geoanalogy.apply(EXEC, True) == {"FINISHED"}
    assert len(volumes()) == len(low) - 1
