"""Giraffes in other poses (figure 3.6d)."""

from __future__ import annotations

import numpy as np
import shapely

from .lines import Array, Stroke, Warp, by_hand, curve, ellipse, inverse, joined, placed, pulled, then
from .picture import Edit, Picture, mixed, over, step, with_alpha, within

#: One giraffe, looking to the right; its hooves stand on y = 0.
NECK_BACK = curve([(0.1, 3.2), (0.75, 3.5), (1.15, 4.3), (1.5, 5.3), (1.75, 6.05)], count=20)
HORNS = joined(
    curve([(1.75, 6.05), (1.58, 6.3), (1.85, 6.3)], count=6),
    curve([(1.85, 6.3), (1.83, 6.6), (1.93, 6.66), (1.98, 6.3)], count=8),
    curve([(1.98, 6.3), (2.08, 6.58), (2.17, 6.55), (2.12, 6.2)], count=8),
    closed=False,
)
SNOUT = joined(
    curve([(2.12, 6.2), (2.4, 6.02), (2.72, 5.78), (2.85, 5.62)], count=10),
    curve([(2.85, 5.62), (2.82, 5.46), (2.62, 5.48), (2.3, 5.6), (2.05, 5.58)], count=12),
    closed=False,
)
NECK_FRONT = curve([(2.05, 5.58), (1.85, 4.7), (1.7, 3.7), (1.66, 3.0), (1.5, 2.55)], count=20)
FORELEGS = joined(
    curve([(1.5, 2.55), (1.46, 1.5), (1.5, 0.8), (1.46, 0.12)], count=14),
    curve([(1.46, 0.12), (1.6, 0.0), (1.28, 0.0)], count=5),
    curve([(1.28, 0.0), (1.3, 0.8), (1.24, 1.5), (1.16, 2.1)], count=14),
    curve([(1.16, 2.1), (1.02, 1.4), (1.0, 0.8), (0.94, 0.12)], count=12),
    curve([(0.94, 0.12), (1.06, 0.0), (0.74, 0.0)], count=5),
    curve([(0.74, 0.0), (0.78, 0.9), (0.78, 1.6), (0.74, 2.08)], count=12),
    closed=False,
)
BELLY = curve([(0.74, 2.08), (0.2, 1.94), (-0.45, 1.98)], count=10)
HINDLEGS = joined(
    curve([(-0.45, 1.98), (-0.42, 1.3), (-0.48, 0.8), (-0.5, 0.12)], count=12),
    curve([(-0.5, 0.12), (-0.38, 0.0), (-0.7, 0.0)], count=5),
    curve([(-0.7, 0.0), (-0.68, 0.8), (-0.66, 1.2), (-0.74, 1.62)], count=12),
    curve([(-0.74, 1.62), (-0.92, 1.15), (-0.92, 0.7), (-1.0, 0.12)], count=12),
    curve([(-1.0, 0.12), (-0.88, 0.0), (-1.2, 0.0)], count=5),
    curve([(-1.2, 0.0), (-1.16, 0.8), (-1.2, 1.3), (-1.14, 1.9), (-1.2, 2.5)], count=14),
    closed=False,
)
RUMP = curve([(-1.2, 2.5), (-1.12, 2.9), (-0.7, 3.08), (-0.2, 3.12), (0.1, 3.2)], count=14)
PARTS = (NECK_BACK, HORNS, SNOUT, NECK_FRONT, FORELEGS, BELLY, HINDLEGS, RUMP)
RIM = joined(*PARTS)
TAIL = joined(
    curve([(-1.17, 2.75), (-1.4, 2.4), (-1.42, 1.85)], count=9),
    curve([(-1.42, 1.85), (-1.55, 1.6), (-1.42, 1.35)], count=6),
    curve([(-1.42, 1.35), (-1.33, 1.6), (-1.38, 1.85)], count=6),
    closed=False,
)
PATCHES = [
    (-0.85, 2.65, 0.24), (-0.3, 2.8, 0.23), (-0.6, 2.25, 0.2), (0.25, 2.85, 0.24), (0.0, 2.32, 0.22),
    (0.7, 3.1, 0.2), (0.62, 2.55, 0.25), (1.15, 2.75, 0.22), (1.2, 3.35, 0.2), (1.35, 3.95, 0.18), (1.5, 4.5, 0.16),
    (1.62, 5.0, 0.13), (1.28, 2.2, 0.13), (-0.98, 2.0, 0.13), (-0.55, 1.65, 0.08), (1.8, 5.45, 0.09),
]  # fmt: skip


