"""Recording operations: what the operators do, and what a script calls.

Each function is a stepper that returns the node it has written; `geoanalogy.progress.run` drives it to its end. Where
anything fails, the scene stays as it was.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import bpy

from ...errors import InputError
from ...geometry.scene import Scene
from ...operations.array_placement import ArrayPlacement
from ...operations.choice_placement import ChoicePlacement
from ...operations.group_placement import GroupPlacement
from ...operations.layout import Layout
from ...operations.node import Node
from ...operations.operation import Operation
from ...operations.placing import Placing
from ...operations.pose_placement import PosePlacement
from ...operations.scatter_placement import ScatterPlacement
from ...poses.arrays import ArrayOptions
from ...poses.local_mapping import TransferOptions
from ...poses.model import PoseModel
from ...poses.options import PoseOptions
from ...poses.scatter import ScatterModel, ScatterOptions
from ...progress import Stepper, within
from .. import names
from ..linked import is_here
from ..reading.ground import label_of
from ..reading.identity import keep_ids
from .editing import chosen_outputs, free_id
from .evaluating import (
    Surroundings,
    after_steps,
    evaluations,
    incoming_steps,
    mark_stale,
    read_surroundings,
    surroundings_of,
    write_node,
)
from .lessons import learn, learn_group, learn_row, scene_without
from .selected import objects_behind
from .sites import Site, site_of, sites_in
from .store import builds, ensure_tree, placed_by, tree_of
from .whole import whole_steps, write_whole
from .writing_nodes import add_node, write_operation, write_placed

#: Least importance that is computed; the threshold of the slider lies above it.
LEAST_IMPORTANCE = 0.1

#: Least importance that is shown, unless another is asked for.
THRESHOLD = 0.5

#: Options of a propagation in Blender: objects keep their size, unless the user asks for another.
OPTIONS = PoseOptions(scale="fixed", threshold=LEAST_IMPORTANCE)

#: Makes an operation from its site, what else stands there, and what was recorded of it before.
Make = Callable[[Site, Scene, Operation | None], Operation]


def pose_steps(
    context: bpy.types.Context,
    item: bpy.types.Object | None,
    options: PoseOptions = OPTIONS,
    *,
    threshold: float = THRESHOLD,
    max_per: Mapping[str, int] | None = None,
    spacing: float | None = None,
    name: str | None = None,
) -> Stepper[bpy.types.Node]:
    """Propagate an object and record it: one example, put wherever the surroundings are alike (chapter 4).

    Parameters
    ----------
    context : bpy.types.Context
    item : bpy.types.Object or None
        The example, labelled, where it belongs; x is where it faces.
    options : PoseOptions, optional
    threshold : float
        Least importance of results that are placed; can be changed later without computing anything again.
    max_per : mapping of str to int, optional
        Most objects per parent of a label; "" stands for the label of the example's own parent.
    spacing : float, optional
        Least distance between two results, scene units.
    name : str, optional
        Of the operation; by default the object's label.

    Returns
    -------
    generator of (float, str)
        Returns the operation's node. An object that was propagated before keeps its operation, which is recorded anew.

    Raises
    ------
    InputError
        For what cannot be used.
    """
    item = require_object(context, item)
    label = label_of(item, context.scene)

    def make(site: Site, scene: Scene, before: Operation | None) -> Operation:
        model = learn(item, site, scene, options)
        most = _most_per(max_per, model)
        return PosePlacement(
            mesh=item.name, label=label, model=model, threshold=threshold, max_per=most, spacing=spacing
        )

    return _record_steps(context, [item], PosePlacement, make, name or label)


def choice_steps(
    context: bpy.types.Context,
    items: Sequence[bpy.types.Object],
    options: PoseOptions = OPTIONS,
    *,
    scope: str | None = None,
    weights: Sequence[float] = (),
    seed: int = 0,
    threshold: float = THRESHOLD,
    max_per: Mapping[str, int] | None = None,
    spacing: float | None = None,
    name: str | None = None,
) -> Stepper[bpy.types.Node]:
    """Propagate in every scope one of several objects, chosen by lot (section 4.8).

    Parameters
    ----------
    context : bpy.types.Context
    items : sequence of bpy.types.Object
        The examples; all are placed under the label of the first.
    options : PoseOptions, optional
    scope : str, optional
        Label of the polygons in which one example is chosen; None: that of the first example's parent.
    weights : sequence of float
        How often each is chosen in proportion to the others; empty: equally often.
    seed : int
    threshold, max_per, spacing, name
        As in `pose_steps`.

    Returns
    -------
    generator of (float, str)
        Returns the operation's node.

    Raises
    ------
    InputError
        For what cannot be used.
    """
    items = [require_object(context, item) for item in items or [None]]
    label = label_of(items[0], context.scene)

    def make(site: Site, scene: Scene, before: Operation | None) -> Operation:
        models = tuple(learn(item, site, scene, options) for item in items)
        return ChoicePlacement(
            meshes=tuple(item.name for item in items),
            label=label,
            models=models,
            scope=scope or None,
            weights=tuple(weights),
            seed=seed,
            threshold=threshold,
            max_per=_most_per(max_per, models[0]),
            spacing=spacing,
        )

    return _record_steps(context, items, ChoicePlacement, make, name or label)


def array_steps(
    context: bpy.types.Context,
    start: bpy.types.Object | None,
    end: bpy.types.Object | None,
    spacing: float,
    options: PoseOptions = OPTIONS,
    array_options: ArrayOptions | None = None,
    *,
    threshold: float = THRESHOLD,
    name: str | None = None,
) -> Stepper[bpy.types.Node]:
    """Put copies of an object along the boundary it stands at, and propagate the whole array (section 4.8).

    Parameters
    ----------
    context : bpy.types.Context
    start : bpy.types.Object or None
        The first object, labelled.
    end : bpy.types.Object or None
        An empty that marks where the array ends; None: it runs all round.
    spacing : float
        Distance along the path between two objects, scene units.
    options : PoseOptions, optional
        Of start and end.
    array_options : ArrayOptions, optional
    threshold : float
        Least importance of arrays.
    name : str, optional
        Of the operation; by default the object's label.

    Returns
    -------
    generator of (float, str)
        Returns the operation's node.

    Raises
    ------
    InputError
        For what cannot be used.
    """
    start = require_object(context, start)
    label = label_of(start, context.scene)
    if end is not None and end.type != "EMPTY":
        raise InputError(f"object {end.name!r} is to mark the array's end, but is no empty; add an empty there")
    items = [start] if end is None else [start, end]

    def make(site: Site, scene: Scene, before: Operation | None) -> Operation:
        model = learn_row(items, site, scene, spacing, options, array_options or ArrayOptions())
        return ArrayPlacement(mesh=start.name, label=label, model=model, threshold=threshold)

    return _record_steps(context, items, ArrayPlacement, make, name or label)


def transfer_steps(
    context: bpy.types.Context,
    items: Sequence[bpy.types.Object],
    options: TransferOptions | None = None,
    marks: Sequence[bpy.types.Object] = (),
    *,
    everything: bool = False,
    name: str | None = None,
) -> Stepper[bpy.types.Node]:
    """Take a group of objects to every polygon like the one that they are in, not rigidly (section 4.7).

    Parameters
    ----------
    context : bpy.types.Context
    items : sequence of bpy.types.Object
        All in one polygon; either examples or results of other operations.
    options : TransferOptions, optional
    marks : sequence of bpy.types.Object
        At most one per polygon, the group's own among them: where lengths along its boundary start, or the corner that
        coordinates start from. Where there is none, that is found by the polygons' likeness.
    everything : bool
        Whether objects are placed too for whose coordinates a polygon has no room.
    name : str, optional
        Of the operation; by default the label of the first object.

    Returns
    -------
    generator of (float, str)
        Returns the operation's node.

    Raises
    ------
    InputError
        For what cannot be used.
    """
    if not items:
        raise InputError("nothing is selected; select the objects to transfer")
    results = [names.KEY in item for item in items]
    if any(results) and not all(results):
        raise InputError(
            f"object {items[results.index(True)].name!r} is a result of an operation and "
            f"{items[results.index(False)].name!r} is none; select either results or objects of your own"
        )
    own = not any(results)
    items = [require_object(context, item) for item in items] if own else list(items)
    labels = [label_of(item, context.scene) for item in items]

    def make(site: Site, scene: Scene, before: Operation | None) -> Operation:
        group = learn_group(items, site, scene, options or TransferOptions(), marks)
        meshes = tuple(one.mesh for one in objects_behind(items, tree_of(context.scene), site))
        return GroupPlacement(meshes=meshes, labels=tuple(labels), group=group, own=own, everything=everything)

    return _record_steps(context, items, GroupPlacement, make, name or f"{labels[0]} group")


def scatter_steps(
    context: bpy.types.Context,
    item: bpy.types.Object | None,
    scatter_options: ScatterOptions,
    options: PoseOptions = OPTIONS,
    *,
    seed: int = 0,
    name: str | None = None,
) -> Stepper[bpy.types.Node]:
    """Put copies of an object where chance falls, likelier where they answer the example better (section 4.8).

    Parameters
    ----------
    context : bpy.types.Context
    item : bpy.types.Object or None
        The example, labelled.
    scatter_options : ScatterOptions
    options : PoseOptions, optional
    seed : int
    name : str, optional
        Of the operation; by default the object's label.

    Returns
    -------
    generator of (float, str)
        Returns the operation's node.

    Raises
    ------
    InputError
        For what cannot be used.
    """
    item = require_object(context, item)
    label = label_of(item, context.scene)

    def make(site: Site, scene: Scene, before: Operation | None) -> Operation:
        model = ScatterModel(learn(item, site, scene, options), scatter_options)
        return ScatterPlacement(mesh=item.name, label=label, model=model, seed=seed)

    return _record_steps(context, [item], ScatterPlacement, make, name or label)


def is_mark(item: bpy.types.Object) -> bool:
    """Whether an object marks a place and is not placed itself.

    Parameters
    ----------
    item : bpy.types.Object

    Returns
    -------
    bool
        An empty without a label that instances nothing.
    """
    return item.type == "EMPTY" and item.instance_type == "NONE" and names.LABEL not in item


def require_object(context: bpy.types.Context, item: bpy.types.Object | None) -> bpy.types.Object:
    """An object that can be an example.

    Parameters
    ----------
    context : bpy.types.Context
    item : bpy.types.Object or None

    Returns
    -------
    bpy.types.Object

    Raises
    ------
    InputError
        Where there is none, it is not in the scene, or it is itself a result.
    """
    if item is None:
        raise InputError("nothing is selected; select the object to propagate")
    if not is_here(item, context.scene):
        raise InputError(f"object {item.name!r} is not in the scene {context.scene.name!r}; link it there")
    if names.KEY in item:
        raise InputError(
            f"object {item.name!r} is a result of {item[names.NODE]!r} itself; select the example, or one of your own"
        )
    return item


def _most_per(max_per: Mapping[str, int] | None, model: PoseModel) -> dict[str, int]:
    return {label or model.parent.label: count for label, count in (max_per or {}).items()}


def _record_steps(
    context: bpy.types.Context, items: Sequence[bpy.types.Object], kind: type[Placing], make: Make, name: str
) -> Stepper[bpy.types.Node]:
    """Record an operation: make it from what comes in, evaluate it, and write both."""
    every = read_surroundings(context, items)
    around = surroundings_of(every, items[0])
    whole = builds(around.tree)
    known = next((n for n in around.nodes if _is_of(n, around, kind, items)), None)
    if known is not None:
        before = around.engine.node(known.name)
        layout = yield from within(incoming_steps(around, known.name), 0.0, 0.3)
        site = _site(around, layout, items[0])
        operation = make(site, scene_without(site, items), before.operation)
        # What the user has accepted and rejected of it stays.
        operation = replace(operation, decisions=before.operation.decisions)
        node = replace(before, operation=operation, muted=False)
    else:
        links = chosen_outputs(around.tree, around.nodes)
        (layout,) = yield from within(after_steps([around], links), 0.0, 0.3)
        site = _site(around, layout, items[0])
        operation = make(site, scene_without(site, items), None)
        node = Node(free_id(around.tree, name), operation, links)
    placed = objects_behind(items, around.tree, site)
    if whole:
        around.engine = around.engine.with_node(node)
        layouts = yield from within(whole_steps(every), 0.3, 1.0)
    else:
        after = yield from within(evaluations.steps(node, layout, around.seed), 0.3, 1.0)
    tree = ensure_tree(context.scene)
    if known is None:
        known = add_node(tree, node, placed, around.plane)
    else:
        write_operation(known, node)
        write_placed(known, placed, around.plane)
        tree.nodes.active = known
    if whole:
        around.nodes.append(known)
        write_whole(context.scene, tree, every, layouts)
    else:
        keep_ids(context.scene, [around.ground.scene])
        write_node(known, [(around, after[0].elements)])
        mark_stale(tree, known)
    return known


def _site(around: Surroundings, layout: Layout, item: bpy.types.Object) -> Site:
    """Where an example lies: on the ground, or on a surface that an operation has made."""
    return site_of(sites_in(around.ground, layout, around.depsgraph), [around], item)


def _is_of(
    node: bpy.types.Node, around: Surroundings, kind: type[Operation], items: Sequence[bpy.types.Object]
) -> bool:
    """Whether a node is an operation of a kind with these examples."""
    known = [one.item for one in placed_by(node)]
    # Whoever gives an array an end, or takes it away, means the same array.
    same = known == list(items) or (kind is ArrayPlacement and known[:1] == items[:1] and 1 in (len(known), len(items)))
    return same and isinstance(around.engine.node(node.name).operation, kind)
