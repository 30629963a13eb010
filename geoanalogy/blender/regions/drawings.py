"""Drawings in Blender: grease-pencil strokes, curves and outlines of meshes as lines on one plane of any direction."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import bpy
import numpy as np
from numpy.typing import NDArray

from ...errors import InputError
from ...tolerances import LARGEST_COORDINATE
from .. import names
from ..reading.curves import curve_lines, stroke_lines
from ..reading.planes import FLAT, PARALLEL, Plane, extent
from ..reading.whereabouts import up_to_date

Array = NDArray[np.float64]

#: Types of objects that draw lines.
LINES = ("GREASEPENCIL", "CURVE")


@dataclass(frozen=True)
class DrawnLines:
    """The lines of a drawing on its plane.

    Attributes
    ----------
    plane : Plane
    lines : list of ndarray of shape (n, 2)
        Plane coordinates; a closed line repeats its first point.
    size : float
        Diagonal of the box around the drawing, scene units.
    smoothing : float
        How much its lines are smoothed before they are matched, scene units along them.
    """

    plane: Plane
    lines: list[Array]
    size: float
    smoothing: float = 0.0


def drawing_objects(context: bpy.types.Context) -> list[bpy.types.Object]:
    """The objects that make up the drawing of a scene.

    Parameters
    ----------
    context : bpy.types.Context

    Returns
    -------
    list of bpy.types.Object
        Of the scene's drawing collection the strokes, curves and meshes; where none is chosen, all visible strokes and
        curves of the scene. Queries, results, and what is carried over do not count.
    """
    chosen = context.scene.geoanalogy.drawing
    if chosen is not None:
        every, kinds = chosen.all_objects, (*LINES, "MESH")
    else:
        every, kinds = [item for item in context.view_layer.objects if item.visible_get()], LINES
    apart = (names.KEY, names.QUERY, names.CONTENT, names.LABEL)
    return sorted((i for i in every if i.type in kinds and not any(name in i for name in apart)), key=lambda i: i.name)


def read_drawn_lines(context: bpy.types.Context) -> DrawnLines:
    """Read the drawing of a scene.

    Parameters
    ----------
    context : bpy.types.Context

    Returns
    -------
    DrawnLines

    Raises
    ------
    InputError
        Where there are no lines, a coordinate is not finite, or the drawing is not flat; naming the object.
    """
    up_to_date(context)
    items = drawing_objects(context)
    drawn = [(item, line) for item in items for line in lines_of(item)]
    if not drawn:
        raise InputError(
            "the scene has no drawing; draw with grease pencil or curves, or choose the collection that holds it"
        )
    plane = plane_through([line for _, line in drawn])
    size = extent(np.vstack([line for _, line in drawn]))
    flat = []
    for item, line in drawn:
        local = plane.to_plane(line)
        if np.abs(local[:, 2]).max() > FLAT * size:
            raise InputError(
                f"object {item.name!r} lies off the plane of the drawing; move it there, or out of the drawing"
            )
        flat.append(local[:, :2])
    # A length of Blender's interface has single precision: 0.1 is meant, not 0.1000000015.
    return DrawnLines(plane, flat, size, float(f"{context.scene.geoanalogy.smoothing:.6g}"))


def lines_of(item: bpy.types.Object) -> list[Array]:
    """The lines of an object.

    Parameters
    ----------
    item : bpy.types.Object
        Grease pencil, curve, or a mesh: of that the outlines of its joined faces, and edges without faces.

    Returns
    -------
    list of ndarray of shape (n, 3)
        In the world; a closed line repeats its first point. Lines of one point are left out.

    Raises
    ------
    InputError
        Where a coordinate is not finite, or too large.
    """
    name = f"object {item.name!r}"
    if item.type == "MESH":
        lines = _mesh_lines(item.data)
    else:
        read = stroke_lines if item.type == "GREASEPENCIL" else curve_lines
        lines = [
            np.vstack([one.points, one.points[:1]]) if one.cyclic else one.points
            for one in read(item.data, name)
            if len(one.points) > 1
        ]
    matrix = np.array(item.matrix_world)
    if not all(np.isfinite(line).all() for line in lines):
        raise InputError(f"{name} has a point that is not finite (NaN or infinity); delete that point")
    placed = [line @ matrix[:3, :3].T + matrix[:3, 3] for line in lines]
    for line in placed:
        if not np.abs(line).max() <= LARGEST_COORDINATE:
            raise InputError(f"{name} has a point beyond {LARGEST_COORDINATE:g}; move it nearer")
    return placed


def plane_through(lines: Sequence[Array]) -> Plane:
    """The plane of a drawing: seen from above, or from where the front and right views look.

    Parameters
    ----------
    lines : sequence of ndarray of shape (n, 3)
        Of one straight line, the most level plane is taken.

    Returns
    -------
    Plane
    """
    points = np.vstack(lines)
    middle = points.mean(axis=0)
    spread, axes = np.linalg.eigh((points - middle).T @ (points - middle))
    lengths = np.sqrt(np.maximum(spread[::-1], 0.0))
    if lengths[1] <= PARALLEL * max(lengths[0], np.finfo(float).tiny):
        along = axes[:, 2]
        up = np.array((0.0, 0.0, 1.0)) if abs(along[2]) < 0.9 else np.array((0.0, -1.0, 0.0))
        normal = up - (up @ along) * along
    else:
        normal = axes[:, 0]
    return Plane.through(middle, _towards_viewer(normal))


def _towards_viewer(normal: Array) -> Array:
    """The normal with the sign that lets it point up, to the front, or to the right."""
    sides = np.array((normal[2], -normal[1], normal[0]))
    return normal * (1.0 if sides[np.abs(sides).argmax()] >= 0.0 else -1.0)


def _mesh_lines(mesh: bpy.types.Mesh) -> list[Array]:
    """The edges with at most one face, joined to lines that end where they branch."""
    points = np.empty(len(mesh.vertices) * 3, np.float32)
    mesh.vertices.foreach_get("co", points)
    points = points.reshape(-1, 3).astype(float)
    edges = np.empty(len(mesh.edges) * 2, np.int32)
    mesh.edges.foreach_get("vertices", edges)
    of_corner = np.empty(len(mesh.loops), np.int32)
    mesh.loops.foreach_get("edge_index", of_corner)
    faces = np.bincount(of_corner, minlength=len(mesh.edges))
    return [points[chain] for chain in joined_edges(edges.reshape(-1, 2)[faces < 2])]


def joined_edges(edges: NDArray[np.intp]) -> list[NDArray[np.intp]]:
    """Edges joined to lines.

    Parameters
    ----------
    edges : ndarray of shape (n, 2), int

    Returns
    -------
    list of ndarray of int
        Vertices of each line in order; a closed one repeats its first. Lines end where edges end or branch.
    """
    around: dict[int, dict[int, None]] = {}
    for a, b in edges.tolist():
        around.setdefault(a, {})[b] = None
        around.setdefault(b, {})[a] = None

    def walk(start: int) -> list[int]:
        chain = [start]
        while around[chain[-1]]:
            here = chain[-1]
            there = next(iter(around[here]))
            del around[here][there], around[there][here]
            chain.append(there)
            if there in ends or there == start:
                break
        return chain

    ends = {v for v, beside in around.items() if len(beside) != 2}
    lines = [walk(v) for v in ends for _ in range(len(around[v]))]
    lines += [walk(v) for v in around if v not in ends and around[v]]
    return [np.array(line, dtype=np.intp) for line in lines if len(line) > 1]


def add_lines(context: bpy.types.Context, lines: Iterable[Array], name: str) -> bpy.types.Object:
    """Add the lines of a file as a curve to the scene's drawing, on the level plane.

    Parameters
    ----------
    context : bpy.types.Context
    lines : iterable of ndarray of shape (n, 2)
        A closed line repeats its first point.
    name : str

    Returns
    -------
    bpy.types.Object
        In the drawing's collection, which is made where there is none.
    """
    settings = context.scene.geoanalogy
    if settings.drawing is None:
        settings.drawing = bpy.data.collections.new("Drawing")
        context.scene.collection.children.link(settings.drawing)
    item = bpy.data.objects.new(name, line_curve(name, [np.column_stack([p, np.zeros(len(p))]) for p in lines]))
    settings.drawing.objects.link(item)
    return item


def line_curve(name: str, lines: Iterable[Array]) -> bpy.types.Curve:
    """Lines as a curve of straight splines.

    Parameters
    ----------
    name : str
    lines : iterable of ndarray of shape (n, 3)
        A closed line repeats its first point.

    Returns
    -------
    bpy.types.Curve
    """
    curve = bpy.data.curves.new(name, "CURVE")
    curve.dimensions = "3D"
    for line in lines:
        cyclic = len(line) > 3 and np.allclose(line[0], line[-1], atol=0.0, rtol=1e-9)
        points = line[:-1] if cyclic else line
        spline = curve.splines.new("POLY")
        spline.points.add(len(points) - 1)
        spline.points.foreach_set("co", np.column_stack([points, np.ones(len(points))]).ravel().astype(np.float32))
        spline.use_cyclic_u = bool(cyclic)
    return curve
