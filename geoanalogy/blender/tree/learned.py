"""What a placement has learned, for the panels: its rule in words, and where it is on unfamiliar ground."""

import json
from dataclasses import dataclass
from functools import lru_cache

import bpy

from ...operations.element import Element
from .. import names
from .explanation import Reason
from .node_settings import stored_settings
from .refresh import proposed_by


@dataclass(frozen=True)
class Target:
    """A polygon that a placement has placed in.

    Attributes
    ----------
    name : str
    novelty : float
        Mean over its results: how far from anything that was taught, 0 to 1.
    count : int
        Results above the threshold.
    """

    name: str
    novelty: float
    count: int


def rule_of(node: bpy.types.Node) -> tuple[Reason, ...]:
    """The learned rule in words.

    Parameters
    ----------
    node : bpy.types.Node

    Returns
    -------
    tuple of Reason
        The surest first; empty for other operations than placements.
    """
    return _read_rule(node.get(names.RULE, ""))


@lru_cache(maxsize=64)
def _read_rule(text: str) -> tuple[Reason, ...]:
    return tuple(Reason(words, weight) for words, weight in json.loads(text)) if text else ()


def targets_of(node: bpy.types.Node) -> tuple[Target, ...]:
    """The polygons that a placement has placed in.

    Parameters
    ----------
    node : bpy.types.Node

    Returns
    -------
    tuple of Target
        The least familiar first: an example there teaches most.
    """
    return _targets(proposed_by(node), float(stored_settings(node).get("threshold", 0.0)))


@lru_cache(maxsize=64)
def _targets(proposed: tuple[Element, ...], threshold: float) -> tuple[Target, ...]:
    of: dict[str, list[float]] = {}
    for e in proposed:
        if not e.example and e.importance >= threshold:
            of.setdefault(e.parent, []).append(e.novelty)
    found = [Target(name, sum(values) / len(values), len(values)) for name, values in of.items()]
    return tuple(sorted(found, key=lambda one: (-one.novelty, one.name)))


def novelty_of(item: bpy.types.Object | None, node: bpy.types.Node) -> float | None:
    """How far from anything that was taught a result is.

    Parameters
    ----------
    item : bpy.types.Object or None
    node : bpy.types.Node

    Returns
    -------
    float or None
        None where it is no result of that placement.
    """
    if item is None or item.get(names.NODE) != node.name or names.RULE not in node:
        return None
    return next((e.novelty for e in proposed_by(node) if e.key == item[names.KEY]), None)
