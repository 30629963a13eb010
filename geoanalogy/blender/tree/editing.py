"""Editing the operations tree: names, ends of chains, taking nodes out and changing their order."""

import json
from collections.abc import Sequence

import bpy

from ...errors import InputError
from ...operations.node import Link
from .. import names
from .store import drawing_nodes, ordered_nodes, sources_by_node, sources_of


def free_id(tree: bpy.types.NodeTree | None, wanted: str) -> str:
    """A name that no node of a tree has.

    Parameters
    ----------
    tree : bpy.types.NodeTree or None
    wanted : str

    Returns
    -------
    str
        With a number behind it where need be, and cut to what Blender keeps of a name.
    """
    taken = set() if tree is None else {node.name for node in tree.nodes}
    numbers = ["", *(f" {i}" for i in range(2, len(taken) + 3))]
    return next(name for number in numbers if (name := _cut(wanted, number)) not in taken)


def _cut(name: str, number: str) -> str:
    """A name with a number, no longer than a node's may be; letters stay whole."""
    room = names.LONGEST_NODE_NAME - len(number)
    return name.encode()[:room].decode(errors="ignore") + number


def leaf(nodes: Sequence[bpy.types.Node], active: bpy.types.Node | None) -> bpy.types.Node | None:
    """The node that a recorded operation builds on: the active one where nothing follows it, else the last leaf.

    Parameters
    ----------
    nodes : sequence of bpy.types.Node
    active : bpy.types.Node or None

    Returns
    -------
    bpy.types.Node or None
        None before the first operation.
    """
    ends = open_outputs(nodes)
    leaves = [node for node in nodes if any(link.node == node.name for link in ends)]
    if active is not None and active in leaves:
        return active
    return leaves[-1] if leaves else None


def open_outputs(nodes: Sequence[bpy.types.Node]) -> tuple[Link, ...]:
    """The outputs of nodes that none of them takes its input from: what merges all branches.

    Parameters
    ----------
    nodes : sequence of bpy.types.Node

    Returns
    -------
    tuple of Link
    """
    by_node = sources_by_node(nodes[0].id_data) if nodes else {}
    used = {(source.name, output) for node in nodes for source, output in by_node.get(node.name, ())}
    every = (Link(node.name, k) for node in nodes for k in range(len(node.outputs)))
    return tuple(link for link in every if (link.node, link.output) not in used)


def chosen_outputs(tree: bpy.types.NodeTree | None, nodes: Sequence[bpy.types.Node]) -> tuple[Link, ...]:
    """What the next operation builds on: the outputs that were chosen, else the first open one of the leaf.

    Parameters
    ----------
    tree : bpy.types.NodeTree or None
    nodes : sequence of bpy.types.Node
        Those that it may build on, inputs first.

    Returns
    -------
    tuple of Link
        None before the first operation.
    """
    if tree is None:
        return ()
    own = {node.name: node for node in nodes}
    stored = json.loads(tree.get(names.BUILD_ON, "[]"))
    chosen = tuple(Link(name, k) for name, k in stored if name in own and k < len(own[name].outputs))
    if chosen:
        return chosen
    source = leaf(nodes, tree.nodes.active)
    return tuple(link for link in open_outputs(nodes) if source is not None and link.node == source.name)[:1]


def build_on(tree: bpy.types.NodeTree, links: Sequence[Link]) -> None:
    """Choose the outputs that the next operation builds on.

    Parameters
    ----------
    tree : bpy.types.NodeTree
    links : sequence of Link
        None: the active operation again.
    """
    tree.pop(names.BUILD_ON, None)
    if links:
        tree[names.BUILD_ON] = json.dumps([[link.node, link.output] for link in links])


def neighbour_of(tree: bpy.types.NodeTree, node: bpy.types.Node) -> bpy.types.Node | None:
    """The operation that becomes active where a node is removed.

    Parameters
    ----------
    tree : bpy.types.NodeTree
    node : bpy.types.Node

    Returns
    -------
    bpy.types.Node or None
        The one above it in the list, which it builds on in a chain; else the one below it; None without others.
    """
    every = [*ordered_nodes(tree), *drawing_nodes(tree)]
    at = every.index(node)
    return every[at - 1] if at else next(iter(every[1:]), None)


def remove_node(tree: bpy.types.NodeTree, node: bpy.types.Node) -> None:
    """Remove a node; what it fed is fed by what fed it.

    Parameters
    ----------
    tree : bpy.types.NodeTree
    node : bpy.types.Node
    """
    sources = [link.from_socket for socket in node.inputs for link in socket.links]
    targets = [link.to_socket for socket in node.outputs for link in socket.links]
    tree.nodes.remove(node)
    for target in targets:
        for source in sources:
            tree.links.new(source, target)


def follower_of(node: bpy.types.Node) -> bpy.types.Node:
    """The operation that builds on a node.

    Parameters
    ----------
    node : bpy.types.Node

    Returns
    -------
    bpy.types.Node

    Raises
    ------
    InputError
        Where there is none, or there are several.
    """
    followers = {link.to_node.name for socket in node.outputs for link in socket.links}
    if len(followers) != 1:
        raise InputError(f"not one operation follows on {node.name!r}, but {len(followers)}; there is nothing to swap")
    return node.id_data.nodes[followers.pop()]


def swap_with_source(tree: bpy.types.NodeTree, node: bpy.types.Node) -> None:
    """Move a node before the one that it gets its input from.

    Parameters
    ----------
    tree : bpy.types.NodeTree
    node : bpy.types.Node

    Raises
    ------
    InputError
        Where it has no source, or several, or shares it: then there is no order to change.
    """
    sources = sources_of(node)
    if not sources:
        raise InputError(f"the operation {node.name!r} follows on none; it is the first already")
    if len(sources) != 1:
        raise InputError(f"the operation {node.name!r} does not follow on a single one; relink it in the node editor")
    source = sources[0][0]
    before = [link.from_socket for socket in source.inputs for link in socket.links]
    after = [link.to_socket for socket in node.outputs for link in socket.links]
    others = [link.to_node for socket in source.outputs for link in socket.links if link.to_node != node]
    if others:
        raise InputError(f"the tree branches after {source.name!r}; relink it in the node editor")
    for link in [link for link in tree.links if {link.from_node, link.to_node} & {node, source}]:
        tree.links.remove(link)
    for socket in before:
        tree.links.new(socket, node.inputs[0])
    tree.links.new(node.outputs[0], source.inputs[0])
    for socket in after:
        tree.links.new(source.outputs[0], socket)
    node.location, source.location = tuple(source.location), tuple(node.location)