def spot(i: int, x: float, y: float, r: float) -> Stroke:
    """A patch of the coat: an uneven pentagon with blunt corners."""
    generator = np.random.default_rng(i)
    turn = 2.0 * np.pi * (np.arange(5) + generator.uniform(-0.2, 0.2, 5)) / 5.0 + 0.7 * i
    k = np.stack([x + r * np.cos(turn), y + r * np.sin(turn)], 1) * (1.0, 1.0)
    dense = np.vstack([a + (b - a) * t for a, b in zip(k, np.roll(k, -1, 0), strict=True) for t in (0.0, 0.33, 0.67)])
    return Stroke(dense, True, 0.7)


SPOTS = [spot(i, *p) for i, p in enumerate(PATCHES)]
FACE = [
    ellipse(2.15, 5.95, 0.075, 0.06, count=10),
    curve([(2.72, 5.68), (2.77, 5.65)], count=3, width=0.7),
    curve([(2.83, 5.56), (2.65, 5.55), (2.5, 5.6)], count=6, width=0.7),
    joined(
        curve([(1.77, 6.1), (1.5, 6.2), (1.35, 6.02)], count=6),
        curve([(1.35, 6.02), (1.55, 5.95), (1.74, 6.0)], count=6),
        closed=False,
    ),
]
MANE = [
    curve([(x, y), (x - 0.14, y + 0.05)], count=3, width=0.7)
    for x, y in ((1.0, 3.95), (1.2, 4.45), (1.38, 4.95), (1.55, 5.45))
]
GIRAFFE = [RIM, TAIL, *FACE, *MANE, *SPOTS]

#: The points by which a pose is pulled: rump, withers, breast, hooves, neck, head.
JOINTS = [
    (-1.2, 2.5), (0.1, 3.2), (1.5, 2.55), (-1.1, 0.0), (-0.6, 0.0), (0.84, 0.0), (1.4, 0.0), (1.25, 4.4), (1.9, 5.8),
    (2.8, 5.6), (0.2, 2.0), (-1.4, 1.4),
]  # fmt: skip
POSES: list[dict[int, tuple[float, float]]] = [
    {},
    {7: (0.55, -0.5), 8: (1.25, -1.35), 9: (1.2, -1.75), 5: (-0.1, 0), 6: (0.25, 0.0), 0: (0, 0.1)},
    {7: (-0.35, 0.1), 8: (-0.65, 0.15), 9: (-0.6, 0.35), 3: (0.2, 0), 6: (-0.15, 0), 11: (-0.2, 0.5)},
    {3: (-0.35, 0), 4: (0.15, 0), 5: (-0.15, 0), 6: (0.35, 0.1), 7: (0.25, -0.1), 8: (0.65, -0.35), 9: (0.7, -0.6)},
    {7: (0.05, 0.25), 8: (0.1, 0.55), 9: (0.15, 0.75), 3: (-0.2, 0), 4: (-0.2, 0), 6: (0.1, 0)},
]
#: Where each stands, how large it is, and whether it looks to the left.
PLACES = [
    ((2.0, 0.9), 1.0, False),
    ((6.5, 0.8), 1.05, False),
    ((14.0, 0.8), 1.05, True),
    ((9.2, 6.1), 0.55, False),
    ((5.7, 6.0), 0.5, False),
]


def posed(i: int) -> Warp:
    """A giraffe of a pose in its place."""
    at, size, left = PLACES[i]
    moves = [(j, tuple(np.add(j, POSES[i].get(k, (0.0, 0.0))))) for k, j in enumerate(JOINTS)]
    face: Warp = (lambda p: np.asarray(p) * (-1.0, 1.0)) if left else (lambda p: np.asarray(p, float))
    return then(pulled(moves), face, placed(at, size))


