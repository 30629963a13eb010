"""Applying a stored tree to a file of parcels: the command, bad parcels, bad trees."""

import json

import pytest
from shapes import rectangle

from geoanalogy import Applied, Cancelled, InputError, OperationsTree, Polygon, Scene, read_scene, write_scene
from geoanalogy.command_line import ExitCode, main
from geoanalogy.formats.files import read_parcels
from geoanalogy.operations.boolean import Boolean
from geoanalogy.operations.extrusion import Extrusion
from geoanalogy.operations.node import Link, Node


def feature(ring, **properties):
    ring = [list(map(float, p)) for p in ring]
    return {
        "type": "Feature",
        "properties": properties,
        "geometry": {"type": "Polygon", "coordinates": [[*ring, ring[0]]]},
    }


def apply_file(tree, path, seed=0, progress=None):
    """What a stored tree makes of a file of parcels, in one go."""
    recorded = OperationsTree.load(tree)
    scene, problems = read_parcels(path)
    applied = recorded.apply(scene, seed, progress)
    applied.problems = (*problems, *applied.problems)
    return applied


GOOD = feature(rectangle(10, 20), id="good", label="plot")
CROSSING = feature([(0, 0), (5, 5), (5, 0), (0, 6)], id="crossing", label="plot")
TINY = feature(rectangle(0.5, 0.5, (30, 0)), id="tiny", label="plot")
UNLABELLED = feature(rectangle(10, 20, (50, 0)), id="unlabelled")


@pytest.fixture
def files(tmp_path):
    tree = OperationsTree([Node("up", Extrusion(label="plot", height=2.0, factor=(0.5, 1.5)))])
    tree.save(tmp_path / "tree.json")
    return tmp_path


def parcels(folder, *features):
    path = folder / "parcels.geojson"
    path.write_text(json.dumps({"type": "FeatureCollection", "features": features}))
    return path


def test_a_tree_is_applied_to_a_file(files):
    path = parcels(files, GOOD)
    applied = apply_file(files / "tree.json", path, seed=7)
    assert isinstance(applied, Applied) and [e.parent for e in applied] == ["good"] and applied.problems == ()
    assert applied == OperationsTree.load(files / "tree.json").apply(read_scene(path), seed=7)


def test_bad_parcels_are_named_and_the_rest_is_built(files):
    path = parcels(files, GOOD, CROSSING, TINY, UNLABELLED)
    applied = apply_file(files / "tree.json", path)
    assert [e.parent for e in applied] == ["good"]
    crossing, tiny, unlabelled = applied.problems
    assert "feature 1 (id 'crossing')" in crossing and crossing.endswith("redraw it as a simple ring")
    assert tiny == "parcels.geojson, polygon 'tiny': its area is 0.25; delete it or correct its outline"
    assert unlabelled == (
        "parcels.geojson, polygon 'unlabelled': it has no label, so that no operation fits; give it one"
    )


def test_a_polygon_without_a_label_may_hold_others(tmp_path):
    child = feature(rectangle(5, 5, (1, 1)), id="child", label="plot", parent="block")
    scene, problems = read_parcels(parcels(tmp_path, feature(rectangle(10, 20), id="block"), child))
    assert [p.id for p in scene.polygons] == ["block", "child"] and problems == []


def test_another_property_holds_the_label(tmp_path):
    scene, _ = read_parcels(parcels(tmp_path, feature(rectangle(10, 20), use="plot")), label="use")
    assert scene.polygons[0].label == "plot"


def test_a_format_that_is_not_read_is_named(tmp_path):
    with pytest.raises(InputError, match=r"parcels.shp is in no format that is read"):
        read_parcels(tmp_path / "parcels.shp")


def test_what_cannot_be_combined_is_named_and_the_rest_done():
    scene = Scene([Polygon(rectangle(10, 20), "plot", "p")])
    nodes = [
        Node("up", Extrusion(label="plot", height=2.0)),
        Node("all", Extrusion(label="top", height=3.0, inwards=True), (Link("up"),)),
        Node("gone", Boolean(label="top", kind="subtract"), (Link("all"),)),
    ]
    applied = OperationsTree(nodes).apply(scene)
    assert [e.label for e in applied] == ["plot", "top"] and applied[0].solid.volume == pytest.approx(400)
    assert applied.problems == (
        f"node 'gone': top '{applied[1].id}' is left as it is: nothing is left of the solid; subtract less",
    )


