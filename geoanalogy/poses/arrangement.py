"""Arrangements: a polygon with its members, the surroundings of a pose (sections 4.5 and 4.8)."""

import math
from collections.abc import Sequence
from functools import cached_property

import numpy as np

from ..geometry.memory import Memory
from ..geometry.polygon import Polygon
from ..geometry.scene import Scene
from ..relations.elements import Elements, ElementType
from .fields import Fields
from .fronts import Fronts, may_be_opening
from .sheets import Grid, Sheets


class Arrangement:
    """A polygon and its members: the surroundings that a pose inside it stands in relations to (section 4.8).

    Parameters
    ----------
    parent : Polygon
    members : sequence of Polygon
        The parent's children and what straddles its boundary.
    memory : Memory, optional
        Where fields are kept.

    Attributes
    ----------
    parent : Polygon
    members : tuple of Polygon
    elements : Elements
        The features of the parent, then of the members.
    """

    def __init__(self, parent: Polygon, members: Sequence[Polygon], memory: Memory | None = None) -> None:
        self.parent = parent
        self.members = tuple(members)
        self.elements = Elements.of([parent, *members], parent.main_orientation)
        self._memory = Memory() if memory is None else memory
        self._fields: dict[tuple[float, float], Fields] = {}

    @property
    def nbytes(self) -> int:
        """Memory held, in bytes, about: that of fields is the memory's."""
        return 4096 + 100 * len(self.elements.edge_length)

    @cached_property
    def roles(self) -> dict[ElementType, list[tuple[bool, str, str]]]:
        """Per element: whether it is the parent's, its polygon's label, and its own label where it is a segment."""
        e = self.elements
        per_polygon = [(i == 0, p.label) for i, p in enumerate(e.polygons)]
        return {
            ElementType.POLYGON: [(*r, "") for r in per_polygon],
            ElementType.SEGMENT: [
                (*per_polygon[k], e.segment_label[i]) for i, k in enumerate(e.segment_polygon.tolist())
            ],
            ElementType.CORNER: [(*per_polygon[k], "") for k in e.corner_polygon.tolist()],
        }

    @cached_property
    def fronts(self) -> Fronts:
        """What has to stay free before its openings."""
        openings = [m for m in self.members if may_be_opening(self.parent, m)]
        # The furniture changes, the openings do not.
        key = ("fronts", self.parent.content, *(m.content for m in openings))
        return self._memory.recall(key, lambda: Fronts.of(self.parent, openings))  # type: ignore[no-any-return]

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
        # In steps, so that objects of different sizes share the fields.
        margin = spacing * 2.0 ** max(1, math.ceil(math.log2(margin / spacing)))
        kept = self._fields.get((spacing, margin))
        if kept is None:
            key = ("sheets", self.parent.content, spacing, margin)
            sheets = self._memory.recall(key, lambda: Sheets(Grid(self.parent, spacing, margin)))
            kept = self._fields[spacing, margin] = Fields(self.elements.polygons, sheets)
        return kept


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
    return scene.memory.recall(key, lambda: Arrangement(polygon, members, scene.memory))  # type: ignore[no-any-return]
