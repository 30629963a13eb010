"""Boolean operations: solids are merged with or subtracted from what they stand on or beside (section 5.6)."""

from collections.abc import Hashable
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from ..errors import InputError
from ..geometry.boolean import Kind
from ..geometry.frame import Frame
from ..geometry.solid import Solid
from ..progress import Stepper
from .changes import Change, changed
from .element import Element
from .layout import Layout
from .operation import Operation
from .settings import one_of, stored, text


@dataclass(frozen=True, kw_only=True)
class Boolean(Operation):
    """Merge elements with their surface, or with what they intersect there, or subtract them from it.

    Attributes
    ----------
    label : str
        Of the elements, which have been extruded.
    kind : str
        "merge" or "subtract".
    target : str
        "surface": the solid that they stand on; "siblings": the solids on the same surface that they intersect. What
        siblings are merged becomes the first of them.
    """

    type = "boolean"

    label: str = field(metadata=stored(text))
    kind: Kind = field(default="merge", metadata=stored(one_of("merge", "subtract")))
    target: Literal["surface", "siblings"] = field(default="surface", metadata=stored(one_of("surface", "siblings")))

    def propose(self, layout: Layout, node: str, seed: int) -> Stepper[tuple[tuple[Element, ...], tuple[str, ...]]]:
        """The changed elements, and what could not be combined."""
        work = self._by_sibling(layout) if self.target == "siblings" else self._by_surface(layout)
        made: dict[str, Element] = {}
        problems = []
        for i, (whole, groups) in enumerate(work):
            if i % 16 == 0:
                yield i / len(work), f"combining {self.label} {i + 1} of {len(work)}"
            element = made.get(whole.id, whole)
            parts = [e for group in groups.values() for e in group]
            try:
                assert element.base is not None
                standing = tuple((face, tuple(_standing(e, element) for e in group)) for face, group in groups.items())
                changes = (*element.changes, Change(node, self.kind, standing))
                solid = changed(element.base, changes, layout.ground.memory)
            except InputError as error:
                problems.append(f"node {node!r}: {self.label} {parts[0].id!r} is left as it is: {error}")
                continue
            made[whole.id] = element.changed(changes=changes, solid=solid)
            for e in parts:
                made.setdefault(e.id, e.changed(absorbed_by=whole.id))
        return tuple(made.values()), tuple(problems)

    def _solids(self, layout: Layout) -> list[Element]:
        return [e for e in layout.visible if e.label == self.label and e.solid is not None and not e.absorbed_by]

    def _by_surface(self, layout: Layout) -> list[tuple[Element, dict[str, list[Element]]]]:
        """The solids that elements of the label stand on, and these by the name of the face."""
        found: dict[str, dict[str, list[Element]]] = {}
        for e in self._solids(layout):
            there = layout.standing_on(e)
            if there is not None:
                found.setdefault(there[0].id, {}).setdefault(there[1], []).append(e)
        return [(layout.by_id[owner], groups) for owner, groups in found.items()]

    def _by_sibling(self, layout: Layout) -> list[tuple[Element, dict[str, list[Element]]]]:
        """The solids that are changed, and those that change them."""
        gone: set[str] = set()
        found = []
        for e in self._solids(layout):
            if e.id in gone:
                continue
            touched = [
                other
                for other in layout.on.get(e.surface, ())
                if other.id != e.id and other.id not in gone and other.solid is not None and not other.absorbed_by
                if _meet(e, other)
            ]
            if touched and self.kind == "merge":
                gone |= {other.id for other in touched}
                found.append((e, {"": touched}))
            elif self.kind == "subtract":
                found += [(other, {"": [e]}) for other in touched]
        return found

    def decide(self, proposed: tuple[tuple[Element, ...], tuple[str, ...]], layout: Layout, node: str) -> tuple[Layout]:
        """The layout with the changed solids."""
        elements, problems = proposed
        return (layout.with_elements(elements).with_problems(problems),)

    def content(self, layout: Layout) -> tuple[Hashable, ...]:
        """The settings, the elements, and the solids that they meet."""
        work = self._by_sibling(layout) if self.target == "siblings" else self._by_surface(layout)
        return (
            self._lesson,
            *((whole, tuple((face, tuple(group)) for face, group in groups.items())) for whole, groups in work),
        )


def _standing(element: Element, whole: Element) -> tuple[Solid, Frame]:
    """The solid of an element, its faces named after it, and where it stands in the coordinates of another one's."""
    assert element.solid is not None
    return element.solid.renamed(element.id), element.place.seen_from(whole.place)


def _meet(one: Element, other: Element) -> bool:
    """Whether the solids of two elements on one surface intersect or touch, by their outlines and heights."""
    if one.polygon is None or other.polygon is None or one.solid is None or other.solid is None:
        return False
    heights = [(s.vertices[:, 2].min(), s.vertices[:, 2].max()) for s in (one.solid, other.solid)]
    (low, high), (least, most) = heights
    near = one.polygon.shape.distance(other.polygon.shape) <= 1e-6 * one.polygon.size
    return bool(near and np.minimum(high, most) >= np.maximum(low, least))
