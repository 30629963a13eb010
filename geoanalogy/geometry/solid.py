"""Solids: closed meshes of planar, named faces (section 5.6)."""

from collections import defaultdict
from collections.abc import Iterable, Sequence
from copy import copy
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
import shapely
import shapely.affinity
from numpy.typing import NDArray

from ..tolerances import COPLANAR, SMALLEST_FACE, SURFACE_GRID
from .frame import Frame
from .loops import border
from .mesh import Mesh
from .polygon import Polygon, signed_area
from .surface import Surface

Array = NDArray[np.float64]

#: An outline and its holes.
Rings = tuple[tuple[tuple[float, float], ...], ...]


@dataclass(frozen=True)
class Face:
    """A planar side of a solid.

    Attributes
    ----------
    name : str
        Its name among the faces of the solid; it survives booleans.
    label : str
        What kind of surface it is; its material has this name, too.
    frame : Frame
        Where it lies, in the solid's coordinates; the normal points outwards.
    domain : tuple of Rings or None
        The outline and holes of each connected part of the face in the frame's coordinates, where these are kept
        although openings have been cut; None: what there is of the face.
    """

    name: str
    label: str
    frame: Frame
    domain: tuple[Rings, ...] | None = None

    @cached_property
    def plane(self) -> tuple[object, ...]:
        """What faces of one label in one plane have in common; those that keep their outlines stay apart."""
        (a, b, c), (x, y, z) = self.frame.normal.tolist(), self.frame.origin
        place = (round(v, COPLANAR) + 0.0 for v in (a, b, c, a * x + b * y + c * z))
        return (self.label, self.domain is None or self.name, *place)

    @cached_property
    def own_surfaces(self) -> tuple[tuple[str, Frame, Polygon], ...]:
        """`surfaces` of the domain, which stay the same whatever happens to the solid."""
        assert self.domain is not None
        return self.surfaces([shapely.Polygon(outer, holes) for outer, *holes in self.domain])

    def surfaces(self, parts: Iterable[shapely.Polygon]) -> tuple[tuple[str, Frame, Polygon], ...]:
        """The surfaces of the connected parts of the face: names, frames and outlines, in the solid's coordinates.

        Parameters
        ----------
        parts : iterable of shapely.Polygon
            In the face's frame.

        Returns
        -------
        tuple of (str, Frame, Polygon)
            See `Solid.surfaces_of`.
        """
        found = []
        for i, part in enumerate(parts):
            x, y = part.bounds[:2]
            # On a grid, equal surfaces have identical outlines; collinear vertices are no corners of a surface.
            plain = shapely.simplify(shapely.affinity.translate(part, -x, -y), SURFACE_GRID)
            valid = shapely.get_parts(shapely.set_precision(plain, SURFACE_GRID))
            if not len(valid):
                continue
            plain = shapely.orient_polygons(max(valid, key=shapely.area))
            rings = [
                _from_least(np.round(shapely.get_coordinates(r)[:-1], 6)) for r in (plain.exterior, *plain.interiors)
            ]
            name = self.name if i == 0 else f"{self.name}#{i + 1}"
            polygon = Polygon(rings[0], self.label, name, rings[1:], orientation=0.0)
            found.append((name, self.frame.moved(x, y), polygon))
        return tuple(found)

    @property
    def flipped(self) -> "Face":
        """The face seen from behind."""
        if self.domain is None:
            return replace(self, frame=self.frame.flipped)
        mirrored = tuple(tuple(tuple((-u, v) for u, v in ring[::-1]) for ring in rings) for rings in self.domain)
        return replace(self, frame=self.frame.flipped, domain=mirrored)


