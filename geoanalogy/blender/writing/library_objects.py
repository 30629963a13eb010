"""Library objects in their places: what a .blend has of them, and plain boxes for what it has not."""

from collections.abc import Iterable, Sequence
from pathlib import Path

import bpy
import numpy as np
from numpy.typing import NDArray

from ...batch.product import Placed
from ...errors import InputError
from ...geometry.scene import Scene
from .. import names
from ..holders import ensure_holder
from .scattering import scattered
from .shading import material

Array = NDArray[np.float64]

#: Size of what stands for a missing library object that has no outline, scene units.
POINT_SIZE = 0.5

#: Thickness of what stands for a missing library object, in proportion to the shorter side of its outline: on level
#: surfaces a box, on others a panel.
BOX, PANEL = 1.0, 0.1

#: The collection of the library objects, which is not shown itself.
LIBRARY = "Library"

#: Corners and outward faces of the unit cube that stands for missing library objects.
CUBE = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
CUBE_FACES = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))


def boxes(placed: Placed) -> tuple[Array, Array]:
    """What stands for library objects that are not there, in their own coordinates.

    Parameters
    ----------
    placed : Placed

    Returns
    -------
    low, size : ndarray of shape (n, 3)
        Lower corner and extents.
    """
    low, size = placed.low.copy(), placed.size.copy()
    level = np.abs(placed.places[:, 2, 2]) > np.sqrt(0.5)
    size[:, 2] *= np.where(level, BOX, PANEL)
    unknown = ~placed.size.any(axis=1)
    size[unknown] = POINT_SIZE
    low[unknown] = (-POINT_SIZE / 2, -POINT_SIZE / 2, 0.0)
    return low, size


def corners(placed: Placed) -> Array:
    """Corners in space of the boxes that library objects are taken to fill.

    Parameters
    ----------
    placed : Placed

    Returns
    -------
    ndarray of shape (8 n, 3)
    """
    low, size = boxes(placed)
    inside = (low[:, None] + CUBE * size[:, None]) * placed.scales[:, None]
    turned = np.einsum("nij,nkj->nki", placed.places[:, :3, :3], inside)
    return (turned + placed.places[:, None, :3, 3]).reshape(-1, 3)


def put(
    scene: bpy.types.Scene, placed: Placed, library: Path | None, ground: Scene
) -> tuple[Array, tuple[str, ...], frozenset[str]]:
    """Put library objects in their places, as instances on points in a collection per label.

    A polygon of the ground whose label is the name of a library object is a place for it: a tree of a map.

    Parameters
    ----------
    scene : bpy.types.Scene
    placed : Placed
    library : Path or None
        A .blend with the library objects.
    ground : Scene

    Returns
    -------
    ndarray of shape (n, 3)
        Points that all of it lies within.
    tuple of str
        A sentence for every library object that is missing.
    frozenset of str
        Labels of the polygons of the ground that library objects stand for.

    Raises
    ------
    InputError
        Where the library cannot be read.
    """
    wanted = dict.fromkeys([*placed.meshes, *(p.label for p in ground.polygons if p.label)])
    sources = {} if library is None else library_objects(library, wanted)
    for source in sources.values():
        shelf(scene).objects.link(source)
    problems: dict[str, str] = {}
    kinds = np.array([f"{mesh}\0{label}" for mesh, label in zip(placed.meshes, placed.labels, strict=True)])
    low, size = boxes(placed)
    for kind in dict.fromkeys(kinds.tolist()):
        those = np.flatnonzero(kinds == kind)
        name, label = kind.split("\0")
        places, scales = placed.places[those], placed.scales[those]
        turns, positions = places[:, :3, :3], places[:, :3, 3]
        source = sources.get(name)
        if source is None:
            where = "--library names no file" if library is None else f"{library} has no such object"
            problems[name] = (
                f"node {placed.nodes[those[0]]!r}: the library object {name!r} is missing ({where}); plain boxes take "
                "its places, add it to the library"
            )
            source = _cube(scene, name, label)
            positions = positions + np.einsum("nij,nj->ni", turns, low[those] * scales)
            scales = scales * size[those]
        _show(scene, label or names.UNLABELLED, source, positions, turns, scales)
    standing = [_on_the_ground(scene, ground, name, source) for name, source in sources.items()]
    return np.concatenate([corners(placed), *standing]), tuple(problems.values()), frozenset(sources)


