"""Scenes from and to GeoJSON."""

import json

import numpy as np
import pytest
import strategies
from hypothesis import given, settings
from hypothesis import strategies as st
from shapes import COURTYARD, DOOR, HOLED_ROOM, L_ROOM, UNIT_SQUARE, rectangle

from geoanalogy import InputError, Polygon, Scene, read_scene, write_scene
from geoanalogy.formats import geojson
from geoanalogy.formats.outlines import make_scene

SQUARE = [[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]]


def feature(coordinates=(SQUARE,), kind="Polygon", **properties):
    geometry = {"type": kind, "coordinates": list(coordinates)}
    return {"type": "Feature", "properties": properties, "geometry": geometry}


def collection(*features, **more):
    return {"type": "FeatureCollection", "features": list(features), **more}


def read(data, **options):
    content = data if isinstance(data, bytes) else json.dumps(data).encode()
    return make_scene("rooms.geojson", geojson.read(content, "rooms.geojson", **options))


def as_data(scene):
    return scene.to_dict()


# What is read


def test_properties():
    scene = read(
        collection(
            feature(
                id="r1", label="bedroom", orientation=0.5, segment_labels=["door", "", None, "window"], parent="flat"
            ),
            feature([[[-1, -1], [9, -1], [9, 9], [-1, 9], [-1, -1]]], id="flat", label="flat"),
        )
    )
    room = scene.polygon("r1")
    assert (room.label, room.orientation, room.segment_labels) == ("bedroom", 0.5, ("door", "", "", "window"))
    assert room.points.tolist() == UNIT_SQUARE.tolist()
    assert scene.parent("r1") is scene.polygon("flat")


def test_nothing_but_a_geometry_is_needed():
    scene = read(collection({"type": "Feature", "geometry": {"type": "Polygon", "coordinates": [SQUARE]}}))
    assert [(p.id, p.label) for p in scene.polygons] == [("polygon 0", "")]


def test_what_is_null_or_empty_says_nothing():
    unnamed = {**feature(id=None, kind_of=None, label="hall"), "id": "f7"}
    scene = read(collection(unnamed, feature([]), feature([], "MultiPolygon")), label="kind_of")
    assert [(p.id, p.label) for p in scene.polygons] == [("f7", "hall")]


def test_a_bare_collection_of_geometries():
    parts = [{"type": "Polygon", "coordinates": [SQUARE]}, {"type": "Point", "coordinates": [0, 0]}]
    (polygon,) = read({"type": "GeometryCollection", "geometries": parts}).polygons
    assert polygon.points.tolist() == UNIT_SQUARE.tolist()


def test_id_of_the_feature_counts_where_the_properties_have_none():
    scene = read(collection({**feature(), "id": 17}, {**feature(id="b"), "id": 18}))
    assert [p.id for p in scene.polygons] == ["17", "b"]


def test_repeated_ids_are_numbered():
    assert [p.id for p in read(collection(feature(id="r"), feature(id="r"))).polygons] == ["r", "r.001"]


def test_any_property_can_be_the_label():
    data = collection(feature(building="garage"), feature(label="road"), feature(building=3))
    assert [p.label for p in read(data, label="building").polygons] == ["garage", "road", "3"]
    assert [p.label for p in read(data).polygons] == ["", "road", ""]


def test_a_number_without_end_is_named_in_our_own_words():
    content = b'{"type": "Feature", "geometry": {"type": "Polygon", "coordinates": [[[1' + b"0" * 5000 + b", 0]]]}}"
    with pytest.raises(InputError, match=r"not valid JSON \(it has a number of thousands of digits\)"):
        geojson.read(content, "plan.geojson")


def test_a_label_that_no_feature_has_is_named():
    data = collection(feature(label="road"), feature())
    with pytest.raises(InputError, match=r"has no feature with the property 'bilding' to take labels from; check"):
        read(data, label="bilding")


def test_holes_and_heights():
    rings = [[[*v, 7.5] for v in np.vstack([r, r[:1]]).tolist()] for r in (HOLED_ROOM, COURTYARD)]
    (room,) = read(collection(feature(rings))).polygons
    assert room.area == 14


