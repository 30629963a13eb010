"""Offset boundaries: the paths that arrays are aligned along (section 4.8)."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

from ..geometry.polygon import Polygon
from ..relations.elements import Elements
from ..relations.observation import Observation

Array = NDArray[np.float64]

#: Edges of a quarter circle where an offset boundary goes round a corner: off by a ten-thousandth of the offset.
ARC_EDGES = 64

#: Longest mitre, in offsets; sharper corners are cut off.
LONGEST_MITRE = 10.0


@dataclass(frozen=True)
class Alignment:
    """The boundary that a point is nearest to.

    Attributes
    ----------
    polygon : Polygon
    offset : float
        Distance from its boundary, scene units.
    inside : bool
        Whether the point lies in the polygon; its boundary counts as inside.
    """

    polygon: Polygon
    offset: float
    inside: bool


def align(point: ArrayLike, polygons: Sequence[Polygon]) -> Alignment:
    """The boundary nearest to a point.

    Parameters
    ----------
    point : array_like of shape (2,)
    polygons : sequence of Polygon
        Of equally near ones the first counts.

    Returns
    -------
    Alignment
    """
    seen = Observation(Elements.of(polygons), np.asarray(point, dtype=np.float64)[None])
    nearest = int(np.argmin(seen.boundary.distance[:, 0]))
    return Alignment(polygons[nearest], float(seen.boundary.distance[nearest, 0]), bool(seen.inside[nearest, 0]))


@dataclass(frozen=True)
class OffsetPath:
    """One closed path at a distance from a boundary; it runs as the boundary does, the polygon's interior on the left.

    Attributes
    ----------
    vertices : ndarray of shape (n, 2)
        Without a repeated last one.
    """

    vertices: Array

    @cached_property
    def _arcs(self) -> Array:
        steps = np.roll(self.vertices, -1, axis=0) - self.vertices
        return np.concatenate([[0.0], np.cumsum(np.hypot(*steps.T))])

    @property
    def length(self) -> float:
        """Length all round, scene units."""
        return float(self._arcs[-1])

    @cached_property
    def _line(self) -> shapely.LinearRing:
        return shapely.LinearRing(self.vertices)

    def distance(self, point: ArrayLike) -> float:
        """Distance of a point from the path.

        Parameters
        ----------
        point : array_like of shape (2,)

        Returns
        -------
        float
        """
        return float(shapely.distance(self._line, shapely.Point(np.asarray(point, float))))

    def project(self, point: ArrayLike) -> float:
        """Arc length, from the first vertex, to the place of the path nearest to a point.

        Parameters
        ----------
        point : array_like of shape (2,)

        Returns
        -------
        float
        """
        return float(shapely.line_locate_point(self._line, shapely.Point(np.asarray(point, float))))

    def points(self, arcs: ArrayLike) -> Array:
        """Places on the path.

        Parameters
        ----------
        arcs : array_like of shape (k,)
            Arc lengths from the first vertex; the path closes on itself.

        Returns
        -------
        ndarray of shape (k, 2)
        """
        at = np.asarray(arcs, dtype=np.float64) % self.length
        closed = np.vstack([self.vertices, self.vertices[:1]])
        return np.stack([np.interp(at, self._arcs, closed[:, axis]) for axis in (0, 1)], axis=1)


def offset_paths(polygon: Polygon, offset: float, inside: bool, corners: Literal["round", "mitre"]) -> list[OffsetPath]:
    """All paths at a distance from a polygon's boundary, on one side of it.

    Parameters
    ----------
    polygon : Polygon
    offset : float
        Distance in scene units, not negative.
    inside : bool
    corners : {"round", "mitre"}
        How the path goes round corners that point to its side.

    Returns
    -------
    list of OffsetPath
        Around the outline and around the holes; none where the polygon is nowhere that wide.
    """
    area = polygon.shape
    if offset > 0:
        width = -offset if inside else offset
        area = area.buffer(width, quad_segs=ARC_EDGES, join_style=corners, mitre_limit=LONGEST_MITRE)
    paths = []
    for part in shapely.get_parts(area):
        if not part.is_empty:
            part = shapely.geometry.polygon.orient(part)
            paths += [OffsetPath(shapely.get_coordinates(ring)[:-1]) for ring in (part.exterior, *part.interiors)]
    return paths
