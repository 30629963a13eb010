"""Queries: the region or the stroke of a drawing that is looked for elsewhere, as a curve that stays editable."""

from collections.abc import Sequence
from dataclasses import dataclass

import bpy
import numpy as np
import shapely
from mathutils import Matrix
from numpy.typing import ArrayLike, NDArray

from ...errors import InputError
from .. import names
from ..holders import ensure_holder
from ..reading.planes import Plane, extent
from ..writing.selection import select_only
from .drawings import LINES, line_curve, lines_of, read_drawn_lines

Array = NDArray[np.float64]

#: The collection that queries are put into.
QUERIES = "Queries"

#: Distance between the ends of a line, as a share of its length, below which it is a ring: a lasso is rarely closed.
NEARLY_RING = 0.02

#: Colours of queries and of what is found.
QUERY_COLOUR, TARGET_COLOUR = (0.1, 0.6, 0.2, 1.0), (0.85, 0.15, 0.1, 1.0)

#: Radius of their lines, in sizes of the drawing: they lie among lines that are black, as all wires are.
MARKED = 0.0012

#: Share of the area of what was drawn that one piece must have for the rest to be slips of the hand.
MAIN_PIECE = 0.9

#: Corners of a quarter circle in the outline of a brush.
BRUSH_CORNERS = 6


@dataclass(frozen=True)
class ReadQuery:
    """A query on the plane of its drawing.

    Attributes
    ----------
    points : ndarray of shape (n, 2)
    closed : bool
        Whether it is a region; else a stroke.
    """

    points: Array
    closed: bool

    @property
    def kind(self) -> str:
        """What `RegionOptions.query_kind` calls it."""
        return "region" if self.closed else "stroke"


def read_query(item: bpy.types.Object | None, plane: Plane) -> ReadQuery:
    """Read a query.

    Parameters
    ----------
    item : bpy.types.Object or None
        A curve or a grease pencil of one line; it is taken to the plane.
    plane : Plane

    Returns
    -------
    ReadQuery

    Raises
    ------
    InputError
        Where there is none, or not one line.
    """
    if item is None:
        raise InputError("there is no query; outline the region to look for with the lasso or the brush")
    if item.type not in LINES:
        raise InputError(f"object {item.name!r} is no line; select a curve or a stroke round the region")
    lines = lines_of(item)
    if len(lines) != 1:
        raise InputError(f"object {item.name!r} has {len(lines)} lines; a query is a single one")
    points = plane.to_plane(lines[0])[:, :2]
    length = float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())
    closed = len(points) > 3 and float(np.linalg.norm(points[-1] - points[0])) <= NEARLY_RING * length
    return ReadQuery(points, closed)


def add_query(
    context: bpy.types.Context, strokes: Sequence[ArrayLike], closed: bool, radius: float = 0.0, name: str = ""
) -> bpy.types.Object:
    """Make a query of points that were drawn, and choose it.

    Parameters
    ----------
    context : bpy.types.Context
    strokes : sequence of array_like of shape (n, 3)
        In the world; they are taken to the plane of the drawing. Several only of a brush.
    closed : bool
        Whether the line goes round a region; else it is a stroke along a thin shape.
    radius : float
        Of a brush: the region that it has passed over, scene units; 0: no brush.
    name : str
        Empty: "query".

    Returns
    -------
    bpy.types.Object
        A curve in the collection of queries, selected and active.

    Raises
    ------
    InputError
        Where there are too few points, some that are not finite, or regions apart from each other; then none is made.
    """
    given = [np.asarray(stroke, float).reshape(-1, 3) for stroke in strokes if len(stroke)]
    if not all(np.isfinite(stroke).all() for stroke in given) or not np.isfinite(radius):
        raise InputError("the query has a point that is not finite (NaN or infinity); draw it again")
    drawn = read_drawn_lines(context)
    parts = [drawn.plane.to_plane(stroke)[:, :2] for stroke in given]
    if radius > 0.0 and parts:
        pieces, closed = brushed(parts, radius), True
        flat = pieces[0]
        if not _is_main(flat, pieces):
            raise InputError(
                f"the brush has painted {len(pieces)} regions apart from each other; paint one, in one piece"
            )
    else:
        flat = parts[0] if len(parts) == 1 else np.zeros((0, 2))
    if len(flat) < (3 if closed else 2) or extent(flat) == 0.0:
        raise InputError("the query has no extent; drag round the region, or along the shape")
    flat = untangled(flat) if closed else flat
    ring = np.vstack([flat, flat[:1]]) if closed and np.any(flat[0] != flat[-1]) else flat
    middle = ring.mean(axis=0)
    curve = line_curve("query", [np.column_stack([ring - middle, np.zeros(len(ring))])])
    mark(curve, QUERY_COLOUR, MARKED * drawn.size)
    item = bpy.data.objects.new(name.strip() or "query", curve)
    frame = drawn.plane.matrix.copy()
    frame[:3, 3] = drawn.plane.to_world([(*middle, 0.0)])[0]
    item.matrix_world = Matrix(frame.tolist())
    ensure_holder(context.scene.collection, QUERIES).objects.link(item)
    choose_query(context, item, closed)
    select_only([item])
    return item


