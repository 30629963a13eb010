"""Butterflies of eight sorts over clutter, the largest ten times the smallest (figure 3.7g)."""

from __future__ import annotations

import numpy as np
import shapely

from .lines import Array, Stroke, Warp, by_hand, curve, ellipse, inverse, joined, placed, pulled, then
from .picture import Edit, Picture, mixed, over, step, with_alpha, within

#: The right half; the left one mirrors it.
FORE = joined(
    curve([(0.07, 0.22), (0.4, 0.75), (0.95, 1.15), (1.4, 1.22)], count=14),
    curve([(1.4, 1.22), (1.36, 0.85), (1.18, 0.5), (1.02, 0.18)], count=10),
    curve([(1.02, 0.18), (0.6, 0.06), (0.08, 0.02)], count=8),
    closed=False,
)
HIND = joined(
    curve([(1.0, 0.17), (1.12, -0.2), (0.98, -0.6)], count=9),
    curve([(0.98, -0.6), (0.86, -0.68), (0.84, -1.12)], count=7),
    curve([(0.84, -1.12), (0.68, -0.78), (0.46, -0.8), (0.24, -0.52), (0.06, -0.28)], count=12),
    closed=False,
)
MARKS = [
    ellipse(1.0, 0.82, 0.12, 0.16, 0.5, count=12),
    ellipse(0.62, 0.5, 0.09, 0.13, 0.8, count=10),
    ellipse(0.78, -0.32, 0.15, count=12),
    ellipse(0.79, -0.33, 0.07, count=9),
    curve([(0.09, 0.1), (0.55, 0.36), (1.2, 1.0)], count=8, width=0.6),
    curve([(0.1, 0.06), (0.6, 0.16), (1.12, 0.42)], count=7, width=0.6),
    curve([(0.08, -0.1), (0.4, -0.25), (0.62, -0.68)], count=7, width=0.6),
]
ANTENNA = curve([(0.03, 0.42), (0.14, 0.78), (0.38, 1.0), (0.43, 0.93)], count=10, width=0.7)
TRUNK = joined(
    curve([(0.0, 0.46), (0.07, 0.3), (0.09, 0.0), (0.06, -0.45), (0.0, -0.68)], count=14),
    curve([(0.0, -0.68), (-0.06, -0.45), (-0.09, 0.0), (-0.07, 0.3), (0.0, 0.46)], count=14),
)
LEFT = np.array([-1.0, 1.0])
BUTTERFLY = [
    TRUNK,
    *(Stroke(s.points * side, s.closed, s.width) for side in (1.0, LEFT) for s in (FORE, HIND, ANTENNA, *MARKS)),
]

