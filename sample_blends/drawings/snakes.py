"""A snake, and larger ones that wind and grow (figure 3.1): their skin, and the pattern on it."""

from __future__ import annotations

import numpy as np

from .lines import Array, Stroke, along, by_hand, curve, ellipse, inverse, joined, then
from .picture import Edit, Picture, mixed, over, step, with_alpha, within

#: Half the width of the body, from the tip of the tail (x = 0) to the neck, and the head.
WIDTH = [(0.0, 0.0), (0.8, 0.09), (2.0, 0.2), (3.6, 0.3), (5.2, 0.34), (6.8, 0.29), (7.6, 0.2), (8.0, 0.19)]
HEAD = [(8.0, 0.19), (8.25, 0.33), (8.6, 0.36), (8.95, 0.27), (9.2, 0.12), (9.27, 0.0)]
UPPER = curve([*WIDTH, *HEAD[1:]], count=70)
LOWER = Stroke(UPPER.points * (1.0, -1.0))
TONGUE = [
    curve([(9.27, 0.0), (9.45, 0.02), (9.6, -0.01)], count=5, width=0.7),
    curve([(9.6, -0.01), (9.7, 0.03), (9.78, 0.1)], count=4, width=0.7),
    curve([(9.6, -0.01), (9.71, -0.04), (9.8, -0.08)], count=4, width=0.7),
]
FACE = [
    ellipse(8.62, 0.19, 0.09, 0.07, count=12),
    ellipse(8.62, -0.19, 0.09, 0.07, count=12),
    curve([(9.02, 0.1), (9.07, 0.07)], count=3, width=0.7),
    curve([(9.02, -0.1), (9.07, -0.07)], count=3, width=0.7),
]

#: Where the diamonds lie on the back: each a little other than the last.
DIAMONDS = [
    (1.35, 0.2, 0.07), (1.95, 0.25, 0.1), (2.65, 0.3, 0.14), (3.4, 0.3, 0.18), (4.15, 0.32, 0.2),
    (4.95, 0.33, 0.2), (5.75, 0.3, 0.19), (6.5, 0.28, 0.16), (7.15, 0.22, 0.12),
]  # fmt: skip


def diamond(x: float, a: float, b: float) -> Stroke:
    """A leaf-shaped spot with a point at either end."""
    top = curve([(x - a, 0.0), (x - 0.25 * a, 0.82 * b), (x + 0.3 * a, b), (x + a, 0.0)], count=8, width=0.7)
    bottom = curve([(x + a, 0.0), (x + 0.2 * a, -b), (x - 0.35 * a, -0.75 * b), (x - a, 0.0)], count=8, width=0.7)
    return joined(top, bottom)


CHEVRON = joined(
    curve([(7.55, 0.1), (7.85, 0.02), (8.05, 0.13)], count=5),
    curve([(8.05, 0.13), (8.3, 0.08), (8.45, 0.0)], count=5),
    curve([(8.45, 0.0), (8.25, -0.1), (8.05, -0.12)], count=5),
    curve([(8.05, -0.12), (7.8, -0.03), (7.55, -0.1)], count=5),
    closed=False,
)
SPOTS = [diamond(*d) for d in DIAMONDS]
SNAKE = [UPPER, LOWER, *FACE, *TONGUE, *SPOTS, Stroke(CHEVRON.points, width=0.7)]
OUTLINE = np.vstack([UPPER.points, LOWER.points[::-1]])

#: A long thin region needs more points.
OPTIONS = {"query_points": 120}

SMALL = along([(1.1, 8.3), (2.6, 8.7), (4.1, 8.5), (5.7, 8.7), (7.1, 9.1)], 0.0, 9.3)
LARGE = along(
    [(1.0, 5.0), (3.4, 5.9), (6.4, 5.3), (9.6, 6.3), (12.4, 6.9), (15.0, 8.0)], 0.0, 9.3, (0.85, 0.9, 1.0, 1.1)
)
WINDING = along(
    [(0.9, 1.3), (3.0, 0.8), (4.6, 1.9), (5.3, 3.5), (7.2, 3.8), (8.5, 2.3), (10.2, 1.2), (12.1, 2.2), (13.1, 4.1),
     (14.7, 4.6)],
    0.0, 9.3, (0.8, 0.9, 1.0, 1.05),
)  # fmt: skip


