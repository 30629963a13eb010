"""Faces of solids that become surfaces: they get a material that has a label."""

import bmesh
import bpy
import numpy as np

from ...errors import InputError
from .. import names
from ..linked import require_editable
from .shading import material


def surface_material(label: str) -> bpy.types.Material:
    """The file's material for surfaces of a label, made at its first use.

    Parameters
    ----------
    label : str

    Returns
    -------
    bpy.types.Material
    """
    known = next((m for m in bpy.data.materials if m.get(names.LABEL) == label), None)
    if known is None:
        known = material(f"{label} surface")
        known[names.LABEL] = label
    return known


def label_faces(item: bpy.types.Object | None, label: str) -> int:
    """Make labelled surfaces of the selected faces of a mesh.

    Parameters
    ----------
    item : bpy.types.Object or None
        In Edit Mode or not.
    label : str
        Empty: they are no surfaces any more.

    Returns
    -------
    int
        How many faces.

    Raises
    ------
    InputError
        Where it is no mesh of the user's own, it is linked, or none of its faces is selected.
    """
    if item is None or item.type != "MESH":
        raise InputError("no mesh is active; click one, and select the faces that are to be surfaces")
    if names.KEY in item:
        raise InputError(
            f"object {item.name!r} is a result of {item[names.NODE]!r} itself, whose faces are surfaces already"
        )
    require_editable([item.data])
    if item.mode == "EDIT":
        edited = bmesh.from_edit_mesh(item.data)
        chosen = np.array([face.select for face in edited.faces], dtype=bool)
    else:
        chosen = np.zeros(len(item.data.polygons), dtype=bool)
        item.data.polygons.foreach_get("select", chosen)
    if not chosen.any():
        raise InputError(f"no face of {item.name!r} is selected; select the faces that are to be surfaces")
    slot = _slot(item, label)
    if item.mode == "EDIT":
        for face in edited.faces:
            if face.select:
                face.material_index = slot
        bmesh.update_edit_mesh(item.data)
    else:
        index = np.zeros(len(item.data.polygons), dtype=np.int32)
        item.data.polygons.foreach_get("material_index", index)
        index[chosen] = slot
        item.data.polygons.foreach_set("material_index", index)
        item.data.update()
    return int(chosen.sum())


def _slot(item: bpy.types.Object, label: str) -> int:
    """The material slot of a label, added where there is none."""
    materials = item.data.materials
    if not len(materials):
        materials.append(None)  # what the other faces keep
    for i, used in enumerate(materials):
        if (used.get(names.LABEL, "") if used is not None else "") == label:
            return i
    materials.append(surface_material(label) if label else None)
    return len(materials) - 1