def test_multipolygon_becomes_polygons_of_one_name():
    parts = [[SQUARE], [[[v[0] + 5, v[1]] for v in SQUARE]]]
    labels = [["door", "", "", ""], ["", "", "", "window"]]
    scene = read(collection(feature(parts, "MultiPolygon", id="wing", label="wing", segment_labels=labels)))
    assert [(p.id, p.label) for p in scene.polygons] == [("wing", "wing"), ("wing.001", "wing")]
    assert [p.segment_labels for p in scene.polygons] == [tuple(names) for names in labels]


def test_lines_and_points_are_left_out_and_collections_opened():
    areas = {"type": "Polygon", "coordinates": [SQUARE]}
    point = {"type": "Point", "coordinates": [0, 0]}
    line = {"type": "LineString", "coordinates": [[0, 0], [1, 1]]}
    mixed = {
        "type": "GeometryCollection",
        "geometries": [point, areas, {"type": "GeometryCollection", "geometries": [areas]}],
    }
    scene = read(
        collection(
            {"type": "Feature", "properties": None, "geometry": mixed},
            {"type": "Feature", "properties": {}, "geometry": line},
            {"type": "Feature", "properties": {}, "geometry": None},
        )
    )
    assert len(scene) == 2


@pytest.mark.parametrize("data", [feature(label="room"), {"type": "Polygon", "coordinates": [SQUARE]}])
def test_a_feature_or_a_geometry_alone(data):
    assert len(read(data)) == 1


def test_byte_order_mark():
    assert len(read(b"\xef\xbb\xbf" + json.dumps(collection(feature())).encode())) == 1


def test_projected_systems_are_read():
    crs = {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25832"}}
    assert len(read(collection(feature(), crs=crs))) == 1


# Far from the origin


def test_far_coordinates_are_brought_near_and_written_back(tmp_path):
    far = np.array([500_123.25, 5_400_456.5])
    rings = [(np.vstack([L_ROOM, L_ROOM[:1]]) + far).tolist()]
    scene = read(collection(feature(rings, id="r1", label="house")))
    assert scene.offset == (500_000.0, 5_400_000.0)
    assert scene.polygon("r1").points.tolist() == (L_ROOM + far - scene.offset).tolist()
    write_scene(scene, tmp_path / "again.geojson")
    assert json.loads((tmp_path / "again.geojson").read_text())["features"][0]["geometry"]["coordinates"] == rings
    assert as_data(read_scene(tmp_path / "again.geojson")) == as_data(scene)


@pytest.mark.parametrize("shift", [0.0, 9_000.0])
def test_near_coordinates_stay(shift):
    rings = [(np.array(SQUARE) + shift).tolist()]
    assert read(collection(feature(rings))).offset == (0.0, 0.0)


def test_a_large_scene_about_the_origin_stays():
    assert read(collection(feature([[[-30_000, 0], [60_000, 0], [0, 50_000], [-30_000, 0]]]))).offset == (0.0, 0.0)


# Writing


@given(
    st.lists(
        st.tuples(strategies.rings(), strategies.similarities(), st.text(max_size=8), st.booleans(), st.booleans()),
        max_size=4,
    )
)
@settings(max_examples=50)
def test_written_and_read_again_is_the_same(drawn):
    polygons = [
        Polygon(rectangle(500, 500, (-250, -250)), id="all", label="ground", holes=[rectangle(1, 1, (240, 240))])
    ]
    for k, (ring, similarity, label, stated, turned) in enumerate(drawn):
        polygons.append(
            Polygon(
                similarity(ring),
                label=label,
                id=f"{label} {k}",
                parent="all" if stated else None,
                orientation=similarity.angle if turned else None,
                segment_labels=[label, *[""] * (len(ring) - 1)] if turned else None,
            )
        )
    scene = Scene(polygons)
    assert as_data(read(geojson.write(scene).encode())) == as_data(scene)


def test_one_feature_per_line_and_the_schema(tmp_path):
    path = tmp_path / "rooms.geojson"
    write_scene(Scene([Polygon(DOOR, label="Tür"), Polygon(HOLED_ROOM, holes=[COURTYARD])]), path)
    text = path.read_text()
    assert len(text.splitlines()) == 4
    data = json.loads(text)
    assert data["schema"] == "geoanalogy.scene/1"
    assert data["features"][0]["properties"] == {"label": "Tür", "id": "polygon 0"}
    assert [f["geometry"]["type"] for f in data["features"]] == ["Polygon", "Polygon"]
    outline, hole = data["features"][1]["geometry"]["coordinates"]
    assert outline[0] == outline[-1]
    assert hole[0] == hole[-1]
    assert list(tmp_path.iterdir()) == [path]


# What is refused


def refused(data, message, **options):
    with pytest.raises(InputError, match=message) as raised:
        read(data, **options)
    assert str(raised.value).startswith("rooms.geojson")
    assert "\n" not in str(raised.value)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b'{"type": "FeatureCollection", "features": [{"ty', r"not valid JSON \(line 1: .*\); it may be cut off"),
        (b"[" * 100_000, "nested too deeply"),
        (b"\xff\xfe{", "not text in UTF-8; save it as UTF-8"),
        (b"[1" + b"0" * 5000 + b"]", "not valid JSON"),
        (b"[]", "no GeoJSON of polygons; give a FeatureCollection of Polygon features"),
        (b'{"type": "Topology"}', "no GeoJSON of polygons"),
        (b'{"type": "FeatureCollection"}', "no list of features"),
        (b'{"type": "FeatureCollection", "features": []}', "holds no closed shape; draw the outlines"),
    ],
)
def test_files_that_are_refused(content, message):
    refused(content, message)


