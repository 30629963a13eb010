"""Decisions by hand about regions that were found: accepted, rejected, forgotten."""

from collections.abc import Iterable
from dataclasses import replace

import bpy

from ...operations.decisions import Decisions
from .. import names
from ..tree.store import drawing_nodes, engine_node, tree_of
from ..tree.writing_nodes import write_operation
from .results import reject_all_below, show_targets


def decide_on_regions(
    context: bpy.types.Context, items: Iterable[bpy.types.Object], verdict: str
) -> tuple[int, list[bpy.types.Object]]:
    """Accept or reject those results that are regions of a drawing.

    Parameters
    ----------
    context : bpy.types.Context
    items : iterable of bpy.types.Object
        Results of any operation.
    verdict : {"accept", "reject"}

    Returns
    -------
    int
        On how many regions was decided.
    list of bpy.types.Object
        The results of other operations.
    """
    nodes = {node.name: node for node in drawing_nodes(tree_of(context.scene))}
    keys: dict[str, dict[str, None]] = {}
    others = []
    for item in items:
        if item[names.NODE] in nodes:
            keys.setdefault(item[names.NODE], {})[item[names.KEY]] = None
        else:
            others.append(item)
    for name, own in keys.items():
        decisions = engine_node(nodes[name]).operation.decisions
        for key in own:
            decisions = getattr(decisions, verdict)(key)
        write_decisions(context.scene, nodes[name], decisions)
    return sum(map(len, keys.values())), others


def reject_regions_below(context: bpy.types.Context, node: bpy.types.Node) -> int:
    """Reject all regions below the threshold of an operation, so that a lower one does not bring them back.

    Parameters
    ----------
    context : bpy.types.Context
    node : bpy.types.Node
        Of a region transfer.

    Returns
    -------
    int
        How many.
    """
    before = engine_node(node).operation.decisions
    decisions = reject_all_below(node)
    write_decisions(context.scene, node, decisions)
    return len(decisions.rejected) - len(before.rejected)


def forget_regions(context: bpy.types.Context, node: bpy.types.Node) -> int:
    """Take back all decisions about the regions of an operation.

    Parameters
    ----------
    context : bpy.types.Context
    node : bpy.types.Node
        Of a region transfer.

    Returns
    -------
    int
        How many there were.
    """
    before = engine_node(node).operation.decisions
    write_decisions(context.scene, node, Decisions())
    return len({*before.accepted, *before.rejected})


def write_decisions(scene: bpy.types.Scene, node: bpy.types.Node, decisions: Decisions) -> None:
    """Write decisions into a region transfer, and show what passes.

    Parameters
    ----------
    scene : bpy.types.Scene
    node : bpy.types.Node
    decisions : Decisions
    """
    engine = engine_node(node)
    write_operation(node, replace(engine, operation=replace(engine.operation, decisions=decisions)))
    show_targets(scene, node)
