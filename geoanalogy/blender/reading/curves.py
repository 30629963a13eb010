"""Curves and grease-pencil strokes as lines and rings in space."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import bpy
import numpy as np
from numpy.typing import NDArray

from ...errors import InputError
from ...tolerances import NEARLY_CLOSED

Array = NDArray[np.float64]

#: Segments per piece of a Bézier stroke, which has no resolution of its own.
STROKE_RESOLUTION = 12


@dataclass(frozen=True)
class Line:
    """A line as it is drawn.

    Attributes
    ----------
    points : ndarray of shape (n, 3)
        In its object's coordinates; a cyclic one does not repeat its first point.
    cyclic : bool
    name : str
        What it is called in messages.
    """

    points: Array
    cyclic: bool
    name: str


def curve_rings(data: bpy.types.Curve, name: str) -> list[Array]:
    """The splines of a curve as rings, in its object's coordinates.

    Parameters
    ----------
    data : bpy.types.Curve
        Its bevel, extrusion and modifiers play no part.
    name : str
        What it is called in messages.

    Returns
    -------
    list of ndarray of shape (n, 3)
        A ring per spline; Bézier and NURBS splines at the curve's resolution.

    Raises
    ------
    InputError
        Where a spline is neither cyclic nor nearly closed.
    """
    return [closed(line.points, line.cyclic, line.name) for line in curve_lines(data, name)]


def curve_lines(data: bpy.types.Curve, name: str) -> Iterator[Line]:
    """The splines of a curve as lines, in its object's coordinates.

    Parameters
    ----------
    data : bpy.types.Curve
        Its bevel, extrusion and modifiers play no part.
    name : str
        What it is called in messages.

    Yields
    ------
    Line
        A line per spline; Bézier and NURBS splines at the curve's resolution.
    """
    for i, spline in enumerate(data.splines):
        if spline.type == "BEZIER":
            knots = [_vectors(spline.bezier_points, key) for key in ("handle_left", "co", "handle_right")]
            points = bezier_points(*knots, spline.use_cyclic_u, spline.resolution_u)
        elif spline.type == "NURBS":
            points = _nurbs_points(data, i)
        else:
            points = _vectors(spline.points, "co", 4)[:, :3]
        yield Line(points, spline.use_cyclic_u, f"spline {i + 1} of {name}")


def stroke_rings(data: bpy.types.ID, name: str) -> list[Array]:
    """The strokes of a grease-pencil drawing as rings, in its object's coordinates.

    Parameters
    ----------
    data : bpy.types.GreasePencil
        Of its visible layers, the frame at the playhead counts.
    name : str
        What it is called in messages.

    Returns
    -------
    list of ndarray of shape (n, 3)

    Raises
    ------
    InputError
        Where a stroke is neither cyclic nor nearly closed.
    """
    return [closed(line.points, line.cyclic, line.name) for line in stroke_lines(data, name)]


def stroke_lines(data: bpy.types.ID, name: str) -> Iterator[Line]:
    """The strokes of a grease-pencil drawing as lines, in its object's coordinates.

    Parameters
    ----------
    data : bpy.types.GreasePencil
        Of its visible layers, the frame at the playhead counts.
    name : str
        What it is called in messages.

    Yields
    ------
    Line
    """
    for layer, drawing in shown_drawings(data):
        # An empty drawing has one offset by its length, and none by what it hands out.
        if len(drawing.curve_offsets) < 2:
            continue
        offsets = _values(drawing.curve_offsets, "value", np.int32)
        position = _attribute(drawing, "position", "vector", np.zeros((offsets[-1], 3)))
        cyclic = _attribute(drawing, "cyclic", "value", np.zeros(len(offsets) - 1, dtype=bool))
        kind = _attribute(drawing, "curve_type", "value", np.ones(len(offsets) - 1, dtype=np.int32))
        handles = [_attribute(drawing, key, "vector", position) for key in ("handle_left", "handle_right")]
        placed = np.array(layer.matrix_local)
        for i, (a, b) in enumerate(pairwise(offsets.tolist())):
            points = position[a:b]
            if kind[i] == _BEZIER:
                points = bezier_points(handles[0][a:b], points, handles[1][a:b], bool(cyclic[i]), STROKE_RESOLUTION)
            points = points @ placed[:3, :3].T + placed[:3, 3]
            yield Line(points, bool(cyclic[i]), f"stroke {i + 1} of layer {layer.name!r} of {name}")


def shown_drawings(
    data: bpy.types.ID,
) -> Iterator[tuple[bpy.types.GreasePencilLayer, bpy.types.GreasePencilDrawing]]:
    """What grease pencil shows at the playhead.

    Parameters
    ----------
    data : bpy.types.GreasePencil

    Yields
    ------
    (bpy.types.GreasePencilLayer, bpy.types.GreasePencilDrawing)
        Of every layer that is hidden neither by itself nor with its groups.
    """
    for layer in data.layers:
        frame, node = layer.current_frame(), layer
        while node is not None and not node.hide:
            node = node.parent_group
        if node is None and frame is not None:
            yield layer, frame.drawing


def closed(points: Array, cyclic: bool, name: str) -> Array:
    """A line as a ring: cyclic ones as they are, others where their ends meet or nearly meet.

    Parameters
    ----------
    points : ndarray of shape (n, 3)
    cyclic : bool
    name : str
        What the line is called in messages.

    Returns
    -------
    ndarray of shape (m, 3)
        Without a repeated last point.

    Raises
    ------
    InputError
        Where the ends are apart.
    """
    if cyclic or len(points) < 3:
        return points
    length = float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())
    gap = float(np.linalg.norm(points[-1] - points[0]))
    if gap > NEARLY_CLOSED * length:
        raise InputError(f"{name} is open: its ends are {gap:.3g} apart; close it")
    return points[:-1]


def bezier_points(left: Array, knots: Array, right: Array, cyclic: bool, resolution: int) -> Array:
    """Points of a Bézier spline.

    Parameters
    ----------
    left, knots, right : ndarray of shape (n, 3)
        Knots and their handles.
    cyclic : bool
    resolution : int
        Segments per piece.

    Returns
    -------
    ndarray of shape (m, 3)
        From the first knot; a piece that is straight adds none but its ends.
    """
    pieces = len(knots) if cyclic else len(knots) - 1
    if pieces < 1:
        return knots
    a, b = np.arange(pieces), (np.arange(pieces) + 1) % len(knots)
    t = (np.arange(resolution) / resolution)[None, :, None]
    p, q, r, s = (k[:, None] for k in (knots[a], right[a], left[b], knots[b]))
    points = (1 - t) ** 3 * p + 3 * (1 - t) ** 2 * t * q + 3 * (1 - t) * t**2 * r + t**3 * s
    straight = _is_on(right[a], knots[a], knots[b]) & _is_on(left[b], knots[a], knots[b])
    kept = np.ones((pieces, resolution), dtype=bool)
    kept[straight, 1:] = False
    return points[kept] if cyclic else np.vstack([points[kept], knots[-1:]])


def _is_on(points: Array, start: Array, end: Array) -> NDArray[np.bool_]:
    """Whether handles lie on the straight line between their knots."""
    along = end - start
    length = np.linalg.norm(along, axis=1)
    off = np.linalg.norm(np.cross(points - start, along), axis=1)
    return off <= 1e-5 * length**2


def _nurbs_points(data: bpy.types.Curve, index: int) -> Array:
    """Points of a NURBS spline, by Blender's own evaluation of a copy that has this spline alone."""
    copy = data.copy()
    try:
        copy.dimensions = "3D"
        copy.bevel_depth = copy.extrude = 0.0
        copy.bevel_object = None
        for i in reversed(range(len(copy.splines))):
            if i != index:
                copy.splines.remove(copy.splines[i])
        carrier = bpy.data.objects.new(copy.name, copy)
        try:
            points = _vectors(carrier.to_mesh().vertices, "co")
            carrier.to_mesh_clear()
        finally:
            bpy.data.objects.remove(carrier)
    finally:
        bpy.data.curves.remove(copy)
    return points


#: Number of the Bézier type in the attribute "curve_type".
_BEZIER = 2


def _values(items: bpy.types.bpy_prop_collection, key: str, dtype: type) -> NDArray:
    values = np.empty(len(items), dtype=dtype)
    items.foreach_get(key, values)
    return values


def _vectors(items: bpy.types.bpy_prop_collection, key: str, width: int = 3) -> Array:
    values = np.empty(len(items) * width, dtype=np.float32)
    items.foreach_get(key, values)
    return values.reshape(-1, width).astype(float)


def _attribute(drawing: bpy.types.GreasePencilDrawing, name: str, key: str, default: NDArray) -> NDArray:
    found = drawing.attributes.get(name)
    if found is None:
        return default
    values = np.empty(default.size, dtype=np.float32 if default.dtype == float else default.dtype)
    found.data.foreach_get(key, values)
    return values.reshape(default.shape).astype(default.dtype)
