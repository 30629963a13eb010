"""Evaluating a scene's operations tree, and writing what comes of it.

Everything is read before the first step and written after the last one, so that work that is cancelled or fails leaves
the scene as it was.
"""

import json
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from time import perf_counter
from typing import Any

import bpy

from ...errors import InputError
from ...geometry.scene import Scene
from ...operations.element import Element
from ...operations.evaluation import Evaluations
from ...operations.layout import Layout
from ...operations.node import Link, Node
from ...operations.operation import Operation
from ...operations.tree import OperationsTree
from ...progress import Stepper, within
from .. import names
from ..reading.ground import Ground, only_in, read_grounds
from ..reading.planes import Plane
from ..reading.whereabouts import up_to_date
from ..writing.bending import Bender
from ..writing.instances import is_instance, write_results
from .proposals import write_proposals
from .refresh import examples_of, ground_for, in_order
from .store import (
    builds,
    engine_tree,
    is_building,
    ordered_nodes,
    placed_by,
    plane_of,
    sources_by_node,
    tree_of,
    works_everywhere,
)


@dataclass(frozen=True)
class _Flow:
    """What a node was evaluated on, and what came of it."""

    operation: Operation
    muted: bool
    seed: int
    incoming: Layout
    outgoing: tuple[Layout, ...]

    def is_of(self, node: Node, layout: Layout, seed: int) -> bool:
        """Whether a node is this very one, and what comes in to it and the seed are equal."""
        same = self.operation is node.operation and (self.muted, self.seed) == (node.muted, seed)
        return same and self.incoming == layout


class TimedEvaluations(Evaluations):
    """What nodes have proposed, and how long each took when it was last computed.

    Nodes that get what they got before give what they gave before, without being asked: where a slider is moved, only
    what follows is looked at, and of that nothing that comes after the last change.

    Attributes
    ----------
    proposed : dict of (str, str) to object
        By the node's id and the name of its ground, of its last evaluation there.
    seconds : dict of (str, str) to float
    """

    def __init__(self) -> None:
        super().__init__()
        self.proposed: dict[tuple[str, str], Any] = {}
        self.seconds: dict[tuple[str, str], float] = {}
        self._flows: dict[tuple[str, str], _Flow] = {}
        self._grounds: dict[str, Ground] = {}

    def same_ground(self, ground: Ground) -> Ground:
        """A ground as it was read before, where nothing of it has changed, with all that was derived from it."""
        name = ground_name(ground.scene)
        before = self._grounds.get(name)
        if before is None or not _equal(before, ground):
            before = self._grounds[name] = ground
        return before

    def steps(self, node: Node, layout: Layout, seed: int) -> Stepper[tuple[Layout, ...]]:
        """What flows out of a node; where that equals what flowed out before, the same objects."""
        where = node.id, ground_name(layout.ground)
        before = self._flows.get(where)
        if before is not None and before.is_of(node, layout, seed):
            return before.outgoing
        after = yield from super().steps(node, layout, seed)
        if before is not None and len(before.outgoing) == len(after):
            after = tuple(old if old == new else new for old, new in zip(before.outgoing, after, strict=True))
        self._flows[where] = _Flow(node.operation, node.muted, seed, layout, after)
        return after

    def proposal(self, node: Node, layout: Layout, seed: int) -> Stepper[Any]:
        """What a node proposes; what was computed for it is timed."""
        computed, started = self.evaluated, perf_counter()
        proposed = yield from super().proposal(node, layout, seed)
        where = node.id, ground_name(layout.ground)
        self.proposed[where] = proposed
        if self.evaluated > computed:
            self.seconds[where] = perf_counter() - started
        return proposed

    def clear(self) -> None:
        """Forget everything."""
        self.leave_ground()
        for kept in (self._surfaces, self.proposed, self.seconds, self._flows, self._grounds):
            kept.clear()


def _equal(one: Ground, other: Ground) -> bool:
    """Whether two grounds have the same polygons on the same plane."""
    if (one.plane, one.alternatives, len(one.scene)) != (other.plane, other.alternatives, len(other.scene)):
        return False
    pairs = zip(one.scene.polygons, other.scene.polygons, strict=True)
    return one.scene.offset == other.scene.offset and all(a.content == b.content for a, b in pairs)


