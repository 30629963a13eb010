"""What several examples in a Blender scene say: a placement from objects, and again where they have changed."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import bpy
import numpy as np

from ...errors import InputError
from ...geometry.rectangle import Rectangle
from ...geometry.scene import Scene
from ...operations.layout import Layout
from ...operations.operation import Operation
from ...operations.rectangle_placement import RectanglePlacement
from ...placements.examples import Example
from ...placements.options import PlacementOptions
from ...progress import Stepper, within
from .. import names
from ..linked import is_here
from ..reading.planes import Plane
from ..reading.rectangles import middle_of, rectangle_of, target_of
from .evaluating import Surroundings, incoming_steps
from .sites import Site, site_of, sites_of
from .store import builds, placed_by

#: Difference of rectangles, in sizes of the rectangle, below which an example has not been changed.
UNMOVED = 1e-4


@dataclass(frozen=True)
class Shown:
    """An example in the scene.

    Attributes
    ----------
    item : bpy.types.Object
    site : Site
        Where it lies.
    rectangle : Rectangle
        There.
    target : float
    """

    item: bpy.types.Object
    site: Site
    rectangle: Rectangle
    target: float


@dataclass(frozen=True)
class Rejected:
    """A result that the user does not want.

    Attributes
    ----------
    plane : Plane
    rectangle : Rectangle
        On that plane.
    """

    plane: Plane
    rectangle: Rectangle


def shown(sites: Sequence[Site], every: Sequence[Surroundings], item: bpy.types.Object) -> Shown:
    """An object as an example.

    Parameters
    ----------
    sites : sequence of Site
    every : sequence of Surroundings
    item : bpy.types.Object

    Returns
    -------
    Shown

    Raises
    ------
    InputError
        Where it has no extent on the face that it lies on, or a preference that is no number from 0 to 1.
    """
    depsgraph = every[0].depsgraph
    site = site_of(sites, every, item, middle_of(item, depsgraph))
    return Shown(item, site, rectangle_of(item, site.plane, depsgraph), target_of(item))


def rejected_by(node: bpy.types.Node) -> list[Rejected]:
    """The rejected results that a node was learned from.

    Parameters
    ----------
    node : bpy.types.Node

    Returns
    -------
    list of Rejected
    """
    entries = (node.get(names.REJECTED) or {}).values()
    return [
        Rejected(
            Plane.of_matrix(np.reshape(entry["frame"].to_list(), (4, 4))), Rectangle(*entry["rectangle"].to_list())
        )
        for entry in entries
    ]


def write_rejected(node: bpy.types.Node, rejected: Sequence[Rejected]) -> None:
    """Write which rejected results a node was learned from.

    Parameters
    ----------
    node : bpy.types.Node
    rejected : sequence of Rejected
    """
    node.pop(names.REJECTED, None)
    if rejected:
        node[names.REJECTED] = {
            str(i): {
                "frame": one.plane.matrix.ravel().tolist(),
                "rectangle": [getattr(one.rectangle, name) for name in ("x", "y", "width", "height", "angle")],
            }
            for i, one in enumerate(rejected)
        }


def incoming_everywhere_steps(every: Sequence[Surroundings], node: str) -> Stepper[list[Layout]]:
    """What comes in to a node on each plane, as a stepper.

    Parameters
    ----------
    every : sequence of Surroundings
    node : str

    Returns
    -------
    generator of (float, str)
        Returns a list of Layout.
    """
    found = []
    for i, around in enumerate(every):
        layout = yield from within(incoming_steps(around, node), i / len(every), (i + 1) / len(every))
        found.append(layout)
    return found


def learn_rectangles(
    sites: Sequence[Site],
    examples: Sequence[Shown],
    rejected: Sequence[Rejected],
    options: PlacementOptions,
    settings: Mapping[str, Any],
) -> RectanglePlacement:
    """Learn a placement from examples and from rejected results.

    Parameters
    ----------
    sites : sequence of Site
        With what comes in there.
    examples : sequence of Shown
    rejected : sequence of Rejected
        Those whose plane is no longer there are left out.
    options : PlacementOptions
    settings : mapping
        Of the operation: at least mesh, label and size.

    Returns
    -------
    RectanglePlacement

    Raises
    ------
    InputError
        Naming the object where a single one is to blame.
    """
    own = {one.item.name for one in examples}
    scenes: dict[int, Scene] = {}

    def scene_at(site: Site) -> Scene:
        if id(site) not in scenes:
            scenes[id(site)] = site.without(e for e in site.layout.elements if e.example and e.mesh in own)
        return scenes[id(site)]

    given = []
    for one in examples:
        scene = scene_at(one.site)
        if not any(_meets(p.bounds, one.rectangle) for p in scene.polygons):
            raise InputError(f"object {one.item.name!r} lies on no labelled face; put it on one, or label the face")
        given.append(Example(scene, one.rectangle, one.target))
    # Where a rectangle itself is what is placed, the others stand there already.
    bare = any(names.DRAWN in one.item and one.item.name == settings["mesh"] for one in examples)
    fill = [names.DRAWN in one.item and not bare for one in examples]
    for one in rejected:
        site = next((site for site in sites if _is_same(site, one)), None)
        if site is not None:
            given.append(Example(scene_at(site), one.rectangle, 0.0))
            fill.append(False)
    return RectanglePlacement.learned(given, options, fill=fill, **settings)


def _is_same(site: Site, one: Rejected) -> bool:
    """Whether a rejected result lay on that site."""
    size = max(one.rectangle.width, one.rectangle.height)
    if site.surface is None:
        return site.plane.is_coplanar(one.plane, size)
    return bool(np.abs(site.plane.matrix - one.plane.matrix).max() <= UNMOVED * size)


def _meets(bounds: np.ndarray, rectangle: Rectangle) -> bool:
    ring = rectangle.ring
    return bool((ring.max(axis=0) > bounds[:2]).all() and (ring.min(axis=0) < bounds[2:]).all())


def examples_in(node: bpy.types.Node, scene: bpy.types.Scene) -> list[bpy.types.Object]:
    """The examples of a placement that are in a scene.

    Parameters
    ----------
    node : bpy.types.Node
    scene : bpy.types.Scene

    Returns
    -------
    list of bpy.types.Object
        Without those that have been deleted.
    """
    examples = [one.item for one in placed_by(node) if one.target is not None]
    return [item for item in examples if item is not None and is_here(item, scene)]


def relearned_placement_steps(every: Sequence[Surroundings], node: bpy.types.Node) -> Stepper[Operation]:
    """A placement, learned again where its examples have been moved, graded anew or deleted since.

    Parameters
    ----------
    every : sequence of Surroundings
    node : bpy.types.Node

    Returns
    -------
    generator of (float, str)
        Returns the operation, the same one where nothing has changed or no example is in the scene.

    Raises
    ------
    InputError
        Where the examples are such that nothing can be learned from them, naming the operation.
    """
    operation = every[0].engine.node(node.name).operation
    items = examples_in(node, every[0].scene)
    if node.mute or not items:
        return operation
    rejected = rejected_by(node)
    if not builds(node.id_data):
        bare = sites_of(every, [Layout(around.ground.scene) for around in every])
        if _is_unchanged(operation, bare, [shown(bare, every, item) for item in items], rejected):
            return operation
    layouts = yield from incoming_everywhere_steps(every, node.name)
    sites = sites_of(every, layouts)
    if _is_left_behind(operation, sites, every, items):
        return operation
    examples = [shown(sites, every, item) for item in items]
    # An example may lie on something that an operation has placed.
    if _is_unchanged(operation, sites, examples, rejected):
        return operation
    try:
        return again(operation, sites, examples, rejected)
    except InputError as error:
        raise InputError(f"the operation {node.name!r}: {error}") from None


def _is_left_behind(
    operation: RectanglePlacement,
    sites: Sequence[Site],
    every: Sequence[Surroundings],
    items: Sequence[bpy.types.Object],
) -> bool:
    """Whether surfaces that examples were drawn on have gone elsewhere with their solids: what was learned stays."""
    there = {str(p.id) for site in sites if site.surface is None for p in site.scene.polygons}
    on_surfaces = sum(ground.id not in there for ground in operation.grounds[: len(items)])
    if not on_surfaces:
        return False
    depsgraph = every[0].depsgraph
    found = sum(site_of(sites, every, item, middle_of(item, depsgraph)).surface is not None for item in items)
    return found < on_surfaces


def _is_unchanged(
    operation: RectanglePlacement, sites: Sequence[Site], examples: Sequence[Shown], rejected: Sequence[Rejected]
) -> bool:
    """Whether an operation was learned from just these examples, in faces that are still the same."""
    if not _same(operation, examples, rejected):
        return False
    here = {id(one.site): one.site for one in examples}.values()
    scenes = [site.scene for site in [*here, *(site for site in sites if site.surface is None)]]
    # Surfaces of rejected results are not among these.
    drawn = operation.grounds if not any(site.surface for site in here) else operation.grounds[: len(examples)]
    return all(any(ground.is_in(scene) for scene in scenes) for ground in drawn)


def again(
    operation: RectanglePlacement,
    sites: Sequence[Site],
    examples: Sequence[Shown],
    rejected: Sequence[Rejected],
) -> RectanglePlacement:
    """An operation with the same settings, learned from other examples.

    Parameters
    ----------
    operation : RectanglePlacement
    sites : sequence of Site
        With what comes in there.
    examples : sequence of Shown
    rejected : sequence of Rejected

    Returns
    -------
    RectanglePlacement

    Raises
    ------
    InputError
        Where nothing can be learned.
    """
    settings = {"mesh": operation.mesh, "label": operation.label, "size": operation.size}
    made = learn_rectangles(sites, examples, rejected, operation.model.options, settings)
    return replace(operation, model=made.model, grounds=made.grounds, fill=made.fill)


def _same(operation: RectanglePlacement, examples: Sequence[Shown], rejected: Sequence[Rejected]) -> bool:
    """Whether examples and rejected results are those that an operation was learned from."""
    taught = operation.model.lesson.taught
    now = [(one.rectangle, one.target) for one in examples] + [(one.rectangle, 0.0) for one in rejected]
    if len(taught) != len(now):
        return False
    return all(
        t.target == target and np.abs(t.rectangle.ring - r.ring).max() <= UNMOVED * max(r.width, r.height)
        for t, (r, target) in zip(taught, now, strict=True)
    )
