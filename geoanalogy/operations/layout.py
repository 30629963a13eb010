"""Layouts: a scene and the elements placed on it so far, which is what flows along the links of an operations tree."""

import re
from collections import defaultdict
from collections.abc import Callable, Collection, Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, TypeVar

from ..geometry.polygon import Polygon
from ..geometry.scene import Scene
from ..geometry.surface import GROUND, Surface
from .changes import changed, joined
from .element import Element

Derived = TypeVar("Derived")


@dataclass(frozen=True)
class Layout:
    """What an operation gets and what it leaves behind.

    Attributes
    ----------
    ground : Scene
        The scene that the tree is applied to.
    elements : tuple of Element
        What the operations upstream have placed.
    aside : frozenset of str
        Ids of polygons, elements and surfaces that this branch of the tree does not see, nor what stands on them.
    problems : tuple of str
        What could not be done upstream, a sentence each.
    chosen : tuple of Surface
        Surfaces that the user has chosen, besides those of solids.
    """

    ground: Scene
    elements: tuple[Element, ...] = ()
    aside: frozenset[str] = frozenset()
    problems: tuple[str, ...] = ()
    chosen: tuple[Surface, ...] = ()

    @cached_property
    def scene(self) -> Scene:
        """The ground's polygons, and the elements on it as labelled polygons after them, as far as the branch sees."""
        seen = [e.polygon for e in self.visible if e.surface == GROUND and e.polygon is not None]
        if not self.aside:
            return self.ground.with_polygons(seen) if seen else self.ground
        own = [p for p in self.ground.polygons if p.id not in self._hidden]
        return Scene([*own, *seen], self.ground.offset, self.ground.memory)

    @cached_property
    def _hidden(self) -> set[str]:
        """What is set aside, and the polygons of the ground below it."""
        hidden = set(self.aside)
        for polygon in self.ground.polygons:
            above: Polygon | None = polygon
            while above is not None and above.id not in hidden:
                above = self.ground.parent(str(above.id))
            if above is not None:
                hidden.add(str(polygon.id))
        return hidden

    @cached_property
    def visible(self) -> tuple[Element, ...]:
        """The elements that this branch sees."""
        if not self.aside:
            return self.elements
        hidden = set(self._hidden)
        seen = []
        for e in self.elements:
            if not hidden.isdisjoint((e.id, e.parent, e.surface, e.owner)):
                hidden.add(e.id)
            else:
                seen.append(e)
        return tuple(seen)

    @cached_property
    def by_id(self) -> dict[str, Element]:
        """All elements by their ids."""
        return {e.id: e for e in self.elements}

    @cached_property
    def polygon_ids(self) -> frozenset[str]:
        """Ids of the polygons of the scene."""
        return frozenset(str(p.id) for p in self.scene.polygons)

    def derived(self, name: Hashable, derive: Callable[[], Derived]) -> Derived:
        """What an operation makes of the layout more than once: to see whether it has changed, and to work on.

        Parameters
        ----------
        name : hashable
        derive : callable

        Returns
        -------
        object
        """
        if name not in self._derived:
            self._derived[name] = derive()
        found: Derived = self._derived[name]
        return found

    @cached_property
    def _derived(self) -> dict[Hashable, Any]:
        return {}

    @cached_property
    def on(self) -> dict[str, list[Element]]:
        """The elements that this branch sees, by their surface."""
        found = defaultdict(list)
        for e in self.visible:
            found[e.surface].append(e)
        return dict(found)

    def surfaces(self, labels: Collection[str] | None = None) -> Iterator[Surface]:
        """The surfaces that this branch sees: those chosen by the user, then those of solids.

        Parameters
        ----------
        labels : collection of str, optional
            Only those of such a label, or that hold an element of such a label.

        Yields
        ------
        Surface
        """
        holding = defaultdict(set)
        if labels is not None:
            for elements in self.on.values():
                if any(e.label in labels for e in elements):
                    owner, name = self._face_of(elements[0])
                    holding[owner].add(name)
        for surface in self.chosen:
            there = self.on.get(surface.id, ())
            wanted_here = labels is None or surface.label in labels or any(e.label in labels for e in there)
            if wanted_here and surface.id not in self.aside:
                yield surface
        for e in self.visible:
            if e.solid is None or e.absorbed_by:
                continue
            wanted = e.solid.by_label if labels is None else labels
            faces = {i for label in wanted for i in e.solid.by_label.get(label, ())}
            faces |= {i for name in holding[e.id] if (i := e.solid.by_name.get(name)) is not None}
            for surface in e.solid.surfaces(e.id, e.place, faces):
                if surface.id not in self.aside:
                    yield surface

    def _face_of(self, element: Element) -> tuple[str, str]:
        """Id of the element whose face an element stands on, and the name of the face there."""
        owner = self.by_id.get(element.owner)
        if owner is None:
            return "", ""
        name = re.sub(r"#\d+$", "", element.surface[len(owner.id) + 1 :])
        while owner.absorbed_by in self.by_id:
            name = f"{owner.id}:{name}"
            owner = self.by_id[owner.absorbed_by]
        return owner.id, name

    def standing_on(self, element: Element) -> tuple[Element, str] | None:
        """The solid that an element stands on, and the name of the face.

        Parameters
        ----------
        element : Element

        Returns
        -------
        (Element, str) or None
            None on the ground.
        """
        owner, name = self._face_of(element)
        return (self.by_id[owner], name) if owner else None

    def elements_on(self, surface: Surface) -> list[Element]:
        """The elements on a surface that this branch sees.

        Parameters
        ----------
        surface : Surface

        Returns
        -------
        list of Element
        """
        # What has become a part of another solid has kept the names of its surfaces there.
        inner = surface.id[len(surface.parent) + 1 :]
        return [*self.on.get(surface.id, ()), *self.on.get(inner, ())]

    def surface_under(self, element: Element) -> Surface | None:
        """The surface that an element stands on.

        Parameters
        ----------
        element : Element

        Returns
        -------
        Surface or None
            None on the ground, and where the surface is no longer there.
        """
        owner, name = self._face_of(element)
        solid = self.by_id[owner].solid if owner else None
        if solid is None:
            return next((s for s in self.chosen if s.id == element.surface), None)
        there = solid.surfaces(owner, self.by_id[owner].place, [solid.by_name[name]] if name in solid.by_name else [])
        return next((s for s in there if s.id.endswith(element.surface)), there[0] if there else None)

    def with_elements(self, elements: Iterable[Element]) -> "Layout":
        """The layout with more elements, or with others of the same ids.

        Parameters
        ----------
        elements : iterable of Element

        Returns
        -------
        Layout
        """
        given = {e.id: e for e in elements}
        kept = (
            tuple(given.pop(e.id, e) for e in self.elements) if any(i in self.by_id for i in given) else self.elements
        )
        made = replace(self, elements=(*kept, *given.values()))
        if "scene" in self.__dict__ and not any(e.surface == GROUND for e in given.values()):
            made.__dict__["scene"] = self.scene
        return made

    def without(self, ids: Iterable[str]) -> "Layout":
        """The layout for a branch that sees less.

        Parameters
        ----------
        ids : iterable of str
            Of polygons, elements and surfaces.

        Returns
        -------
        Layout
        """
        more = self.aside.union(ids)
        return self if more == self.aside else replace(self, aside=more)

    def with_problems(self, problems: Iterable[str]) -> "Layout":
        """The layout with more problems.

        Parameters
        ----------
        problems : iterable of str

        Returns
        -------
        Layout
        """
        more = tuple(p for p in dict.fromkeys(problems) if p not in self.problems)
        if not more:
            return self
        made = replace(self, problems=(*self.problems, *more))
        if "scene" in self.__dict__:
            made.__dict__["scene"] = self.scene
        return made


