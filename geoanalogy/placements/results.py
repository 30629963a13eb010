"""What placing gives."""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property

import shapely

from ..geometry.polygon import Polygon
from ..geometry.rectangle import Rectangle
from .rule import Relation


@dataclass(frozen=True)
class Placement:
    """One result.

    Attributes
    ----------
    rectangle : Rectangle
        In the scene's coordinates; its width runs along its angle as the examples' do.
    score : float
        1 for an example, 0 for what resembles none; comparable between scenes.
    parent : Polygon
    novelty : float
        How far from anything that was taught, 0 to 1: where it is large, an example more would help.
    why : callable
        Finds out why it is here, when somebody asks for its `relations`.
    """

    rectangle: Rectangle
    score: float
    parent: Polygon
    novelty: float
    why: Callable[[], tuple[Relation, ...]] = field(default=tuple, compare=False, repr=False)

    @cached_property
    def relations(self) -> tuple[Relation, ...]:
        """Why it is here: the elements it stands to as examples do, with weights, the surest first."""
        return self.why()


def told(why: Callable[[], list[tuple[Relation, ...]]], number: int) -> tuple[Relation, ...]:
    """The relations of one of several results, which are found out for all at once.

    Parameters
    ----------
    why : callable
        Gives the relations of all.
    number : int

    Returns
    -------
    tuple of Relation
    """
    return why()[number]


def disjoint(found: list[Placement], allowed: float) -> list[Placement]:
    """Placements of different frames without overlaps.

    Parameters
    ----------
    found : list of Placement
    allowed : float
        Share of the smaller of two that they may share.

    Returns
    -------
    list of Placement
        The best first.
    """
    kept: list[Placement] = []
    shapes: list[shapely.Polygon] = []
    for placement in sorted(found, key=lambda p: -p.score):
        shape = shapely.Polygon(placement.rectangle.ring)
        if all(shapely.area(shapely.intersection(shape, s)) <= allowed * min(shape.area, s.area) for s in shapes):
            kept.append(placement)
            shapes.append(shape)
    return kept
