"""What is linked from another file: it cannot be edited here, and may be missing; what overrides it forgets."""

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
        Naming the first that is linked, or overrides what is.
    """
    for item in items:
        kind = item.bl_rna.name.lower()
        if not item.is_editable:
            raise InputError(f"{kind} {item.name!r} is linked from another file; make it local, or change it there")
        if item.override_library is not None:
            raise InputError(
                f"{kind} {item.name!r} overrides one of another file, and Blender would forget the change; make it "
                "local, or change it there"
            )


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


def own_copy(item: bpy.types.Object) -> bpy.types.Object:
    """A copy of an object that keeps what is written to it, whatever the object is.

    Parameters
    ----------
    item : bpy.types.Object

    Returns
    -------
    bpy.types.Object
        In no collection yet; it shares the object's data. The copy of a library override would be one itself.
    """
    made = item.copy()
    if made.override_library is not None:
        made.make_local(clear_liboverride=True)
    return made
