"""What stands free on the floor: a table with its chairs."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

import geoanalogy as ga

from ..houses.recorder import Box, Sheet
from ..library import ASSETS
from .drawn import KitchenRecorder, roomiest

TABLE, CHAIR = "dining table", "dining chair"


def table(s: Sheet) -> Sequence[Box]:
    """In the middle of what cabinets leave free, with room to walk round it; none in small kitchens."""
    x0, y0, x1, y1 = roomiest(s)
    width, depth = min(x1 - x0 - 1.5, 1.8), 0.8
    if width < 0.9 or y1 - y0 < depth + 1.5:
        return []
    x, y = (x0 + x1) / 2, (y0 + y1) / 2 + 0.16  # away from the door
    return [(x - width / 2, y - depth / 2, x + width / 2, y + depth / 2)]


def record(r: KitchenRecorder) -> None:
    """Record the furniture."""
    size = np.ptp(ASSETS[TABLE].footprint, axis=0)
    r.place("table", "floor", table, 6, mesh=TABLE, size=(float(size[0]), float(size[1])), max_per={"floor": 1})
    number, box = next((i, s.boxes("table")[0]) for i, s in enumerate(r.sheets("floor")) if s.boxes("table"))
    beside = ga.Pose((box[0] + 0.35, box[1] - 0.12), np.pi / 2)
    r.pose(CHAIR, "floor", (number, beside), 4, 0.3)
