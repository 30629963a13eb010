"""Parcels of maps as they come: tags, degrees, rings that are broken, slivers, overlaps, multipolygons."""

import json
import re

import numpy as np
import pytest
from shapes import rectangle

from geoanalogy import InputError, Polygon, Scene
from geoanalogy.formats.files import read_parcels
from geoanalogy.formats.labelling import label_by, read_table
from geoanalogy.formats.repair import of_few_vertices, without_overlaps


def parcels(folder, *features, **members):
    path = folder / "map.geojson"
    made = []
    for rings, properties in features:
        rings = [[[float(x), float(y)] for x, y in [*ring, ring[0]]] for ring in rings]
        geometry = {"type": "Polygon", "coordinates": rings}
        made.append({"type": "Feature", "properties": properties, "geometry": geometry})
    path.write_text(json.dumps({"type": "FeatureCollection", "features": made, **members}))
    return path


PLOT = {"id": "a", "label": "plot"}


@pytest.mark.parametrize(
    ("tags", "label"),
    [
        ({"building": "apartments"}, "condominium"),
        ({"building": "yes"}, "building"),
        ({"building": "no", "landuse": "grass"}, "lawn"),
        ({"landuse": "orchard"}, "orchard"),
        ({"building": "house", "label": "mill"}, "mill"),
        ({"building": None, "area:highway": "residential"}, "street"),
    ],
)
def test_tags_become_labels_by_the_table(tmp_path, tags, label):
    scene, problems = read_parcels(parcels(tmp_path, ([rectangle(9, 9)], tags)))
    assert [p.label for p in scene.polygons] == [label] and problems == []


def test_any_attribute_may_hold_the_label_and_any_table_replace_ours(tmp_path):
    path = parcels(tmp_path, ([rectangle(9, 9)], {"zone": "R3", "building": "house"}))
    assert read_parcels(path, label="zone")[0].polygons[0].label == "R3"
    table = tmp_path / "table.json"
    table.write_text(json.dumps({"schema": "geoanalogy.labels/1", "rules": [["zone", "R3", "tower"]]}))
    assert read_parcels(path, table=table)[0].polygons[0].label == "tower"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (None, "cannot be read"),
        ("{", "is not valid JSON"),
        ("{}", 'is no table of labels; it should begin with "schema": "geoanalogy.labels/1"'),
        ('{"schema": "geoanalogy.labels/1"}', 'has no list of "rules"'),
        ('{"schema": "geoanalogy.labels/1", "rules": [["a", "b"]]}', "rule 1: it is no row of three texts"),
    ],
)
def test_a_broken_table_is_named(tmp_path, text, message):
    path = tmp_path / "table.json"
    if text is not None:
        path.write_text(text)
    with pytest.raises(InputError, match=message):
        read_table(path)


def test_the_first_rule_that_fits_counts():
    rules = (("a", "x", "first"), ("a", "*", "second"), ("b", "*", "*"))
    assert [label_by(rules, tags) for tags in ({"a": "x"}, {"a": 3}, {"b": "c"}, {"a": True}, {})] == [
        "first",
        "second",
        "c",
        "",
        "",
    ]


def test_degrees_are_refused_though_the_file_says_nothing(tmp_path):
    path = parcels(tmp_path, ([rectangle(2e-4, 3e-4, (14.4, 50.1))], PLOT))
    with pytest.raises(InputError, match=r"map.geojson seems to have its coordinates in degrees .* such as UTM"):
        read_parcels(path)
    assert len(read_parcels(parcels(tmp_path, ([rectangle(2, 3)], PLOT)))[0]) == 1


def test_projected_coordinates_are_brought_near_the_origin(tmp_path):
    ring = rectangle(20, 30, (458_123.5, 5_551_987.25))
    scene, _ = read_parcels(parcels(tmp_path, ([ring], PLOT)))
    assert scene.offset == (458_000.0, 5_552_000.0)
    assert scene.polygons[0].points + scene.offset == pytest.approx(np.array(ring))


def test_a_small_loop_is_cut_off_and_said(tmp_path):
    ring = [(0, 0), (20, 0), (20, 20), (0.2, 20), (-0.2, 20.3), (0.2, 20.3), (0, 20)]
    scene, problems = read_parcels(parcels(tmp_path, ([ring], PLOT)))
    assert scene.polygons[0].area == pytest.approx(400, abs=1.0)
    assert problems == ["map.geojson, feature 0 (id 'a'): its outline touched or crossed itself and has been mended"]


