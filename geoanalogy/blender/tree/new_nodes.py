"""Operations that are added by hand in the node editor."""

import bpy

from ...operations.boolean import Boolean
from ...operations.extrusion import Extrusion
from ...operations.node import Node
from ...operations.operation import Operation
from ...operations.selection import Selection
from .. import names
from ..reading.planes import Plane
from ..units import in_scene_units
from .editing import free_id
from .writing_nodes import add_node

#: Kinds of operations that need no examples, and what they do.
KINDS = {
    Extrusion.type: "Make solids of everything of a label",
    Boolean.type: "Merge solids with what they stand on, or cut them out",
    Selection.type: "Divide what is of a label among branches",
}

#: Height of an extrusion that nobody has set, metres.
HEIGHT = 3.0


def new_node(tree: bpy.types.NodeTree, kind: str, label: str) -> bpy.types.Node:
    """Add an operation that is linked to nothing.

    Parameters
    ----------
    tree : bpy.types.NodeTree
    kind : str
        Of `KINDS`.
    label : str
        Of what it works on.

    Returns
    -------
    bpy.types.Node
        Selected alone, active, and marked as not yet evaluated.
    """
    height = in_scene_units(bpy.context.scene, HEIGHT)
    made: dict[str, Operation] = {
        Extrusion.type: Extrusion(label=label, height=height),
        Boolean.type: Boolean(label=label),
        Selection.type: Selection(label=label, weights=(1.0, 1.0)),
    }
    for other in tree.nodes:
        other.select = False
    node = add_node(tree, Node(free_id(tree, f"{kind} {label}"), made[kind]), (), Plane())
    node.select = True
    node[names.STALE] = True
    return node
