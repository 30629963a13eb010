"""Drawings from SVG: paths and basic shapes, through all transforms, with y upwards."""

import re
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..geometry.polygon import signed_area
from ..tolerances import LARGEST_COORDINATE
from .curves import elliptic_arc, flatten, straight, transform
from .outlines import Outline, Points, is_closed, joined, with_holes
from .svg_paths import SubPath, parse_path
from .svg_styles import Style, StyleSheet
from .svg_units import Viewport, fit, length, matrix, numbers, page

Matrix = NDArray[np.float64]

#: Elements that a file may draw, each use of a symbol counted: uses of uses grow without bound.
_MOST_ELEMENTS = 200_000
#: Uses within uses.
_DEEPEST_USE = 32

_CONTAINERS = {"svg", "g", "a", "switch"}
_SHAPES = {"path", "rect", "circle", "ellipse", "polygon", "polyline", "line"}
_DRAWN = _CONTAINERS | _SHAPES | {"use"}
_CONDITIONS = ("requiredExtensions", "systemLanguage")
_SVG = "{http://www.w3.org/2000/svg}"
_INKSCAPE_LABEL = "{http://www.inkscape.org/namespaces/inkscape}label"
_LINKS = ("href", "{http://www.w3.org/1999/xlink}href")
#: Names that drawing programs make up: they say nothing.
_MADE_UP = re.compile(
    r"(svg|g|layer|path|rect|circle|ellipse|polygon|polyline|line|use|group|clone|image|cls|st|fil)?[-_ \d]*",
    re.IGNORECASE,
)
#: Ids are unique: programs number those that a designer repeats.
_NUMBER_AT_END = re.compile(r"[-_ .]\d+_?$")


@dataclass(frozen=True)
class _Context:
    """What a group hands down to its elements."""

    matrix: Matrix
    style: Style
    viewport: Viewport
    layer: str = ""
    uses: int = 0


@dataclass(frozen=True)
class _Shape:
    """A shape of the drawing: its strokes in scene coordinates, and whether each is closed by the file itself."""

    where: str
    tag: str
    attributes: Mapping[str, str]
    layer: str
    filled: bool
    strokes: list[tuple[Points, bool]]


@np.errstate(all="ignore")  # what overflows is refused as too far from the origin
def read(content: bytes, file: str, label: str | None = None) -> list[Outline]:
    """The closed shapes of an SVG drawing.

    A shape is an area where it is closed, or filled, or ends where it starts; other lines are left out, and so is what
    is hidden. Curves become edges as `geoanalogy.tolerances.CURVE_TURN` says. A path's inner rings are its holes. The
    page's lower left is the origin; `svg_units.page` says what the unit is.

    Parameters
    ----------
    content : bytes
    file : str
        The file's name, for messages.
    label : str, optional
        The attribute that holds the label ("class", "id", "inkscape:label", "data-room" …), or "layer" for the name
        of the group. By default the first of these that a shape has: ``data-label``, ``inkscape:label``, ``class``,
        the name of the nearest group, its own id without a number at the end. Names that drawing programs make up
        ("path123", "layer1", "cls-2") do not count.

    Returns
    -------
    list of Outline

    Raises
    ------
    InputError
        For text that is not SVG, malformed shapes, and rings that are nearly closed.
    """
    outlines = []
    for shape in _shapes(content, file):
        rings = [
            joined(points)
            for points, closed in shape.strokes
            if closed
            or (shape.filled and len(points) > 2 and signed_area(points))
            or is_closed(points, file, shape.where)
        ]
        if rings:
            properties = {"label": _label(shape.attributes, shape.layer, label), "id": shape.attributes.get("id")}
            outlines += [Outline(shape.where, parts, properties) for parts in with_holes(rings)]
    if label not in (None, "layer") and outlines and not any(o.properties["label"] for o in outlines):
        raise InputError(f"{file} has no shape with the attribute {label!r} to take labels from; check its name")
    return outlines


@np.errstate(all="ignore")
def read_strokes(content: bytes, file: str) -> list[Points]:
    """The lines of an SVG drawing; closed ones repeat their first point.

    Parameters
    ----------
    content : bytes
    file : str
        The file's name, for messages.

    Returns
    -------
    list of ndarray of shape (n, 2)
        In scene coordinates as `read` has them.

    Raises
    ------
    InputError
        For text that is not SVG and malformed shapes.
    """
    strokes = []
    for shape in _shapes(content, file):
        for points, closed in shape.strokes:
            ends_apart = closed and (points[0] != points[-1]).any()
            strokes.append(np.vstack([points, points[:1]]) if ends_apart else points)
    return strokes


