"""Evaluating nodes, and keeping what they proposed until something that they read changes."""

import hashlib
from collections import OrderedDict
from collections.abc import Hashable, Sequence
from typing import Any

from ..errors import InputError
from ..geometry.frame import SPACE
from ..geometry.polygon import Polygon
from ..geometry.scene import Scene
from ..geometry.surface import GROUND, Surface
from ..progress import Stepper
from .element import Element
from .layout import Layout
from .node import Node
from .placing import UNNAMED, Placing, standing_on

#: Proposals that are kept: several states of a tree of a hundred nodes, each some kilobytes.
MOST_KEPT = 1024

#: The same on surfaces: the facades of a quarter of a city, each some 20 kilobytes.
MOST_KEPT_ON_SURFACES = 1 << 13


class Evaluations:
    """What nodes have proposed, by all that it depends on.

    May be shared by trees: what is found in it is what would be computed.

    Attributes
    ----------
    evaluated, reused : int
        How often a node was evaluated on the ground, and how often it was found here.
    surfaces_evaluated, surfaces_reused : int
        How often a node was evaluated on a surface, and how often what it proposes there was found here: on this
        surface or on an equal one.
    """

    def __init__(self) -> None:
        self.evaluated = self.reused = self.surfaces_evaluated = self.surfaces_reused = 0
        self._kept: OrderedDict[Hashable, Any] = OrderedDict()
        self._surfaces: OrderedDict[Hashable, Any] = OrderedDict()
        self._layouts: OrderedDict[Hashable, Layout] = OrderedDict()

    @property
    def hit_rate(self) -> float:
        """Share of the evaluations on surfaces that were found; 0 before any."""
        every = self.surfaces_evaluated + self.surfaces_reused
        return self.surfaces_reused / every if every else 0.0

    def leave_ground(self) -> None:
        """Forget what was proposed on the ground, which no other scene has; what equal surfaces share stays."""
        self._kept.clear()
        self._layouts.clear()

    def steps(self, node: Node, layout: Layout, seed: int) -> Stepper[tuple[Layout, ...]]:
        """Evaluate a node, as a stepper.

        Parameters
        ----------
        node : Node
        layout : Layout
            What comes in.
        seed : int
            The tree's.

        Returns
        -------
        generator of (float, str)
            Returns a layout per output.

        Raises
        ------
        InputError
            What the operation raised, with the node's name before it.
        """
        if node.muted:
            return (layout,) * node.operation.outputs
        try:
            proposed = yield from self.proposal(node, layout, seed)
            return node.operation.decide(proposed, layout, node.id)
        except InputError as error:
            raise InputError(f"node {node.id!r}: {error}") from None

    def proposal(self, node: Node, layout: Layout, seed: int) -> Stepper[Any]:
        """What a node proposes, computed only where it is not kept, as a stepper.

        Parameters
        ----------
        node : Node
        layout : Layout
            What comes in.
        seed : int
            The tree's.

        Returns
        -------
        generator of (float, str)
            Returns what the operation's `propose` returned; of one that places, on the ground and on all surfaces.
        """
        own_seed = node_seed(seed, node.id)
        name = Known((node.id, own_seed if node.operation.random else None, node.operation.content(layout)))
        if name in self._kept:
            self.reused += 1
            self._kept.move_to_end(name)
        else:
            proposed = yield from node.operation.propose(layout, node.id, own_seed)
            self.evaluated += 1
            _keep(self._kept, name, proposed, MOST_KEPT)
        if not isinstance(node.operation, Placing):
            return self._kept[name]
        found = list(self._kept[name])
        for surface in layout.surfaces(node.operation.places_in):
            placed = yield from self._on_surface(node, node.operation, layout, surface, seed)
            found += [standing_on(surface, e) for e in placed]
        return tuple(found)

    def _on_surface(
        self, node: Node, operation: Placing, layout: Layout, surface: Surface, seed: int
    ) -> Stepper[tuple[Element, ...]]:
        """What an operation places on a surface, which is the same on all that are equal up to a rigid motion."""
        there = self._unnamed(surface, layout.elements_on(surface), layout)
        own_seed = node_seed(seed, f"{node.id}\0{surface.id}")
        name = Known((node.id, own_seed if operation.random else None, operation.content(there)))
        if name in self._surfaces:
            self.surfaces_reused += 1
            self._surfaces.move_to_end(name)
        else:
            proposed = yield from operation.propose(there, node.id, own_seed)
            self.surfaces_evaluated += 1
            _keep(self._surfaces, name, proposed, MOST_KEPT_ON_SURFACES)
        found: tuple[Element, ...] = self._surfaces[name]
        return found

    def _unnamed(self, surface: Surface, elements: Sequence[Element], layout: Layout) -> Layout:
        """A surface and what stands on it, without the surface's name and place."""
        twins = tuple(_twin(e, surface) for e in elements)
        name = Known((surface.label, tuple(ring.tobytes() for ring in surface.polygon.rings), twins))
        if name not in self._layouts:
            outline = Polygon(
                surface.polygon.points, surface.label, UNNAMED, surface.polygon.holes, None, surface.polygon.orientation
            )
            _keep(self._layouts, name, Layout(Scene([outline], memory=layout.ground.memory), twins), MOST_KEPT)
        self._layouts.move_to_end(name)
        return self._layouts[name]


def _twin(element: Element, surface: Surface) -> Element:
    """An element as it stands on an unnamed surface."""
    if element.twin is not None:
        return element.twin
    return element.changed(
        parent=element.parent.replace(element.surface, UNNAMED),
        key=element.key.replace(element.surface, UNNAMED),
        surface=GROUND,
        owner="",
        frame=SPACE,
        base=None,
        changes=(),
        solid=None,
        absorbed_by="",
    )


class Known:
    """A name that is hashed once: what a node reads may be thousands of elements.

    Parameters
    ----------
    name : hashable
    """

    __slots__ = ("_hash", "name")

    def __init__(self, name: Hashable) -> None:
        self.name = name
        self._hash = hash(name)

    def __hash__(self) -> int:
        return self._hash

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Known) and self._hash == other._hash and self.name == other.name


def _keep(kept: OrderedDict[Hashable, Any], name: Hashable, value: Any, most: int) -> None:
    kept[name] = value
    if len(kept) > most:
        kept.popitem(last=False)


def node_seed(seed: int, node: str) -> int:
    """The seed of one node: it depends on the tree's seed and the node's id, and on no other node.

    Parameters
    ----------
    seed : int
    node : str

    Returns
    -------
    int
        64 bits.
    """
    return int.from_bytes(hashlib.sha256(f"{seed}\0{node}".encode()).digest()[:8], "big")
