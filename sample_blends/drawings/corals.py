"""Branching corals (figure 3.6c): a stroke along one, since they are thin."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import shapely

from .lines import Array, Stroke, Warp, along, by_hand, curve, inverse, then
from .picture import Edit, Picture, mixed, over, step, with_alpha, within

#: Branches of a coral along x: their middle lines, and their thickness at either end.
BRANCHES = [
    ([(-0.1, 0.0), (0.8, 0.06), (1.6, -0.05), (2.4, 0.12), (3.1, 0.02)], 0.2, 0.07),
    ([(0.7, 0.04), (1.15, 0.55), (1.25, 1.05), (1.6, 1.35)], 0.13, 0.06),
    ([(1.2, 0.02), (1.6, -0.5), (2.15, -0.75), (2.5, -1.2)], 0.13, 0.06),
    ([(1.95, 0.02), (2.25, 0.5), (2.7, 0.75)], 0.1, 0.055),
    ([(1.2, 0.9), (0.95, 1.25)], 0.08, 0.05),
    ([(2.0, -0.7), (2.5, -0.68), (2.8, -0.5)], 0.08, 0.05),
    ([(0.35, 0.0), (0.7, -0.42), (0.75, -0.8)], 0.11, 0.055),
]


def limb(knots: list[tuple[float, float]], start: float, end: float) -> shapely.Polygon:
    """A branch with a round, thicker tip."""
    middle = curve(knots, count=30).points
    width = np.linspace(start, end, 30)
    width[-4:] = end * 1.25
    discs = [shapely.Point(p).buffer(w, quad_segs=8) for p, w in zip(middle, width, strict=True)]
    return shapely.union_all([shapely.MultiPolygon([a, b]).convex_hull for a, b in pairwise(discs)])


SHAPE = shapely.union_all([limb(*b) for b in BRANCHES])
RIM = Stroke(shapely.get_coordinates(SHAPE.exterior.simplify(0.004).segmentize(0.09))[:-1], True)
PORES = [
    curve([(x - 0.05, y), (x, y + 0.035), (x + 0.06, y + 0.01)], count=4, width=0.6)
    for x, y in ((0.2, 0.02), (0.5, -0.06), (0.85, 0.08), (1.45, -0.04), (1.75, 0.03), (2.3, 0.08), (2.75, 0.08),
                 (1.15, 0.66), (1.36, 1.12), (1.62, -0.5), (2.3, -0.95), (0.68, -0.4))
]  # fmt: skip
CORAL = [RIM, *PORES]
TRUNK = curve(BRANCHES[0][0], count=40).points

#: Middle lines from foot to tip.
SPINES = [
    ([(2.9, 1.0), (2.85, 2.9), (2.95, 4.8), (3.15, 6.7)], (1.0, 1.0, 1.0), 1.0),
    ([(6.4, 0.8), (6.3, 2.0), (6.1, 3.2), (5.8, 4.3)], (1.05, 1.0, 0.95), 1.0),
    ([(9.9, 1.1), (10.0, 3.4), (10.2, 5.8), (10.6, 8.2)], (0.95, 1.0, 1.05), -1.0),
    ([(14.0, 0.9), (14.15, 2.1), (14.2, 3.3), (14.1, 4.5)], (1.0, 1.0, 1.0), 1.0),
    ([(13.2, 5.9), (13.5, 6.8), (13.9, 7.7), (14.4, 8.5)], (1.0, 1.0, 1.0), 1.0),
]


def red(points: Array) -> Array:
    """Red with pale tips and pale pores."""
    x, y = points.T
    xy = shapely.points(points)
    colour = mixed((0.55, 0.06, 0.14), (0.95, 0.3, 0.22), np.hypot(x, y) / 3.0)
    depth = shapely.distance(SHAPE.exterior, xy)
    colour = over(colour, (1.0, 0.62, 0.5), 0.6 * step(depth, 0.07, 0.09))
    colour = over(colour, (0.4, 0.02, 0.12), 0.6 * step(0.03 - depth, 0.0, 0.03))
    tips = np.array([b[0][-1] for b in BRANCHES])
    tip = np.linalg.norm(points[:, None] - tips[None], axis=2).min(axis=1)
    colour = over(colour, (1.0, 0.92, 0.82), step(0.2 - tip, 0.0, 0.16))
    pores = np.array([s.points.mean(axis=0) for s in PORES])
    pore = np.linalg.norm(points[:, None] - pores[None], axis=2).min(axis=1)
    colour = over(colour, (1.0, 0.88, 0.7), 0.9 * step(0.045 - pore, 0.0, 0.02))
    return with_alpha(colour, within(np.array(SHAPE.exterior.coords))(points))


def sea(points: Array) -> Array:
    """Blue, darker below; rocks."""
    x, y = points.T
    colour = mixed((0.02, 0.12, 0.3), (0.25, 0.62, 0.78), step(y, 5.0, 13.0))
    for at, r in ((2.6, 1.5), (6.4, 1.7), (10.0, 1.9), (14.2, 1.5), (4.5, 1.0), (12.2, 1.1)):
        rock = np.hypot((x - at) / 1.5, y + 0.45)
        colour = over(colour, mixed((0.16, 0.14, 0.22), (0.42, 0.38, 0.44), y / 1.5), step(r - rock, 0.0, 0.08))
    ledge = np.hypot((x - 14.2) / 3.2, (y - 5.55) / 0.5)
    colour = over(colour, (0.2, 0.22, 0.36), step(1.0 - ledge, 0.0, 0.1))
    for i in range(30):
        a, b = (0.21 + 0.618 * i) % 1.0 * 16, 2.0 + (0.37 + 0.387 * i) % 1.0 * 8
        bubble = np.hypot(x - a, y - b)
        colour = over(colour, (0.8, 0.95, 1.0), 0.35 * step(0.03 - np.abs(bubble - 0.06 - 0.02 * (i % 4)), 0.0, 0.03))
    return with_alpha(colour, np.ones(len(points)))


def picture() -> Picture:
    """Five corals."""
    hand = np.random.default_rng(63)
    warps: list[Warp] = [along(spine, -0.1, 3.1, sizes, side) for spine, sizes, side in SPINES]
    strokes = [s for w in warps for s in by_hand([k.warped(w) for k in CORAL], 0.01, hand)]
    home = inverse(warps[0], (-0.4, -1.5), (3.4, 1.7))
    return Picture(
        "corals",
        "3.6c",
        strokes,
        [
            Edit(
                "coral",
                warps[0](TRUNK),
                lambda p: red(home(p)),
                [then(home, w) for w in warps[1:]],
                closed=False,
                options={"reach": 0.48},
            )
        ],
        sea,
        (0.0, 0.0),
        (16.0, 10.0),
    )
