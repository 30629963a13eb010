"""What has been built, tile by tile, gathered by what it becomes: of a tile no more is kept than a .blend has of it."""

import zlib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...batch.placed import Placed
from ...batch.product import Masses, Product
from ...geometry.mesh import Mesh, joined
from ..names import UNLABELLED
from .extent import Boxes, turned
from .scattering import quaternions

Single = NDArray[np.float32]

#: Size of what stands for a missing library object that has no outline, scene units.
POINT_SIZE = 0.5

#: Thickness of what stands for a missing library object, in proportion to the shorter side of its outline: on level
#: surfaces a box, on others a panel.
BOX, PANEL = 1.0, 0.1


@dataclass(frozen=True, eq=False)
class Points:
    """Where equal library objects stand.

    Attributes
    ----------
    positions : ndarray of shape (n, 3)
    turns : ndarray of shape (n, 4)
        Unit quaternions.
    scales : ndarray of shape (n, 3)
    corners, sizes : ndarray of shape (n, 3)
        Of boxes that stand for them where the library has no such object: their lower corners in space, and extents.
    """

    positions: Single
    turns: Single
    scales: Single
    corners: Single
    sizes: Single

    def __len__(self) -> int:
        return len(self.positions)

    def __getitem__(self, those: NDArray[np.intp]) -> "Points":
        return Points(*(getattr(self, name)[those] for name in self.__dataclass_fields__))


@dataclass(frozen=True)
class Kind:
    """Library objects that are equal, up to places and sizes.

    Attributes
    ----------
    mesh, label : str
    node : str
        The first operation that places one.
    bend : bytes
        The outlines of what is bent, before and after, as an array of four columns; empty for all else.
    """

    mesh: str
    label: str
    node: str
    bend: bytes

    @property
    def outlines(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The outlines, before and after, each of shape (n, 2)."""
        rows = np.frombuffer(self.bend).reshape(-1, 4)
        return rows[:, :2], rows[:, 2:]


class Gathered:
    """What several tiles have built.

    Parameters
    ----------
    products : iterable of Product
        Each is let go before the next one is asked for.

    Attributes
    ----------
    boxes : list of Boxes
        That all of it lies within.
    instances : int
        How many library objects there are.
    """

    def __init__(self, products: Iterable[Product]) -> None:
        self.boxes: list[Boxes] = []
        self.instances = 0
        self._masses: dict[str, list[tuple[Mesh, Single]]] = {}
        self._kinds: dict[tuple[str, str, bytes], tuple[int, Kind]] = {}
        self._kind: list[NDArray[np.int32]] = []
        self._points: list[Points] = []
        for product in products:
            if len(product.masses):
                self._add_masses(product.masses)
            if len(product.placed):
                self._add_placed(product.placed)

    def masses(self) -> Iterator[tuple[str, Mesh, Single]]:
        """The meshes of each label as one, once.

        Yields
        ------
        str
            The label.
        Mesh
            In single precision.
        ndarray of shape (k,)
            Of each face a number from 0 to 1 that differs from parcel to parcel.
        """
        for label in list(self._masses):
            parts = self._masses.pop(label)
            yield label, joined([mesh for mesh, _ in parts]), np.concatenate([lots for _, lots in parts])

    def placed(self) -> Iterator[tuple[Kind, Points]]:
        """The library objects by their kinds, once.

        Yields
        ------
        Kind
        Points
        """
        if not self._kind:
            return
        kind = np.concatenate(self._kind)
        names = Points.__dataclass_fields__
        whole = Points(*(np.concatenate([getattr(points, name) for points in self._points]) for name in names))
        self._kind, self._points = [], []
        order = np.argsort(kind, kind="stable")
        ends = np.cumsum(np.bincount(kind))
        for k, one in self._kinds.values():
            yield one, whole[order[ends[k - 1] if k else 0 : ends[k]]]

    @property
    def meshes(self) -> list[str]:
        """Names of the library objects."""
        return list(dict.fromkeys(kind.mesh for _, kind in self._kinds.values()))

    def _add_masses(self, masses: Masses) -> None:
        whole = masses.mesh
        filled = np.diff(masses.vertex_start) > 0
        if filled.any():
            starts = masses.vertex_start[:-1][filled]
            low, high = (extreme.reduceat(whole.vertices, starts) for extreme in (np.minimum, np.maximum))
            self.boxes.append((low, high))
        numbers = {label: k for k, label in enumerate(dict.fromkeys(label or UNLABELLED for label in masses.labels))}
        number = np.array([numbers[label or UNLABELLED] for label in masses.labels])
        lots = {parcel: zlib.crc32(parcel.encode()) / 0xFFFFFFFF for parcel in set(masses.parcels)}
        lot = np.array([lots[parcel] for parcel in masses.parcels], np.float32)
        # Vertices and faces by their labels, and in their own order among those of a label.
        of_vertex = np.repeat(number, np.diff(masses.vertex_start))
        of_face = np.repeat(number, np.diff(masses.face_start))
        vertex_order, face_order = (np.argsort(of, kind="stable") for of in (of_vertex, of_face))
        place = np.empty(len(vertex_order), np.int32)
        place[vertex_order] = np.arange(len(vertex_order), dtype=np.int32)
        vertices = whole.vertices.astype(np.float32)[vertex_order]
        faces = place[whole.faces[face_order]]
        uv = whole.uv.astype(np.float32)[face_order]
        index = whole.material_index[face_order]
        varied = np.repeat(lot, np.diff(masses.face_start))[face_order]
        v = f = 0
        for label, k in numbers.items():
            w, g = v + int(np.count_nonzero(of_vertex == k)), f + int(np.count_nonzero(of_face == k))
            used = np.unique(index[f:g])
            names = tuple(whole.materials[i] for i in used)
            finish = np.searchsorted(used, index[f:g]).astype(np.int16)
            mesh = Mesh(vertices[v:w].copy(), faces[f:g] - np.int32(v), uv[f:g].copy(), names, finish)
            self._masses.setdefault(label, []).append((mesh, varied[f:g].copy()))
            v, f = w, g

    def _add_placed(self, placed: Placed) -> None:
        self.instances += len(placed)
        low, size = _boxes(placed)
        turns, positions = placed.places[:, :3, :3], placed.places[:, :3, 3]
        corners = positions + (turns @ (low * placed.scales)[:, :, None])[:, :, 0]
        self.boxes.append(turned(low, size, placed.scales, placed.places))
        parts = (positions, quaternions(turns), placed.scales, corners, size * placed.scales)
        self._points.append(Points(*(np.asarray(part, np.float32) for part in parts)))
        bends = [rows.tobytes() for rows in placed.bends]
        number = []
        rows = zip(placed.meshes, placed.labels, placed.bend.tolist(), placed.nodes, strict=True)
        for mesh, label, bend, node in rows:
            name = (mesh, label, bends[bend] if bend >= 0 else b"")
            if name not in self._kinds:
                self._kinds[name] = (len(self._kinds), Kind(mesh, label, node, name[2]))
            number.append(self._kinds[name][0])
        self._kind.append(np.array(number, np.int32))


def _boxes(placed: Placed) -> Boxes:
    """Lower corners and extents, in their own coordinates, of what library objects are taken to fill."""
    low, size = placed.low.copy(), placed.size.copy()
    level = np.abs(placed.places[:, 2, 2]) > np.sqrt(0.5)
    size[:, 2] *= np.where(level, BOX, PANEL)
    unknown = ~placed.size.any(axis=1)
    size[unknown] = POINT_SIZE
    low[unknown] = (-POINT_SIZE / 2, -POINT_SIZE / 2, 0.0)
    return low, size
