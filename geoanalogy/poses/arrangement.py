"""Arrangements: a polygon with its members, and the fields of all relations over it (sections 4.5 and 4.8)."""

from collections.abc import Iterable, Sequence
from functools import cached_property

import numpy as np
import shapely
from numpy.typing import NDArray

from ..geometry.polygon import Polygon
from ..geometry.scene import Scene
from ..relations.elements import Elements, ElementType
from ..relations.observation import Observation
from ..relations.table import RELATIONS, Kind, Positional

Array = NDArray[np.float64]
Array32 = NDArray[np.float32]

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


class Arrangement:
    """A polygon and its members: the surroundings that a pose inside it stands in relations to (section 4.8).

    Parameters
    ----------
    parent : Polygon
    members : sequence of Polygon
        The parent's children and what straddles its boundary.

    Attributes
    ----------
    parent : Polygon
    members : tuple of Polygon
    elements : Elements
        The features of the parent, then of the members.
    """

    def __init__(self, parent: Polygon, members: Sequence[Polygon]) -> None:
        self.parent = parent
        self.members = tuple(members)
        self.elements = Elements.of([parent, *members], parent.main_orientation)
        self._fields: dict[float, Fields] = {}

    @property
    def nbytes(self) -> int:
        """Memory held by the fields, in bytes."""
        return 4096 + sum(f.nbytes for f in self._fields.values())

    @cached_property
    def roles(self) -> dict[ElementType, list[tuple[bool, str, str]]]:
        """Per element: whether it is the parent's, its polygon's label, and its own label where it is a segment."""
        e = self.elements
        per_polygon = [(i == 0, p.label) for i, p in enumerate(e.polygons)]
        return {
            ElementType.POLYGON: [(*r, "") for r in per_polygon],
            ElementType.SEGMENT: [(*per_polygon[k], e.segment_label[i]) for i, k in enumerate(e.segment_polygon)],
            ElementType.CORNER: [(*per_polygon[k], "") for k in e.corner_polygon],
        }

    def is_at(self, other: "Arrangement") -> bool:
        """Whether the other arrangement's parent is this one's, in the same place.

        Parameters
        ----------
        other : Arrangement

        Returns
        -------
        bool
        """
        return self.parent.label == other.parent.label and np.array_equal(self.parent.points, other.parent.points)

    def fields(self, spacing: float, margin: float) -> "Fields":
        """The relation fields on a grid, evaluated at the first use and kept.

        Parameters
        ----------
        spacing, margin : float
            Of the grid, scene units.

        Returns
        -------
        Fields
        """
        kept = self._fields.get(spacing)
        if kept is None or kept.margin < margin:
            kept = self._fields[spacing] = Fields(self, spacing, margin)
        return kept


class Fields:
    """Every relation's value at every grid point: they depend on the scene alone, not on the query.

    Parameters
    ----------
    arrangement : Arrangement
    spacing, margin : float
        Of the grid, scene units.
    """

    def __init__(self, arrangement: Arrangement, spacing: float, margin: float) -> None:
        self.margin = margin
        self.grid = Grid(arrangement.parent, spacing, margin)
        self._arrangement = arrangement
        self._kept: dict[str, Array32] = {}

    @property
    def nbytes(self) -> int:
        """Memory held, in bytes."""
        return sum(v.nbytes for v in self._kept.values())

    def evaluate(self, relations: Iterable[Positional]) -> None:
        """Evaluate relations that are not there yet, all together: they share what the points see.

        Parameters
        ----------
        relations : iterable of Positional
        """
        missing = [r for r in relations if f"{r.name} value" not in self._kept]
        if not missing:
            return
        seen = Observation(self._arrangement.elements, self.grid.points)
        for relation in missing:
            value = relation.value(seen)
            self._kept[f"{relation.name} value"] = value.astype(np.float32)
            if relation.kind is not Kind.LENGTH:
                slope = np.broadcast_to(relation.slope(seen), value.shape)
                reach = np.divide(1.0, slope, out=np.full(value.shape, FAR), where=slope > 0)
                self._kept[f"{relation.name} reach"] = np.minimum(reach, FAR).astype(np.float32)
            if relation.directional is not None and relation.directional.name not in self._kept:
                self._kept[relation.directional.name] = relation.directional.reference(seen).astype(np.float32)

    def value(self, relation: Positional) -> Array32:
        """The relation's value; shape (elements, points).

        Parameters
        ----------
        relation : Positional

        Returns
        -------
        ndarray of float32
        """
        return self._kept[f"{relation.name} value"]

    def reach(self, relation: Positional) -> Array32:
        """Distance in the plane per unit of value: the inverse of the slope; shape (elements, points).

        Parameters
        ----------
        relation : Positional
            Whose values are no lengths.

        Returns
        -------
        ndarray of float32
        """
        return self._kept[f"{relation.name} reach"]

    def direction(self, relation: Positional) -> Array32:
        """Reference direction of the relation's directional partner, radians; shape (elements, points).

        Parameters
        ----------
        relation : Positional
            With a directional partner.

        Returns
        -------
        ndarray of float32
        """
        assert relation.directional is not None
        return self._kept[relation.directional.name]

    @cached_property
    def boundary_distance(self) -> Array32:
        """Distance of each point from each polygon's boundary; shape (polygons, points)."""
        relation = RELATIONS["boundary distance"]
        self.evaluate([relation])
        return self.value(relation)

    @cached_property
    def covered(self) -> NDArray[np.bool_]:
        """Per polygon of the arrangement, whether it covers each point; shape (polygons, points)."""
        x, y = self.grid.points.T
        polygons = self._arrangement.elements.polygons
        return np.array([shapely.intersects_xy(p.shape, x, y) for p in polygons]).reshape(-1, len(x))


def arrangement_of(scene: Scene, polygon: Polygon) -> Arrangement:
    """The arrangement of a polygon of a scene, with what is remembered of it.

    Parameters
    ----------
    scene : Scene
    polygon : Polygon

    Returns
    -------
    Arrangement
    """
    members = scene.members_of(str(polygon.id))
    key = ("arrangement", polygon.content, *(m.content for m in members))
    return scene.memory.recall(key, lambda: Arrangement(polygon, members))  # type: ignore[no-any-return]
