"""Drawings from SVG."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from geoanalogy import InputError
from geoanalogy.formats import svg
from geoanalogy.formats.outlines import make_scene
from geoanalogy.geometry.features import polygon_features

HEAD = (
    'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
    'xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"'
)


def document(body, attributes=""):
    return f"<svg {HEAD} {attributes}>{body}</svg>".encode()


def outlines(body, attributes="", **options):
    return svg.read(document(body, attributes), "plan.svg", **options)


def scene(body, attributes="", **options):
    return make_scene("plan.svg", outlines(body, attributes, **options))


def only(body, attributes="", **options):
    (polygon,) = scene(body, attributes, **options).polygons
    return polygon


def places(ring):
    """The vertices as a set, to thousandths; the page's y axis is flipped back."""
    return {(round(x, 3) + 0.0, round(-y, 3) + 0.0) for x, y in ring}


UNIT = {(0, 0), (1, 0), (1, 1), (0, 1)}


# Paths


@pytest.mark.parametrize(
    "data",
    [
        "M0,0 L1,0 L1,1 L0,1 Z",
        "M0 0 1 0 1 1 0 1z",
        "m0 0 1 0 0 1-1 0z",
        "M0 0H1V1H0Z",
        "m0,0h1v1h-1z",
        "M.0.0L1.0.0 1e0 1 0 10e-1Z",
        "M 0 0 L 1 0 1 1 0 1 L 0 0",
        "M0 0L1 0L1 1L0 1L1e-6 0Z",
        "M0 0L1 0L1 1L0 1",
        "M5 5 M0 0 L1 0 1 1 0 1 z M7 7 z",
    ],
)
def test_ways_to_write_a_square(data):
    assert places(only(f'<path d="{data}"/>').points) == UNIT


def test_commands_after_closing_start_where_the_ring_started():
    body = '<path d="M2 2h1v1h-1z l5 0 1 1 -1 0z"/>'
    assert [p.area for p in scene(body).polygons] == [3.0, 1.0]


def radii(ring, centre):
    return np.hypot(*(ring - centre).T)


@pytest.mark.parametrize(
    "data",
    [
        "M3 0 A3 3 0 0 1 -3 0 A3 3 0 0 1 3 0 Z",
        "M3 0 A3 3 0 1 0 -3 0 A3 3 0 0 0 3 0 Z",
        "m3 0a3 3 0 01-6 0 3 3 0 01 6 0z",
        "M3 0 A1 1 0 0 1 -3 0 A.1 .1 0 0 1 3 0 Z",
        "M0 -3A3 3 45 1 1-3 0 3-3 0 0 1 0-3z",
    ],
)
def test_circles_of_arcs(data):
    polygon = only(f'<path d="{data}"/>')
    assert radii(polygon.points, (0, 0)) == pytest.approx(3, abs=2e-5)
    assert polygon.area == pytest.approx(9 * np.pi, rel=5e-3)
    assert len(polygon_features(polygon)[1]) == 0


def test_arc_flags_choose_among_four_arcs():
    # Chord from (0, 0) to (2, 0) on circles of radius 2: the arc's highest and lowest points tell which it is.
    rise = 2 - np.sqrt(3)
    extents = {}
    for large in (0, 1):
        for sweep in (0, 1):
            ring = only(f'<path d="M0 0A2 2 0 {large} {sweep} 2 0z"/>').points
            extents[large, sweep] = (ring[:, 1].max(), ring[:, 1].min())
    # On the page y points down: an arc with sweep bulges upwards for us.
    assert extents[0, 1] == pytest.approx((rise, 0), abs=2e-3)
    assert extents[0, 0] == pytest.approx((0, -rise), abs=2e-3)
    assert extents[1, 1] == pytest.approx((4 - rise, 0), abs=5e-3)
    assert extents[1, 0] == pytest.approx((0, rise - 4), abs=5e-3)


