"""Plans from ASCII DXF: polylines, circles, ellipses, splines, and lines that close to rings, through all blocks."""

import itertools
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray
from scipy.interpolate import BSpline
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from ..errors import InputError
from ..tolerances import JOINED_ENDS, LARGEST_COORDINATE
from .curves import Run, bulge_arc, elliptic_arc, flatten, straight, transform
from .dxf_tags import Drawing, Entity, as_number, parse
from .outlines import Outline, Points, is_closed, joined

Matrix = NDArray[np.float64]

#: Metres per unit, by the codes of $INSUNITS; 0 says nothing.
_METRES = {
    1: 0.0254,
    2: 0.3048,
    3: 1609.344,
    4: 1e-3,
    5: 1e-2,
    6: 1.0,
    7: 1e3,
    8: 2.54e-8,
    9: 2.54e-5,
    10: 0.9144,
    13: 1e-6,
    14: 0.1,
    15: 10.0,
    16: 100.0,
    21: 1200 / 3937,
}
#: Entities that a file may draw, each copy of a block counted: blocks of blocks grow without bound.
_MOST_ENTITIES = 500_000
#: Blocks within blocks.
_DEEPEST_BLOCK = 32
#: Cubics per span of a spline; of one that is cubic itself each is exact.
_SPAN_PARTS = 4
_INSIDE = 1e-9
#: Radians by which an ellipse may miss a full turn and is closed all the same: files write as few as six digits.
_FULL_TURN = 1e-4


@dataclass(frozen=True)
class _Place:
    """What an insertion hands down to the entities of its block."""

    matrix: Matrix
    layer: str = ""
    block: str = ""
    handle: str = ""
    depth: int = 0


@dataclass(frozen=True)
class _Stroke:
    """A line of the drawing in scene coordinates."""

    where: str
    points: Points
    closed: bool
    label: str
    id: str | None


def read(content: bytes, file: str, label: str | None = None) -> list[Outline]:
    """The closed shapes of a DXF drawing, in metres where the drawing states its unit ($INSUNITS).

    Closed polylines, circles, closed ellipses and splines are areas; lines, arcs and open polylines of one label are
    joined where their ends meet, and each face they enclose is an area. Other lines are left out, and so are layers
    that are off or frozen, and paper space.

    Parameters
    ----------
    content : bytes
    file : str
        The file's name, for messages.
    label : str, optional
        "layer" (the default), or "block": the name of the outermost block, the layer where there is none.

    Returns
    -------
    list of Outline

    Raises
    ------
    InputError
        For binary, truncated or malformed files, and rings that are nearly closed.
    """
    if label not in (None, "layer", "block"):
        raise InputError(f"{file} has no attribute {label!r} to take labels from; a DXF has 'layer' and 'block'")
    drawing = parse(content, file)
    outlines, open_strokes = [], []
    with np.errstate(all="ignore"):  # what overflows is refused as too far from the origin
        for stroke in _strokes(drawing, file, label == "block"):
            if stroke.closed or is_closed(stroke.points, file, stroke.where):
                properties = {"label": stroke.label, "id": stroke.id}
                outlines.append(Outline(stroke.where, [joined(stroke.points)], properties))
            else:
                open_strokes.append(stroke)
        for name in dict.fromkeys(s.label for s in open_strokes):
            outlines += _joined_lines([s.points for s in open_strokes if s.label == name], name, file)
    return outlines


def _strokes(drawing: Drawing, file: str, by_block: bool) -> Iterator[_Stroke]:
    """The visible strokes in the order of the file, blocks expanded."""
    scale = _METRES.get(_integer(drawing.header.get("$INSUNITS", "0")), 1.0)
    waiting = [
        (entity, _Place(np.array([[scale, 0.0, 0.0], [0.0, scale, 0.0]]))) for entity in reversed(drawing.entities)
    ]
    drawn = 0
    while waiting:
        entity, place = waiting.pop()
        drawn += 1
        if drawn > _MOST_ENTITIES:
            raise InputError(f"{file} draws more than {_MOST_ENTITIES} entities; export less of the drawing")
        layer = place.layer if entity.layer == "0" and place.layer else entity.layer
        handle = "-".join(filter(None, (place.handle, entity.text(5).strip())))
        where = f"{entity.kind} {handle or f'number {drawn}'} on layer {layer!r}"
        if (
            layer.casefold() in drawing.hidden_layers
            or entity.text(67).strip() == "1"
            or entity.text(60).strip() == "1"
        ):
            continue
        try:
            if entity.kind == "INSERT":
                waiting += reversed(_inserted(entity, drawing, place, layer, handle))
                continue
            if entity.kind not in _READERS:
                continue
            run, closed = _READERS[entity.kind](entity)
        except (ValueError, OverflowError) as error:
            if isinstance(error, InputError):
                raise InputError(f"{file}, {where}: {error}") from None
            raise InputError(f"{file}, {where}: {error}; correct or delete it") from None
        if not len(run):
            continue
        run = transform(run, place.matrix)
        if not np.abs(run).max() <= LARGEST_COORDINATE:
            raise InputError(
                f"{file}, {where}: it lies more than {LARGEST_COORDINATE:g} units from the origin, or has a coordinate "
                "that is no number; move it near the origin"
            )
        points = flatten(run)
        label = place.block if by_block and place.block else layer
        yield _Stroke(where, points, closed, label, handle or None)


