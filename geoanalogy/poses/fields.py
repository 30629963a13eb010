"""The fields of all relations over a polygon: values on a grid that depend on the scene alone (section 4.5)."""

from collections.abc import Collection, Iterable, Sequence
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..geometry.polygon import Polygon
from ..relations.elements import ElementType
from ..relations.table import RELATIONS, Kind, Positional
from .sheets import Sheets

Array32 = NDArray[np.float32]
Indices = NDArray[np.intp]


class Fields:
    """Every relation's value at every grid point, for the features of an arrangement.

    Parameters
    ----------
    polygons : sequence of Polygon
        The arrangement's.
    sheets : Sheets
    """

    def __init__(self, polygons: Sequence[Polygon], sheets: Sheets) -> None:
        self.grid = sheets.grid
        self._polygons = polygons
        self._sheets = sheets
        sheets.forget_gone(polygons)
        self._start()

    def _start(self) -> None:
        self._forgotten = self._sheets.forgotten
        #: Fields by name, and the rows of the arrangement's features in those of their type.
        self._kept: dict[str, Array32] = {}
        self._features: dict[ElementType, Indices] = {}
        #: What has been asked for.
        self._evaluated: set[tuple[object, ...]] = set()

    def evaluate(
        self,
        relations: Iterable[Positional],
        directions: Collection[Positional] | None = None,
        polygons: Collection[int] | None = None,
    ) -> None:
        """Evaluate relations that are not there yet.

        Parameters
        ----------
        relations : iterable of Positional
        directions : collection of Positional, optional
            Those of them whose directional partners are evaluated too; None: all.
        polygons : collection of int, optional
            Numbers of the polygons to whose features they are evaluated; None: all.
        """
        wanted = list(dict.fromkeys(relations))
        every = (wanted, directions, polygons)
        asked = tuple(None if part is None else tuple(part) for part in every)
        if self._forgotten != self._sheets.forgotten:
            self._start()
        if asked in self._evaluated:
            return
        self._evaluated.add(asked)
        turned = [r for r in wanted if r.directional is not None and (directions is None or r in directions)]
        chosen = self._polygons if polygons is None else [self._polygons[i] for i in polygons]
        self._sheets.evaluate(chosen, wanted, turned)
        for element in {r.element for r in wanted}:
            self._features[element] = self._sheets.rows(element, self._polygons)
            for relation in (r for r in wanted if r.element is element):
                names = {f"{relation.name} value"}
                if relation.kind is not Kind.LENGTH:
                    names.add(f"{relation.name} reach")
                if relation.directional is not None and relation in turned:
                    names.add(relation.directional.name)
                self._kept.update((name, self._sheets[name]) for name in names)

    def index(self, element: ElementType, feature: Indices, where: Indices) -> Indices:
        """Where the values of features at grid points are kept.

        Parameters
        ----------
        element : ElementType
            Of which relations are evaluated.
        feature : ndarray of shape (k,), int
            Of the arrangement.
        where : ndarray of shape (k, n) or (n,), int
            Grid points.

        Returns
        -------
        ndarray of shape (k, n), int
        """
        index: Indices = (self._features[element][feature] * len(self.grid))[:, None] + where
        return index

    def value(self, relation: Positional, index: Indices) -> Array32:
        """The relation's value.

        Parameters
        ----------
        relation : Positional
            Evaluated.
        index : ndarray of int
            Of features of the relation's type.

        Returns
        -------
        ndarray of the same shape, float32
        """
        return self._kept[f"{relation.name} value"].ravel().take(index)

    def reach(self, relation: Positional, index: Indices) -> Array32:
        """Distance in the plane per unit of value: the inverse of the slope.

        Parameters
        ----------
        relation : Positional
            Evaluated, whose values are no lengths.
        index : ndarray of int

        Returns
        -------
        ndarray of the same shape, float32
        """
        return self._kept[f"{relation.name} reach"].ravel().take(index)

    def direction(self, relation: Positional, index: Indices) -> Array32:
        """Reference direction of the relation's directional partner, radians.

        Parameters
        ----------
        relation : Positional
            Evaluated, with a directional partner.
        index : ndarray of int

        Returns
        -------
        ndarray of the same shape, float32
        """
        assert relation.directional is not None
        return self._kept[relation.directional.name].ravel().take(index)

    @cached_property
    def parent_distance(self) -> Array32:
        """Distance of each point from the boundary of the arrangement's parent; shape (points,)."""
        relation = RELATIONS["boundary distance"]
        self.evaluate([relation], (), [0])
        return self._kept[f"{relation.name} value"][self._features[ElementType.POLYGON][0]]

    def inside(self, polygons: Collection[int]) -> list[tuple[Indices, Array32]]:
        """The points that polygons of the arrangement cover, and how deep inside they are.

        Parameters
        ----------
        polygons : collection of int
            Their numbers.

        Returns
        -------
        list of (ndarray of shape (n,), ndarray of shape (n,))
            Of each polygon its points, and their distances from its boundary in scene units.
        """
        return self._sheets.inside([self._polygons[i] for i in polygons])

    def covered(self, polygon: int) -> NDArray[np.bool_]:
        """Whether a polygon of the arrangement covers each point; shape (points,).

        Parameters
        ----------
        polygon : int
            Its number.

        Returns
        -------
        ndarray of bool
        """
        return self._sheets.covered(self._polygons[polygon])
