"""Plans from ASCII DXF."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from geoanalogy import InputError
from geoanalogy.formats import dxf
from geoanalogy.formats.outlines import make_scene
from geoanalogy.geometry.features import polygon_features


def tags(*pairs):
    return "".join(f"{code}\n{value}\n" for code, value in pairs)


def entity(kind, *pairs, layer="room"):
    return tags((0, kind), (8, layer), *pairs)


def line(x1, y1, x2, y2, layer="wall"):
    return entity("LINE", (10, x1), (20, y1), (11, x2), (21, y2), layer=layer)


def polyline(vertices, closed=True, bulges=None, layer="room", extra=()):
    pairs = [(90, len(vertices)), (70, int(closed)), *extra]
    for k, (x, y) in enumerate(vertices):
        pairs += [(10, x), (20, y)] + ([(42, bulges[k])] if bulges else [])
    return entity("LWPOLYLINE", *pairs, layer=layer)


def insert(name, x=0, y=0, *pairs, layer="furniture"):
    return entity("INSERT", (2, name), (10, x), (20, y), *pairs, layer=layer)


def block(name, body, x=0, y=0):
    return tags((0, "BLOCK"), (2, name), (10, x), (20, y)) + body + tags((0, "ENDBLK"))


def document(body, blocks="", header=(), layers=""):
    sections = [
        tags((0, "SECTION"), (2, "HEADER"), *header, (0, "ENDSEC")),
        tags((0, "SECTION"), (2, "TABLES")) + layers + tags((0, "ENDSEC")),
        tags((0, "SECTION"), (2, "BLOCKS")) + blocks + tags((0, "ENDSEC")),
        tags((0, "SECTION"), (2, "ENTITIES")) + body + tags((0, "ENDSEC")),
        tags((0, "EOF")),
    ]
    return "".join(sections).encode()


def outlines(body, label=None, **more):
    return dxf.read(document(body, **more), "plan.dxf", label)


def scene(body, label=None, **more):
    return make_scene("plan.dxf", outlines(body, label, **more))


def only(body, label=None, **more):
    (polygon,) = scene(body, label, **more).polygons
    return polygon


def places(ring):
    return {(round(x, 4) + 0.0, round(y, 4) + 0.0) for x, y in ring}


SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
UNIT = {(0, 0), (1, 0), (1, 1), (0, 1)}


# Entities


def test_closed_polyline_and_its_layer():
    room = only(polyline(SQUARE, extra=[(5, "2F")]))
    assert places(room.points) == UNIT
    assert (room.label, room.id) == ("room", "2F")


def test_polyline_that_ends_where_it_starts():
    assert places(only(polyline([*SQUARE, (0, 0)], closed=False)).points) == UNIT
    assert places(only(polyline([*SQUARE, (0, 1e-5)], closed=True)).points) == UNIT


def test_bulges_are_arcs():
    # A stadium: two straight sides and two half rounds, counter-clockwise, so outwards.
    stadium = only(polyline([(0, 0), (4, 0), (4, 2), (0, 2)], bulges=[0, 1, 0, 1]))
    assert stadium.area == pytest.approx(8 + np.pi, rel=2e-3)
    assert stadium.bounds == pytest.approx([-1, 0, 5, 2], abs=1e-2)
    assert polygon_features(stadium)[1] == []
    bitten = only(polyline([(0, 0), (4, 0), (4, 2), (0, 2)], bulges=[0, -0.5, 0, 0]))
    # Bulge -0.5: an arc of 4 atan(0.5) inwards over a chord of 2; its rise is a quarter of the chord.
    assert 4 - bitten.points[np.abs(bitten.points[:, 1] - 1).argmin(), 0] == pytest.approx(0.5, abs=1e-2)


def test_a_circle_of_two_bulges():
    ring = only(polyline([(-3, 0), (3, 0)], bulges=[1, 1])).points
    assert np.hypot(*ring.T) == pytest.approx(3, abs=1e-4)


def test_old_polyline():
    vertices = "".join(
        tags((0, "VERTEX"), (8, "room"), (10, x), (20, y), (42, b))
        for x, y, b in [(0, 0, 0), (4, 0, 1), (4, 2, 0), (0, 2, 0)]
    )
    frame = tags((0, "VERTEX"), (10, 99), (20, 99), (70, 16))
    room = only(entity("POLYLINE", (66, 1), (70, 1)) + vertices + frame + tags((0, "SEQEND")) + line(0, 0, 9, 9))
    assert room.area == pytest.approx(8 + np.pi / 2, rel=2e-3)


@pytest.mark.parametrize("flag", [16, 64])
def test_meshes_are_left_out(flag):
    vertices = "".join(tags((0, "VERTEX"), (10, x), (20, y)) for x, y in SQUARE)
    assert outlines(entity("POLYLINE", (70, flag | 1)) + vertices + tags((0, "SEQEND"))) == []


def test_circle():
    table = only(entity("CIRCLE", (10, 5), (20, 2), (40, 0.75)))
    assert np.hypot(*(table.points - (5, 2)).T) == pytest.approx(0.75, abs=1e-5)
    assert polygon_features(table)[1] == []


def test_ellipses():
    axes = [(10, 1), (20, 2), (11, 0), (21, 3), (40, 0.5)]
    tub = only(entity("ELLIPSE", *axes))
    assert tub.bounds == pytest.approx([-0.5, -1, 2.5, 5], abs=1e-2)
    assert only(entity("ELLIPSE", *axes, (41, 1.0), (42, 1.0 + 2 * np.pi))).area == pytest.approx(4.5 * np.pi, rel=5e-3)
    # Half of it, closed by a line: from angle 0 (the top) counter-clockwise over the left.
    half = entity("ELLIPSE", *axes, (41, 0), (42, np.pi)) + line(1, -1, 1, 5, layer="room")
    assert only(half).bounds == pytest.approx([-0.5, -1, 1, 5], abs=1e-2)
    # Seen from behind it runs over the right.
    assert only(half.replace("LINE", "LINE").replace("\nELLIPSE\n", "\nELLIPSE\n230\n-1\n")).bounds == pytest.approx(
        [1, -1, 2.5, 5], abs=1e-2
    )


def spline(control, knots, degree=3, flags=1, weights=()):
    pairs = [(70, flags), (71, degree), *((40, k) for k in knots), *((41, w) for w in weights)]
    for x, y in control:
        pairs += [(10, x), (20, y)]
    return entity("SPLINE", *pairs)


def test_splines():
    bezier = spline([(0, 0), (0, 4 / 3), (2, 4 / 3), (2, 0)], [0, 0, 0, 0, 1, 1, 1, 1])
    lens = only(bezier)
    assert lens.bounds == pytest.approx([0, 0, 2, 1], abs=1e-2)
    assert lens.area == pytest.approx(1.6, rel=5e-3)
    # A circle as a rational quadratic of four quarters.
    r = np.sqrt(0.5)
    control = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)]
    knots = [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4]
    circle = only(spline(control, knots, degree=2, weights=[1, r, 1, r, 1, r, 1, r, 1]))
    assert np.hypot(*circle.points.T) == pytest.approx(1, abs=3e-4)
    # Only the points it runs through.
    fit = entity("SPLINE", (70, 1), *(pair for x, y in SQUARE for pair in ((11, x), (21, y))))
    assert places(only(fit).points) == UNIT


def test_lines_and_arcs_join_to_rings_where_their_ends_meet():
    body = line(0, 0, 4, 0) + line(0, 2, 0, 0) + line(4, 2, 0, 2.000001)
    bow = entity("ARC", (10, 4), (20, 1), (40, 1), (50, 270), (51, 90), layer="wall")
    room = only(body + bow)
    assert room.area == pytest.approx(8 + np.pi / 2, rel=2e-3)
    assert room.label == "wall"


def test_shared_walls_make_two_rooms_and_loose_ends_none():
    body = (
        line(0, 0, 4, 0) + line(4, 0, 8, 0) + line(8, 0, 8, 3) + line(8, 3, 4, 3) + line(4, 3, 0, 3) + line(0, 3, 0, 0)
    )
    body += line(4, 0, 4, 3) + line(4, 3, 4, 0) + line(8, 0, 12, -3)
    assert [p.bounds.tolist() for p in scene(body).polygons] == [[0, 0, 4, 3], [4, 0, 8, 3]]


def test_what_stands_inside_a_ring_of_lines_is_no_hole():
    def box(x, y, size):
        return (
            line(x, y, x + size, y)
            + line(x + size, y, x + size, y + size)
            + line(x + size, y + size, x, y + size)
            + line(x, y + size, x, y)
        )

    plan = scene(box(0, 0, 5) + box(1, 1, 2))
    assert [p.area for p in plan.polygons] == [25, 4]
    assert plan.parent(plan.polygons[1].id) is plan.polygons[0]


def test_layers_are_not_joined():
    assert outlines(line(0, 0, 4, 0) + line(4, 0, 4, 3) + line(4, 3, 0, 0, layer="other")) == []


@pytest.mark.parametrize("kind", ["TEXT", "MTEXT", "HATCH", "POINT", "DIMENSION"])
def test_other_entities_are_left_out(kind):
    assert outlines(entity(kind, (10, 0), (20, 0))) == []


def test_seen_from_behind_x_runs_the_other_way():
    mirrored = polyline([(1, 0), (3, 0), (3, 1)], extra=[(210, 0), (220, 0), (230, -1)])
    assert places(only(mirrored).points) == {(-1, 0), (-3, 0), (-3, 1)}
    assert only(entity("CIRCLE", (10, 5), (20, 2), (40, 1), (230, -1))).bounds == pytest.approx(
        [-6, 1, -4, 3], abs=1e-2
    )


# What is not shown


@pytest.mark.parametrize("off", [(70, 1), (62, -7)])
def test_hidden_layers_are_left_out(off):
    layers = tags((0, "LAYER"), (2, "grid"), off) + tags((0, "LAYER"), (2, "room"), (70, 0), (62, 7))
    plan = scene(polyline(SQUARE, layer="grid") + polyline(SQUARE), layers=layers)
    assert [p.label for p in plan.polygons] == ["room"]


@pytest.mark.parametrize("mark", [(67, 1), (60, 1)])
def test_paper_space_and_invisible_entities_are_left_out(mark):
    assert outlines(polyline(SQUARE, extra=[mark])) == []


# Blocks


def test_block_is_placed():
    bed = block("BED", polyline([(10, 10), (12, 10), (12, 11), (10, 11)], layer="0"), x=10, y=10)
    placed = only(insert("BED", 5, 6, (41, 2), (42, 1), (50, 90)), blocks=bed)
    assert places(placed.points) == {(5, 6), (5, 10), (4, 10), (4, 6)}
    assert placed.label == "furniture"


def test_layer_zero_takes_the_layer_of_the_insert():
    bed = block("BED", polyline(SQUARE, layer="0") + polyline([(0, 0), (0.5, 0), (0.5, 0.5)], layer="pillow"))
    assert [p.label for p in scene(insert("BED"), blocks=bed).polygons] == ["furniture", "pillow"]


def test_label_from_the_block():
    inner = block("LEG", entity("CIRCLE", (40, 0.1), layer="0"))
    table = block("TABLE", polyline(SQUARE) + insert("LEG", 0.5, 0.5))
    anonymous = block("*U3", polyline(SQUARE))
    body = insert("TABLE") + polyline(SQUARE, layer="rug") + insert("*U3", 5, 5)
    blocks = inner + table + anonymous
    assert [p.label for p in scene(body, "block", blocks=blocks).polygons] == ["TABLE", "TABLE", "rug", "room"]
    assert [p.label for p in scene(body, "layer", blocks=blocks).polygons] == ["room", "furniture", "rug", "room"]


def test_blocks_nest_and_mirror():
    seat = block("SEAT", polyline([(0, 0), (1, 0), (1, 2)], layer="0"))
    row = block("ROW", insert("SEAT", 1, 0, (41, -1), layer="0") + insert("SEAT", 3, 0, layer="0"))
    seats = scene(insert("ROW", 10, 0, (50, 90)), blocks=seat + row).polygons
    assert [places(p.points) for p in seats] == [{(10, 1), (10, 0), (8, 0)}, {(10, 3), (10, 4), (8, 4)}]


def test_rows_and_columns():
    chair = block("CHAIR", polyline([(0, 0), (0.4, 0), (0, 0.4)], layer="0"))
    body = insert("CHAIR", 0, 0, (70, 3), (71, 2), (44, 1), (45, 2), (50, 90))
    corners = {tuple(p.points[0].round(6) + 0.0) for p in scene(body, blocks=chair).polygons}
    assert corners == {(-2.0 * row + 0.0, 1.0 * column) for row in range(2) for column in range(3)}


def test_handles_of_inserts_and_entities_make_ids():
    leg = block("LEG", polyline(SQUARE, extra=[(5, "A1")]))
    body = insert("LEG", 0, 0, (5, "B7")) + insert("LEG", 3, 0, (5, "B8")) + insert("LEG", 6, 0)
    assert [p.id for p in scene(body, blocks=leg).polygons] == ["B7-A1", "B8-A1", "A1"]


# Units


@pytest.mark.parametrize(("code", "metres"), [(0, 1), (1, 0.0254), (2, 0.3048), (4, 0.001), (5, 0.01), (6, 1), ("", 1)])
def test_units(code, metres):
    room = only(
        polyline([(0, 0), (4000, 0), (0, 3000)]), header=[(9, "$ACADVER"), (1, "AC1027"), (9, "$INSUNITS"), (70, code)]
    )
    assert room.bounds == pytest.approx([0, 0, 4000 * metres, 3000 * metres])


def test_old_code_pages_and_line_ends():
    content = document(polyline(SQUARE, layer="Küche")).decode().replace("\n", "\r\n")
    for encoding in ("utf-8", "utf-8-sig", "cp1252"):
        assert [o.properties["label"] for o in dxf.read(content.encode(encoding), "plan.dxf")] == ["Küche"]


# What is refused


def refused(content, message, **more):
    with pytest.raises(InputError, match=message) as raised:
        content = content if isinstance(content, bytes) else document(content, **more)
        make_scene("plan.dxf", dxf.read(content, "plan.dxf"))
    assert str(raised.value).startswith("plan.dxf")


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"AutoCAD Binary DXF\r\n\x1a\0", "is a binary DXF; save it as an ASCII DXF"),
        (b"AC1027\0\0", "is a DWG drawing; save it as an ASCII DXF"),
        (document(polyline(SQUARE))[:-8], "ends without EOF, so it is cut off or no DXF; export it again"),
        (document(polyline(SQUARE))[:150], "ends without EOF"),
        (b"<svg/>\n<g/>", "line 1: '<svg/>' is no group code of an ASCII DXF"),
        (b"hello", "ends without EOF"),
        (
            document("", header=[(9, "$ACADVER"), (1, "AC1040")]),
            "version AC1040, newer than AC1032; save it as DXF of 2018",
        ),
        (document("", layers=tags((0, "LAYER"), (2, "a"), (70, "x"))), "layer 'a': 'x' is no number"),
        (document(""), "holds no closed shape"),
    ],
)
def test_files_that_are_refused(content, message):
    refused(content, message)


@pytest.mark.parametrize(
    ("body", "message"),
    [
        (polyline([(0, 0), (1, "wide"), (1, 1)]), "LWPOLYLINE number 1 on layer 'room': 'wide' is no number; correct"),
        (
            polyline([(0, 0), (1, 1), (1, 0), (0, 2)], extra=[(5, "2F")]),
            "LWPOLYLINE 2F on layer 'room': .* crosses or touches",
        ),
        (polyline([(0, 0), (1, 0), (2, 0)]), "has no area"),
        (polyline([(0, 0), (1, 0)]), "2 distinct vertices; a polygon needs at least three"),
        (polyline([(0, 0), ("nan", 0), (1, 1)]), "LWPOLYLINE number 1 on layer 'room': 'nan' is no number; correct"),
        (polyline([(0, 0), (1, 0), (1, 1)], bulges=["inf", 0, 0]), "'inf' is no number; correct or delete it"),
        (polyline([(0, 0), (1, 0), (1, 1)], bulges=["nan", 0, 0]), "'nan' is no number; correct or delete it"),
        (polyline([(0, 0), ("1e300", 0), (1, 1)]), r"more than 1e\+09 units from the origin"),
        (
            polyline([(0, 0), (9, 0), (9, 9), (0, 9), (0, 0.2)], closed=False),
            "the ring is open, its ends are 0.2 units apart",
        ),
        (entity("CIRCLE", (40, 0)), "CIRCLE number 1 on layer 'room': its radius is 0"),
        (entity("ARC", (40, "nan")), "'nan' is no number"),
        (entity("ELLIPSE", (40, 0.5)), "its axes have no length"),
        (spline([(0, 0), (1, 1)], [0, 1]), "its 2 control points, 2 knots and degree 3 make no spline"),
        (
            insert("CHAIR"),
            "INSERT number 1 on layer 'furniture': it inserts the block 'CHAIR', which the file does not hold",
        ),
        (
            line(0, 0, 9, 0) + line(9, 0, 9, 9) + line(9, 9, 0, 9) + line(0, 9, 0, 0.2),
            "the lines on layer 'wall': the ring is open",
        ),
        (
            line(0, 0, 2, 2) + line(2, 2, 2, 0) + line(2, 0, 0, 3) + line(0, 3, 0, 0),
            "the lines on layer 'wall': .* crosses",
        ),
    ],
)
def test_entities_that_are_refused(body, message):
    refused(body, message)


def test_blocks_that_insert_themselves_are_refused():
    refused(
        insert("A"),
        "the block '[AB]' inserts itself; explode it",
        blocks=block("A", insert("B")) + block("B", insert("A")),
    )


def test_explosions_of_blocks_are_refused(monkeypatch):
    monkeypatch.setattr(dxf, "_MOST_ENTITIES", 1000)
    blocks = "".join(block(f"L{k}", insert(f"L{k + 1}") * 10) for k in range(9)) + block("L9", polyline(SQUARE))
    refused(insert("L0"), "draws more than 1000 entities; export less of the drawing", blocks=blocks)
    rows = insert("L9", 0, 0, (70, 30000), (71, 30000))
    refused(rows, "it repeats its block 30000 by 30000 times", blocks=block("L9", polyline(SQUARE)))


def test_other_sources_of_labels_are_refused():
    with pytest.raises(InputError, match="no attribute 'colour' to take labels from; a DXF has 'layer' and 'block'"):
        outlines(polyline(SQUARE), "colour")


TAG = st.tuples(
    st.sampled_from([0, 2, 5, 8, 10, 20, 11, 21, 40, 41, 42, 50, 51, 60, 66, 67, 70, 71, 90, 230]),
    st.one_of(
        st.sampled_from(
            [
                "LINE",
                "ARC",
                "INSERT",
                "SPLINE",
                "ELLIPSE",
                "VERTEX",
                "POLYLINE",
                "LWPOLYLINE",
                "CIRCLE",
                "SEQEND",
                "B",
                "",
            ]
        ),
        st.integers(-3, 70),
        st.floats(),
    ),
)


@given(st.lists(TAG, max_size=25), st.lists(TAG, max_size=8))
def test_any_tags_are_read_or_refused(body, inside):
    _read_or_refuse(document(line(0, 0, 1, 1) + tags(*body), blocks=block("B", tags(*inside))))


GOOD = document(
    polyline(SQUARE, bulges=[0, 1, 0, 0])
    + spline([(0, 0), (0, 2), (2, 2), (2, 0)], [0, 0, 0, 0, 1, 1, 1, 1])
    + insert("B", 1, 2, (41, 2), (50, 30), (70, 2))
    + "".join(line(*v) for v in [(0, 0, 5, 0), (5, 0, 5, 5), (5, 5, 0, 0)]),
    blocks=block("B", entity("CIRCLE", (40, 1)) + entity("ELLIPSE", (11, 2), (40, 0.5))),
    header=[(9, "$INSUNITS"), (70, 4)],
)


def test_what_is_damaged_below_is_good():
    assert len(make_scene("plan.dxf", dxf.read(GOOD, "plan.dxf"))) == 7


@given(st.integers(0, len(GOOD)), st.binary(max_size=5), st.integers(0, 5))
def test_any_damage_is_read_or_refused(place, inserted, removed):
    _read_or_refuse(GOOD[:place] + inserted + GOOD[place + removed :])


def _read_or_refuse(content):
    try:
        make_scene("plan.dxf", dxf.read(content, "plan.dxf"))
    except InputError as error:
        assert str(error).startswith("plan.dxf")


@pytest.mark.parametrize(
    ("written", "read"),
    [(r"K\U+00FCche", "Küche"), (r"\U+5BDD\U+5BA4", "寝室"), (r"\U+00", r"\U+00"), (r"\U+D800", r"\U+D800")],
)
def test_letters_written_by_their_numbers_are_read(written, read):
    assert only(polyline(SQUARE, layer=written)).label == read


def test_names_of_blocks_and_layers_count_whatever_the_case_of_their_letters():
    layers = tags((0, "LAYER"), (2, "Hidden"), (70, 1), (62, 7))
    body = insert("CHAIR") + polyline(SQUARE, layer="HIDDEN")
    (found,) = scene(body, blocks=block("Chair", polyline(SQUARE, layer="0")), layers=layers).polygons
    assert places(found.points) == UNIT


def test_an_ellipse_of_six_digits_is_closed():
    body = entity("ELLIPSE", (10, 0), (20, 0), (11, 2), (21, 0), (40, 0.5), (41, 0.0), (42, 6.28319))
    assert only(body).area == pytest.approx(2 * np.pi, rel=1e-2)
