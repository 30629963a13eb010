"""Feature vectors as they would be in a turned, mirrored or scaled copy of the surroundings.

Rooms of one kind are mirror images and quarter turns of each other as often as not, and their plans come in different
scales. Box coordinates and the relations of outlines under these changes follow from the ones at hand; nothing is
evaluated again.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..relations.table import Kind
from .signature import PARENT_BOX, Signature, outline_kinds, outline_relations_of

Array = NDArray[np.float64]

#: The eight ways in which a rectangle can be laid on itself: mirrored along x, mirrored along y, then x and y swapped.
TURNS = tuple((along_x, along_y, swapped) for swapped in (False, True) for along_y in (0, 1) for along_x in (0, 1))

#: Where each of the five samples goes when x or y is mirrored, and when x and y are swapped.
_MIRRORED_SAMPLES = ([1, 0, 3, 2, 4], [3, 2, 1, 0, 4])
_SWAPPED_SAMPLES = [0, 3, 2, 1, 4]


def flipped(values: Array) -> Array:
    """Box coordinates of the mirrored box.

    Parameters
    ----------
    values : ndarray of shape (..., 3, 4)
        By position and coordinate, along one axis.

    Returns
    -------
    ndarray of the same shape
    """
    turned = values[..., ::-1, :]
    return np.stack([-turned[..., 1], -turned[..., 0], -turned[..., 2], 1.0 - turned[..., 3]], axis=-1)


def turned_boxes(values: Array, turn: tuple[int, int, bool]) -> Array:
    """Box coordinates in a mirrored or turned copy.

    Parameters
    ----------
    values : ndarray of shape (..., 2, 3, 4)
        By axis, position and coordinate.
    turn : tuple
        One of `TURNS`.

    Returns
    -------
    ndarray of the same shape
    """
    parts = [flipped(values[..., axis, :, :]) if turn[axis] else values[..., axis, :, :] for axis in (0, 1)]
    return np.stack(parts[::-1] if turn[2] else parts, axis=-3)


def turned_outlines(outlines: dict[str, Array], turn: tuple[int, int, bool]) -> dict[str, Array]:
    """Relations of outlines that boxes would have in a mirrored or turned copy of their surroundings.

    Parameters
    ----------
    outlines : dict of str to ndarray of shape (n, k, 5, r)
        See `Signature`.
    turn : tuple
        One of `TURNS`.

    Returns
    -------
    dict of str to ndarray of shape (n, k, 5, r)
    """
    samples = np.arange(5)
    for axis in (0, 1):
        if turn[axis]:
            samples = samples[_MIRRORED_SAMPLES[axis]]
    if turn[2]:
        samples = samples[_SWAPPED_SAMPLES]
    reversed_ = (turn[0] + turn[1] + turn[2]) % 2 == 1  # a reflection: every ring runs the other way
    found = {}
    for key, values in outlines.items():
        moved = values[:, :, samples]
        if reversed_:
            for i, name in enumerate(outline_relations_of(key)):
                if name == "segment arc length":
                    moved[..., i] = 1.0 - moved[..., i]
                elif name == "corner ratio":  # beyond the corner's edges it goes on from 1 to 2 = 0
                    moved[..., i] = (1.0 - moved[..., i]) % 2.0
        found[key] = moved
    return found


def in_units(seen: Signature, units: Array | float) -> Signature:
    """Feature vectors whose lengths are counted in other units; ratios stay.

    Parameters
    ----------
    seen : Signature
        Of n boxes.
    units : float or ndarray of shape (n,)
        Length of the unit of each box, scene units.

    Returns
    -------
    Signature
    """
    unit = np.atleast_1d(np.asarray(units, dtype=np.float64))
    boxes = {}
    for key, values in seen.boxes.items():
        scaled = values.copy()
        scaled[..., :3] /= unit.reshape(-1, 1, 1, 1, 1)
        boxes[key] = scaled
    outlines = {}
    for key, values in seen.outlines.items():
        lengths = np.array([kind is Kind.LENGTH for kind in outline_kinds(key)[0]])
        outlines[key] = np.where(lengths, values / unit.reshape(-1, 1, 1, 1), values)
    return Signature(boxes, outlines)


def parent_sizes(seen: Signature) -> Array:
    """Width and height of the parent of each box, scene units, shape (n, 2).

    Parameters
    ----------
    seen : Signature

    Returns
    -------
    ndarray
    """
    edges = seen.boxes[PARENT_BOX][:, 0, :, 0]
    return edges[..., 0] - edges[..., 1]  # from the parent's minimum, less from its maximum


def parent_shares(seen: Signature, rows: Sequence[int] | NDArray[np.intp] | None = None) -> Array:
    """Boxes (x0, y0, x1, y1) as shares of their parents' boxes, shape (n, 4).

    Parameters
    ----------
    seen : Signature
    rows : sequence of int, optional
        Only these boxes.

    Returns
    -------
    ndarray
    """
    values = seen.boxes[PARENT_BOX][:, 0][:, :, [0, 2], 3]
    chosen = values if rows is None else values[np.asarray(rows, dtype=np.intp)]
    return chosen.transpose(0, 2, 1).reshape(len(chosen), 4)


def turned_shares(shares: Array, turn: tuple[int, int, bool]) -> Array:
    """Boxes in the unit square after a turn, shape (n, 4).

    Parameters
    ----------
    shares : ndarray of shape (n, 4)
    turn : tuple
        One of `TURNS`.

    Returns
    -------
    ndarray
    """
    out = shares.copy()
    for axis in (0, 1):
        if turn[axis]:
            out[:, [axis, axis + 2]] = 1.0 - out[:, [axis + 2, axis]]
    return out[:, [1, 0, 3, 2]] if turn[2] else out
