"""Curves of drawing formats as runs of cubic Béziers, and how they become edges.

Everything a file can draw becomes cubics first, is transformed by its control points, and is flattened last: a circle
in a group that is stretched tenfold is still smooth. A run is an array of shape (k, 4, 2), the control points of k
cubics, each starting where the one before it ends.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..tolerances import CURVE_TURN, SMALLEST_CURVE

Run = NDArray[np.float64]
Points = NDArray[np.float64]

#: Each cubic of an arc spans at most this angle: its radius is then exact to four millionths.
_ARC_STEP = np.pi / 4
#: Halvings of a cubic: enough for a full turn in edges of `CURVE_TURN`, a bound for cusps.
_DEPTH = 12


def straight(points: ArrayLike) -> Run:
    """A polyline as a run.

    Parameters
    ----------
    points : array_like of shape (n, 2), n >= 1

    Returns
    -------
    ndarray of shape (n - 1, 4, 2)
    """
    p = np.asarray(points, dtype=np.float64).reshape(-1, 2)
    return np.stack([p[:-1], p[:-1], p[1:], p[1:]], axis=1)


def quadratic(start: ArrayLike, control: ArrayLike, end: ArrayLike) -> Run:
    """A quadratic Bézier as a run of one cubic.

    Parameters
    ----------
    start, control, end : array_like of shape (2,)

    Returns
    -------
    ndarray of shape (1, 4, 2)
    """
    a, b, c = (np.asarray(p, dtype=np.float64) for p in (start, control, end))
    return np.array([[a, a + (b - a) * (2 / 3), c + (b - c) * (2 / 3), c]])


def elliptic_arc(centre: ArrayLike, first_axis: ArrayLike, second_axis: ArrayLike, start: float, end: float) -> Run:
    """The arc centre + cos(t) first_axis + sin(t) second_axis for t from start to end.

    Parameters
    ----------
    centre, first_axis, second_axis : array_like of shape (2,)
        Half axes, or any pair of conjugate half diameters.
    start, end : float
        Radians; end < start runs backwards.

    Returns
    -------
    ndarray of shape (k, 4, 2)
    """
    axes = np.array([first_axis, second_axis], dtype=np.float64)
    count = max(1, int(np.ceil(abs(end - start) / _ARC_STEP - 1e-9)))
    t = np.linspace(start, end, count + 1)
    on = np.asarray(centre, dtype=np.float64) + np.stack([np.cos(t), np.sin(t)], axis=1) @ axes
    along = np.stack([-np.sin(t), np.cos(t)], axis=1) @ axes * (4 / 3 * np.tan((end - start) / count / 4))
    return np.stack([on[:-1], on[:-1] + along[:-1], on[1:] - along[1:], on[1:]], axis=1)


def bulge_arc(start: ArrayLike, end: ArrayLike, bulge: float) -> Run:
    """The circular arc of a DXF polyline's edge.

    Parameters
    ----------
    start, end : array_like of shape (2,)
    bulge : float
        Tangent of a quarter of the arc's angle; positive to the right of the way from start to end, so that the arc
        runs counter-clockwise; 0 is straight.

    Returns
    -------
    ndarray of shape (k, 4, 2)
    """
    a, b = np.asarray(start, dtype=np.float64), np.asarray(end, dtype=np.float64)
    if not bulge or not (b - a).any():
        return straight([a, b])
    half = (b - a) / 2
    centre = a + half + np.array([-half[1], half[0]]) * (1 - bulge * bulge) / (2 * bulge)
    arm = a - centre
    return elliptic_arc(centre, arm, (-arm[1], arm[0]), 0.0, 4 * float(np.arctan(bulge)))


def transform(run: Run, matrix: NDArray[np.float64]) -> Run:
    """A run under an affine map.

    Parameters
    ----------
    run : ndarray of shape (k, 4, 2)
    matrix : ndarray of shape (2, 3)
        Maps (x, y) to matrix @ (x, y, 1).

    Returns
    -------
    ndarray of shape (k, 4, 2)
    """
    return run @ matrix[:, :2].T + matrix[:, 2]


def flatten(run: Run) -> Points:
    """A run as a polyline whose edges turn by at most `CURVE_TURN` within a cubic.

    Parameters
    ----------
    run : ndarray of shape (k, 4, 2), k >= 1

    Returns
    -------
    ndarray of shape (n, 2)
        From the run's first point to its last.
    """
    if (run[:, 0] == run[:, 1]).all() and (run[:, 2] == run[:, 3]).all():  # made by `straight`
        return np.vstack([run[:1, 0], run[:, 3]])
    smallest = SMALLEST_CURVE * float(np.ptp(run.reshape(-1, 2), axis=0).max())
    for _ in range(_DEPTH):
        extents = np.ptp(run, axis=1).max(axis=1)
        bent = (_turns(run) > CURVE_TURN) & (extents > smallest)
        if not bent.any():
            break
        left, right = _halves(run[bent])
        place = np.arange(len(run)) + np.concatenate([[0], np.cumsum(bent)[:-1]])
        run_of_halves = np.empty((len(run) + int(bent.sum()), 4, 2))
        run_of_halves[place] = run
        run_of_halves[place[bent]] = left
        run_of_halves[place[bent] + 1] = right
        run = run_of_halves
    return np.vstack([run[:1, 0], run[:, 3]])


def _turns(run: Run) -> NDArray[np.float64]:
    """By how much each cubic turns, in radians: the sum of its control polygon's turns."""
    first, second, third = np.moveaxis(np.diff(run, axis=1), 1, 0)
    # Coincident control points have no direction: the neighbour's counts.
    second = np.where(second.any(axis=1)[:, None], second, np.where(first.any(axis=1)[:, None], first, third))
    first = np.where(first.any(axis=1)[:, None], first, second)
    third = np.where(third.any(axis=1)[:, None], third, second)
    return _angle(first, second) + _angle(second, third)


def _angle(a: Points, b: Points) -> NDArray[np.float64]:
    return np.abs(np.arctan2(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0], np.einsum("ij,ij->i", a, b)))


def _halves(run: Run) -> tuple[Run, Run]:
    """The halves of each cubic, by de Casteljau's construction."""
    a, b, c, d = np.moveaxis(run, 1, 0)
    ab, bc, cd = (a + b) / 2, (b + c) / 2, (c + d) / 2
    abc, bcd = (ab + bc) / 2, (bc + cd) / 2
    middle = (abc + bcd) / 2
    return np.stack([a, ab, abc, middle], axis=1), np.stack([middle, bcd, cd, d], axis=1)
