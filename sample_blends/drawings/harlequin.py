"""Three harlequins of cloth, bent this way and that (figure 3.6e): doll and hat."""

from __future__ import annotations

import numpy as np
import shapely

from .lines import Array, Stroke, Warp, along, by_hand, curve, ellipse, inverse, joined, then
from .picture import Edit, Picture, mixed, over, step, with_alpha, within

#: Drawn along x, from the feet (0) to the tips of the hat (5.6).
BODY = joined(
    curve([(0.0, 0.7), (0.25, 0.95), (0.5, 0.62)], count=8),
    curve([(0.5, 0.62), (1.2, 0.55), (1.75, 0.6)], count=8),
    curve([(1.75, 0.6), (2.2, 0.72), (2.6, 0.62)], count=8),
    curve([(2.6, 0.62), (2.4, 1.05), (2.15, 1.45)], count=7),
    curve([(2.15, 1.45), (2.3, 1.72), (2.62, 1.6)], count=7),
    curve([(2.62, 1.6), (2.85, 1.1), (3.08, 0.42)], count=8),
    curve([(3.08, 0.42), (3.12, 0.0), (3.08, -0.42)], count=8),
    curve([(3.08, -0.42), (2.85, -1.1), (2.62, -1.6)], count=8),
    curve([(2.62, -1.6), (2.3, -1.72), (2.15, -1.45)], count=7),
    curve([(2.15, -1.45), (2.4, -1.05), (2.6, -0.62)], count=7),
    curve([(2.6, -0.62), (2.2, -0.72), (1.75, -0.6)], count=8),
    curve([(1.75, -0.6), (1.2, -0.55), (0.5, -0.62)], count=8),
    curve([(0.5, -0.62), (0.25, -0.95), (0.0, -0.7)], count=8),
    curve([(0.0, -0.7), (0.1, -0.3), (0.45, -0.1)], count=7),
    curve([(0.45, -0.1), (1.2, -0.04), (1.35, 0.0)], count=6),
    curve([(1.35, 0.0), (1.2, 0.04), (0.45, 0.1)], count=6),
    curve([(0.45, 0.1), (0.1, 0.3), (0.0, 0.7)], count=7),
)
COLLAR = Stroke(np.array([(3.25 + (0.24 if i % 2 else -0.12), 0.46 * (1 - i / 5.0)) for i in range(11)]), False, 0.8)
HEAD = curve([(3.3, 0.42), (3.7, 0.55), (4.05, 0.5)], count=10)
CHIN = curve([(3.3, -0.42), (3.7, -0.55), (4.05, -0.5)], count=10)
HAT = joined(
    curve([(4.0, 0.58), (4.35, 0.62), (4.8, 0.78), (5.0, 1.1), (4.85, 1.55)], count=16),
    curve([(4.85, 1.55), (5.3, 1.2), (5.25, 0.7), (4.95, 0.2)], count=14),
    curve([(4.95, 0.2), (5.4, -0.2), (5.45, -0.8), (5.0, -1.25)], count=14),
    curve([(5.0, -1.25), (5.0, -0.9), (4.6, -0.7), (4.0, -0.58)], count=14),
    curve([(4.0, -0.58), (4.12, 0.0), (4.0, 0.58)], count=12),
)
BELLS = [ellipse(4.78, 1.62, 0.12, count=12), ellipse(4.94, -1.36, 0.12, count=12)]
FACE = [
    ellipse(3.82, 0.2, 0.07, count=10),
    ellipse(3.82, -0.2, 0.07, count=10),
    curve([(3.96, 0.3), (4.0, 0.2), (3.96, 0.1)], count=5, width=0.7),
    curve([(3.96, -0.3), (4.0, -0.2), (3.96, -0.1)], count=5, width=0.7),
    ellipse(3.64, 0.0, 0.08, count=10),
    curve([(3.56, 0.24), (3.45, 0.1), (3.44, -0.1), (3.55, -0.26)], count=8, width=0.8),
]
#: Where lozenges are sewn onto the cloth.
LOZENGES = ((0.95, 0.33), (1.35, 0.33), (2.15, -0.3), (2.6, -0.3))
CLOTH = [
    curve([(0.5, 0.62), (0.56, 0.35), (0.45, 0.1)], count=6, width=0.7),
    curve([(0.5, -0.62), (0.56, -0.35), (0.45, -0.1)], count=6, width=0.7),
    curve([(1.75, 0.6), (1.68, 0.0), (1.75, -0.6)], count=8, width=0.7),
    curve([(3.1, 0.0), (2.4, 0.03), (1.72, 0.0), (1.35, 0.0)], count=8, width=0.7),
    curve([(2.32, 1.2), (2.45, 1.32), (2.62, 1.42)], count=5, width=0.7),
    curve([(2.32, -1.2), (2.45, -1.32), (2.62, -1.42)], count=5, width=0.7),
    *(ellipse(x, 0.16, 0.055, count=8) for x in (2.0, 2.4, 2.8)),
    curve([(4.12, 0.0), (4.5, 0.08), (4.95, 0.2)], count=6, width=0.7),
    *(Stroke(np.array([(x - 0.2, y), (x, y + 0.13), (x + 0.2, y), (x, y - 0.13)]), True, 0.7)
      for x, y in LOZENGES),
]  # fmt: skip
DOLL = [BODY, COLLAR, HEAD, CHIN, HAT, *BELLS, *FACE, *CLOTH]

