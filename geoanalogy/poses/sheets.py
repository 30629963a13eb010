"""Relations to the features of single polygons on a grid, kept while polygons come and go (section 4.5)."""

from collections.abc import Collection, Sequence
from functools import cached_property

import numpy as np
import shapely
from numpy.typing import NDArray

from ..geometry.polygon import Polygon
from ..relations.elements import Elements, ElementType
from ..relations.observation import Observation
from ..relations.runs import run_starts
from ..relations.sighting import Sighting
from ..relations.table import Directional, Kind, Positional

Array = NDArray[np.float64]
Array32 = NDArray[np.float32]
Indices = NDArray[np.intp]

#: Stands for an infinite distance in the plane where a value does not change with the point; larger than any scene,
#: and finite in float32.
FAR = 1e30


class Grid:
    """Points in a regular grid over a polygon and a margin around it.

    Parameters
    ----------
    polygon : Polygon
    spacing : float
        Distance between neighbours, scene units.
    margin : float
        Width around the polygon's box that is covered too.
    """

    def __init__(self, polygon: Polygon, spacing: float, margin: float) -> None:
        self.spacing = spacing
        low, high = polygon.bounds[:2] - margin, polygon.bounds[2:] + margin
        # Centred on the polygon: the grid moves with it.
        self.columns, self.rows = (int(np.ceil(v)) + 1 for v in (high - low) / spacing)
        self.origin = (low + high) / 2 - spacing * (np.array([self.columns, self.rows]) - 1) / 2

    def __len__(self) -> int:
        return self.columns * self.rows

    @cached_property
    def points(self) -> Array:
        """All points, row by row; shape (rows * columns, 2)."""
        x = self.origin[0] + self.spacing * np.arange(self.columns)
        y = self.origin[1] + self.spacing * np.arange(self.rows)
        return np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)

    def steps(self, offset: Array) -> NDArray[np.intp]:
        """Offsets in the plane as whole steps along the columns and rows.

        Parameters
        ----------
        offset : ndarray of shape (n, 2)

        Returns
        -------
        ndarray of shape (n, 2), int
        """
        return np.rint(offset / self.spacing).astype(np.intp)


#: Edges that points are compared with at once.
MOST_EDGES = 1 << 16

#: Rows for the features of polygons that are gone, in proportion to those in use, at which all are forgotten.
STALE = 4


