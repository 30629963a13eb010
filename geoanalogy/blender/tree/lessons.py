"""What examples in a Blender scene say: models from objects, and the same again where an example has been moved."""

from collections.abc import Sequence
from dataclasses import replace

import bpy
import numpy as np
import shapely
from numpy.typing import NDArray

from ...errors import InputError
from ...geometry.polygon import Polygon
from ...geometry.scene import Scene
from ...operations.array_placement import ArrayPlacement
from ...operations.choice_placement import ChoicePlacement
from ...operations.group_placement import GroupPlacement
from ...operations.layout import Layout
from ...operations.operation import Operation
from ...operations.placing import holds
from ...operations.pose_placement import PosePlacement
from ...operations.scatter_placement import ScatterPlacement
from ...poses.arrays import ArrayModel, ArrayOptions, learn_array
from ...poses.group_transfer import GroupObject, GroupTransfer
from ...poses.local_coordinates import BoundarySystem
from ...poses.local_mapping import TransferOptions
from ...poses.model import PoseModel
from ...poses.options import PoseOptions
from ...poses.pose import Pose, footprint_ring
from ...poses.propagate import learn_pose
from ...poses.scatter import ScatterModel
from ...progress import Stepper
from ...tolerances import CONTAINED_SHARE
from .. import names
from ..linked import is_here
from ..reading.footprints import footprint_of, pose_of
from .evaluating import Surroundings, incoming_steps, parcels_of
from .placement_lessons import relearned_placement_steps
from .sites import Site, site_of, sites_in
from .store import builds, is_building, is_placement, placed_by

Array = NDArray[np.float64]

#: Difference of poses and footprints, in sizes of the footprint, below which an example has not been moved.
UNMOVED = 1e-4


def scene_without(site: Site, items: Sequence[bpy.types.Object]) -> Scene:
    """What comes in to an operation, without the objects that it learns from: another operation may have placed them.

    Parameters
    ----------
    site : Site
    items : sequence of bpy.types.Object

    Returns
    -------
    Scene
    """
    own = {item.name for item in items if names.KEY not in item}
    made = {(item[names.NODE], item[names.KEY]) for item in items if names.KEY in item}
    return site.without(e for e in site.layout.elements if (e.example and e.mesh in own) or (e.node, e.key) in made)


def learn(item: bpy.types.Object, site: Site, scene: Scene, options: PoseOptions) -> PoseModel:
    """Learn from the pose of an object.

    Parameters
    ----------
    item : bpy.types.Object
    site : Site
    scene : Scene
        What else stands there.
    options : PoseOptions

    Returns
    -------
    PoseModel

    Raises
    ------
    InputError
        Naming the object.
    """
    pose, ring = pose_of(item, site.plane), footprint_of(item, site.plane, site.depsgraph)
    try:
        return learn_pose(scene, pose, ring, _at(site, options))
    except InputError as error:
        raise InputError(f"object {item.name!r}: {error}") from None


def _at(site: Site, options: PoseOptions) -> PoseOptions:
    """Options that know which outlines stand for others when results are validated, and whether things hang there."""
    alternatives = {**options.alternative_geometry, **site.ground.alternatives}
    return replace(options, alternative_geometry=alternatives, upright=site.plane.is_wall)


def learn_row(
    items: Sequence[bpy.types.Object],
    site: Site,
    scene: Scene,
    spacing: float,
    options: PoseOptions,
    array_options: ArrayOptions,
) -> ArrayModel:
    """Learn an array from its first object and the marker of its end.

    Parameters
    ----------
    items : sequence of bpy.types.Object
        The first object, and the empty at the end; without it, the array runs all round.
    site : Site
    scene : Scene
    spacing : float
        Scene units.
    options : PoseOptions
    array_options : ArrayOptions

    Returns
    -------
    ArrayModel

    Raises
    ------
    InputError
        Naming the object.
    """
    start, *end = items
    ring = footprint_of(start, site.plane, site.depsgraph)
    last = pose_of(end[0], site.plane) if end else None
    try:
        pose = pose_of(start, site.plane)
        return learn_array(scene, pose, last, spacing, ring, _at(site, options), array_options)
    except InputError as error:
        raise InputError(f"object {start.name!r}: {error}") from None


