"""Library objects in their places, as arrays."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..geometry.cage import is_bent
from ..operations.applied import instances
from ..operations.element import Element, Ring
from ..operations.group_placement import GroupPlacement
from ..operations.tree import OperationsTree

Array = NDArray[np.float64]

#: By the operation and the library object: the outline that it has before it is bent.
Outlines = Mapping[tuple[str, str], Array]


@dataclass(frozen=True, eq=False)
class Placed:
    """Library objects in their places.

    Attributes
    ----------
    places : ndarray of shape (n, 4, 4)
        From the object's coordinates, already scaled, to space: a rotation and a shift.
    scales : ndarray of shape (n, 3)
        Negative along an axis where the object is mirrored.
    low, size : ndarray of shape (n, 3)
        Box that it fills in its own coordinates, lower corner and extents; size 0 where its outline is not known.
    bend : ndarray of shape (n,), int
        Which of the bends it has; -1 for none.
    meshes, labels, nodes, keys : list of str
        Of each: the library object, what it is, and the name of the result.
    bends : list of ndarray of shape (k, 4)
        An outline in the object's own coordinates in two columns, and the outline that it is bent to in two more.
    """

    places: Array
    scales: Array
    low: Array
    size: Array
    bend: NDArray[np.intp]
    meshes: list[str]
    labels: list[str]
    nodes: list[str]
    keys: list[str]
    bends: list[Array]

    def __len__(self) -> int:
        return len(self.meshes)

    def content(self) -> tuple[list[Array | NDArray[np.intp]], list[Any]]:
        """The arrays that it consists of, the bends one after the other, and the rest as plain data.

        Returns
        -------
        list of ndarray
        list
        """
        bends = np.concatenate([np.zeros((0, 4)), *self.bends])
        counts = [len(one) for one in self.bends]
        arrays = [self.places, self.scales, self.low, self.size, self.bend, bends]
        return arrays, [self.meshes, self.labels, self.nodes, self.keys, counts]

    @classmethod
    def of_content(cls, arrays: Sequence[Array], plain: Sequence[list[Any]]) -> "Placed":
        """The inverse of `content`.

        Parameters
        ----------
        arrays : sequence of ndarray
        plain : sequence of list

        Returns
        -------
        Placed
        """
        places, scales, low, size, bend, rows = arrays
        meshes, labels, nodes, keys, counts = plain
        bends = np.split(rows, np.cumsum(counts)[:-1]) if counts else []
        return cls(places, scales, low, size, bend.astype(np.intp), meshes, labels, nodes, keys, bends)


def outlines_of(tree: OperationsTree) -> dict[tuple[str, str], Array]:
    """The outlines of all library objects that a tree bends.

    Parameters
    ----------
    tree : OperationsTree

    Returns
    -------
    dict of (str, str) to ndarray of shape (n, 2)
        By the id of the node and the library object.
    """
    return {
        (node.id, mesh): outline
        for node in tree.nodes
        if isinstance(node.operation, GroupPlacement)
        for mesh, outline in node.operation.bent_outlines.items()
    }


def placed_of(elements: Iterable[Element], outlines: Outlines) -> Placed:
    """The library objects among elements.

    Parameters
    ----------
    elements : iterable of Element
        Of a layout.
    outlines : mapping
        As `outlines_of` returns them.

    Returns
    -------
    Placed
    """
    found = [i for i in instances(elements) if isinstance(i.mesh, str)]
    low, size = np.zeros((len(found), 3)), np.zeros((len(found), 3))
    bend = np.full(len(found), -1, dtype=np.intp)
    known: dict[tuple[str, str, Ring], int] = {}
    bends: list[Array] = []
    for k, i in enumerate(found):
        ring = i.element.footprint
        if ring is None:
            continue
        least, most = np.min(ring, axis=0), np.max(ring, axis=0)
        low[k, :2], size[k, :2] = least, most - least
        size[k, 2] = (most - least).min()
        outline = outlines.get((i.element.node, str(i.mesh)))
        if outline is not None and is_bent(outline, np.array(ring)):
            kind = (i.element.node, str(i.mesh), ring)
            if kind not in known:
                known[kind] = len(bends)
                bends.append(np.column_stack([outline, ring]))
            bend[k] = known[kind]
    return Placed(
        np.array([i.frame.matrix for i in found]).reshape(-1, 4, 4),
        np.array([i.scale for i in found], float).reshape(-1, 3),
        low,
        size,
        bend,
        [str(i.mesh) for i in found],
        [i.element.label for i in found],
        [i.element.node for i in found],
        [i.element.key for i in found],
        bends,
    )


def placed_together(several: Sequence[Placed]) -> Placed:
    """Those of several tiles.

    Parameters
    ----------
    several : sequence of Placed

    Returns
    -------
    Placed
    """
    nothing = np.zeros((0, 3))
    before = np.cumsum([0, *(len(one.bends) for one in several)])
    shifted = [np.where(one.bend < 0, -1, one.bend + n) for one, n in zip(several, before, strict=False)]
    return Placed(
        np.concatenate([np.zeros((0, 4, 4)), *(one.places for one in several)]),
        np.concatenate([nothing, *(one.scales for one in several)]),
        np.concatenate([nothing, *(one.low for one in several)]),
        np.concatenate([nothing, *(one.size for one in several)]),
        np.concatenate([np.zeros(0, np.intp), *shifted]),
        [text for one in several for text in one.meshes],
        [text for one in several for text in one.labels],
        [text for one in several for text in one.nodes],
        [text for one in several for text in one.keys],
        [rows for one in several for rows in one.bends],
    )
