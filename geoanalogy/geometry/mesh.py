"""Meshes: what of a solid or a flat element can be drawn."""

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from .frame import Frame

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles with texture coordinates and named materials.

    Attributes
    ----------
    vertices : ndarray of shape (n, 3)
    faces : ndarray of shape (k, 3), int
        Corners of triangles, counter-clockwise seen from outside.
    uv : ndarray of shape (k, 3, 2)
        Texture coordinates of the corners, in scene units on the surface of each triangle.
    materials : tuple of str
        Names.
    material_index : ndarray of shape (k,), int
        Which of them each triangle has.
    """

    vertices: Array
    faces: NDArray[np.intp]
    uv: Array
    materials: tuple[str, ...]
    material_index: NDArray[np.intp]

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Mesh) and all(
            np.array_equal(getattr(self, f.name), getattr(other, f.name)) for f in fields(self)
        )

    def __hash__(self) -> int:
        return hash((len(self.vertices), len(self.faces), self.materials))

    @property
    def material(self) -> str:
        """Name of the material that most triangles have; "" for a mesh without triangles."""
        if not len(self.faces):
            return ""
        return self.materials[int(np.bincount(self.material_index).argmax())]

    @property
    def nbytes(self) -> int:
        """Bytes held."""
        return self.vertices.nbytes + self.faces.nbytes + self.uv.nbytes + self.material_index.nbytes

    def placed(self, frame: Frame) -> "Mesh":
        """The mesh in the coordinates that a frame is given in.

        Parameters
        ----------
        frame : Frame
            Its vertices are in the coordinates of this one.

        Returns
        -------
        Mesh
        """
        return Mesh(frame.to_space(self.vertices), self.faces, self.uv, self.materials, self.material_index)


def joined(meshes: Sequence[Mesh]) -> Mesh:
    """Several meshes as one.

    Parameters
    ----------
    meshes : sequence of Mesh

    Returns
    -------
    Mesh
        Its arrays have the types that those of the given ones have.
    """
    if not meshes:
        return Mesh(np.zeros((0, 3)), np.zeros((0, 3), np.intp), np.zeros((0, 3, 2)), (), np.zeros(0, np.intp))
    materials = tuple(dict.fromkeys(name for mesh in meshes for name in mesh.materials))
    starts = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])
    index = [np.array([materials.index(name) for name in m.materials], m.material_index.dtype) for m in meshes]
    return Mesh(
        np.concatenate([mesh.vertices for mesh in meshes]),
        np.concatenate([m.faces + m.faces.dtype.type(s) for m, s in zip(meshes, starts, strict=False)]),
        np.concatenate([mesh.uv for mesh in meshes]),
        materials,
        np.concatenate([i[m.material_index] for i, m in zip(index, meshes, strict=True)]),
    )
