"""What an operation places, from the objects that were selected for it."""

from collections.abc import Sequence

import bpy

from ...errors import InputError
from .. import names
from ..reading.footprints import pose_of, rest_of
from .refresh import proposed_by
from .sites import Site
from .store import Placed, placed_by


def objects_behind(items: Sequence[bpy.types.Object], tree: bpy.types.NodeTree | None, site: Site) -> list[Placed]:
    """The library objects behind objects of the scene: they themselves, or what results are copies of.

    Parameters
    ----------
    items : sequence of bpy.types.Object
    tree : bpy.types.NodeTree or None
        What has placed the results among them.
    site : Site
        Where the others rest.

    Returns
    -------
    list of Placed
        One each.

    Raises
    ------
    InputError
        For a result of nothing that is known.
    """
    found = []
    for item in items:
        if names.KEY in item:
            found.append(_behind(item, tree))
        else:
            found.append(Placed(item.name, item, rest_of(item, pose_of(item, site.plane), site.plane)))
    return found


def _behind(item: bpy.types.Object, tree: bpy.types.NodeTree | None) -> Placed:
    """The library object that a result is a copy of, whatever has been done to the result since."""
    source = None if tree is None else tree.nodes.get(item[names.NODE])
    if source is not None:
        meshes = {e.mesh for e in proposed_by(source) if e.key == item[names.KEY]}
        for one in placed_by(source):
            if one.item is not None and one.mesh in meshes:
                return one
    raise InputError(f"object {item.name!r} is a result of nothing that is known here; replay the operations first")