def lasso() -> Array:
    """A ring round a snake, round at the tip of the tail and before the tongue."""
    x = -0.25 + 10.2 * 0.5 * (1.0 - np.cos(np.linspace(0.0, np.pi, 90)))
    y = np.interp(x, UPPER.points[:, 0], UPPER.points[:, 1])
    y += 0.14 * np.sqrt(np.clip(np.minimum(x + 0.25, 9.95 - x) / 0.25, 0.0, 1.0))
    upper = np.column_stack([x, y])
    return np.vstack([upper, upper[-2:0:-1] * (1.0, -1.0)])


def skin(points: Array) -> Array:
    """Green scales, yellow below."""
    x, y = points.T
    half = np.interp(x, UPPER.points[:, 0], UPPER.points[:, 1])
    across = np.abs(y) / np.maximum(half, 1e-6)
    colour = mixed((0.24, 0.5, 0.2), (0.8, 0.78, 0.36), step(across, 0.72, 0.5))
    row = np.floor(y / 0.075)
    u = (x / 0.11 + 0.5 * (row % 2)) % 1.0 - 0.5
    v = y / 0.075 - row - 0.5
    colour = over(colour, (0.1, 0.27, 0.14), 0.45 * (np.hypot(u, v) > 0.5))
    colour = over(colour, (1.0, 1.0, 0.8), 0.18 * step(0.25 - np.abs(across - 0.3), 0.0, 0.3))
    tongue = x > 9.24
    colour = np.where(tongue[:, None], (0.8, 0.1, 0.15), colour)
    eye = np.hypot((x - 8.62) / 0.09, (np.abs(y) - 0.19) / 0.07)
    colour = over(colour, (0.98, 0.85, 0.2), eye < 1.0)
    colour = over(colour, (0.05, 0.05, 0.05), (eye < 1.0) & (np.abs(x - 8.62) < 0.022))
    return with_alpha(colour, within(OUTLINE)(points))


def pattern(points: Array) -> Array:
    """Dark diamonds with a red heart."""
    x, y = points.T
    inside = np.max([within(s.polyline())(points) for s in SPOTS], axis=0)
    inside = np.maximum(inside, within(np.vstack([CHEVRON.points, CHEVRON.points[:1]]))(points))
    heart = np.min([np.hypot((x - at) / a, y / b) for at, a, b in DIAMONDS], axis=0)
    colour = mixed((0.85, 0.25, 0.08), (0.22, 0.08, 0.06), step(heart, 0.42, 0.15))
    return with_alpha(colour, inside)


def desert(points: Array) -> Array:
    """Sand with ripples, and the sky's light from above."""
    x, y = points.T
    colour = mixed((0.93, 0.76, 0.5), (0.99, 0.92, 0.76), y / 10.0)
    ripple = np.sin(6.0 * y + 1.1 * np.sin(0.8 * x) + 0.5 * np.sin(2.1 * x + y))
    colour = over(colour, (0.8, 0.58, 0.36), 0.16 * step(ripple, 0.6, 0.8))
    for a, b, r in ((10.6, 8.9, 0.5), (1.3, 4.9, 0.4), (15.1, 1.2, 0.6), (6.6, 3.4, 0.3)):
        stone = np.hypot((x - a) / 1.4, y - b)
        colour = over(colour, (0.62, 0.5, 0.4), 0.7 * step(r - stone, 0.0, 0.1))
        colour = over(
            colour, (0.82, 0.72, 0.6), 0.7 * step(0.6 * r - np.hypot((x - a + 0.2) / 1.4, y - b - 0.14), 0, 0.2)
        )
    return with_alpha(colour, np.ones(len(points)))


def picture() -> Picture:
    """Three snakes."""
    hand = np.random.default_rng(31)
    strokes = [s for w in (SMALL, LARGE, WINDING) for s in by_hand([s.warped(w) for s in SNAKE], 0.006, hand)]
    home = inverse(SMALL, (-0.2, -0.6), (10.0, 0.6))
    ring = SMALL(lasso())
    truth = [then(home, LARGE), then(home, WINDING)]
    return Picture(
        "snakes",
        "3.1",
        strokes,
        [
            Edit("skin", ring, lambda p: skin(home(p)), truth, pixels=900, options=OPTIONS),
            Edit("pattern", ring, lambda p: pattern(home(p)), truth, pixels=900, options=OPTIONS),
        ],
        desert,
        (0.0, 0.0),
        (16.0, 10.0),
        pen=0.016,
    )
