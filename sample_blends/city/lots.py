"""Lots: rectangles on streets that a type of house fits on, in real plots and along generated streets."""

from __future__ import annotations

import zlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

from ..houses.plots import EDGES

#: Cell of the grid on which the largest rectangle of a plot is looked for, metres.
CELL = 0.5

#: How far behind the foremost point of a plot its lot may begin, metres.
FURTHEST = 10.0

#: Deepest lot, metres.
DEEPEST = 33.0

#: Least width and depth of the lot of each type, and the greatest width; the widest types first.
TYPES = (
    ("condominium", 25.0, 26.0, 41.0),
    ("two-storey", 14.0, 20.0, 25.0),
    ("one-storey", 15.0, 18.5, 26.0),
)


@dataclass(frozen=True)
class Lot:
    """A rectangle whose front is on a street.

    Attributes
    ----------
    corner : (float, float)
        Its left front corner, seen from the street.
    angle : float
        Direction of the front, radians.
    width, depth : float
    type : str
        Of the house.
    """

    corner: tuple[float, float]
    angle: float
    width: float
    depth: float
    type: str

    @property
    def ring(self) -> np.ndarray:
        """Its corners, counter-clockwise from the left front one."""
        c, s = np.cos(self.angle), np.sin(self.angle)
        flat = np.array([(0, 0), (self.width, 0), (self.width, self.depth), (0, self.depth)])
        return flat @ np.array([[c, s], [-s, c]]) + self.corner

    @property
    def shape(self) -> shapely.Polygon:
        """Its area."""
        return shapely.Polygon(self.ring)

    @property
    def front(self) -> shapely.LineString:
        """Its edge on the street."""
        return shapely.LineString(self.ring[:2])

    @property
    def ways(self) -> tuple[tuple[str, float, float], ...]:
        """The walks and drives of its house: their kind, and from where to where they are on the front."""
        if self.type == "condominium":
            middle = self.width / 2 - 1.0
            return ("walk", middle - 1.2, middle + 1.2), ("drive", self.width - 3.4, self.width - 0.4)
        if self.type == "two-storey":
            return ("drive", 1.1, 4.4), ("walk", 5.4, 6.7)
        return (("walk", 4.1, 5.4),)

    def properties(self, id: str) -> dict[str, object]:
        """What a file says of it."""
        return {"id": id, "label": self.type, "orientation": round(self.angle, 6), "segment_labels": list(EDGES)}


def type_of(width: float, depth: float, name: str) -> str | None:
    """The type of house for a lot, by its size, and by lot where two fit."""
    fitting = [type for type, least, deep, most in TYPES if least <= width <= most and depth >= deep]
    if "condominium" in fitting:
        return "condominium"
    return fitting[zlib.crc32(name.encode()) % len(fitting)] if fitting else None


def front_of(plot: shapely.Polygon, streets: BaseGeometry, reach: float) -> float | None:
    """Direction of a plot's longest stretch on a street, with the plot on its left; None where it has none."""
    ring = np.array(shapely.orient_polygons(plot).exterior.coords)
    edges = np.diff(ring, axis=0)
    lengths = np.hypot(*edges.T)
    outwards = np.column_stack([edges[:, 1], -edges[:, 0]]) / np.maximum(lengths, 1e-9)[:, None]
    middles = (ring[:-1] + ring[1:]) / 2
    # Straight out of the plot, the next thing is the street.
    looks = shapely.linestrings(np.stack([middles + 0.3 * outwards, middles + reach * outwards], axis=1))
    facing = shapely.intersects(looks, streets) & (lengths > 1.0)
    turns = np.arctan2(edges[:, 1], edges[:, 0])
    best, longest = None, 5.0
    for turn in turns[facing]:
        along = facing & (np.cos(turns - turn) > np.cos(np.radians(12.0)))
        if lengths[along].sum() > longest + 1e-6:
            best, longest = float(turn), float(lengths[along].sum())
    return best


