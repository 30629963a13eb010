"""What an operations tree has built, as a .blend: masses as one mesh per label, library objects as instances."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

import bpy
import numpy as np
from mathutils import Matrix
from numpy.typing import NDArray

from ..errors import InputError
from ..geometry.extrusion import triangulated
from ..geometry.mesh import Mesh, joined
from ..geometry.scene import Scene
from ..operations.applied import Applied, Instance, instances
from . import names
from .drawing import draw_picture
from .outdoors import furnish
from .shading import material

Array = NDArray[np.float64]

#: How far parcels lie below what stands on them, scene units: flat elements at height 0 are seen.
DROP = 0.03

#: Size of what stands for a missing library object that has no outline, scene units.
POINT_SIZE = 0.5

#: Thickness of what stands for a missing library object, in proportion to the shorter side of its outline: on level
#: surfaces a box, on others a panel.
BOX, PANEL = 1.0, 0.1

#: Name of what has no label.
UNLABELLED = "unlabelled"

#: Corners and outward faces of the unit cube that stands for missing library objects.
CUBE = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
CUBE_FACES = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))


@dataclass(frozen=True)
class Built:
    """What has been written.

    Attributes
    ----------
    masses : int
        Meshes, one per label.
    instances : int
        Library objects in their places.
    problems : tuple of str
        A sentence for every library object that is missing.
    """

    masses: int
    instances: int
    problems: tuple[str, ...]


def write_applied(applied: Applied, *, library: Path | None, output: Path | None, render: Path | None) -> Built:
    """Write what an operations tree has built as a .blend, a picture of it, or both.

    The open file makes room for a fresh one.

    Parameters
    ----------
    applied : Applied
    library : Path or None
        A .blend with the library objects; of those that it has not, plain boxes and panels take the places.
    output, render : Path or None
        The .blend and the .png to write.

    Returns
    -------
    Built

    Raises
    ------
    InputError
        Where the library cannot be read, or nothing was built that could be drawn.
    OSError
        When a file cannot be written.
    """
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True, load_ui=False)
    scene = bpy.context.scene
    built = build(scene, applied, library)
    if render is not None:
        draw_picture(scene, render)
    if output is not None:
        try:
            bpy.ops.wm.save_as_mainfile(filepath=str(output), copy=True, compress=True, check_existing=False)
        except RuntimeError as error:
            raise OSError(f"cannot write {output}: {str(error).strip()}") from None
    return built


def build(scene: bpy.types.Scene, applied: Applied, library: Path | None) -> Built:
    """Fill a scene with what an operations tree has built, and with what it takes to look at it.

    Parameters
    ----------
    scene : bpy.types.Scene
        An empty one.
    applied : Applied
    library : Path or None

    Returns
    -------
    Built

    Raises
    ------
    InputError
        Where the library cannot be read, or nothing was built that could be drawn.
    """
    placed = [i for i in instances(applied.layout.elements) if isinstance(i.mesh, str)]
    masses: dict[str, list[Mesh]] = {}
    for e in applied:
        if isinstance(e.mesh, Mesh):
            masses.setdefault(e.label or UNLABELLED, []).append(e.mesh)
    parcels = _parcels(applied.layout.ground)
    points = [parcels.vertices, *(mesh.vertices for group in masses.values() for mesh in group)]
    holders = {label: bpy.data.collections.new(label) for label in masses}
    for i in placed:
        label = i.element.label or UNLABELLED
        if label not in holders:
            holders[label] = bpy.data.collections.new(label)
    for holder in holders.values():
        scene.collection.children.link(holder)
    for label, group in masses.items():
        mass = bpy.data.objects.new(label, mesh_data(label, joined(group)))
        mass[names.LABEL] = label
        holders[label].objects.link(mass)
    problems = _place(placed, holders, library)
    points += [_corners(i) for i in placed]
    everything = np.concatenate(points)
    if not len(everything):
        raise InputError("nothing was built and there are no parcels; check the labels of the parcels")
    surroundings = bpy.data.collections.new("Surroundings")
    scene.collection.children.link(surroundings)
    if len(parcels.faces):
        surroundings.objects.link(bpy.data.objects.new("Parcels", mesh_data("Parcels", parcels)))
    furnish(scene, surroundings, everything, DROP)
    return Built(len(masses), len(placed), problems)


def mesh_data(name: str, mesh: Mesh) -> bpy.types.Mesh:
    """An engine mesh as Blender's: its triangles, texture coordinates and materials.

    Parameters
    ----------
    name : str
    mesh : Mesh

    Returns
    -------
    bpy.types.Mesh
    """
    made = bpy.data.meshes.new(name)
    made.vertices.add(len(mesh.vertices))
    made.vertices.foreach_set("co", mesh.vertices.astype(np.float32).ravel())
    made.loops.add(3 * len(mesh.faces))
    made.loops.foreach_set("vertex_index", mesh.faces.astype(np.int32).ravel())
    made.polygons.add(len(mesh.faces))
    made.polygons.foreach_set("loop_start", np.arange(0, 3 * len(mesh.faces), 3, dtype=np.int32))
    made.polygons.foreach_set("material_index", mesh.material_index.astype(np.int32))
    made.uv_layers.new(name="UVMap").data.foreach_set("uv", mesh.uv.astype(np.float32).ravel())
    for finish in mesh.materials:
        made.materials.append(material(finish))
    made.update(calc_edges=True)
    made.shade_flat()
    return made


def _parcels(ground: Scene) -> Mesh:
    """The ground's polygons, smaller ones above those that they lie in."""
    made = []
    for polygon in ground.polygons:
        above, depth = ground.parent(str(polygon.id)), 1
        while above is not None:
            above, depth = ground.parent(str(above.id)), depth + 1
        faces, points = triangulated(polygon.rings), np.concatenate(polygon.rings)
        flat = np.column_stack([points, np.full(len(points), -DROP / depth)])
        made.append(Mesh(flat, faces, points[faces], ("parcel",), np.zeros(len(faces), dtype=np.intp)))
    return joined(made)