def ground_name(scene: Scene) -> str:
    """What tells the grounds of a file apart: the id of the first polygon.

    Parameters
    ----------
    scene : Scene

    Returns
    -------
    str
    """
    return str(scene.polygons[0].id)


#: What has been evaluated in this session, by content: nothing in it is ever out of date.
evaluations = TimedEvaluations()


@dataclass
class Surroundings:
    """What an operation on a plane starts from.

    Attributes
    ----------
    scene : bpy.types.Scene
    depsgraph : bpy.types.Depsgraph
    tree : bpy.types.NodeTree or None
        None before the first operation.
    ground : Ground
    nodes : list of bpy.types.Node
        The operations on that plane, inputs first.
    engine : OperationsTree
        All operations as the engine's; those on other planes pass on what comes in.
    problems : tuple of str
        What of the scene has been left out, a sentence each.
    """

    scene: bpy.types.Scene
    depsgraph: bpy.types.Depsgraph
    tree: bpy.types.NodeTree | None
    ground: Ground
    nodes: list[bpy.types.Node]
    engine: OperationsTree
    problems: tuple[str, ...] = ()

    @property
    def plane(self) -> Plane:
        """The plane of the ground."""
        return self.ground.plane

    @property
    def name(self) -> str:
        """The name of the ground."""
        return ground_name(self.ground.scene)

    @property
    def seed(self) -> int:
        """The tree's seed."""
        return 0 if self.tree is None else self.tree.seed


def read_surroundings(
    context: bpy.types.Context, items: Iterable[bpy.types.Object] = (), chosen: Iterable[str] | None = None
) -> list[Surroundings]:
    """Read a scene: its planes and the operations on each.

    Parameters
    ----------
    context : bpy.types.Context
    items : iterable of bpy.types.Object
        Objects that do not count as ground, besides the examples of operations.
    chosen : iterable of str, optional
        Ids of the objects of the plan that count, with what lies in them and what they lie in; empty: all; None:
        those that the tree is applied to.

    Returns
    -------
    list of Surroundings
        One per plane, the largest first.

    Raises
    ------
    InputError
        For what cannot be used, naming the object or the operation.
    """
    scene = context.scene
    depsgraph = up_to_date(context)
    tree = tree_of(scene)
    without = examples_of(tree) | {item.name for item in items}
    if builds(tree):
        # What was drawn as an example stays one, also where the tree has come from a file without it.
        without |= {item.name for item in scene.objects if names.DRAWN in item}
    parcels = frozenset(parcels_of(tree) if chosen is None else chosen)
    # Where many parcels are built on, one that cannot be used does not stand in the way of the others.
    problems: list[str] | None = [] if builds(tree) else None
    grounds = restricted(read_grounds(scene, depsgraph, without, problems), parcels)
    grounds = [evaluations.same_ground(ground) for ground in grounds]
    nodes = ordered_nodes(tree)
    engine = engine_tree(nodes, evaluations)
    where = {node.name: None if works_everywhere(node) else ground_for(grounds, plane_of(node)) for node in nodes}
    by_node = {} if tree is None else sources_by_node(tree)
    for node in nodes:
        # A node goes where its source is: it builds on what that has placed.
        for source, _ in by_node.get(node.name, ()):
            if where[node.name] is not None and where[source.name] is not None:
                where[node.name] = where[source.name]
    found = []
    for ground in grounds:
        own = [node for node in nodes if where[node.name] is None or where[node.name] is ground]
        working = {node.name for node in own}
        there = [replace(node, muted=node.muted or node.id not in working) for node in engine.nodes]
        engine_there = OperationsTree(there, evaluations)
        found.append(Surroundings(scene, depsgraph, tree, ground, own, engine_there, tuple(problems or ())))
    return found


def parcels_of(tree: bpy.types.NodeTree | None) -> list[str]:
    """Ids of the objects of the plan that a tree is applied to.

    Parameters
    ----------
    tree : bpy.types.NodeTree or None

    Returns
    -------
    list of str
        Empty: all.
    """
    return [] if tree is None else json.loads(tree.get(names.APPLIED_TO, "[]"))


def restricted(grounds: list[Ground], chosen: frozenset[str]) -> list[Ground]:
    """A part of a scene.

    Parameters
    ----------
    grounds : list of Ground
    chosen : frozenset of str
        Ids of objects.

    Returns
    -------
    list of Ground
        What is chosen, with what lies in it and what it lies in; all, where nothing of it is there.
    """
    if not chosen:
        return grounds
    parts = [part for part in (only_in(ground, chosen) for ground in grounds) if part.scene.polygons]
    return parts or grounds


