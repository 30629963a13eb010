"""Operations trees as JSON files, and as node groups: read from one into the other, and grown onto what is there."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import bpy
import numpy as np

from ...errors import InputError
from ...operations.node import Link, Node
from ...operations.tree import OperationsTree
from .. import names
from ..reading.planes import Plane
from .links import unwatched
from .store import Placed, engine_tree, ordered_nodes, placed_by, require_operations, sources_of
from .writing_nodes import BRANCH_GAP, NODE_GAP, add_node

#: Nodes beside each other before a chain goes on in the next row.
LONGEST_ROW = 12


def import_tree(scene: bpy.types.Scene, path: Path) -> bpy.types.NodeTree:
    """Read a tree from a file; it becomes the scene's, which keeps the one that it had as a data-block of its own.

    Parameters
    ----------
    scene : bpy.types.Scene
    path : Path
        A .json.

    Returns
    -------
    bpy.types.NodeTree

    Raises
    ------
    InputError
        Where the file holds no tree of this version, or is cut off; then nothing has changed.
    """
    read = OperationsTree.load(path)
    _require_names(read.nodes)
    tree = bpy.data.node_groups.new(path.stem, names.TREE)
    tree.use_fake_user = True
    with unwatched(tree):
        _add_nodes(tree, read.nodes)
    scene.geoanalogy.tree = tree
    return tree


def graft_tree(tree: bpy.types.NodeTree, path: Path, after: Sequence[Link], prefix: str) -> int:
    """Let a tree from a file, which was recorded apart, grow onto outputs of another.

    Parameters
    ----------
    tree : bpy.types.NodeTree
    path : Path
        A .json.
    after : sequence of Link
        Outputs of the tree that the other's first nodes get as their input.
    prefix : str
        Put before the names of the other's nodes.

    Returns
    -------
    int
        How many nodes have been added.

    Raises
    ------
    InputError
        For an unusable file, and where a node of the other has the name of one that is there.
    """
    before = engine_tree(ordered_nodes(tree))
    known = {node.id for node in before.nodes}
    grown = before.with_tree(OperationsTree.load(path), after, prefix)
    more = [node for node in grown.nodes if node.id not in known]
    _require_names(more)
    with unwatched(tree):
        _add_nodes(tree, more)
    return len(more)


def export_tree(scene: bpy.types.Scene, path: Path) -> int:
    """Write a scene's tree to a file.

    Parameters
    ----------
    scene : bpy.types.Scene
    path : Path

    Returns
    -------
    int
        How many nodes it has.

    Raises
    ------
    InputError
        Where the scene has no operations, they are damaged, or the file cannot be written.
    """
    nodes = ordered_nodes(require_operations(scene))
    outlines = {one.mesh for node in nodes for one in placed_by(node) if one.item and names.DRAWN in one.item}
    tree = engine_tree(nodes)
    # A drawn rectangle is an outline; elsewhere there is no object of its name.
    plain = [
        replace(node, operation=replace(node.operation, mesh=""))
        if getattr(node.operation, "mesh", "") in outlines
        else node
        for node in tree.nodes
    ]
    OperationsTree(plain).save(path)
    return len(plain)


def _require_names(nodes: Sequence[Node]) -> None:
    for node in nodes:
        if len(node.id.encode()) > names.LONGEST_NODE_NAME:
            raise InputError(f"node {node.id!r} has a name of more than {names.LONGEST_NODE_NAME} letters; shorten it")


def _add_nodes(tree: bpy.types.NodeTree, nodes: Sequence[Node]) -> None:
    """Add nodes, inputs first, each a step to the right of what it builds on; long chains go on in further rows."""
    depths: dict[str, int] = {}
    for known in ordered_nodes(tree):
        depths[known.name] = max((depths[s.name] + 1 for s, _ in sources_of(known) if s.name in depths), default=0)
    low = min((other.location[1] for other in tree.nodes), default=BRANCH_GAP) - BRANCH_GAP
    places, used = [], {}
    for node in nodes:
        depth = depths[node.id] = max((depths[link.node] + 1 for link in node.inputs), default=0)
        used[depth] = used.get(depth, -1) + 1
        places.append((depth, used[depth]))
    rows = max(used.values(), default=0) + 1
    for node, (depth, row) in zip(nodes, places, strict=True):
        made = add_node(tree, node, library_objects(node), Plane())
        turn, column = divmod(depth, LONGEST_ROW)
        made.location = (column * NODE_GAP, low - (turn * rows + row) * BRANCH_GAP)


def library_objects(node: Node) -> list[Placed]:
    """The objects of the file that a node from elsewhere places.

    Parameters
    ----------
    node : Node

    Returns
    -------
    list of Placed
        By their names, whether they are there or not. They lie on their surfaces as they lie on the ground.
    """
    operation = node.operation
    wanted = getattr(operation, "meshes", None) or [getattr(operation, "mesh", "")]
    found = []
    for name in dict.fromkeys(str(name) for name in wanted if name):
        item = bpy.data.objects.get(name)
        rest = np.eye(4) if item is None else np.array(item.matrix_basis)
        rest[:3, 3] = 0.0
        found.append(Placed(name, item, rest))
    return found