#: Where wing tips and tails are pulled, sort by sort; the first is as drawn.
CORNERS = [(1.4, 1.22), (1.02, 0.18), (0.84, -1.12), (0.0, 0.4), (0.0, -0.6)]
SORTS = [
    (0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    (0.12, -0.08, 0.05, 0.0, -0.08, 0.1),
    (-0.12, 0.12, -0.06, 0.02, 0.08, -0.05),
    (0.05, 0.15, 0.08, -0.05, 0.0, -0.12),
    (-0.15, -0.05, 0.0, 0.05, 0.1, 0.08),
    (0.1, 0.05, -0.08, 0.0, -0.05, -0.1),
    (0.0, 0.12, 0.08, 0.06, 0.06, 0.05),
    (-0.08, -0.1, 0.05, -0.04, -0.06, 0.1),
]
#: Place, size and turn of each.
PLACES = [
    ((3.1, 6.6), 1.5, 12.0),
    ((11.5, 6.1), 2.2, -18.0),
    ((7.3, 8.3), 0.75, 35.0),
    ((6.9, 5.2), 0.9, -40.0),
    ((14.9, 2.6), 0.7, 20.0),
    ((8.4, 2.9), 0.5, 60.0),
    ((1.4, 2.9), 0.45, -25.0),
    ((5.2, 3.2), 0.23, 30.0),
]


def butterfly(i: int) -> Warp:
    """A butterfly of its sort in its place."""
    a, b, c, d, e, f = SORTS[i]
    moves = [(a, b), (c, d), (e, f), (0.0, 0.0), (0.0, 0.0)]
    handles = []
    for (x, y), (dx, dy) in zip(CORNERS, moves, strict=True):
        handles.append(((x, y), (x + dx, y + dy)))
        if x:
            # One wing is held a little higher than the other.
            handles.append(((-x, y), (-x - dx, y + dy + 0.04 * (i % 3 - 1))))
    at, size, turn = PLACES[i]
    return then(pulled(handles), placed(at, size, turn))


def clutter(generator: np.random.Generator) -> list[Stroke]:
    """Leaves, stalks, petals and scribbles all over the sheet."""
    strokes = []
    for i in range(26):
        at = generator.uniform((0.3, 0.3), (15.7, 9.7))
        size, turn = generator.uniform(0.35, 0.9), generator.uniform(0, 360)
        leaf = joined(
            curve([(0, 0), (0.4, 0.26), (1.0, 0.2), (1.5, 0.0)], count=10),
            curve([(1.5, 0.0), (0.9, -0.24), (0.35, -0.2), (0, 0)], count=10),
        )
        vein = curve([(-0.3, -0.04), (0.5, 0.03), (1.3, 0.0)], count=7, width=0.6)
        strokes += [s.warped(placed(at, size, turn)) for s in ((leaf, vein) if i % 2 else (leaf,))]
    for _ in range(16):
        at, turn = generator.uniform((0.3, 0.3), (15.7, 9.7)), generator.uniform(0, 360)
        knots = np.cumsum(generator.normal(0.25, 0.22, (5, 2)), axis=0)
        strokes.append(curve(knots, count=16, width=0.8).warped(placed(at, 1.0, turn)))
    for _ in range(9):
        at, size = generator.uniform((0.5, 0.5), (15.5, 9.5)), generator.uniform(0.25, 0.5)
        t = np.linspace(0, 2 * np.pi, 40, endpoint=False)
        r = 0.75 + 0.25 * np.cos(5 * t)
        strokes.append(Stroke(np.stack([r * np.cos(t), r * np.sin(t)], 1), True).warped(placed(at, size)))
        strokes.append(ellipse(0, 0, 0.22, count=10).warped(placed(at, size)))
    return strokes


def wings(points: Array) -> Array:
    """Orange and black like a swallowtail, a blue eye on each hind wing."""
    x, y = np.abs(points[:, 0]), points[:, 1]
    fold = np.column_stack([x, y])
    fore, hind = (within(np.vstack([s.points, [(0.0, 0.0)]]))(fold) for s in (FORE, HIND))
    colour = mixed((1.0, 0.8, 0.25), (0.93, 0.4, 0.08), np.hypot(x, y) / 1.3)
    colour = np.where((hind > fore)[:, None], mixed((1.0, 0.72, 0.2), (0.85, 0.28, 0.1), np.hypot(x, y) / 1.1), colour)
    shapes = [shapely.make_valid(shapely.polygons(np.vstack([s.points, [(0.0, 0.0)]]))) for s in (FORE, HIND)]
    rim = shapely.distance(shapely.union_all(shapes).exterior, shapely.points(fold))
    colour = over(
        colour, (0.1, 0.06, 0.08), step(0.11 + 0.03 * np.sin(16 * np.arctan2(y, x)) - rim, 0, 0.03) * (x > 0.3)
    )
    angle = np.arctan2(y, x - 0.02)
    colour = over(colour, (0.12, 0.07, 0.06), 0.7 * (np.abs(np.sin(7 * angle)) < 0.1) * (x > 0.1))
    for s, tint in zip(
        MARKS[:4], ((1.0, 0.95, 0.8), (0.15, 0.08, 0.06), (0.15, 0.3, 0.75), (0.8, 0.95, 1.0)), strict=True
    ):
        colour = over(colour, tint, within(s.polyline())(fold))
    trunk = within(TRUNK.polyline())(points)
    colour = over(colour, mixed((0.25, 0.14, 0.08), (0.5, 0.32, 0.16), 0.5 + 0.5 * np.sin(40 * y)), trunk)
    return with_alpha(colour, np.max([fore, hind, trunk], axis=0))


def garden(points: Array) -> Array:
    """Soft greens and spots of blossom."""
    x, y = points.T
    colour = mixed((0.72, 0.84, 0.62), (0.93, 0.96, 0.86), step(y, 5.0, 10.0))
    generator = np.random.default_rng(2)
    tints = ((0.95, 0.8, 0.85), (0.62, 0.78, 0.55), (0.97, 0.92, 0.7), (0.55, 0.74, 0.6))
    for i in range(22):
        a, b, r = generator.uniform((0, 0, 0.6), (16, 10, 1.6))
        colour = over(colour, tints[i % 4], 0.55 * step(1.0 - np.hypot(x - a, y - b) / r, 0.0, 0.9))
    return with_alpha(colour, np.ones(len(points)))


def picture() -> Picture:
    """Eight butterflies."""
    hand = np.random.default_rng(77)
    warps = [butterfly(i) for i in range(len(PLACES))]
    strokes = clutter(hand)
    for w, (_, size, _) in zip(warps, PLACES, strict=True):
        strokes += by_hand([s.warped(w) for s in BUTTERFLY], 0.005 * size, hand)
    home = inverse(warps[0], (-1.8, -1.5), (1.8, 1.6))
    halves = [np.vstack([s.points * side, [(0.0, 0.0)]]) for s in (FORE, HIND) for side in (1.0, LEFT)]
    shapes = [shapely.make_valid(shapely.polygons(h)) for h in (*halves, TRUNK.polyline())]
    shapes += [shapely.linestrings(ANTENNA.points * side) for side in (1.0, LEFT)]
    ring = shapely.get_coordinates(shapely.union_all(shapes).buffer(0.07).exterior.simplify(0.01))[:-1]
    return Picture(
        "butterflies",
        "3.7g",
        strokes,
        [
            Edit(
                "butterfly",
                warps[0](ring),
                lambda p: wings(home(p)),
                [then(home, w) for w in warps[1:]],
                # Mirrored, a butterfly looks the same.
                options={"mirrored": False},
            )
        ],
        garden,
        (0.0, 0.0),
        (16.0, 10.0),
        pen=0.016,
    )