def _shapes(content: bytes, file: str) -> Iterator[_Shape]:
    """The visible shapes of a file in drawing order."""
    try:
        root = ElementTree.fromstring(content)
    except (ElementTree.ParseError, ValueError, LookupError) as error:
        raise InputError(f"{file} is not valid XML ({error}); it may be cut off, export it again") from None
    if _tag(root) != "svg":
        raise InputError(f"{file} is no SVG drawing, its outermost element is {_tag(root)[:30]!r}; export it as SVG")
    by_id = {e.attrib["id"]: e for e in reversed(list(root.iter())) if "id" in e.attrib}
    sheet = StyleSheet("".join(e.itertext()) for e in root.iter() if _tag(e) == "style")
    try:
        to_scene, viewport = page(root.attrib)
    except ValueError as error:
        raise InputError(f"{file}: {error}; correct the size of the page") from None
    waiting = [(root, _Context(to_scene, Style(), viewport))]
    drawn: Counter[str] = Counter()
    while waiting:
        element, context = waiting.pop()
        tag, attributes = _tag(element), element.attrib
        drawn[tag] += 1
        if drawn.total() > _MOST_ELEMENTS:
            raise InputError(f"{file} draws more than {_MOST_ELEMENTS} elements; export less of the drawing")
        where = f"{tag} {attributes['id']!r}" if "id" in attributes else f"{tag} number {drawn[tag]}"
        style = sheet.style(tag, attributes, context.style)
        if style.gone or (style.hidden and tag in _SHAPES) or tag not in _DRAWN:
            continue
        try:
            own = matrix(attributes.get("transform"))
            if tag in _SHAPES:
                strokes = _strokes(tag, attributes, context.viewport)
                yield from _shape(file, where, tag, attributes, context, style, context.matrix @ own, strokes)
                continue
            if tag == "use":
                children, inner = _used(attributes, by_id, context, where, file)
            else:
                children = _chosen(element) if tag == "switch" else list(element)
                nested = tag == "svg" and element is not root
                inner = fit(attributes, context.viewport) if nested else (np.eye(3), context.viewport)
        except ValueError as error:
            if isinstance(error, InputError):
                raise
            raise InputError(f"{file}, {where}: {error}; correct or delete it") from None
        step, viewport = inner
        layer = _group_name(attributes) or context.layer
        handed = _Context(context.matrix @ own @ step, style, viewport, layer, context.uses + (tag == "use"))
        waiting += [(child, handed) for child in reversed(children)]


def _shape(
    file: str,
    where: str,
    tag: str,
    attributes: Mapping[str, str],
    context: _Context,
    style: Style,
    to_scene: Matrix,
    strokes: list[SubPath],
) -> Iterator[_Shape]:
    """The shape in scene coordinates; nothing where it is flattened to a line or a point."""
    placed = []
    for stroke in strokes:
        run = transform(stroke.run, to_scene[:2])
        if not np.abs(run).max() <= LARGEST_COORDINATE:
            raise InputError(
                f"{file}, {where}: it lies more than {LARGEST_COORDINATE:g} units from the origin; move it near it"
            )
        if np.ptp(run.reshape(-1, 2), axis=0).any():
            placed.append((flatten(run), stroke.closed))
    if placed and np.linalg.det(to_scene[:2, :2]) != 0:
        yield _Shape(where, tag, attributes, context.layer, style.filled, placed)


def _used(
    attributes: Mapping[str, str],
    by_id: Mapping[str, ElementTree.Element],
    context: _Context,
    where: str,
    file: str,
) -> tuple[list[ElementTree.Element], tuple[Matrix, Viewport]]:
    """What a use element draws, and where."""
    link = next((attributes[name] for name in _LINKS if name in attributes), "")
    target = by_id.get(link.removeprefix("#")) if link.startswith("#") else None
    if target is None:
        raise ValueError(f"it refers to {link[:40]!r}, which the file does not hold")
    if context.uses >= _DEEPEST_USE:
        raise InputError(f"{file}, {where}: symbols use each other in a circle; expand or delete the clones")
    place = np.eye(3)
    place[:2, 2] = [
        length(attributes.get("x"), context.viewport.width),
        length(attributes.get("y"), context.viewport.height),
    ]
    if _tag(target) != "symbol":
        return [target], (place, context.viewport)
    size = {name: attributes[name] for name in ("width", "height") if name in attributes}
    step, viewport = fit({**target.attrib, **size, "x": "0", "y": "0"}, context.viewport)
    return list(target), (place @ step, viewport)


