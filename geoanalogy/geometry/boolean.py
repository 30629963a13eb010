"""Merging and subtracting solids (section 5.6)."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..tolerances import COORDINATE_GRID, PARALLEL_AXES
from .frame import SPACE, Frame
from .solid import Face, Solid

if TYPE_CHECKING:
    # Scenes without solids need no library for them.
    import manifold3d

Array = NDArray[np.float64]
Kind = Literal["merge", "subtract"]


def combined(first: Solid, others: Sequence[tuple[Solid, Frame]], kind: Kind, plane: Frame = SPACE) -> Solid:
    """A solid with others merged into it or subtracted from it.

    All is rounded to a common grid, in the coordinates of the plane where the solids meet: what is meant to touch or to
    be coplanar is so to the last bit, which the boolean treats exactly.

    Parameters
    ----------
    first : Solid
    others : sequence of (Solid, Frame)
        With the frame that each stands in, in the coordinates of the first. The names of their faces are kept, so give
        them different ones.
    kind : str
        "merge" or "subtract".
    plane : Frame
        Where they meet, in the coordinates of the first.

    Returns
    -------
    Solid
        In the coordinates of the first. Faces of one label in one plane are one face.

    Raises
    ------
    InputError
        Where a solid is not closed, and where nothing is left.
    """
    square = is_square(plane)
    if square:  # the grid is that of the solid itself, which then need not be built anew each time
        plane = SPACE
    faces = list(first.faces)
    planes = {face.plane: i for i, face in reversed(list(enumerate(faces)))} if kind == "merge" else {}
    manifolds = [_manifold(first) if square else _built(plane.to_plane(first.vertices), first.triangles, first.face)]
    for solid, frame in others:
        index = []
        for one in solid.faces:
            face = Face(one.name, one.label, one.frame.inside(frame), one.domain)
            face = face.flipped if kind == "subtract" else face
            same = planes.setdefault(face.plane, len(faces)) if kind == "merge" else len(faces)
            if same == len(faces):
                faces.append(face)
            index.append(same)
        there = plane.to_plane(frame.to_space(solid.vertices))
        manifolds.append(_built(there, solid.triangles, np.array(index)[solid.face]))
    import manifold3d

    operation = manifold3d.OpType.Add if kind == "merge" else manifold3d.OpType.Subtract
    result = manifold3d.Manifold.batch_boolean(manifolds, operation)
    mesh = result.to_mesh64()
    if not len(mesh.tri_verts):
        raise InputError("nothing is left of the solid; subtract less")
    vertices = np.asarray(mesh.vert_properties)[:, :3]
    triangles = np.asarray(mesh.tri_verts, dtype=np.intp)
    made = Solid(
        vertices if square else plane.to_space(vertices),
        triangles,
        np.asarray(mesh.face_id, dtype=np.intp),
        tuple(faces),
    )
    if square:
        made.derived["manifold"] = result
    return made


def is_square(plane: Frame) -> bool:
    """Whether the axes of a frame are parallel to those of the coordinates that it is given in.

    Parameters
    ----------
    plane : Frame

    Returns
    -------
    bool
    """
    return bool((np.abs(plane.axes - np.round(plane.axes)) < PARALLEL_AXES).all())


def _manifold(solid: Solid) -> "manifold3d.Manifold":
    """The solid as the library has it, kept with it: building it anew takes longer than a boolean."""
    if "manifold" not in solid.derived:
        solid.derived["manifold"] = _built(solid.vertices, solid.triangles, solid.face)
    return solid.derived["manifold"]


def _built(vertices: Array, triangles: NDArray[np.intp], face: NDArray[np.intp]) -> "manifold3d.Manifold":
    import manifold3d

    rounded = np.ascontiguousarray(np.round(vertices / COORDINATE_GRID) * COORDINATE_GRID)
    mesh = manifold3d.Mesh64(
        rounded, np.ascontiguousarray(triangles, dtype=np.uint64), face_id=np.ascontiguousarray(face, dtype=np.uint64)
    )
    made = manifold3d.Manifold(mesh)
    if made.status() != manifold3d.Error.NoError:
        raise InputError(f"a solid is not closed ({made.status().name}); extrude it again")
    return made