def learn_group(
    items: Sequence[bpy.types.Object],
    site: Site,
    scene: Scene,
    options: TransferOptions,
    marks: Sequence[bpy.types.Object] = (),
) -> GroupTransfer:
    """Learn a group from objects in one polygon.

    Parameters
    ----------
    items : sequence of bpy.types.Object
    site : Site
    scene : Scene
    options : TransferOptions
    marks : sequence of bpy.types.Object
        Where coordinates start, at most one per polygon.

    Returns
    -------
    GroupTransfer

    Raises
    ------
    InputError
        Where they are not all in one polygon, or two objects mark the same one.
    """
    objects, parents = [], []
    for item in items:
        pose, ring = pose_of(item, site.plane), footprint_of(item, site.plane, site.depsgraph)
        objects.append(GroupObject(pose, ring))
        parents.append(scene.parent_of_shape(pose.to_scene(ring), CONTAINED_SHARE) or scene.parent_of(pose.position))
        if parents[-1] is None:
            raise InputError(f"object {item.name!r} lies outside every polygon; put it into one")
        if parents[-1].id != parents[0].id:
            raise InputError(
                f"object {item.name!r} lies in {parents[-1].id!r} and {items[0].name!r} in {parents[0].id!r}; "
                "select objects of one polygon"
            )
    options = replace(options, upright=site.plane.is_wall)
    return GroupTransfer(parents[0], objects, _marked(options, parents[0], site, scene, marks))


def _marked(
    options: TransferOptions, source: Polygon, site: Site, scene: Scene, marks: Sequence[bpy.types.Object]
) -> TransferOptions:
    """Options with the starts, or the corner, that objects mark on the boundaries of polygons like the group's."""
    if not marks:
        return options
    alike = [p for p in scene.polygons if p.label == source.label]
    places: dict[str, tuple[float, float]] = {}
    for mark in marks:
        x, y, _ = site.plane.to_plane([mark.matrix_world.translation])[0].tolist()
        polygon = min(alike, key=lambda p: p.shape.exterior.distance(shapely.Point(x, y)))
        if str(polygon.id) in places:
            raise InputError(f"several empties mark the start of {polygon.id!r}; keep one of them")
        places[str(polygon.id)] = (x, y)
    if str(source.id) not in places:
        raise InputError(f"no empty marks the start of {source.id!r}, which the group is in; put one at its boundary")
    start = places.pop(str(source.id))
    if options.system == "corner":
        system = BoundarySystem(source)
        corners = system.places(system.corner_arcs)
        nearest = int(np.hypot(*(corners - start).T).argmin()) if len(corners) else None
        return replace(options, corner=nearest)
    return replace(options, start=start, starts=places)


