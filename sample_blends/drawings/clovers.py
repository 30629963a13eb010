"""Clovers of all sizes among grass (figure 3.6a)."""

from __future__ import annotations

import numpy as np
import shapely

from .lines import Array, Stroke, Warp, along, by_hand, curve, inverse, joined, then
from .picture import Edit, Picture, mixed, over, step, with_alpha, within


def leaflet(turn: float, size: float) -> list[Stroke]:
    """A heart with its point at the origin: its rim, its vein, and the pale band across it."""
    right = [(0.0, 0.0), (0.16, 0.2), (0.42, 0.42), (0.52, 0.72), (0.36, 0.96), (0.14, 0.97), (0.0, 0.84)]
    rim = joined(
        curve(right, count=14),
        curve([(-0.95 * x, 0.98 * y) for x, y in right[::-1]], count=14),
    )
    vein = curve([(0.0, 0.08), (0.02, 0.4), (0.0, 0.74)], count=6, width=0.6)
    band = [(-0.34, 0.4), (-0.2, 0.62), (0.0, 0.5), (0.19, 0.63), (0.35, 0.42)]
    strokes = [rim, vein, curve(band, count=12, width=0.6)]
    return [Stroke(k.points @ turned(turn, size), k.closed, k.width) for k in strokes]


def turned(turn: float, size: float) -> Array:
    """The matrix that turns rows of points, and scales them."""
    c, s = np.cos(turn), np.sin(turn)
    return size * np.array([[c, s], [-s, c]])


#: Turns and sizes of the leaflets of a plant.
TURNS = ((0.1, 1.0), (2.25, 0.92), (-2.05, 0.96))
LEAFLETS = [leaflet(*t) for t in TURNS]
STEM = joined(
    curve([(-0.045, -0.1), (-0.1, -0.9), (0.02, -1.7), (-0.06, -2.3)], count=16),
    curve([(-0.06, -2.3), (0.07, -2.32)], count=3),
    curve([(0.07, -2.32), (0.13, -1.7), (0.0, -0.9), (0.045, -0.12)], count=16),
    closed=False,
)
CLOVER = [s for leaf in LEAFLETS for s in leaf] + [STEM]
#: The frame along the stem: from its foot upwards.
UPRIGHT = [Stroke(np.column_stack([s.points[:, 1], -s.points[:, 0]]), s.closed, s.width) for s in CLOVER]

#: Feet and tops of the plants, and how much they lean in between.
PLANTS = [
    ((2.6, 3.9), (3.0, 7.4), 0.15, 1.0),
    ((6.1, 4.9), (5.7, 8.6), -0.3, 1.0),
    ((9.3, 5.5), (10.6, 8.9), 0.35, -1.0),
    ((13.4, 4.6), (12.9, 8.6), 0.3, 1.0),
    ((4.6, 1.0), (4.5, 3.7), 0.25, -1.0),
    ((7.6, 1.2), (7.4, 4.0), -0.25, 1.0),
    ((10.2, 1.0), (10.9, 3.5), 0.1, 1.0),
    ((13.6, 0.9), (13.9, 3.1), -0.15, -1.0),
    ((1.3, 0.8), (1.2, 2.6), 0.1, 1.0),
]


def plant(foot: tuple[float, float], top: tuple[float, float], lean: float, side: float) -> Warp:
    """A plant from its foot to its top."""
    a, b = np.array(foot), np.array(top)
    across = np.array([-(b - a)[1], (b - a)[0]]) * lean * 0.4
    spine = [a, a + (b - a) * 0.35 + across * 0.8, a + (b - a) * 0.7 + across * 0.7, b]
    return along(spine, -2.32, 1.0, (0.95, 1.0, 1.05), side)


def tuft(foot: tuple[float, float], tall: float, generator: np.random.Generator) -> list[Stroke]:
    """Blades of grass round the foot of a plant."""
    blades = []
    for side in (-1.5, -1.0, 1.1, 1.6):
        x, y = foot[0] + 0.25 * side, foot[1] - 0.1
        lean, high = generator.uniform(0.15, 0.4) * side, tall * generator.uniform(0.6, 1.1)
        tip, half = (x + lean, y + high), 0.35 * lean
        left = curve([(x - 0.05, y), (x - 0.05 + half, y + 0.5 * high), tip], count=8)
        right = curve([tip, (x + 0.05 + half, y + 0.5 * high), (x + 0.05, y)], count=8)
        blades.append(joined(left, right, closed=False))
    return blades


