"""Recording region transfers: what the operators do, and what a script calls (chapter 3).

Each function that takes a while is a stepper; `geoanalogy.progress.run` drives it to its end. Where anything fails, the
scene stays as it was.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from time import perf_counter

import bpy
import numpy as np
import shapely
from numpy.typing import NDArray

from ...errors import InputError
from ...operations.node import Link, Node
from ...operations.region_transfer import Found, RegionTransfer, Target
from ...progress import Stepper, within
from ...regions.options import RegionOptions
from .. import names
from ..reading.planes import Plane
from ..tree.editing import free_id, leaf
from ..tree.store import drawing_nodes, engine_node, ensure_tree, plane_of, recorded_nodes, tree_of, works_on_drawings
from ..tree.writing_nodes import add_node, write_operation
from ..writing.instances import clear_results
from .contents import points_of
from .drawings import DrawnLines, read_drawn_lines
from .finding import find_steps, read_operation
from .patches import add_patch
from .results import StoredTarget, clear_targets, contents_of, key_of, show_targets, write_targets

Array = NDArray[np.float64]

#: Depth of the first image below the lines of its drawing, and of each further one above it, in sizes of the drawing.
BELOW_LINES, ABOVE_EACH_OTHER = 0.02, 0.001

#: Step by which the local size of a mapping is measured, in sizes of the query.
NEAR = 1e-3

#: Digits that a threshold found by the engine is rounded to, downwards.
DIGITS = 3


@dataclass(frozen=True)
class Transfer:
    """A region transfer that has been evaluated, to be written.

    Attributes
    ----------
    operation : RegionTransfer
    targets : list of StoredTarget
    source : Plane
        Where the query and what is carried over lie.
    drawn : DrawnLines
        The drawing that the targets are in.
    seconds : float
    """

    operation: RegionTransfer
    targets: list[StoredTarget]
    source: Plane
    drawn: DrawnLines
    seconds: float


def region_steps(
    context: bpy.types.Context,
    query: bpy.types.Object | None,
    options: RegionOptions | None = None,
    contents: Sequence[bpy.types.Object] = (),
    *,
    threshold: float | None = None,
    name: str | None = None,
) -> Stepper[bpy.types.Node]:
    """Find the regions of the drawing that are similar to a query, and record it.

    Parameters
    ----------
    context : bpy.types.Context
    query : bpy.types.Object or None
        A closed line round a region, or an open one along a thin shape.
    options : RegionOptions, optional
    contents : sequence of bpy.types.Object
        What is carried over: meshes, curves, strokes, or anything that stands on the drawing. None yet: the outlines of
        what was found are shown.
    threshold : float, optional
        Least similarity of what is shown; None: as the engine thinks right. Can be changed later without computing.
    name : str, optional
        Of the operation; by default that of the query.

    Returns
    -------
    generator of (float, str)
        Returns the operation's node. A query that was matched before keeps its operation, which is recorded anew.

    Raises
    ------
    InputError
        For what cannot be used.
    """
    started = perf_counter()
    drawn = read_drawn_lines(context)
    known = _node_of(context.scene, query)
    contents = list(contents) or ([] if known is None else contents_of(known))
    operation = read_operation(drawn, query, options or RegionOptions())
    if known is not None:
        # What the user has accepted and rejected of it stays.
        operation = replace(operation, decisions=engine_node(known).operation.decisions)
    found = yield from find_steps(operation, drawn)
    least = found.threshold if threshold is None else threshold
    operation = replace(operation, threshold=_rounded_down(least))
    made = _evaluated(operation, found, contents, drawn.plane, drawn, started)
    tree = ensure_tree(context.scene)
    if known is None:
        source = leaf(drawing_nodes(tree), tree.nodes.active)
        links = () if source is None else (Link(source.name),)
        known = add_node(tree, Node(free_id(tree, name or query.name), operation, links), [], drawn.plane)
    else:
        known.mute = False
        tree.nodes.active = known
    known[names.QUERY_OBJECT] = query
    _write_contents(known, contents)
    write_transfer(context.scene, known, made)
    return known


def carry_steps(
    context: bpy.types.Context, node: bpy.types.Node, items: Sequence[bpy.types.Object], *, only: bool = False
) -> Stepper[int]:
    """Carry objects over to all regions that an operation shows.

    Parameters
    ----------
    context : bpy.types.Context
    node : bpy.types.Node
        Of a region transfer.
    items : sequence of bpy.types.Object
    only : bool
        Whether they replace what was carried over before.

    Returns
    -------
    generator of (float, str)
        Returns to how many regions.

    Raises
    ------
    InputError
        Where the node is no region transfer, or an object cannot be carried over.
    """
    require_transfer(node)
    items = [item for item in items if names.QUERY not in item]
    if not items:
        raise InputError("nothing is selected; select what is painted on the query")
    for item in items:
        if names.KEY in item:
            raise InputError(f"object {item.name!r} is a result; select what is painted on the query")
        points_of(item)
    before = [] if only else contents_of(node)
    contents = list(dict.fromkeys([*before, *items]))
    marked = [item for item in items if names.CONTENT not in item]
    try:
        for item in marked:
            # It is no line of the drawing that it lies on.
            item[names.CONTENT] = True
        made = yield from evaluated_steps(context, node, contents, relearn=False)
    except BaseException:
        for item in marked:
            item.pop(names.CONTENT, None)
        raise
    _write_contents(node, contents)
    return write_transfer(context.scene, node, made)


def image_steps(
    context: bpy.types.Context, node: bpy.types.Node, image: bpy.types.Image | None, width: float = 0.0
) -> Stepper[int]:
    """Lay an image over the query of an operation, and carry it over to all regions that it shows.

    Parameters
    ----------
    context : bpy.types.Context
    node : bpy.types.Node
        Of a region transfer.
    image : bpy.types.Image or None
        With alpha; it fills the box round the query.
    width : float
        How far it reaches beside a stroke, as a share of the stroke's length; 0: as far as lines belong to it.

    Returns
    -------
    generator of (float, str)
        Returns to how many regions.

    Raises
    ------
    InputError
        Where there is no image, it cannot be read, or the node is no region transfer.
    """
    require_transfer(node)
    if image is None:
        raise InputError("there is no image; choose one that is painted for the query")
    if not all(image.size):
        where = f" from {image.filepath!r}" if image.filepath else ""
        raise InputError(f"the image {image.name!r} cannot be read{where}; choose one that is there")
    drawn = read_drawn_lines(context)
    operation = engine_node(node).operation
    if width > 0.0:
        operation = replace(operation, options=replace(operation.options, reach=width))
    patch = lay_image(context, operation.region, image, plane_of(node), drawn.size)
    try:
        return (yield from carry_steps(context, node, [patch]))
    except BaseException:
        mesh = patch.data
        bpy.data.objects.remove(patch)
        bpy.data.meshes.remove(mesh)
        raise


def lay_image(
    context: bpy.types.Context, region: shapely.Geometry, image: bpy.types.Image, plane: Plane, size: float
) -> bpy.types.Object:
    """Lay an image over a region: below the lines, above the images that were laid before.

    Parameters
    ----------
    context : bpy.types.Context
    region : shapely geometry
    image : bpy.types.Image
    plane : Plane
        That the region is on.
    size : float
        Of the drawing.

    Returns
    -------
    bpy.types.Object
        A patch with UVs and a material.
    """
    laid = sum(item.get(names.CONTENT) == "image" for item in context.scene.objects if names.KEY not in item)
    height = size * (ABOVE_EACH_OTHER * laid - BELOW_LINES)
    patch = add_patch(context.scene, region, image, plane, height, image.name.rsplit(".", 1)[0])
    patch[names.CONTENT] = "image"
    return patch


def evaluated_steps(
    context: bpy.types.Context,
    node: bpy.types.Node,
    contents: Sequence[bpy.types.Object] | None = None,
    *,
    relearn: bool = True,
    threshold: float | None = None,
) -> Stepper[Transfer]:
    """Evaluate a recorded region transfer on what is drawn now; nothing is written.

    Parameters
    ----------
    context : bpy.types.Context
    node : bpy.types.Node
    contents : sequence of bpy.types.Object, optional
        None: those of the node.
    relearn : bool
        Whether the query is read again, where its object is in the scene and goes round lines of the drawing. Else, and
        in another drawing, the lines that it was recorded with are looked for.
    threshold : float, optional
        None: that of the operation.

    Returns
    -------
    generator of (float, str)
        Returns the Transfer.

    Raises
    ------
    InputError
        For what cannot be used, naming the operation.
    """
    started = perf_counter()
    drawn = read_drawn_lines(context)
    operation = engine_node(node).operation
    source = plane_of(node)
    query = node.get(names.QUERY_OBJECT)
    if relearn and query is not None and context.scene.objects.get(query.name) == query:
        try:
            fresh = read_operation(drawn, query, operation.options)
        except InputError:
            # Another drawing: the lines that were recorded are looked for in it.
            pass
        else:
            operation = replace(fresh, threshold=operation.threshold, decisions=operation.decisions)
            source = drawn.plane
    if threshold is not None:
        operation = replace(operation, threshold=threshold)
    try:
        found = yield from find_steps(operation, drawn)
        own = contents_of(node) if contents is None else contents
        return _evaluated(operation, found, own, source, drawn, started)
    except InputError as error:
        raise InputError(f"the operation {node.name!r}: {error}") from None


def write_transfer(scene: bpy.types.Scene, node: bpy.types.Node, made: Transfer) -> int:
    """Write an evaluated region transfer into its node, and show what passes.

    Parameters
    ----------
    scene : bpy.types.Scene
    node : bpy.types.Node
    made : Transfer

    Returns
    -------
    int
        How many regions are shown.
    """
    write_operation(node, Node(node.name, made.operation, muted=node.mute))
    node[names.FRAME] = made.source.matrix.ravel().tolist()
    node[names.SECONDS] = made.seconds
    write_targets(node, made.targets, made.drawn.plane, made.drawn.size)
    for key in (names.STALE, names.PROBLEM):
        node.pop(key, None)
    clear_targets(scene, node)
    return show_targets(scene, node)


def replayed_steps(
    context: bpy.types.Context, nodes: Sequence[bpy.types.Node], threshold: float | None = None
) -> Stepper[list[tuple[bpy.types.Node, Transfer]]]:
    """Evaluate all region transfers of a scene again; nothing is written.

    Parameters
    ----------
    context : bpy.types.Context
    nodes : sequence of bpy.types.Node
    threshold : float, optional
        None: each operation's own.

    Returns
    -------
    generator of (float, str)
        Returns what is to be written with `write_transfer`.
    """
    made = []
    for i, node in enumerate(nodes):
        steps = evaluated_steps(context, node, threshold=threshold)
        made.append((node, (yield from within(steps, i / len(nodes), (i + 1) / len(nodes)))))
    return made


def write_replayed(scene: bpy.types.Scene, transfers: Sequence[tuple[bpy.types.Node, Transfer]]) -> int:
    """Write what `replayed_steps` has evaluated, and delete the results of region transfers that are gone.

    Parameters
    ----------
    scene : bpy.types.Scene
    transfers : sequence of (bpy.types.Node, Transfer)

    Returns
    -------
    int
        How many regions are shown.
    """
    present = {node.name for node in recorded_nodes(tree_of(scene))}
    gone = {i[names.NODE] for i in scene.objects if names.SIMILARITY in i and i[names.NODE] not in present}
    clear_results(scene, gone)
    return sum(write_transfer(scene, node, made) for node, made in transfers)


def require_transfer(node: bpy.types.Node) -> None:
    """Refuse nodes that are no region transfers.

    Parameters
    ----------
    node : bpy.types.Node

    Raises
    ------
    InputError
        Naming the node.
    """
    if not works_on_drawings(node):
        raise InputError(f"the operation {node.name!r} works on no drawing; click one that does in the list of step 5")


def _node_of(scene: bpy.types.Scene, query: bpy.types.Object | None) -> bpy.types.Node | None:
    """The region transfer that a query was recorded with."""
    return next((n for n in drawing_nodes(tree_of(scene)) if n.get(names.QUERY_OBJECT) == query), None)


def _evaluated(
    operation: RegionTransfer,
    found: Found,
    contents: Sequence[bpy.types.Object],
    source: Plane,
    drawn: DrawnLines,
    started: float,
) -> Transfer:
    """The targets with the places of all that is carried over."""
    parts = [source.to_plane(points_of(item))[:, :2] for item in contents]
    targets = stored_targets(operation, found, np.vstack([*parts, np.zeros((0, 2))]))
    return Transfer(operation, targets, source, drawn, perf_counter() - started)


def stored_targets(operation: RegionTransfer, found: Found, points: Array | None = None) -> list[StoredTarget]:
    """What was found, with all that is needed to show it.

    Parameters
    ----------
    operation : RegionTransfer
    found : Found
    points : ndarray of shape (n, 2), optional
        Of what is carried over, on the plane of the query.

    Returns
    -------
    list of StoredTarget
        In the order of the matches.
    """
    points = np.zeros((0, 2)) if points is None else points
    query = np.array(operation.query)
    step = NEAR * float(np.ptp(query, axis=0).max())
    return [_stored_target(target, query, points, step) for target in found.targets]


def _stored_target(target: Target, query: Array, points: Array, step: float) -> StoredTarget:
    outline = target.map(query)
    moved, trust = np.zeros((0, 4)), target.confidence(query)
    if len(points):
        there = target.map(points)
        x, y = (target.map(points + offset) - there for offset in ((step, 0.0), (0.0, step)))
        size = np.sqrt(np.abs(x[:, 0] * y[:, 1] - x[:, 1] * y[:, 0])) / step
        trust = target.confidence(points)
        moved = np.column_stack([there, size, trust])
    return StoredTarget(
        key_of(outline),
        float(target.similarity),
        float(target.coverage),
        float(np.mean(trust)),
        bool(target.mirrored),
        outline,
        moved,
    )


def _write_contents(node: bpy.types.Node, contents: Sequence[bpy.types.Object]) -> None:
    node[names.CONTENTS] = {str(i): {"object": item} for i, item in enumerate(contents)}


def _rounded_down(value: float) -> float:
    return float(np.floor(value * 10**DIGITS) / 10**DIGITS)
