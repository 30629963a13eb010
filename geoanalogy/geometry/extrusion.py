"""Extruding polygons to solids (section 5.6)."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

from ..errors import InputError
from ..tolerances import STRAIGHT_RUN
from .boolean import combined
from .frame import Frame
from .polygon import Polygon
from .roof import Roof
from .solid import Face, Solid, assembled

Array = NDArray[np.float64]
Triangles = NDArray[np.intp]


#: Which of its faces an extruded solid has on the surface that its outline is drawn on.
BOTTOM = 0

#: The triangles of four corners in a row.
QUADRANGLE = np.array([(0, 1, 2), (0, 2, 3)])


@dataclass(frozen=True)
class FaceLabels:
    """What the faces of an extruded solid are called.

    Attributes
    ----------
    side : str
        Sides. A labelled edge of the outline gives its side the edge's label as well: "street facade".
    top, bottom : str
        Caps; the bottom lies on the surface that the outline is drawn on.
    roof : str
        Faces of a roof.
    gable : str
        Walls under a roof.
    outside : str
        What a room shows of itself outside: its walls' outer faces, and below.
    """

    side: str = "facade"
    top: str = "top"
    bottom: str = "base"
    roof: str = "roof"
    gable: str = "gable"
    outside: str = "outside"


def extrude(
    polygon: Polygon,
    height: float,
    labels: FaceLabels | None = None,
    roof: Roof | None = None,
    segment_labels: Sequence[str] = (),
    up: ArrayLike = (0.0, 0.0, 1.0),
    walls: float = 0.0,
) -> Solid:
    """The solid between a polygon and the polygon moved along the normal of its plane, or the walls round that.

    Parameters
    ----------
    polygon : Polygon
    height : float
        Scene units; negative: it reaches below the plane.
    labels : FaceLabels, optional
    roof : Roof, optional
        At the far end; None: a flat cap.
    segment_labels : sequence of str
        A label per edge of the outline; none: the polygon's own.
    up : array_like of shape (3,)
        The direction, in the coordinates of the polygon's plane, in which the y axes of the sides point as far as they
        can.
    walls : float
        Thickness of walls and floor, scene units. Where it is not 0, the polygon is a room that is open at the far end:
        the sides look inwards, what lies in the polygon is the "floor" with the label of the bottom, and the top is the
        rim of the walls.

    Returns
    -------
    Solid
        The polygon lies in the plane of its x and y axes. Straight runs of its outline are one face each, called
        "side 0", "side 1" and so on.

    Raises
    ------
    InputError
        For a height of 0 or that is not finite, where a roof does not close, for walls that are thinner than nothing,
        and for a room with a roof.
    """
    if not np.isfinite(height) or height == 0.0:
        raise InputError(f"the height is {height:g}; give a positive one")
    labels = labels or FaceLabels()
    outline = _Outline.of(polygon, segment_labels)
    pitched = None if roof is None or roof.kind == "flat" else roof
    if not (np.isfinite(walls) and walls >= 0.0):
        raise InputError(f"the walls are {walls:g} thick; give a positive number, or 0 for a full body")
    if walls > 0.0 and pitched is not None:
        raise InputError("a room of walls is open above; leave out its roof, or extrude a full body")
    solid = _room(outline, abs(height), labels, walls) if walls else _prism(outline, abs(height), labels, pitched)
    if height < 0:
        solid = _mirrored(solid)
    return replace(solid, faces=tuple(Face(f.name, f.label, f.frame.upright(up), f.domain) for f in solid.faces))


@dataclass(frozen=True)
class _Outline:
    """Rings without vertices along straight runs, and the label of every edge."""

    rings: tuple[Array, ...]
    labels: tuple[tuple[str, ...], ...]

    @classmethod
    def of(cls, polygon: Polygon, segment_labels: Sequence[str]) -> "_Outline":
        names: list[tuple[str, ...]] = [tuple(segment_labels) or polygon.segment_labels]
        names += [("",) * len(hole) for hole in polygon.holes]
        rings, labels = [], []
        for ring, name in zip(polygon.rings, names, strict=True):
            edges = np.concatenate([ring[1:], ring[:1]]) - ring
            before = np.concatenate([edges[-1:], edges[:-1]])
            turn = np.arctan2(before[:, 0] * edges[:, 1] - before[:, 1] * edges[:, 0], (before * edges).sum(axis=1))
            changes = np.array([name[i] != name[i - 1] for i in range(len(name))])
            kept = np.flatnonzero((np.abs(turn) > STRAIGHT_RUN) | changes)
            rings.append(ring[kept])
            labels.append(tuple(name[i] for i in kept))
        return cls(tuple(rings), tuple(labels))

    def widened(self, by: float) -> "_Outline":
        """The outline of eaves; its edges have no labels."""
        wide = shapely.Polygon(self.rings[0], self.rings[1:]).buffer(by, join_style="mitre", mitre_limit=4.0)
        wide = shapely.orient_polygons(shapely.get_parts(wide)[0])
        rings = tuple(shapely.get_coordinates(ring)[:-1] for ring in (wide.exterior, *wide.interiors))
        return _Outline(rings, tuple(("",) * len(ring) for ring in rings))


def _prism(outline: _Outline, height: float, labels: FaceLabels, roof: Roof | None) -> Solid:
    """The solid above an outline."""
    every = np.concatenate(outline.rings)
    cap = triangulated(outline.rings)
    faces = [Face("bottom", labels.bottom, Frame(x=(-1.0, 0.0, 0.0)))]
    parts = [(_raised(every, 0.0), cap[:, ::-1], 0)]
    number = 0
    for ring, names in zip(outline.rings, outline.labels, strict=True):
        corners = ring.tolist()
        for (x, y), (u, v), name in zip(corners, [*corners[1:], corners[0]], names, strict=True):
            length = math.hypot(u - x, v - y)
            frame = Frame((x, y, 0.0), ((u - x) / length, (v - y) / length, 0.0), (0.0, 0.0, 1.0))
            upright = np.array([(x, y, 0.0), (u, v, 0.0), (u, v, height), (x, y, height)])
            parts.append((upright, QUADRANGLE, len(faces)))
            faces.append(Face(f"side {number}", f"{name} {labels.side}".strip(), frame))
            number += 1
    if roof is None or roof.overhang > 0.0:
        parts.append((_raised(every, height), cap, len(faces)))
        faces.append(Face("top", labels.top, Frame(origin=(0.0, 0.0, height))))
    elif roof is not None:
        _roofed(outline, height, labels, roof, parts, faces)
    solid = assembled(parts, faces)
    if roof is None or roof.overhang == 0.0:
        return solid
    eaves = outline.widened(roof.overhang)
    soffit = Face("soffit", labels.roof, Frame((0.0, 0.0, height), x=(-1.0, 0.0, 0.0)))
    above = [soffit]
    over = [(_raised(np.concatenate(eaves.rings), height), triangulated(eaves.rings)[:, ::-1], 0)]
    _roofed(eaves, height, labels, roof, over, above)
    return combined(solid, [(assembled(over, above), Frame())], "merge")


def _room(outline: _Outline, height: float, labels: FaceLabels, walls: float) -> Solid:
    """Walls round an outline, and a floor below it."""
    outer = outline.widened(walls)
    every, around = np.concatenate(outline.rings), np.concatenate(outer.rings)
    slab = triangulated(outer.rings)
    # The rim lies between the two outlines: the ground of one is the hole of the other.
    rings = (*outer.rings, *(ring[::-1] for ring in outline.rings))
    faces = [
        Face("bottom", labels.outside, Frame((0.0, 0.0, -walls), x=(-1.0, 0.0, 0.0))),
        Face("floor", labels.bottom, Frame()),
        Face("top", labels.top, Frame(origin=(0.0, 0.0, height))),
    ]
    parts = [
        (_raised(around, -walls), slab[:, ::-1], 0),
        (_raised(every, 0.0), triangulated(outline.rings), 1),
        (_raised(np.concatenate(rings), height), triangulated(rings), 2),
    ]
    for one, foot, side in ((outline, 0.0, "side"), (outer, -walls, "outside")):
        number = 0
        for ring, names in zip(one.rings, one.labels, strict=True):
            for a, b, name in zip(ring, np.roll(ring, -1, axis=0), names, strict=True):
                inner = side == "side"
                start, end = (b, a) if inner else (a, b)
                along = (end - start) / np.hypot(*(end - start))
                corners = np.array([(*start, foot), (*end, foot), (*end, height), (*start, height)])
                parts.append((corners, QUADRANGLE, len(faces)))
                label = f"{name} {labels.side}".strip() if inner else labels.outside
                faces.append(Face(f"{side} {number}", label, Frame.of((*start, foot), (*along, 0.0), (0.0, 0.0, 1.0))))
                number += 1
    return assembled(parts, faces)


def _roofed(
    outline: _Outline,
    height: float,
    labels: FaceLabels,
    roof: Roof,
    parts: list[tuple[Array, Triangles, int]],
    faces: list[Face],
) -> None:
    """Add the faces of a roof with its eaves at a height."""
    skeleton, gables = roof.over(outline.rings)
    starts = np.concatenate(outline.rings)
    edges = np.concatenate([np.roll(ring, -1, axis=0) - ring for ring in outline.rings])
    points = np.column_stack([skeleton.points, height + roof.heights(skeleton.times)])
    for edge, stage, loops in skeleton.faces:
        along = edges[edge] / np.hypot(*edges[edge])
        if gables[edge]:
            name, label, up = f"gable {edge}", labels.gable, np.array([0.0, 0.0, 1.0])
        else:
            lower = roof.kind == "mansard" and stage == 0
            pitch = roof.lower_pitch if lower else roof.pitch
            name, label = f"roof {edge}" if stage == 0 else f"upper roof {edge}", labels.roof
            up = np.array([-along[1] * np.cos(pitch), along[0] * np.cos(pitch), np.sin(pitch)])
        frame = Frame.of((*starts[edge], height), (*along, 0.0), up)
        corners = [points[loop] for loop in loops]
        triangles = triangulated([frame.to_plane(c)[:, :2] for c in corners])
        parts.append((np.concatenate(corners), triangles, len(faces)))
        faces.append(Face(name, label, frame))
    if skeleton.tops:
        corners = [points[loop] for loop in skeleton.tops]
        parts.append((np.concatenate(corners), triangulated([c[:, :2] for c in corners]), len(faces)))
        faces.append(Face("top", labels.top, Frame(origin=(0.0, 0.0, float(corners[0][0, 2])))))


def _raised(points: Array, height: float) -> Array:
    return np.column_stack([points, np.full(len(points), height)])


def _mirrored(solid: Solid) -> Solid:
    """The solid below the plane instead of above it."""
    faces = []
    for face in solid.faces:
        (ox, oy, oz), (x1, x2, x3), (y1, y2, y3) = face.frame.origin, face.frame.x, face.frame.y
        faces.append(Face(face.name, face.label, Frame((ox, oy, -oz), (-x1, -x2, x3), (y1, y2, -y3))))
    return Solid(solid.vertices * (1.0, 1.0, -1.0), solid.triangles[:, ::-1], solid.face, tuple(faces))


def triangulated(rings: Sequence[Array]) -> Triangles:
    """Triangles of an area by its rings.

    Parameters
    ----------
    rings : sequence of ndarray of shape (n, 2)
        The interior on the left.

    Returns
    -------
    ndarray of shape (k, 3), int
        Counter-clockwise, by the numbers of the rings' vertices in a row; every vertex is used.
    """
    import manifold3d

    found = manifold3d.triangulate([np.ascontiguousarray(ring) for ring in rings])
    return np.asarray(found, dtype=np.intp)
