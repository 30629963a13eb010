"""What has been built of a tile, as arrays: what processes hand each other, and what is kept on disk."""

import io
import json
import zipfile
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..geometry.mesh import Mesh, joined
from ..operations.applied import Applied
from ..operations.element import Element
from .placed import Outlines, Placed, placed_of, placed_together

Array = NDArray[np.float64]

#: Version of the form that products have on disk.
FORM = 2

#: Names of the arrays of what is placed.
PLACED = ("places", "scales", "low", "size", "bend", "bends")


@dataclass(frozen=True, eq=False)
class Masses:
    """Meshes one after the other.

    Attributes
    ----------
    mesh : Mesh
        All of them.
    vertex_start, face_start : ndarray of shape (n + 1,), int
        Where each begins.
    names, labels, parcels : list of str
        Of each: the element's id and label, and the parcel that it was built on.
    """

    mesh: Mesh
    vertex_start: NDArray[np.intp]
    face_start: NDArray[np.intp]
    names: list[str]
    labels: list[str]
    parcels: list[str]

    def __len__(self) -> int:
        return len(self.names)

    def single(self, k: int) -> Mesh:
        """One of the meshes.

        Parameters
        ----------
        k : int

        Returns
        -------
        Mesh
        """
        v, w = self.vertex_start[k : k + 2]
        f, g = self.face_start[k : k + 2]
        whole = self.mesh
        faces = whole.faces[f:g] - v
        return Mesh(whole.vertices[v:w], faces, whole.uv[f:g], whole.materials, whole.material_index[f:g])


@dataclass(frozen=True, eq=False)
class Product:
    """What has been built of a tile.

    Attributes
    ----------
    masses : Masses
    placed : Placed
    facts : mapping
        "parcels", "elements", "problems", "hit_rate", "seconds" by the kind of operation.
    """

    masses: Masses
    placed: Placed
    facts: Mapping[str, Any]

    def content(self) -> tuple[Any, ...]:
        """All but how long it took and what was remembered, comparable."""
        m = self.masses
        placed, plain = self.placed.content()
        arrays = (m.mesh.vertices, m.mesh.faces, m.mesh.uv, m.mesh.material_index, m.vertex_start, *placed)
        texts = (m.mesh.materials, m.names, m.labels, m.parcels, *plain)
        facts = {name: self.facts[name] for name in ("parcels", "elements", "problems")}
        return (*(a.tobytes() for a in arrays), json.dumps(texts), json.dumps(facts))

    def to_bytes(self) -> bytes:
        """As it is kept on disk.

        Returns
        -------
        bytes
        """
        m = self.masses
        placed, plain = self.placed.content()
        texts = {
            "form": FORM,
            "materials": m.mesh.materials,
            "names": m.names,
            "labels": m.labels,
            "parcels": m.parcels,
            "placed": plain,
            "facts": dict(self.facts),
        }
        named: dict[str, Any] = dict(zip(PLACED, placed, strict=True))
        stream = io.BytesIO()
        np.savez(
            stream,
            texts=np.frombuffer(json.dumps(texts).encode(), np.uint8),
            vertices=m.mesh.vertices,
            faces=m.mesh.faces.astype(np.int32),
            uv=m.mesh.uv,
            material=m.mesh.material_index.astype(np.int16),
            vertex_start=m.vertex_start,
            face_start=m.face_start,
            **named,
        )
        return stream.getvalue()

    @classmethod
    def from_bytes(cls, content: bytes) -> "Product":
        """What `to_bytes` wrote.

        Parameters
        ----------
        content : bytes

        Returns
        -------
        Product

        Raises
        ------
        InputError
            Where the content is damaged or of another form.
        """
        try:
            with np.load(io.BytesIO(content), allow_pickle=False) as there:
                texts = json.loads(there["texts"].tobytes())
                if texts["form"] != FORM:
                    raise InputError("the finished tile has another form; build it again")
                mesh = Mesh(
                    there["vertices"],
                    there["faces"].astype(np.intp),
                    there["uv"],
                    tuple(texts["materials"]),
                    there["material"].astype(np.intp),
                )
                starts = (there["vertex_start"], there["face_start"])
                masses = Masses(mesh, *starts, texts["names"], texts["labels"], texts["parcels"])
                placed = Placed.of_content([there[name] for name in PLACED], texts["placed"])
                return cls(masses, placed, texts["facts"])
        except (ValueError, KeyError, EOFError, OSError, TypeError, IndexError, zipfile.BadZipFile) as error:
            if isinstance(error, InputError):
                raise
            raise InputError(f"the finished tile is damaged ({error}); build it again") from None


