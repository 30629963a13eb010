"""Levels of detail: how far down the surfaces an operations tree is applied."""

from collections.abc import Callable
from dataclasses import replace
from typing import Literal, get_args

from ..operations.boolean import Boolean
from ..operations.extrusion import Extrusion
from ..operations.node import Node
from ..operations.placing import Placing
from ..operations.tree import OperationsTree

#: "mass": what stands on the ground; "facade": and what lies on the surfaces of that, such as windows and doors;
#: "full": and what lies on the surfaces of those, such as sills and bars.
Detail = Literal["mass", "facade", "full"]

DETAILS: tuple[str, ...] = get_args(Detail)


def simplified(tree: OperationsTree, detail: Detail) -> OperationsTree:
    """The tree that leaves out what is finer than a level of detail.

    The rest comes out as it does with all details: chance goes by names, and nothing depends on what stands on it.

    Parameters
    ----------
    tree : OperationsTree
    detail : {"mass", "facade", "full"}

    Returns
    -------
    OperationsTree
        Its finer nodes are muted.
    """
    if detail == "full":
        return tree
    most = DETAILS.index(detail)
    levels = depths(tree)
    nodes = (replace(n, muted=True) if levels[n.id] > most else n for n in tree.nodes)
    return OperationsTree(nodes, tree.evaluations)


def depths(tree: OperationsTree) -> dict[str, int]:
    """How many solids lie between the ground and what each node works on.

    Parameters
    ----------
    tree : OperationsTree

    Returns
    -------
    dict of str to int
        By the id of the node: 0 on the ground, 1 on what was extruded there, and so on. Selections, which make
        nothing, have 0.
    """
    elements: dict[str, int] = {}
    surfaces: dict[str, int] = {}

    def depth(label: str) -> int:
        if label in elements:
            return elements[label]
        # A side that faces a labelled edge has the label of that edge in front: "street wall".
        known = [d for name, d in surfaces.items() if label == name or label.endswith(f" {name}")]
        return max(known, default=0)

    found = {}
    for node in tree.nodes:
        found[node.id] = _depth(node, depth)
        if isinstance(node.operation, Placing):
            for label in _placed(node.operation):
                elements[label] = max(elements.get(label, 0), found[node.id])
        elif isinstance(node.operation, Extrusion):
            faces = node.operation.faces
            for label in (faces.side, faces.top, faces.bottom, faces.roof, faces.gable):
                surfaces[label] = max(surfaces.get(label, 0), found[node.id] + 1)
    return found


def _depth(node: Node, depth: Callable[[str], int]) -> int:
    operation = node.operation
    if isinstance(operation, Placing):
        return max((depth(label) for label in operation.places_in or ()), default=0)
    if isinstance(operation, Extrusion | Boolean):
        return depth(operation.label)
    return 0


def _placed(operation: Placing) -> tuple[str, ...]:
    """Labels of what an operation places."""
    one = getattr(operation, "label", None)
    return (one,) if isinstance(one, str) else tuple(getattr(operation, "labels", ()))
