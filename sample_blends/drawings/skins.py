"""Two snakes with a fine, repeating pattern on their skins (figure 3.7f)."""

from __future__ import annotations

import numpy as np

from .lines import Array, Stroke, along, by_hand, curve, inverse, joined, then
from .picture import Edit, Picture, mixed, over, step, with_alpha, within
from .snakes import FACE, LOWER, OPTIONS, OUTLINE, TONGUE, UPPER, desert, lasso

#: Where the rings of the skin lie; between them run zigzags with dots, all much alike.
RINGS = np.concatenate([np.arange(1.2, 7.5, 0.55), [7.75]])


def half(x: float) -> float:
    """Half the width of the body."""
    return float(np.interp(x, UPPER.points[:, 0], UPPER.points[:, 1]))


def skin_lines() -> list[Stroke]:
    """Rings across, and a zigzag and a dot between two of them."""
    lines = []
    for i, x in enumerate(RINGS):
        w = 0.94 * half(x)
        lines.append(curve([(x - 0.05, w), (x + 0.05, 0.0), (x - 0.05, -w)], count=6, width=0.7))
        if i + 1 < len(RINGS):
            a, b = x + 0.13, x + 0.42
            h = 0.6 * half(x + 0.3)
            lines.append(
                joined(
                    curve([(a, h), ((a + b) / 2 + 0.05, 0.6 * h), (b, 0.0)], count=5, width=0.7),
                    curve([(b, 0.0), ((a + b) / 2 + 0.05, -0.6 * h), (a, -h)], count=5, width=0.7),
                    closed=False,
                )
            )
            dot = 0.07 + 0.02 * (i % 3)
            lines.append(
                joined(
                    curve([(a - 0.02, 0.0), (a + 0.06, dot), (a + 0.16, 0.0)], count=4, width=0.6),
                    curve([(a + 0.16, 0.0), (a + 0.06, -dot), (a - 0.02, 0.0)], count=4, width=0.6),
                )
            )
    return lines


SKIN = skin_lines()
SNAKE = [UPPER, LOWER, *FACE, *TONGUE, *SKIN]
FIRST = along([(0.9, 5.9), (3.0, 7.4), (5.6, 7.5), (8.3, 8.7), (11.0, 9.1)], 0.0, 9.3)
SECOND = along([(15.2, 1.2), (12.4, 1.0), (9.4, 2.2), (6.3, 2.6), (3.2, 1.6), (0.8, 3.0)], 0.0, 9.3, (0.95, 1.0, 1.05))


def paint(points: Array) -> Array:
    """Blue-green rings with gold zigzags and dots."""
    x, y = points.T
    width = np.interp(x, UPPER.points[:, 0], UPPER.points[:, 1])
    across = np.abs(y) / np.maximum(width, 1e-6)
    number = np.clip(np.searchsorted(RINGS, x + 0.05 * (1 - 2 * across)), 0, len(RINGS))
    colour = np.where((number % 2 == 0)[:, None], (0.08, 0.4, 0.42), (0.16, 0.56, 0.45)) * np.ones((len(points), 3))
    colour = over(colour, (0.8, 0.86, 0.55), step(across, 0.82, 0.3))
    zigzag = np.max(
        [within(np.vstack([s.points, s.points[:1]]))(points) for s in SKIN if not s.closed and len(s.points) > 6], 0
    )
    colour = over(colour, (0.9, 0.68, 0.2), zigzag)
    dots = np.max([within(s.polyline())(points) for s in SKIN if s.closed], axis=0)
    colour = over(colour, (0.55, 0.12, 0.1), dots)
    head = x > 7.8
    colour = np.where(head[:, None], mixed((0.08, 0.36, 0.36), (0.5, 0.7, 0.45), step(across, 0.7, 0.5)), colour)
    eye = np.hypot((x - 8.62) / 0.09, (np.abs(y) - 0.19) / 0.07)
    colour = over(colour, (0.98, 0.8, 0.15), eye < 1.0)
    colour = over(colour, (0.05, 0.05, 0.05), (eye < 1.0) & (np.abs(x - 8.62) < 0.022))
    return with_alpha(colour, within(OUTLINE)(points))


def picture() -> Picture:
    """Two snakes."""
    hand = np.random.default_rng(76)
    strokes = [s for w in (FIRST, SECOND) for s in by_hand([k.warped(w) for k in SNAKE], 0.006, hand)]
    home = inverse(FIRST, (-0.2, -0.6), (10.0, 0.6))
    ring = FIRST(lasso())
    return Picture(
        "skins",
        "3.7f",
        strokes,
        [Edit("skin", ring, lambda p: paint(home(p)), [then(home, SECOND)], pixels=700, options=OPTIONS)],
        desert,
        (0.0, 0.0),
        (16.0, 10.0),
        pen=0.016,
    )
