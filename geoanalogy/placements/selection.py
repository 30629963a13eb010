"""Filters on ranked candidates (section 5.5)."""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .boxes import overlap, union_overlap

Array = NDArray[np.float64]
Boxes = NDArray[Any]


def thin(boxes: Array, strength: Array, limit: float, most: int) -> NDArray[np.intp]:
    """Non-maximum suppression: the strongest boxes, none of which nearly repeats a stronger one.

    Parameters
    ----------
    boxes : ndarray of shape (n, 4)
    strength : ndarray of shape (n,)
    limit : float
        Shared area over united area from which two boxes are the same.
    most : int
        How many to keep.

    Returns
    -------
    ndarray of int
        Indices, strongest first.
    """
    order = np.argsort(-strength, kind="stable")[: MOST_COMPARED * most]
    # Far from the origin, single precision would not tell the boxes apart.
    ranked = (boxes[order] - np.tile(boxes[:, :2].min(axis=0, initial=np.inf), 2)).astype(np.float32)
    return order[_strongest(ranked, lambda a, b: union_overlap(a, b) >= limit)[:most]]


def _strongest(ranked: Boxes, repeats: Callable[[Boxes, Boxes], NDArray[np.bool_]]) -> list[int]:
    """Of boxes, strongest first, those that do not repeat a stronger one that is kept."""
    kept: list[int] = []
    free = np.ones(len(ranked), dtype=bool)
    for start in range(0, len(ranked), AT_ONCE):
        # What repeats a stronger box of those before need not be compared with the weaker ones.
        some = start + np.flatnonzero(free[start : start + AT_ONCE])
        for i, same in zip(some.tolist(), repeats(ranked[some], ranked[start:]), strict=True):
            if free[i]:
                kept.append(i)
                free[start:] &= ~same
    return kept


#: Boxes that are compared with each other for every one that is kept.
MOST_COMPARED = 4
#: Boxes that are compared with all weaker ones at once.
AT_ONCE = 64


def without_overlaps(boxes: Array, score: Array, taken: Array, allowed: float) -> NDArray[np.intp]:
    """The best boxes that overlap neither what is taken nor each other: the lowest scores are removed first.

    Parameters
    ----------
    boxes : ndarray of shape (n, 4)
    score : ndarray of shape (n,)
    taken : ndarray of shape (m, 4)
    allowed : float
        Share of the smaller box that two may share.

    Returns
    -------
    ndarray of int
        Indices, best first.
    """
    free = (overlap(boxes, taken) <= allowed).all(axis=1) if len(taken) else np.ones(len(boxes), dtype=bool)
    order = np.argsort(-score, kind="stable")
    order = order[free[order]]
    return order[_strongest(boxes[order], lambda a, b: ~(overlap(a, b) <= allowed))]


def shape_factor(sizes: Array, taught: Array, aspect_tolerance: float, area_tolerance: float) -> Array:
    """The penalty on deformed boxes (eq. 5.9).

    The thesis compares with the average example. Where examples differ on purpose (a narrow and a wide balcony), both
    of their shapes are right and the average need not be; the example most alike counts.

    Parameters
    ----------
    sizes : ndarray of shape (n, 2)
        Widths and heights.
    taught : ndarray of shape (m, 2)
        Those of the examples.
    aspect_tolerance, area_tolerance : float
        Widths of the Gaussians of the logarithms of the changes.

    Returns
    -------
    ndarray of shape (n,)
        Between 0 and 1.
    """
    change = np.log(sizes)[:, None] - np.log(taught)[None]
    aspect = (change[..., 0] - change[..., 1]) / aspect_tolerance
    area = change.sum(axis=2) / area_tolerance
    return np.exp(-0.5 * (aspect**2 + area**2).min(axis=1))


#: Least and greatest certainty at which a candidate is kept by default.
CUTS = (0.1, 0.45)
#: The least one where exactly one placement per parent was taught.
CUT_OF_ONE = 0.02
#: The one where nothing is worth showing: of candidates, none or so few that are likelier than not.
LIKELIER_THAN_NOT = 0.5


def useful_cut(certainty: Array, one: bool, perhaps_none: bool) -> float:
    """The certainty from which results are of more use than harm.

    Whoever checks results weighs wrong ones against missed ones. The balanced measure of both, the harmonic mean of
    precision and recall, is largest in expectation when everything is kept whose certainty is above half of that
    largest value: where an arrangement is clear, doubtful candidates are left out; where all is doubtful, the better
    ones are worth showing. Where it may be that nothing is meant, showing nothing is right as often as all candidates
    are wrong; where that is likelier than the largest value is large, none is worth showing.

    Parameters
    ----------
    certainty : ndarray of shape (n,)
        Of candidates that do not overlap.
    one : bool
        Whether there is one placement for certain: every example was the only one in its parent.
    perhaps_none : bool
        Whether there may be none: examples were drawn here, and may be all that is meant.

    Returns
    -------
    float
    """
    falling = np.sort(certainty)[::-1]
    whole = max(float(falling.sum()), 1.0)
    expected = 2 * np.cumsum(falling) / (np.arange(1, len(falling) + 1) + whole)
    least = CUT_OF_ONE if one else CUTS[0]
    if one:
        # One is sure to be right: the best candidate is always worth showing.
        return float(np.clip(min(expected.max(initial=0.0) / 2, falling.max(initial=0.0)), least, CUTS[1]))
    if perhaps_none and np.prod(1.0 - falling) > expected.max(initial=0.0):
        return LIKELIER_THAN_NOT
    return float(np.clip(expected.max(initial=0.0) / 2, least, CUTS[1]))


def rescaled(certainty: Array, cut: float) -> Array:
    """Certainty as a score that is 0.5 at the cut: odds in multiples of the cut's.

    Parameters
    ----------
    certainty : ndarray
    cut : float
        Between 0 and 1, exclusive.

    Returns
    -------
    ndarray
    """
    return certainty * (1 - cut) / (certainty * (1 - cut) + cut * (1 - certainty))
