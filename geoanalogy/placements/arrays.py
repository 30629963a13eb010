"""Element arrays (section 5.6): an element fills a placement by being scaled or repeated, per axis, or by both."""

from collections.abc import Sequence
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..geometry.rectangle import Rectangle

Array = NDArray[np.float64]
Fit = Literal["scale", "repeat", "divide"]

#: Elements along one axis at most: a gap typed with a digit missing must not make millions.
MOST_REPEATED = 10_000


def repeated(extent: float, size: float, gap: float) -> Array:
    """Centres of elements repeated along an extent, measured from its middle.

    As many as fit with at least the gap between them, the first and the last flush with the ends of the extent; a
    single one stands in the middle.

    Parameters
    ----------
    extent, size, gap : float
        Of the placement, of an element, and between two elements at least; scene units.

    Returns
    -------
    ndarray of shape (n,), n >= 1

    Raises
    ------
    InputError
        Where more elements fit than anybody wants.

    Examples
    --------
    >>> repeated(10.0, 2.0, 1.0).tolist()
    [-4.0, 0.0, 4.0]
    """
    # Rounding must not cost the last of elements that fill the extent exactly.
    count = max(1, int(np.floor((extent + gap) / (size + gap) + 1e-9)))
    if count > MOST_REPEATED:
        raise InputError(
            f"{count} elements of size {size:g} fit into {extent:g}; give a larger element or a larger distance"
        )
    if count == 1:
        return np.zeros(1)
    return np.linspace(-(extent - size) / 2, (extent - size) / 2, count)


def element_array(
    placement: Rectangle,
    size: Sequence[float],
    fit: tuple[Fit, Fit] = ("scale", "scale"),
    gap: Sequence[float] = (0.0, 0.0),
) -> list[Rectangle]:
    """The elements that fill a placement.

    Parameters
    ----------
    placement : Rectangle
    size : sequence of two float
        Width and height of the element, scene units.
    fit : tuple of two of "scale", "repeat", "divide"
        Along the placement's width and along its height: stretched to fill it, repeated in its own size, or repeated as
        often as it fits best and stretched, so that with the gaps between them they fill the placement.
    gap : sequence of two float
        Least distance between repeated elements along either axis.

    Returns
    -------
    list of Rectangle
        Row by row from the least corner.

    Raises
    ------
    InputError
        For sizes that are not positive, gaps that are negative, or an unknown fit.
    """
    extent = (placement.width, placement.height)
    offsets, sizes = [], []
    for axis, name in enumerate(("width", "height")):
        if not (np.isfinite(size[axis]) and size[axis] > 0):
            raise InputError(f"the element has the {name} {size[axis]}; give a positive number")
        if not (np.isfinite(gap[axis]) and gap[axis] >= 0):
            raise InputError(f"the distance along the {name} is {gap[axis]}; give a number that is not negative")
        if fit[axis] == "scale":
            offsets.append(np.zeros(1))
            sizes.append(extent[axis])
        elif fit[axis] == "repeat":
            offsets.append(repeated(extent[axis], float(size[axis]), float(gap[axis])))
            sizes.append(float(size[axis]))
        elif fit[axis] == "divide":
            step = float(size[axis] + gap[axis])
            shared = max(1, round((extent[axis] + float(gap[axis])) / step)) * step - float(gap[axis])
            offsets.append(repeated(shared, float(size[axis]), float(gap[axis])) * (extent[axis] / shared))
            sizes.append(float(size[axis]) * (extent[axis] / shared))
        else:
            raise InputError(f"the fit along the {name} is {fit[axis]!r}; choose 'scale', 'repeat' or 'divide'")
    c, s = np.cos(placement.angle), np.sin(placement.angle)
    return [
        Rectangle(placement.x + c * u - s * v, placement.y + s * u + c * v, sizes[0], sizes[1], placement.angle)
        for v in offsets[1]
        for u in offsets[0]
    ]
