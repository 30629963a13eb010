"""Layouts: a scene and the elements placed on it so far, which is what flows along the links of an operations tree."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from ..geometry.scene import Scene
from .element import Element


@dataclass(frozen=True)
class Layout:
    """What an operation gets and what it leaves behind.

    Attributes
    ----------
    ground : Scene
        The scene that the tree is applied to.
    elements : tuple of Element
        What the operations upstream have placed.
    """

    ground: Scene
    elements: tuple[Element, ...] = ()

    @cached_property
    def scene(self) -> Scene:
        """The ground's polygons, and the elements as labelled polygons after them."""
        return self.ground.with_polygons([e.polygon for e in self.elements if e.polygon is not None])

    def with_elements(self, elements: Iterable[Element]) -> "Layout":
        """The layout with more elements.

        Parameters
        ----------
        elements : iterable of Element

        Returns
        -------
        Layout
        """
        return replace(self, elements=(*self.elements, *elements))


def merge(ground: Scene, layouts: Sequence[Layout], rank: Mapping[str, int]) -> Layout:
    """The layout that holds what several branches have placed, every element once.

    Parameters
    ----------
    ground : Scene
    layouts : sequence of Layout
        One per incoming link.
    rank : mapping of str to int
        Place of every node in the tree's order. Elements are put in this order, so that it does not matter in which
        order branches are linked or evaluated.

    Returns
    -------
    Layout
    """
    if len(layouts) == 1:
        return layouts[0]
    every = {e.id: e for layout in layouts for e in layout.elements}
    return Layout(ground, tuple(sorted(every.values(), key=lambda e: rank[e.node])))
