"""Results as objects: copies of the example that share its data, in one collection, with a collection per operation.

Only what carries the name of a node and a key is ever deleted; whatever else a user puts into these collections stays.
"""

from collections.abc import Iterable, Mapping, Sequence

import bpy
import numpy as np
from mathutils import Matrix
from numpy.typing import NDArray

from ...geometry.surface import GROUND
from ...operations.element import Element
from .. import names
from ..holders import ensure_holder_with, holder_with
from ..linked import is_here, own_copy
from ..reading.footprints import frame_of
from ..reading.ground import results_collection
from ..reading.planes import Plane
from ..tree.store import Placed
from .bending import Bender
from .local_view import show_locally
from .numbering import name_result
from .selection import Selection

Array = NDArray[np.float64]

#: Distance of an example from a result, in sizes of the result, below which they are one.
SAME_PLACE = 1e-3


def ensure_results_collection(scene: bpy.types.Scene) -> bpy.types.Collection:
    """The collection that holds a scene's results, made where there is none.

    Parameters
    ----------
    scene : bpy.types.Scene

    Returns
    -------
    bpy.types.Collection
    """
    return ensure_holder_with(scene.collection, names.NODE, names.COLLECTION)


def collection_of(scene: bpy.types.Scene, node: str) -> bpy.types.Collection | None:
    """The collection of one operation's results.

    Parameters
    ----------
    scene : bpy.types.Scene
    node : str
        Name of the node.

    Returns
    -------
    bpy.types.Collection or None
    """
    outer = results_collection(scene)
    return None if outer is None else holder_with(outer, names.NODE, node)


def results_in(holder: bpy.types.Collection) -> list[bpy.types.Object]:
    """The results in a collection, without what a user has put there.

    Parameters
    ----------
    holder : bpy.types.Collection

    Returns
    -------
    list of bpy.types.Object
    """
    return [item for item in holder.objects if names.KEY in item]


def write_results(
    scene: bpy.types.Scene,
    node: str,
    standing: Sequence[tuple[Element, Plane]],
    placed: Iterable[Placed],
    *,
    bender: Bender | None = None,
    unmoved: bool = False,
) -> int:
    """Show the results of one operation in place of those shown before.

    Parameters
    ----------
    scene : bpy.types.Scene
    node : str
        Name of the node.
    standing : sequence of (Element, Plane)
        Elements in order, and the plane that each lies on. An example is shown only where its object is not in the
        scene itself.
    placed : iterable of Placed
        The objects by their names in the operation; elements of others are left out.
    bender : Bender, optional
        Of the node; None: nothing is bent.
    unmoved : bool
        Whether results of the same key stand where they did: those at the beginning that stay the same are left alone,
        and a threshold that is moved only takes from the end, or adds there.

    Returns
    -------
    int
        How many objects stand there now.
    """
    outer = ensure_results_collection(scene)
    holder = ensure_holder_with(outer, names.NODE, node)
    by_mesh = {one.mesh: one for one in placed if one.item is not None}
    there = {one.mesh for one in by_mesh.values() if is_here(one.item, scene)}
    children = _children_of([one.item for one in by_mesh.values()])
    examples = [one for one in by_mesh.values() if one.target is not None and one.mesh in there]
    shown = [
        (e, p)
        for e, p in standing
        if is_instance(e) and e.mesh in by_mesh and not (e.example and e.mesh in there) and not _stands(e, p, examples)
    ]
    before = Selection.of(results_in(holder))
    left = _leave(holder, [e.key for e, _ in shown]) if unmoved else 0
    if not left:
        delete_results(holder)
    # Copies of what is selected would be selected too.
    family = [*(one.item for one in by_mesh.values()), *(child for own in children.values() for child in own)]
    selected = [item for item in family if item.select_get()]
    for item in selected:
        item.select_set(False)
    for count, (e, plane) in enumerate(shown[left:], left + 1):
        one = by_mesh[e.mesh]
        made = own_copy(one.item)
        name_result(made, node, count, len(shown))
        made[names.NODE], made[names.KEY] = node, e.key
        if names.DRAWN not in made:
            # An example, or a library object that stands aside, may be hidden by itself; its results are not.
            made.hide_viewport = made.hide_render = False
        _stand(made, e, one.rest, plane)
        if bender is not None:
            bender.bend(made, e, one.rest)
        holder.objects.link(made)
        _copy_children(one.item, made, holder, children)
    for item in selected:
        item.select_set(True)
    show_locally(results_in(holder), [one.item for one in by_mesh.values()])
    before.restore(results_in(holder))
    return len(shown)


def is_instance(element: Element) -> bool:
    """Whether an element is shown by a library object: it has not become a solid, or a part of one.

    Parameters
    ----------
    element : Element

    Returns
    -------
    bool
    """
    return bool(element.mesh) and element.solid is None and not element.absorbed_by


