"""What is linked from another file: it cannot be edited here, and may be missing."""

from collections.abc import Iterable

import bpy

from ..errors import InputError


def require_editable(items: Iterable[bpy.types.ID]) -> None:
    """Refuse to edit what a file does not own: Blender would forget the edit when the file is opened again.

    Parameters
    ----------
    items : iterable of bpy.types.ID

    Raises
    ------
    InputError
        Naming the first that is linked.
    """
    for item in items:
        if not item.is_editable:
            kind = item.bl_rna.name.lower()
            raise InputError(f"{kind} {item.name!r} is linked from another file; make it local, or change it there")


def is_here(item: bpy.types.Object, scene: bpy.types.Scene) -> bool:
    """Whether an object is in a scene, and all of it.

    Parameters
    ----------
    item : bpy.types.Object
    scene : bpy.types.Scene

    Returns
    -------
    bool
        False for the empty that stands for an object whose file is missing.
    """
    if item.is_missing:
        return False
    found = scene.objects.get(item.name)
    # A linked object and one of the file's own may have the same name.
    return found == item or (found is not None and scene in item.users_scene)
