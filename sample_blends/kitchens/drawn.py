"""What a user draws in kitchens, and the operations that follow in a row."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import combinations
from typing import Any

import numpy as np
import shapely

import geoanalogy as ga
from geoanalogy.operations.pose_placement import PosePlacement

from ..houses.recorder import Box, Draw, Recorder, Sheet
from ..library import ASSETS
from ..library.fittings import FITTINGS

#: A place between two ends.
Along = Callable[[float, float], float]


def centre(x0: float, x1: float) -> float:
    return (x0 + x1) / 2


def after(distance: float) -> Along:
    return lambda x0, x1: x0 + distance


def ahead_of(distance: float) -> Along:
    return lambda x0, x1: x1 - distance


def free(s: Sheet, height: float) -> tuple[float, float]:
    """Left and right end of what is free of a wall at a height: of its longest part there."""
    x0, y0, x1, _ = s.edges
    level = shapely.LineString([(x0 - 1.0, y0 + height), (x1 + 1.0, y0 + height)])
    parts = shapely.get_parts(shapely.intersection(level, s.polygon.shape))
    longest = max(parts, key=lambda part: part.length)
    return float(longest.bounds[0]), float(longest.bounds[2])


def filling(out: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)) -> Draw:
    """All of the sheet, so much wider at the left, below, at the right and above."""

    def draw(s: Sheet) -> Sequence[Box]:
        x0, y0, x1, y1 = s.edges
        return [(x0 - out[0], y0 - out[1], x1 + out[2], y1 + out[3])]

    return draw


def gap(labels: Sequence[str], number: int, least: float = 0.25) -> Draw:
    """What the elements of some labels leave free of the sheet's width, as high as they are: one of the parts, counted
    from the left.
    """

    def draw(s: Sheet) -> Sequence[Box]:
        x0, _, x1, _ = s.edges
        taken = sorted(box for label in labels for box in s.boxes(label))
        ends = [x0, *(x for a0, _, a1, _ in taken for x in (a0, a1)), x1]
        a, b = ends[2 * number : 2 * number + 2]
        return [(a, taken[0][1], b, taken[0][3])] if b - a > least else []

    return draw


def roomiest(s: Sheet) -> Box:
    """The largest upright rectangle between corners of the sheet's outline that lies in it."""
    ring = s.polygon.points
    xs, ys = (np.unique(np.round(ring[:, k], 6)) for k in (0, 1))
    inside = s.polygon.shape.buffer(1e-6)
    boxes = [(a, b, c, d) for a, c in combinations(xs, 2) for b, d in combinations(ys, 2)]
    held = [box for box in boxes if inside.contains(shapely.box(*box))]
    return max(held, key=lambda box: (box[2] - box[0]) * (box[3] - box[1]))


class KitchenRecorder(Recorder):
    """A recorder that takes fittings and furniture from the library."""

    def fit(self, name: str, on: str, draw: Draw, examples: int = 4, **settings: Any) -> str:
        """Put a fitting where examples of it are drawn: stretched, unless the settings say otherwise."""
        made = FITTINGS[name]
        settings = {"max_per": {on: 1}, **settings}
        return self.place(made.label, on, draw, examples, mesh=name, size=made.size, **settings)

    def pose(self, name: str, on: str, place: tuple[int, ga.Pose], most: int, threshold: float, **options: Any) -> str:
        """Put one piece of furniture on a sheet, by its number, and more where they stand in the same relations."""
        number, pose = place
        sheet = list(self.sheets(on))[number]
        made = ASSETS[name]
        model = ga.learn_pose(sheet.scene, pose, made.footprint, ga.PoseOptions(**options))
        operation = PosePlacement(
            mesh=name, label=made.label, model=model, threshold=threshold, max_per={model.parent.label: most}
        )
        return self.record(f"pose {made.label}", operation)
