"""Library objects in their places: what a .blend has of them, and plain boxes for what it has not."""

from collections.abc import Iterable, Sequence
from pathlib import Path

import bpy
import numpy as np

from ...errors import InputError
from ...geometry.scene import Scene
from .. import names
from ..holders import ensure_holder
from .bending import BENDING, bent_data
from .extent import CUBE, Boxes
from .gathering import Gathered, Kind
from .scattering import Single, scattered
from .shading import material

#: The collection of the library objects, which is not shown itself.
LIBRARY = "Library"

#: Outward faces of the unit cube that stands for missing library objects.
CUBE_FACES = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))


def put(
    scene: bpy.types.Scene, gathered: Gathered, library: Path | None, ground: Scene
) -> tuple[list[Boxes], tuple[str, ...], frozenset[str]]:
    """Put library objects in their places, as instances on points in a collection per label.

    A polygon of the ground whose label is the name of a library object is a place for it: a tree of a map.

    Parameters
    ----------
    scene : bpy.types.Scene
    gathered : Gathered
    library : Path or None
        A .blend with the library objects.
    ground : Scene

    Returns
    -------
    list of Boxes
        That those on the ground lie within.
    tuple of str
        A sentence for every library object that is missing.
    frozenset of str
        Labels of the polygons of the ground that library objects stand for.

    Raises
    ------
    InputError
        Where the library cannot be read.
    """
    wanted = dict.fromkeys([*gathered.meshes, *(p.label for p in ground.polygons if p.label)])
    sources = {} if library is None else library_objects(library, wanted)
    for source in sources.values():
        shelf(scene).objects.link(source)
    problems: dict[str, str] = {}
    for kind, points in gathered.placed():
        source = sources.get(kind.mesh)
        if source is None:
            where = "--library names no file" if library is None else f"{library} has no such object"
            problems[kind.mesh] = (
                f"node {kind.node!r}: the library object {kind.mesh!r} is missing ({where}); plain boxes take "
                "its places, add it to the library"
            )
            cube = _cube(scene, kind.mesh, kind.label)
            _show(scene, kind.label or names.UNLABELLED, cube, points.corners, points.turns, points.sizes)
            continue
        if kind.bend and source.type in BENDING:
            source = _bent(scene, source, kind)
        _show(scene, kind.label or names.UNLABELLED, source, points.positions, points.turns, points.scales)
    standing = [_on_the_ground(scene, ground, name, source) for name, source in sources.items()]
    return standing, tuple(problems.values()), frozenset(sources)


def _bent(scene: bpy.types.Scene, source: bpy.types.Object, kind: Kind) -> bpy.types.Object:
    """A library object that is bent as the outline of a kind."""
    made = source.copy()
    made.data = bent_data(source.data, *kind.outlines, np.eye(4))
    shelf(scene).objects.link(made)
    return made


def _show(
    scene: bpy.types.Scene, label: str, source: bpy.types.Object, positions: Single, turns: Single, scales: Single
) -> None:
    made = scattered(label if source.name == label else f"{label}: {source.name}", source, positions, turns, scales)
    made[names.LABEL] = label
    ensure_holder(scene.collection, label).objects.link(made)


def _on_the_ground(scene: bpy.types.Scene, ground: Scene, name: str, source: bpy.types.Object) -> Boxes:
    """Show a library object on the polygons that have its name for a label, each as large as that; the boxes."""
    there = [p for p in ground.polygons if p.label == name]
    if not there:
        return np.zeros((0, 3)), np.zeros((0, 3))
    extent = max(*source.dimensions[:2], 1e-6)
    positions = np.array([(*p.centroid, 0.0) for p in there])
    half = np.array([p.main_orientation for p in there]) / 2
    turns = np.column_stack([np.cos(half), np.zeros((len(there), 2)), np.sin(half)])
    scales = np.array([[float((p.bounds[2:] - p.bounds[:2]).max()) / extent] for p in there])
    arrays = (np.asarray(a, np.float32) for a in (positions, turns, np.repeat(scales, 3, axis=1)))
    _show(scene, name, source, *arrays)
    reach = scales * (extent / 2, extent / 2, 0.0)
    return positions - reach, positions + reach + scales * (0.0, 0.0, source.dimensions[2])


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
