"""The ground: the labelled objects of a Blender scene as arrangements of polygons, one for each plane.

An object with a label (its own, or that of a collection it is in) is part of the ground, and so is everything in the
scene's plan collection. What is drawn flat counts as drawn; what is solid, or has a footprint of its own, counts by its
footprint. Results of operations and their examples are left out: they come from the operations tree.
"""

from collections.abc import Collection, Iterable
from dataclasses import dataclass, field

import bpy
import numpy as np
from numpy.typing import NDArray

from ...errors import InputError
from ...geometry.memory import Memory
from ...geometry.polygon import Polygon, signed_area
from ...geometry.scene import Scene
from .. import names
from ..holders import holder_with
from .footprints import footprint_ring_of
from .identity import ids_of
from .instanced import why_nothing_is_drawn
from .planes import SAME_PLANE_ASIDE, Plane, best_plane, extent
from .shapes import KINDS, Ring, has_labelled_faces, labelled_faces, rings_of

Array = NDArray[np.float64]

#: What was derived from scenes; it is kept by content, so that nothing in it is ever out of date.
memory = Memory()


#: Share of the width and of the height of what is drawn that lies over something else where the one is drawn on the
#: other.
OVER = 0.05


@dataclass(frozen=True)
class Ground:
    """What lies on one plane.

    Attributes
    ----------
    plane : Plane
    scene : Scene
        Ids are those of the objects (`identity`), with a number behind a slash where an object has several polygons.
    alternatives : dict of str to list of (float, float)
        By the polygon's id, the ring that stands for it when results are validated (section 4.8).
    """

    plane: Plane
    scene: Scene
    alternatives: dict[str, list[tuple[float, float]]]


@dataclass
class _Drawn:
    """An object that is drawn flat."""

    item: bpy.types.Object
    rings: list[Ring]
    plane: Plane
    size: float
    part: int | None = None

    def id_in(self, ids: dict[str, str]) -> str:
        """The id of the object, with the number of the part behind it where it is a part of a solid."""
        return ids[self.item.name] if self.part is None else f"{ids[self.item.name]}/{self.part}"


@dataclass
class _Layer:
    """A plane, and what is found to lie on it."""

    plane: Plane
    size: float
    polygons: dict[str, list[Polygon]] = field(default_factory=dict)


def results_collection(scene: bpy.types.Scene) -> bpy.types.Collection | None:
    """The collection that holds a scene's results.

    Parameters
    ----------
    scene : bpy.types.Scene

    Returns
    -------
    bpy.types.Collection or None
        None before the first operation.
    """
    return holder_with(scene.collection, names.NODE, names.COLLECTION)


def labels_of(scene: bpy.types.Scene) -> dict[str, str]:
    """The label of every object of a scene that has one.

    Parameters
    ----------
    scene : bpy.types.Scene

    Returns
    -------
    dict of str to str
        By the object's name: its own label, else that of a labelled collection it is in, else the name of the
        collection inside the plan collection.
    """
    plan = scene.geoanalogy.plan
    found: dict[str, str] = {}
    inside = set() if plan is None else {c.name for c in plan.children_recursive}
    for holder in scene.collection.children_recursive:
        label = holder.get(names.LABEL)
        if label is None and holder.name in inside:
            label = holder.name
        if label is not None:
            for item in holder.objects:
                found.setdefault(item.name, str(label) or holder.name)
    for item in scene.objects:
        own = item.get(names.LABEL)
        if own is not None and str(own):
            found[item.name] = str(own)
    return found


def label_of(item: bpy.types.Object, scene: bpy.types.Scene) -> str:
    """The label of an object.

    Parameters
    ----------
    item : bpy.types.Object
    scene : bpy.types.Scene

    Returns
    -------
    str

    Raises
    ------
    InputError
        Where it has none.
    """
    label = labels_of(scene).get(item.name, "")
    if not label:
        raise InputError(f"object {item.name!r} has no label; say what it is in step 2, or label its collection")
    return label


