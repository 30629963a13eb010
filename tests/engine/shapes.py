"""Named shapes with known measures, shared by all tests of the engine. Rings are counter-clockwise, in scene units."""

import numpy as np


def ring(*vertices):
    """A ring from its vertices."""
    return np.array(vertices, dtype=np.float64)


def regular(count, radius=1.0, centre=(0.0, 0.0), start=0.0):
    """A regular polygon of `count` vertices."""
    angles = start + 2 * np.pi * np.arange(count) / count
    return np.stack([np.cos(angles), np.sin(angles)], axis=1) * radius + centre


def rectangle(width, height, corner=(0.0, 0.0)):
    """An axis-aligned rectangle from its lower left corner."""
    return np.array([(0, 0), (width, 0), (width, height), (0, height)], dtype=np.float64) + corner


def comb(teeth, width=1.0, depth=1.0):
    """A bar with teeth upwards; every tooth and every gap is `width` wide."""
    outline = [(0.0, -width), ((2 * teeth - 1) * width, -width)]
    for tooth in reversed(range(teeth)):
        left = 2 * tooth * width
        outline += [(left + width, depth), (left, depth)]
        if tooth:
            outline += [(left, 0.0), (left - width, 0.0)]
    return np.array(outline)


def star(points, outer=1.0, inner=0.4):
    """A star; its inner corners are reflex."""
    outline = regular(2 * points, 1.0)
    outline[::2] *= outer
    outline[1::2] *= inner
    return outline


def bay(edges=32, radius=1.5):
    """A room 3 long and `2 * radius` wide; its right wall is a half round that the straight walls run into smoothly."""
    angles = np.linspace(-np.pi / 2, np.pi / 2, edges + 1)
    arc = np.stack([3 + radius * np.cos(angles), radius + radius * np.sin(angles)], axis=1)
    return np.vstack([[(0.0, 0.0)], arc, [(0.0, 2 * radius)]])


UNIT_SQUARE = rectangle(1, 1)
#: 5 by 4 metres without the upper right 2 by 2; one reflex corner, vertex 3.
L_ROOM = ring((0, 0), (5, 0), (5, 2), (3, 2), (3, 4), (0, 4))
#: 4 by 3 metres with a bevel of one metre at the upper right.
BEVELLED_ROOM = ring((0, 0), (4, 0), (4, 2), (3, 3), (0, 3))
#: 64 edges: no corners.
CIRCLE = regular(64, radius=2.0)
#: A wall runs smoothly into the half round; two corners at the left.
BAY_ROOM = bay()
#: One corner only, at the tip: a smooth segment that starts and ends there.
TEARDROP = np.vstack([[(-3.0, 0.0)], regular(64, start=-1.9106332362490186)[np.arange(40)]])
#: 4 by 3 metres with a window niche of 5 centimetres in the upper wall.
NICHE_ROOM = ring((0, 0), (4, 0), (4, 3), (2.5, 3), (2.5, 3.05), (1.5, 3.05), (1.5, 3), (0, 3))
#: A door leaf, 10 centimetres thick.
DOOR = rectangle(0.9, 0.1)
COMB = comb(5)
STAR = star(5)
#: 4 by 4 metres with a courtyard of 2 by 1.
HOLED_ROOM = rectangle(4, 4)
COURTYARD = rectangle(2, 1, (1.0, 1.5))

#: Name, ring, number of corners and of segments.
CATALOGUE = [
    ("unit square", UNIT_SQUARE, 4, 4),
    ("L room", L_ROOM, 6, 6),
    ("bevelled room", BEVELLED_ROOM, 5, 5),
    ("circle", CIRCLE, 0, 1),
    ("bay room", BAY_ROOM, 2, 2),
    ("teardrop", TEARDROP, 1, 1),
    ("niche room", NICHE_ROOM, 8, 8),
    ("door", DOOR, 4, 4),
    ("comb", COMB, 20, 20),
    ("star", STAR, 10, 10),
    ("octagon", regular(8), 8, 8),
    ("dodecagon", regular(12), 0, 1),
]


def drawn(outline, noise, spacing, seed, across=True):
    """An outline as a trembling hand or a scanner draws it.

    Vertices every `spacing`, displaced by normal deviations of `noise`, both in units of the square root of the
    area; `across` the line only, else in any direction.
    """
    rng = np.random.default_rng(seed)
    following = np.roll(outline, -1, axis=0)
    x, y = (outline - outline[0]).T
    size = np.sqrt(abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) / 2)
    vertices = []
    for a, b in zip(outline, following, strict=True):
        length = np.hypot(*(b - a))
        share = np.arange(count := max(1, round(length / (spacing * size)))) / count
        normal = np.array([b[1] - a[1], a[0] - b[0]]) / length
        tremor = rng.normal(size=(count, 1)) * normal if across else rng.normal(size=(count, 2))
        vertices.append(a + share[:, None] * (b - a) + noise * size * tremor)
    return np.vstack(vertices)
