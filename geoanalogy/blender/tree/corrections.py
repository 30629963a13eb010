"""Corrections by hand: results accepted, rejected, or kept where the user has moved them."""

from collections.abc import Iterable
from dataclasses import replace

import bpy
import numpy as np

from ...errors import InputError
from ...operations.decisions import Decisions, Pin
from ...operations.element import Element
from ...operations.node import Node
from ...operations.other_places import other_places, taken_on
from ...operations.pose_placement import PosePlacement
from ...poses.pose import Pose
from ...tolerances import CONTAINED_SHARE
from .. import names
from ..reading.footprints import pose_of
from ..reading.planes import Plane
from ..regions.results import hidden_targets
from .evaluating import mark_stale
from .refresh import decided, proposed_by
from .showing import show_again
from .sites import site_under, sites_before
from .store import (
    builds,
    engine_node,
    is_building,
    is_placement,
    placed_by,
    require_operations,
    works_on_drawings,
)
from .writing_nodes import write_operation

#: Distance, in scene units, and angle, in radians, from its place below which a result has not been moved: single
#: precision at a kilometre from the origin.
UNMOVED = 1e-3


def selected_results(context: bpy.types.Context) -> list[bpy.types.Object]:
    """The results among the selected objects.

    Parameters
    ----------
    context : bpy.types.Context

    Returns
    -------
    list of bpy.types.Object
    """
    return [item for item in context.selected_objects if names.KEY in item]


def decide(context: bpy.types.Context, items: Iterable[bpy.types.Object], verdict: str) -> int:
    """Accept or reject results; those that were moved by hand are kept where they are when they are accepted.

    Parameters
    ----------
    context : bpy.types.Context
    items : iterable of bpy.types.Object
        Results.
    verdict : {"accept", "reject", "forget"}

    Returns
    -------
    int
        How many were decided on.

    Raises
    ------
    InputError
        Where there are none, their operation is gone, or one to be kept lies outside every polygon.
    """
    changed, keys = [], {}
    for node, group in _by_node(context, items):
        engine = engine_node(node)
        keys[node.name] = _keys(group)
        decisions = engine.operation.decisions.following([e.key for e in proposed_by(node)])
        # What is carried over to a region stands where that is found.
        pins = _pins(context, node, group) if verdict == "accept" and not works_on_drawings(node) else {}
        for key in keys[node.name]:
            decisions = decisions.pin(key, pins[key]) if key in pins else getattr(decisions, verdict)(key)
        changed.append((node, engine, decisions))
    for node, engine, decisions in changed:
        _write_decisions(context, node, engine, decisions)
    return sum(map(len, keys.values()))


def _by_node(
    context: bpy.types.Context, items: Iterable[bpy.types.Object]
) -> list[tuple[bpy.types.Node, list[bpy.types.Object]]]:
    """Results by the operation that placed them, which can be corrected."""
    tree = require_operations(context.scene)
    by_node: dict[str, list[bpy.types.Object]] = {}
    for item in items:
        by_node.setdefault(item[names.NODE], []).append(item)
    if not by_node:
        raise InputError(f"no result is selected; select objects in the collection {names.COLLECTION!r}")
    missing = sorted(set(by_node) - {node.name for node in tree.nodes})
    if "" in missing:
        raise InputError("the masses are merged into one mesh per label; show them singly in step 5 to correct one")
    if missing:
        raise InputError(f"the operation {missing[0]!r} is no longer there; replay, and its results will go")
    for name, group in by_node.items():
        if is_building(tree.nodes[name]):
            raise InputError(
                f"object {group[0].name!r} was made of the plan itself by {name!r}, not placed; correct the plan"
            )
    return [(tree.nodes[name], group) for name, group in by_node.items()]


def _keys(items: Iterable[bpy.types.Object]) -> list[str]:
    """The keys of results, each once: several objects may be one result."""
    return list(dict.fromkeys(item[names.KEY] for item in items))


def take_on(context: bpy.types.Context, items: Iterable[bpy.types.Object], step: int) -> tuple[int, int]:
    """Take results to another of the places of their polygons, where they stay.

    Parameters
    ----------
    context : bpy.types.Context
    items : iterable of bpy.types.Object
        Results.
    step : int
        How many places further; negative: back.

    Returns
    -------
    taken, left : int
        How many went, and how many have no other place.

    Raises
    ------
    InputError
        Where there are none, or they were not placed by a single example.
    """
    changed, taken, left = [], 0, 0
    for node, group in _by_node(context, items):
        engine = engine_node(node)
        operation = engine.operation
        if not isinstance(operation, PosePlacement):
            raise InputError(
                f"object {group[0].name!r} was not placed by Propagate, which alone knows other places; move it by "
                "hand, and press Accept"
            )
        sites = sites_before(context, node)
        proposed = proposed_by(node)
        by_key = {e.key: e for e in proposed}
        decisions = operation.decisions.following(list(by_key))
        engine = replace(engine, operation=replace(operation, decisions=decisions))
        # What is taken on stands elsewhere for those after it.
        placed = (e for site in sites for e in decided(engine, proposed, site.layout).elements)
        standing = {e.key: e for e in placed if e.node == node.name}
        for key in _keys(group):
            own = by_key.get(key)
            at = None if own is None else site_under(sites, own)
            if at is None:
                left += 1
                continue
            parent = at.scene.polygon(own.parent)
            places = other_places(own, proposed, list(standing.values()), decisions.rejected, operation.spacing)
            further = taken_on(decisions, own, places, parent, step)
            if further is None:
                left += 1
                continue
            decisions, taken = further, taken + 1
            pin = decisions.pinned.get(key)
            standing[key] = own if pin is None else replace(own, pose=pin.pose(parent), scale=pin.scale)
        changed.append((node, engine, decisions))
    for node, engine, decisions in changed:
        _write_decisions(context, node, engine, decisions)
    return taken, left