def read_grounds(
    scene: bpy.types.Scene,
    depsgraph: bpy.types.Depsgraph,
    without: Collection[str] = (),
    problems: list[str] | None = None,
) -> list[Ground]:
    """The arrangements of a Blender scene.

    Parameters
    ----------
    scene : bpy.types.Scene
    depsgraph : bpy.types.Depsgraph
        Of that scene, up to date.
    without : collection of str
        Names of objects that do not count: examples of operations.
    problems : list of str, optional
        What cannot be used is left out, and a sentence about it added here.

    Returns
    -------
    list of Ground
        The largest first; polygons in the order of their ids.

    Raises
    ------
    InputError
        For what cannot be used where no problems are collected, naming the object; where nothing is labelled.
    """

    def fail(error: InputError) -> None:
        if problems is None:
            raise error
        problems.append(f"{error}; it is left out")

    labels, ids = labels_of(scene), ids_of(scene)
    plan = scene.geoanalogy.plan
    results = results_collection(scene)
    made = set() if results is None else {item.name for item in results.all_objects}
    planned = set() if plan is None else {item.name for item in plan.all_objects}
    drawn, solid = [], []
    for item in sorted(scene.objects, key=lambda item: item.name):
        name = item.name
        if name in made or name in without or item.type not in KINDS:
            continue
        faces = has_labelled_faces(item)
        if not (name in labels or name in planned or faces):
            continue
        try:
            if name not in labels and not faces:
                raise InputError(f"object {name!r} of the plan has no label; say what it is in step 1")
            flat = _drawn(item, depsgraph) if name in labels or not faces else None
            chosen = _chosen(item, depsgraph) if faces and flat is None else []
        except InputError as error:
            fail(error)
            continue
        drawn += chosen if flat is None else [flat]
        if flat is None and name in labels:
            solid.append(item)
    if not drawn:
        raise InputError(why_nothing_is_drawn(scene))
    layers: list[_Layer] = []
    for flat in sorted(drawn, key=lambda d: (-d.size, d.id_in(ids))):
        layer = next((one for one in layers if _lies_on(flat, one)), None)
        where = layer or _Layer(flat.plane, flat.size)
        try:
            where.polygons[flat.id_in(ids)] = _polygons(flat, where.plane, labels.get(flat.item.name, ""), ids)
        except InputError as error:
            fail(error)
            continue
        if layer is None:
            layers.append(where)
    if not layers:
        raise InputError("nothing of the plan can be used; correct its outlines")
    for item in solid:
        layer = min(layers, key=lambda one: abs(one.plane.to_plane([item.matrix_world.translation])[0, 2]))
        try:
            ring = footprint_ring_of(item, layer.plane, depsgraph)
            layer.polygons[ids[item.name]] = [
                _polygon(item, layer.plane, [ring], ids[item.name], labels[item.name], ids)
            ]
        except InputError as error:
            fail(error)
    validated = {i.name: str(i[names.VALIDATION]) for i in scene.objects if i.name in ids and names.VALIDATION in i}
    return [_ground(layer, scene, depsgraph, ids, validated) for layer in layers]


def only_in(ground: Ground, chosen: frozenset[str]) -> Ground:
    """A ground on which only some polygons are, what lies in them, and what they lie in.

    Parameters
    ----------
    ground : Ground
    chosen : frozenset of str
        Ids of objects.

    Returns
    -------
    Ground
        The same one where all is left.
    """
    kept: set[str] = set()
    for polygon in ground.scene.polygons:
        above = [polygon]
        while (parent := ground.scene.parent(str(above[-1].id))) is not None:
            above.append(parent)
        if any(not chosen.isdisjoint((p.id, str(p.id).rpartition("/")[0])) for p in above):
            kept.update(str(p.id) for p in above)
    if len(kept) == len(ground.scene.polygons):
        return ground
    polygons = [p for p in ground.scene.polygons if p.id in kept]
    return Ground(ground.plane, Scene(polygons, memory=memory), ground.alternatives)


def _lies_on(flat: _Drawn, layer: _Layer) -> bool:
    """Whether what is drawn flat lies on a plane: nearly where it lies over what is there, else exactly."""
    if layer.plane.is_coplanar(flat.plane, min(layer.size, flat.size), SAME_PLANE_ASIDE):
        return True
    if not layer.plane.is_coplanar(flat.plane, max(layer.size, flat.size)):
        return False
    points = layer.plane.to_plane(np.vstack([ring.points for ring in flat.rings]))[:, :2]
    low, high = points.min(axis=0), points.max(axis=0)
    bounds = np.array([p.bounds for polygons in layer.polygons.values() for p in polygons])
    shared = np.minimum(bounds[:, 2:], high) - np.maximum(bounds[:, :2], low)
    return bool((shared > OVER * (high - low)).all(axis=1).any())


def _ground(
    layer: _Layer,
    scene: bpy.types.Scene,
    depsgraph: bpy.types.Depsgraph,
    ids: dict[str, str],
    validated: dict[str, str],
) -> Ground:
    polygons = [p for id in sorted(layer.polygons) for p in layer.polygons[id]]
    alternatives = {}
    for name, wanted in validated.items():
        if ids[name] not in layer.polygons:
            continue
        item = scene.objects.get(wanted)
        if item is None:
            raise InputError(f"object {name!r} is to be validated as {wanted!r}, which is not there; correct the name")
        rings = rings_of(item, depsgraph)
        if len(rings) != 1:
            raise InputError(f"object {item.name!r} has {len(rings)} closed lines; one is to stand for {name!r}")
        ring = layer.plane.to_plane(rings[0].points)[:, :2]
        alternatives[ids[name]] = [(float(x), float(y)) for x, y in ring]
    return Ground(layer.plane, Scene(polygons, memory=memory), alternatives)