def _inserted(entity: Entity, drawing: Drawing, place: _Place, layer: str, handle: str) -> list[tuple[Entity, _Place]]:
    """The entities of an inserted block, each with its place; rows and columns repeat the block."""
    name = entity.text(2)
    if name.casefold() not in drawing.blocks:
        raise ValueError(f"it inserts the block {name!r}, which the file does not hold")
    if place.depth >= _DEEPEST_BLOCK:
        raise InputError(f"the block {name!r} inserts itself; explode it")
    block, entities = drawing.blocks[name.casefold()]
    name = block.text(2)
    angle = np.radians(entity.number(50))
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    linear = turn * [entity.number(41, 1.0), entity.number(42, 1.0)]
    base = np.array([block.number(10), block.number(20)])
    columns, rows = (max(1, int(entity.number(code, 1.0))) for code in (70, 71))
    if columns * rows > _MOST_ENTITIES:
        raise ValueError(f"it repeats its block {columns} by {rows} times")
    outer = place.block or ("" if name.startswith("*") else name)
    result = []
    for row in range(rows):
        for column in range(columns):
            step = turn @ [column * entity.number(44), row * entity.number(45)]
            shift = np.array([entity.number(10), entity.number(20)]) + step - linear @ base
            local = _facing(entity) @ np.column_stack([linear, shift])
            matrix = place.matrix[:, :2] @ local
            matrix[:, 2] += place.matrix[:, 2]
            inner = _Place(matrix, layer, outer, handle, place.depth + 1)
            result += [(child, inner) for child in entities]
    return result


def _facing(entity: Entity) -> Matrix:
    """The map from the entity's own plane: seen from behind, x runs the other way."""
    return np.diag([-1.0 if entity.number(230, 1.0) < 0 else 1.0, 1.0])


def _own_plane(entity: Entity, run: Run) -> Run:
    return run @ _facing(entity)


def _light_polyline(entity: Entity) -> tuple[Run, bool]:
    vertices: list[list[float]] = []
    for code, value in entity.tags:
        if code == 10:
            vertices.append([as_number(value), 0.0, 0.0])
        elif code in (20, 42) and vertices:
            vertices[-1][1 if code == 20 else 2] = as_number(value)
    return _bulged(entity, np.array(vertices).reshape(-1, 3))


def _polyline(entity: Entity) -> tuple[Run, bool]:
    flags = int(entity.number(70))
    if flags & (16 | 64):  # meshes
        return straight(np.zeros((0, 2))), False
    drawn = [v for v in entity.vertices if not int(v.number(70)) & 16]  # not the frame of a spline
    return _bulged(entity, np.array([[v.number(10), v.number(20), v.number(42)] for v in drawn]).reshape(-1, 3))


def _bulged(entity: Entity, vertices: NDArray[np.float64]) -> tuple[Run, bool]:
    closed = bool(int(entity.number(70)) & 1)
    if closed:
        vertices = np.vstack([vertices, vertices[:1]])
    points, bulges = vertices[:, :2], vertices[:-1, 2]
    if not bulges.any():
        return _own_plane(entity, straight(points)), closed
    runs = [bulge_arc(a, b, bulge) for a, b, bulge in zip(points, points[1:], bulges, strict=False)]
    return _own_plane(entity, np.concatenate(runs)), closed


def _line(entity: Entity) -> tuple[Run, bool]:
    return straight([[entity.number(10), entity.number(20)], [entity.number(11), entity.number(21)]]), False


def _circle(entity: Entity) -> tuple[Run, bool]:
    return _own_plane(entity, _round(entity, 0.0, 2 * np.pi)), True


def _arc(entity: Entity) -> tuple[Run, bool]:
    start, end = np.radians(entity.number(50)), np.radians(entity.number(51))
    return _own_plane(entity, _round(entity, start, start + ((end - start) % (2 * np.pi) or 2 * np.pi))), False


def _round(entity: Entity, start: float, end: float) -> Run:
    radius = entity.number(40)
    if not radius > 0:
        raise ValueError(f"its radius is {radius:g}")
    return elliptic_arc([entity.number(10), entity.number(20)], (radius, 0.0), (0.0, radius), start, end)


