"""Accumulated level sets as pictures: the importance of every place in the rooms that can match (figure 4.6)."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import geoanalogy as ga
from geoanalogy.poses.arrangement import arrangement_of
from geoanalogy.poses.batch import importance_at
from geoanalogy.poses.candidates import accumulate_in_plane
from geoanalogy.poses.directions import directions
from geoanalogy.poses.importance import Importance

Array = NDArray[np.float64]

#: Places evaluated at once: bounds the memory.
BLOCK = 2000


@dataclass(frozen=True)
class HeatMap:
    """The importance over a room.

    Attributes
    ----------
    outline : ndarray of shape (n, 2)
        Of the room.
    extent : tuple of float
        x0, x1, y0, y1 of the outer edges of the cells.
    values : ndarray of shape (rows, columns)
        The lowest row first; NaN away from the room.
    """

    outline: Array
    extent: tuple[float, float, float, float]
    values: Array


def heat_maps(model: ga.PoseModel, scene: ga.Scene, points: int = 5000) -> list[HeatMap]:
    """The accumulated level sets of a model in every room that can match.

    Parameters
    ----------
    model : PoseModel
    scene : Scene
    points : int
        Grid points in a room of average size.

    Returns
    -------
    list of HeatMap
        At each place the best of all directions, senses and scales.
    """
    rooms = model.targets(scene)
    spacing = float(np.sqrt(np.mean([r.area for r in rooms]) / points))
    maps = []
    for room in rooms:
        target = arrangement_of(scene, room)
        fields = target.fields(spacing, 2 * spacing)
        # And a little around, so that a picture can be cut off at the walls.
        grid, free = fields.grid, np.flatnonzero(fields.covered(0) | (fields.parent_distance < 2 * spacing))
        sheet = np.full(len(grid), np.nan)
        sheet[free] = 0.0
        for importance in model.importances(target):
            fields.evaluate(importance.relations)
            if importance.query.rigid:
                values = _best_direction(importance, grid.points[free])
            else:
                values = accumulate_in_plane(importance, fields, free)[0]
            sheet[free] = np.maximum(sheet[free], values)
        low = grid.origin - spacing / 2
        high = low + spacing * np.array([grid.columns, grid.rows])
        extent = (float(low[0]), float(high[0]), float(low[1]), float(high[1]))
        maps.append(HeatMap(room.points, extent, sheet.reshape(grid.rows, grid.columns)))
    return maps


def _best_direction(importance: Importance, position: Array) -> Array:
    best = np.zeros(len(position))
    for direction in directions(importance):
        for start in range(0, len(position), BLOCK):
            part = slice(start, start + BLOCK)
            angle = np.full(len(position[part]), direction)
            best[part] = np.maximum(best[part], importance_at(importance, position[part], angle))
    return best