def _drawn(item: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> _Drawn | None:
    """The object as drawn; None where it is a solid."""
    if names.FOOTPRINT in item or item.type not in ("MESH", "CURVE", "GREASEPENCIL"):
        return None
    rings = rings_of(item, depsgraph)
    name = f"object {item.name!r}"
    if not rings:
        if item.type == "MESH" and len(item.data.polygons):
            return None  # a closed solid has no outline
        raise InputError(f"{name} has no closed line; draw its outline, or take its label away")
    plane = best_plane([r.points for r in rings], name)
    if plane is None and item.type != "MESH":
        raise InputError(f"{name} is not flat; draw it on a plane")
    points = np.vstack([r.points for r in rings])
    if plane is None or (item.type == "MESH" and _stands_out(item, plane, extent(points))):
        return None
    return _Drawn(item, rings, plane, extent(points))


def _chosen(item: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> list[_Drawn]:
    """The faces of a solid that have a label of their own."""
    found = []
    for rings in labelled_faces(item, depsgraph):
        plane = best_plane([r.points for r in rings], f"object {item.name!r}")
        if plane is not None:
            size = extent(np.vstack([r.points for r in rings]))
            found.append(_Drawn(item, rings, plane, size, rings[0].region))
    return found


def _stands_out(item: bpy.types.Object, plane: Plane, size: float) -> bool:
    """Whether a mesh whose outlines are flat has vertices off their plane: a tent, a cup."""
    corners = np.array(item.bound_box) @ np.array(item.matrix_world)[:3, :3].T + np.array(item.matrix_world)[:3, 3]
    return bool(np.ptp(plane.to_plane(corners)[:, 2]) > 0.02 * size)


def _polygons(flat: _Drawn, plane: Plane, label: str, ids: dict[str, str]) -> list[Polygon]:
    regions: dict[int, list[Ring]] = {}
    for ring in flat.rings:
        regions.setdefault(ring.region, []).append(ring)
    found = []
    parts = [part for rings in regions.values() for part in _nested(rings, plane)]
    whole = flat.id_in(ids)
    for i, (rings, own) in enumerate(parts):
        id = whole if len(parts) == 1 else f"{whole}/{i}"
        found.append(_polygon(flat.item if flat.part is None else None, plane, rings, id, own or label, ids))
    return found


def _nested(rings: list[Ring], plane: Plane) -> Iterable[tuple[list[Array], str]]:
    """The polygons of a region: outlines, each with the rings inside it as holes."""
    flat = [(plane.to_plane(ring.points)[:, :2], ring.label) for ring in rings]
    if len(flat) == 1:
        return [([flat[0][0]], flat[0][1])]
    flat.sort(key=lambda entry: -abs(signed_area(entry[0])))
    outlines: list[tuple[list[Array], str]] = []
    for points, label in flat:
        holder = next((o for o in outlines if _holds(o[0][0], points[0])), None)
        within_hole = holder is not None and any(_holds(hole, points[0]) for hole in holder[0][1:])
        if holder is None or within_hole:
            outlines.insert(0 if within_hole else len(outlines), ([points], label))
        else:
            holder[0].append(points)
    return outlines


def _holds(ring: Array, point: Array) -> bool:
    """Whether a point lies in a ring, by the crossings of a ray."""
    a, b = ring, np.roll(ring, -1, axis=0)
    spans = (a[:, 1] > point[1]) != (b[:, 1] > point[1])
    with np.errstate(divide="ignore", invalid="ignore"):
        x = a[:, 0] + (point[1] - a[:, 1]) * (b[:, 0] - a[:, 0]) / (b[:, 1] - a[:, 1])
    return bool((spans & (point[0] < x)).sum() % 2)


def _polygon(
    item: bpy.types.Object | None,
    plane: Plane,
    rings: list[Array],
    id: str,
    label: str,
    ids: dict[str, str],
) -> Polygon:
    if item is None:
        return Polygon(rings[0], label=label, id=id, holes=rings[1:])
    orientation = item.get(names.ORIENTATION)
    if orientation is not None:
        x, y = plane.to_plane(np.array(item.matrix_world)[:3, 0] + plane.origin)[:2]
        orientation = float(orientation) + float(np.arctan2(y, x))
    segments = item.get(names.SEGMENT_LABELS)
    parent = item.get(names.PARENT) or None
    return Polygon(
        rings[0],
        label=label,
        id=id,
        holes=rings[1:],
        parent=ids.get(parent, parent),
        orientation=orientation,
        segment_labels=None if segments is None else [part.strip() for part in str(segments).split(",")],
    )
