"""The kernels that level sets fall off with (section 4.5), and differences of angles."""

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

#: The level sets' kernel is a narrow linear fall-off on a wide, low one: rooms of another size meet the example's
#: relations only nearly, and among places that miss them the nearer miss should win. Share of the wide part, and its
#: width in narrow ones.
WIDE_SHARE = 0.3
WIDE_WIDTH = 5.0

Real = TypeVar("Real", np.float32, np.float64)


def level_set(away: NDArray[Real]) -> NDArray[Real]:
    """The kernel k of section 4.5: 1 on a level set, falling off with the distance from it in the plane.

    Parameters
    ----------
    away : ndarray
        Distance in half-widths, not negative.

    Returns
    -------
    ndarray
        Of the same type.
    """
    kernel = away * away.dtype.type(-(1 - WIDE_SHARE + WIDE_SHARE / WIDE_WIDTH))
    kernel += away.dtype.type(1)
    # Where only the wide part is left.
    wide = away * away.dtype.type(-WIDE_SHARE / WIDE_WIDTH)
    wide += away.dtype.type(WIDE_SHARE)
    np.maximum(kernel, wide, out=kernel)
    return np.maximum(kernel, 0, out=kernel)  # type: ignore[no-any-return]


def wrap(difference: NDArray[Real], period: NDArray[Real] | float = 2 * np.pi) -> NDArray[Real]:
    """A cyclic difference in the interval around zero: at most half a period in size.

    Parameters
    ----------
    difference : ndarray
    period : ndarray or float

    Returns
    -------
    ndarray
    """
    # Several times as fast as the remainder.
    turns = difference / period
    np.rint(turns, out=turns)
    turns *= period
    np.subtract(difference, turns, out=turns)
    return np.asarray(turns, dtype=difference.dtype)
