"""A sun in three operations (figure 3.7i): its wavy rays, its pointed rays, and its eyes."""

from __future__ import annotations

import numpy as np

from .lines import Array, Warp, along, by_hand, curve, ellipse, inverse, joined, then
from .picture import Edit, Picture, mixed, over, step, with_alpha, within

MIDDLE = np.array([8.0, 5.0])

#: A tongue of fire along x with a curl inside.
FLAME = joined(
    curve([(0, 0.44), (0.35, 0.28), (0.75, 0.34), (1.15, 0.2), (1.55, 0.22), (2.05, 0.1)], count=24),
    curve([(2.05, 0.1), (1.6, 0.02), (1.25, -0.06), (0.85, -0.02), (0.42, -0.22), (0, -0.4)], count=24),
    closed=False,
)
FIRE = [
    FLAME,
    curve([(0.1, 0.12), (0.5, 0.05), (0.9, 0.16), (1.3, 0.08)], count=12, width=0.7),
    curve([(0.12, -0.1), (0.4, -0.06), (0.55, 0.0)], count=6, width=0.7),
    curve([(0.3, 0.2), (0.42, 0.13), (0.36, 0.08)], count=5, width=0.7),
]

#: A pointed ray with a ridge and notches.
SPIKE = joined(
    curve([(0, 0.34), (0.25, 0.3), (0.42, 0.2)], count=7),
    curve([(0.42, 0.2), (0.5, 0.27), (1.1, 0.1), (1.6, 0.0)], count=12),
    curve([(1.6, 0.0), (1.1, -0.1), (0.5, -0.27), (0.42, -0.2)], count=12),
    curve([(0.42, -0.2), (0.25, -0.3), (0, -0.34)], count=7),
    closed=False,
)
DART = [
    SPIKE,
    curve([(0.06, 0.0), (0.6, 0.015), (1.2, 0.0)], count=8, width=0.7),
    curve([(0.42, 0.2), (0.34, 0.08), (0.42, 0.0)], count=6, width=0.7),
    curve([(0.42, -0.2), (0.34, -0.08), (0.42, 0.0)], count=6, width=0.7),
]

#: An eye with its lid, iris and lashes; the other one mirrors it.
EYE = joined(
    curve([(-0.55, -0.06), (-0.2, 0.26), (0.2, 0.28), (0.58, 0.02)], count=12),
    curve([(0.58, 0.02), (0.2, -0.16), (-0.2, -0.2), (-0.55, -0.06)], count=12),
)
EYES = [
    EYE,
    ellipse(0.03, 0.05, 0.17, count=14),
    ellipse(0.05, 0.07, 0.07, count=10),
    curve([(-0.6, 0.22), (-0.15, 0.5), (0.35, 0.46), (0.62, 0.26)], count=12),
    *(curve([(x, y), (1.25 * x + 0.12, 1.3 * y + 0.04)], count=4, width=0.7)
      for x, y in ((0.58, 0.02), (0.46, 0.15), (0.3, 0.24))),
    curve([(-0.3, -0.3), (0.0, -0.36), (0.3, -0.3)], count=6, width=0.7),
]  # fmt: skip


def ray(turn: float, reach: float, bend: float, side: float, end: float) -> Warp:
    """A ray that leaves the disc at an angle, as long as ``reach``, and bends."""
    out = np.array([np.cos(turn), np.sin(turn)])
    across = np.array([-out[1], out[0]])
    root = MIDDLE + 2.2 * out
    length = end * reach
    spine = [root + out * length * t + across * bend * t**2 * length for t in (0.0, 0.33, 0.66, 1.0)]
    return along(spine, 0.0, end, (1.0, 1.0), side)


FLAMES = [ray(np.radians(45 * i + 90), r, b, s, 2.05) for i, (r, b, s) in enumerate(
    [(1.05, 0.05, 1), (1.1, 0.35, 1), (0.95, -0.3, -1), (1.15, 0.25, 1), (0.9, -0.15, -1), (1.1, 0.4, 1),
     (1.0, -0.35, -1), (1.1, 0.2, 1)]
)]  # fmt: skip
DARTS = [ray(np.radians(45 * i + 112.5), r, b, s, 1.6) for i, (r, b, s) in enumerate(
    [(0.95, 0.0, 1), (1.1, 0.3, 1), (0.9, -0.35, 1), (1.05, 0.2, 1), (1.15, -0.2, 1), (0.9, 0.3, 1), (1.0, -0.3, 1),
     (1.1, 0.1, 1)]
)]  # fmt: skip
GAZES: list[Warp] = [
    lambda p: np.asarray(p) * (-0.85, 0.85) + MIDDLE + (-0.8, 0.5),
    lambda p: np.asarray(p) * (0.8, 0.85) + MIDDLE + (0.82, 0.46),
]
FACE = [
    ellipse(8.0, 5.0, 2.0, count=36),
    curve([(8.0, 5.75), (7.78, 5.05), (7.85, 4.82), (8.12, 4.8)], count=12),
    joined(
        curve([(7.3, 4.3), (7.65, 4.22), (8.0, 4.3), (8.4, 4.2), (8.75, 4.32)], count=16),
        curve([(8.75, 4.32), (8.4, 3.85), (8.0, 3.75), (7.6, 3.88), (7.3, 4.3)], count=16),
    ),
]


def fire(points: Array) -> Array:
    """From red at the root to yellow at the tip."""
    x, y = points.T
    colour = mixed((0.8, 0.12, 0.06), (1.0, 0.78, 0.12), x / 1.9)
    lick = y - 0.1 * np.sin(5.5 * x + 0.6) + 0.02
    colour = over(colour, (1.0, 0.92, 0.45), 0.8 * step(0.07 - np.abs(lick), 0.0, 0.06) * (x < 1.6))
    colour = over(colour, (0.6, 0.05, 0.05), 0.5 * step(np.abs(y - 0.03) - 0.22 + 0.06 * x, 0.05, 0.1))
    return with_alpha(colour, within(np.vstack([FLAME.points, FLAME.points[:1]]))(points))


