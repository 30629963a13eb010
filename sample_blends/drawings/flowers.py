"""Flowers, and one leaf that is found on all their stalks (figure 3.7h)."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import shapely

from .lines import Array, Stroke, Warp, along, behind, by_hand, curve, ellipse, inverse, joined, placed, then
from .picture import Edit, Picture, mixed, over, step, with_alpha, within

#: A notched leaf along x, with its veins.
NOTCHES = [
    (0.0, 0.0),
    (0.25, 0.2),
    (0.42, 0.17),
    (0.62, 0.34),
    (0.8, 0.28),
    (1.0, 0.36),
    (1.2, 0.25),
    (1.45, 0.2),
    (1.8, 0.0),
]
EDGE = [curve([a, ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2 + 0.03), b], count=5) for a, b in pairwise(NOTCHES)]
UNDER = [Stroke(s.points[::-1] * (1.0, -0.92)) for s in EDGE[::-1]]
RIM = joined(*EDGE, *UNDER)
LEAF = [
    RIM,
    curve([(-0.25, -0.02), (0.5, 0.03), (1.1, 0.0), (1.7, 0.0)], count=10, width=0.7),
    *(curve([(x, 0.02), (x + 0.2, y)], count=4, width=0.6) for x, y in ((0.35, 0.16), (0.65, 0.24), (0.95, 0.24))),
    *(curve([(x, 0.0), (x + 0.2, -y)], count=4, width=0.6) for x, y in ((0.4, 0.14), (0.72, 0.22), (1.0, 0.2))),
]

#: Half the thickness of a stalk.
HALF_STALK = 0.06

STALKS = [
    ((2.3, 0.3), (2.5, 6.3), 0.25),
    ((6.0, 0.3), (5.6, 7.6), -0.3),
    ((9.6, 0.3), (9.9, 5.6), 0.3),
    ((13.3, 0.3), (13.6, 7.2), -0.2),
]
#: Roots and tips of leaves, and how they curve.
LEAVES = [
    ((2.5, 2.4), (4.3, 3.4), 0.1, 1.0),
    ((2.35, 3.6), (0.8, 4.5), -0.15, -1.0),
    ((5.95, 2.0), (7.9, 2.5), 0.3, 1.0),
    ((5.85, 3.7), (4.5, 5.0), 0.2, 1.0),
    ((5.7, 5.0), (6.9, 6.0), -0.25, -1.0),
    ((9.85, 1.6), (8.3, 2.9), -0.3, -1.0),
    ((9.95, 2.7), (11.7, 3.9), 0.15, 1.0),
    ((13.3, 2.2), (15.2, 2.6), 0.3, 1.0),
    ((13.3, 3.4), (11.8, 4.9), 0.25, 1.0),
    ((13.35, 4.6), (14.6, 5.4), -0.2, -1.0),
]


def stalk(foot: tuple[float, float], top: tuple[float, float], bend: float) -> Array:
    """The middle of a stalk, from its foot to its blossom."""
    a, b = np.array(foot), np.array(top)
    end = b - 0.36 * (b - a) / np.linalg.norm(b - a)
    spine = [a, a + (end - a) * 0.35 + (bend, 0), a + (end - a) * 0.7 + (bend, 0), end]
    return curve(spine, count=18).points


MIDDLES = [stalk(*where) for where in STALKS]


def rooted(root: tuple[float, float], tip: tuple[float, float]) -> tuple[float, float]:
    """Where a leaf grows out of the nearest stalk, on the side of its tip."""
    x = min((float(np.interp(root[1], m[:, 1], m[:, 0])) for m in MIDDLES), key=lambda at: abs(at - root[0]))
    return x + np.copysign(HALF_STALK, tip[0] - x), root[1]


def leaf(root: tuple[float, float], tip: tuple[float, float], bend: float, side: float) -> Warp:
    """A leaf from its root to its tip."""
    a, b = np.array(rooted(root, tip)), np.array(tip)
    across = np.array([-(b - a)[1], (b - a)[0]]) * bend * 0.35
    return along([a, a + (b - a) * 0.35 + across, a + (b - a) * 0.7 + across, b], -0.25, 1.8, (1.0, 1.0), side)


def petals(kind: int) -> list[Stroke]:
    """A blossom, another for each stalk."""
    strokes = [ellipse(0, 0, 0.34, count=16), ellipse(0, 0, 0.2, count=12)]
    count = (8, 6, 12, 5)[kind]
    for i in range(count):
        turn, size = 360.0 * i / count, 1.0 + 0.06 * ((i * 3) % 4)
        wide = (0.28, 0.4, 0.2, 0.5)[kind]
        petal = joined(
            curve([(0.34, 0.08), (0.7, wide), (1.15, 0.6 * wide), (1.3, 0.0)], count=9),
            curve([(1.3, 0.0), (1.1, -0.7 * wide), (0.65, -0.9 * wide), (0.34, -0.08)], count=9),
            closed=False,
        )
        strokes += [
            s.warped(placed((0, 0), size, turn))
            for s in (petal, curve([(0.45, 0.0), (0.95, 0.03)], count=4, width=0.6))
        ]
    return strokes


def blossom(kind: int) -> shapely.Geometry:
    """What the petals and the middle of a blossom cover."""
    shapes = [shapely.make_valid(shapely.polygons(s.points)) for s in petals(kind) if len(s.points) > 6]
    where = placed(STALKS[kind][1], 1.0, 11.0 * kind)
    return shapely.transform(shapely.union_all(shapes).buffer(0.02), where)


BLOSSOMS = [blossom(kind) for kind in range(len(STALKS))]


def green(points: Array) -> Array:
    """Two greens, pale veins."""
    x, y = points.T
    colour = mixed((0.12, 0.42, 0.18), (0.42, 0.7, 0.26), step(y, 0.0, 0.04))
    colour = over(colour, (0.06, 0.3, 0.14), 0.5 * (np.sin(24 * (x - np.abs(y))) > 0.7))
    colour = over(colour, (0.82, 0.92, 0.6), 0.85 * step(0.02 - np.abs(y - 0.02), 0.0, 0.02))
    colour = over(colour, (0.86, 0.8, 0.35), 0.7 * step(x, 1.55, 0.3))
    return with_alpha(colour, within(RIM.polyline())(points))


def wall(points: Array) -> Array:
    """A pale wall, a sill, and the flowers' own colours as a wash."""
    x, y = points.T
    colour = mixed((0.98, 0.93, 0.84), (0.86, 0.92, 0.95), step(y, 6.0, 8.0))
    colour = over(colour, (0.78, 0.62, 0.48), step(0.55 - y, 0.0, 0.05))
    tints = ((0.95, 0.55, 0.6), (0.98, 0.8, 0.35), (0.72, 0.6, 0.88), (0.98, 0.62, 0.4))
    for middle, (_, top, _), shape, tint in zip(MIDDLES, STALKS, BLOSSOMS, tints, strict=True):
        stem = np.abs(x - np.interp(y, middle[:, 1], middle[:, 0])) < HALF_STALK
        colour = over(colour, (0.5, 0.68, 0.36), stem & (y > STALKS[0][0][1]) & (y < top[1]))
        r = np.hypot(x - top[0], y - top[1])
        petal = shapely.contains_xy(shape, x, y)
        colour = np.where(petal[:, None], mixed(np.array(tint) * 0.8, tint, step(r, 0.7, 0.7)), colour)
        colour = over(colour, (0.6, 0.4, 0.12), 0.8 * step(0.34 - r, 0.0, 0.06))
    return with_alpha(colour, np.ones(len(points)))


