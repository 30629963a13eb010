"""Pictures of what operations trees have built, in the finishes of the palette; drawing needs Blender."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from geoanalogy.geometry.mesh import Mesh, joined

from .library import ASSETS
from .library.fittings import FITTINGS
from .library.palette import PALETTE
from .library.solids import Solid


def engine_mesh(solid: Solid) -> Mesh:
    """A solid of the library as the engine's mesh."""
    faces = [(f[0], f[i], f[i + 1]) for f in solid.faces for i in range(1, len(f) - 1)]
    names = sorted(set(solid.materials))
    index = [names.index(m) for f, m in zip(solid.faces, solid.materials, strict=True) for _ in range(len(f) - 2)]
    triangles = np.array(faces, dtype=np.intp)
    uv = solid.vertices[triangles][:, :, :2]
    return Mesh(solid.vertices, triangles, uv, tuple(names), np.array(index, dtype=np.intp))


def library() -> dict[str, Mesh]:
    """All fittings and furniture by their names."""
    made = {name: engine_mesh(fitting.solid()) for name, fitting in FITTINGS.items()}
    return {**{name: engine_mesh(a.solid()) for name, a in ASSETS.items() if a.family == "furniture"}, **made}


def finish(label: str, finishes: Mapping[str, str], otherwise: str) -> str:
    """The finish of a face: what its label names, or what the last word of that stands for that is found."""
    if label in PALETTE:
        return label
    return next((finishes[word] for word in reversed(label.split()) if word in finishes), otherwise)


def finished(mesh: Mesh, finishes: Mapping[str, str], otherwise: str) -> Mesh:
    """A mesh whose materials are finishes."""
    return replace(mesh, materials=tuple(finish(name, finishes, otherwise) for name in mesh.materials))


def draw(
    meshes: Sequence[Mesh],
    picture: Path,
    turn: float,
    elevation: float,
    size: tuple[int, int],
    samples: int = 24,
    ground: tuple[str, float] = ("hall stone", -0.02),
    lens: float = 70.0,
    seen: np.ndarray | None = None,
    visibility: float | None = None,
) -> None:
    """Render meshes in the finishes that their materials name.

    ``turn`` and ``elevation`` say where the viewer stands, in degrees; ``ground`` is its finish and height. The camera
    shows the points ``seen``, of shape (n, 3); where there are none, everything. Haze takes most of what is further
    away than ``visibility`` metres, under a blue sky.
    """
    import bpy

    from geoanalogy.blender.writing.buildings import mesh_data

    from . import haze, stage
    from .library.materials import material

    scene = stage.clear()
    whole = joined(list(meshes))
    for name in whole.materials:
        material(name)
    stage.collection(scene, "Built").objects.link(bpy.data.objects.new("Built", mesh_data("Built", whole)))
    stage.settings(scene, *size, samples)
    stage.light(scene)
    stage.ground(
        scene, whole.vertices, ground[0], margin=10.0 * float(np.ptp(whole.vertices, axis=0).max()), z=ground[1]
    )
    points = whole.vertices if seen is None else seen
    stage.camera(scene, points, elevation=elevation, turn=turn, lens=lens, margin=0.02)
    if visibility is not None:
        haze.light(scene)
        haze.Haze().reach(visibility)
    stage.render(scene, picture)
