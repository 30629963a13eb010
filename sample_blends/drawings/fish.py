"""Fish of other proportions, bent and half hidden behind seaweed (figure 3.6b); the seaweed by strokes along it."""

from __future__ import annotations

import numpy as np
import shapely

from .lines import Array, Stroke, Warp, along, behind, by_hand, curve, ellipse, inverse, joined, then
from .picture import Edit, Picture, mixed, over, step, with_alpha, within

#: Sizes of a fish from its mouth (x = 1) to the root of its tail (x = -1).
BACK = curve([(1.0, 0.02), (0.72, 0.26), (0.25, 0.43), (-0.3, 0.36), (-0.75, 0.16), (-1.0, 0.1)], count=22)
BELLY = curve([(1.0, 0.02), (0.75, -0.14), (0.35, -0.33), (-0.2, -0.36), (-0.7, -0.15), (-1.0, -0.08)], count=22)
TAIL = joined(
    curve([(-1.0, 0.1), (-1.18, 0.24), (-1.52, 0.52)], count=9),
    curve([(-1.52, 0.52), (-1.36, 0.2), (-1.33, 0.02), (-1.42, -0.2), (-1.6, -0.44)], count=14),
    curve([(-1.6, -0.44), (-1.25, -0.24), (-1.0, -0.08)], count=9),
    closed=False,
)
DORSAL = joined(
    curve([(0.42, 0.4), (0.22, 0.68), (-0.05, 0.74)], count=9),
    curve([(-0.05, 0.74), (-0.12, 0.58), (-0.35, 0.56)], count=7),
    curve([(-0.35, 0.56), (-0.38, 0.44), (-0.42, 0.32)], count=6),
    closed=False,
)
ANAL = joined(
    curve([(-0.25, -0.36), (-0.42, -0.58), (-0.6, -0.6)], count=8),
    curve([(-0.6, -0.6), (-0.55, -0.42), (-0.62, -0.2)], count=6),
    closed=False,
)
BREAST = joined(
    curve([(0.34, -0.06), (0.12, -0.02), (-0.12, -0.16)], count=9),
    curve([(-0.12, -0.16), (0.0, -0.22), (0.02, -0.3)], count=6),
    curve([(0.02, -0.3), (0.2, -0.26), (0.34, -0.06)], count=8),
)
DETAILS = [
    ellipse(0.68, 0.1, 0.085, count=14),
    ellipse(0.695, 0.105, 0.035, count=10),
    curve([(0.47, 0.33), (0.37, 0.12), (0.4, -0.1), (0.5, -0.24)], count=12),
    curve([(0.99, 0.0), (0.86, -0.04), (0.79, -0.01)], count=7),
    curve([(-1.08, 0.1), (-1.35, 0.28)], count=5, width=0.6),
    curve([(-1.1, 0.02), (-1.28, 0.03)], count=5, width=0.6),
    curve([(-1.08, -0.06), (-1.38, -0.25)], count=5, width=0.6),
    curve([(0.25, 0.45), (0.08, 0.64)], count=5, width=0.6),
    curve([(0.02, 0.44), (-0.12, 0.58)], count=5, width=0.6),
    curve([(0.2, -0.1), (-0.02, -0.17)], count=5, width=0.6),
]
FISH = [BACK, BELLY, TAIL, DORSAL, ANAL, BREAST, *DETAILS]
BODY = np.vstack([BACK.polyline(), TAIL.polyline(), BELLY.polyline()[::-1]])
FINS = [np.vstack([DORSAL.polyline(), [(0.0, 0.3)]]), np.vstack([ANAL.polyline(), [(-0.4, -0.2)]])]


def lobes(first: float, side: float) -> list[Stroke]:
    """One edge of a blade, with pointed lobes that grow smaller towards the tip."""
    pieces, x, at = [], first, (0.0, 0.1 * side)
    while x < 2.4:
        size = 1.15 - 0.3 * x
        tip = (x + 0.36, (0.1 + 0.36 * size) * side)
        notch = (x + 0.3, 0.09 * side)
        pieces += [curve([at, (x, 0.1 * side), (x + 0.12, (0.1 + 0.25 * size) * side), tip], count=8)]
        pieces += [curve([tip, (x + 0.26, (0.1 + 0.16 * size) * side), notch], count=5)]
        x, at = x + 0.5, notch
    return [*pieces, curve([at, (2.7, 0.07 * side), (3.0, 0.0)], count=6)]


