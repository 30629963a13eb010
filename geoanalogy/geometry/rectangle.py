"""Rectangles: the bounding boxes that placements are made of (section 5.2)."""

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from ..arguments import real, shown
from ..errors import InputError
from ..tolerances import LARGEST_COORDINATE


@dataclass(frozen=True)
class Rectangle:
    """A rectangle with a direction.

    Attributes
    ----------
    x, y : float
        Its centre in scene coordinates.
    width, height : float
        Its extent along its direction and across, scene units, positive.
    angle : float
        Its direction in radians, counter-clockwise from the scene's x axis.

    Raises
    ------
    InputError
        For values that are not finite, huge coordinates, or sides that are not positive.

    Examples
    --------
    >>> Rectangle(2, 1, 4, 2).ring.tolist()
    [[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [0.0, 2.0]]
    """

    x: float
    y: float
    width: float
    height: float
    angle: float = 0.0

    def __post_init__(self) -> None:
        for name in (f.name for f in fields(self)):
            value = real(given := getattr(self, name))
            if not np.isfinite(value):
                raise InputError(f"the {name} of a rectangle is {shown(given)}, which is not finite; give five numbers")
            object.__setattr__(self, name, value)
        if max(abs(self.x), abs(self.y)) > LARGEST_COORDINATE:
            raise InputError(
                f"{self!r} lies more than {LARGEST_COORDINATE:g} units from the origin; move the scene near the origin"
            )
        if self.width <= 0 or self.height <= 0:
            raise InputError(f"{self!r} has no area; give a positive width and height")

    @property
    def area(self) -> float:
        """Area in squared scene units."""
        return self.width * self.height

    @property
    def ring(self) -> NDArray[np.float64]:
        """Its corners counter-clockwise, from the least one in its own directions; shape (4, 2)."""
        along = np.array([np.cos(self.angle), np.sin(self.angle)])
        across = np.array([-along[1], along[0]])
        sides = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) / 2
        return (self.x, self.y) + sides[:, :1] * self.width * along + sides[:, 1:] * self.height * across

    def box(self, frame: float) -> tuple[NDArray[np.float64], int]:
        """The rectangle in a frame that it is parallel to, up to a small turn that is left out.

        Parameters
        ----------
        frame : float
            Direction in radians of the frame's x axis.

        Returns
        -------
        box : ndarray of shape (4,)
            Least and greatest coordinates in the frame: (x0, y0, x1, y1).
        quarter : int
            Quarter turns from the frame's x axis to the rectangle's direction, 0 to 3.
        """
        quarter = round((self.angle - frame) / (np.pi / 2)) % 4
        c, s = np.cos(frame), np.sin(frame)
        centre = np.array([c * self.x + s * self.y, -s * self.x + c * self.y])
        half = np.array([self.width, self.height] if quarter % 2 == 0 else [self.height, self.width]) / 2
        return np.concatenate([centre - half, centre + half]), quarter

    @classmethod
    def from_box(cls, box: NDArray[np.float64], frame: float, quarter: int = 0) -> "Rectangle":
        """The rectangle of a box in a frame: the inverse of `box`.

        Parameters
        ----------
        box : ndarray of shape (4,)
            (x0, y0, x1, y1) in the frame.
        frame : float
            Direction in radians of the frame's x axis.
        quarter : int
            Quarter turns from the frame's x axis to the rectangle's direction.

        Returns
        -------
        Rectangle
            Its angle lies in (-pi, pi].
        """
        c, s = np.cos(frame), np.sin(frame)
        u, v = (box[:2] + box[2:]) / 2
        size = box[2:] - box[:2]
        width, height = size if quarter % 2 == 0 else size[::-1]
        angle = np.pi - (np.pi - (frame + quarter * np.pi / 2)) % (2 * np.pi)
        return cls(float(c * u - s * v), float(s * u + c * v), float(width), float(height), float(angle))
