"""The shape of an object: rings on a plane where it is drawn flat, or a solid that stands on the ground."""

from dataclasses import dataclass, field

import bpy
import numpy as np
from numpy.typing import NDArray

from ...errors import InputError
from .. import names
from .curves import curve_rings, stroke_rings
from .loops import chains, joined_faces, outlines

Array = NDArray[np.float64]

#: Cosine of the angle between faces up to which they lie in one plane: half a degree.
IN_ONE_PLANE = 0.99996

#: Kinds of objects that have a shape.
KINDS = ("MESH", "CURVE", "SURFACE", "FONT", "META", "GREASEPENCIL", "EMPTY")


@dataclass(frozen=True)
class Ring:
    """A closed line of an object.

    Attributes
    ----------
    points : ndarray of shape (n, 3)
        World coordinates, without a repeated last one.
    region : int
        Rings of one region are one polygon: its outline, and the holes in it.
    label : str
        The label of its material, "" where it has none.
    """

    points: Array
    region: int
    label: str = field(default="", kw_only=True)


def rings_of(drawn: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> list[Ring]:
    """The closed lines of an object.

    Parameters
    ----------
    drawn : bpy.types.Object
        Mesh, curve or grease pencil.
    depsgraph : bpy.types.Depsgraph
        Modifiers of meshes are evaluated in it.

    Returns
    -------
    list of Ring
        Of a mesh, the outlines of its faces (see `names.FACES`), or its closed lines where it has no faces; of a curve
        the splines (those inside others are holes of a curve that Blender would fill), of a grease pencil the strokes.

    Raises
    ------
    InputError
        For other kinds of objects, and for lines that are open; it names the object.
    """
    name = f"object {drawn.name!r}"
    to_world = np.array(drawn.matrix_world)
    if drawn.type == "MESH":
        rings = _mesh_rings(drawn, depsgraph, name, False)
    elif drawn.type == "CURVE":
        filled = drawn.data.dimensions == "2D"
        rings = [Ring(points, 0 if filled else i) for i, points in enumerate(curve_rings(drawn.data, name))]
    elif drawn.type == "GREASEPENCIL":
        rings = [Ring(points, i) for i, points in enumerate(stroke_rings(drawn.data, name))]
    else:
        raise InputError(f"{name} is neither mesh, curve nor grease pencil; draw its outline as one of them")
    return [Ring(_transformed(r.points, to_world), r.region, label=r.label) for r in rings]


def has_labelled_faces(item: bpy.types.Object) -> bool:
    """Whether an object may have faces that are surfaces of their own: one of its materials has a label.

    Parameters
    ----------
    item : bpy.types.Object

    Returns
    -------
    bool
    """
    return item.type == "MESH" and any(
        slot.material is not None and names.LABEL in slot.material for slot in item.material_slots
    )


def labelled_faces(drawn: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> list[list[Ring]]:
    """The flat parts of a mesh whose material has a label.

    Parameters
    ----------
    drawn : bpy.types.Object
        A mesh.
    depsgraph : bpy.types.Depsgraph
        Modifiers are evaluated in it.

    Returns
    -------
    list of list of Ring
        The outline and the holes of each part: faces that share edges, a plane and a material are one.
    """
    to_world = np.array(drawn.matrix_world)
    parts: dict[int, list[Ring]] = {}
    for r in _mesh_rings(drawn, depsgraph, f"object {drawn.name!r}", True):
        if r.label:
            parts.setdefault(r.region, []).append(Ring(_transformed(r.points, to_world), r.region, label=r.label))
    return list(parts.values())


def _transformed(points: Array, matrix: Array) -> Array:
    return points @ matrix[:3, :3].T + matrix[:3, 3]


def _mesh_rings(drawn: bpy.types.Object, depsgraph: bpy.types.Depsgraph, name: str, flat_parts: bool) -> list[Ring]:
    if drawn.mode == "EDIT":
        drawn.update_from_editmode()
    source = drawn.evaluated_get(depsgraph) if drawn.modifiers else drawn
    mesh = source.to_mesh()
    try:
        return _rings_of_mesh(mesh, drawn, name, flat_parts)
    finally:
        source.to_mesh_clear()


def _rings_of_mesh(mesh: bpy.types.Mesh, drawn: bpy.types.Object, name: str, flat_parts: bool) -> list[Ring]:
    points = vertices_of(mesh)
    if not len(mesh.polygons):
        edges = np.empty(2 * len(mesh.edges), dtype=np.int32)
        mesh.edges.foreach_get("vertices", edges)
        loops = chains(edges.reshape(-1, 2).astype(np.intp), len(points), name)
        return [Ring(points[loop], i) for i, loop in enumerate(loops)]
    corners, faces = len(mesh.loops), len(mesh.polygons)
    vertex, edge = np.empty(corners, dtype=np.int32), np.empty(corners, dtype=np.int32)
    total, material = np.empty(faces, dtype=np.int32), np.empty(faces, dtype=np.int32)
    mesh.loops.foreach_get("vertex_index", vertex)
    mesh.loops.foreach_get("edge_index", edge)
    mesh.polygons.foreach_get("loop_total", total)
    mesh.polygons.foreach_get("material_index", material)
    face = np.repeat(np.arange(faces), total)
    first = np.concatenate([[0], np.cumsum(total)[:-1]])
    following = np.arange(corners) + 1
    following[first + total - 1] = first
    each = faces == 1 or (drawn.get(names.FACES, "joined") == "each" and not flat_parts)
    if flat_parts:
        edge = _apart(mesh, face, edge, material)
    region = np.arange(faces) if each else joined_faces(face, edge.astype(np.intp), faces)
    outer = np.ones(corners, dtype=bool) if each else np.bincount(edge)[edge] == 1
    labels = [slot.material.get(names.LABEL, "") if slot.material else "" for slot in drawn.material_slots]
    rings = []
    order = np.argsort(region[face], kind="stable")
    bounds = np.searchsorted(region[face][order], np.arange(region.max() + 2))
    for i in range(region.max() + 1):
        own = order[bounds[i] : bounds[i + 1]]
        used = int(material[face[own[0]]])
        label = labels[used] if used < len(labels) else ""
        own = own[outer[own]]
        loops = outlines(vertex[own].astype(np.intp), vertex[following[own]].astype(np.intp))
        rings += [Ring(points[loop], i, label=label) for loop in loops]
    return rings


def _apart(mesh: bpy.types.Mesh, face: Array, edge: Array, material: Array) -> Array:
    """The edge of each corner, where edges between faces of different planes or materials are two."""
    normals = np.empty(3 * len(mesh.polygons), dtype=np.float32)
    mesh.polygons.foreach_get("normal", normals)
    normals = normals.reshape(-1, 3)
    order = np.argsort(edge, kind="stable")
    pairs = np.flatnonzero(edge[order][1:] == edge[order][:-1])
    one, other = face[order[pairs]], face[order[pairs + 1]]
    bent = np.einsum("ij,ij->i", normals[one], normals[other]) < IN_ONE_PLANE
    parted = order[pairs[bent | (material[one] != material[other])] + 1]
    apart = edge.copy()
    apart[parted] = len(mesh.edges) + np.arange(len(parted))
    return apart


def vertices_of(mesh: bpy.types.Mesh) -> Array:
    """The vertices of a mesh.

    Parameters
    ----------
    mesh : bpy.types.Mesh

    Returns
    -------
    ndarray of shape (n, 3)
        In its object's coordinates.
    """
    buffer = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", buffer)
    return buffer.reshape(-1, 3).astype(float)


def solid_points(placed: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> Array:
    """All points of an object, of what it instances and of its children.

    Parameters
    ----------
    placed : bpy.types.Object
    depsgraph : bpy.types.Depsgraph
        Modifiers are evaluated in it.

    Returns
    -------
    ndarray of shape (n, 3)
        World coordinates; none for an empty without children.
    """
    parts = [np.empty((0, 3))]
    to_world = np.array(placed.matrix_world)
    if placed.type == "EMPTY" and placed.instance_collection is not None:
        offset = np.array(placed.instance_collection.instance_offset)
        for inner in placed.instance_collection.all_objects:
            parts.append(_transformed(solid_points(inner, depsgraph) - offset, to_world))
    elif placed.type in ("MESH", "CURVE", "SURFACE", "FONT", "META"):
        if placed.mode == "EDIT":
            placed.update_from_editmode()
        evaluated = placed.evaluated_get(depsgraph)
        mesh = evaluated.to_mesh()
        if mesh is not None:
            parts.append(_transformed(vertices_of(mesh), to_world))
        evaluated.to_mesh_clear()
    elif placed.type == "GREASEPENCIL":
        parts += [r.points for r in rings_of(placed, depsgraph)]
    parts += [solid_points(child, depsgraph) for child in placed.children]
    return np.vstack(parts)
