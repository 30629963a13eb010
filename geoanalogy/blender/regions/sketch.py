"""A query while it is being drawn: points on the plane of the drawing under the mouse, and how they are shown."""

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..overlay import Shape
from ..reading.planes import Plane
from ..rectangle_drawing import sight_on
from .queries import QUERY_COLOUR, brushed

Array = NDArray[np.float64]


@dataclass
class QuerySketch:
    """A query that is being drawn: nothing of it is in the scene yet.

    Attributes
    ----------
    plane : Plane
        Of the drawing.
    mode : str
        "LASSO", "BRUSH" or "STROKE".
    strokes : list of list of ndarray of shape (3,)
        Points in the world; of the lasso and the stroke the last drag counts, the brush adds up.
    radius : float
        Of the brush, scene units.
    """

    plane: Plane
    mode: str
    strokes: list[list[Array]] = field(default_factory=list)
    radius: float = 0.0

    def sight(self, origin: ArrayLike, direction: ArrayLike) -> Array | None:
        """Where a line of sight meets the plane.

        Parameters
        ----------
        origin, direction : array_like of shape (3,)

        Returns
        -------
        ndarray of shape (3,) or None
            None where the plane is seen edge-on.
        """
        away = sight_on(self.plane, origin, direction)
        return None if away is None else np.asarray(origin, float) + away * np.asarray(direction, float)

    def press(self, point: Array) -> None:
        """Begin a drag.

        Parameters
        ----------
        point : ndarray of shape (3,)
        """
        if self.mode != "BRUSH":
            self.strokes.clear()
        self.strokes.append([point])

    def move(self, point: Array) -> None:
        """Go on with it.

        Parameters
        ----------
        point : ndarray of shape (3,)
        """
        if self.strokes and np.any(self.strokes[-1][-1] != point):
            self.strokes[-1].append(point)

    def take_back(self) -> None:
        """Drop the last drag."""
        if self.strokes:
            self.strokes.pop()

    def outlines(self) -> list[Array]:
        """What is shown of it.

        Returns
        -------
        list of ndarray of shape (n, 3)
        """
        if self.mode != "BRUSH":
            lines = [np.array(points) for points in self.strokes if len(points) > 1]
            return [np.vstack([line, line[:1]]) if self.mode == "LASSO" else line for line in lines]
        flat = [self.plane.to_plane(np.array(points))[:, :2] for points in self.strokes]
        if not flat or self.radius <= 0.0:
            return []
        rings = [np.vstack([ring, ring[:1]]) for ring in brushed(flat, self.radius)]
        return [self.plane.to_world(np.column_stack([ring, np.zeros(len(ring))])) for ring in rings]

    def shapes(self) -> Iterator[Shape]:
        """What is to be drawn of it.

        Yields
        ------
        Shape
        """
        for line in self.outlines():
            yield Shape(line.tolist(), QUERY_COLOUR)