def dart(points: Array) -> Array:
    """Gold, one side of the ridge in shadow."""
    x, y = points.T
    colour = mixed((0.95, 0.6, 0.08), (1.0, 0.9, 0.4), step(y, 0.0, 0.05))
    colour = over(colour, (0.75, 0.36, 0.04), 0.85 * step(0.42 - x, 0.0, 0.04))
    colour = over(colour, (1.0, 0.98, 0.75), 0.8 * step(0.05 - np.hypot(x - 0.22, np.abs(y) - 0.15), 0, 0.03))
    colour = over(colour, (0.85, 0.45, 0.05), 0.4 * (np.sin(30 * (x + np.abs(y))) > 0.6) * (x > 0.45))
    return with_alpha(colour, within(np.vstack([SPIKE.points, SPIKE.points[:1]]))(points))


def gaze(points: Array) -> Array:
    """White, a blue iris with rays, a shadow under the lid."""
    x, y = points.T
    colour = mixed((0.8, 0.86, 0.95), (1.0, 1.0, 1.0), step(0.16 - y, 0.0, 0.12))
    r, a = np.hypot(x - 0.03, y - 0.05), np.arctan2(y - 0.05, x - 0.03)
    iris = mixed((0.1, 0.25, 0.6), (0.35, 0.65, 0.9), 0.5 + 0.5 * np.sin(14 * a))
    colour = np.where((r < 0.17)[:, None], iris, colour)
    colour = over(colour, (0.03, 0.03, 0.08), np.hypot(x - 0.05, y - 0.07) < 0.07)
    colour = over(colour, (1.0, 1.0, 1.0), np.hypot(x - 0.0, y - 0.12) < 0.035)
    lid = within(np.vstack([EYE.points[:12], EYES[3].points[::-1]]))(points)
    colour = np.where((lid > 0)[:, None], mixed((0.95, 0.5, 0.2), (0.8, 0.3, 0.25), (x + 0.6) / 1.2), colour)
    return with_alpha(colour, np.maximum(within(EYE.polyline())(points), lid))


def sky(points: Array) -> Array:
    """Dusk with stars; the plain colour of the disc."""
    x, y = points.T
    colour = mixed((0.16, 0.2, 0.45), (0.06, 0.08, 0.25), y / 10.0)
    glow = np.hypot(x - MIDDLE[0], y - MIDDLE[1])
    colour = over(colour, (0.55, 0.3, 0.5), 0.8 * np.exp(-((glow / 4.2) ** 4)))
    for i in range(40):
        a, b = (0.1 + 0.618 * i) % 1.0 * 16.0, (0.3 + 0.387 * i) % 1.0 * 10.0
        star = np.abs(x - a) ** 0.6 + np.abs(y - b) ** 0.6
        colour = over(colour, (1.0, 0.96, 0.8), (star < 0.14 + 0.04 * (i % 3)) & (np.hypot(a - 8, b - 5) > 4.6))
    disc = mixed((1.0, 0.72, 0.16), (1.0, 0.88, 0.4), 0.5 + (y - 5.0) / 4.0 - (x - 8.0) / 8.0)
    colour = np.where((glow < 2.0)[:, None], disc, colour)
    mouth = within(FACE[-1].polyline())(points)
    colour = over(colour, (0.75, 0.12, 0.12), mouth)
    return with_alpha(colour, np.ones(len(points)))


def picture() -> Picture:
    """Sixteen rays and a face."""
    hand = np.random.default_rng(37)
    strokes = list(FACE)
    for shape, places in ((FIRE, FLAMES), (DART, DARTS), (EYES, GAZES)):
        strokes += [s for w in places for s in by_hand([k.warped(w) for k in shape], 0.006, hand)]
    edits = []
    # A ray is open at the disc: its root stays outside the query, so that the disc does too.
    rings = (
        np.array(
            [(0.05, 0.55), (0.6, 0.46), (1.6, 0.32), (2.2, 0.2), (2.2, 0.0), (1.6, -0.12), (0.7, -0.22), (0.05, -0.5)]
        ),
        np.array(
            [
                (0.05, 0.42),
                (0.5, 0.36),
                (1.2, 0.18),
                (1.72, 0.06),
                (1.72, -0.06),
                (1.2, -0.18),
                (0.5, -0.36),
                (0.05, -0.42),
            ]
        ),
        ellipse(0.06, 0.06, 0.86, 0.58, count=28).points,
    )
    for name, ring, places, paint, box in (
        ("flames", rings[0], FLAMES, fire, ((-0.2, -0.8), (2.5, 0.8))),
        ("darts", rings[1], DARTS, dart, ((-0.2, -0.6), (2.0, 0.6))),
        ("eyes", rings[2], GAZES, gaze, ((-1.0, -0.8), (1.0, 0.8))),
    ):
        home = inverse(places[0], *box)
        dense = curve(ring, True, 60).points if name == "eyes" else ring
        dense = np.vstack(
            [a + (b - a) * t for a, b in zip(dense, np.roll(dense, -1, 0), strict=True) for t in (0, 0.5)]
        )
        edits.append(
            Edit(
                name,
                places[0](dense),
                lambda p, home=home, paint=paint: paint(home(p)),
                [then(home, w) for w in places[1:]],
                # Mirrored, a dart looks nearly the same.
                options={"mirrored": name != "darts"},
                pixels=320,
            )
        )
    return Picture("sun", "3.7i", strokes, edits, sky, (0.0, 0.0), (16.0, 10.0))
