"""Offset boundaries: the paths that arrays are aligned along (section 4.8)."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

from ..errors import InputError
from ..geometry.polygon import Polygon
from ..relations.elements import Elements
from ..relations.observation import Observation

Array = NDArray[np.float64]

#: Edges of a quarter circle where an offset boundary goes round a corner: off by a ten-thousandth of the offset.
ARC_EDGES = 64

#: Longest mitre, in offsets; sharper corners are cut off.
LONGEST_MITRE = 10.0


#: Objects that an array may have: more is a mistyped spacing.
MOST_OBJECTS = 10_000

#: Half the stretch, as a share of the whole path, over which its direction is taken: at a corner it halves the angle.
DIRECTION_STRETCH = 1e-4

#: Share of a spacing by which the way may be too short for the last object.
LAST_SLACK = 1e-6


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


@dataclass(frozen=True)
class Stretch:
    """Part of an offset path.

    Attributes
    ----------
    path : OffsetPath
    begin : float
        Arc length of its beginning.
    sense : int
        1 where it runs as the path does, -1 against it.
    length : float
        Scene units.
    """

    path: OffsetPath
    begin: float
    sense: int
    length: float

    def places(self, spacing: float, even: bool, closed: bool) -> Array:
        """Where the objects of an array stand.

        Parameters
        ----------
        spacing : float
            Distance between two objects along the way, scene units.
        even : bool
            Whether the spacing is changed to the nearest one that leaves no rest.
        closed : bool
            Whether the end is the beginning.

        Returns
        -------
        ndarray of shape (k,)
            Distances from the beginning, along the way.

        Raises
        ------
        InputError
            For so small a spacing that it must be mistyped.
        """
        count = self.length / spacing
        if count > MOST_OBJECTS:
            raise InputError(
                f"an array at a spacing of {spacing:g} would have more than {MOST_OBJECTS} objects; "
                "give a larger spacing"
            )
        if even:
            gaps = max(1, round(count))
            spacing = self.length / gaps
        else:
            gaps = math.floor(count + LAST_SLACK)
        # All round, the place after the last gap is the start again.
        return np.asarray(spacing * np.arange(max(1, gaps) if closed else gaps + 1), dtype=np.float64)

    def points(self, places: Array) -> Array:
        """Positions.

        Parameters
        ----------
        places : ndarray of shape (k,)
            Distances from the beginning.

        Returns
        -------
        ndarray of shape (k, 2)
        """
        return self.path.points(self.begin + self.sense * places)

    def directions(self, places: Array) -> Array:
        """Directions of the way: at a corner that which halves the angle, at its ends its own.

        Parameters
        ----------
        places : ndarray of shape (k,)
            Distances from the beginning.

        Returns
        -------
        ndarray of shape (k,)
            Radians.
        """
        half = DIRECTION_STRETCH * self.path.length
        before, after = np.maximum(places - half, 0.0), places + half
        if self.length > half:
            after = np.minimum(after, self.length)
        way = self.points(after) - self.points(before)
        return np.arctan2(way[:, 1], way[:, 0])


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
