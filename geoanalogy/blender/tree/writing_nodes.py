"""Writing the engine's nodes into a scene's operations tree."""

import json
from collections.abc import Sequence

import bpy

from ...operations.node import Node
from ...operations.rectangle_placement import RectanglePlacement
from ...operations.storage import SCHEMA, VERSION
from .. import names
from ..reading.planes import Plane
from .plain import to_property
from .store import Placed

#: Distance between the nodes of a chain in the node editor.
NODE_GAP = 260.0

#: Distance between branches there.
BRANCH_GAP = 300.0


def write_operation(node: bpy.types.Node, operation: Node) -> None:
    """Write an engine's node into one of Blender's, without its links.

    Parameters
    ----------
    node : bpy.types.Node
    operation : Node
    """
    plain = operation.to_dict()
    settings = plain["settings"]
    if hasattr(operation.operation, "threshold"):
        settings.setdefault("threshold", operation.operation.threshold)
    entry = {"schema": f"{SCHEMA}/{VERSION}", "type": plain["type"], "settings": settings}
    node[names.OPERATION] = {key: to_property(value) for key, value in entry.items()}
    if isinstance(operation.operation, RectanglePlacement):
        rule = [[relation.text, relation.weight] for relation in operation.operation.model.rule()]
        node[names.RULE] = json.dumps(rule, ensure_ascii=False)
    if node.mute != operation.muted:
        node.mute = operation.muted
    _fit_outputs(node, operation.operation.outputs)


def _fit_outputs(node: bpy.types.Node, count: int) -> None:
    """Give a node as many outputs as its operation has."""
    while len(node.outputs) > count:
        node.outputs.remove(node.outputs[-1])
    while len(node.outputs) < count:
        node.outputs.new(names.LAYOUT_SOCKET, "Layout")
    for i, socket in enumerate(node.outputs):
        name = f"Set {i + 1}" if count > 1 else "Layout"
        if socket.name != name:
            socket.name = name


def add_node(tree: bpy.types.NodeTree, operation: Node, placed: Sequence[Placed], plane: Plane) -> bpy.types.Node:
    """Add an engine's node to a scene's tree, linked and active.

    Parameters
    ----------
    tree : bpy.types.NodeTree
    operation : Node
    placed : sequence of Placed
        The objects that it places.
    plane : Plane

    Returns
    -------
    bpy.types.Node
    """
    node = tree.nodes.new(names.OPERATION_NODE)
    node.name = operation.id
    tree.pop(names.BUILD_ON, None)
    write_operation(node, operation)
    write_placed(node, placed, plane)
    sources = [tree.nodes[link.node] for link in operation.inputs]
    link_inputs(node, [source.outputs[link.output] for link, source in zip(operation.inputs, sources, strict=True)])
    rows = [other.location[1] for other in tree.nodes if other != node]
    node.location = (
        (max(source.location[0] for source in sources) + NODE_GAP, sources[0].location[1])
        if sources
        else (0.0, min(rows) - NODE_GAP if rows else 0.0)
    )
    column = [o.location[1] for o in tree.nodes if o != node and abs(o.location[0] - node.location[0]) < NODE_GAP / 2]
    while any(abs(y - node.location[1]) < BRANCH_GAP / 2 for y in column):
        node.location[1] -= BRANCH_GAP
    tree.nodes.active = node
    return node


def link_inputs(node: bpy.types.Node, sockets: Sequence[bpy.types.NodeSocket]) -> None:
    """Link outputs to a node that has no input yet.

    Parameters
    ----------
    node : bpy.types.Node
    sockets : sequence of bpy.types.NodeSocket
        In this order, whichever of its links a Blender lists first.
    """
    links = node.id_data.links
    for socket in sockets:
        links.new(socket, node.inputs[0])
    found = [link.from_socket for link in node.inputs[0].links]
    if len(sockets) > 1 and found == list(reversed(sockets)):
        for link in list(node.inputs[0].links):
            links.remove(link)
        for socket in reversed(sockets):
            links.new(socket, node.inputs[0])


def write_placed(node: bpy.types.Node, placed: Sequence[Placed], plane: Plane) -> None:
    """Write which objects a node places, and on which plane.

    Parameters
    ----------
    node : bpy.types.Node
    placed : sequence of Placed
    plane : Plane
    """
    node[names.EXAMPLES] = {
        str(i): {"mesh": one.mesh, "rest": one.rest.ravel().tolist()}
        | ({} if one.item is None else {"object": one.item})
        | ({} if one.target is None else {"target": one.target})
        for i, one in enumerate(placed)
    }
    node[names.FRAME] = plane.matrix.ravel().tolist()
