"""A street of eight houses that bends: their facades, each in its own coordinates (x along it, y up)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .outlines import PlanPolygon, rectangle

# Heights in metres: the ground floor, every other floor, a frieze, the cornice.
GROUND_FLOOR, FLOOR, FRIEZE, CORNICE = 3.6, 3.2, 0.25, 0.6
DEPTH = 9.0


@dataclass(frozen=True)
class House:
    """One house.

    Attributes
    ----------
    id : str
    width : float
    floors : int
        Above the ground floor.
    finish : str
        Of its walls.
    roof : str
    turn : float
        Direction of its facade in degrees.
    back : float
        How far its facade stands behind its neighbour's on the left.
    """

    id: str
    width: float
    floors: int
    finish: str
    roof: str
    turn: float = 0.0
    back: float = 0.0

    @property
    def height(self) -> float:
        """Of the facade."""
        return GROUND_FLOOR + self.floors * FLOOR + FRIEZE + CORNICE


HOUSES = (
    House("house 1", 7.4, 2, "plaster ochre", "tile orange", 14.0),
    House("house 2", 13.4, 4, "plaster rose", "roof slate", 14.0, 0.3),
    House("house 3", 9.4, 3, "plaster sage", "tile orange", 0.0),
    House("house 4", 8.2, 3, "plaster cream", "tile brown", 0.0, -0.4),
    House("house 5", 11.8, 2, "plaster blue", "roof slate", 0.0, 0.4),
    House("house 6", 8.8, 4, "plaster brick", "tile brown", -16.0, 0.2),
    House("house 7", 10.8, 3, "plaster grey", "tile orange", -16.0, -0.3),
    House("house 8", 12.2, 2, "plaster ochre", "roof slate", -30.0),
)


def frames() -> dict[str, np.ndarray]:
    """By the house's id, the frame (4, 4) of its facade: x along it, y up, z towards the street."""
    placed = {}
    corner = np.zeros(2)
    for house in HOUSES:
        angle = np.radians(house.turn)
        along, out = np.array((np.cos(angle), np.sin(angle))), np.array((np.sin(angle), -np.cos(angle)))
        corner = corner - house.back * out
        frame = np.eye(4)
        frame[:2, 0], frame[:3, 1], frame[:2, 2], frame[:2, 3] = along, (0.0, 0.0, 1.0), out, corner
        frame[2, 2] = 0.0
        placed[house.id] = frame
        corner = corner + house.width * along
    return placed


def house(id: str) -> House:
    """The house of an id."""
    return next(h for h in HOUSES if h.id == id)


def plan(gap: float = 3.0) -> list[PlanPolygon]:
    """The facades side by side on one sheet."""
    found, x = [], 0.0
    for one in HOUSES:
        found.append(PlanPolygon("facade", one.id, rectangle(x, 0.0, x + one.width, one.height)))
        x += one.width + gap
    return found