def relearned_steps(every: Sequence[Surroundings], node: bpy.types.Node) -> Stepper[Operation]:
    """A node's operation, learned again where its examples have been moved since.

    Parameters
    ----------
    every : sequence of Surroundings
        The planes that it works on.
    node : bpy.types.Node

    Returns
    -------
    generator of (float, str)
        Returns the operation, the same one where nothing has moved or the examples are not in the scene.

    Raises
    ------
    InputError
        Where an example stands where it cannot be learned from, naming operation and object.
    """
    if is_placement(node):
        return (yield from relearned_placement_steps(every, node))
    if is_building(node):
        return every[0].engine.node(node.name).operation
    around = every[0]
    operation = around.engine.node(node.name).operation
    items = [one.item for one in placed_by(node)]
    here = all(item is not None and is_here(item, around.scene) for item in items)
    if node.mute or not items or not here or (isinstance(operation, GroupPlacement) and not operation.own):
        return operation
    tree, (poses, parent) = node.id_data, _learned_from(operation)
    if not builds(tree):
        bare = Site(around.ground, Layout(around.ground.scene), None, around.depsgraph)
        if _all_stand(items, bare, poses) and holds(bare.scene, parent):
            return operation
    layout = yield from incoming_steps(around, node.name)
    site = site_of(sites_in(around.ground, layout, around.depsgraph), [around], items[0])
    if site.surface is None and parent.id not in layout.polygon_ids and (builds(tree) or parcels_of(tree)):
        return operation  # the surface has gone elsewhere, or the tree is applied to other parcels; what is known stays
    # The parent may itself be something that an operation has placed.
    if _all_stand(items, site, poses) and holds(site.scene, parent):
        return operation
    try:
        return _again(operation, items, site, scene_without(site, items))
    except InputError as error:
        raise InputError(f"the operation {node.name!r}: {error}") from None


def _learned_from(operation: Operation) -> tuple[list[tuple[Pose, Array | None]], Polygon]:
    """The poses and footprints that an operation has been learned from, and the polygon they were in."""
    if isinstance(operation, GroupPlacement):
        return [(o.pose, o.footprint) for o in operation.group.objects], operation.group.source
    models = {
        PosePlacement: lambda o: [o.model],
        ScatterPlacement: lambda o: [o.model.model],
        ChoicePlacement: lambda o: list(o.models),
        ArrayPlacement: lambda o: [o.model.start] + ([o.model.end] if o.model.end else []),
    }[type(operation)](operation)
    poses = [(model.pose, model.footprint) for model in models]
    if isinstance(operation, ArrayPlacement):
        poses[1:] = [(pose, None) for pose, _ in poses[1:]]
    return poses, models[0].parent


def _again(operation: Operation, items: Sequence[bpy.types.Object], site: Site, scene: Scene) -> Operation:
    """An operation with the same options, learned from its examples as they stand now."""
    if isinstance(operation, PosePlacement):
        return replace(operation, model=learn(items[0], site, scene, operation.model.options))
    if isinstance(operation, ScatterPlacement):
        model = learn(items[0], site, scene, operation.model.model.options)
        return replace(operation, model=ScatterModel(model, operation.model.options))
    if isinstance(operation, ChoicePlacement):
        pairs = zip(items, operation.models, strict=True)
        return replace(operation, models=tuple(learn(item, site, scene, model.options) for item, model in pairs))
    if isinstance(operation, GroupPlacement):
        return replace(operation, group=learn_group(items, site, scene, operation.group.options))
    assert isinstance(operation, ArrayPlacement)
    model = operation.model
    row = learn_row(items, site, scene, model.spacing, model.start.options, model.options)
    return replace(operation, model=row)


def _all_stand(items: Sequence[bpy.types.Object], site: Site, poses: Sequence[tuple[Pose, Array | None]]) -> bool:
    """Whether objects stand where they did, with the same footprints."""
    # The end of an array that runs all round has no pose of its own.
    return all(_stands(item, site, pose, ring) for item, (pose, ring) in zip(items, poses, strict=False))


def _stands(item: bpy.types.Object, site: Site, before: Pose, footprint: Array | None) -> bool:
    pose = pose_of(item, site.plane)
    turned = abs(np.angle(np.exp(1j * (pose.angle - before.angle))))
    moved = np.hypot(*np.subtract(pose.position, before.position))
    if footprint is None:
        return bool(turned <= UNMOVED and moved <= UNMOVED)
    ring = footprint_ring(footprint_of(item, site.plane, site.depsgraph))
    size = float(np.ptp(footprint, axis=0).max())
    same = ring.shape == footprint.shape and np.abs(ring - footprint).max() <= UNMOVED * size
    return bool(turned <= UNMOVED and moved <= UNMOVED * size and same)
