"""Ids of objects: the names that operations know them by, which stay when a user renames the objects."""

from collections.abc import Iterable

import bpy

from ...geometry.scene import Scene
from .. import names


def ids_of(scene: bpy.types.Scene) -> dict[str, str]:
    """The ids of a scene's objects.

    Parameters
    ----------
    scene : bpy.types.Scene

    Returns
    -------
    dict of str to str
        By the objects' names, of all that are no results. The id that an object carries, where no other object has
        more right to it: of an object and its copies that is the one of that name. Else its name, with a number where
        that is taken.
    """

    def right(item: bpy.types.Object) -> tuple[bool, bool, str]:
        own = item.get(names.ID)
        return own is None, own != item.name, item.name

    found: dict[str, str] = {}
    taken: set[str] = set()
    for item in sorted((item for item in scene.objects if names.KEY not in item), key=right):
        id = str(item.get(names.ID, item.name))
        if id in taken:
            id, number = item.name, 0
            while id in taken:
                number += 1
                id = f"{item.name}.{number:03d}"
        taken.add(id)
        found.setdefault(item.name, id)
    return found


def object_of(scene: bpy.types.Scene, id: str) -> bpy.types.Object | None:
    """The object that a polygon belongs to.

    Parameters
    ----------
    scene : bpy.types.Scene
    id : str
        The polygon's: the object's, or with a number behind a slash, where an object has several polygons.

    Returns
    -------
    bpy.types.Object or None
        None where the polygon belongs to none.
    """
    by_id = {own: name for name, own in ids_of(scene).items()}
    return scene.objects.get(by_id.get(id) or by_id.get(id.rpartition("/")[0], ""))


def keep_ids(scene: bpy.types.Scene, grounds: Iterable[Scene]) -> None:
    """Let objects keep the ids that they have now, whatever they are called later.

    Parameters
    ----------
    scene : bpy.types.Scene
    grounds : iterable of Scene
        What operations have worked on: results, and what is decided about them, depend on the ids of its polygons.
        Objects that are linked from another file keep their names anyway.
    """
    polygons = (str(polygon.id) for ground in grounds for polygon in ground.polygons)
    known = {part for id in polygons for part in (id, id.rpartition("/")[0])}
    ids = ids_of(scene)
    # Not by their names: each look-up would go through all objects.
    for item in scene.objects:
        id = ids.get(item.name)
        if id in known and names.KEY not in item and item.is_editable and item.get(names.ID) != id:
            item[names.ID] = id
