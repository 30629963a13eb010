"""What a placement has learned, for the panels: its rule in words, and where it is on unfamiliar ground."""

import json
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache

import bpy

from ...operations.element import Element
from ...operations.rectangle_placement import RectanglePlacement
from ...progress import Stepper
from .. import names
from .explanation import Reason
from .node_settings import stored_settings
from .refresh import proposed_by
from .sites import Site

#: Novelty from which an example more would help.
UNFAMILIAR = 0.4

#: Faces that are kept with a node: more than anybody gives examples on.
MOST_KEPT = 100

Point = tuple[float, float, float]


@dataclass(frozen=True)
class Face:
    """A face that is unlike all that was taught.

    Attributes
    ----------
    name : str
        Of its polygon: the object that it was drawn as, or the element that an operation has made.
    novelty : float
        How far from anything that was taught, 0 to 1.
    ring : tuple of (float, float, float)
        Its outline in the world.
    """

    name: str
    novelty: float
    ring: tuple[Point, ...]


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


def unfamiliar_steps(operation: RectanglePlacement, sites: Sequence[Site]) -> Stepper[list[Face]]:
    """The faces that are unlike the examples of a placement, whether something is placed there or not, as a stepper.

    Parameters
    ----------
    operation : RectanglePlacement
    sites : sequence of Site
        With what comes in to the operation.

    Returns
    -------
    generator of (float, str)
        Returns a list of Face, the least familiar first: an example there teaches most.
    """
    found = []
    for i, site in enumerate(sites):
        yield i / len(sites), "looking for unfamiliar faces"
        for polygon, novelty in operation.model.novelties(site.scene):
            if novelty >= UNFAMILIAR:
                ring = site.plane.to_world([(*point, 0.0) for point in polygon.points.tolist()])
                found.append(Face(str(polygon.id), novelty, tuple(map(tuple, ring.tolist()))))
    return sorted(found, key=lambda face: (-face.novelty, face.name))[:MOST_KEPT]


def write_unfamiliar(node: bpy.types.Node, faces: Sequence[Face]) -> None:
    """Write which faces are unlike the examples of a placement.

    Parameters
    ----------
    node : bpy.types.Node
    faces : sequence of Face
    """
    rows = [[face.name, face.novelty, face.ring] for face in faces]
    node[names.UNFAMILIAR] = json.dumps(rows, ensure_ascii=False, allow_nan=False)


def unfamiliar_of(node: bpy.types.Node | None) -> tuple[Face, ...]:
    """The faces that were unlike the examples of a placement when it was learned.

    Parameters
    ----------
    node : bpy.types.Node or None

    Returns
    -------
    tuple of Face
        The least familiar first; empty for other operations, and where a replay may have changed the faces since.
    """
    return () if node is None else _read_faces(node.get(names.UNFAMILIAR, ""))


@lru_cache(maxsize=64)
def _read_faces(text: str) -> tuple[Face, ...]:
    rows = json.loads(text) if text else []
    return tuple(Face(name, novelty, tuple(map(tuple, ring))) for name, novelty, ring in rows)


def placed_on(node: bpy.types.Node) -> Mapping[str, int]:
    """How many objects a placement has put on each face.

    Parameters
    ----------
    node : bpy.types.Node

    Returns
    -------
    mapping of str to int
        By the face's name, those above the threshold; faces without any are not in it.
    """
    return _counts(proposed_by(node), float(stored_settings(node).get("threshold", 0.0)))


@lru_cache(maxsize=64)
def _counts(proposed: tuple[Element, ...], threshold: float) -> Mapping[str, int]:
    return Counter(e.parent for e in proposed if e.example or e.importance >= threshold)


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