def _show(
    scene: bpy.types.Scene, label: str, source: bpy.types.Object, positions: Array, turns: Array, scales: Array
) -> None:
    made = scattered(label if source.name == label else f"{label}: {source.name}", source, positions, turns, scales)
    made[names.LABEL] = label
    ensure_holder(scene.collection, label).objects.link(made)


def _on_the_ground(scene: bpy.types.Scene, ground: Scene, name: str, source: bpy.types.Object) -> Array:
    """Show a library object on the polygons that have its name for a label, each as large as that; the corners."""
    there = [p for p in ground.polygons if p.label == name]
    if not there:
        return np.zeros((0, 3))
    extent = max(*source.dimensions[:2], 1e-6)
    positions = np.array([(*p.centroid, 0.0) for p in there])
    angles = np.array([p.main_orientation for p in there])
    turns = np.zeros((len(there), 3, 3))
    turns[:, 0, 0] = turns[:, 1, 1] = np.cos(angles)
    turns[:, 1, 0], turns[:, 0, 1], turns[:, 2, 2] = np.sin(angles), -np.sin(angles), 1.0
    scales = np.array([float((p.bounds[2:] - p.bounds[:2]).max()) / extent for p in there])
    _show(scene, name, source, positions, turns, np.repeat(scales[:, None], 3, axis=1))
    reach = scales[:, None, None] * (CUBE - (0.5, 0.5, 0.0)) * (extent, extent, source.dimensions[2])
    return (positions[:, None] + reach).reshape(-1, 3)


def shelf(scene: bpy.types.Scene) -> bpy.types.Collection:
    """The collection of library objects, which are shown only where they are put.

    Parameters
    ----------
    scene : bpy.types.Scene

    Returns
    -------
    bpy.types.Collection
    """
    made = ensure_holder(scene.collection, LIBRARY)
    for layer in scene.view_layers:
        layer.layer_collection.children[made.name].exclude = True
    return made


def _cube(scene: bpy.types.Scene, name: str, label: str) -> bpy.types.Object:
    cube = bpy.data.meshes.new(name)
    cube.from_pydata(CUBE.tolist(), [], CUBE_FACES)
    cube.materials.append(material(label))
    made = bpy.data.objects.new(name, cube)
    shelf(scene).objects.link(made)
    return made


def library_objects(library: Path, wanted: Iterable[str]) -> dict[str, bpy.types.Object]:
    """The objects of these names that a .blend has, brought into this file but not into its scene.

    Parameters
    ----------
    library : Path
    wanted : iterable of str

    Returns
    -------
    dict of str to bpy.types.Object
        By the names that they have there. Their rotations and scales are part of their shapes.

    Raises
    ------
    InputError
        Where the file cannot be opened.
    """
    found: Sequence[str] = []
    try:
        with bpy.data.libraries.load(str(library), link=False) as (there, brought):
            found = [name for name in wanted if name in there.objects]
            brought.objects = list(found)
    except OSError as error:
        raise InputError(f"{library} cannot be opened ({error}); save it again") from None
    sources = dict(zip(found, brought.objects, strict=True))
    for source in sources.values():
        turned = source.matrix_basis.copy()
        turned.translation = (0.0, 0.0, 0.0)
        source.parent = None
        if source.data is not None and hasattr(source.data, "transform"):
            source.data.transform(turned)
        source.matrix_world.identity()
    return sources