def _stands(element: Element, plane: Plane, examples: Sequence[Placed]) -> bool:
    """Whether an example stands where an element would: those on surfaces are found there again like all others."""
    if element.surface == GROUND or not examples:
        return False
    where = frame_of(element.pose, plane)
    size = element.reach
    return any(
        np.abs((where @ one.rest)[:3, 3] - np.array(one.item.matrix_world.translation)).max() < SAME_PLACE * size
        for one in examples
        if names.DRAWN not in one.item
    )


def _leave(holder: bpy.types.Collection, keys: Sequence[str]) -> int:
    """Delete results from the first on that is not among these keys in order; how many are left."""
    every = results_in(holder)
    # Children follow on the result that they belong to.
    starts = [i for i, item in enumerate(every) if item.parent is None]
    same = 0
    while same < min(len(starts), len(keys)) and every[starts[same]][names.KEY] == keys[same]:
        same += 1
    if same < len(starts):
        _remove(every[starts[same] :])
    return same


def _stand(made: bpy.types.Object, e: Element, rest: Array, plane: Plane) -> None:
    """Put an object where an element stands: its own scale and tilt, mirrored by a negative y scale.

    Of the object's own axes each is stretched as the direction is that it has on the plane.
    """
    made.parent = None
    made.animation_data_clear()
    for constraint in list(made.constraints):
        made.constraints.remove(constraint)
    frame = Matrix(frame_of(e.pose, plane).tolist())
    location, rotation, scale = Matrix(rest.tolist()).decompose()
    turn = rotation.to_matrix()
    if e.pose.mirrored:
        mirror = Matrix.Diagonal((1.0, -1.0, 1.0))
        # Reflecting the rested object is turning it the other way round and reflecting it in its own frame.
        location, turn = mirror @ location, mirror @ turn @ mirror
        scale.y = -scale.y
    made.rotation_mode = "XYZ"
    made.matrix_parent_inverse.identity()
    made.delta_location = made.delta_rotation_euler = (0.0, 0.0, 0.0)
    made.delta_scale = (1.0, 1.0, 1.0)
    stretch = Matrix.Diagonal((*e.stretch, 1.0))
    made.location = frame @ (e.scale * (stretch @ location))
    made.rotation_euler = (frame.to_3x3() @ turn).to_euler("XYZ")
    made.scale = [e.scale * s * (stretch @ axis).length for s, axis in zip(scale, turn.col, strict=True)]


def _children_of(items: Sequence[bpy.types.Object]) -> dict[str, list[bpy.types.Object]]:
    """The children of objects and of their children, by their parents' names.

    Blender looks through all objects of the file for the children of one, so each is asked once.
    """
    found: dict[str, list[bpy.types.Object]] = {}
    waiting = list(items)
    while waiting:
        item = waiting.pop()
        found[item.name] = [child for child in item.children if names.KEY not in child]
        waiting += found[item.name]
    return found


def _copy_children(
    example: bpy.types.Object,
    made: bpy.types.Object,
    holder: bpy.types.Collection,
    children: Mapping[str, list[bpy.types.Object]],
) -> None:
    for child in children[example.name]:
        copy = own_copy(child)
        copy.parent = made
        copy[names.NODE], copy[names.KEY] = made[names.NODE], made[names.KEY]
        holder.objects.link(copy)
        _copy_children(child, copy, holder, children)


def delete_results(holder: bpy.types.Collection) -> None:
    """Delete the results in a collection.

    Parameters
    ----------
    holder : bpy.types.Collection
    """
    _remove(results_in(holder))


def _remove(items: Sequence[bpy.types.Object]) -> None:
    """Remove results, and the data that were made for them."""
    own = {item.data for item in items if item.data is not None and names.KEY in item.data}
    bpy.data.batch_remove(items)
    bpy.data.batch_remove([data for data in own if not data.users])


def clear_results(scene: bpy.types.Scene, nodes: Iterable[str] | None = None) -> None:
    """Delete results, and the collections that hold nothing else.

    Parameters
    ----------
    scene : bpy.types.Scene
    nodes : iterable of str, optional
        Names of the nodes whose results go; None: all, and the outer collection with them.
    """
    outer = results_collection(scene)
    if outer is None:
        return
    chosen = None if nodes is None else set(nodes)
    for holder in list(outer.children):
        if names.NODE in holder and (chosen is None or holder[names.NODE] in chosen):
            delete_results(holder)
            if not holder.all_objects:
                bpy.data.collections.remove(holder)
    if chosen is None and not outer.all_objects and not outer.children:
        bpy.data.collections.remove(outer)


def arrange_collections(scene: bpy.types.Scene, nodes: Sequence[str]) -> None:
    """Put the collections of operations into an order, so that it does not depend on what was shown first.

    Parameters
    ----------
    scene : bpy.types.Scene
    nodes : sequence of str
        Names of the nodes in order.
    """
    outer = results_collection(scene)
    if outer is None:
        return
    rank = {name: i for i, name in enumerate(nodes)}
    made = [c for c in outer.children if c.get(names.NODE) in rank]
    wanted = sorted(made, key=lambda c: rank[c[names.NODE]])
    if made != wanted:
        for holder in wanted:
            outer.children.unlink(holder)
            outer.children.link(holder)