def reject_below(context: bpy.types.Context, node: bpy.types.Node) -> int:
    """Reject all results of an operation below its threshold, so that a lower one does not bring them back.

    Parameters
    ----------
    context : bpy.types.Context
    node : bpy.types.Node

    Returns
    -------
    int
        How many.
    """
    engine = engine_node(node)
    decisions = engine.operation.decisions
    below = hidden_targets(node) if works_on_drawings(node) else _hidden_results(node, engine)
    for key in below:
        decisions = decisions.reject(key)
    _write_decisions(context, node, engine, decisions)
    return len(below)


def _hidden_results(node: bpy.types.Node, engine: Node) -> list[str]:
    """The keys of results that a threshold hides and that nobody has decided on."""
    threshold = getattr(engine.operation, "threshold", 0.0)
    decisions = engine.operation.decisions
    kept = {*decisions.accepted, *decisions.pinned, *decisions.rejected}
    return [e.key for e in proposed_by(node) if e.importance < threshold and not e.example and e.key not in kept]


def forget_all(context: bpy.types.Context, node: bpy.types.Node) -> int:
    """Take back all decisions about an operation's results.

    Parameters
    ----------
    context : bpy.types.Context
    node : bpy.types.Node

    Returns
    -------
    int
        How many there were.
    """
    engine = engine_node(node)
    decisions = engine.operation.decisions
    _write_decisions(context, node, engine, Decisions())
    return len({*decisions.accepted, *decisions.rejected, *decisions.pinned})


def _write_decisions(context: bpy.types.Context, node: bpy.types.Node, engine: Node, decisions: Decisions) -> None:
    write_operation(node, replace(engine, operation=replace(engine.operation, decisions=decisions)))
    show_again(context, node)
    if not builds(node.id_data) and not works_on_drawings(node):
        mark_stale(node.id_data, node)


def _pins(context: bpy.types.Context, node: bpy.types.Node, items: Iterable[bpy.types.Object]) -> dict[str, Pin]:
    """Where those results stand that have been moved, by their keys."""
    sites = sites_before(context, node)
    proposed = {e.key: e for e in proposed_by(node)}
    rests = {one.mesh: one.rest for one in placed_by(node)}
    found = {}
    for item in items:
        e = proposed.get(item[names.KEY])
        at = None if e is None else site_under(sites, e)
        if at is None:
            continue
        if names.MASS in item.users_collection[0]:
            pose = pose_of(item, at.plane)
        elif is_placement(node):
            pose = _pose_of_placed(item, e, rests[e.mesh], at.plane)
        else:
            pose = pose_of(item, at.plane)
        if _is_at(pose, e.pose):
            continue
        pose = replace(pose, mirrored=e.pose.mirrored)
        ring = pose.to_scene(e.scale * np.array(e.stretch) * np.array(e.footprint or [(0.0, 0.0)]))
        parent = at.scene.parent_of_shape(ring, CONTAINED_SHARE) if e.footprint else None
        parent = parent or at.scene.parent_of(pose.position)
        if parent is None:
            raise InputError(f"object {item.name!r} lies outside every polygon; put it into one to keep it there")
        found[e.key] = Pin.of(pose, parent, e.scale)
    return found


def _pose_of_placed(item: bpy.types.Object, e: Element, rest: np.ndarray, plane: Plane) -> Pose:
    """The pose that a result of a placement stands for: the centre and the direction of its rectangle."""
    frame = np.array(item.matrix_world) @ np.linalg.inv(np.diag((*np.multiply(e.scale, e.stretch), 1.0, 1.0)) @ rest)
    x, y, _ = plane.to_plane([frame[:3, 3]])[0]
    axis = plane.matrix[:3, :3].T @ frame[:3, 0]
    return Pose((x, y), float(np.arctan2(axis[1], axis[0])))


def _is_at(one: Pose, other: Pose) -> bool:
    turned = abs(np.angle(np.exp(1j * (one.angle - other.angle))))
    return bool(np.hypot(*np.subtract(one.position, other.position)) < UNMOVED and turned < UNMOVED)