def incoming_steps(around: Surroundings, node: str) -> Stepper[Layout]:
    """What comes in to a node, as a stepper.

    Parameters
    ----------
    around : Surroundings
    node : str

    Returns
    -------
    generator of (float, str)
        Returns the layout.
    """
    # A muted node passes on what comes in.
    muted = around.engine.with_node(replace(around.engine.node(node), muted=True))
    return muted.layout_steps(around.ground.scene, node, around.seed)


def after_steps(every: Sequence[Surroundings], links: Sequence[Link]) -> Stepper[list[Layout]]:
    """What flows out of some outputs together on each plane, as a stepper.

    Parameters
    ----------
    every : sequence of Surroundings
    links : sequence of Link
        None: the bare ground.

    Returns
    -------
    generator of (float, str)
        Returns a list of Layout.
    """
    found = []
    for i, around in enumerate(every):
        layout = Layout(around.ground.scene)
        if links:
            steps = around.engine.layout_steps(around.ground.scene, links, around.seed)
            layout = yield from within(steps, i / len(every), (i + 1) / len(every))
        found.append(layout)
    return found


def write_node(node: bpy.types.Node, evaluated: Sequence[tuple[Surroundings, Iterable[Element]]]) -> int:
    """Write what an evaluated node has proposed, and show what has passed.

    Parameters
    ----------
    node : bpy.types.Node
    evaluated : sequence of (Surroundings, iterable of Element)
        The grounds that it works on, and what has passed on each; elements of other nodes are left out.

    Returns
    -------
    int
        How many objects stand there.
    """
    for key in (names.STALE, names.PROBLEM):
        node.pop(key, None)
    places = [(node.name, around.name) for around, _ in evaluated]
    if not node.mute:
        node[names.SECONDS] = sum(evaluations.seconds.get(place, 0.0) for place in places)
    if is_building(node):
        node[names.COUNT] = 0 if node.mute else sum(_touched(evaluations.proposed.get(place, ())) for place in places)
        return 0
    if not node.mute:
        proposed = (e for place in places for e in evaluations.proposed.get(place, ()))
        node[names.RESULTS] = write_proposals(proposed)
    standing = [] if node.mute else in_order(node, [(around.plane, elements) for around, elements in evaluated])
    scene = evaluated[0][0].scene
    shown = write_results(scene, node.name, standing, placed_by(node), bender=Bender.of(node))
    node[names.COUNT] = shown + sum(not is_instance(e) for e, _ in standing)
    return shown


def _touched(proposed: Any) -> int:
    """How many elements an operation has made, changed or divided that places none."""
    return len(proposed if isinstance(proposed, dict) else proposed[0]) if proposed else 0


def mark_stale(tree: bpy.types.NodeTree, node: bpy.types.Node) -> None:
    """Mark the operations that build on a node: they were evaluated before it changed.

    Parameters
    ----------
    tree : bpy.types.NodeTree
    node : bpy.types.Node
    """
    changed, by_node = {node.name}, sources_by_node(tree)
    for other in ordered_nodes(tree):
        if any(source.name in changed for source, _ in by_node.get(other.name, ())):
            changed.add(other.name)
            other[names.STALE] = True


def surroundings_of(
    around: list[Surroundings], item: bpy.types.Object, point: Sequence[float] | None = None
) -> Surroundings:
    """The plane that an object stands on.

    Parameters
    ----------
    around : list of Surroundings
    item : bpy.types.Object
    point : sequence of three float, optional
        What of it stands there, in the world; None: its origin.

    Returns
    -------
    Surroundings
        Of the planes on which a polygon lies below the point the nearest, else of all.

    Raises
    ------
    InputError
        Where the matrix of the object is not finite.
    """
    origin = item.matrix_world.translation if point is None else point
    if not all(abs(v) < float("inf") for v in origin):
        raise InputError(f"object {item.name!r} has a location that is not finite; clear its transform")

    def rank(one: Surroundings) -> tuple[bool, float]:
        x, y, height = one.plane.to_plane([origin])[0]
        return one.ground.scene.parent_of((x, y)) is None, abs(height)

    return min(around, key=rank)
