"""The adapted SL0 similarity: Gaussians of differences, and a one-to-one assignment of elements (sections 5.2, 5.3)."""

import itertools
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from ..relations.table import Kind
from .signature import outline_kinds

Array = NDArray[np.float64]

#: Width of the Gaussian of eq. 5.1 by kind of relation, for a kernel size of 1. Lengths are in shares of the examples'
#: size (see `length_widths`); ratios in shares of the element. Calibrated on facades, plots and rooms: half as wide
#: loses places that people draw by eye, twice as wide cannot tell a sill from the edge of its window.
SIGMA: dict[Kind, float] = {Kind.LENGTH: 0.1, Kind.RATIO: 0.1, Kind.ANGLE: 0.1}


def length_widths(sizes: Array, tau: float) -> Array:
    """Width of the Gaussians of lengths along x, along y, and in any direction.

    Section 5.7 makes it proportional to the diagonal of the box. Along an axis it is the mean of that and of the side
    along the axis: what is 60 wide and 6 high is placed more precisely in height than in width.

    Parameters
    ----------
    sizes : ndarray of shape (m, 2)
        Widths and heights of the examples.
    tau : float
        The kernel size of section 5.7.

    Returns
    -------
    ndarray of shape (3,)
        Scene units.
    """
    size = sizes.mean(axis=0)
    diagonal = np.hypot(*size)
    return tau * SIGMA[Kind.LENGTH] * np.array([*(diagonal + size) / 2, diagonal])


def box_agreement(a: Array, b: Array, widths: Array, tau: float) -> NDArray[Any]:
    """Gaussians of the differences in box coordinates between every two elements.

    Parameters
    ----------
    a : ndarray of shape (n, p, 2, 3, 4)
    b : ndarray of shape (m, q, 2, 3, 4)
    widths : ndarray of shape (3,)
        See `length_widths`.
    tau : float

    Returns
    -------
    ndarray of shape (n, m, p, q, 2, 3, 4), float32
        Between 0 and 1; 0 where either is a nil element.
    """
    return np.stack([axis_agreement(a[:, :, i], b[:, :, i], widths[i], tau) for i in (0, 1)], axis=4)


def axis_agreement(a: Array, b: Array, width: float, tau: float) -> NDArray[Any]:
    """`box_agreement` along one axis.

    Parameters
    ----------
    a : ndarray of shape (n, p, 3, 4)
    b : ndarray of shape (m, q, 3, 4)
    width : float
        Of the Gaussians of lengths along the axis, scene units.
    tau : float

    Returns
    -------
    ndarray of shape (n, m, p, q, 3, 4), float32
    """
    scale = np.array([width, width, width, tau * SIGMA[Kind.RATIO]], dtype=np.float32)
    x, y = _apart((a / scale).astype(np.float32), (b / scale).astype(np.float32))
    return _gaussian(x[:, None, :, None] - y[None, :, None])


def outline_agreement(key: str, a: Array, b: Array, widths: Array, tau: float) -> NDArray[Any]:
    """Gaussians of the differences in the relations of outlines between every two elements.

    Parameters
    ----------
    key : str
        The group, which says what its relations are.
    a : ndarray of shape (n, p, 5, r)
    b : ndarray of shape (m, q, 5, r)
    widths : ndarray of shape (3,)
    tau : float

    Returns
    -------
    ndarray of shape (n, m, p, q, 5, r), float32
    """
    kinds, periods = outline_kinds(key)
    scale = np.array([widths[2] if kind is Kind.LENGTH else tau * SIGMA[kind] for kind in kinds])
    x, y = _apart((a / scale).astype(np.float32), (b / scale).astype(np.float32))
    difference = x[:, None, :, None] - y[None, :, None]
    for i, period in enumerate(periods):
        if np.isfinite(period):
            off = np.abs(difference[..., i])
            difference[..., i] = np.minimum(off, np.abs(np.float32(period / scale[i]) - off))
    return _gaussian(difference)


#: A value in place of a nil element's: far from any other in units of the Gaussians, its square a finite float32.
NIL = 1e15


def _apart(a: NDArray[Any], b: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
    """Values in which nil elements are far from everything, other nil elements included."""
    return np.where(np.isnan(a), a.dtype.type(NIL), a), np.where(np.isnan(b), b.dtype.type(-NIL), b)


def _gaussian(difference: NDArray[Any]) -> NDArray[Any]:
    np.multiply(difference, difference, out=difference)
    difference *= np.float32(-0.5)
    np.exp(difference, out=difference)
    return difference


@cache
def _permutations(count: int) -> NDArray[np.intp]:
    return np.array(list(itertools.permutations(range(count))), dtype=np.intp)


#: Largest number of elements for which all assignments are tried at once: 24 of them, 9 times as fast as solving each.
MOST_TRIED = 4


def best_assignment(utility: Array) -> tuple[Array, NDArray[np.intp]]:
    """The one-to-one assignment of largest utility (eq. 5.4) of many square matrices.

    Rows whose best columns differ are an optimum at once; only where two rows want the same column is there a problem
    to solve.

    Parameters
    ----------
    utility : ndarray of shape (..., k, k)
        Not negative; rows and columns of nil elements are 0.

    Returns
    -------
    total : ndarray of shape (...)
    column : ndarray of shape (..., k), int
        The column of each row.
    """
    k = utility.shape[-1]
    if k == 1:
        return utility[..., 0, 0], np.zeros(utility.shape[:-1], dtype=np.intp)
    flat = utility.reshape(-1, k, k)
    rows = np.arange(k)
    if k <= MOST_TRIED:
        ways = _permutations(k)
        totals = flat[:, rows, ways].sum(axis=2)
        best = np.argmax(totals, axis=1)
        total, column = totals[np.arange(len(flat)), best], ways[best]
    else:
        column = np.argmax(flat, axis=2)
        ordered = np.sort(column, axis=1)
        for i in np.flatnonzero((ordered[:, 1:] == ordered[:, :-1]).any(axis=1)):
            column[i] = linear_sum_assignment(flat[i], maximize=True)[1]
        total = np.take_along_axis(flat, column[:, :, None], axis=2)[..., 0].sum(axis=1)
    return total.reshape(utility.shape[:-2]), column.reshape(utility.shape[:-1])
