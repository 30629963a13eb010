"""Recording placements by several examples: what the operators do, and what a script calls (chapter 5).

Each function is a stepper that returns the node it has written. Where anything fails, the scene stays as it was.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

import bpy
import numpy as np

from ...errors import InputError
from ...geometry.surface import GROUND
from ...operations.decisions import Decisions
from ...operations.layout import Layout
from ...operations.node import Node
from ...operations.rectangle_placement import outline_of, placement_key, siblings
from ...placements.arrays import Fit
from ...placements.options import PlacementOptions
from ...progress import Stepper, within
from .. import names
from ..reading.ground import label_of
from ..reading.identity import keep_ids
from ..reading.planes import Plane
from ..reading.rectangles import middle_of, rectangle_of, require_stretchable, rest_on, target_of
from .corrections import decide, forget_all
from .editing import chosen_outputs, free_id
from .evaluating import (
    Surroundings,
    after_steps,
    evaluations,
    mark_stale,
    read_surroundings,
    surroundings_of,
    write_node,
)
from .learned import unfamiliar_steps, write_unfamiliar
from .placement_lessons import (
    Rejected,
    Shown,
    again,
    examples_in,
    incoming_everywhere_steps,
    learn_rectangles,
    rejected_by,
    shown,
    write_rejected,
)
from .recording import require_object
from .refresh import proposed_by
from .sites import site_under, sites_before, sites_of
from .store import (
    Placed,
    builds,
    engine_node,
    ensure_tree,
    is_placement,
    operation_nodes,
    ordered_nodes,
    placed_by,
    require_operations,
    tree_of,
)
from .whole import whole_steps, write_whole
from .writing_nodes import add_node, write_operation, write_placed

#: Least score of results that are shown, unless another is asked for.
THRESHOLD = PlacementOptions().threshold


def placement_steps(
    context: bpy.types.Context,
    items: Sequence[bpy.types.Object],
    element: bpy.types.Object | None = None,
    options: PlacementOptions | None = None,
    *,
    fit: tuple[Fit, Fit] = ("scale", "scale"),
    gap: tuple[float, float] = (0.0, 0.0),
    threshold: float = THRESHOLD,
    max_per: Mapping[str, int] | None = None,
    name: str | None = None,
) -> Stepper[bpy.types.Node]:
    """Learn from examples where rectangles are meant to be, fill them with an object, and record it.

    Parameters
    ----------
    context : bpy.types.Context
    items : sequence of bpy.types.Object
        The examples, where they belong, on faces of any direction. Their property `names.TARGET` says how much each is
        wanted; rectangles that were drawn are filled like the results.
    element : bpy.types.Object, optional
        What is placed; None: what was placed before, else the first example that is wanted most.
    options : PlacementOptions, optional
    fit : (str, str)
        "scale" or "repeat", along the width and along the height.
    gap : (float, float)
        Least distance between repeated objects.
    threshold : float
        Least score of results that are placed; can be changed later without computing anything again.
    max_per : mapping of str to int, optional
        Most placements per parent of a label; "" stands for the label of the examples' own parents.
    name : str, optional
        Of the operation; by default the label of what is placed.

    Returns
    -------
    generator of (float, str)
        Returns the operation's node. Examples that an operation was learned from before are recorded anew in its place.

    Raises
    ------
    InputError
        For what cannot be used.
    """
    if not items:
        raise InputError("nothing is selected; select the examples, or draw some")
    items = [require_object(context, item) for item in items]
    tree = tree_of(context.scene)
    known = _known(tree, items)
    element = _element(context, items, element, known)
    label = _label(context, items, element)
    every = read_surroundings(context, [*items, element])
    if known is not None:
        before = engine_node(known)
        layouts = yield from within(incoming_everywhere_steps(every, known.name), 0.0, 0.3)
        rejected, decisions, links = rejected_by(known), before.operation.decisions, before.inputs
    else:
        links = chosen_outputs(tree, ordered_nodes(tree))
        layouts = yield from within(after_steps(every, links), 0.0, 0.3)
        rejected, decisions = [], Decisions()
    sites = sites_of(every, layouts)
    examples = [shown(sites, every, item) for item in items]
    placed = _placed(every, examples, element, "scale" in fit)
    settings = {"mesh": element.name, "label": label, "size": placed[1], "fit": fit, "gap": gap, "threshold": threshold}
    operation = learn_rectangles(sites, examples, rejected, options or PlacementOptions(), settings)
    most = {of or operation.model.label: count for of, count in (max_per or {}).items()}
    operation = replace(operation, max_per=most, decisions=decisions)
    node = Node(free_id(tree, name or label) if known is None else known.name, operation, links)
    home = examples[0].site.ground.plane
    return (yield from _write_steps(context, every, layouts, node, known, placed[0], home, rejected))


def rejected_steps(context: bpy.types.Context, items: Iterable[bpy.types.Object]) -> Stepper[int]:
    """Reject results: one of a placement becomes an example of what is not wanted, and the rule is learned again.

    Parameters
    ----------
    context : bpy.types.Context
    items : iterable of bpy.types.Object
        Results.

    Returns
    -------
    generator of (float, str)
        Returns how many were rejected; all the objects of an array are one.

    Raises
    ------
    InputError
        Where there are none, or nothing can be learned any more.
    """
    tree = require_operations(context.scene)
    by_node: dict[str, list[str]] = {}
    others = []
    for item in items:
        node = tree.nodes.get(item[names.NODE])
        if node is not None and is_placement(node) and not _on_surface(item, node):
            by_node.setdefault(node.name, []).append(item[names.KEY])
        else:
            others.append(item)
    count = 0
    for name, keys in by_node.items():
        node = tree.nodes[name]
        sites = sites_before(context, node)
        proposed = [e for e in proposed_by(node) if not e.example]
        decisions, more = engine_node(node).operation.decisions, []
        for key in dict.fromkeys(placement_key(key) for key in keys):
            same = siblings(key, [e.key for e in proposed])
            filling = [e for e in proposed if e.key in same]
            at = site_under(sites, filling[0]) if filling else None
            for other in same:
                decisions = decisions.reject(other)
            if at is not None:
                more.append(Rejected(at.plane, outline_of(filling)))
            count += 1
        yield from _again_steps(context, node, [*rejected_by(node), *more], decisions)
    return count + (decide(context, others, "reject") if others or not count else 0)


def _on_surface(item: bpy.types.Object, node: bpy.types.Node) -> bool:
    """Whether a result stands on a surface of a solid: many are alike, and what one of them lacks teaches nothing."""
    found = next((e for e in proposed_by(node) if e.key == item[names.KEY]), None)
    return found is not None and found.surface != GROUND


def forgotten_steps(context: bpy.types.Context, node: bpy.types.Node) -> Stepper[int]:
    """Take back all decisions about an operation's results; a placement is learned again without them.

    Parameters
    ----------
    context : bpy.types.Context
    node : bpy.types.Node

    Returns
    -------
    generator of (float, str)
        Returns how many there were.
    """
    if not is_placement(node):
        return forget_all(context, node)
    decisions = engine_node(node).operation.decisions
    count = len({*decisions.accepted, *decisions.rejected, *decisions.pinned})
    yield from _again_steps(context, node, [], Decisions())
    return count


def unfamiliar_again_steps(context: bpy.types.Context, node: bpy.types.Node) -> Stepper[int]:
    """List anew which faces are unlike the examples of a placement: the scene may be another one by now.

    Parameters
    ----------
    context : bpy.types.Context
    node : bpy.types.Node

    Returns
    -------
    generator of (float, str)
        Returns how many there are.

    Raises
    ------
    InputError
        Where the node places by a single example or not at all, or the ground cannot be read.
    """
    if not is_placement(node):
        raise InputError(f"the operation {node.name!r} was not learned from several examples; click one that was")
    every = read_surroundings(context)
    layouts = yield from within(incoming_everywhere_steps(every, node.name), 0.0, 0.5)
    faces = yield from within(unfamiliar_steps(engine_node(node).operation, sites_of(every, layouts)), 0.5, 1.0)
    write_unfamiliar(node, faces)
    return len(faces)


def _again_steps(
    context: bpy.types.Context, node: bpy.types.Node, rejected: Sequence[Rejected], decisions: Decisions
) -> Stepper[bpy.types.Node]:
    """Learn a placement again from its examples and other rejected results."""
    every = read_surroundings(context)
    before = engine_node(node)
    layouts = yield from within(incoming_everywhere_steps(every, node.name), 0.0, 0.3)
    sites = sites_of(every, layouts)
    examples = [shown(sites, every, item) for item in examples_in(node, context.scene)]
    # Without its examples, as in a file that the tree was appended to, it stays as it was learned.
    learned = again(before.operation, sites, examples, rejected) if examples else before.operation
    operation = replace(learned, decisions=decisions)
    wanted = Node(node.name, operation, before.inputs, before.muted)
    return (yield from _write_steps(context, every, layouts, wanted, node, placed_by(node), None, rejected))


def _write_steps(
    context: bpy.types.Context,
    every: Sequence[Surroundings],
    layouts: Sequence[Layout],
    node: Node,
    known: bpy.types.Node | None,
    placed: Sequence[Placed],
    home: Plane | None,
    rejected: Sequence[Rejected],
) -> Stepper[bpy.types.Node]:
    """Evaluate a placement on every plane, then write it and its results."""
    whole = builds(tree_of(context.scene))
    evaluated, after = [], []
    if whole:
        after = yield from within(whole_steps(every, [node]), 0.3, 0.9)
    else:
        for i, (around, layout) in enumerate(zip(every, layouts, strict=True)):
            start, end = (0.3 + 0.6 * k / len(every) for k in (i, i + 1))
            (out,) = yield from within(evaluations.steps(node, layout, around.seed), start, end)
            evaluated.append((around, out.elements))
    unfamiliar = yield from within(unfamiliar_steps(node.operation, sites_of(every, layouts)), 0.9, 1.0)
    tree = ensure_tree(context.scene)
    if known is None:
        known = add_node(tree, node, placed, home or Plane())
    else:
        write_operation(known, node)
        if home is not None:
            write_placed(known, placed, home)
        tree.nodes.active = known
    write_rejected(known, rejected)
    if whole:
        write_whole(context.scene, tree, every, after)
    else:
        keep_ids(context.scene, [around.ground.scene for around, _ in evaluated])
        write_node(known, evaluated)
        mark_stale(tree, known)
    write_unfamiliar(known, unfamiliar)
    return known


def _known(tree: bpy.types.NodeTree | None, items: Sequence[bpy.types.Object]) -> bpy.types.Node | None:
    """The placement that was learned from most of these examples before."""
    nodes = [node for node in operation_nodes(tree) if is_placement(node)]
    shared = [sum(one.item in items for one in placed_by(n) if one.target is not None) for n in nodes]
    return nodes[int(np.argmax(shared))] if any(shared) else None


def _element(
    context: bpy.types.Context,
    items: Sequence[bpy.types.Object],
    element: bpy.types.Object | None,
    known: bpy.types.Node | None,
) -> bpy.types.Object:
    """The object that is placed."""
    if element is None and known is not None:
        mesh = engine_node(known).operation.mesh
        element = next((one.item for one in placed_by(known) if one.mesh == mesh), None)
    if element is None:
        # An object before an empty rectangle.
        return max(items, key=lambda item: (target_of(item), names.DRAWN not in item))
    if names.KEY in element:
        raise InputError(f"object {element.name!r} is a result of {element[names.NODE]!r} itself; choose another")
    return element


def _label(context: bpy.types.Context, items: Sequence[bpy.types.Object], element: bpy.types.Object) -> str:
    """What the results are: the label of the object that is placed, else that of the first example."""
    try:
        return label_of(element, context.scene)
    except InputError:
        return label_of(items[0], context.scene)


def _placed(
    every: Sequence[Surroundings], examples: Sequence[Shown], element: bpy.types.Object, stretched: bool
) -> tuple[list[Placed], tuple[float, float]]:
    """The object that is placed and the examples, how each rests on its rectangle; and the size of the first."""
    found = []
    own = next((one for one in examples if one.item == element), None)
    if own is None:
        plane = _plane_behind(every, examples[0].site.plane, element)
        rectangle = rectangle_of(element, plane, every[0].depsgraph)
        found.append(Placed(element.name, element, rest_on(element, rectangle, plane)))
    else:
        rectangle = own.rectangle
    for one in examples:
        rest = rest_on(one.item, one.rectangle, one.site.plane)
        found.append(Placed(one.item.name, one.item, rest, one.target))
    if stretched:
        require_stretchable(element, next(one.rest for one in found if one.item == element))
    return found, (rectangle.width, rectangle.height)


def _plane_behind(every: Sequence[Surroundings], wanted: Plane, element: bpy.types.Object) -> Plane:
    """The plane that an object rests on which is no example.

    Where it lies on a face of the examples' kind, that face; else it stands free, with its origin on the face, its
    front towards -y where the face is a wall, upwards where it is level.
    """
    middle = middle_of(element, every[0].depsgraph)
    plane = surroundings_of(list(every), element, middle).plane
    size = 2 * float(np.linalg.norm(middle - np.array(element.matrix_world.translation))) + max(element.dimensions)
    x, y, height = plane.to_plane([middle])[0]
    alike = plane.is_wall == wanted.is_wall
    lies = any(one.plane is plane and one.ground.scene.parent_of((x, y)) is not None for one in every)
    if alike and lies and abs(height) < size:
        return plane
    return Plane.through(element.matrix_world.translation, (0, -1, 0) if wanted.is_wall else (0, 0, 1))
