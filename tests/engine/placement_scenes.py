"""Facades, rooms and other scenes for the tests of placements."""

import numpy as np

import geoanalogy as ga


def box(x, y, width, height):
    """A ring from its least corner."""
    return [(x, y), (x + width, y), (x + width, y + height), (x, y + height)]


def polygon(x, y, width, height, label, id=None, **more):
    return ga.Polygon(box(x, y, width, height), label, id, **more)


def facade(x, columns, rows, window=1.2, spacing=3.0, name="f", door=True):
    """A facade with a grid of windows and a door in the middle, its left edge at x."""
    width, height = columns * spacing + 1.0, rows * 3.0 + 3.0
    polygons = [polygon(x, 0, width, height, "facade", name)]
    for i in range(columns):
        for j in range(rows):
            polygons.append(polygon(x + 1.4 + spacing * i, 3.5 + 3 * j, window, 1.5, "window", f"{name} {i} {j}"))
    if door:
        polygons.append(polygon(x + width / 2 - 0.6, 0, 1.2, 2.2, "door", f"{name} door"))
    return polygons


def below(scene, id, gap=0.2, height=0.2, overhang=0.1):
    """The rectangle of a sill below a window."""
    x0, y0, x1, _ = scene.polygon(id).bounds
    return ga.Rectangle((x0 + x1) / 2, y0 - gap + height / 2, x1 - x0 + 2 * overhang, height)


def values(placements):
    """(n, 5) x, y, width, height, angle, sorted by place."""
    rows = np.array(
        [(p.rectangle.x, p.rectangle.y, p.rectangle.width, p.rectangle.height, p.rectangle.angle) for p in placements]
    ).reshape(-1, 5)
    return rows[np.lexsort(np.round(rows[:, 1::-1].T, 6))]


def overlap(a, b):
    """Shared area over united area of two upright rectangles."""
    low = np.maximum([a.x - a.width / 2, a.y - a.height / 2], [b.x - b.width / 2, b.y - b.height / 2])
    high = np.minimum([a.x + a.width / 2, a.y + a.height / 2], [b.x + b.width / 2, b.y + b.height / 2])
    shared = np.prod(np.clip(high - low, 0, None))
    return shared / (a.area + b.area - shared)
