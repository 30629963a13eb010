"""Showing what the stored proposals of operations let pass, without computing anything again."""

from collections.abc import Iterable, Sequence

import bpy

from ...operations.element import Element
from ...operations.layout import Layout
from ...operations.node import Node
from ...operations.placing import Placing
from ...operations.tree import OperationsTree
from .. import names
from ..reading.ground import Ground, read_grounds
from ..reading.planes import Plane
from ..reading.whereabouts import up_to_date
from ..writing.bending import Bender
from ..writing.instances import write_results
from .proposals import read_proposals
from .store import engine_node, engine_tree, operation_nodes, ordered_nodes, placed_by, plane_of, works_everywhere


def ground_for(grounds: list[Ground], plane: Plane) -> Ground:
    """The ground nearest to a plane; the largest one where none lies there, as for a tree from another file.

    Parameters
    ----------
    grounds : list of Ground
        The largest first.
    plane : Plane

    Returns
    -------
    Ground
    """
    size = float((grounds[0].scene.bounds[2:] - grounds[0].scene.bounds[:2]).max())
    there = [g for g in grounds if g.plane.is_coplanar(plane, size)]
    return min(there, key=lambda g: g.plane.gap_to(plane), default=grounds[0])


def examples_of(tree: bpy.types.NodeTree | None) -> set[str]:
    """Names of the objects that are examples of operations which are not muted.

    Parameters
    ----------
    tree : bpy.types.NodeTree or None

    Returns
    -------
    set of str
    """
    return {
        one.item.name
        for node in operation_nodes(tree)
        if not node.mute
        for one in placed_by(node)
        if one.item is not None
    }


def proposed_by(node: bpy.types.Node) -> tuple[Element, ...]:
    """What a node has proposed when it was last evaluated.

    Parameters
    ----------
    node : bpy.types.Node

    Returns
    -------
    tuple of Element
    """
    return read_proposals(node.get(names.RESULTS, ""), node.name)


def stored_layouts(engine: OperationsTree, tree: bpy.types.NodeTree, ground: Ground) -> dict[str, Layout]:
    """What comes in to every node, by the stored proposals.

    Parameters
    ----------
    engine : OperationsTree
        All operations of the tree.
    tree : bpy.types.NodeTree
    ground : Ground

    Returns
    -------
    dict of str to Layout
        By the nodes' names; of the first output of each node, for chains.
    """
    incoming: dict[str, Layout] = {}
    outgoing: dict[str, Layout] = {}
    for node in engine.nodes:
        elements = {e.id: e for link in node.inputs for e in outgoing[link.node].elements}
        incoming[node.id] = Layout(ground.scene, tuple(elements.values()))
        outgoing[node.id] = decided(node, proposed_by(tree.nodes[node.id]), incoming[node.id])
    return incoming


def decided(node: Node, proposed: tuple[Element, ...], layout: Layout) -> Layout:
    """The layout after a node, by what it has proposed.

    Parameters
    ----------
    node : Node
    proposed : tuple of Element
    layout : Layout
        What comes in.

    Returns
    -------
    Layout
        What came in, where the node is muted or places nothing itself.
    """
    if node.muted or not isinstance(node.operation, Placing):
        return layout
    there = {p.id for p in layout.scene.polygons}
    known = tuple(e for e in proposed if e.parent in there)
    return node.operation.decide(known, layout, node.id)[0]


def stored_layout(scene: bpy.types.Scene, node: bpy.types.Node) -> list[tuple[Ground, Layout]]:
    """What comes in to a node, by the stored proposals.

    Parameters
    ----------
    scene : bpy.types.Scene
    node : bpy.types.Node
        Of the scene's tree.

    Returns
    -------
    list of (Ground, Layout)
        On the node's plane, or on all where it works everywhere.

    Raises
    ------
    InputError
        Where the ground cannot be read.
    """
    grounds = read_grounds(scene, up_to_date(bpy.context), examples_of(node.id_data))
    chosen = grounds if works_everywhere(node) else [ground_for(grounds, plane_of(node))]
    engine = engine_tree(ordered_nodes(node.id_data))
    return [(ground, stored_layouts(engine, node.id_data, ground)[node.name]) for ground in chosen]


def in_order(node: bpy.types.Node, parts: Sequence[tuple[Plane, Iterable[Element]]]) -> list[tuple[Element, Plane]]:
    """The elements of a node on all its planes, in the order in which they are shown.

    Parameters
    ----------
    node : bpy.types.Node
    parts : sequence of (Plane, iterable of Element)
        Elements of other nodes are left out.

    Returns
    -------
    list of (Element, Plane)
        As they are on a single plane; the best of all planes first where there are several.
    """
    standing = [(e, plane.under(e.frame)) for plane, elements in parts for e in elements if e.node == node.name]
    return standing if len(parts) == 1 else sorted(standing, key=lambda one: -one[0].importance)


def show(scene: bpy.types.Scene, node: bpy.types.Node, *, unmoved: bool = False) -> int:
    """Show what a node's settings and decisions let pass of what it has proposed.

    Parameters
    ----------
    scene : bpy.types.Scene
    node : bpy.types.Node
        Of the scene's tree.
    unmoved : bool
        Whether only the selection has changed, not where results stand.

    Returns
    -------
    int
        How many results stand there.

    Raises
    ------
    InputError
        Where the ground cannot be read.
    """
    engine, proposed = engine_node(node), proposed_by(node)
    parts = [(g.plane, decided(engine, proposed, incoming).elements) for g, incoming in stored_layout(scene, node)]
    standing = in_order(node, parts)
    node[names.COUNT] = write_results(
        scene, node.name, standing, placed_by(node), bender=Bender.of(node), unmoved=unmoved
    )
    return node[names.COUNT]
