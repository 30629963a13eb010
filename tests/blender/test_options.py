"""Whatever can be set in the engine can be set in Blender."""

import importlib
from dataclasses import fields

import bpy
import pytest
from flats import engine

POSE_NAMES = {"labels": "use_labels", "relation_weights": "weights"}

#: How the best places are searched: chance draws places from all, as far from the best ones as its width says.
SEARCHED = {"accumulation", "level_set_width", "direction_width", "cells", "direction_bins", "candidates"}

#: Options of the engine, the operators that set them, and what is called otherwise there or is set another way.
OPTIONS = [
    ("poses.options", "PoseOptions", {"propagate", "choose", "array"}, POSE_NAMES),
    ("poses.options", "PoseOptions", {"scatter"}, POSE_NAMES | dict.fromkeys(SEARCHED, "width")),
    ("poses.arrays", "ArrayOptions", {"array"}, {}),
    ("poses.scatter", "ScatterOptions", {"scatter"}, {}),
    ("poses.local_mapping", "TransferOptions", {"transfer"}, {}),
    ("placements.options", "PlacementOptions", {"place"}, {"allow_overlaps": "overlap"}),
    ("regions.options", "RegionOptions", {"find_regions"}, {}),
]

#: What is not a property of the operator, and where it is set instead.
ELSEWHERE = {
    ("PoseOptions", "threshold"): "the threshold of results; lower ones are kept for the slider",
    ("PoseOptions", "alternative_geometry"): "the custom property ga_validation of objects",
    ("PoseOptions", "max_per"): "the operators' own most and most_of",
    ("PoseOptions", "spacing"): "the operators' own spacing, which sifts what has been computed",
    ("PoseOptions", "upright"): "the direction of the plane that the example lies on",
    ("TransferOptions", "upright"): "the direction of the plane that the group lies on",
    ("TransferOptions", "corner"): "an empty at the corner",
    ("TransferOptions", "start"): "an empty at the group's polygon",
    ("TransferOptions", "starts"): "empties at the others",
    ("RegionOptions", "query_kind"): "how the query was drawn",
}


@pytest.mark.parametrize(
    ("module", "kind", "operators", "aliases"),
    OPTIONS,
    ids=[f"{kind} of {min(names)}" for _, kind, names, _ in OPTIONS],
)
def test_every_option_of_the_engine_can_be_set(module, kind, operators, aliases):
    options = {field.name for field in fields(getattr(engine(module), kind))}
    for operator in operators:
        properties = getattr(bpy.ops.geoanalogy, operator).get_rna_type().properties
        missing = {
            name for name in options if aliases.get(name, name) not in properties and (kind, name) not in ELSEWHERE
        }
        assert not missing
        mute = [p.identifier for p in properties if not p.description and p.type not in ("ENUM", "POINTER")]
        assert mute == []


def test_scatter_offers_nothing_that_counts_for_nothing_there():
    assert SEARCHED.isdisjoint(bpy.ops.geoanalogy.scatter.get_rna_type().properties.keys())


#: What nobody sees: kinds of files, and what is drawn with the mouse.
UNSEEN = {"rna_type", "filter_glob", "points", "rectangles"}


def tells(row):
    """Whether a property says what it is: itself, or each of its choices."""
    return bool(row.description) or (row.type == "ENUM" and all(item.description for item in row.enum_items))


def test_operators_and_what_they_show_have_tooltips():
    for operator in dir(bpy.ops.geoanalogy):
        kind = getattr(bpy.ops.geoanalogy, operator).get_rna_type()
        assert kind.name and kind.description and not kind.description.endswith("."), operator
        mute = [row.identifier for row in kind.properties if row.identifier not in UNSEEN and not tells(row)]
        assert mute == [], operator


def test_names_to_search_for_are_told_apart():
    found = [getattr(bpy.ops.geoanalogy, operator).get_rna_type().name for operator in dir(bpy.ops.geoanalogy)]
    assert len(found) > 35 and len(set(found)) == len(found)


def test_what_panels_and_nodes_show_has_tooltips():
    scene = bpy.context.scene.geoanalogy
    tree = bpy.data.node_groups.new("Operations", "GeoAnalogyTree")
    node = tree.nodes.new("GeoAnalogyOperation")
    for shown in (scene, scene.matching, tree, node):
        own = [row for row in shown.bl_rna.properties if row.is_runtime]
        assert own
        assert [row.identifier for row in own if not tells(row) and row.type != "POINTER"] == []


def test_blenders_search_finds_the_operators_in_a_menu(addon):
    """Others belong to a place in the sidebar or the node editor."""
    groups = importlib.import_module(f"{addon.__name__}.panels.menu").GROUPS
    listed = [name for group in groups for name in group]
    assert len(set(listed)) == len(listed)
    assert set(dir(bpy.ops.geoanalogy)) - set(listed) == {
        "add_node",
        "build_on",
        "move_operation",
        "mute_operation",
        "remove_operation",
        "select_examples",
        "set_target",
        "show_face",
    }
    assert set(listed) <= set(dir(bpy.ops.geoanalogy))
    assert bpy.types.GEOANALOGY_MT_object.bl_label == "GeoAnalogy"
