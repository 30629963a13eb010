"""Leaving out the pairs of features that cannot matter: what is compared for poses grows smaller as they settle."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..relations.elements import ElementType
from ..relations.observation import length
from .kernels import WIDE_WIDTH
from .part import Part
from .rows import Rows

Array = NDArray[np.float64]


def strongest(rows: Rows, share: float) -> Part:
    """What rows stand for, without the pairs of features that contribute little.

    Parameters
    ----------
    rows : Rows
    share : float
        Of the pose's strongest pair, below which a pair is left out.

    Returns
    -------
    Part
    """
    possible = rows.of_pairs(np.ones_like(rows.weight))
    pose = rows.pose[rows.pair_start]
    greatest = np.zeros(rows.poses)
    np.maximum.at(greatest, pose, possible)
    return _among(rows, possible >= share * greatest[pose])


def near(rows: Rows, position: Array, angle: Array, reach: float, turn: float) -> Part:
    """What poses can meet without going far: an importance a pose, of elements of its own.

    Parameters
    ----------
    rows : Rows
    position : ndarray of shape (m, 2)
    angle : ndarray of shape (m,)
    reach : float
        How far they may move, in half-widths of level sets.
    turn : float
        How far they may turn, radians.

    Returns
    -------
    Part
        Without the pairs of features, and the edges of boundaries, that they do not come near to.
    """
    if not len(rows.entry):
        return _among(rows, np.zeros(0, dtype=bool))
    misses = rows.misses(position, angle)
    far = reach * rows.width + turn * length(*rows.asked[0])
    met = (np.abs(misses.place) < WIDE_WIDTH * rows.width + far).any(axis=0)
    if misses.turn is not None and rows.elements.heading(rows.element) is not None:  # the same everywhere
        met &= (np.abs(misses.turn) < rows.tolerance + turn).any(axis=0)
    kept = np.logical_or.reduceat(met, rows.pair_start)
    edges = misses.seen.reachable_edges(far) if rows.element is ElementType.POLYGON else None
    elements = rows.elements.take(rows.element, np.flatnonzero(np.repeat(kept, rows.per_pair)), edges)
    part = _among(rows, kept)
    return replace(part, elements=elements, target=np.arange(len(part.target)), has_own_elements=True)


def _among(rows: Rows, kept: NDArray[np.bool_]) -> Part:
    """What rows stand for, pose by pose, with some of the pairs of features."""
    entry = np.repeat(kept, rows.per_pair)
    answering = np.add.reduceat(kept.astype(np.intp), rows.feature_start) if len(kept) else np.zeros(0, np.intp)
    pairs = rows.pose[rows.pair_start[kept]]
    features = rows.pose[rows.pair_start[rows.feature_start[answering > 0]]]
    counts = [np.bincount(p, minlength=rows.poses) for p in (rows.pose[entry], pairs, features)]
    return rows.part.only(rows.entry[entry], rows.accuracy[kept], rows.per_pair[kept], answering[answering > 0], counts)
