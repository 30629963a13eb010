"""Non-rigid registration by a robust L2 estimator: L2E of figure 3.9.

After Ma, Zhao, Tian, Tu and Yuille, "Robust estimation of nonrigid transformation for point set registration" (2013).
Two steps alternate: points are matched one to one by their shape contexts (Hungarian method), and the transformation,
the identity and a function of a reproducing kernel Hilbert space, is estimated from the matches by minimising the L2
distance between their residuals and a Gaussian, whose width is annealed, so that wrong matches count for nothing.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment, minimize

Array = NDArray[np.float64]

#: Of the paper: width of the kernel, weight of the smoothness, first variance and its annealing, control points.
BETA, SMOOTHNESS, VARIANCE, ANNEALING, CONTROLS = 0.8, 0.1, 0.05, 0.5, 15
#: Rounds of matching, and annealing steps in each.
ROUNDS, STEPS = 10, 4
#: Log-polar bins, and their least and greatest radius in mean distances.
RINGS, SECTORS, INNERMOST, OUTERMOST = 5, 12, 0.125, 2.0


def shape_contexts(points: Array, others: Array | None = None) -> Array:
    """Histograms of where the other points are, (n, RINGS * SECTORS), each with sum 1.

    The unit of length is the mean distance of the points; the direction of a context is that from its centre to the
    centre of mass, as the thesis says of this method.
    """
    others = points if others is None else others
    way = others[None] - points[:, None]
    distance = np.hypot(way[..., 0], way[..., 1])
    unit = distance[distance > 0.0].mean()
    towards = others.mean(0) - points
    angle = np.arctan2(way[..., 1], way[..., 0]) - np.arctan2(towards[:, 1], towards[:, 0])[:, None]
    edges = np.geomspace(INNERMOST, OUTERMOST, RINGS + 1)[1:] * unit
    ring = np.searchsorted(edges, distance)
    sector = np.floor((angle % (2 * np.pi)) / (2 * np.pi) * SECTORS).astype(int) % SECTORS
    seen = (distance > 0.0) & (ring < RINGS)
    out = np.zeros((len(points), RINGS * SECTORS))
    row = np.broadcast_to(np.arange(len(points))[:, None], ring.shape)
    np.add.at(out, (row[seen], ring[seen] * SECTORS + sector[seen]), 1.0)
    return out / np.maximum(out.sum(1, keepdims=True), 1.0)


def matched(source: Array, target: Array) -> NDArray[np.intp]:
    """The target's point of each source point, -1 without one, by the chi-squared distance of shape contexts."""
    a, b = shape_contexts(source), shape_contexts(target)
    cost = np.empty((len(a), len(b)))
    for i, row in enumerate(a):
        cost[i] = ((row - b) ** 2 / np.maximum(row + b, 1e-12)).sum(1)
    out = np.full(len(a), -1)
    rows, columns = linear_sum_assignment(cost)
    out[rows] = columns
    return out


def _kernel(a: Array, b: Array) -> Array:
    """Gaussian kernel."""
    return np.exp(-BETA * ((a[:, None] - b[None]) ** 2).sum(2))


def _estimated(basis: Array, gram: Array, source: Array, target: Array, weights: Array, variance: float) -> Array:
    """Coefficients (c, 2) of the transformation that minimises the L2 estimator at one variance."""

    def value(flat: Array) -> tuple[float, Array]:
        c = flat.reshape(-1, 2)
        miss = target - source - basis @ c
        close = np.exp(-(miss**2).sum(1) / (2.0 * variance)) / (2.0 * np.pi * variance)
        smooth = gram @ c
        energy = -2.0 / len(source) * close.sum() + SMOOTHNESS * float((c * smooth).sum())
        slope = -2.0 / (len(source) * variance) * basis.T @ (close[:, None] * miss) + 2.0 * SMOOTHNESS * smooth
        return energy, slope.ravel()

    return minimize(value, weights.ravel(), jac=True, method="BFGS", options={"maxiter": 40}).x.reshape(-1, 2)


def register(source: Array, target: Array, seed: int = 0) -> Callable[[Array], Array]:
    """Register two point sets.

    Parameters
    ----------
    source, target : (n, 2) and (m, 2) float

    Returns
    -------
    callable
        Points of the source's plane to points of the target's.
    """
    x0, y0 = source.mean(0), target.mean(0)
    sx, sy = (np.sqrt(((p - p.mean(0)) ** 2).sum(1).mean()) for p in (source, target))
    x, y = (source - x0) / sx, (target - y0) / sy
    layers: list[tuple[Array, Array]] = []
    moved = x.copy()
    rng = np.random.default_rng(seed)
    variance = VARIANCE
    for _ in range(ROUNDS):
        to = matched(moved, y)
        has = to >= 0
        control = moved[rng.choice(len(moved), min(CONTROLS, len(moved)), replace=False)]
        basis, gram = _kernel(moved[has], control), _kernel(control, control)
        weights = np.zeros((len(control), 2))
        width = variance
        for _ in range(STEPS):
            weights = _estimated(basis, gram, moved[has], y[to[has]], weights, width)
            width *= ANNEALING
        layers.append((control, weights))
        moved = moved + _kernel(moved, control) @ weights

    def carry(points: Array) -> Array:
        p = (np.asarray(points, float) - x0) / sx
        for control, weights in layers:
            p = p + _kernel(p, control) @ weights
        return p * sy + y0

    return carry
