"""Neighbours in arrays: those of one owner stand side by side, told by where each begins or how many each has."""

import numpy as np
from numpy.typing import NDArray

Indices = NDArray[np.intp]


def first_of(size: Indices) -> Indices:
    """Where neighbours of given sizes begin.

    Parameters
    ----------
    size : ndarray of shape (n,), int

    Returns
    -------
    ndarray of shape (n,), int

    Examples
    --------
    >>> first_of(np.array([2, 0, 3])).tolist()
    [0, 2, 2]
    """
    first: Indices = size.cumsum()
    first -= size
    return first


def sizes(first: Indices, whole: int) -> Indices:
    """Sizes of neighbours that begin at given places.

    Parameters
    ----------
    first : ndarray of shape (n,), int
        Ascending.
    whole : int
        Where the last of them ends.

    Returns
    -------
    ndarray of shape (n,), int

    Examples
    --------
    >>> sizes(np.array([0, 2, 2]), 5).tolist()
    [2, 0, 3]
    """
    size: Indices = np.empty_like(first)
    np.subtract(first[1:], first[:-1], out=size[:-1])
    size[-1:] = whole - first[-1:]
    return size


def ranges(start: Indices, count: Indices) -> Indices:
    """Runs of whole numbers, one after another.

    Parameters
    ----------
    start, count : ndarray of shape (n,), int
        First number and length of each run.

    Returns
    -------
    ndarray of shape (sum of `count`,), int

    Examples
    --------
    >>> ranges(np.array([5, 0, 8]), np.array([2, 0, 3])).tolist()
    [5, 6, 8, 9, 10]
    """
    offset = start - first_of(count)
    runs: Indices = offset.repeat(count)
    runs += np.arange(len(runs))
    return runs


def run_starts(values: Indices) -> Indices:
    """Where runs of equal values begin.

    Parameters
    ----------
    values : ndarray of shape (n,), int

    Returns
    -------
    ndarray of int

    Examples
    --------
    >>> run_starts(np.array([4, 4, 1, 4])).tolist()
    [0, 2, 3]
    """
    changed = np.ones(len(values), dtype=bool)
    np.not_equal(values[1:], values[:-1], out=changed[1:])
    return changed.nonzero()[0]
