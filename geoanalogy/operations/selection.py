"""Selection: branches of the tree that see only some of the elements (section 5.6)."""

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np

from ..errors import InputError
from ..geometry.polygon import Polygon
from ..progress import Stepper
from .chance import share
from .layout import Layout
from .operation import Operation
from .settings import number, one_of, stored, text, whole


def _read_weights(value: Any) -> tuple[float, ...]:
    return tuple(number(weight) for weight in value)


@dataclass(frozen=True, kw_only=True)
class Selection(Operation):
    """Divide the elements, polygons and surfaces of a label among branches, by chance; or leave the others out.

    A branch sees those of its own set and what stands on them, and everything of other labels. Where branches are
    merged, what one of them sees is seen; nothing is lost in the end, so that an output that nothing follows makes the
    other an optional branch.

    Attributes
    ----------
    label : str
        Of what is divided.
    weights : tuple of float
        One set per weight, of the shares that they have among each other. One weight alone below 1: the share of those
        that are in the set.
    within : str
        "each": each draws its own set; "parent": those of one parent are put in random order and cut by the weights, so
        that the shares hold there as well as they can.
    seed : int
        For another division by this operation alone.
    """

    type = "selection"
    random = True

    label: str = field(metadata=stored(text))
    weights: tuple[float, ...] = field(default=(1.0,), metadata=stored(_read_weights, list))
    within: Literal["each", "parent"] = field(default="each", metadata=stored(one_of("each", "parent")))
    seed: int = field(default=0, metadata=stored(whole))

    def __post_init__(self) -> None:
        if not self.weights or min(self.weights) < 0.0 or not sum(self.weights) > 0.0:
            raise InputError(f"the weights are {list(self.weights)}; give one positive number per set")

    @property
    def outputs(self) -> int:  # type: ignore[override]
        """One per set."""
        return len(self.weights)

    def propose(self, layout: Layout, node: str, seed: int) -> Stepper[dict[str, int]]:
        """The set of everything of the label; -1 for none."""
        yield 0.0, f"dividing {self.label}"
        seed ^= self.seed
        limits = np.cumsum(self.weights) / max(sum(self.weights), 1.0 if len(self.weights) == 1 else 0.0)
        groups: defaultdict[str, list[str]] = defaultdict(list)
        for id, parent in self._candidates(layout):
            groups[parent].append(id)
        drawn = {}
        for ids in groups.values():
            lots = {id: share(seed, id) for id in ids}
            if self.within == "parent":
                # A random number before the first keeps what is rounded from always falling to the same set.
                order = sorted(ids, key=lambda id: (lots[id], id))
                start = share(seed, "\0".join(sorted(ids)))
                lots = {id: (k + start) / len(ids) for k, id in enumerate(order)}
            for id, lot in lots.items():
                place = int(np.searchsorted(limits, lot, side="right"))
                drawn[id] = place if place < len(limits) else -1
        return drawn

    def _candidates(self, layout: Layout) -> Iterator[tuple[str, str]]:
        """Ids of all of the label, and of the parents within which they are divided."""
        seen = {e.id for e in layout.visible}
        for e in layout.visible:
            if e.label == self.label:
                yield e.id, e.parent
        for polygon in layout.scene.polygons:
            if polygon.label == self.label and polygon.id not in seen:
                yield str(polygon.id), _parent(layout, polygon)
        for surface in layout.surfaces({self.label}):
            if surface.label == self.label:
                yield surface.id, surface.parent

    def decide(self, proposed: dict[str, int], layout: Layout, node: str) -> tuple[Layout, ...]:
        """A layout per set, which leaves aside what is in the others."""
        return tuple(
            layout.without(id for id, drawn in proposed.items() if drawn != k) for k in range(len(self.weights))
        )

    def content(self, layout: Layout) -> tuple[object, ...]:  # type: ignore[override]
        """The settings, and what is divided."""
        return (self._lesson, *self._candidates(layout))


def _parent(layout: Layout, polygon: Polygon) -> str:
    parent = layout.scene.parent(str(polygon.id))
    return "" if parent is None else str(parent.id)