#: A blade of seaweed, rooted at x = 0.
BLADE = joined(*lobes(0.3, 1.0), *(Stroke(s.points[::-1]) for s in lobes(0.52, -1.0)[::-1]), closed=False)
VEIN = curve([(0.05, 0.0), (0.6, 0.03), (1.1, -0.03), (1.6, 0.03), (2.1, -0.02), (2.75, 0.0)], count=26, width=0.6)
NICKS = [
    curve([(x, 0.0), (x + 0.3, y)], count=4, width=0.6)
    for x, y in ((0.3, 0.3), (0.52, -0.3), (0.8, 0.26), (1.02, -0.24), (1.3, 0.22), (1.52, -0.2), (1.8, 0.18))
]
WEED = [BLADE, VEIN, *NICKS]

SPINES: list[tuple[list[tuple[float, float]], tuple[float, ...], float]] = [
    ([(2.0, 6.2), (3.6, 6.25), (5.2, 6.2)], (1.0, 1.0, 1.0), 1.0),
    ([(6.3, 8.1), (7.7, 8.45), (9.1, 7.95)], (0.8, 1.1, 0.85), 1.0),
    ([(14.3, 5.0), (12.9, 5.5), (11.3, 5.1), (10.3, 4.5)], (0.8, 1.0, 1.15), -1.0),
    ([(6.9, 2.9), (8.0, 2.3), (9.2, 2.6), (9.9, 3.3)], (0.95, 1.0, 0.8), 1.0),
    ([(14.6, 8.9), (13.4, 8.65), (12.3, 9.1)], (0.8, 1.05, 0.9), -1.0),
    ([(3.6, 3.4), (2.6, 2.7), (1.5, 2.75)], (1.0, 0.85, 0.8), -1.0),
    ([(12.3, 1.5), (13.4, 1.6), (14.6, 2.3)], (0.7, 1.1, 1.0), 1.0),
]
STALKS: list[list[tuple[float, float]]] = [
    [(5.7, 0.4), (5.8, 1.9), (5.6, 3.4), (5.9, 4.7)],
    [(11.2, 0.4), (11.4, 2.0), (11.2, 3.6), (11.7, 5.4)],
    [(1.9, 0.4), (1.6, 1.4), (1.9, 2.5), (2.3, 3.5)],
    [(8.6, 0.4), (8.4, 1.4), (8.6, 2.6), (8.4, 3.8)],
    [(13.9, 0.4), (14.2, 1.4), (13.9, 2.6), (14.2, 3.6)],
]


def scales(points: Array) -> Array:
    """Orange scales from a dark back to a pale belly; fins with rays."""
    x, y = points.T
    colour = mixed((1.0, 0.86, 0.55), (0.93, 0.38, 0.1), step(y, 0.0, 0.7))
    colour = over(colour, (0.62, 0.14, 0.1), step(y, 0.38, 0.3))
    row = np.round(y / 0.1)
    u = (x / 0.14 + 0.5 * (row % 2)) % 1.0 - 0.5
    v = y / 0.1 - row
    arc = np.abs(np.hypot(u + 0.1, v * 1.1) - 0.52) < 0.085
    body = (x > -0.95) & (x < 0.4)
    colour = over(colour, (0.68, 0.2, 0.08), 0.75 * (arc & body & (u < 0.45)))
    for at in (0.1, -0.42):
        colour = over(colour, (1.0, 0.97, 0.9), 0.92 * body * step(0.1 - np.abs(x - at - 0.25 * y**2), 0.0, 0.03))
    fin = np.max([within(f)(points) for f in FINS], axis=0) * (np.abs(y) > 0.38)
    tail = x < -1.02
    rays = 0.5 + 0.5 * np.sin(np.where(tail, np.arctan2(y, -x - 0.55) * 34, (x + 0.35 * y) * 62))
    colour = np.where((fin + tail > 0)[:, None], mixed((0.98, 0.62, 0.16), (0.84, 0.28, 0.1), rays), colour)
    breast = within(BREAST.polyline())(points)
    colour = np.where(
        (breast > 0)[:, None], mixed((1.0, 0.74, 0.3), (0.86, 0.36, 0.12), 0.5 + 0.5 * np.sin(y * 70)), colour
    )
    colour = over(
        colour, (0.75, 0.24, 0.1), 0.5 * step(0.03 - np.abs(np.hypot(x - 0.78, y - 0.03) - 0.39), 0, 0.02) * body
    )
    eye = np.hypot(x - 0.68, y - 0.1)
    colour = over(colour, (1.0, 1.0, 0.95), eye < 0.085)
    colour = over(colour, (0.05, 0.04, 0.08), np.hypot(x - 0.695, y - 0.105) < 0.038)
    inside = np.max([within(o)(points) for o in (BODY, *FINS)], axis=0)
    return with_alpha(colour, inside)


