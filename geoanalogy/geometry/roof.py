"""Roofs over outlines: hip, gable and mansard, by the straight skeleton (section 5.6)."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from .skeleton import Skeleton, straight_skeleton

Array = NDArray[np.float64]
RoofKind = Literal["flat", "hip", "gable", "mansard"]


@dataclass(frozen=True)
class Roof:
    """What a roof looks like.

    Attributes
    ----------
    kind : str
        "flat", "hip", "gable" or "mansard".
    pitch : float
        Angle of the roof's faces in radians; of a mansard, of the upper ones.
    lower_pitch : float
        Angle of the lower faces of a mansard in radians.
    break_height : float
        Height of a mansard's lower faces, scene units.
    rise : float or None
        Height at which it is cut off flat, scene units; None: where it closes.
    overhang : float
        How far the eaves stand out, scene units.

    Raises
    ------
    InputError
        For angles and lengths that no roof has.
    """

    kind: RoofKind = "flat"
    pitch: float = np.pi / 6
    lower_pitch: float = np.radians(70.0)
    break_height: float = 2.0
    rise: float | None = None
    overhang: float = 0.0

    def __post_init__(self) -> None:
        for name, angle in (("pitch", self.pitch), ("lower pitch", self.lower_pitch)):
            if not 0.0 < angle < np.pi / 2:
                raise InputError(f"the roof's {name} is {angle:g} radians; give an angle between 0 and a quarter turn")
        for name, length in (("break height", self.break_height), ("rise", 1.0 if self.rise is None else self.rise)):
            if not length > 0.0:
                raise InputError(f"the roof's {name} is {length:g}; give a positive length")
        if not self.overhang >= 0.0:
            raise InputError(f"the roof's overhang is {self.overhang:g}; give 0 or a positive length")

    @property
    def turn(self) -> float:
        """How far the lower edge of a mansard's upper faces is from the eaves, in plan; 0 for other roofs."""
        return self.break_height / np.tan(self.lower_pitch) if self.kind == "mansard" else 0.0

    def heights(self, times: Array) -> Array:
        """Heights above the eaves of points that are so far from them in plan.

        Parameters
        ----------
        times : ndarray of shape (n,)

        Returns
        -------
        ndarray of shape (n,)
        """
        low = np.minimum(times, self.turn) * np.tan(self.lower_pitch)
        return low + np.maximum(times - self.turn, 0.0) * np.tan(self.pitch)

    @property
    def stop(self) -> float:
        """How far from the eaves, in plan, it is cut off flat."""
        if self.rise is None:
            return np.inf
        lower = self.turn * np.tan(self.lower_pitch)
        if self.rise <= lower:
            return self.rise / np.tan(self.lower_pitch)
        return self.turn + (self.rise - lower) / np.tan(self.pitch)

    def over(self, rings: Sequence[Array]) -> tuple[Skeleton, NDArray[np.bool_]]:
        """The plan of the roof over an outline.

        Parameters
        ----------
        rings : sequence of ndarray of shape (n, 2)
            Outline counter-clockwise, holes clockwise.

        Returns
        -------
        skeleton : Skeleton
        gables : ndarray of bool
            Whether a gable stands on each edge. Where gables would not close, there are none: the roof is a hip roof.
        """
        count = sum(len(ring) for ring in rings)
        marks = [self.turn] if self.kind == "mansard" and self.turn < self.stop else []
        if self.kind == "gable":
            gables = gable_edges(rings)
            try:
                return straight_skeleton(rings, (~gables).astype(float), self.stop), gables
            except InputError:
                pass  # parallel walls of one height meet where a hip in between was: the hip roof always closes
        return straight_skeleton(rings, None, self.stop, marks), np.zeros(count, dtype=bool)


def gable_edges(rings: Sequence[Array]) -> NDArray[np.bool_]:
    """The narrow ends of an outline: edges between two right-angled corners that are shorter than a neighbour.

    Parameters
    ----------
    rings : sequence of ndarray of shape (n, 2)
        Outline counter-clockwise, holes clockwise.

    Returns
    -------
    ndarray of bool
        Per edge, ring by ring. Of neighbours of equal length, every other one.
    """
    found = []
    for ring in rings:
        edges = np.roll(ring, -1, axis=0) - ring
        length = np.hypot(*edges.T)
        before = np.roll(edges, 1, axis=0)
        turn = np.arctan2(before[:, 0] * edges[:, 1] - before[:, 1] * edges[:, 0], (before * edges).sum(axis=1))
        convex = np.abs(turn - np.pi / 2) < np.radians(30.0)  # at the vertex where the edge begins
        ends = convex & np.roll(convex, -1)
        taken = np.zeros(len(ring), dtype=bool)
        for i in np.argsort(np.round(length, 6), kind="stable"):
            neighbours = [(i - 1) % len(ring), (i + 1) % len(ring)]
            shorter = length[i] <= length[neighbours].max() * (1 + 1e-6)
            taken[i] = ends[i] and shorter and not taken[neighbours].any()
        found.append(taken)
    return np.concatenate(found)