def picture() -> Picture:
    """Four flowers with ten leaves."""
    hand = np.random.default_rng(78)
    strokes = []
    for kind, (_, top, _) in enumerate(STALKS):
        sides = [Stroke(MIDDLES[kind] + (d, 0.0)) for d in (-HALF_STALK, HALF_STALK)]
        strokes += behind(sides, [shapely.get_coordinates(p.exterior) for p in shapely.get_parts(BLOSSOMS[kind])])
        strokes += by_hand([s.warped(placed(top, 1.0, 11.0 * kind)) for s in petals(kind)], 0.01, hand)
    warps = [leaf(*where) for where in LEAVES]
    for w in warps:
        strokes += by_hand([s.warped(w) for s in LEAF], 0.008, hand)
    home = inverse(warps[0], (-0.5, -0.7), (2.2, 0.7))
    upper = np.column_stack([-0.12 + 2.07 * 0.5 * (1.0 - np.cos(np.linspace(0.0, np.pi, 40))), np.zeros(40)])
    upper[:, 1] = np.interp(upper[:, 0], *np.array(NOTCHES).T)
    upper[:, 1] += 0.12 * np.sqrt(np.clip(np.minimum(upper[:, 0] + 0.12, 1.95 - upper[:, 0]) / 0.12, 0.0, 1.0))
    ring = warps[0](np.vstack([upper, upper[-2:0:-1] * (1.0, -1.0)]))
    return Picture(
        "flowers",
        "3.7h",
        strokes,
        [Edit("leaf", ring, lambda p: green(home(p)), [then(home, w) for w in warps[1:]])],
        wall,
        (0.0, 0.0),
        (16.0, 10.0),
    )