def weed(points: Array) -> Array:
    """Green, lighter towards the tip and along the vein."""
    x, y = points.T
    colour = mixed((0.05, 0.3, 0.2), (0.5, 0.72, 0.2), x / 3.0)
    vein = np.interp(x, VEIN.points[:, 0], VEIN.points[:, 1])
    colour = over(colour, (0.78, 0.88, 0.45), 0.8 * step(0.028 - np.abs(y - vein), 0.0, 0.02))
    colour = over(colour, (0.03, 0.2, 0.14), 0.4 * (np.sin(26 * (x - np.abs(y))) > 0.55))
    colour = over(colour, (0.72, 0.84, 0.4), 0.6 * step(np.abs(y), 0.34, 0.2))
    return with_alpha(colour, within(BLADE.polyline())(points))


def water(points: Array) -> Array:
    """Light falls in from above; sand below."""
    x, y = points.T
    colour = mixed((0.03, 0.2, 0.36), (0.45, 0.8, 0.86), step(y, 5.5, 12.0))
    for at, wide in ((2.5, 1.1), (6.4, 0.7), (9.8, 1.4), (13.6, 0.8)):
        beam = np.exp(-(((x - at + 0.28 * (10 - y)) / wide) ** 2))
        colour = over(colour, (0.85, 0.97, 0.95), 0.22 * beam * y / 10.0)
    dune = 0.75 + 0.18 * np.sin(0.9 * x) + 0.1 * np.sin(2.3 * x + 1.0)
    colour = over(colour, mixed((0.8, 0.68, 0.42), (0.95, 0.86, 0.6), y / 0.8), step(dune - y, 0.0, 0.06))
    return with_alpha(colour, np.ones(len(points)))


def fish_warps() -> list[Warp]:
    """Where the fish swim; the first is the query."""
    return [along(spine, -1.0, 1.0, sizes, side) for spine, sizes, side in SPINES]


def weed_warps() -> list[Warp]:
    """Where the seaweed grows; the first is the query."""
    return [along(spine, 0.0, 3.0) for spine in STALKS]


def picture() -> Picture:
    """Seven fish and five blades."""
    hand = np.random.default_rng(36)
    swim, grow = fish_warps(), weed_warps()
    blades = [by_hand([s.warped(w) for s in WEED], 0.012, hand) for w in grow]
    fronts = [b[0].polyline() for b in blades]
    strokes: list[Stroke] = [s for b in blades for s in b]
    for w in swim:
        strokes += behind(by_hand([s.warped(w) for s in FISH], 0.012, hand), fronts)
    ground = curve(
        [(0.2, 0.72), (2.5, 0.95), (5.0, 0.72), (8.0, 0.9), (11.0, 0.66), (13.5, 0.95), (15.8, 0.7)], count=40
    )
    strokes += behind([ground], fronts)
    home = inverse(swim[0], (-1.8, -0.9), (1.2, 0.95))
    root = inverse(grow[0], (-0.3, -0.7), (3.4, 0.7))
    outline = shapely.union_all([shapely.make_valid(shapely.polygons(o)) for o in (BODY, *FINS)])
    ring = shapely.get_coordinates(outline.buffer(0.08).exterior.simplify(0.01))[:-1]
    return Picture(
        "fish",
        "3.6b",
        strokes,
        [
            Edit("fish", swim[0](ring), lambda p: scales(home(p)), [then(home, w) for w in swim[1:]]),
            Edit(
                "seaweed",
                grow[0](np.stack([np.linspace(0.03, 2.97, 40), np.zeros(40)], 1)),
                lambda p: weed(root(p)),
                [then(root, w) for w in grow[1:]],
                closed=False,
                options={"reach": 0.17},
            ),
        ],
        water,
        (0.0, 0.0),
        (16.0, 10.0),
    )