def _ellipse(entity: Entity) -> tuple[Run, bool]:
    major = np.array([entity.number(11), entity.number(21)])
    ratio = entity.number(40, 1.0)
    if not major.any() or not ratio:
        raise ValueError("its axes have no length")
    minor = np.array([-major[1], major[0]]) * ratio * (-1 if entity.number(230, 1.0) < 0 else 1)
    start, end = entity.number(41), entity.number(42, 2 * np.pi)
    sweep = (end - start) % (2 * np.pi)
    closed = min(sweep, 2 * np.pi - sweep) < _FULL_TURN
    centre = [entity.number(10), entity.number(20)]
    return elliptic_arc(centre, major, minor, start, start + (2 * np.pi if closed else sweep)), closed


def _spline(entity: Entity) -> tuple[Run, bool]:
    closed = bool(int(entity.number(70)) & 1)
    control = np.array([entity.numbers(10), entity.numbers(20)]).T
    if not len(control):
        points = np.array([entity.numbers(11), entity.numbers(21)]).T
        return straight(np.vstack([points, points[:1]]) if closed else points), closed
    degree = int(entity.number(71, 3))
    knots = np.array(entity.numbers(40))
    weights = np.array(entity.numbers(41) or [1.0] * len(control))
    sound = np.isfinite(knots).all() and np.isfinite(control).all() and (np.diff(knots) >= 0).all()
    if (
        not 1 <= degree < len(control)
        or len(knots) != len(control) + degree + 1
        or not sound
        or len(weights) != len(control)
    ):
        raise ValueError(f"its {len(control)} control points, {len(knots)} knots and degree {degree} make no spline")
    spans = np.unique(knots[degree : len(control) + 1])
    if len(spans) < 2:
        raise ValueError("its knots are all the same")
    ends = np.concatenate([np.linspace(a, b, _SPAN_PARTS + 1) for a, b in itertools.pairwise(spans)])
    t = ends.reshape(-1, _SPAN_PARTS + 1)
    start, step = t[:, :-1].ravel(), np.diff(t, axis=1).ravel()
    curve = BSpline(knots, np.column_stack([control * weights[:, None], weights]), degree)
    # A little inside of each part: at a repeated knot the curve may have two directions.
    first, first_way = _on_curve(curve, start + step * _INSIDE)
    last, last_way = _on_curve(curve, start + step * (1 - _INSIDE))
    step = step[:, None] / 3
    return np.stack([first, first + first_way * step, last - last_way * step, last], axis=1), closed


def _on_curve(curve: BSpline, t: NDArray[np.float64]) -> tuple[Points, Points]:
    """Points and derivatives of a rational curve that is given in homogeneous coordinates."""
    place, way = curve(t), curve(t, 1)
    point = place[:, :2] / place[:, 2:]
    return point, (way[:, :2] - point * way[:, 2:]) / place[:, 2:]


_READERS = {
    "LWPOLYLINE": _light_polyline,
    "POLYLINE": _polyline,
    "LINE": _line,
    "CIRCLE": _circle,
    "ARC": _arc,
    "ELLIPSE": _ellipse,
    "SPLINE": _spline,
}


def _integer(text: str) -> int:
    return int(text) if text.strip().lstrip("-").isdigit() else 0


def _joined_lines(lines: list[Points], label: str, file: str) -> list[Outline]:
    """The faces that lines enclose where their ends meet."""
    where = f"the lines on layer {label!r}"
    lines = [line for line in lines if np.ptp(line, axis=0).any()]
    if not lines:
        return []
    ends = np.array([[line[0], line[-1]] for line in lines]).reshape(-1, 2)
    extent = float(np.ptp(np.concatenate(lines), axis=0).max())
    near = cKDTree(ends).query_pairs(JOINED_ENDS * extent, output_type="ndarray")
    links = coo_matrix((np.ones(len(near)), near.T), shape=(len(ends), len(ends)))
    _, nodes = connected_components(links, directed=False)
    _, first = np.unique(nodes, return_index=True)
    snapped = ends[first[nodes]].reshape(-1, 2, 2)
    drawn: dict[bytes, Points] = {}
    for line, (start, end) in zip(lines, snapped, strict=True):
        line = np.vstack([start, line[1:-1], end])
        forwards, backwards = line.tobytes(), line[::-1].tobytes()
        if backwards not in drawn and np.ptp(line, axis=0).any():
            drawn[forwards] = line  # a line drawn twice would enclose nothing
    faces, _, dangles, crossing = shapely.polygonize_full([shapely.LineString(line) for line in drawn.values()])
    loose = shapely.multilinestrings(shapely.get_parts(dangles))
    for chain in shapely.get_parts(shapely.line_merge(loose)):
        is_closed(shapely.get_coordinates(chain), file, where)
    # What stands inside a ring is its content, no hole. Rings that cross themselves are for `Polygon` to refuse.
    rings = [shapely.get_coordinates(face.exterior)[:-1] for face in shapely.get_parts(faces)]
    rings += [shapely.get_coordinates(ring)[:-1] for ring in shapely.get_parts(crossing)]
    # In the order of place, since polygonize promises none.
    rings.sort(key=lambda ring: (*ring.min(axis=0), *ring.max(axis=0)))
    return [Outline(where, [ring], {"label": label}) for ring in rings]
