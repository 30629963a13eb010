"""Lots as plain numbers: those that the skyscrapers are recorded on, and those that they are then built on."""

from __future__ import annotations

import geoanalogy as ga

LOT = "lot"

#: Width and depth of the lots that are recorded, and of those that are built on.
RECORDED = ((30, 34), (38, 30), (34, 40), (44, 36), (28, 30), (36, 44), (48, 40), (32, 36), (40, 46))
BUILT = (
    (33, 31),
    (42, 38),
    (29, 36),
    (46, 33),
    (37, 37),
    (31, 42),
    (50, 44),
    (35, 32),
    (40, 41),
    (45, 47),
    (28, 33),
    (39, 35),
)

#: Lots in a row, and how far they are apart along and across the streets.
ROW, ALONG, ACROSS = 4, 16.0, 24.0


def _in_rows(sizes: tuple[tuple[float, float], ...], name: str) -> ga.Scene:
    """Lots side by side, the first row at the back, their fronts towards -y."""
    lots, y = [], 0.0
    for start in range(0, len(sizes), ROW):
        row = sizes[start : start + ROW]
        y -= max(depth for _, depth in row) + ACROSS
        x = 0.0
        for i, (width, depth) in enumerate(row):
            ring = [(x, y), (x + width, y), (x + width, y + depth), (x, y + depth)]
            edges = ("street", "side", "rear", "side")
            lots.append(ga.Polygon(ring, LOT, f"{name} {start + i + 1:02d}", orientation=0.0, segment_labels=edges))
            x += width + ALONG
    return ga.Scene(lots)


def recorded() -> ga.Scene:
    """The nine lots that the skyscrapers are recorded on."""
    return _in_rows(RECORDED, "example")


def built() -> ga.Scene:
    """Twelve other lots."""
    return _in_rows(BUILT, "lot")
