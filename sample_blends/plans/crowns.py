"""Two crowns (figure 4.12), unrolled by a cylindrical mapping, and the mapping back.

In the plan, x runs once around a crown along its base and y up its wall; both are true lengths in metres at the base.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .outlines import PlanPolygon


@dataclass(frozen=True)
class Crown:
    """One crown.

    Attributes
    ----------
    id : str
    origin : tuple of float
        Position of the unrolled outline's lower left corner in the plan.
    radius : float
        At the base, metres.
    flare : float
        By how much the radius grows, as a share, up to :attr:`height`.
    height : float
        Of the highest peak.
    periods : int
        How often the rim's pattern repeats.
    pattern : ndarray (n, 2)
        Rim of one period from left to right: place in the period (0 to 1, 1 left out), height.
    """

    id: str
    origin: tuple[float, float]
    radius: float
    flare: float
    height: float
    periods: int
    pattern: np.ndarray

    @property
    def length(self) -> float:
        """Circumference of the base, the width of the unrolled outline."""
        return 2 * np.pi * self.radius

    def rim(self) -> np.ndarray:
        """The rim (n, 2) from left to right in the crown's own coordinates, both ends included."""
        places = (np.arange(self.periods)[:, None] + self.pattern[:, 0]).ravel()
        heights = np.append(np.tile(self.pattern[:, 1], self.periods), self.pattern[0, 1])
        return np.column_stack((np.append(places, self.periods) / self.periods * self.length, heights))

    def outline(self) -> np.ndarray:
        """The unrolled outline in the plan."""
        return np.vstack(((0.0, 0.0), (self.length, 0.0), self.rim()[::-1])) + self.origin

    def radius_at(self, y: np.ndarray | float) -> np.ndarray:
        """Radius of the wall at a height y above the base."""
        return self.radius * (1 + self.flare * (np.asarray(y, dtype=float) / self.height) ** 2)

    def rolled(self, points: np.ndarray, height: np.ndarray | float = 0.0) -> np.ndarray:
        """Plan points (n, 2) and heights above the surface as points (n, 3) about the upright crown."""
        x, y = (np.asarray(points, dtype=float) - self.origin).T
        angle = x / self.radius
        slope = self.radius * self.flare * 2 * y / self.height**2
        lean = np.hypot(1.0, slope)
        reach = self.radius_at(y) + np.asarray(height) / lean
        return np.column_stack((reach * np.cos(angle), reach * np.sin(angle), y - np.asarray(height) * slope / lean))

    def frame(self, x: float, y: float, direction: float, height: float = 0.0) -> np.ndarray:
        """Placement (4, 4) on the crown of a thing that lies at (x, y) in the plan and points along ``direction``.

        Columns: the thing's +X (``direction``, radians, on the surface), its +Y, the surface normal, its position.
        """
        along_x, along_y = x - self.origin[0], y - self.origin[1]
        angle = along_x / self.radius
        slope = self.radius * self.flare * 2 * along_y / self.height**2
        around = np.array((-np.sin(angle), np.cos(angle), 0.0))
        up = np.array((slope * np.cos(angle), slope * np.sin(angle), 1.0)) / np.hypot(1.0, slope)
        placed = np.eye(4)
        placed[:3, 0] = np.cos(direction) * around + np.sin(direction) * up
        placed[:3, 1] = -np.sin(direction) * around + np.cos(direction) * up
        placed[:3, 2] = np.cross(around, up)
        placed[:3, 3] = self.rolled(np.array([(x, y)]), height)[0]
        return placed


def _period(half: np.ndarray, seam: float) -> np.ndarray:
    """A whole period of its right half: distances from the peak and heights, the last one half a period away.

    The period begins ``seam`` metres to the right of the peak, where neither a peak nor a hollow's middle is cut.
    """
    away, height = half.T
    breadth = 2 * away[-1]
    # Half a period away, left and right are the same place: it is kept once.
    place = np.concatenate((-away[-2:0:-1], away)) / breadth - seam / breadth
    height = np.concatenate((height[-2:0:-1], height))
    start = np.interp(0.0, place, height)
    order = np.argsort(place % 1.0)
    inner = np.column_stack((place % 1.0, height))[order]
    return np.vstack(((0.0, start), inner[inner[:, 0] > 1e-9]))


def _leaves() -> np.ndarray:
    """Peaks like lily leaves with pointed tips, round hollows between."""
    turn = np.linspace(0.0, np.pi / 2, 9)
    across = 0.0172 * np.sin(turn) ** 0.9
    leaf = np.column_stack((across, 0.082 + 0.028 * np.cos(turn) ** 0.9 + 0.012 * np.exp(-across / 0.005)))
    turn = np.linspace(0.0, np.pi / 2, 10)[1:]
    hollow = np.column_stack((0.0565 - 0.0393 * np.cos(turn), 0.0825 - 0.0225 * np.sin(turn)))
    return _period(np.vstack((leaf, hollow)), seam=0.028)


def _arches() -> np.ndarray:
    """Tall pointed arches on upright sides, and between each two a low round one."""
    turn = np.linspace(0.0, 1.0, 9)
    # A pointed arch is two arcs, each about a place beyond the other side.
    radius, half, foot = 0.0465, 0.0190, 0.074
    start = np.arccos((radius - half) / radius)
    angle = start * (1 - turn)
    tall = np.column_stack((radius * np.cos(angle) - (radius - half), foot + radius * np.sin(angle)))
    tall = np.vstack((tall, (half, 0.062)))
    turn = np.linspace(0.0, np.pi / 2, 7)
    low = np.column_stack((0.0429 - 0.0125 * np.cos(turn), 0.062 + 0.0145 * np.sin(turn)))
    return _period(np.vstack((tall, low)), seam=0.0246)


CROWNS = (
    Crown("royal crown", (0.0, 0.0), 0.090, 0.16, 0.122, 5, _leaves()),
    Crown("ducal crown", (0.0, 0.17), 0.082, 0.10, float(_arches()[:, 1].max()), 6, _arches()),
)


def crown(id: str) -> Crown:
    """The crown of an id."""
    return next(c for c in CROWNS if c.id == id)


def plan() -> list[PlanPolygon]:
    """The unrolled outlines."""
    return [PlanPolygon("crown", c.id, c.outline()) for c in CROWNS]