@dataclass(frozen=True, eq=False)
class Solid:
    """A closed mesh, each triangle of which belongs to a planar face.

    Attributes
    ----------
    vertices : ndarray of shape (n, 3)
        In the solid's own coordinates.
    triangles : ndarray of shape (k, 3), int
        Counter-clockwise seen from outside.
    face : ndarray of shape (k,), int
        Which of the faces each triangle belongs to.
    faces : tuple of Face
    """

    vertices: Array
    triangles: NDArray[np.intp]
    face: NDArray[np.intp]
    faces: tuple[Face, ...]

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Solid):
            return NotImplemented
        return self is other or (hash(self) == hash(other) and self.content == other.content)

    def __hash__(self) -> int:
        return self._hash

    @cached_property
    def _hash(self) -> int:
        return hash((self.vertices.tobytes(), len(self.triangles), len(self.faces)))

    @property
    def content(self) -> tuple[object, ...]:
        """All there is to know of the solid, hashable."""
        return (self.vertices.tobytes(), self.triangles.tobytes(), self.face.tobytes(), self.faces)

    @property
    def nbytes(self) -> int:
        """Bytes held."""
        return self.vertices.nbytes + self.triangles.nbytes + self.face.nbytes

    @property
    def is_closed(self) -> bool:
        """Whether every edge joins two triangles that run along it in opposite directions: watertight, manifold."""
        a = self.triangles.ravel()
        b = self.triangles[:, [1, 2, 0]].ravel()
        n = len(self.vertices)
        forth, back = np.sort(a * n + b), np.sort(b * n + a)
        return bool(len(forth) and (a != b).all() and (np.diff(forth) > 0).all() and (forth == back).all())

    @property
    def volume(self) -> float:
        """Volume in cubed scene units; the normals point outwards where it is positive."""
        a, b, c = (self.vertices[self.triangles[:, i]] - self.vertices[:1] for i in range(3))
        return float(np.einsum("ij,ij->", np.cross(a, b), c) / 6)

    @cached_property
    def derived(self) -> dict[str, Any]:
        """What others have made of the solid and keep with it, by name."""
        return {}

    @cached_property
    def by_label(self) -> dict[str, tuple[int, ...]]:
        """Indices of the faces that have triangles, by label."""
        found = defaultdict(list)
        for i in np.flatnonzero(np.bincount(self.face, minlength=len(self.faces))):
            found[self.faces[i].label].append(int(i))
        return {label: tuple(indices) for label, indices in found.items()}

    @cached_property
    def by_name(self) -> dict[str, int]:
        """Index of every face by its name."""
        return {face.name: i for i, face in enumerate(self.faces)}

    def triangles_of(self, face: int) -> NDArray[np.intp]:
        """The triangles of a face, shape (k, 3)."""
        return self.triangles[self.face == face]

    def on_face(self, face: int) -> Array:
        """All vertices in the coordinates of a face, shape (n, 2)."""
        return self.faces[face].frame.to_plane(self.vertices)[:, :2]

    def shapes(self, face: int) -> list[shapely.Polygon]:
        """What there is of a face in the coordinates of its frame: one polygon per connected part, large ones first.

        Parameters
        ----------
        face : int

        Returns
        -------
        list of shapely.Polygon
        """
        triangles = self.triangles_of(face)
        points = self.on_face(face)
        rings = [points[loop] for loop in border(triangles, points)]
        areas = [signed_area(ring) for ring in rings]
        outlines = [shapely.Polygon(ring) for ring, area in zip(rings, areas, strict=True) if area > SMALLEST_FACE]
        holes = [shapely.Polygon(ring) for ring, area in zip(rings, areas, strict=True) if area < -SMALLEST_FACE]
        missing = shapely.union_all(shapely.buffer(holes, 0.0), grid_size=SURFACE_GRID)
        parts = [
            p
            for outline in shapely.buffer(outlines, 0.0)
            for p in shapely.get_parts(shapely.difference(outline, missing, grid_size=SURFACE_GRID))
            if isinstance(p, shapely.Polygon) and p.area > SMALLEST_FACE
        ]
        return sorted(parts, key=lambda p: -p.area)

    @cached_property
    def _surfaces(self) -> dict[int, tuple[tuple[str, Frame, Polygon], ...]]:
        return {}

    def surfaces_of(self, face: int) -> tuple[tuple[str, Frame, Polygon], ...]:
        """The surfaces that a face gives: names, frames and outlines, in the solid's coordinates.

        Parameters
        ----------
        face : int

        Returns
        -------
        tuple of (str, Frame, Polygon)
            One per connected part; the first has the face's name. The origin of the frame is the lower left corner of
            the outline's bounding box, so that equal surfaces have equal outlines.
        """
        if face not in self._surfaces:
            one = self.faces[face]
            self._surfaces[face] = one.own_surfaces if one.domain is not None else one.surfaces(self.shapes(face))
        return self._surfaces[face]

    def surfaces(self, owner: str, frame: Frame, faces: Iterable[int] | None = None) -> list[Surface]:
        """The surfaces of the solid.

        Parameters
        ----------
        owner : str
            Id of the element that has the solid; the ids of the surfaces begin with it.
        frame : Frame
            Where the solid stands.
        faces : iterable of int, optional
            Only those of these faces.

        Returns
        -------
        list of Surface
        """
        wanted = {i for indices in self.by_label.values() for i in indices} if faces is None else set(faces)
        found = []
        for i in sorted(wanted):
            for name, where, polygon in self.surfaces_of(i):
                own = copy(polygon)
                own.__dict__.pop("content", None)  # which has the id
                own.id = f"{owner}:{name}"
                found.append(Surface(own.id, own.label, where.inside(frame), own, owner))
        return found

    @cached_property
    def mesh(self) -> Mesh:
        """The solid as a mesh with the labels of its faces as materials and their coordinates as UVs."""
        materials = tuple(dict.fromkeys(face.label for face in self.faces))
        index = np.array([materials.index(face.label) for face in self.faces], dtype=np.intp)
        origins = np.array([face.frame.origin for face in self.faces])[self.face][:, None]
        axes = np.array([face.frame.axes[:2] for face in self.faces])[self.face]
        corners = self.vertices[self.triangles] - origins
        uv = np.einsum("kcs,kas->kca", corners, axes)
        return Mesh(self.vertices, self.triangles, uv, materials, index[self.face])

    def with_domain(self, face: int) -> "Solid":
        """The solid, one surface of which keeps the outline that it has now, whatever is cut out of it or added.

        Parameters
        ----------
        face : int

        Returns
        -------
        Solid
        """
        parts = self.shapes(face) if self.faces[face].domain is None else []
        if not parts:
            return self
        kept = replace(self.faces[face], domain=tuple(_rings(shapely.simplify(part, SURFACE_GRID)) for part in parts))
        return replace(self, faces=(*self.faces[:face], kept, *self.faces[face + 1 :]))

    def renamed(self, prefix: str) -> "Solid":
        """The solid with a prefix before the names of its faces."""
        faces = (Face(f"{prefix}:{face.name}", face.label, face.frame, face.domain) for face in self.faces)
        return Solid(self.vertices, self.triangles, self.face, tuple(faces))