def test_rotated_elliptic_arc():
    c, s = np.cos(np.radians(30)), np.sin(np.radians(30))
    ends = f"{-2 * c} {-2 * s}", f"{2 * c} {2 * s}"
    ring = only(f'<path d="M{ends[0]}A2 1 30 1 1 {ends[1]}A2 1 30 1 1 {ends[0]}z"/>').points * (1, -1)
    assert np.hypot(ring @ (c, s) / 2, ring @ (-s, c)) == pytest.approx(1, abs=1e-4)
    assert only('<path d="M2 0A2 1 0 1 1-2 0z" transform="rotate(30)"/>').area == pytest.approx(np.pi, rel=5e-3)


def test_smooth_commands_reflect_the_last_control_point():
    long = '<path d="M0 0C0 1 1 1 1 0C1 -1 2 -1 2 0L2 5L0 5z"/>'
    short = '<path d="M0 0C0 1 1 1 1 0S2 -1 2 0L2 5L0 5z"/>'
    assert only(short).points == pytest.approx(only(long).points)
    long = '<path d="M0 0Q1 1 2 0Q3 -1 4 0L4 5L0 5z"/>'
    short = '<path d="M0 0Q1 1 2 0T4 0L4 5L0 5z"/>'
    assert only(short).points == pytest.approx(only(long).points)
    # After anything else there is nothing to reflect.
    assert only('<path d="M0 0S1 1 2 0L2 5z"/>').points == pytest.approx(
        only('<path d="M0 0C0 0 1 1 2 0L2 5z"/>').points
    )
    assert places(only('<path d="M0 0T2 0L2 5z"/>').points) == {(0, 0), (2, 0), (2, 5)}


def test_bezier_area():
    # The area under a quadratic from (0, 0) over (1, 1) to (2, 0) is 2/3.
    assert only('<path d="M0 0Q1 1 2 0z"/>').area == pytest.approx(2 / 3, rel=5e-3)
    assert only('<path d="M0 0q1 1 2 0z"/>').area == pytest.approx(2 / 3, rel=5e-3)


def test_straight_curves_stay_single_edges():
    assert places(only('<path d="M0 0C.5 0 .7 0 1 0C1 0 1 1 1 1L0 1z"/>').points) == UNIT


def test_flattening_is_smooth_however_it_is_stretched():
    for transform in ("scale(1)", "scale(20 1)", "matrix(1 3 0 .5 7 9)"):
        polygon = only(f'<circle r="5" transform="{transform}"/>')
        assert len(polygon_features(polygon)[1]) == 0
    assert 40 <= len(only('<circle r="5"/>').points) <= 130


def test_holes():
    body = '<path d="M0 0H9V9H0Z M1 1V3H3V1Z M5 5H8V8H5Z M6 6H7V7H6Z"/>'
    block, court = scene(body).polygons
    assert (block.area, [abs(h).max() for h in block.holes]) == (81 - 4 - 9, [8, 3])
    assert court.area == 1


# Basic shapes


@pytest.mark.parametrize(
    "element",
    [
        '<rect width="1" height="1"/>',
        '<rect x="-2" y="3" width="1" height="1" transform="translate(2 -3)"/>',
        '<polygon points="0,0 1,0 1,1 0,1"/>',
        '<polygon points="0 0 1 0 1 1 0 1 0 0"/>',
        '<polyline points="0,0 1,0 1,1 0,1 0,0" fill="none"/>',
        '<polyline points="0,0,1,0,1,1,0,1"/>',
    ],
)
def test_shapes_that_are_squares(element):
    assert places(only(element).points) == UNIT


def test_round_shapes():
    assert radii(only('<circle cx="4" cy="-3" r="2"/>').points, (4, 3)) == pytest.approx(2, abs=1e-4)
    ellipse = only('<ellipse cx="1" cy="0" rx="4" ry="2"/>')
    assert ellipse.bounds == pytest.approx([-3, -2, 5, 2], abs=1e-2)
    assert ellipse.area == pytest.approx(8 * np.pi, rel=5e-3)