def test_what_cannot_be_mended_is_left_out_by_name(tmp_path):
    nan = [(0, 0), (float("nan"), 0), (5, 5), (0, 5)]
    many = np.random.default_rng(0).uniform(-50, 50, (3000, 2))
    bow = [(0, 0), (5, 5), (5, 0), (0, 6)]
    sliver = rectangle(40, 0.3)
    every = [([ring], {"id": f"f{k}", "label": "plot"}) for k, ring in enumerate((nan, many, bow, sliver))]
    scene, problems = read_parcels(parcels(tmp_path, *every, ([rectangle(9, 9)], PLOT)))
    assert [p.id for p in scene.polygons] == ["a"] and len(problems) == 4
    said = "\n".join(problems)
    assert re.search(r"feature 1 \(id 'f1'\): it has 3001 vertices, and \d+ when simplified; draw it with fewer", said)
    assert "(id 'f0')" in said and "not finite" in said and "redraw it as a simple ring" in said
    assert "polygon 'f3': it is a sliver, 0.3 wide" in said


def test_far_too_many_vertices_are_simplified(tmp_path):
    turn = np.linspace(0, 2 * np.pi, 50_000, endpoint=False)
    circle = np.column_stack([np.cos(turn), np.sin(turn)])
    path = tmp_path / "map.geojson"
    rings = [[*ring, ring[0]] for ring in ((circle * 15).round(6).tolist(), (circle[:600] * 1e-4).tolist())]
    feature = {"type": "Feature", "properties": PLOT, "geometry": {"type": "Polygon", "coordinates": rings}}
    path.write_text(json.dumps({"type": "FeatureCollection", "features": [feature]}))
    scene, (said,) = read_parcels(path)
    assert re.search(r"feature 0 \(id 'a'\): it has 50602 vertices and has been simplified to \d\d$", said)
    (plot,) = scene.polygons
    assert len(plot.points) < 100 and plot.area == pytest.approx(np.pi * 15**2, rel=0.005) and not plot.holes


def test_long_outlines_keep_their_shape_unless_they_are_built_on(tmp_path):
    turn = np.linspace(0, 2 * np.pi, 5_000, endpoint=False)
    wave = (30 + 4 * np.cos(40 * turn))[:, None] * np.column_stack([np.cos(turn), np.sin(turn)])
    ring = wave.round(6).tolist()
    scene, problems = read_parcels(
        parcels(tmp_path, ([ring], {"id": "s", "label": "street"}), ([rectangle(9, 9, (50, 0))], PLOT))
    )
    assert problems == [] and len(scene.polygon("s").points) == 5_000
    assert of_few_vertices(scene, frozenset({"plot"}), problems) is scene and problems == []
    made = of_few_vertices(scene, None, problems)
    (said,) = problems
    assert re.fullmatch(r"polygon 's' has 5000 vertices and has been simplified to \d{3}", said)
    assert made.polygons[1] is scene.polygons[1]
    assert made.polygon("s").shape.symmetric_difference(scene.polygon("s").shape).area < 0.005 * scene.polygon("s").area


def test_edges_of_a_simplified_parcel_keep_the_labels_that_they_share():
    corners = np.array(rectangle(20, 30))
    edges = [
        np.linspace(one, other, 200, endpoint=False)
        for one, other in zip(corners, np.roll(corners, -1, 0), strict=True)
    ]
    labels = ["street"] * 200 + ["side"] * 200 + ["garden", "shed"] * 100 + ["side"] * 200
    plot = Polygon(np.concatenate(edges), "plot", "a", [rectangle(4, 4, (8, 8))], None, 0.0, labels)
    made = of_few_vertices(Scene([plot]), frozenset({"plot"}), []).polygon("a")
    assert len(made.points) == 4 and len(made.holes) == 1 and made.orientation == 0.0
    found = dict(zip(map(tuple, made.points.round(6).tolist()), made.segment_labels, strict=True))
    assert found == {(0, 0): "street", (20, 0): "side", (20, 30): "", (0, 30): "side"}


def test_a_parcel_that_stays_too_long_is_left_out_by_name():
    turn = np.linspace(0, 2 * np.pi, 1_200, endpoint=False)
    star = (30 + 8 * (-1.0) ** np.arange(1_200))[:, None] * np.column_stack([np.cos(turn), np.sin(turn)])
    problems = []
    made = of_few_vertices(
        Scene([Polygon(star, "plot", "star"), Polygon(rectangle(9, 9), "plot", "a")]), None, problems
    )
    assert [p.id for p in made.polygons] == ["a"]
    assert problems == ["polygon 'star' has 1200 vertices, 1200 when simplified, and is left out; draw it with fewer"]


