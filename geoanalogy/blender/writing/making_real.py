"""Results as objects of the user's own, which no replay takes away."""

import bpy

from ...errors import InputError
from .. import names
from ..reading.ground import results_collection
from ..tree.store import operation_nodes, tree_of
from .instances import clear_results
from .masses import clear_masses

#: The collection that objects are put into which were results.
REAL = "Real"


def make_real(scene: bpy.types.Scene) -> int:
    """Turn all results of a scene into objects with data of their own, in a collection per label.

    Parameters
    ----------
    scene : bpy.types.Scene

    Returns
    -------
    int
        How many objects.

    Raises
    ------
    InputError
        Where there are no results.
    """
    outer = results_collection(scene)
    items = [] if outer is None else [item for item in outer.all_objects if names.KEY in item]
    if not items:
        raise InputError("there are no results to make real; replay or apply the operations first")
    holder = bpy.data.collections.new(REAL)
    scene.collection.children.link(holder)
    by_label: dict[str, bpy.types.Collection] = {}
    for item in items:
        label = str(item.get(names.LABEL, "")) or str(item[names.NODE])
        if label not in by_label:
            by_label[label] = bpy.data.collections.new(label)
            holder.children.link(by_label[label])
        for used in item.users_collection:
            used.objects.unlink(item)
        by_label[label].objects.link(item)
        if item.data is not None and item.data.users > 1:
            item.data = item.data.copy()
        if item.data is not None:
            item.data.pop(names.KEY, None)  # of what was bent
        # Without a label they are no part of the plan, on which the operations would see them a second time.
        for name in (names.NODE, names.KEY, names.LABEL):
            if name in item:
                del item[name]
    clear_masses(scene)
    clear_results(scene)
    for node in operation_nodes(tree_of(scene)):
        node[names.COUNT] = 0
    return len(items)