def masses_of(meshes: Iterable[tuple[Element, Mesh, str]]) -> Masses:
    """Meshes of elements, one after the other.

    Parameters
    ----------
    meshes : iterable of (Element, Mesh, str)
        With the parcel of each.

    Returns
    -------
    Masses
    """
    given = list(meshes)
    every = [mesh for _, mesh, _ in given]
    return Masses(
        joined(every),
        _starts([len(mesh.vertices) for mesh in every]),
        _starts([len(mesh.faces) for mesh in every]),
        [e.id for e, _, _ in given],
        [e.label for e, _, _ in given],
        [parcel for _, _, parcel in given],
    )


def _starts(counts: list[int]) -> NDArray[np.intp]:
    return np.cumsum([0, *counts]).astype(np.intp)


def product_of(applied: Applied, parcel_of: Mapping[str, str], facts: Mapping[str, Any], outlines: Outlines) -> Product:
    """What a tree has built, as arrays.

    Parameters
    ----------
    applied : Applied
    parcel_of : mapping of str to str
        By the id of a polygon of the ground, the parcel that it belongs to.
    facts : mapping
        The product's.
    outlines : mapping
        Of the library objects that are bent, as `placed.outlines_of` returns them.

    Returns
    -------
    Product
    """
    by_id = applied.layout.by_id

    def parcel(element: Element) -> str:
        while element.owner in by_id:
            element = by_id[element.owner]
        at = element.parent
        while at not in parcel_of and at in by_id:
            at = by_id[at].parent
        return parcel_of.get(at, "")

    meshes = ((e, e.mesh, parcel(e)) for e in applied if isinstance(e.mesh, Mesh))
    return Product(masses_of(meshes), placed_of(applied.layout.elements, outlines), facts)


def together(products: Iterable[Product]) -> Product:
    """Several products as one.

    Parameters
    ----------
    products : iterable of Product

    Returns
    -------
    Product
        Its facts are added up.
    """
    given = list(products)
    m = [g.masses for g in given]
    masses = Masses(
        joined([one.mesh for one in m]),
        _starts([n for one in m for n in np.diff(one.vertex_start).tolist()]),
        _starts([n for one in m for n in np.diff(one.face_start).tolist()]),
        *([text for one in m for text in getattr(one, name)] for name in ("names", "labels", "parcels")),
    )
    return Product(masses, placed_together([g.placed for g in given]), added([g.facts for g in given]))


def added(facts: Iterable[Mapping[str, Any]]) -> dict[str, Any]:
    """The facts of several products, added up.

    Parameters
    ----------
    facts : iterable of mapping

    Returns
    -------
    dict
    """
    whole: dict[str, Any] = {"parcels": [], "elements": 0, "problems": [], "known": 0, "surfaces": 0, "seconds": {}}
    for one in facts:
        for name in ("parcels", "elements", "problems", "known", "surfaces"):
            whole[name] += one[name]
        for kind, seconds in one["seconds"].items():
            whole["seconds"][kind] = whole["seconds"].get(kind, 0.0) + seconds
    whole["problems"] = list(dict.fromkeys(whole["problems"]))
    return whole