def coat(points: Array) -> Array:
    """Brown patches on cream, pale legs."""
    x, y = points.T
    colour = mixed((0.98, 0.9, 0.72), (0.93, 0.72, 0.4), step(y, 1.8, 2.0))
    colour = over(colour, (1.0, 0.95, 0.85), step(0.7 - np.hypot((x - 0.1) / 1.6, y - 1.9), 0.0, 0.5))
    spots = np.max([within(s.polyline())(points) for s in SPOTS], axis=0)
    colour = over(colour, mixed((0.42, 0.2, 0.08), (0.68, 0.36, 0.14), 0.5 + 0.5 * np.sin(9 * x + 7 * y)), spots)
    colour = over(colour, (0.3, 0.18, 0.12), step(0.13 - y, 0.0, 0.04))
    colour = over(colour, (0.5, 0.3, 0.2), 0.7 * step(0.3 - np.hypot(x - 2.8, y - 5.55), 0, 0.2))
    colour = over(colour, (0.05, 0.03, 0.03), np.hypot((x - 2.15) / 0.075, (y - 5.95) / 0.06) < 1.0)
    tuft = within(np.vstack([TAIL.points[8:]]))(points)
    colour = over(colour, (0.2, 0.1, 0.06), tuft)
    inside = np.maximum(within(RIM.polyline())(points), tuft)
    inside = np.maximum(inside, within(FACE[3].points)(points))
    return with_alpha(colour, inside)


def savanna(points: Array) -> Array:
    """Evening over grass, a far tree."""
    x, y = points.T
    colour = mixed((1.0, 0.78, 0.45), (0.55, 0.75, 0.9), step(y, 7.6, 5.0))
    colour = over(colour, (1.0, 0.95, 0.75), 0.9 * step(1.0 - np.hypot(x - 12.6, y - 8.6), 0.0, 0.3))
    hills = 6.9 + 0.4 * np.sin(0.5 * x + 1.0) + 0.15 * np.sin(1.7 * x)
    colour = over(colour, (0.62, 0.55, 0.5), step(hills - y, 0.0, 0.1))
    grass = mixed((0.78, 0.62, 0.25), (0.92, 0.8, 0.45), y / 5.8)
    colour = np.where((y < 6.4 + 0.1 * np.sin(2 * x))[:, None], grass, colour)
    crown = np.min(
        [np.hypot((x - a) / 1.5, y - b) / r for a, b, r in ((0.9, 8.7, 0.5), (2.0, 9.2, 0.55), (0.0, 9.3, 0.55))], 0
    )
    trunk = step(0.12 - np.abs(x - 0.9 - 0.05 * (y - 5)), 0.0, 0.05)
    colour = over(colour, (0.35, 0.28, 0.2), trunk * (y > 6.2) * (y < 8.8))
    colour = over(colour, (0.38, 0.48, 0.22), step(1.0 - crown, 0.0, 0.15))
    return with_alpha(colour, np.ones(len(points)))


def picture() -> Picture:
    """Five giraffes."""
    hand = np.random.default_rng(64)
    warps = [posed(i) for i in range(len(PLACES))]
    strokes = [
        s for i, w in enumerate(warps) for s in by_hand([k.warped(w) for k in GIRAFFE], 0.008 * PLACES[i][1], hand)
    ]
    home = inverse(warps[0], (-2.0, -0.5), (3.5, 7.2))
    shapes = [shapely.make_valid(shapely.polygons(p)) for p in (RIM.polyline(), TAIL.points, FACE[3].points)]
    ring = shapely.get_coordinates(shapely.union_all(shapes).buffer(0.13).exterior.simplify(0.01))[:-1]
    return Picture(
        "giraffes",
        "3.6d",
        strokes,
        [
            Edit(
                "giraffe", warps[0](ring), lambda p: coat(home(p)), [then(home, w) for w in warps[1:]],
                options={"query_points": 80},
            )
        ],
        savanna,
        (0.0, 0.0),
        (16.0, 10.0),
    )  # fmt: skip
