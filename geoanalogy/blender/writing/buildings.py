"""What an operations tree has built, as a .blend: masses as one mesh per label, library objects as instances."""

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

import bpy
import numpy as np
from numpy.typing import NDArray

from ...batch.product import Product
from ...batch.store import ensure_folder
from ...errors import InputError
from ...geometry.extrusion import triangulated
from ...geometry.mesh import Mesh, joined
from ...geometry.scene import Scene
from .. import names
from ..holders import ensure_holder
from .extent import Boxes, outermost
from .gathering import Gathered
from .library_objects import put
from .outdoors import furnish
from .picture import draw_picture
from .saving import save_copy, whole
from .shading import FINISHES, VARIATION, material

#: How far parcels lie below what stands on them, scene units: flat elements at height 0 are seen.
DROP = 0.03

#: Material of parcels whose label says nothing about what they look like.
PARCEL = "parcel"

#: Labels of streets on maps.
STREETS = ("street", "road")

#: The collection of parcels, ground, lamps and cameras.
SURROUNDINGS = "Surroundings"


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


@dataclass(frozen=True)
class Results:
    """What is to be written.

    Attributes
    ----------
    output, render : Path or None
        The .blend and the .png.
    library : Path or None
        A .blend with the library objects; of those that it has not, plain boxes and panels take the places.
    tiles : Path or None
        Folder of a .blend per tile, which the output then links.
    """

    output: Path | None = None
    render: Path | None = None
    library: Path | None = None
    tiles: Path | None = None


