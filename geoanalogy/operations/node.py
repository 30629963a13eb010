"""Nodes: an operation, where its input comes from, and whether it is muted."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ..errors import InputError
from .operation import Operation
from .table import OPERATIONS


@dataclass(frozen=True)
class Link:
    """A link into a node: one output of another.

    Attributes
    ----------
    node : str
        Id of the node that it comes from.
    output : int
        Which of its outputs.
    """

    node: str
    output: int = 0


@dataclass(frozen=True)
class Node:
    """One step of the tree.

    Attributes
    ----------
    id : str
        Its name in the tree; elements and chance refer to it.
    operation : Operation
    inputs : tuple of Link
        None: it gets the scene as it is. Several: what all of them have placed.
    muted : bool
        Whether it passes on what comes in.
    """

    id: str
    operation: Operation
    inputs: tuple[Link, ...] = ()
    muted: bool = False

    def to_dict(self) -> dict[str, Any]:
        """Plain data, as it is written to JSON.

        Returns
        -------
        dict
            A link to a first output is the node's id alone.
        """
        links = [k.node if k.output == 0 else {"node": k.node, "output": k.output} for k in self.inputs]
        return {
            "id": self.id,
            "type": self.operation.type,
            "inputs": links,
            "muted": self.muted,
            "settings": self.operation.to_dict(),
        }

    @classmethod
    def from_dict(cls, plain: Any) -> "Node":
        """The node that `to_dict` wrote.

        Parameters
        ----------
        plain : mapping

        Returns
        -------
        Node

        Raises
        ------
        InputError
            For an unknown type, and for anything missing or damaged.
        """
        if not isinstance(plain, Mapping) or not isinstance(plain.get("id"), str):
            raise InputError("a node has no id; give it one")
        name, kind = plain["id"], plain.get("type")
        if not isinstance(kind, str) or kind not in OPERATIONS:
            raise InputError(
                f"node {name!r} is of the unknown type {kind!r}; it may come from a newer version, known are "
                + ", ".join(OPERATIONS)
            )
        try:
            operation = OPERATIONS[kind].from_dict(plain.get("settings", {}))
        except InputError as error:
            raise InputError(f"node {name!r}: {error}") from None
        inputs = plain.get("inputs", [])
        try:
            links = tuple(Link(k) if isinstance(k, str) else Link(str(k["node"]), int(k["output"])) for k in inputs)
        except (TypeError, KeyError, ValueError):
            raise InputError(f"node {name!r} has a damaged input; link it again") from None
        return cls(name, operation, links, bool(plain.get("muted", False)))
