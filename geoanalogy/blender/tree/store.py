"""The operations tree of a scene: between Blender's node tree and the engine's `OperationsTree`.

A node carries its operation (`names.OPERATION`: schema, type, settings), the objects it places (`names.EXAMPLES`, with
how each rests on its pose, and those that were examples of a placement), the frame of its plane, and what it has
proposed. Links are the tree; a node's name is its
id, and its mute switch is the engine's.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from ...errors import InputError
from ...operations.boolean import Boolean
from ...operations.evaluation import Evaluations
from ...operations.extrusion import Extrusion
from ...operations.node import Link, Node
from ...operations.operation import Operation
from ...operations.pose_placement import PosePlacement
from ...operations.rectangle_placement import RectanglePlacement
from ...operations.region_transfer import RegionTransfer
from ...operations.selection import Selection
from ...operations.tree import OperationsTree
from .. import names
from ..reading.planes import Plane
from .plain import from_property

Array = NDArray[np.float64]

#: The types of operations that make solids and surfaces, or choose among them.
BUILDING = {Extrusion.type, Boolean.type, Selection.type}


@dataclass(frozen=True)
class Placed:
    """An object that an operation places.

    Attributes
    ----------
    mesh : str
        Its name in the operation.
    item : bpy.types.Object or None
        None where it is no longer in the file.
    rest : ndarray of shape (4, 4)
        How it rests on the frame of a pose.
    target : float or None
        How much it is wanted as an example of a placement; None where it is none.
    """

    mesh: str
    item: bpy.types.Object | None
    rest: Array
    target: float | None = None


def tree_of(scene: bpy.types.Scene) -> bpy.types.NodeTree | None:
    """The operations tree of a scene.

    Parameters
    ----------
    scene : bpy.types.Scene

    Returns
    -------
    bpy.types.NodeTree or None
        The one chosen; else the file's only one, as after appending it.
    """
    if scene.geoanalogy.tree is not None:
        return scene.geoanalogy.tree
    every = [tree for tree in bpy.data.node_groups if tree.bl_idname == names.TREE]
    used = {other.geoanalogy.tree for other in bpy.data.scenes}
    free = [tree for tree in every if tree not in used]
    return free[0] if len(free) == 1 else None


def ensure_tree(scene: bpy.types.Scene) -> bpy.types.NodeTree:
    """The operations tree of a scene, made where there is none.

    Parameters
    ----------
    scene : bpy.types.Scene

    Returns
    -------
    bpy.types.NodeTree
        It has a fake user, or Blender would not write it.
    """
    tree = tree_of(scene)
    if tree is None:
        tree = bpy.data.node_groups.new(f"{scene.name} operations", names.TREE)
    tree.use_fake_user = True
    scene.geoanalogy.tree = tree
    return tree


def recorded_nodes(tree: bpy.types.NodeTree | None) -> list[bpy.types.Node]:
    """The nodes that carry an operation.

    Parameters
    ----------
    tree : bpy.types.NodeTree or None

    Returns
    -------
    list of bpy.types.Node
        In the order in which they were added.
    """
    return [] if tree is None else [node for node in tree.nodes if hasattr(node.get(names.OPERATION), "items")]


def operation_nodes(tree: bpy.types.NodeTree | None) -> list[bpy.types.Node]:
    """The nodes that carry an operation on polygons.

    Parameters
    ----------
    tree : bpy.types.NodeTree or None

    Returns
    -------
    list of bpy.types.Node
        In the order in which they were added.
    """
    return [node for node in recorded_nodes(tree) if not works_on_drawings(node)]


def drawing_nodes(tree: bpy.types.NodeTree | None) -> list[bpy.types.Node]:
    """The nodes that carry an operation on the lines of a drawing.

    Parameters
    ----------
    tree : bpy.types.NodeTree or None

    Returns
    -------
    list of bpy.types.Node
        Inputs first. They see no polygons, and are linked to each other alone.
    """
    return _inputs_first([node for node in recorded_nodes(tree) if works_on_drawings(node)])


def works_on_drawings(node: bpy.types.Node) -> bool:
    """Whether a node carries over regions of a drawing.

    Parameters
    ----------
    node : bpy.types.Node

    Returns
    -------
    bool
    """
    operation = node.get(names.OPERATION)
    return hasattr(operation, "items") and operation.get("type") == RegionTransfer.type


def sources_of(node: bpy.types.Node) -> list[tuple[bpy.types.Node, int]]:
    """Where a node's input comes from: nodes and the numbers of their outputs.

    Parameters
    ----------
    node : bpy.types.Node

    Returns
    -------
    list of (bpy.types.Node, int)
        Nodes that carry no operation, such as reroutes, are looked through.
    """
    found = []
    for link in (link for socket in node.inputs for link in socket.links):
        if hasattr(link.from_node.get(names.OPERATION), "items"):
            output = next(i for i, socket in enumerate(link.from_node.outputs) if socket == link.from_socket)
            found.append((link.from_node, output))
        else:
            found += sources_of(link.from_node)
    return found


def sources_by_node(tree: bpy.types.NodeTree) -> dict[str, list[tuple[bpy.types.Node, int]]]:
    """Where the input of every node comes from, in one look at the links: each socket would look through all of them.

    Parameters
    ----------
    tree : bpy.types.NodeTree

    Returns
    -------
    dict of str to list of (bpy.types.Node, int)
        By the node's name, as `sources_of` lists them, but that their order is that in which they were linked.
    """
    into: dict[str, list[bpy.types.NodeLink]] = {}
    for link in tree.links:
        into.setdefault(link.to_node.name, []).append(link)

    def sources(name: str) -> list[tuple[bpy.types.Node, int]]:
        found = []
        for link in into.get(name, ()):
            source = link.from_node
            if not hasattr(source.get(names.OPERATION), "items"):
                found += sources(source.name)
            elif len(source.outputs) == 1:
                found.append((source, 0))
            else:
                found.append((source, list(source.outputs).index(link.from_socket)))
        return found

    return {name: sources(name) for name in into}


def ordered_nodes(tree: bpy.types.NodeTree | None) -> list[bpy.types.Node]:
    """The nodes that carry an operation, inputs first.

    Parameters
    ----------
    tree : bpy.types.NodeTree or None

    Returns
    -------
    list of bpy.types.Node
        Of those that could come next, the one added first; nodes in a circle come last.
    """
    return _inputs_first(operation_nodes(tree))


def _inputs_first(nodes: Sequence[bpy.types.Node]) -> list[bpy.types.Node]:
    waiting = list(nodes)
    by_node = sources_by_node(nodes[0].id_data) if nodes else {}
    sources = {node.name: [source.name for source, _ in by_node.get(node.name, ())] for node in nodes}
    order: list[bpy.types.Node] = []
    done: set[str] = set()
    while waiting:
        ready = next((n for n in waiting if done.issuperset(sources[n.name])), waiting[0])
        waiting.remove(ready)
        order.append(ready)
        done.add(ready.name)
    return order


def plane_of(node: bpy.types.Node) -> Plane:
    """The plane that a node works on.

    Parameters
    ----------
    node : bpy.types.Node

    Returns
    -------
    Plane
    """
    stored = node.get(names.FRAME)
    return Plane() if stored is None else Plane.of_matrix(np.reshape(stored.to_list(), (4, 4)))


def is_placement(node: bpy.types.Node) -> bool:
    """Whether a node places by several examples.

    Parameters
    ----------
    node : bpy.types.Node

    Returns
    -------
    bool
    """
    return node[names.OPERATION].get("type") == RectanglePlacement.type


def is_propagation(node: bpy.types.Node) -> bool:
    """Whether a node places by one example.

    Parameters
    ----------
    node : bpy.types.Node

    Returns
    -------
    bool
    """
    return node[names.OPERATION].get("type") == PosePlacement.type


def is_building(node: bpy.types.Node) -> bool:
    """Whether a node makes or chooses among elements, solids and surfaces, and places nothing itself.

    Parameters
    ----------
    node : bpy.types.Node

    Returns
    -------
    bool
    """
    return node[names.OPERATION].get("type") in BUILDING


def builds(tree: bpy.types.NodeTree | None) -> bool:
    """Whether a tree has such nodes: what stands in the scene then depends on all of its nodes together.

    Parameters
    ----------
    tree : bpy.types.NodeTree or None

    Returns
    -------
    bool
    """
    return any(is_building(node) for node in operation_nodes(tree))


def works_everywhere(node: bpy.types.Node) -> bool:
    """Whether a node works on every plane, not on that of its example alone.

    Parameters
    ----------
    node : bpy.types.Node

    Returns
    -------
    bool
    """
    return is_placement(node) or is_building(node)


def engine_node(node: bpy.types.Node) -> Node:
    """A node as the engine's.

    Parameters
    ----------
    node : bpy.types.Node

    Returns
    -------
    Node

    Raises
    ------
    InputError
        For what another or a newer version has written, and for anything damaged.
    """
    return engine_tree([node], linked=False).nodes[0]


def engine_tree(
    nodes: Sequence[bpy.types.Node],
    evaluations: Evaluations | None = None,
    linked: bool = True,
) -> OperationsTree:
    """Nodes as the engine's tree.

    Parameters
    ----------
    nodes : sequence of bpy.types.Node
    evaluations : Evaluations, optional
    linked : bool
        Whether links count; they must come from nodes among these.

    Returns
    -------
    OperationsTree

    Raises
    ------
    InputError
        For what another or a newer version has written, for circles, and for anything damaged.
    """
    made = []
    for node in nodes:
        links = tuple(Link(source.name, output) for source, output in sources_of(node)) if linked else ()
        made.append(Node(node.name, _operation_of(node), links, node.mute))
    return OperationsTree(made, evaluations)


#: The operations that were read last, by the names of their nodes, with what they were read from.
_read: dict[str, tuple[Any, Operation]] = {}


def _operation_of(node: bpy.types.Node) -> Operation:
    """The operation of a node: the same object as before, where nothing of it has changed."""
    plain = from_property(node[names.OPERATION])
    known = _read.get(node.name)
    if known is not None and known[0] == plain:
        return known[1]
    entry = {"id": node.name, "type": plain.get("type"), "settings": plain.get("settings", {})}
    holder = {"schema": plain.get("schema"), "nodes": [{**entry, "inputs": [], "muted": False}]}
    (read,) = OperationsTree.from_dict(holder, f"the operation {node.name!r}").nodes
    _read[node.name] = plain, read.operation
    return read.operation


def forget_operations() -> None:
    """Forget what has been read: another file has other nodes."""
    _read.clear()


def placed_by(node: bpy.types.Node) -> list[Placed]:
    """The objects that a node places.

    Parameters
    ----------
    node : bpy.types.Node

    Returns
    -------
    list of Placed
    """
    found = []
    for entry in (node.get(names.EXAMPLES) or {}).values():
        item = entry.get("object") or bpy.data.objects.get(entry["mesh"])
        rest = np.array(entry["rest"].to_list()).reshape(4, 4)
        found.append(Placed(entry["mesh"], item, rest, entry.get("target")))
    return found


def require_operations(scene: bpy.types.Scene) -> bpy.types.NodeTree:
    """The operations tree of a scene that has operations.

    Parameters
    ----------
    scene : bpy.types.Scene

    Returns
    -------
    bpy.types.NodeTree

    Raises
    ------
    InputError
        Where there are none.
    """
    tree = tree_of(scene)
    if not recorded_nodes(tree):
        raise InputError(f"the scene {scene.name!r} has no operations; propagate an object first")
    return tree