@pytest.mark.parametrize(("radius", "rx", "ry"), [('rx="1"', 1, 1), ('ry="1"', 1, 1), ('rx="9" ry="1"', 2, 1)])
def test_rounded_rectangle(radius, rx, ry):
    room = only(f'<rect width="4" height="3" {radius}/>')
    assert room.area == pytest.approx(12 - (4 - np.pi) * rx * ry, rel=1e-3)
    assert room.bounds == pytest.approx([0, -3, 4, 0])


@pytest.mark.parametrize(
    "element",
    [
        '<rect width="0" height="3"/>',
        '<circle r="0"/>',
        '<polygon points=""/>',
        "<path/>",
        '<path d="M3 3z"/>',
        '<line x2="5"/>',
        '<path d="M0 0L5 5" />',
        '<path fill="none" d="M0 0L5 5L5 0"/>',
        '<rect width="3" height="3" transform="scale(0 1)"/>',
        "<text>room</text>",
        '<defs><rect width="1" height="1"/></defs>',
        '<symbol><rect width="1" height="1"/></symbol>',
        '<clipPath><rect width="1" height="1"/></clipPath>',
        '<rect xmlns="urn:other" width="1" height="1"/>',
        "<!-- a comment -->",
    ],
)
def test_what_is_no_area_is_left_out(element):
    assert outlines(element) == []


# Style


@pytest.mark.parametrize(
    "body",
    [
        '<rect width="1" height="1" display="none"/>',
        '<g style="display:none"><g><rect width="1" height="1"/></g></g>',
        '<rect width="1" height="1" visibility="hidden"/>',
        '<style>.off { display: none }</style><rect class="room off" width="1" height="1"/>',
        '<style>/* #r {} */ #r, circle {visibility:collapse}</style><rect id="r" width="1" height="1"/><circle r="1"/>',
    ],
)
def test_hidden_shapes_are_left_out(body):
    assert outlines(body) == []


@pytest.mark.parametrize(
    ("style", "area"),
    [
        ("", True),
        ('fill="none"', True),  # rules are stronger than attributes
        ('style="stroke:red;fill:none"', False),
        ('style="fill: none" fill="red"', False),
        ('style="fill:red" fill="none"', True),
        ('class="line"', False),
        ('class="line" style="fill:#fff"', True),
        ('id="it" class="line"', True),
    ],
)
def test_open_lines_are_areas_where_they_are_filled(style, area):
    sheet = "<style>.line{fill:none;stroke:#000} path{fill:blue} #it{fill:green} g path{fill:none}</style>"
    assert len(outlines(f'{sheet}<path {style} d="M0 0L5 0L5 5L0 5"/>')) == area
    assert len(outlines(f'{sheet}<g fill="none"><path fill="inherit" style="fill:inherit" d="M0 0L5 0L5 5"/></g>')) == 0


# Transforms


@pytest.mark.parametrize(
    ("transform", "corner"),
    [
        ("translate(3)", (4, 0)),
        ("translate(3, 4)", (4, 4)),
        ("scale(2)", (2, 0)),
        ("scale(2,3) translate(1 1)", (4, 3)),
        ("rotate(90)", (0, 1)),
        ("rotate(90 1 1)", (2, 1)),
        ("rotate(90,0,0) , translate(2)", (0, 3)),
        ("skewX(45)", (1, 0)),
        ("skewY(45)", (1, 1)),
        ("matrix(1 2 3 4 5 6)", (6, 8)),
        ("none", (1, 0)),
        ("", (1, 0)),
    ],
)
def test_transforms(transform, corner):
    body = f'<path transform="{transform}" d="M0 0L1 0L0 1z"/>'
    assert corner in places(only(body).points)


def test_transforms_nest():
    room = '<rect transform="scale(2 1)" width="1" height="1"/>'
    body = f'<g transform="translate(10)"><g transform="rotate(90)">{room}</g></g>'
    assert places(only(body).points) == {(10, 0), (10, 2), (9, 2), (9, 0)}