def lot_in(plot: shapely.Polygon, angle: float, name: str) -> Lot | None:
    """The lot for a house in a plot: the largest rectangle on the front of a direction that a type fits on."""
    c, s = np.cos(angle), np.sin(angle)
    turn = np.array([[c, -s], [s, c]])
    flat = shapely.transform(plot, lambda p: p @ turn)
    x0, y0, x1, y1 = flat.bounds
    xs, ys = np.arange(x0 + CELL / 2, x1, CELL), np.arange(y0 + CELL / 2, min(y1, y0 + DEEPEST + 12.0), CELL)
    if len(xs) < 2 or len(ys) < 2:
        return None
    inside = shapely.contains_xy(flat, *np.meshgrid(xs, ys))
    best: tuple[float, Lot] | None = None
    for base in range(min(len(ys), round(FURTHEST / CELL))):
        free = np.cumprod(inside[base:], axis=0).sum(axis=0) * CELL
        for left, right, depth in _under(np.minimum(free, DEEPEST)):
            width = (right - left) * CELL
            width_kept = min(width, TYPES[0][3])
            type = type_of(width_kept, depth, name)
            if type is None:
                continue
            if type != "condominium":
                width_kept = min(width_kept, 24.0)
                depth = min(depth, 30.0)
            x = x0 + left * CELL + (width - width_kept) / 2
            corner = np.array([x, y0 + base * CELL]) @ turn.T
            # Near the street rather than large.
            worth = width_kept * depth - 12.0 * base * CELL
            if best is None or worth > best[0]:
                place = (round(float(corner[0]), 2), round(float(corner[1]), 2))
                best = worth, Lot(place, angle, round(width_kept, 2), round(depth, 2), type)
    return None if best is None else best[1]


def _under(heights: np.ndarray) -> Iterator[tuple[int, int, float]]:
    """All widest rectangles under a row of heights: from column, up to column, height."""
    stack: list[tuple[int, float]] = []
    for k, height in enumerate([*heights.tolist(), 0.0]):
        start = k
        while stack and stack[-1][1] >= height:
            start, tall = stack.pop()
            yield start, k, tall
        stack.append((start, height))


def lots_along(
    lines: Sequence[shapely.LineString], streets: BaseGeometry, setback: float, weights: Sequence[float], seed: int
) -> list[Lot]:
    """Lots along both sides of lines, as close as they fit, clear of streets and of each other.

    Parameters
    ----------
    lines : sequence of LineString
        The middles of streets.
    streets : geometry
        Carriageways and pavements.
    setback : float
        Distance of the fronts from the lines.
    weights : sequence of float
        How frequent each of `TYPES` is.
    seed : int
    """
    rng = np.random.default_rng(seed)
    sizes = {
        "condominium": ((27, 38), (28, 33)),
        "two-storey": ((16, 21), (24, 28)),
        "one-storey": ((17, 23), (23, 27)),
    }
    found: list[Lot] = []
    shapes: list[shapely.Polygon] = []
    for line in lines:
        for side in (1.0, -1.0):
            at = 0.0
            # A stretch has one type, as streets do.
            left, type = 0, ""
            while at < line.length:
                if not left:
                    type = str(rng.choice([name for name, *_ in TYPES], p=np.array(weights) / sum(weights)))
                    left = int(rng.integers(2, 7))
                (low, high), (near, far) = sizes[type]
                # Whole metres, as surveyors divide land.
                width, depth = float(rng.integers(low, high)), float(rng.integers(near, far))
                lot = _on(line, at, side, setback, width, depth, type)
                if lot is None:
                    break
                shape = lot.shape
                close = shapely.STRtree(shapes).query(shape, predicate="intersects") if shapes else []
                overlap = any(shapes[i].intersection(shape).area > 0.05 for i in close)
                if overlap or shape.intersects(streets):
                    at += 1.5
                    continue
                found.append(lot)
                shapes.append(shape)
                left -= 1
                at += width
    return found


def _on(
    line: shapely.LineString, at: float, side: float, setback: float, width: float, depth: float, type: str
) -> Lot | None:
    if at + width > line.length:
        return None
    a, b = (np.array(line.interpolate(s).coords[0]) for s in (at, at + width))
    along = b - a
    if np.hypot(*along) < 0.9 * width:
        return None
    along /= np.hypot(*along)
    out = side * np.array([-along[1], along[0]])
    # On the left of the line the lot's front runs along it, on the right against it.
    start = (a + b) / 2 - side * along * width / 2 + setback * out
    angle = float(np.arctan2(*(side * along)[::-1]))
    return Lot((round(float(start[0]), 3), round(float(start[1]), 3)), round(angle, 6), width, depth, type)
