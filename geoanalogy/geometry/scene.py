"""Scenes: arrangements of labelled polygons with a hierarchy (sections 4.2 and 4.8)."""

import copy
import itertools
import operator
from collections.abc import Iterable, Sequence
from functools import cached_property
from typing import Any

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

from ..arguments import listed, points_of, real, shown
from ..errors import InputError
from .hierarchy import Overlaps, find_overlaps, find_parents
from .memory import Memory
from .polygon import Polygon, clean_ring


class Scene:
    """A set of labelled polygons and their hierarchy. Never changed: edits make a new scene.

    Parameters
    ----------
    polygons : iterable of Polygon
        Those without an id are given one that is free ("polygon 3"). An id that occurs again gets a number, as names
        do in Blender ("bed", "bed.001"); a parent named by several polygons is the one of them that holds most of the
        child.
    offset : pair of float
        What is added to the scene's coordinates to have those of the file it came from: map coordinates are brought
        near the origin, where Blender's single precision and ours hold them exactly.
    memory : Memory, optional
        Where what is derived from the scene is kept; scenes made from this one share it. None: one of its own.

    Attributes
    ----------
    polygons : tuple of Polygon
    offset : tuple of float

    Raises
    ------
    InputError
        For anything that is no polygon; when the hierarchy is asked for, stated parents that are not there and circles
        of parents.

    Examples
    --------
    >>> scene = Scene([
    ...     Polygon([(0, 0), (4, 0), (4, 3), (0, 3)], label="bedroom", id="r1"),
    ...     Polygon([(0, 0), (2, 0), (2, 1), (0, 1)], label="bed", id="b1"),
    ... ])
    >>> scene.parent_of((1, 0.5)).id, [p.id for p in scene.members_of("r1")]
    ('b1', ['b1'])
    """

    def __init__(
        self, polygons: Iterable[Polygon], offset: tuple[float, float] = (0.0, 0.0), memory: Memory | None = None
    ) -> None:
        every = listed(polygons, "what the scene is made of", "a list of polygons")
        for p in every:
            if not isinstance(p, Polygon):
                raise InputError(
                    f"a scene is made of polygons, not of {type(p).__name__}; wrap the ring in Polygon(points, label=…)"
                )
        moved = [real(v) for v in listed(offset, "the scene's offset", "x and y")]
        if len(moved) != 2 or not np.isfinite(moved).all():
            raise InputError(f"the scene's offset is {shown(offset)}; give finite x and y")
        self.polygons: tuple[Polygon, ...] = _with_unique_ids(every)
        self._index: dict[str, int] = {str(p.id): i for i, p in enumerate(self.polygons)}
        self.offset = (moved[0], moved[1])
        self.memory = Memory() if memory is None else memory
        #: A scene whose polygons are the first of this one's; and of the latest scene that was grown from this one, the
        #: polygons and their overlaps: what is placed step by step is compared once.
        self._grown_from: Scene | None = None
        self._latest: tuple[tuple[Polygon, ...], Overlaps | None] = ((), None)

    def __repr__(self) -> str:
        return f"Scene({len(self.polygons)} polygons)"

    def __len__(self) -> int:
        return len(self.polygons)

    @cached_property
    def _hierarchy(self) -> tuple[NDArray[np.intp], list[list[int]]]:
        return find_parents(self.polygons, self._overlaps)

    @cached_property
    def _overlaps(self) -> Overlaps:
        if self._grown_from is None:
            return find_overlaps(self.polygons)
        found = find_overlaps(self.polygons, self._grown_from._overlaps_of_first(self.polygons))
        self._grown_from._latest = (self.polygons, found)
        return found

    def _overlaps_of_first(self, polygons: tuple[Polygon, ...]) -> Overlaps:
        """The overlaps of the first of some polygons that begin with this scene's."""
        known, overlaps = self._latest
        if overlaps is None or len(known) > len(polygons) or not all(map(operator.is_, known, polygons)):
            return self._overlaps
        return overlaps

    @cached_property
    def _tree(self) -> shapely.STRtree:
        return shapely.STRtree([p.shape for p in self.polygons])

    def polygon(self, id: str) -> Polygon:
        """The polygon of an id.

        Parameters
        ----------
        id : str

        Returns
        -------
        Polygon

        Raises
        ------
        InputError
            Where the scene has none of that id.
        """
        if str(id) not in self._index:
            raise InputError(
                f"the scene has no polygon {shown(id)}; it has {len(self.polygons)} polygons, check the id"
            )
        return self.polygons[self._index[str(id)]]

    def subset(self, ids: Iterable[str]) -> list[Polygon]:
        """The polygons of some ids, in the scene's order.

        Parameters
        ----------
        ids : iterable of str
            Of polygons that the scene has.

        Returns
        -------
        list of Polygon
        """
        return [self.polygons[i] for i in sorted({self._index[id] for id in ids})]

    def parent(self, id: str) -> Polygon | None:
        """The parent of a polygon, None at the top.

        Parameters
        ----------
        id : str

        Returns
        -------
        Polygon or None
        """
        i = self._hierarchy[0][self._index[str(self.polygon(id).id)]]
        return None if i < 0 else self.polygons[i]

    def members_of(self, id: str) -> list[Polygon]:
        """The children of a polygon and what straddles its boundary, in the scene's order.

        Parameters
        ----------
        id : str

        Returns
        -------
        list of Polygon
        """
        return [self.polygons[i] for i in self._hierarchy[1][self._index[str(self.polygon(id).id)]]]

    def parent_of(self, point: ArrayLike) -> Polygon | None:
        """The smallest polygon that contains a point; its boundary counts as inside.

        Parameters
        ----------
        point : array_like of shape (2,)

        Returns
        -------
        Polygon or None
        """
        place = points_of(point, "the coordinates of the point")
        if place.size != 2:
            raise InputError(f"the point is {shown(point)}; give its x and y")
        return self._smallest(self._tree.query(shapely.Point(place.ravel()), predicate="intersects"))

    def parent_of_shape(self, ring: ArrayLike, share: float) -> Polygon | None:
        """The smallest polygon that holds a share of a ring's area: the parent of an object by its footprint.

        Where parents are stated, a polygon with a stated parent that is nobody's parent is an object, not a place: a
        cabinet under a counter top that is stated to be in the kitchen stands in the kitchen.

        Parameters
        ----------
        ring : array_like of shape (n, 2)
            Outline in scene coordinates.
        share : float
            Between 0 and 1.

        Returns
        -------
        Polygon or None
        """
        if not 0 <= real(share) <= 1:
            raise InputError(f"the share of the outline is {shown(share)}; give a number from 0 to 1")
        shape = shapely.Polygon(clean_ring(ring, "the outline")[0])
        near = self._tree.query(shape)
        held = shapely.area(shapely.intersection(np.array([self.polygons[i].shape for i in near], dtype=object), shape))
        holding = near[held >= share * shape.area]
        return self._smallest(holding[[self._is_place(i) for i in holding]])

    def places(self) -> list[Polygon]:
        """The polygons that something can be placed in: all but those with a stated parent that are nobody's parent.

        Returns
        -------
        list of Polygon
        """
        return [p for i, p in enumerate(self.polygons) if self._is_place(i)]

    def _is_place(self, i: int) -> bool:
        return self.polygons[i].parent is None or bool(self._hierarchy[1][i])

    def _smallest(self, indices: NDArray[np.intp]) -> Polygon | None:
        return min((self.polygons[i] for i in np.sort(indices)), key=lambda p: p.area, default=None)

    def with_polygons(self, polygons: Sequence[Polygon]) -> "Scene":
        """A new scene with more polygons.

        Parameters
        ----------
        polygons : sequence of Polygon

        Returns
        -------
        Scene
        """
        more = listed(polygons, "what is added to the scene", "a list of polygons")
        scene = Scene([*self.polygons, *more], self.offset, self.memory)
        scene._grown_from = self
        return scene

    @cached_property
    def bounds(self) -> NDArray[np.float64]:
        """Smallest and largest x and y of all polygons: (x0, y0, x1, y1)."""
        if not self.polygons:
            raise InputError("the scene is empty; add polygons first")
        every = np.array([p.bounds for p in self.polygons])
        return np.hstack([every[:, :2].min(axis=0), every[:, 2:].max(axis=0)])

    def to_dict(self) -> dict[str, Any]:
        """Plain data, as it is written to JSON.

        Returns
        -------
        dict
            Arguments for `Scene`, its polygons as arguments for `Polygon`.
        """
        plain: dict[str, Any] = {"polygons": [p.to_dict() for p in self.polygons]}
        if any(self.offset):
            plain["offset"] = list(self.offset)
        return plain


