"""Reading and writing by path: the suffix, the file system, scale."""

import numpy as np
import pytest
from shapes import L_ROOM, UNIT_SQUARE

import geoanalogy as ga
from geoanalogy import InputError, Polygon, Scene, read_drawing, read_scene, write_scene

SVG = b'<svg xmlns="http://www.w3.org/2000/svg"><path class="room" d="M0 0h4v3h-4z"/></svg>'
DXF = b"0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n8\ntable\n10\n1\n20\n2\n40\n0.5\n0\nENDSEC\n0\nEOF\n"


def test_the_suffix_says_the_format(tmp_path):
    (tmp_path / "plan.SVG").write_bytes(SVG)
    (tmp_path / "plan.dxf").write_bytes(DXF)
    write_scene(Scene([Polygon(L_ROOM, label="hall")]), tmp_path / "plan.json")
    found = {
        name: [p.label for p in read_scene(tmp_path / name).polygons] for name in ("plan.SVG", "plan.dxf", "plan.json")
    }
    assert found == {"plan.SVG": ["room"], "plan.dxf": ["table"], "plan.json": ["hall"]}
    assert ga.read_scene is read_scene
    assert ga.write_scene is write_scene


def test_paths_may_be_text(tmp_path):
    write_scene(Scene([Polygon(UNIT_SQUARE)]), str(tmp_path / "a.geojson"))
    assert len(read_scene(str(tmp_path / "a.geojson"))) == 1


def test_scale_and_label_reach_the_reader(tmp_path):
    (tmp_path / "plan.svg").write_bytes(SVG.replace(b"class=", b'data-use="sleeping" class='))
    scene = read_scene(tmp_path / "plan.svg", label="data-use", scale=50)
    assert [(p.label, p.area) for p in scene.polygons] == [("sleeping", 12 * 2500)]


def test_drawing_is_a_list_of_lines(tmp_path):
    (tmp_path / "plan.svg").write_bytes(SVG)
    (line,) = read_drawing(tmp_path / "plan.svg")
    assert line.tolist() == [[0, 0], [4, 0], [4, -3], [0, -3], [0, 0]]
    assert ga.read_drawing is read_drawing


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("plan.pdf", b"%PDF", r"plan.pdf is in no format that is read; give a .geojson, .json, .svg or .dxf file"),
        ("plan.svg", b"", "plan.svg is empty; export it again"),
        ("plan.dxf", b" \n ", "plan.dxf is empty; export it again"),
        ("plan.geojson", b"", "plan.geojson is empty"),
        ("plan.svg", b"<svg/>", "plan.svg holds no closed shape"),
    ],
)
def test_scenes_that_are_refused(tmp_path, name, content, message):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(InputError, match=message):
        read_scene(tmp_path / name)


@pytest.mark.parametrize("scale", [0.0, -1.0, np.nan, np.inf])
def test_scales_that_are_none(tmp_path, scale):
    (tmp_path / "plan.svg").write_bytes(SVG)
    with pytest.raises(InputError, match="is no scale; give how many scene units a unit of the file is"):
        read_scene(tmp_path / "plan.svg", scale=scale)


def test_missing_files_and_folders(tmp_path):
    with pytest.raises(InputError, match=r"none.svg cannot be read \(No such file or directory\); check the name"):
        read_scene(tmp_path / "none.svg")
    (tmp_path / "folder.svg").mkdir()
    with pytest.raises(InputError, match=r"folder.svg cannot be read"):
        read_drawing(tmp_path / "folder.svg")
    with pytest.raises(InputError, match=r"cannot be written \(No such file or directory\); choose another place"):
        write_scene(Scene([]), tmp_path / "none" / "a.geojson")


def test_other_formats_are_not_written_nor_drawings_read(tmp_path):
    with pytest.raises(InputError, match=r"a.svg is in no format that is written; give a .geojson file"):
        write_scene(Scene([]), tmp_path / "a.svg")
    with pytest.raises(InputError, match=r"a.dxf is no drawing that is read; give an .svg file"):
        read_drawing(tmp_path / "a.dxf")
    (tmp_path / "a.svg").write_bytes(b"<svg><text>hello</text></svg>")
    with pytest.raises(InputError, match=r"a.svg holds no lines; draw at least one path"):
        read_drawing(tmp_path / "a.svg")