SPINES = [
    ([(3.0, 1.2), (2.95, 3.4), (3.1, 5.6), (3.0, 7.8)], (1.0, 1.0), 1.0),
    ([(8.0, 1.2), (7.7, 3.2), (8.1, 5.4), (9.3, 7.3)], (1.0, 1.05), -1.0),
    ([(13.1, 1.2), (13.6, 3.2), (13.4, 5.2), (12.5, 7.0)], (0.95, 1.0), 1.0),
]


def costume(points: Array) -> Array:
    """Red and gold halves, lozenges, white face and collar."""
    x, y = points.T
    flip = (y > 0) ^ (x > 4.0)
    colour = np.where(flip[:, None], (0.78, 0.1, 0.14), (0.16, 0.28, 0.6)) * np.ones((len(points), 3))
    u, v = (x / 0.5 + y / 0.34) % 2.0, (x / 0.5 - y / 0.34) % 2.0
    lozenge = (u < 1.0) ^ (v < 1.0)
    colour = over(colour, (0.95, 0.74, 0.18), 0.9 * (lozenge & (x < 3.1)))
    colour = over(colour, (0.95, 0.74, 0.18), 0.9 * ((np.sin(11 * x + 6 * np.abs(y)) > 0.5) & (x > 4.1)))
    for at, side in LOZENGES:
        sewn = np.abs(x - at) / 0.2 + np.abs(y - side) / 0.13
        colour = over(colour, (0.1, 0.36, 0.26), sewn < 1.0)
    hand = (x > 2.0) & (x < 2.75) & (np.abs(y) > 1.3)
    colour = over(colour, (0.98, 0.92, 0.86), hand & (x < 4))
    colour = over(colour, (0.12, 0.1, 0.14), x < 0.5 - 0.1 * np.abs(y))
    shape = np.vstack([HEAD.points, CHIN.points[::-1]])
    face = within(shape)(points)
    colour = over(colour, (1.0, 0.96, 0.92), face)
    for side in (1.0, -1.0):
        cheek = np.hypot(x - 3.6, y - side * 0.36)
        colour = over(colour, (0.95, 0.5, 0.5), 0.8 * face * step(0.16 - cheek, 0.0, 0.12))
        colour = over(colour, (0.1, 0.1, 0.2), np.hypot(x - 3.82, y - side * 0.2) < 0.07)
    colour = over(colour, (0.9, 0.15, 0.12), np.hypot(x - 3.64, y) < 0.08)
    ruff = within(np.vstack([COLLAR.points, [(3.3, -0.42), (3.08, -0.42), (3.08, 0.42), (3.3, 0.42)]]))(points)
    colour = over(colour, mixed((0.8, 0.8, 0.85), (1.0, 1.0, 1.0), 0.5 + 0.5 * np.cos(y * 50)), ruff)
    bells = np.max([within(b.polyline())(points) for b in BELLS], axis=0)
    colour = over(colour, (1.0, 0.82, 0.25), bells)
    parts = [within(BODY.polyline())(points), within(HAT.polyline())(points), face, ruff, bells]
    return with_alpha(colour, np.max(parts, axis=0))


def stage_floor(points: Array) -> Array:
    """A curtain, a light, and boards."""
    x, y = points.T
    fold = 0.5 + 0.5 * np.sin(3.4 * x + 0.5 * np.sin(1.3 * x))
    colour = mixed((0.2, 0.1, 0.24), (0.4, 0.2, 0.42), fold)
    spot = np.hypot((x - 8.0) / 7.5, (y - 4.5) / 5.2)
    colour = over(colour, (0.95, 0.82, 0.7), 0.55 * np.exp(-(spot**2) * 1.6))
    board = mixed((0.5, 0.32, 0.18), (0.66, 0.45, 0.26), np.floor(x / 1.2) % 3 / 2.0)
    board = over(board, (0.28, 0.16, 0.1), np.abs(x % 1.2) < 0.04)
    return with_alpha(np.where((y < 1.15)[:, None], board, colour), np.ones(len(points)))


def picture() -> Picture:
    """Three harlequins."""
    hand = np.random.default_rng(65)
    warps: list[Warp] = [along(spine, 0.0, 5.2, sizes, side) for spine, sizes, side in SPINES]
    strokes = [s for w in warps for s in by_hand([k.warped(w) for k in DOLL], 0.012, hand)]
    home = inverse(warps[0], (-0.4, -2.1), (5.9, 2.1))
    shapes = [shapely.make_valid(shapely.polygons(s.polyline())) for s in (BODY, HAT, *BELLS)]
    shapes.append(shapely.polygons(np.vstack([HEAD.points, CHIN.points[::-1]])).buffer(0.25))
    ring = shapely.get_coordinates(shapely.union_all(shapes).buffer(0.1).exterior.simplify(0.01))[:-1]
    return Picture(
        "harlequin",
        "3.6e",
        strokes,
        [Edit("doll", warps[0](ring), lambda p: costume(home(p)), [then(home, w) for w in warps[1:]])],
        stage_floor,
        (0.0, 0.0),
        (16.0, 10.0),
    )
