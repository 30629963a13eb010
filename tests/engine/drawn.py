"""Lines as an illustrator draws them, for the tests of matching regions."""

import numpy as np
from scipy.interpolate import CubicSpline

FISH = np.array(
    [
        (0.00, 0.02),
        (0.10, 0.12),
        (0.26, 0.20),
        (0.38, 0.33),
        (0.50, 0.21),
        (0.66, 0.13),
        (0.80, 0.06),
        (1.00, 0.22),
        (0.93, 0.02),
        (0.97, -0.12),
        (0.80, -0.02),
        (0.62, -0.11),
        (0.52, -0.20),
        (0.46, -0.14),
        (0.24, -0.14),
        (0.08, -0.07),
    ]
)


def closed(points):
    """A line that ends where it begins."""
    p = np.asarray(points, float)
    return np.vstack([p, p[:1]])


def rounded(points, count=160):
    """A closed smooth line through points."""
    p = closed(points)
    t = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(p, axis=0), axis=1))])
    line = CubicSpline(t, p, bc_type="periodic")(np.linspace(0.0, t[-1], count, endpoint=False))
    return closed(line)


def fish():
    """A fish that heads left, about 1 long: the closed outline and two open lines, its gill and its lateral line."""
    gill = np.array([(0.22, 0.13), (0.25, 0.06), (0.25, -0.02), (0.22, -0.08)])
    side = np.array([(0.32, 0.04), (0.45, 0.06), (0.60, 0.04), (0.72, 0.03)])
    return [rounded(FISH), gill, side]


def bent(points, angle):
    """The plane bent about the y direction: what lies on 0 <= x <= 1 becomes an arc that turns by `angle`."""
    p = np.asarray(points, float)
    radius = 1.0 / angle
    turn = p[:, 0] * angle
    return np.stack([(radius - p[:, 1]) * np.sin(turn), radius - (radius - p[:, 1]) * np.cos(turn)], 1)


def moved(points, scale=1.0, angle=0.0, shift=(0.0, 0.0), mirrored=False):
    """A similarity."""
    p = np.asarray(points, float) * ((1.0, -1.0) if mirrored else (1.0, 1.0))
    c, s = np.cos(angle), np.sin(angle)
    return scale * p @ np.array([[c, s], [-s, c]]) + shift


def clutter(rng, count, low=(-1.0, -2.0), high=(4.0, 2.0)):
    """Open wavy lines."""
    out = []
    for _ in range(count):
        steps = np.cumsum(rng.normal(0.0, 0.5, 30))
        walk = np.cumsum(0.05 * np.stack([np.cos(0.2 * steps), np.sin(0.2 * steps)], 1), axis=0)
        out.append(walk + rng.uniform(low, high))
    return out


def box(lines, margin=0.05):
    """A ring round lines."""
    every = np.concatenate(lines)
    (x0, y0), (x1, y1) = every.min(0) - margin, every.max(0) + margin
    return np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])


def inner_points(count=60):
    """Points inside the fish."""
    rng = np.random.default_rng(5)
    p = rng.uniform((0.05, -0.12), (0.95, 0.2), (40 * count, 2))
    import shapely

    return p[shapely.contains_xy(shapely.Polygon(FISH), p[:, 0], p[:, 1])][:count]
