"""Two ways to carry a pose from one room to another with shape contexts (figure 4.18).

*SC B-spline* after Belongie, Malik and Puzicha (2002) and the registration by Kroon that the thesis compares with:
shape contexts at regular places of all boundaries are matched one to one, the matches pull at a grid of cubic B-splines
that is refined step by step, is as smooth as possible and never folds over. A pose goes where its place is deformed to.

*SC inner*: a shape context at the example's pose is compared with the shape contexts at all poses of a grid over the
other room; the pose goes to the best.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

Array = NDArray[np.float64]

#: Log-polar histogram: rings between these radii, in mean distances of the samples, and sectors.
INNERMOST, OUTERMOST, RINGS, SECTORS = 0.125, 2.0, 5, 12

#: Cells of the deformation grid along the longer side, coarse to fine, and rounds of matching at each.
GRIDS, ROUNDS = (2, 4, 8), 3

#: Weight of the bending of the grid beside the mean squared distance of the matches; halved at each refinement.
STIFFNESS = 0.02

#: Least determinant of the deformation's derivative: below, it is about to fold.
LEAST_STRETCH = 0.1


# ------------------------------------------------------------------------------------------------ shape contexts


def boundary_samples(rings: Sequence[Array], count: int) -> tuple[Array, Array]:
    """Places at equal distances along rings.

    Parameters
    ----------
    rings : sequence of ndarray of shape (n, 2)
        Without a repeated last vertex.
    count : int
        Places in all.

    Returns
    -------
    places : ndarray of shape (m, 2)
    tangents : ndarray of shape (m,)
        Directions of the boundary, radians.
    """
    lines = [shapely.LinearRing(r) for r in rings]
    length = sum(line.length for line in lines)
    places, tangents = [], []
    for line in lines:
        n = max(4, round(count * line.length / length))
        at = (np.arange(n) + 0.5) / n * line.length
        step = 1e-4 * line.length
        p = shapely.get_coordinates(shapely.line_interpolate_point(line, at))
        ahead = shapely.get_coordinates(shapely.line_interpolate_point(line, (at + step) % line.length))
        places.append(p)
        tangents.append(np.arctan2(*(ahead - p).T[::-1]))
    return np.concatenate(places), np.concatenate(tangents)


def shape_contexts(centres: Array, directions: Array, samples: Array, sectors: int = SECTORS) -> Array:
    """Log-polar histograms of samples as seen from poses.

    Parameters
    ----------
    centres : ndarray of shape (m, 2)
    directions : ndarray of shape (m,)
        The first sector lies around it: the histograms do not depend on how the scene is turned.
    samples : ndarray of shape (n, 2)
    sectors : int

    Returns
    -------
    ndarray of shape (m, RINGS, sectors)
        Shares that add up to at most 1. Radii are in mean distances between samples: free of scale.
    """
    way = samples - centres[:, None]
    distance = np.hypot(*way.transpose(2, 0, 1))
    scale = np.hypot(*(samples[:, None] - samples).transpose(2, 0, 1)).mean()
    edges = np.geomspace(INNERMOST, OUTERMOST, RINGS)
    ring = np.searchsorted(edges, distance / scale)
    # Straight on and at right angles are the middles of sectors: on a border, walls would fall on either side of it.
    turn = (np.arctan2(way[..., 1], way[..., 0]) - directions[:, None] + np.pi / SECTORS) % (2 * np.pi)
    sector = np.minimum((turn * sectors / (2 * np.pi)).astype(int), sectors - 1)
    result = np.zeros((len(centres), RINGS, sectors))
    row = np.broadcast_to(np.arange(len(centres))[:, None], ring.shape)
    # A sample at the pose itself has no direction.
    seen = (ring < RINGS) & (distance > 1e-9 * scale)
    np.add.at(result, (row[seen], ring[seen], sector[seen]), 1.0 / len(samples))
    return result


def chi_squared(a: Array, b: Array) -> Array:
    """Distances between histograms, 0 (equal) to 1.

    Parameters
    ----------
    a : ndarray of shape (m, rings, sectors)
    b : ndarray of shape (n, rings, sectors)

    Returns
    -------
    ndarray of shape (m, n)
    """
    a, b = a.reshape(len(a), -1), b.reshape(len(b), -1)
    result = np.empty((len(a), len(b)))
    for i, row in enumerate(a):
        total = row + b
        result[i] = 0.5 * np.divide((row - b) ** 2, total, out=np.zeros_like(total), where=total > 0).sum(axis=1)
    return result


# ------------------------------------------------------------------------------------------------ B-spline


def _basis(t: Array) -> tuple[Array, Array]:
    """The four cubic B-splines that reach a point, and their derivatives, at t in [0, 1); both (n, 4)."""
    values = np.stack([(1 - t) ** 3, 3 * t**3 - 6 * t**2 + 4, -3 * t**3 + 3 * t**2 + 3 * t + 1, t**3], axis=1) / 6
    slopes = np.stack([-((1 - t) ** 2) / 2, 1.5 * t**2 - 2 * t, -1.5 * t**2 + t + 0.5, t**2 / 2], axis=1)
    return values, slopes


@dataclass(frozen=True)
class Spline:
    """A deformation of the plane by a grid of cubic B-splines.

    Attributes
    ----------
    origin : ndarray of shape (2,)
    spacing : float
    control : ndarray of shape (columns, rows, 2)
        Displacements; one more on the lower side, two more on the upper side of the box they are for.
    """

    origin: Array
    spacing: float
    control: Array

    def weights(self, points: Array) -> tuple[Array, Array, Array]:
        """How the control points act on points: values and both derivatives, each (n, columns * rows)."""
        at = (points - self.origin) / self.spacing
        columns, rows = self.control.shape[:2]
        cell = np.clip(np.floor(at).astype(int), 0, [columns - 4, rows - 4])
        (bx, dx), (by, dy) = (_basis(at[:, k] - cell[:, k]) for k in (0, 1))
        index = (cell[:, :1] + np.arange(4))[:, :, None] * rows + (cell[:, 1:] + np.arange(4))[:, None]
        result = []
        for x, y, unit in ((bx, by, 1.0), (dx, by, self.spacing), (bx, dy, self.spacing)):
            matrix = np.zeros((len(points), columns * rows))
            np.put_along_axis(
                matrix, index.reshape(len(points), 16), (x[:, :, None] * y[:, None] / unit).reshape(-1, 16), 1
            )
            result.append(matrix)
        return result[0], result[1], result[2]

    def __call__(self, points: Array) -> Array:
        """Where points are deformed to; shape (n, 2)."""
        return points + self.weights(points)[0] @ self.control.reshape(-1, 2)

    def derivative(self, points: Array) -> Array:
        """Derivatives of the deformation; shape (n, 2, 2), columns by x and y."""
        _, by_x, by_y = self.weights(points)
        flat = self.control.reshape(-1, 2)
        return np.eye(2) + np.stack([by_x @ flat, by_y @ flat], axis=-1)


def _bending(columns: int, rows: int) -> Array:
    """Second differences of a grid of control points as a matrix."""
    index = np.arange(columns * rows).reshape(columns, rows)
    stencils = []
    for a, b, c in ((index[:-2], index[1:-1], index[2:]), (index[:, :-2], index[:, 1:-1], index[:, 2:])):
        block = np.zeros((a.size, index.size))
        at = np.arange(a.size)
        block[at, a.ravel()] += 1
        block[at, b.ravel()] -= 2
        block[at, c.ravel()] += 1
        stencils.append(block)
    cross = np.zeros(((columns - 1) * (rows - 1), index.size))
    at = np.arange(len(cross))
    for part, sign in ((index[:-1, :-1], 1), (index[1:, :-1], -1), (index[:-1, 1:], -1), (index[1:, 1:], 1)):
        cross[at, part.ravel()] += sign * np.sqrt(2)
    return np.vstack([*stencils, cross])


def _fit(points: Array, goals: Array, trust: Array, box: Array, cells: int, stiffness: float, probes: Array) -> Spline:
    """The smoothest deformation that takes points near their goals; stiffened until it folds nowhere at the probes."""
    spacing = float((box[1] - box[0]).max() / cells)
    count = np.ceil((box[1] - box[0]) / spacing - 1e-9).astype(int) + 3
    empty = Spline(box[0], spacing, np.zeros((*count, 2)))
    act = empty.weights(points)[0]
    bend = _bending(*count)
    pull = act.T * trust
    while True:
        normal = pull @ act + stiffness * bend.T @ bend / len(bend) * cells**2
        control = np.linalg.solve(normal + 1e-9 * np.eye(len(normal)), pull @ (goals - points))
        spline = Spline(box[0], spacing, control.reshape(*count, 2))
        stretch = np.linalg.det(spline.derivative(probes))
        if stretch.min() > LEAST_STRETCH or stiffness > 1e6:
            return spline
        stiffness *= 2


@dataclass(frozen=True)
class Registration:
    """The one-to-one mapping of SC B-spline.

    Attributes
    ----------
    affine : ndarray of shape (3, 2)
        Applied first, to (x, y, 1).
    spline : Spline
    residual : float
        Root mean square distance of the matches, in scene units.
    """

    affine: Array
    spline: Spline
    residual: float

    def __call__(self, points: Array) -> Array:
        """Source points in the target; shape (n, 2)."""
        return self.spline(_affine(self.affine, points))

    def pose(self, position: Sequence[float], angle: float) -> tuple[Array, float]:
        """A pose of the source in the target: its position, and its direction as it is deformed there."""
        ahead = 1e-4 * np.array([np.cos(angle), np.sin(angle)])
        here, there = self(np.array([position, np.asarray(position) + ahead]))
        return here, float(np.arctan2(*(there - here)[::-1]))


def _affine(matrix: Array, points: Array) -> Array:
    return points @ matrix[:2] + matrix[2]


def register(source: Sequence[Array], target: Sequence[Array], count: int = 160) -> Registration:
    """Match the boundaries of two arrangements and deform one into the other.

    Parameters
    ----------
    source, target : sequence of ndarray of shape (n, 2)
        The room's ring first, then those of the objects in it.
    count : int
        Places on the boundaries.

    Returns
    -------
    Registration
    """
    p, tangent = boundary_samples(source, count)
    q, target_tangent = boundary_samples(target, count)
    goal_context = shape_contexts(q, target_tangent, q)
    low, high = source[0].min(axis=0), source[0].max(axis=0)
    inside = _grid_points(source[0], float((high - low).max()) / 24)
    # The first match needs no alignment: contexts are counted from the tangents.
    matched, cost = _matches(shape_contexts(p, tangent, p), goal_context)
    affine = np.linalg.lstsq(
        np.column_stack([p, np.ones(len(p))]) * np.exp(-4 * cost)[:, None],
        q[matched] * np.exp(-4 * cost)[:, None],
        rcond=None,
    )[0]
    start, probes = _affine(affine, p), _affine(affine, inside)
    box = np.array([np.vstack([start, probes]).min(axis=0), np.vstack([start, probes]).max(axis=0)])
    spline = None
    for level, cells in enumerate(GRIDS):
        for _ in range(ROUNDS):
            warped = start if spline is None else spline(start)
            # Tangents go with the boundary: a place and its neighbour are deformed alike.
            ahead = p + 1e-3 * np.stack([np.cos(tangent), np.sin(tangent)], axis=1)
            moved = _affine(affine, ahead) if spline is None else spline(_affine(affine, ahead))
            turned = np.arctan2(*(moved - warped).T[::-1])
            near = np.hypot(*(warped[:, None] - q).transpose(2, 0, 1)) / np.sqrt(np.ptp(q, axis=0).prod())
            contexts = shape_contexts(warped, turned, warped)
            matched, cost = _matches(contexts, goal_context, near)
            spline = _fit(start, q[matched], np.exp(-4 * cost), box, cells, STIFFNESS / 2**level, probes)
    assert spline is not None
    residual = float(np.sqrt(np.mean(np.sum((spline(start) - q[matched]) ** 2, axis=1))))
    return Registration(affine, spline, residual)


def _matches(a: Array, b: Array, apart: Array | None = None) -> tuple[NDArray[np.intp], Array]:
    """For every context of `a` its partner in `b`, one to one as far as there are enough, and the cost."""
    cost = chi_squared(a, b) + (0.0 if apart is None else apart)
    rows, columns = linear_sum_assignment(cost)
    partner = np.argmin(cost, axis=1)
    partner[rows] = columns
    return partner, cost[np.arange(len(a)), partner]


# ------------------------------------------------------------------------------------------------ inner contexts


@dataclass(frozen=True)
class InnerMatch:
    """Where SC inner puts a pose.

    Attributes
    ----------
    position : ndarray of shape (2,)
    angle : float
    points : ndarray of shape (n, 2)
    quality : ndarray of shape (n,)
        Best quality over the directions, 0 to 1, at each point inside the room.
    """

    position: Array
    angle: float
    points: Array
    quality: Array


def match_inside(
    source: Sequence[Array],
    position: Sequence[float],
    angle: float,
    target: Sequence[Array],
    count: int = 240,
    points: int = 1500,
    directions: int = 72,
) -> InnerMatch:
    """Find the pose in a room whose shape context is most like the example's.

    Parameters
    ----------
    source, target : sequence of ndarray of shape (n, 2)
        The room's ring first, then those of the objects in it.
    position, angle
        The example's pose.
    count : int
        Samples of the boundaries.
    points, directions : int
        Of the grid over the target's poses; directions a multiple of SECTORS.

    Returns
    -------
    InnerMatch
    """
    samples = boundary_samples(source, count)[0]
    wanted = shape_contexts(np.array([position], dtype=float), np.array([angle]), samples)
    spacing = float(np.sqrt(shapely.Polygon(target[0]).area / points))
    grid = _grid_points(target[0], spacing)
    fine = shape_contexts(grid, np.zeros(len(grid)), boundary_samples(target, count)[0], directions)
    cost = np.empty((len(grid), directions))
    for k in range(directions):
        turned = np.roll(fine, -k, axis=2).reshape(len(grid), RINGS, SECTORS, -1).sum(axis=3)
        cost[:, k] = chi_squared(turned, wanted)[:, 0]
    best, direction = np.unravel_index(np.argmin(cost), cost.shape)
    return InnerMatch(grid[best], float(2 * np.pi * direction / directions), grid, 1 - cost.min(axis=1))


def _grid_points(ring: Array, spacing: float) -> Array:
    """Points of a grid that lie inside a ring."""
    low, high = ring.min(axis=0), ring.max(axis=0)
    axes = [np.arange(a + spacing / 2, b, spacing) for a, b in zip(low, high, strict=True)]
    points = np.stack(np.meshgrid(*axes), axis=-1).reshape(-1, 2)
    return points[shapely.contains_xy(shapely.Polygon(ring), *points.T)]