def _chosen(switch: ElementTree.Element) -> list[ElementTree.Element]:
    """The one child that a switch shows: the first that asks for nothing, else the first of all."""
    drawn = [child for child in switch if _tag(child) in _DRAWN]
    free = [child for child in drawn if not any(name in child.attrib for name in _CONDITIONS)]
    return (free or drawn)[:1]


def _strokes(tag: str, attributes: Mapping[str, str], viewport: Viewport) -> list[SubPath]:
    """The strokes of a shape in its own user units."""

    def get(name: str, reference: float) -> float:
        return length(attributes.get(name), reference)

    if tag == "path":
        return parse_path(attributes.get("d", ""))
    if tag in ("polygon", "polyline"):
        values = numbers(attributes.get("points", ""))
        if len(values) % 2:
            raise ValueError(f"its points are {len(values)} numbers, which are no pairs")
        if len(values) < 4:
            return []
        points = values.reshape(-1, 2)
        return [SubPath(straight(np.vstack([points, points[:1]]) if tag == "polygon" else points), tag == "polygon")]
    if tag == "line":
        ends = [[get(f"x{k}", viewport.width), get(f"y{k}", viewport.height)] for k in (1, 2)]
        return [SubPath(straight(ends), False)]
    if tag == "rect":
        return _rectangle(attributes, viewport)
    centre = [get("cx", viewport.width), get("cy", viewport.height)]
    if tag == "circle":
        radii = [get("r", viewport.diagonal)] * 2
    else:
        radii = [get("rx", viewport.width), get("ry", viewport.height)]
    if min(radii) < 0:
        raise ValueError("its radius is negative")
    return [SubPath(elliptic_arc(centre, (radii[0], 0.0), (0.0, radii[1]), 0.0, 2 * np.pi), True)] if all(radii) else []


def _rectangle(attributes: Mapping[str, str], viewport: Viewport) -> list[SubPath]:
    x, width = (length(attributes.get(name), viewport.width) for name in ("x", "width"))
    y, height = (length(attributes.get(name), viewport.height) for name in ("y", "height"))
    if width < 0 or height < 0:
        raise ValueError("its width or height is negative")
    if not width or not height:
        return []
    given = [attributes.get(name) for name in ("rx", "ry")]
    rx, ry = (length(own or other, size) for own, other, size in zip(given, given[::-1], (width, height), strict=True))
    rx, ry = min(max(rx, 0.0), width / 2), min(max(ry, 0.0), height / 2)
    if not rx or not ry:
        return [SubPath(straight([(x, y), (x + width, y), (x + width, y + height), (x, y + height), (x, y)]), True)]
    arcs = [
        elliptic_arc((cx, cy), (rx, 0.0), (0.0, ry), quarter * np.pi / 2, (quarter + 1) * np.pi / 2)
        for quarter, (cx, cy) in enumerate(
            [
                (x + width - rx, y + height - ry),
                (x + rx, y + height - ry),
                (x + rx, y + ry),
                (x + width - rx, y + ry),
            ]
        )
    ]
    sides = [straight([a[-1, 3], b[0, 0]]) for a, b in zip(arcs, arcs[1:] + arcs[:1], strict=True)]
    return [SubPath(np.concatenate([piece for pair in zip(arcs, sides, strict=True) for piece in pair]), True)]


def _tag(element: ElementTree.Element) -> str:
    """The name of an SVG element; of another one with its namespace."""
    return element.tag.removeprefix(_SVG) if isinstance(element.tag, str) else ""


def _said(name: str | None) -> str:
    return "" if name is None or _MADE_UP.fullmatch(name.strip()) else name.strip()


def _group_name(attributes: Mapping[str, str]) -> str:
    return attributes.get("data-label", "") or _said(attributes.get(_INKSCAPE_LABEL)) or _said(attributes.get("id"))


def _label(attributes: Mapping[str, str], layer: str, wanted: str | None) -> str:
    if wanted == "layer":
        return layer
    if wanted is not None:
        return attributes.get(_INKSCAPE_LABEL if wanted == "inkscape:label" else wanted, "")
    return (
        attributes.get("data-label", "")
        or _said(attributes.get(_INKSCAPE_LABEL))
        or _said(attributes.get("class"))
        or layer
        or _said(_NUMBER_AT_END.sub("", attributes.get("id", "")))
    )