def test_uses():
    body = (
        '<defs><g id="bed"><rect id="mattress" width="2" height="1"/></g><symbol id="pot" viewBox="0 0 10 10">'
        '<circle cx="5" cy="5" r="5"/></symbol></defs>'
        '<use href="#bed" x="5" y="1"/><use xlink:href="#bed" transform="rotate(90)" data-label="bunk"/>'
        '<use href="#pot" x="20" y="0" width="2" height="2" id="palm"/>'
    )
    first, second, third = scene(body).polygons
    assert places(first.points) == {(5, 1), (7, 1), (7, 2), (5, 2)}
    assert places(second.points) == {(0, 0), (0, 2), (-1, 2), (-1, 0)}
    assert radii(third.points, (21, -1)) == pytest.approx(1, abs=1e-4)
    assert [p.label for p in (first, second, third)] == ["bed", "bed", "palm"]


def test_nested_drawings():
    body = '<svg x="10" y="20" width="40" height="20" viewBox="0 0 10 10"><rect width="10" height="10"/></svg>'
    assert places(only(body).points) == {(20, 20), (40, 20), (40, 40), (20, 40)}
    body = body.replace("viewBox", 'preserveAspectRatio="none" viewBox')
    assert places(only(body).points) == {(10, 20), (50, 20), (50, 40), (10, 40)}
    assert places(only('<svg x="3"><rect width="50%" height="1"/></svg>', 'viewBox="0 0 8 8"').points - (0, 8)) == {
        (3, 0),
        (7, 0),
        (7, 1),
        (3, 1),
    }


# Units and axes


@pytest.mark.parametrize(
    ("page", "bounds"),
    [
        ("", [0, -1, 1, 0]),
        ('height="10"', [0, 9, 1, 10]),
        ('viewBox="0 0 20 10"', [0, 9, 1, 10]),
        ('viewBox="-5 -5 20 10"', [5, 4, 6, 5]),
        ('width="40" viewBox="0 0 20 10"', [0, 18, 2, 20]),
        ('width="100%" height="100%" viewBox="0 0 20 10"', [0, 9, 1, 10]),
        ('width="20mm" height="10mm" viewBox="0 0 20 10"', [0, 0.009, 0.001, 0.01]),
        ('width="2cm" viewBox="0 0 20 10"', [0, 0.009, 0.001, 0.01]),
        ('width="20in" height="10in" viewBox="0 0 20 10"', [0, 9 * 0.0254, 0.0254, 0.254]),
        ('width="20pt" height="10pt" viewBox="0 0 20 10"', [0, 9 * 0.0254 / 72, 0.0254 / 72, 0.254 / 72]),
        ('width="96mm" height="96mm"', [0, 0.096 - 0.0254 / 96, 0.0254 / 96, 0.096]),
        ('width="40" height="40" viewBox="0 0 20 10"', [0, 18, 2, 20]),
        ('width="40" height="40" viewBox="0 0 20 10" preserveAspectRatio="none"', [0, 36, 2, 40]),
    ],
)
def test_units_and_origin_of_the_page(page, bounds):
    assert only('<rect width="1" height="1"/>', page).bounds == pytest.approx(bounds)


@pytest.mark.parametrize(
    ("width", "expected"),
    [
        ("5", 5),
        ("5px", 5),
        ("1in", 96),
        ("25.4mm", 96),
        ("2.54cm", 96),
        ("72pt", 96),
        ("6pc", 96),
        ("2em", 32),
        ("25%", 50),
    ],
)
def test_lengths(width, expected):
    room = only(f'<rect width="{width}" height="1"/>', 'viewBox="0 0 200 100"')
    assert room.bounds[2] == pytest.approx(expected)


def test_percentages_of_round_shapes_and_lines():
    page = 'viewBox="0 0 400 300"'
    assert only('<circle cx="50%" cy="50%" r="10%"/>', page).bounds == pytest.approx(
        [200 - 35.355, 150 - 35.355, 200 + 35.355, 150 + 35.355], abs=0.1
    )
    (line,) = svg.read_strokes(document('<line x1="25%" y1="0" x2="50%" y2="100%"/>', page), "plan.svg")
    assert line.tolist() == [[100, 300], [200, 0]]