def test_holes_and_parts_are_kept(tmp_path):
    path = tmp_path / "map.geojson"
    outer, hole, other = rectangle(30, 30), rectangle(5, 5, (10, 10)), rectangle(9, 9, (50, 0))
    rings = [[[*map(list, r), list(r[0])] for r in part] for part in ([outer, hole], [other])]
    geometry = {"type": "MultiPolygon", "coordinates": rings}
    feature = {"type": "Feature", "properties": PLOT, "geometry": geometry}
    path.write_text(json.dumps({"type": "FeatureCollection", "features": [feature]}))
    scene, problems = read_parcels(path)
    assert [p.id for p in scene.polygons] == ["a", "a.001"] and problems == []
    assert [p.area for p in scene.polygons] == pytest.approx([875, 81])


def test_an_empty_file_is_named(tmp_path):
    with pytest.raises(InputError, match=r"map.geojson holds no closed shape"):
        read_parcels(parcels(tmp_path))


def test_parcels_that_overlap_are_cut_back_or_left_out():
    edges = ("street", "side", "garden", "side")
    scene = Scene(
        [
            Polygon(rectangle(20, 30), "plot", "one", segment_labels=edges),
            Polygon(rectangle(20, 30, (18, 0)), "plot", "cut", segment_labels=edges, orientation=0.0),
            Polygon(rectangle(20, 30, (6, 5)), "plot", "gone"),
            Polygon(rectangle(10, 10, (-5, 0)), "street", "street"),
            Polygon(rectangle(3, 3, (2, 2)), "plot", "inside"),
        ]
    )
    problems = []
    made = without_overlaps(scene, frozenset({"plot"}), problems)
    assert [p.id for p in made.polygons] == ["one", "cut", "street", "inside"]
    assert made.polygon("cut").area == pytest.approx(18 * 30) and made.polygon("cut").orientation == 0.0
    assert sorted(made.polygon("cut").segment_labels) == ["", "garden", "side", "street"]
    assert made.polygon("cut").shape.intersection(made.polygon("one").shape).area == pytest.approx(0)
    assert problems == [
        "polygon 'cut' overlaps 'one' by 10% of its area and has been cut back",
        "polygon 'gone' overlaps 'one' by 58% of its area and is left out; correct one of their outlines",
    ]
    assert without_overlaps(made, frozenset({"plot"}), []) is made


def test_a_parcel_that_is_there_twice_counts_once():
    scene = Scene(
        [
            Polygon(rectangle(20, 30), "plot", "one"),
            Polygon(rectangle(20, 30), "plot", "again"),
            Polygon(rectangle(18, 26, (1, 1)), "plot", "smaller"),
            Polygon(rectangle(22, 32, (-1, -1)), "plot", "larger"),
            Polygon(rectangle(20, 30), "lawn", "other label"),
            Polygon(rectangle(10, 20, (2, 2)), "plot", "less than half"),
        ]
    )
    problems = []
    made = without_overlaps(scene, frozenset({"plot", "lawn"}), problems)
    assert [p.id for p in made.polygons] == ["one", "other label", "less than half"]
    assert problems == [
        f"polygon {id!r} overlaps 'one' by {share} of its area and is left out; correct one of their outlines"
        for id, share in (("again", "100%"), ("smaller", "100%"), ("larger", "85%"))
    ]


@pytest.mark.parametrize("angle", [3.0239239199893424, 3.4814525162841092, 5.819595751463642, 3.27494836830566])
def test_edges_on_one_line_leave_no_spikes(angle):
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    one = Polygon(np.array([(0, 0), (20, 0), (20, 30), (0, 30)]) @ turn + (0, 2000), "plot", "one")
    two = Polygon(np.array([(17.4, 0), (40, 0), (40, 30), (17.4, 30)]) @ turn + (0, 2000), "plot", "two")
    problems = []
    made = without_overlaps(Scene([one, two]), None, problems)
    assert made.polygon("two").area == pytest.approx(20 * 30) and len(made.polygon("two").points) == 4
    assert problems == ["polygon 'two' overlaps 'one' by 12% of its area and has been cut back"]
