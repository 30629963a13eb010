"""Straight lines and circular arcs fitted to runs of points, and the fewest that explain a run."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..tolerances import CURVE_TURN

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Line:
    """A straight piece.

    Attributes
    ----------
    point, direction : ndarray of shape (2,)
        A point of the line, and its unit direction along the run.
    length : float
        Of the run it was fitted to.
    """

    point: Array
    direction: Array
    length: float

    #: The standard deviation of its direction is this times that of the points' distances, divided by its length and
    #: the root of their number (the textbook's least-squares slope).
    direction_error = 12**0.5

    def nearest(self, points: Array) -> Array:
        """The nearest points of the line.

        Parameters
        ----------
        points : ndarray of shape (2,) or (n, 2)

        Returns
        -------
        ndarray of the same shape
        """
        return self.point + ((points - self.point) @ self.direction)[..., None] * self.direction

    def direction_at(self, point: Array) -> Array:
        """The unit direction along the run.

        Parameters
        ----------
        point : ndarray of shape (2,)

        Returns
        -------
        ndarray of shape (2,)
        """
        return self.direction

    def between(self, start: Array, end: Array) -> Array:
        """The vertices strictly between two points of the line: none.

        Parameters
        ----------
        start, end : ndarray of shape (2,)

        Returns
        -------
        ndarray of shape (0, 2)
        """
        return np.zeros((0, 2))


@dataclass(frozen=True)
class Arc:
    """A circular piece.

    Attributes
    ----------
    centre : ndarray of shape (2,)
    radius : float
    sweep : float
        Angle over which the run goes round the centre, in radians, positive counter-clockwise.
    """

    centre: Array
    radius: float
    sweep: float

    #: As that of `Line`, at the ends of the run: a parabola's slope is four times as uncertain there.
    direction_error = 192**0.5

    @property
    def length(self) -> float:
        """Of the run it was fitted to."""
        return abs(self.sweep) * self.radius

    def nearest(self, points: Array) -> Array:
        """The nearest points of the circle.

        Parameters
        ----------
        points : ndarray of shape (2,) or (n, 2)

        Returns
        -------
        ndarray of the same shape
        """
        away = points - self.centre
        distance = np.maximum(np.hypot(away[..., 0], away[..., 1]), 1e-300)[..., None]
        return self.centre + away / distance * self.radius

    def direction_at(self, point: Array) -> Array:
        """The unit direction along the run where a point is nearest.

        Parameters
        ----------
        point : ndarray of shape (2,)

        Returns
        -------
        ndarray of shape (2,)
        """
        away = (self.nearest(point) - self.centre) / self.radius
        return np.sign(self.sweep) * np.array([-away[1], away[0]])

    def between(self, start: Array, end: Array) -> Array:
        """The vertices strictly between two points of the circle, no more than `CURVE_TURN` apart.

        Parameters
        ----------
        start, end : ndarray of shape (2,)
            The same point twice: the whole circle.

        Returns
        -------
        ndarray of shape (n, 2)
        """
        a, b = start - self.centre, end - self.centre
        first = np.arctan2(a[1], a[0])
        side = np.sign(self.sweep)
        sweep = (side * (np.arctan2(b[1], b[0]) - first)) % (2 * np.pi)
        if (start == end).all():
            sweep = 2 * np.pi
        elif sweep > abs(self.sweep) + np.pi:
            return np.zeros((0, 2))  # the ends lie the other way round: the arc is shorter than its noise
        count = max(1, int(np.ceil(sweep / CURVE_TURN - 1e-9)))
        angles = first + side * sweep * np.arange(1, count) / count
        return self.centre + self.radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)


Piece = Line | Arc


def fit_line(points: Array) -> Line:
    """The line with the least sum of squared distances.

    Parameters
    ----------
    points : ndarray of shape (n, 2), n >= 2

    Returns
    -------
    Line
    """
    centre = points.mean(axis=0)
    away = points - centre
    direction = np.linalg.eigh(away.T @ away)[1][:, 1]
    extent = float(direction @ (points[-1] - points[0]))
    return Line(centre, direction if extent >= 0 else -direction, abs(extent))


def fit_arc(points: Array) -> Piece:
    """The circular arc with about the least sum of squared distances (Taubin's fit), a line where it has no curvature.

    Parameters
    ----------
    points : ndarray of shape (n, 2), n >= 3

    Returns
    -------
    Arc or Line
    """
    middle = points.mean(axis=0)
    away = points - middle
    square = (away * away).sum(axis=1)
    mean = square.mean()
    scale = 2 * np.sqrt(mean)
    design = np.column_stack([(square - mean) / scale, away])
    bend, b, c = np.linalg.eigh(design.T @ design)[1][:, 0]
    bend /= scale
    if abs(bend) * scale <= 1e-9:
        return fit_line(points)
    to_centre = -np.array([b, c]) / (2 * bend)
    radius = float(np.sqrt(to_centre @ to_centre + mean))
    spokes = away - to_centre
    cross = spokes[:-1, 0] * spokes[1:, 1] - spokes[:-1, 1] * spokes[1:, 0]
    sweep = float(np.arctan2(cross, (spokes[:-1] * spokes[1:]).sum(axis=1)).sum())
    return Arc(middle + to_centre, radius, sweep) if sweep else fit_line(points)


def deviations(piece: Piece, points: Array) -> Array:
    """Distances of points from a piece.

    Parameters
    ----------
    piece : Line or Arc
    points : ndarray of shape (n, 2)

    Returns
    -------
    ndarray of shape (n,)
    """
    return np.hypot(*(points - piece.nearest(points)).T)


def squared_deviations(points: Array) -> tuple[Array, Array]:
    """Sums of squared distances of every run of points from its line and from its arc.

    Both fits are smallest eigenvalues of moment matrices (Taubin's of three by three), and moments of runs are
    differences of running sums: all runs cost one pass.

    Parameters
    ----------
    points : ndarray of shape (m, 2)
        About the origin and of about unit size: fourth powers are summed.

    Returns
    -------
    line, arc : ndarray of shape (m, m)
        Entry (i, j), i <= j, is the run from point i to point j.
    """
    m = len(points)
    x, y = points.T
    z = x * x + y * y
    powers = np.stack([np.ones(m), x, y, z, x * x, x * y, y * y, x * z, y * z, z * z], axis=1)
    sums = np.vstack([np.zeros(10), np.cumsum(powers, axis=0)])
    i, j = np.triu_indices(m, 1)
    n, *moments = (sums[j + 1] - sums[i]).T
    mx, my, mz, mxx, mxy, myy, mxz, myz, mzz = (moment / n for moment in moments)
    xx, xy, yy = mxx - mx * mx, mxy - mx * my, myy - my * my
    # z about the run's own centre: z - 2 mx x - 2 my y.
    xz, yz, zz = mxz - mx * mz, myz - my * mz, mzz - mz * mz
    zz = zz + 4 * (mx * mx * xx + my * my * yy + 2 * mx * my * xy - mx * xz - my * yz)
    xz, yz = xz - 2 * (mx * xx + my * xy), yz - 2 * (mx * xy + my * yy)
    scale = 2 * np.sqrt(np.maximum(xx + yy, 1e-300))
    line, arc = np.zeros((m, m)), np.zeros((m, m))
    half = (xx - yy) / 2
    line[i, j] = n * np.maximum((xx + yy) / 2 - np.sqrt(half * half + xy * xy), 0.0)
    arc[i, j] = n * np.maximum(_least_eigenvalue(zz / scale**2, xx, yy, xz / scale, yz / scale, xy), 0.0)
    return line, arc


def _least_eigenvalue(a: Array, b: Array, c: Array, ab: Array, ac: Array, bc: Array) -> Array:
    """The least eigenvalues of symmetric matrices with diagonals a, b, c, by the roots of a cubic; all at once."""
    mean = (a + b + c) / 3
    a, b, c = a - mean, b - mean, c - mean
    spread = np.sqrt((a * a + b * b + c * c + 2 * (ab * ab + ac * ac + bc * bc)) / 6)
    determinant = a * (b * c - bc * bc) - ab * (ab * c - bc * ac) + ac * (ab * bc - b * ac)
    cosine = determinant / np.maximum(2 * spread**3, 1e-300)
    return mean + 2 * spread * np.cos((np.arccos(np.clip(cosine, -1.0, 1.0)) + 2 * np.pi) / 3)


def cheapest_partition(cost: Array) -> list[tuple[int, int]]:
    """The partition of 0 .. m - 1 into runs with the least sum of costs.

    Parameters
    ----------
    cost : ndarray of shape (m, m)
        Entry (i, j), i <= j, is the cost of the run from i to j.

    Returns
    -------
    list of (int, int)
        First and last index of each run, ascending; of two points there is always a line, so runs have three at least.
    """
    m = len(cost)
    least = np.full(m + 1, np.inf)
    least[0] = 0.0
    before = np.zeros(m + 1, dtype=np.intp)
    for end in range(3, m + 1):
        total = least[: end - 2] + cost[: end - 2, end - 1]
        before[end] = np.argmin(total)
        least[end] = total[before[end]]
    runs = []
    end = m
    while end > 0:
        runs.append((int(before[end]), end - 1))
        end = int(before[end])
    return runs[::-1]