def test_schemas():
    assert len(read(collection(feature(), schema="geoanalogy.scene/1"))) == 1
    assert len(read(collection(feature(), schema="somebody else's"))) == 1
    refused(
        collection(feature(), schema="geoanalogy.scene/2"), "'geoanalogy.scene/2', .*; open it with a newer GeoAnalogy"
    )
    refused(collection(feature(), schema="geoanalogy.operations/1"), "'geoanalogy.operations/1', which is no scene")


@pytest.mark.parametrize(
    "crs",
    [
        {"type": "name", "properties": {"name": "urn:ogc:def:crs:OGC:1.3:CRS84"}},
        {"type": "name", "properties": {"name": "EPSG:4326"}},
        {"type": "name", "properties": {"name": "http://www.opengis.net/def/crs/EPSG/0/4258"}},
        {"type": "EPSG", "properties": {"code": 4326}},
    ],
)
def test_degrees_are_refused(crs):
    refused(collection(feature(), crs=crs), "coordinates in degrees .*; export it in a projected system in metres")


@pytest.mark.parametrize(
    ("bad", "message"),
    [
        ("room", "feature 1: it is no Feature"),
        ({"type": "Room"}, "feature 1: it is no Feature"),
        (feature([SQUARE[:-1]]), "feature 1: ring 0 is open; repeat its first position at the end"),
        (feature([SQUARE, SQUARE[1:]], id="r2"), r"feature 1 \(id 'r2'\): ring 1 is open"),
        (feature([[[0, 0], [2, 2], [2, 0], [0, 3], [0, 0]]]), "feature 1: .* crosses or touches itself near x 1.2"),
        (feature([[[0, 0], [1, 0], [2, 0], [0, 0]]], id="r2"), "polygon 'r2' has no area"),
        (feature([[[0, 0], [0, 0]]]), "1 distinct vertex; a polygon needs at least three"),
        (feature([[]]), r"shape \(0, 2\)|0 distinct vertices"),
        ({"type": "Feature", "geometry": {"type": "Polygon", "coordinates": {}}}, "its Polygon has no rings"),
        (feature(orientation=True), "its orientation is True; give an angle in radians"),
        (feature([None]), "ring 0 is no list of x, y pairs of numbers"),
        (feature([[[0, 0], ["1", 0], [1, 1], [0, 0]]]), "ring 0 is no list of x, y pairs of numbers"),
        (feature([[[0, 0], [True, 0], [1, 1], [0, 0]]]), "ring 0 is no list of x, y pairs of numbers"),
        (feature([[[0, 0], [float("nan"), 0], [1, 1], [0, 0]]]), "not finite"),
        (feature([[[0, 0], [float("inf"), 0], [1, 1], [0, 0]]]), "more than 1e.09 units|not finite"),
        (feature([[[0, 0], [10**400, 0], [1, 1], [0, 0]]]), "a number beyond all coordinates"),
        (feature([[[1e12, 0], [1e12 + 1, 0], [1e12, 1], [1e12, 0]]]), "more than 1e.09 units from the origin"),
        (feature([SQUARE, [[5, 5], [6, 5], [6, 6], [5, 5]]]), "a hole that leaves its outline"),
        (feature(None or [[0, 0]], "Circle"), "its geometry is 'Circle'; give a Polygon or MultiPolygon"),
        (feature([3], "MultiPolygon"), "its MultiPolygon has no rings"),
        (feature(kind="GeometryCollection"), "has no list of geometries"),
        (feature(label=["a"]), r"its label is \['a'\]; give a text"),
        (feature(id={}), "its id is {}; give a text"),
        (feature(parent=False), "its parent is False; give a text"),
        (feature(orientation="north"), "its orientation is 'north'; give an angle in radians"),
        (feature(orientation=10**400), "its orientation is 1000.*; give an angle in radians"),
        (feature(orientation=float("nan")), "orientation"),
        (feature(segment_labels="door"), "segment_labels are no list of texts"),
        (feature(segment_labels=[1, 2, 3, 4]), "segment_labels are no list of texts"),
        (feature(segment_labels=["door"]), "1 segment labels for 4 edges"),
        ({"type": "Feature", "properties": [], "geometry": None}, r"its properties are \[\]; give an object or null"),
        ({"type": "Feature", "properties": {"segment_labels": []}, "geometry": None}, "segment_labels are no list"),
    ],
)
def test_features_that_are_refused(bad, message):
    refused(collection(feature(id="first"), bad), message)


