"""Tiles: spatial parts of a scene that are built apart, each with all that its parcels depend on."""

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ..geometry.polygon import Polygon
from ..geometry.scene import Scene
from ..operations.extrusion import Extrusion
from ..operations.placing import Placing
from ..operations.selection import Selection
from ..operations.tree import OperationsTree

#: Parcels of a tile unless somebody says otherwise: some seconds of work, so that little is lost when it is stopped,
#: and enough for equal surfaces to meet.
PARCELS_PER_TILE = 24


@dataclass(frozen=True)
class Unit:
    """What must be built together.

    Attributes
    ----------
    parcel : str
        Id of the outermost polygon that operations work on.
    members : tuple of str
        Ids of all polygons that it takes: the parcel, what it contains and what straddles its boundary, and what
        contains it.
    """

    parcel: str
    members: tuple[str, ...]


@dataclass(frozen=True)
class Tile:
    """A part of a scene.

    Attributes
    ----------
    name : str
        "tile 007".
    units : tuple of Unit
    """

    name: str
    units: tuple[Unit, ...]

    @property
    def parcels(self) -> tuple[str, ...]:
        """Ids of the parcels that are built in it."""
        return tuple(unit.parcel for unit in self.units)


def wanted_labels(tree: OperationsTree, beginning: bool = False) -> frozenset[str] | None:
    """Labels of the polygons that a tree does something with.

    Parameters
    ----------
    tree : OperationsTree
    beginning : bool
        Only the labels of what the tree begins with, which are those of parcels: the rest it may have made itself.

    Returns
    -------
    frozenset of str or None
        None: any.
    """
    found: set[str] = set()
    for node in tree.nodes:
        operation = node.operation
        if beginning and node.inputs:
            continue
        if isinstance(operation, Placing):
            if operation.places_in is None:
                return None
            found |= operation.places_in
        elif isinstance(operation, Extrusion | Selection):
            found.add(operation.label)
    return frozenset(found)


def units_of(scene: Scene, wanted: frozenset[str] | None) -> list[Unit]:
    """The units of a scene.

    Parameters
    ----------
    scene : Scene
    wanted : frozenset of str or None
        As `wanted_labels` gives them.

    Returns
    -------
    list of Unit
        In the scene's order of their parcels. Polygons that nothing is done with belong to none of their own.
    """
    above = {str(p.id): scene.parent(str(p.id)) for p in scene.polygons}
    is_wanted = {str(p.id): wanted is None or p.label in wanted for p in scene.polygons}

    def ancestors(id: str) -> list[str]:
        found, at = [], above[id]
        while at is not None:
            found.append(str(at.id))
            at = above[str(at.id)]
        return found

    rank = {str(p.id): i for i, p in enumerate(scene.polygons)}
    roots = [id for id, ok in is_wanted.items() if ok and not any(is_wanted[a] for a in ancestors(id))]
    inside = {root: _within(scene, root) for root in roots}
    leader = {root: root for root in roots}

    def lead(id: str) -> str:
        while leader[id] != id:
            id = leader[id]
        return id

    def join(one: str, other: str) -> None:
        first, second = sorted((lead(one), lead(other)), key=rank.__getitem__)
        leader[second] = first

    # What is built on may belong to two parcels at once: then these are built together.
    holder: dict[str, str] = {}
    for root in roots:
        for id in inside[root]:
            if id in leader:
                join(root, id)
            elif is_wanted[id]:
                join(root, holder.setdefault(id, root))
    groups: dict[str, set[str]] = {}
    for root in roots:
        groups.setdefault(lead(root), set()).update((root, *inside[root], *ancestors(root)))
    return [Unit(root, tuple(sorted(ids, key=rank.__getitem__))) for root, ids in groups.items()]


def _within(scene: Scene, root: str) -> list[str]:
    """Ids of everything in a polygon, at any depth, and of what straddles the boundaries."""
    found: dict[str, None] = {}
    waiting = [root]
    while waiting:
        for member in scene.members_of(waiting.pop()):
            id = str(member.id)
            if id not in found and id != root:
                found[id] = None
                waiting.append(id)
    return list(found)


def divide(scene: Scene, units: Sequence[Unit], most: int = PARCELS_PER_TILE) -> list[Tile]:
    """Divide units into tiles of neighbours, by halves along the longer side.

    Parameters
    ----------
    scene : Scene
    units : sequence of Unit
        In any order, which does not matter.
    most : int
        Parcels of a tile.

    Returns
    -------
    list of Tile
        Neighbours follow each other.
    """
    places = {unit.parcel: scene.polygon(unit.parcel).centroid for unit in units}
    found: list[list[Unit]] = []
    waiting = [sorted(units, key=lambda u: u.parcel)] if units else []
    while waiting:
        group = waiting.pop()
        if len(group) <= most:
            found.append(group)
            continue
        points = np.array([places[u.parcel] for u in group])
        axis = int(np.ptp(points, axis=0).argmax())
        order = np.lexsort((np.arange(len(group)), points[:, axis]))
        half = len(group) // 2
        waiting += [sorted((group[i] for i in part), key=lambda u: u.parcel) for part in (order[half:], order[:half])]
    return [Tile(f"tile {k + 1:03d}", tuple(group)) for k, group in enumerate(found)]


def scene_text(scene: Scene, units: Sequence[Unit]) -> str:
    """What a process needs to know of the scene to build some units, as JSON.

    Parameters
    ----------
    scene : Scene
    units : sequence of Unit

    Returns
    -------
    str
        Numbers are written in full, so that nothing depends on who builds.
    """
    polygons = [p.to_dict() for p in scene.subset(id for unit in units for id in unit.members)]
    known = [[u.parcel, *u.members] for u in units]
    return json.dumps({"polygons": polygons, "offset": list(scene.offset), "units": known}, sort_keys=True)


def read_scene_text(text: str) -> tuple[Scene, list[Unit]]:
    """What `scene_text` wrote.

    Parameters
    ----------
    text : str

    Returns
    -------
    Scene
    list of Unit
    """
    plain = json.loads(text)
    make: Callable[..., Polygon] = Polygon
    scene = Scene([make(**p) for p in plain["polygons"]], tuple(plain["offset"]))
    return scene, [Unit(parcel, tuple(members)) for parcel, *members in plain["units"]]
