"""Openings cut out of faces in two dimensions, which is exact where it suffices (section 5.6)."""

from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from ..tolerances import COORDINATE_GRID
from .extrusion import BOTTOM, triangulated
from .frame import Frame
from .loops import border
from .polygon import signed_area
from .solid import Face, Solid

Array = NDArray[np.float64]
Standing = tuple[Solid, Frame]


def with_openings(solid: Solid, face: int, openings: Sequence[Standing]) -> tuple[Solid, list[Standing]]:
    """Cut openings out of one face of a solid, as far as two dimensions suffice.

    They do where the opening lies strictly inside of what there is of the face, apart from other openings, and where
    nothing else of the solid is as deep behind it.

    Parameters
    ----------
    solid : Solid
    face : int
    openings : sequence of (Solid, Frame)
        Extruded below the plane of the face, with the frame that each stands in, in the coordinates of the solid. The
        names of their faces are kept.

    Returns
    -------
    solid : Solid
    others : list of (Solid, Frame)
        Those that need a boolean of solids.
    """
    frame = solid.faces[face].frame
    own = solid.triangles_of(face)
    loops = border(own, frame.to_plane(solid.vertices)[:, :2])
    cut, others = _separate(solid, face, openings, loops)
    if not cut:
        return solid, others
    parts = [solid.vertices]
    triangles, index = [solid.triangles[solid.face != face]], [solid.face[solid.face != face]]
    faces = list(solid.faces)
    count = len(solid.vertices)
    for opening, where, ring in cut:
        kept = opening.face != BOTTOM
        triangles.append(opening.triangles[kept][:, ::-1] + count)
        index.append(opening.face[kept] + len(faces))
        faces += [_standing(one, where).flipped for one in opening.faces]
        parts.append(where.to_space(opening.vertices))
        loops.append([vertex + count for vertex in ring[::-1]])
        count += len(opening.vertices)
    vertices = np.concatenate(parts)
    flat = frame.to_plane(vertices)[:, :2]
    around = np.concatenate([np.array(loop) for loop in loops])
    own = around[triangulated([flat[loop] for loop in loops])]
    triangles.append(own)
    index.append(np.full(len(own), face))
    return Solid(vertices, np.concatenate(triangles), np.concatenate(index), tuple(faces)), others


def _separate(
    solid: Solid, face: int, openings: Sequence[Standing], loops: list[list[int]]
) -> tuple[list[tuple[Solid, Frame, list[int]]], list[Standing]]:
    """Openings that can be cut in two dimensions, with their outlines, and the others."""
    frame = solid.faces[face].frame
    there = frame.to_plane(solid.vertices)
    rings = [there[loop, :2] for loop in loops]
    outlines = [shapely.Polygon(ring) for ring in rings if signed_area(ring) > 0]
    holes = [shapely.Polygon(ring) for ring in rings if signed_area(ring) < 0]
    whole = shapely.difference(shapely.union_all(shapely.buffer(outlines, 0.0)), shapely.union_all(holes))
    shapely.prepare(whole)
    corners = there[solid.triangles[solid.face != face]]
    low, high = corners.min(axis=1), corners.max(axis=1)
    cut: list[tuple[Solid, Frame, list[int]]] = []
    others: list[Standing] = []
    taken: list[shapely.Polygon] = []
    for opening, where in openings:
        points = frame.to_plane(where.to_space(opening.vertices))
        lid = opening.triangles_of(BOTTOM)
        edge = border(lid, points[:, :2])
        flat = bool((np.abs(points[lid, 2]) < COORDINATE_GRID).all())
        if len(edge) == 1 and flat and points[:, 2].max() < COORDINATE_GRID:
            shape = shapely.Polygon(points[edge[0], :2])
            least, most = points.min(axis=0) - COORDINATE_GRID, points.max(axis=0) + COORDINATE_GRID
            behind = ((low <= most) & (high >= least)).all(axis=1).any()
            if whole.contains_properly(shape) and not behind and not any(shape.intersects(t) for t in taken):
                cut.append((opening, where, edge[0]))
                taken.append(shape)
                continue
        others.append((opening, where))
    return cut, others


def _standing(face: Face, frame: Frame) -> Face:
    return Face(face.name, face.label, face.frame.inside(frame), face.domain)