def test_unknown_parents_are_refused():
    refused(
        collection(feature(id="bed", parent="attic")),
        "polygon 'bed' names the parent 'attic', which is not in the scene",
    )


JSON = st.recursive(
    st.none()
    | st.booleans()
    | st.integers()
    | st.floats()
    | st.text(max_size=5)
    | st.sampled_from(["Polygon", "Feature"]),
    lambda inner: (
        st.lists(inner, max_size=4)
        | st.dictionaries(
            st.sampled_from(
                ["type", "features", "geometry", "coordinates", "properties", "label", "id", "parent", "crs"]
            ),
            inner,
        )
    ),
    max_leaves=12,
)


@given(JSON, st.data())
def test_whatever_stands_in_a_file_is_read_or_refused(value, data):
    """A good file in which one value is replaced by another."""
    good = collection(feature(id="a", label="b", orientation=0.5, segment_labels=["", "", "", "d"]), feature(id="c"))
    good = json.loads(json.dumps(good))  # nothing in it is shared
    places = list(_places(good))
    keys = data.draw(st.sampled_from(places))
    holder = good
    for key in keys[:-1]:
        holder = holder[key]
    holder[keys[-1]] = value
    _read_or_refuse(json.dumps(good).encode())


def _places(value, path=()):
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, inner in items:
        yield (*path, key)
        yield from _places(inner, (*path, key))


@given(JSON)
def test_any_json_is_read_or_refused(value):
    _read_or_refuse(json.dumps(value).encode())


@given(st.integers(0, 400), st.binary(max_size=6), st.integers(0, 6))
def test_any_damage_is_read_or_refused(place, inserted, removed):
    text = json.dumps(collection(feature(id="a", label="b"), feature(id="c"))).encode()
    _read_or_refuse(text[:place] + inserted + text[place + removed :])


def _read_or_refuse(content):
    try:
        read(content)
    except InputError as error:
        assert str(error).startswith("rooms.geojson")