def green(points: Array) -> Array:
    """Deep green with a pale band and a vein on every leaflet."""
    flat = np.column_stack([-points[:, 1], points[:, 0]])
    alpha = within(STEM.polyline())(flat)
    colour = mixed((0.3, 0.5, 0.16), (0.55, 0.75, 0.3), step(flat[:, 0], 0.0, 0.1))
    for (rim, *_), (turn, size) in zip(LEAFLETS, TURNS, strict=True):
        inside = within(rim.polyline())(flat)
        local = flat @ np.linalg.inv(turned(turn, size))
        u, v = local.T
        own = mixed((0.05, 0.34, 0.14), (0.3, 0.66, 0.2), v / 1.05)
        edge = np.interp(u, [-0.34, -0.2, 0.0, 0.19, 0.35], [0.4, 0.62, 0.5, 0.63, 0.42])
        own = over(own, (0.78, 0.9, 0.62), 0.85 * step(0.09 - np.abs(v - edge + 0.05), 0.0, 0.05) * (np.abs(u) < 0.4))
        own = over(own, (0.03, 0.22, 0.1), 0.5 * (np.sin(38 * (v - 0.9 * np.abs(u))) > 0.75))
        own = over(own, (0.85, 0.95, 0.7), 0.8 * step(0.018 - np.abs(u), 0.0, 0.02) * (v < 0.8))
        colour = np.where((inside > 0)[:, None], own, colour)
        alpha = np.maximum(alpha, inside)
    return with_alpha(colour, alpha)


def meadow(points: Array) -> Array:
    """Soft blades out of focus, light from above."""
    x, y = points.T
    colour = mixed((0.35, 0.55, 0.22), (0.93, 0.97, 0.72), step(y, 5.0, 11.0))
    for i in range(26):
        at, wide, tall = (0.37 + 0.618 * i) % 1.0 * 16.0, 0.1 + 0.012 * (i * 7 % 11), 3.0 + (i * 5 % 9) * 0.6
        bend = 0.09 * ((i * 3 % 7) - 3)
        blade = step(wide * (1.0 - y / tall) - np.abs(x - at - bend * y), 0.0, 0.12)
        colour = over(colour, (0.2 + 0.02 * (i % 5), 0.45 + 0.03 * (i % 4), 0.15), 0.35 * blade)
    return with_alpha(colour, np.ones(len(points)))


def picture() -> Picture:
    """Nine clovers in the grass."""
    hand = np.random.default_rng(7)
    warps = [plant(*p) for p in PLANTS]
    strokes = []
    for w in warps:
        size = float(np.linalg.norm(w(np.array([(1.0, 0.0)])) - w(np.array([(-2.3, 0.0)]))))
        strokes += by_hand([s.warped(w) for s in UPRIGHT], 0.003 * size, hand)
    for i in range(14):
        at, tall, lean = 0.4 + 1.17 * i, 0.9 + 0.5 * (i * 5 % 4) / 3.0, 0.5 * ((i * 3 % 5) - 2) / 2.0
        tip = (at + lean, 0.1 + tall)
        strokes.append(
            joined(
                curve([(at - 0.09, 0.1), (at - 0.06 + 0.35 * lean, 0.1 + 0.6 * tall), tip], count=8),
                curve([tip, (at + 0.07 + 0.3 * lean, 0.1 + 0.5 * tall), (at + 0.09, 0.1)], count=8),
                closed=False,
            )
        )
    for k, (foot, *_) in enumerate(PLANTS):
        strokes += tuft(foot, 0.5 + 0.3 * (k % 3) / 2.0, hand)
    home = inverse(warps[0], (-2.5, -1.2), (1.2, 1.2))
    outline = shapely.union_all(
        [shapely.make_valid(shapely.polygons(s.polyline())) for s in UPRIGHT if len(s.points) > 15]
    )
    ring = shapely.get_coordinates(outline.buffer(0.1).exterior.simplify(0.01))[:-1]
    return Picture(
        "clovers",
        "3.6a",
        strokes,
        [Edit("clover", warps[0](ring), lambda p: green(home(p)), [then(home, w) for w in warps[1:]])],
        meadow,
        (0.0, 0.0),
        (16.0, 10.0),
    )
