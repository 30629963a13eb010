"""Plane regions with holes (shapely) as solids: walls, ways, lawns."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import shapely
from mathutils.geometry import tessellate_polygon

from .solids import Solid, joined


def parts_of(region: shapely.Geometry) -> list[shapely.Polygon]:
    """The polygons of a region, without slivers."""
    return [part for part in shapely.get_parts(region) if part.geom_type == "Polygon" and part.area > 1e-6]


def flat(region: shapely.Geometry, z: float, finish: str) -> Solid:
    """The region as triangles at a height; they look upwards."""
    pieces = []
    for part in parts_of(region):
        rings = [np.array(ring.coords)[:-1] for ring in (part.exterior, *part.interiors)]
        points = np.vstack(rings)
        triangles = tessellate_polygon([[(x, y, 0.0) for x, y in ring] for ring in rings])
        faces = []
        for a, b, c in triangles:
            (ux, uy), (vx, vy) = points[b] - points[a], points[c] - points[a]
            faces.append((a, b, c) if ux * vy - uy * vx > 0 else (a, c, b))
        pieces.append(Solid(np.column_stack((points, np.full(len(points), z))), faces, [finish] * len(faces)))
    return joined(pieces)


def standing(
    region: shapely.Geometry, z0: float, z1: float, sides: str | Callable[[np.ndarray], str], top: str
) -> Solid:
    """Walls over a region, open below; ``sides`` is a finish or chooses one by an edge's middle."""
    pieces = [flat(region, z1, top)]
    for part in parts_of(region):
        part = shapely.geometry.polygon.orient(part)
        for ring in (part.exterior, *part.interiors):
            points = np.array(ring.coords)[:-1]
            count = len(points)
            vertices = np.vstack([np.column_stack((points, np.full(count, z))) for z in (z0, z1)])
            faces = [(i, (i + 1) % count, count + (i + 1) % count, count + i) for i in range(count)]
            middles = (points + np.roll(points, -1, axis=0)) / 2
            finishes = [sides if isinstance(sides, str) else sides(middle) for middle in middles]
            pieces.append(Solid(vertices, faces, finishes))
    return joined(pieces)