# Labels


@pytest.mark.parametrize(
    ("body", "label"),
    [
        ('<rect data-label="bed" inkscape:label="b" class="c" id="d" {}/>', "bed"),
        ('<rect inkscape:label="bed" class="c" id="d" {}/>', "bed"),
        ('<rect inkscape:label="path123" class="bed" id="d" {}/>', "bed"),
        ('<g inkscape:label="furniture"><rect class="bed" {}/></g>', "bed"),
        ('<g inkscape:label="beds" id="layer1"><g id="g12"><rect id="rect7" class="cls-3" {}/></g></g>', "beds"),
        ('<g inkscape:groupmode="layer" inkscape:label="Layer 1" id="layer1"><rect id="bed" {}/></g>', "bed"),
        ('<g id="beds"><rect id="bed-2" {}/></g>', "beds"),
        ('<g data-label="beds"><g id="inner"><rect {}/></g></g>', "inner"),
        ('<rect id="bed_12_" {}/>', "bed"),
        ('<rect id="bed" {}/>', "bed"),
        ('<rect id="path-12" class="st0" {}/>', ""),
        ("<rect {}/>", ""),
    ],
)
def test_labels(body, label):
    assert only(body.format('width="1" height="1"')).label == label


@pytest.mark.parametrize(
    ("source", "label"),
    [
        ("class", "room big"),
        ("id", "r1"),
        ("inkscape:label", "Room"),
        ("layer", "plan"),
        ("data-use", "sleep"),
    ],
)
def test_label_from_a_stated_place(source, label):
    body = (
        '<g id="plan"><rect class="room big" id="r1" inkscape:label="Room" data-use="sleep" width="1" height="1"/></g>'
    )
    assert only(body, label=source).label == label


def test_ids_are_those_of_the_elements():
    body = '<rect id="r1" width="1" height="1"/><rect width="2" height="1"/><path id="p" d="M0 0h1v1z M5 5h1v1z"/>'
    assert [p.id for p in scene(body).polygons] == ["r1", "polygon 0", "p", "p.001"]


# Strokes


def test_strokes():
    body = (
        '<path d="M0 0L1 0L1 1z M5 5L6 6"/><line x1="1" y1="2" x2="3" y2="4"/><rect width="2" height="1"/>'
        '<polyline points="0,0 3,0 3,3" fill="none"/><g display="none"><line x2="9"/></g>'
    )
    strokes = svg.read_strokes(document(body, 'height="10"'), "plan.svg")
    assert [s.tolist() for s in strokes] == [
        [[0, 10], [1, 10], [1, 9], [0, 10]],
        [[5, 5], [6, 4]],
        [[1, 8], [3, 6]],
        [[0, 10], [2, 10], [2, 9], [0, 9], [0, 10]],
        [[0, 10], [3, 10], [3, 7]],
    ]


def test_closed_strokes_repeat_their_first_point():
    for element in (
        '<circle r="1"/>',
        '<ellipse rx="2" ry="1"/>',
        '<path d="M0 0Q1 1 2 0z"/>',
        '<rect rx="1" width="4" height="4"/>',
    ):
        (stroke,) = svg.read_strokes(document(element), "plan.svg")
        assert stroke[0] == pytest.approx(stroke[-1], abs=1e-12)
        assert (stroke[0] == stroke[-1]).all()


# What is refused


def test_an_attribute_that_no_shape_has_is_named():
    content = b'<svg xmlns="http://www.w3.org/2000/svg"><rect class="bed" width="5" height="4"/></svg>'
    assert [o.properties["label"] for o in svg.read(content, "plan.svg", "class")] == ["bed"]
    with pytest.raises(
        InputError, match=r"plan\.svg has no shape with the attribute 'clas' to take labels from; check"
    ):
        svg.read(content, "plan.svg", "clas")