@pytest.mark.parametrize(
    ("damage", "message"),
    [
        (lambda text: text[: len(text) // 2], "tree.json is damaged or cut off at line"),
        (lambda text: text.replace("operations/1", "operations/9"), "was saved by a newer version of GeoAnalogy"),
        (lambda text: text.replace('"inputs": []', '"inputs": ["up"]'), "the nodes form a circle through 'up'"),
        (lambda text: text.replace('"extrusion"', '"sculpting"'), "is of the unknown type 'sculpting'"),
    ],
)
def test_a_damaged_tree_is_named_and_stays_as_it_is(files, damage, message):
    path = files / "tree.json"
    path.write_text(damage(path.read_text()))
    before = path.read_bytes()
    with pytest.raises(InputError, match=message):
        apply_file(path, parcels(files, GOOD))
    assert path.read_bytes() == before


def test_the_command_writes_meshes_and_says_what_it_made(files, capsys):
    path = parcels(files, GOOD, CROSSING)
    output = files / "out.obj"
    command = [
        "apply",
        "--tree",
        str(files / "tree.json"),
        "--parcels",
        str(path),
        "--seed",
        "7",
        "--output",
        str(output),
    ]
    assert main(command) == ExitCode.DONE
    said = capsys.readouterr()
    assert "redraw it as a simple ring" in said.out and "1 elements on 1 parcels" in said.out
    assert said.err.startswith("[  0%] 0 of 1 parcels built")
    written = output.read_text().splitlines()
    assert written[0].startswith("o up/good@")
    assert sum(line.startswith("v ") for line in written) == 8 and sum(line.startswith("f ") for line in written) == 12
    assert {line for line in written if line.startswith("usemtl")} == {"usemtl facade", "usemtl top", "usemtl base"}
    first = output.read_bytes()
    assert main(command) == ExitCode.DONE and output.read_bytes() == first


def test_the_command_fails_with_a_sentence(files, capsys):
    path = parcels(files, GOOD)
    command = ["apply", "--tree", str(files / "no.json"), "--parcels", str(path), "--output", str(files / "out.obj")]
    assert main(command) == ExitCode.BAD_INPUT
    assert "no.json cannot be read" in capsys.readouterr().err
    command[2], command[-1] = str(files / "tree.json"), str(files / "no folder" / "out.obj")
    assert main(command) == ExitCode.WRITE_FAILED
    assert not (files / "out.obj").exists()


def test_parcels_none_of_which_can_be_used_are_named(files, capsys):
    path = parcels(files, TINY, CROSSING)
    command = ["apply", "--tree", str(files / "tree.json"), "--parcels", str(path), "--output", str(files / "out.obj")]
    assert main(command) == ExitCode.BAD_INPUT
    said = capsys.readouterr().err
    assert "geoanalogy: no polygon can be used: parcels.geojson, " in said
    assert "'crossing'" in said and "and 1 more like this" in said


def test_a_tree_without_operations_is_named(files, capsys):
    OperationsTree().save(files / "bare.json")
    path = parcels(files, GOOD)
    command = ["apply", "--tree", str(files / "bare.json"), "--parcels", str(path), "--output", str(files / "out.obj")]
    assert main(command) == ExitCode.BAD_INPUT
    assert "geoanalogy: bare.json has no operations; record some and save it again" in capsys.readouterr().err


@pytest.mark.parametrize("option", ["--work", "--tiles"])
def test_a_folder_that_cannot_be_made_is_named(files, capsys, option):
    (files / "file").write_text("no folder")
    path, output = parcels(files, GOOD), files / ("out.blend" if option == "--tiles" else "out.obj")
    command = ["apply", "--tree", str(files / "tree.json"), "--parcels", str(path), "--output", str(output)]
    assert main([*command, option, str(files / "file")]) == ExitCode.WRITE_FAILED
    assert f"geoanalogy: cannot make the folder {files / 'file'}: File exists" in capsys.readouterr().err


def test_it_can_be_cancelled(files):
    with pytest.raises(Cancelled):
        apply_file(files / "tree.json", parcels(files, GOOD), progress=lambda *_: False)


def test_a_scene_written_is_the_scene_applied_to(files):
    scene = Scene([Polygon(rectangle(10, 20), "plot", "p", segment_labels=["street", "", "", ""], orientation=0.0)])
    write_scene(scene, files / "written.geojson")
    applied = apply_file(files / "tree.json", files / "written.geojson", seed=3)
    assert {s.label for s in applied.surfaces} == {"street facade", "facade", "top", "base"}
