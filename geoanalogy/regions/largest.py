"""The largest of a few rows, column by column: what dynamic programmes ask in every step."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..geometry.contours import Indices


def largest(values: NDArray[np.float32], value: NDArray[np.float32], which: NDArray[np.int8]) -> None:
    """The largest value along the first axis, and the first row that has it.

    Parameters
    ----------
    values : (k, ...) float32
        Not nan; at most 128 rows.
    value : (...) float32
        Is filled with the largest values.
    which : (...) int8
        Is filled with the rows.

    Notes
    -----
    `argmax` along any axis but the last looks at one value after the other; whole rows compared with their maximum are
    ten times faster.
    """
    np.maximum.reduce(values, axis=0, out=value)
    which[...] = 0
    before = np.ones(value.shape, bool)  # whether no row so far has the largest value
    for row in values[:-1]:
        before &= row != value
        which += before


def picked(values: NDArray[Any], which: NDArray[np.int8], column: Indices) -> NDArray[Any]:
    """The values of some rows, one for each column: `values[which[i], i]`.

    Parameters
    ----------
    values : (k, ...) array
        Contiguous.
    which : (...) int8
        Rows.
    column : (...) int
        Numbers of the columns: `arange`, shaped as `which`.

    Returns
    -------
    (...) array
    """
    return values.reshape(-1).take(which.astype(np.intp) * which.size + column)