class Sheets:
    """The values of relations to the features of polygons on one grid: a row per feature.

    A polygon's rows are kept when others come or go: an edit in a room costs what it adds.

    Parameters
    ----------
    grid : Grid
    """

    def __init__(self, grid: Grid) -> None:
        self.grid = grid
        #: How often everything was forgotten.
        self.forgotten = -1
        self._forget()

    def _forget(self) -> None:
        self.forgotten += 1
        self._first: dict[tuple[ElementType, object], Indices] = {}
        self._used = dict.fromkeys(ElementType, 0)
        self._kept: dict[str, Array32] = {}
        self._done: dict[object, tuple[str, ...]] = {}
        self._covered: dict[object, NDArray[np.bool_]] = {}
        self._inside: dict[object, tuple[Indices, Array32]] = {}

    @property
    def nbytes(self) -> int:
        """Memory held, in bytes."""
        inside = (v for pair in self._inside.values() for v in pair)
        return sum(v.nbytes for held in (self._kept.values(), self._covered.values(), inside) for v in held)

    def forget_gone(self, polygons: Sequence[Polygon]) -> None:
        """Forget everything, where most of it is about other polygons and some of these are not there yet.

        Parameters
        ----------
        polygons : sequence of Polygon
            Those that will be asked for.
        """
        known = {content for _, content in self._first}
        if len(known) > STALE * len(polygons) and not known.issuperset(p.content for p in polygons):
            self._forget()

    def evaluate(
        self, polygons: Sequence[Polygon], relations: Sequence[Positional], directions: Collection[Positional]
    ) -> None:
        """Evaluate relations to polygons that are not there yet, all together: they share what the points see.

        Parameters
        ----------
        polygons : sequence of Polygon
        relations : sequence of Positional
        directions : collection of Positional
            Those of them whose directional partners are evaluated too.
        """
        turned = dict.fromkeys(r.directional for r in directions if r.directional is not None)
        for lacking, there in self._missing(polygons, [*relations, *turned]).items():
            self._add(there, lacking)

    def _missing(
        self, polygons: Sequence[Polygon], wanted: Sequence[Positional | Directional]
    ) -> dict[tuple[Positional | Directional, ...], list[Polygon]]:
        """The relations that are not there yet, with the polygons that lack them."""
        missing: dict[tuple[Positional | Directional, ...], list[Polygon]] = {}
        for polygon in polygons:
            done = self._done.get(polygon.content, ())
            lacking = tuple(r for r in wanted if r.name not in done)
            if lacking:
                missing.setdefault(lacking, []).append(polygon)
        return missing

    def _add(self, polygons: Sequence[Polygon], relations: Sequence[Positional | Directional]) -> None:
        elements = Elements.of(polygons)
        seen = Observation(elements, self.grid.points)
        rows = {e: _as_slice(self.rows(e, polygons)) for e in dict.fromkeys(r.element for r in relations)}
        for relation in relations:
            mine = rows[relation.element]
            if isinstance(relation, Directional):
                self._write(relation.name, relation.element, mine, relation.reference(seen))
                continue
            value = relation.value(seen)
            self._write(f"{relation.name} value", relation.element, mine, value)
            if relation.kind is not Kind.LENGTH:
                with np.errstate(divide="ignore"):
                    reach = 1.0 / np.broadcast_to(relation.slope(seen), value.shape)
                self._write(f"{relation.name} reach", relation.element, mine, np.minimum(reach, FAR, out=reach))
        for polygon in polygons:
            self._done[polygon.content] = (*self._done.get(polygon.content, ()), *(r.name for r in relations))

    def rows(self, element: ElementType, polygons: Sequence[Polygon]) -> Indices:
        """The rows of the features of polygons, one polygon after another; made where there are none yet.

        Parameters
        ----------
        element : ElementType
        polygons : sequence of Polygon

        Returns
        -------
        ndarray of int
        """
        found = []
        for polygon in polygons:
            rows = self._first.get((element, polygon.content))
            if rows is None:
                first = self._used[element]
                self._used[element] += Elements.of([polygon]).count(element)
                rows = self._first[element, polygon.content] = np.arange(first, self._used[element])
            found.append(rows)
        return np.concatenate(found)

    def _write(self, name: str, element: ElementType, rows: Indices | slice, values: Array) -> None:
        kept = self._kept.get(name)
        if kept is None or len(kept) < self._used[element]:
            # Room for as many again: members come one by one.
            more = np.empty((2 * self._used[element], len(self.grid)), dtype=np.float32)
            if kept is not None:
                more[: len(kept)] = kept
            kept = self._kept[name] = more
        kept[rows] = values

    def __getitem__(self, name: str) -> Array32:
        """The rows of a field by its name; shape (rows, points)."""
        return self._kept[name]

    def covered(self, polygon: Polygon) -> NDArray[np.bool_]:
        """Whether a polygon covers each point; shape (points,).

        Parameters
        ----------
        polygon : Polygon

        Returns
        -------
        ndarray of bool
        """
        kept = self._covered.get(polygon.content)
        if kept is None:
            kept = self._covered[polygon.content] = shapely.intersects_xy(polygon.shape, *self.grid.points.T)
        return kept

    def inside(self, polygons: Sequence[Polygon]) -> list[tuple[Indices, Array32]]:
        """The points that polygons cover, and how deep inside they are.

        Parameters
        ----------
        polygons : sequence of Polygon

        Returns
        -------
        list of (ndarray of shape (n,), ndarray of shape (n,))
            Of each polygon its points, and their distances from its boundary in scene units.
        """
        missing = [p for p in dict.fromkeys(polygons) if p.content not in self._inside]
        points = [self._within(p) for p in missing]
        if missing:
            elements = Elements.of(missing)
            owner = np.arange(len(missing)).repeat([len(at) for at in points])
            at = np.concatenate(points)
            edges = np.bincount(elements.edge_polygon, minlength=len(missing))[owner].cumsum()
            depth = np.empty(len(at), dtype=np.float32)
            for part in np.split(np.arange(len(at)), run_starts(edges // MOST_EDGES)[1:]):
                mine = elements.take(ElementType.POLYGON, owner[part])
                seen = Sighting(mine, ElementType.POLYGON, *self.grid.points[at[part]].T)
                depth[part] = seen.boundary.distance[:, 0]
            ends = np.cumsum([len(at) for at in points])[:-1]
            for polygon, where, deep in zip(missing, points, np.split(depth, ends), strict=True):
                self._inside[polygon.content] = where, deep
        return [self._inside[p.content] for p in polygons]

    def _within(self, polygon: Polygon) -> Indices:
        """The points that a polygon covers, of which only those in its box are looked at."""
        low, high = polygon.bounds.reshape(2, 2)
        first = np.maximum(np.floor((low - self.grid.origin) / self.grid.spacing), 0).astype(np.intp)
        last = np.floor((high - self.grid.origin) / self.grid.spacing).astype(np.intp) + 2
        columns = np.arange(first[0], min(last[0], self.grid.columns))
        rows = np.arange(first[1], min(last[1], self.grid.rows))
        at = (rows[:, None] * self.grid.columns + columns).ravel()
        covered = shapely.intersects_xy(polygon.shape, *self.grid.points[at].T)
        within: Indices = at[covered]
        return within


def _as_slice(rows: Indices) -> Indices | slice:
    """Rows as a slice, which is written faster, where they are neighbours."""
    if len(rows) and (rows[1:] - rows[:-1] == 1).all():
        return slice(int(rows[0]), int(rows[-1]) + 1)
    return rows