def _with_unique_ids(polygons: tuple[Polygon, ...]) -> tuple[Polygon, ...]:
    """The polygons, copied where they or the parent they name need a new id."""
    stated = {p.id for p in polygons if p.id is not None}
    if len(stated) == len(polygons):
        return polygons
    used: dict[str, Polygon] = {}
    bearers: dict[str, list[str]] = {}
    unnamed = (f"polygon {k}" for k in itertools.count())
    for p in polygons:
        if p.id is None:
            used[next(n for n in unnamed if n not in stated)] = p
            continue
        same = bearers.setdefault(p.id, [])
        numbered = (f"{p.id}.{k:03d}" for k in itertools.count(max(len(same), 1)))
        name = p.id if not same else next(n for n in numbered if n not in stated and n not in used)
        same.append(name)
        used[name] = p
    result = []
    for name, p in used.items():
        parent = p.parent
        named = [k for k in bearers.get(parent, ()) if k != name] if parent is not None else []
        if len(named) > 1:
            held = [used[k].shape.intersection(p.shape).area for k in named]
            parent = named[int(np.argmax(held))]
        elif named:
            parent = named[0]
        if (name, parent) != (p.id, p.parent):
            p = copy.copy(p)
            p.id, p.parent = name, parent
        result.append(p)
    return tuple(result)