def use_as_query(context: bpy.types.Context, item: bpy.types.Object | None) -> bool:
    """Take a stroke or a curve that is there already as the query.

    Parameters
    ----------
    context : bpy.types.Context
    item : bpy.types.Object or None

    Returns
    -------
    bool
        Whether it is a region.

    Raises
    ------
    InputError
        Where it is no single line, or nothing else is drawn.
    """
    if item is None:
        raise InputError("nothing is selected; select the curve or the stroke that goes round the region")
    if names.KEY in item:
        raise InputError(f"object {item.name!r} is a result; select a line of your own")
    known = item.get(names.QUERY)
    # It must not count as a line of the drawing whose plane it is read on.
    item[names.QUERY] = known or "region"
    try:
        closed = read_query(item, read_drawn_lines(context).plane).closed
    except InputError:
        if known is None:
            del item[names.QUERY]
        raise
    choose_query(context, item, closed)
    return closed


def choose_query(context: bpy.types.Context, item: bpy.types.Object, closed: bool) -> None:
    """Make an object the query of its scene.

    Parameters
    ----------
    context : bpy.types.Context
    item : bpy.types.Object
    closed : bool
        Whether it is a region.
    """
    item[names.QUERY] = "region" if closed else "stroke"
    item.hide_render = True
    item.show_in_front = True
    item.color = QUERY_COLOUR
    context.scene.geoanalogy.query = item


def mark(curve: bpy.types.Curve, colour: tuple[float, float, float, float], radius: float) -> None:
    """Let a curve be seen as a coloured line.

    Parameters
    ----------
    curve : bpy.types.Curve
    colour : (r, g, b, a)
    radius : float
        Of the line, scene units.
    """
    curve.bevel_depth = radius
    curve.bevel_resolution = 0
    name = "Query" if colour == QUERY_COLOUR else "Similar Region"
    known = next((m for m in bpy.data.materials if m.get(names.QUERY) == name), None)
    if known is None:
        known = bpy.data.materials.new(name)
        known[names.QUERY] = name
        known.diffuse_color = colour
        if known.node_tree is None:  # Blender before 5.0
            known.use_nodes = True
        surface = next(node for node in known.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
        surface.inputs["Base Color"].default_value = colour
    curve.materials.append(known)


def untangled(ring: Array) -> Array:
    """A ring without the loops that a hasty hand leaves where a lasso begins and ends.

    Parameters
    ----------
    ring : ndarray of shape (n, 2)

    Returns
    -------
    ndarray of shape (m, 2)
        The ring itself where it does not cross itself, and where no piece of it is by far the largest.
    """
    if shapely.is_valid(shapely.polygons(ring)):
        return ring
    crossed = shapely.union_all(shapely.linestrings(np.vstack([ring, ring[:1]])))
    faces = shapely.get_parts(shapely.polygonize(shapely.get_parts(crossed)))
    # A face that the lasso goes round twice belongs to the region as well.
    inside = [face for face in faces if _turns(ring, shapely.get_coordinates(face.representative_point())[0])]
    pieces = [shapely.get_coordinates(p.exterior)[:-1] for p in shapely.get_parts(shapely.union_all(inside))]
    pieces = sorted(pieces, key=lambda piece: -shapely.polygons(piece).area)
    return pieces[0] if pieces and _is_main(pieces[0], pieces) else ring


def _turns(ring: Array, point: Array) -> int:
    """How often a ring goes round a point."""
    away = (ring - point) @ (1.0, 1.0j)
    return round(float(np.angle(np.roll(away, -1) / away).sum()) / (2.0 * np.pi))


def _is_main(piece: Array, pieces: Sequence[Array]) -> bool:
    """Whether the others are so small that they were not meant."""
    return shapely.polygons(piece).area >= MAIN_PIECE * sum(shapely.polygons(one).area for one in pieces)


def brushed(strokes: Sequence[Array], radius: float) -> list[Array]:
    """The outlines of what a round brush has passed over.

    Parameters
    ----------
    strokes : sequence of ndarray of shape (n, 2)
    radius : float

    Returns
    -------
    list of ndarray of shape (m, 2)
        Of every part, the largest first, without holes; the last point is not repeated.
    """
    paths = [shapely.linestrings(stroke) if len(stroke) > 1 else shapely.points(stroke[0]) for stroke in strokes]
    swept = shapely.union_all([path.buffer(radius, quad_segs=BRUSH_CORNERS) for path in paths])
    outlines = [shapely.polygons(shapely.get_exterior_ring(part)) for part in shapely.get_parts(swept)]
    largest_first = sorted(outlines, key=lambda outline: -outline.area)
    return [shapely.get_coordinates(outline.exterior.simplify(0.05 * radius))[:-1] for outline in largest_first]
