"""What operations have extruded, and outlines that nothing fills yet, as meshes: in a collection per label."""

import json
from collections.abc import Collection, Iterable, Sequence

import bpy
import numpy as np
from mathutils import Matrix
from numpy.typing import NDArray

from ...geometry.mesh import Mesh, joined
from ...geometry.solid import Solid
from ...operations.element import Element
from ...operations.layout import Layout
from .. import names
from ..holders import ensure_holder_with
from ..names import UNLABELLED
from ..reading.ground import results_collection
from ..reading.planes import Plane
from .buildings import mesh_data
from .instances import ensure_results_collection
from .numbering import name_result

Array = NDArray[np.float64]

#: How far outlines lie above their surface, scene units: what is level with it is not seen.
LIFT = 0.004


def write_masses(
    scene: bpy.types.Scene, parts: Sequence[tuple[Plane, Layout]], library: Collection[str], merged: bool
) -> int:
    """Show solids and outlines in place of those shown before.

    Parameters
    ----------
    scene : bpy.types.Scene
    parts : sequence of (Plane, Layout)
        What has flowed out of the tree on each plane.
    library : collection of str
        Names of the library objects that there are: elements of these are instances, and are left out.
    merged : bool
        Whether there is one mesh per label instead of one object per element. Equal solids share their mesh where there
        are several.

    Returns
    -------
    int
        How many objects stand there now.
    """
    clear_masses(scene)
    by_label: dict[str, list[tuple[Element, Plane]]] = {}
    for plane, layout in parts:
        for e in layout.elements:
            if _is_shown(e, library):
                by_label.setdefault(e.label or UNLABELLED, []).append((e, plane))
    outer = ensure_results_collection(scene)
    shared: dict[Solid, bpy.types.Mesh] = {}
    count = 0
    for label, standing in by_label.items():
        holder = ensure_holder_with(outer, names.MASS, label)
        made = [_merged(label, standing)] if merged else [_single(e, plane, shared) for e, plane in standing]
        for i, item in enumerate(made, 1):
            if merged:
                item.name = label
            else:
                name_result(item, label, i, len(made))
            item[names.LABEL] = label
            holder.objects.link(item)
        count += len(made)
    return count


def _is_shown(element: Element, library: Collection[str]) -> bool:
    if element.absorbed_by or element.solid is not None:
        return not element.absorbed_by
    return element.polygon is not None and not element.example and str(element.mesh) not in library


def _single(element: Element, plane: Plane, shared: dict[Solid, bpy.types.Mesh]) -> bpy.types.Object:
    """An element as an object in its own place."""
    solid = element.solid
    if solid is None:
        data = mesh_data(element.label, _flat(element))
    else:
        if solid not in shared:
            shared[solid] = mesh_data(element.label, solid.mesh)
            _name_faces(shared[solid], [face.name for face in solid.faces], solid.face)
        data = shared[solid]
    made = bpy.data.objects.new(element.label, data)
    made.matrix_world = Matrix((plane.matrix @ element.place.matrix).tolist())
    made[names.NODE], made[names.KEY] = element.node, element.key
    return made


def _merged(label: str, standing: Sequence[tuple[Element, Plane]]) -> bpy.types.Object:
    """All elements of a label as one object."""
    meshes, faces, surfaces = [], [], []
    for e, plane in standing:
        mesh = _flat(e) if e.solid is None else e.solid.mesh
        meshes.append(mesh.placed(e.place).placed(plane.frame))
        own = [e.id] if e.solid is None else [f"{e.id}:{face.name}" for face in e.solid.faces]
        face = np.zeros(len(mesh.faces), dtype=np.intp) if e.solid is None else e.solid.face
        faces.append(face + len(surfaces))
        surfaces += own
    data = mesh_data(label, joined(meshes))
    _name_faces(data, surfaces, np.concatenate(faces))
    made = bpy.data.objects.new(label, data)
    # It is a result, but of no single place.
    made[names.NODE], made[names.KEY] = "", ""
    return made


def _flat(element: Element) -> Mesh:
    """The outline of an element in its own frame."""
    mesh = element.geometry
    assert mesh is not None
    points = np.add(element.place.to_plane(mesh.vertices), (0.0, 0.0, LIFT))
    return Mesh(points, mesh.faces, mesh.uv, mesh.materials, mesh.material_index)


def _name_faces(data: bpy.types.Mesh, surfaces: Sequence[str], face: NDArray[np.intp]) -> None:
    """Say of each triangle which surface it is a part of."""
    attribute = data.attributes.new(names.SURFACE, "INT", "FACE")
    attribute.data.foreach_set("value", face.astype(np.int32))
    data[names.SURFACES] = json.dumps(list(surfaces), ensure_ascii=False)


def masses_in(scene: bpy.types.Scene) -> list[bpy.types.Object]:
    """The objects that show solids and outlines.

    Parameters
    ----------
    scene : bpy.types.Scene

    Returns
    -------
    list of bpy.types.Object
    """
    return [item for holder in _holders(scene) for item in holder.objects if names.KEY in item]


def _holders(scene: bpy.types.Scene) -> Iterable[bpy.types.Collection]:
    outer = results_collection(scene)
    return [] if outer is None else [c for c in outer.children if names.MASS in c]


def clear_masses(scene: bpy.types.Scene) -> None:
    """Delete all solids and outlines, their meshes, and the collections that hold nothing else.

    Parameters
    ----------
    scene : bpy.types.Scene
    """
    items = masses_in(scene)
    data = {item.data for item in items}
    bpy.data.batch_remove(items)
    bpy.data.batch_remove([mesh for mesh in data if not mesh.users])
    for holder in list(_holders(scene)):
        if not holder.all_objects and not holder.children:
            bpy.data.collections.remove(holder)
