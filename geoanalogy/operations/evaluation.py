"""Evaluating nodes, and keeping what they proposed until something that they read changes."""

import hashlib
from collections import OrderedDict
from collections.abc import Hashable
from typing import Any

from ..errors import InputError
from ..progress import Stepper
from .layout import Layout
from .node import Node

#: Proposals that are kept: several states of a tree of a hundred nodes, each some kilobytes.
MOST_KEPT = 1024


class Evaluations:
    """What nodes have proposed, by all that it depends on.

    May be shared by trees: what is found in it is what would be computed.

    Attributes
    ----------
    evaluated, reused : int
        How often a node was evaluated, and how often it was found here.
    """

    def __init__(self) -> None:
        self.evaluated = 0
        self.reused = 0
        self._kept: OrderedDict[Hashable, Any] = OrderedDict()

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
            Returns what the operation's `propose` returned.
        """
        own_seed = node_seed(seed, node.id)
        name = (node.id, own_seed if node.operation.random else None, node.operation.content(layout))
        if name in self._kept:
            self.reused += 1
            self._kept.move_to_end(name)
        else:
            proposed = yield from node.operation.propose(layout, node.id, own_seed)
            self.evaluated += 1
            self._kept[name] = proposed
            if len(self._kept) > MOST_KEPT:
                self._kept.popitem(last=False)
        return self._kept[name]


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