@dataclass(frozen=True)
class OnSurface(Layout):
    """One surface as a scene of its own.

    Attributes
    ----------
    surface : Surface
    standing : tuple of Element
        What stands on it.
    """

    surface: Surface | None = None
    standing: tuple[Element, ...] = ()

    @cached_property
    def scene(self) -> Scene:
        """The surface's outline and the elements on it, in the coordinates of its frame."""
        outline = [] if self.surface is None else [self.surface.polygon]
        seen = [e.polygon for e in self.standing if e.polygon is not None]
        return Scene([*outline, *seen], memory=self.ground.memory)


def merge(ground: Scene, layouts: Sequence[Layout], rank: Mapping[str, int]) -> Layout:
    """The layout that holds what several branches have placed, every element once.

    Parameters
    ----------
    ground : Scene
    layouts : sequence of Layout
        One per incoming link.
    rank : mapping of str to int
        Place of every node in the tree's order. Elements are put in this order, so that it does not matter in which
        order branches are linked or evaluated; of an element that several branches have changed, all changes are made,
        in this order.

    Returns
    -------
    Layout
        What one of the branches sees is seen.
    """
    if len(layouts) == 1:
        return layouts[0]
    every: dict[str, Element] = {}
    for layout in layouts:
        for e in layout.elements:
            known = every.get(e.id)
            every[e.id] = e if known is None or known == e else _merged(known, e, rank, ground)
    aside = frozenset.intersection(*(layout.aside for layout in layouts))
    problems = tuple(dict.fromkeys(p for layout in layouts for p in layout.problems))
    chosen = layouts[0].chosen
    return Layout(ground, tuple(sorted(every.values(), key=lambda e: rank[e.node])), aside, problems, chosen)


def _merged(one: Element, other: Element, rank: Mapping[str, int], ground: Scene) -> Element:
    """An element that two branches have changed, with the changes of both."""
    further = max(one, other, key=lambda e: (e.absorbed_by != "", e.base is not None, len(e.changes)))
    base = further.base
    if base is None or base not in (one.base, other.base) or one.changes == other.changes:
        return further
    changes = tuple(sorted(joined(one.changes, other.changes), key=lambda c: rank[c.node]))
    return further.changed(changes=changes, solid=changed(base, changes, ground.memory))