def refused(content, message):
    with pytest.raises(InputError, match=message) as raised:
        make_scene("plan.svg", svg.read(content if isinstance(content, bytes) else document(content), "plan.svg"))
    assert str(raised.value).startswith("plan.svg")


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (document('<rect width="1" height="1"/>')[:-4], r"not valid XML \(.*\); it may be cut off, export it again"),
        (b"%PDF-1.4", "not valid XML"),
        (b'<?xml version="1.0" encoding="nonsense"?><svg/>', "not valid XML"),
        (b'<!DOCTYPE svg [<!ENTITY a "b">]><svg>&c;</svg>', "not valid XML"),
        (b"<html/>", "no SVG drawing, its outermost element is 'html'; export it as SVG"),
        (document("", 'width="-5"'), "the width '-5' of the page is negative; correct the size of the page"),
        (document("", 'width="wide"'), "'wide' is no length; correct the size of the page"),
        (document("", 'viewBox="0 0 0 5"'), "the viewBox '0 0 0 5' has no area"),
        (document("", 'viewBox="0 0 5"'), "the viewBox '0 0 5' has no area"),
        (document(""), "holds no closed shape"),
    ],
)
def test_files_that_are_refused(content, message):
    refused(content, message)


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ('<path id="a" d="L1 1"/>', "path 'a': it starts with 'L' instead of a move; correct or delete it"),
        ('<path d="M0 0 L1"/>', "path number 1: path command 'L' at character 5 has too few numbers"),
        ('<path d="M0 0 X1 1"/>', "'X1 1' at character 5 is no path command"),
        ('<path d="M0 0A1 1 0 2 0 3 3"/>', "path command 'A' at character 4 has too few numbers"),
        ('<path d="M0 0L1e999 0L1 1z"/>', "the number 1e999 is beyond all coordinates"),
        ('<path d="M0 0L1e14 0L1 1z"/>', r"more than 1e\+09 units from the origin"),
        ('<path d="M0 0L1 0L1 1z" transform="scale(1e12)"/>', r"more than 1e\+09 units"),
        ('<path id="a" d="M0 0L1 1L1 0L0 2z"/>', "path 'a': polygon 'a' crosses or touches itself near"),
        ('<path d="M0 0L1 1L2 2z"/>', "path number 1: a polygon labelled '' has no area"),
        (
            '<path fill="none" d="M0 0L10 0L10 10L0 10L0.2 0.2"/>',
            "the ring is open, its ends are 0.283 units apart; close it",
        ),
        ('<polygon points="0 0 1"/>', "polygon number 1: its points are 3 numbers, which are no pairs"),
        ('<polygon points="0 0 1 x"/>', "'0 0 1 x' is no list of numbers"),
        ('<rect width="-1" height="1"/>', "its width or height is negative"),
        ('<rect width="1furlong" height="1"/>', "'1furlong' is no length"),
        ('<circle r="-1"/>', "its radius is negative"),
        ('<g transform="spin(3)"/>', r"g number 2|'spin\(3\)' is no transform"),
        ('<g transform="rotate(3 4)"/>', r"'rotate\(3 4\)' is no transform"),
        ('<g transform="rotate"/>', "'rotate' is no transform"),
        ('<use href="#nothing"/>', "it refers to '#nothing', which the file does not hold"),
        ('<use href="http://other/file"/>', "it refers to 'http://other/file', which the file does not hold"),
        ('<g id="a"><use href="#a"/></g>', "symbols use each other in a circle; expand or delete the clones"),
    ],
)
def test_shapes_that_are_refused(body, message):
    refused(body, message)


def test_explosions_of_uses_are_refused(monkeypatch):
    monkeypatch.setattr(svg, "_MOST_ELEMENTS", 1000)
    levels = "".join(f'<g id="l{k}">' + f'<use href="#l{k + 1}"/>' * 10 + "</g>" for k in range(9))
    refused(
        f'{levels}<rect id="l9" width="1" height="1"/>', "draws more than 1000 elements; export less of the drawing"
    )


