"""Coherent point drift: pycpd's deformable registration, from several directions, the best fit kept."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

#: Rotations that are tried, and iterations of each.
DIRECTIONS, ITERATIONS = 8, 100


def register(source: Array, target: Array) -> Callable[[Array], Array]:
    """Register two point sets with pycpd; points of the source's plane to points of the target's.

    Parameters
    ----------
    source, target : (n, 2) and (m, 2) float
    """
    from pycpd import DeformableRegistration

    x0, y0 = source.mean(0), target.mean(0)
    sx, sy = (np.sqrt(((p - p.mean(0)) ** 2).sum(1).mean()) for p in (source, target))
    goal = (target - y0) / sy
    best: tuple[float, Array, Array, Array] | None = None
    for angle in 2.0 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS:
        turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
        start = (source - x0) / sx @ turn
        fit = DeformableRegistration(X=goal, Y=start, alpha=1.0, beta=1.0, max_iterations=ITERATIONS)
        fit.register()
        moved = start + _kernel(start, start, fit.beta) @ fit.W
        gap = np.linalg.norm(moved[:, None] - goal[None], axis=2)
        miss = float(gap.min(1).mean() + gap.min(0).mean())
        if best is None or miss < best[0]:
            best = miss, turn, start, fit.W
    assert best is not None
    _, turn, start, weights = best

    def carry(points: Array) -> Array:
        p = (np.asarray(points, float) - x0) / sx @ turn
        return (p + _kernel(p, start, 1.0) @ weights) * sy + y0

    return carry


def _kernel(a: Array, b: Array, width: float) -> Array:
    """Gaussian kernel."""
    return np.exp(-((a[:, None] - b[None]) ** 2).sum(2) / (2.0 * width**2))
