"""Editing sessions: what is recorded in one is a tree of its own, though it was drawn on what others have built."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import geoanalogy as ga
from geoanalogy.operations.node import Link

from ..houses.recorder import Recorder


class Session(Recorder):
    """A recorder that goes on after a tree that another session has made.

    Attributes
    ----------
    before : frozenset of str
        Ids of the nodes of that tree.
    """

    def __init__(self, scene: ga.Scene, tree: ga.OperationsTree, at: Sequence[Link]) -> None:
        super().__init__(scene)
        self.tree, self.at = tree, tuple(at)
        self.before = frozenset(node.id for node in tree.nodes)

    @property
    def recorded(self) -> ga.OperationsTree:
        """What this session has recorded, to be grown onto any tree that makes the same surfaces."""
        own = [node for node in self.tree.nodes if node.id not in self.before]
        return ga.OperationsTree(
            [replace(n, inputs=tuple(link for link in n.inputs if link.node not in self.before)) for n in own]
        )