PIECES = """<path d="|"/>|M0 0|L1 1|A1 2 3 0 1 5 5|c1 2 3 4 5 6|z|Z|q|T|1e9|-.5|,|<g |transform="rotate(30)"|>|</g>|/>
|transform="scale(-1,1e-9)"|<use href="#a"/>| id="a"|<rect x="1"| width="1e308" height="5%"|<circle r="3"/>|&amp;|é|\0
|<polygon points="0 0 1 0 1 1"/>| fill="none"|<style>a{fill:none}|</style>| class="a b\""""


@given(st.lists(st.sampled_from(PIECES.split("|")), max_size=12))
def test_whatever_is_strung_together_is_read_or_refused(parts):
    _read_or_refuse(document("".join(parts)))


@given(st.lists(st.sampled_from(list("MmLlHhVvCcSsQqTtAaZz0123456789.-+eE ,")), max_size=40).map("".join))
def test_any_path_data_is_read_or_refused(data):
    _read_or_refuse(document(f'<path d="M0 0{data}"/>'))


@given(st.integers(0, 600), st.binary(max_size=5), st.integers(0, 5))
def test_any_damage_is_read_or_refused(place, inserted, removed):
    good = document(
        '<defs><g id="s"><circle r="2"/></g></defs><g transform="translate(3 4) rotate(30)" id="plan">'
        '<path class="room" d="M0 0C1 2 3 4 5 6S7 8 9 -1A3 4 30 0 1 0 0z"/><use href="#s" x="5"/>'
        '<rect width="3mm" height="50%" rx="1"/></g>',
        'width="20mm" height="10mm" viewBox="0 0 200 100"',
    )
    _read_or_refuse(good[:place] + inserted + good[place + removed :])


def _read_or_refuse(content):
    for read in (
        lambda: make_scene("plan.svg", svg.read(content, "plan.svg")),
        lambda: svg.read_strokes(content, "plan.svg"),
    ):
        try:
            read()
        except InputError as error:
            assert str(error).startswith("plan.svg")


def test_a_switch_shows_one_of_its_children():
    other = '<rect width="5" height="5" systemLanguage="de"/>'
    square = '<rect width="1" height="1"/>'
    assert places(only(f"<switch><title>x</title>{other}{square}<rect width='3' height='3'/></switch>").points) == UNIT
    assert only(f"<switch>{other}</switch>").area == pytest.approx(25)


def test_what_is_in_something_hidden_may_be_visible_but_not_in_something_gone():
    square = '<rect width="1" height="1" visibility="visible"/><rect width="2" height="2"/>'
    assert places(only(f'<g visibility="hidden">{square}</g>').points) == UNIT
    assert outlines(f'<g display="none">{square}</g>') == []


@pytest.mark.parametrize(
    ("aspect", "corners"),
    [
        ("none", (0, 0, 4, 2)),
        ("xMinYMin", (0, 0, 2, 2)),
        ("xMidYMid meet", (1, 0, 3, 2)),
        ("xMaxYMax", (2, 0, 4, 2)),
        ("defer xMinYMin slice", (0, 0, 4, 4)),
        ("xMidYMax slice", (0, -2, 4, 2)),
    ],
)
def test_a_nested_drawing_fits_its_place_as_it_says(aspect, corners):
    square = '<rect width="1" height="1"/>'
    nested = f'<svg width="4" height="2" viewBox="0 0 1 1" preserveAspectRatio="{aspect}">{square}</svg>'
    x0, y0, x1, y1 = corners
    assert places(only(nested).points) == {(x0, y0), (x1, y0), (x1, y1), (x0, y1)}


def test_units_are_written_in_letters_of_either_case():
    one, other = (only('<rect width="1" height="1"/>', f'width="10{unit}" viewBox="0 0 1 1"') for unit in ("mm", "MM"))
    assert one.area == other.area == pytest.approx(1e-4)


def test_names_that_programs_number_say_nothing():
    assert only('<g id="layer 1-2"><rect width="1" height="1"/></g>').label == ""
