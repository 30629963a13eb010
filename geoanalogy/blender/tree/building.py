"""Recording operations that need no examples: extrusion, boolean, selection (section 5.6)."""

from collections.abc import Sequence

import bpy

from ...errors import InputError
from ...geometry.extrusion import FaceLabels
from ...geometry.roof import Roof
from ...operations.boolean import Boolean
from ...operations.extrusion import Extrusion
from ...operations.layout import Layout
from ...operations.node import Node
from ...operations.operation import Operation
from ...operations.selection import Selection
from ...progress import Stepper, within
from .. import names
from ..reading.ground import labels_of
from ..reading.planes import Plane
from .editing import chosen_outputs, free_id
from .evaluating import after_steps, evaluations, read_surroundings
from .node_settings import stored_settings
from .store import ensure_tree, ordered_nodes, tree_of
from .whole import Shown, whole_steps, write_whole
from .writing_nodes import add_node

#: Labels that are listed where one is not found.
MOST_LISTED = 8


def extrusion_of(
    label: str,
    height: float,
    factor: tuple[float, float] = (1.0, 1.0),
    *,
    inwards: bool = False,
    roof: Roof | None = None,
    walls: float = 0.0,
    faces: FaceLabels | None = None,
) -> Extrusion:
    """An extrusion, whose height can be.

    Parameters
    ----------
    label : str
    height : float
        Scene units.
    factor : (float, float)
        Least and greatest random multiplier.
    inwards : bool
    roof : Roof, optional
    walls : float
        Thickness of the walls of a room, scene units; 0: a full body.
    faces : FaceLabels, optional

    Returns
    -------
    Extrusion

    Raises
    ------
    InputError
        Where the height or a multiplier is not positive.
    """
    if not height > 0.0:
        raise InputError(f"the height is {height:g}; give a positive one, and choose inwards to go below the surface")
    if not min(factor) > 0.0:
        raise InputError(f"the random multiplier goes down to {min(factor):g}; give positive ones")
    low, high = sorted(factor)
    return Extrusion(
        label=label,
        height=height,
        factor=(low, high),
        inwards=inwards,
        roof=roof or Roof(),
        walls=walls,
        faces=faces or FaceLabels(),
    )


def label_here(context: bpy.types.Context, wanted: str) -> str:
    """The label of what is to be worked on.

    Parameters
    ----------
    context : bpy.types.Context
    wanted : str
        Empty: that of the active object, be it of the plan or a result, else what the active operation has placed.

    Returns
    -------
    str

    Raises
    ------
    InputError
        Where neither has one.
    """
    if wanted.strip():
        return wanted.strip()
    item = context.active_object
    label = "" if item is None else str(item.get(names.LABEL, "") or labels_of(context.scene).get(item.name, ""))
    tree = tree_of(context.scene)
    if not label and tree is not None and tree.nodes.active is not None:
        label = str(stored_settings(tree.nodes.active).get("label", ""))
    if not label:
        raise InputError("nothing says what is meant; type a label, or click an object that has one")
    return label


def operation_steps(
    context: bpy.types.Context, operation: Extrusion | Boolean | Selection, name: str | None = None
) -> Stepper[tuple[bpy.types.Node, Shown]]:
    """Record an operation after the chosen outputs, and show what comes of the whole tree.

    Parameters
    ----------
    context : bpy.types.Context
    operation : Extrusion, Boolean or Selection
    name : str, optional
        Of the operation; by default what it does and to what.

    Returns
    -------
    generator of (float, str)
        Returns the node, and what stands in the scene.

    Raises
    ------
    InputError
        Where nothing has the label, and for what cannot be used.
    """
    tree = tree_of(context.scene)
    every = read_surroundings(context)
    links = chosen_outputs(tree, ordered_nodes(tree))
    layouts = yield from within(after_steps(every, links), 0.0, 0.2)
    node = Node(free_id(tree, name or f"{_verb(operation)} {operation.label}"), operation, links)
    after = yield from within(whole_steps(every, [node]), 0.2, 1.0)
    proposed = [p for around in every if (p := evaluations.proposed.get((node.id, around.name)))]
    if not any(isinstance(p, dict) or p[0] for p in proposed):
        # Where nothing at all can be done, the first reason is told and nothing is recorded.
        failed = [sentence for p in proposed if not isinstance(p, dict) for sentence in p[1]]
        raise InputError(failed[0].removeprefix(f"node {node.id!r}: ") if failed else _nothing(operation, layouts))
    tree = ensure_tree(context.scene)
    made = add_node(tree, node, (), Plane())
    return made, write_whole(context.scene, tree, every, after)


def _verb(operation: Operation) -> str:
    if isinstance(operation, Boolean):
        return operation.kind
    return "extrude" if isinstance(operation, Extrusion) else "select"


def _nothing(operation: Extrusion | Boolean | Selection, layouts: Sequence[Layout]) -> str:
    """Why an operation has found nothing to do."""
    label = operation.label
    labels = {e.label for layout in layouts for e in layout.visible}
    if label in labels and isinstance(operation, Boolean):
        solids = [e for layout in layouts for e in layout.visible if e.label == label and e.solid is not None]
        if operation.target == "surface" and solids and not any(e.owner for e in solids):
            return (
                f"what has the label {label!r} stands on nothing that an operation has made, and nothing else can be "
                "cut or grown; label an outline, extrude it, and place on its faces"
            )
        others = "its own surface" if operation.target == "surface" else "others on its surface"
        return f"no solid with the label {label!r} meets {others}; extrude it first, or choose the other target"
    if label in labels and isinstance(operation, Extrusion):
        return f"all that has the label {label!r} is extruded already; choose another label"
    labels |= {p.label for layout in layouts for p in layout.scene.polygons}
    labels |= {surface.label for layout in layouts for surface in layout.surfaces()}
    known = sorted(labels - {""})
    listed = ", ".join(known[:MOST_LISTED]) + (" …" if len(known) > MOST_LISTED else "")
    return f"nothing there has the label {label!r}; there are {listed}"


def chosen_text(tree: bpy.types.NodeTree | None) -> str:
    """What the next operation builds on, in words.

    Parameters
    ----------
    tree : bpy.types.NodeTree or None

    Returns
    -------
    str
    """
    links = chosen_outputs(tree, ordered_nodes(tree))
    if not links:
        return "the plan"
    several = {link.node for link in links if len(tree.nodes[link.node].outputs) > 1}
    return ", ".join(f"{k.node} ({k.output + 1})" if k.node in several else k.node for k in links)