def _rings(shape: shapely.Polygon) -> Rings:
    rings = (shapely.get_coordinates(ring)[:-1].tolist() for ring in (shape.exterior, *shape.interiors))
    return tuple(tuple((u, v) for u, v in ring) for ring in rings)


def _from_least(ring: Array) -> Array:
    """The ring from its least vertex on."""
    return np.roll(ring, -int(np.lexsort(ring.T[::-1])[0]), axis=0) + 0.0


def assembled(parts: Sequence[tuple[Array, NDArray[np.intp], int]], faces: Sequence[Face]) -> Solid:
    """A solid of triangles by their corners; corners in the same place are one vertex.

    Parameters
    ----------
    parts : sequence of (ndarray of shape (n, 3), ndarray of shape (k, 3), int)
        Vertices, triangles and the face they belong to. Shared corners must have identical coordinates.
    faces : sequence of Face

    Returns
    -------
    Solid
    """
    starts = np.cumsum([0, *(len(points) for points, _, _ in parts)])
    points = np.concatenate([points for points, _, _ in parts]) + 0.0
    triangles = np.concatenate([t + s for (_, t, _), s in zip(parts, starts, strict=False)])
    order = np.lexsort(points.T[::-1])
    ordered = points[order]
    distinct = np.concatenate([[True], (ordered[1:] != ordered[:-1]).any(axis=1)])
    index = np.empty(len(points), dtype=np.intp)
    index[order] = np.cumsum(distinct) - 1
    face = np.repeat([f for _, _, f in parts], [len(t) for _, t, _ in parts])
    return Solid(ordered[distinct], index[triangles], face, tuple(faces))