def _extent(instance: Instance) -> tuple[Array, Array]:
    """Lower corner and size, in the mesh's own coordinates, of what stands for a missing library object."""
    outline = instance.element.footprint
    if outline is None:
        return np.array([-POINT_SIZE / 2, -POINT_SIZE / 2, 0.0]), np.full(3, POINT_SIZE)
    low, high = np.min(outline, axis=0), np.max(outline, axis=0)
    level = abs(instance.frame.normal[2]) > np.sqrt(0.5)
    thickness = (BOX if level else PANEL) * float((high - low).min())
    return np.append(low, 0.0), np.append(high - low, thickness)


def _corners(instance: Instance) -> Array:
    """Corners in space of the box that an instance is taken to fill, shape (8, 3)."""
    low, size = _extent(instance)
    return instance.frame.to_space((low + CUBE * size) * instance.scale)


def _place(
    placed: Iterable[Instance], holders: Mapping[str, bpy.types.Collection], library: Path | None
) -> tuple[str, ...]:
    """Put library objects, or what stands for them, in their places; a sentence for every one that is missing."""
    placed = list(placed)
    wanted = dict.fromkeys(str(i.mesh) for i in placed)
    sources = {} if library is None else _library_objects(library, wanted)
    problems: dict[str, str] = {}
    cubes: dict[str, bpy.types.Mesh] = {}
    count: dict[str, int] = {}
    for i in placed:
        name, label = str(i.mesh), i.element.label or UNLABELLED
        count[label] = count.get(label, 0) + 1
        place = np.array(i.frame.matrix) @ np.diag((*i.scale, 1.0))
        if name in sources:
            made = sources[name].copy()
            turned = made.matrix_basis.copy()
            turned.translation = (0.0, 0.0, 0.0)
            made.parent = None
            made.matrix_world = Matrix(place.tolist()) @ turned
        else:
            if name not in cubes:
                cubes[name] = _cube(name, label)
                where = "--library names no file" if library is None else f"{library} has no such object"
                problems[name] = (
                    f"node {i.element.node!r}: the library object {name!r} is missing ({where}); plain boxes take its "
                    "places, add it to the library"
                )
            made = bpy.data.objects.new(name, cubes[name])
            low, size = _extent(i)
            fit = np.diag((*size, 1.0))
            fit[:3, 3] = low
            made.matrix_world = Matrix((place @ fit).tolist())
        made.name = f"{label} {count[label]:03d}"
        made[names.LABEL], made[names.NODE], made[names.KEY] = label, i.element.node, i.element.key
        holders[label].objects.link(made)
    bpy.data.batch_remove(list(sources.values()))
    return tuple(problems.values())


def _cube(name: str, label: str) -> bpy.types.Mesh:
    cube = bpy.data.meshes.new(name)
    cube.from_pydata(CUBE.tolist(), [], CUBE_FACES)
    cube.materials.append(material(label))
    return cube


def _library_objects(library: Path, wanted: Iterable[str]) -> dict[str, bpy.types.Object]:
    """The objects of these names that a .blend has, brought into this file but not into its scene."""
    try:
        with bpy.data.libraries.load(str(library), link=False) as (there, brought):
            found = [name for name in wanted if name in there.objects]
            brought.objects = list(found)
    except OSError as error:
        raise InputError(f"{library} cannot be opened ({error}); save it again") from None
    return dict(zip(found, brought.objects, strict=True))