def write(
    ground: Scene,
    products: Iterable[tuple[str, Product]],
    results: Results,
    properties: Mapping[str, object] | None = None,
    report: Callable[[float, str], object] = lambda *_: None,
) -> Built:
    """Write what has been built as a .blend, a picture of it, or both.

    The open file makes room for a fresh one. Files of those names stay as they were until the new ones are complete.

    Parameters
    ----------
    ground : Scene
        All parcels.
    products : iterable of (str, Product)
        With the names of their tiles.
    results : Results
    properties : mapping, optional
        Custom properties of the scene.
    report : callable (fraction, text), optional
        Called before each part of the work, which is not stopped any more.

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
    if results.tiles is None:
        report(1.0, "writing")
        scene = _fresh()
        built = fill(scene, ground, (product for _, product in products), results.library)
    else:
        scene, built = _linked(ground, products, results, report)
    for name, value in (properties or {}).items():
        scene[name] = value
    # Both are complete before either takes its place.
    with ExitStack() as parts:
        if results.render is not None:
            report(1.0, "drawing")
            draw_picture(scene, parts.enter_context(whole(results.render)))
        if results.output is not None:
            save_copy(results.output)
    return built


def _fresh() -> bpy.types.Scene:
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True, load_ui=False)
    return bpy.context.scene


def _linked(
    ground: Scene, products: Iterable[tuple[str, Product]], results: Results, report: Callable[[float, str], object]
) -> tuple[bpy.types.Scene, Built]:
    """A .blend per tile, and a scene that links them."""
    folder = results.tiles
    ensure_folder(folder)
    written: list[tuple[str, Path]] = []
    boxes, problems, instances = [], {}, 0
    for name, product in products:
        report(1.0, f"writing {name}")
        scene = _fresh()
        built, there, _ = _buildings(scene, Gathered([product]), results.library, Scene([]))
        boxes += there
        problems.update(dict.fromkeys(built.problems))
        instances += built.instances
        whole = bpy.data.collections.new(name)
        for part in [c for c in scene.collection.children if c.name != "Library"]:
            scene.collection.children.unlink(part)
            whole.children.link(part)
        scene.collection.children.link(whole)
        path = folder / f"{name}.blend"
        save_copy(path)
        written.append((name, path))
    scene = _fresh()
    base = results.output or results.render
    for name, path in written:
        with bpy.data.libraries.load(str(path), link=True) as (_, brought):
            brought.collections = [name]
        scene.collection.children.link(brought.collections[0])
    for library in bpy.data.libraries:
        if base is not None and Path(library.filepath).parent == folder:
            library.filepath = f"//{Path(os.path.relpath(library.filepath, base.parent)).as_posix()}"
    there, _, standing = put(scene, Gathered([]), results.library, ground)
    _place_to_look_from(scene, [*boxes, *there, _surroundings(scene, ground, standing)], ground)
    return scene, Built(len(written), instances, tuple(problems))


def fill(scene: bpy.types.Scene, ground: Scene, products: Iterable[Product], library: Path | None) -> Built:
    """Fill a scene with what has been built on parcels, and with what it takes to look at it.

    Parameters
    ----------
    scene : bpy.types.Scene
        An empty one.
    ground : Scene
    products : iterable of Product
        Each is let go before the next one is asked for.
    library : Path or None

    Returns
    -------
    Built

    Raises
    ------
    InputError
        Where the library cannot be read, or nothing was built that could be drawn.
    """
    built, boxes, standing = _buildings(scene, Gathered(products), library, ground)
    _place_to_look_from(scene, [*boxes, _surroundings(scene, ground, standing)], ground)
    return built


def _buildings(
    scene: bpy.types.Scene, gathered: Gathered, library: Path | None, ground: Scene
) -> tuple[Built, list[Boxes], frozenset[str]]:
    """Put masses and library objects into the collections of their labels.

    Returns also the boxes that they lie within, and which of them stand for polygons of the ground.
    """
    count = 0
    for label, mesh, lots in gathered.masses():
        data = mesh_data(label, mesh)
        data.attributes.new(VARIATION, "FLOAT", "FACE").data.foreach_set("value", lots)
        mass = bpy.data.objects.new(label, data)
        mass[names.LABEL] = label
        ensure_holder(scene.collection, label).objects.link(mass)
        count += 1
    there, problems, standing = put(scene, gathered, library, ground)
    return Built(count, gathered.instances, problems), [*gathered.boxes, *there], standing


def _surroundings(scene: bpy.types.Scene, ground: Scene, standing: frozenset[str]) -> Boxes:
    """The parcels but those that something stands for, and boxes that they lie within."""
    parcels = _parcels(ground, standing)
    if len(parcels.faces):
        made = bpy.data.objects.new("Parcels", mesh_data("Parcels", parcels))
        ensure_holder(scene.collection, SURROUNDINGS).objects.link(made)
    points = np.maximum(parcels.vertices, (-np.inf, -np.inf, -DROP))
    return points, points


def _place_to_look_from(scene: bpy.types.Scene, boxes: Sequence[Boxes], ground: Scene) -> None:
    everything = outermost(boxes)
    if not len(everything):
        raise InputError("nothing was built and there are no parcels; check the labels of the parcels")
    # Between the streets of a map grass grows; a plan without any stands on the street itself.
    finish = "verge" if any(p.label in STREETS for p in ground.polygons) else "ground"
    furnish(scene, ensure_holder(scene.collection, SURROUNDINGS), everything, DROP, finish)


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
    made.loops.add(3 * len(mesh.faces))
    made.polygons.add(len(mesh.faces))
    made.polygons.foreach_set("loop_start", np.arange(0, 3 * len(mesh.faces), 3, dtype=np.int32))
    made.uv_layers.new(name="UVMap")
    # Attributes take an array at once; vertices, corners and faces take it value by value, some fifty times as long.
    for attribute, (kind, domain, value, values) in {
        "position": ("FLOAT_VECTOR", "POINT", "vector", np.asarray(mesh.vertices, np.float32)),
        ".corner_vert": ("INT", "CORNER", "value", np.asarray(mesh.faces, np.int32)),
        "UVMap": ("FLOAT2", "CORNER", "vector", np.asarray(mesh.uv, np.float32)),
        "material_index": ("INT", "FACE", "value", np.asarray(mesh.material_index, np.int32)),
        "sharp_face": ("BOOLEAN", "FACE", "value", np.ones(len(mesh.faces), bool)),
    }.items():
        layer = made.attributes.get(attribute) or made.attributes.new(attribute, kind, domain)
        layer.data.foreach_set(value, values.ravel())
    for finish in mesh.materials:
        made.materials.append(material(finish))
    made.update(calc_edges=True)
    # Blender leaves open which of the edges are selected; without any of it, equal scenes are equal files.
    for attribute in (".select_vert", ".select_edge", ".select_poly"):
        if attribute in made.attributes:
            made.attributes.remove(made.attributes[attribute])
    return made


def _parcels(ground: Scene, standing: frozenset[str]) -> Mesh:
    """The ground's polygons, smaller ones above those that they lie in."""
    made = []
    for polygon in ground.polygons:
        if polygon.label in standing:
            continue
        above, depth = ground.parent(str(polygon.id)), 1
        while above is not None:
            above, depth = ground.parent(str(above.id)), depth + 1
        faces, points = triangulated(polygon.rings), np.concatenate(polygon.rings)
        flat = np.column_stack([points, np.full(len(points), -DROP / depth)])
        low = np.column_stack([points, np.full(len(points), -2.0 * DROP)])
        # Down to the ground all round: one would see under it from the street.
        faces = np.concatenate([faces, _sides([len(ring) for ring in polygon.rings])])
        finish = polygon.label if polygon.label and polygon.label.lower().split()[-1] in FINISHES else PARCEL
        uv = np.concatenate([points, points])[faces]
        made.append(Mesh(np.concatenate([flat, low]), faces, uv, (finish,), np.zeros(len(faces), dtype=np.intp)))
    return joined(made)


def _sides(counts: Sequence[int]) -> NDArray[np.intp]:
    """Triangles between rings of so many vertices, one after the other, and the same again below them."""
    total = sum(counts)
    start = np.arange(total)
    end = start + 1
    ends = np.cumsum(counts)
    end[ends - 1] = ends - counts
    return np.concatenate(
        [np.column_stack([start, start + total, end + total]), np.column_stack([start, end + total, end])]
    )
