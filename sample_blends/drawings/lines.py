"""Lines as an illustrator draws them: shapes in a frame of their own, warped to their places, with an unsteady hand."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import CubicSpline
from scipy.ndimage import gaussian_filter1d

Array = NDArray[np.float64]
Warp = Callable[[Array], Array]

#: Turn between two pieces of a line, in radians, from which it is drawn as a corner.
CORNER = np.radians(40.0)

#: Segments that a Bézier piece is evaluated in, as Blender does by default.
RESOLUTION = 12


@dataclass(frozen=True)
class Stroke:
    """A line of the drawing: points that a smooth line goes through, but for its corners.

    Attributes
    ----------
    points : (n, 2)
        A closed line does not repeat its first point.
    closed : bool
    width : float
        Of the ink, in widths of the scene's pen.
    """

    points: Array
    closed: bool = False
    width: float = 1.0

    def warped(self, warp: Warp) -> Stroke:
        """The stroke where a warp takes it."""
        return Stroke(warp(self.points), self.closed, self.width)

    def handles(self) -> tuple[Array, Array]:
        """Left and right Bézier handles of the points: along the line, drawn in at corners."""
        p = self.points
        if self.closed:
            before, after = np.roll(p, 1, axis=0), np.roll(p, -1, axis=0)
        else:
            before, after = np.vstack([p[:1], p[:-1]]), np.vstack([p[1:], p[-1:]])
        a, b = p - before, after - p
        turn = np.abs(np.angle(np.exp(1j * (np.arctan2(b[:, 1], b[:, 0]) - np.arctan2(a[:, 1], a[:, 0])))))
        la, lb = np.linalg.norm(a, axis=1), np.linalg.norm(b, axis=1)
        along = after - before
        along /= np.maximum(np.linalg.norm(along, axis=1), 1e-12)[:, None]
        smooth = (turn < CORNER) & (la > 0.0) & (lb > 0.0)
        left = np.where(smooth[:, None], p - along * la[:, None] / 3, p - a / 3)
        right = np.where(smooth[:, None], p + along * lb[:, None] / 3, p + b / 3)
        return left, right

    def polyline(self) -> Array:
        """The line as Blender evaluates it, (n, 2); a closed one repeats its first point."""
        left, right = self.handles()
        p = self.points
        a = np.arange(len(p) if self.closed else len(p) - 1)
        b = (a + 1) % len(p)
        t = (np.arange(RESOLUTION) / RESOLUTION)[None, :, None]
        q = [k[:, None] for k in (p[a], right[a], left[b], p[b])]
        line = (1 - t) ** 3 * q[0] + 3 * (1 - t) ** 2 * t * q[1] + 3 * (1 - t) * t**2 * q[2] + t**3 * q[3]
        return np.vstack([line.reshape(-1, 2), p[:1] if self.closed else p[-1:]])


def curve(knots: ArrayLike, closed: bool = False, count: int = 24, width: float = 1.0) -> Stroke:
    """A smooth line through a few knots."""
    k = np.asarray(knots, float)
    path = np.vstack([k, k[:1]]) if closed else k
    at = np.concatenate([[0.0], np.cumsum(np.sqrt(np.linalg.norm(np.diff(path, axis=0), axis=1)))])
    spline = CubicSpline(at, path, bc_type="periodic" if closed else "natural")
    return Stroke(spline(np.linspace(0.0, at[-1], count, endpoint=not closed)), closed, width)


def corners(knots: ArrayLike, closed: bool = False, each: int = 6, width: float = 1.0) -> Stroke:
    """A line of straight pieces."""
    k = np.asarray(knots, float)
    path = np.vstack([k, k[:1]]) if closed else k
    t = np.arange(each)[:, None] / each
    pieces = [a + t * (b - a) for a, b in pairwise(path)]
    return Stroke(np.vstack([*pieces, *([] if closed else [path[-1:]])]), closed, width)


def joined(*strokes: Stroke, closed: bool = True) -> Stroke:
    """Smooth lines that meet in corners, as one."""
    parts = [s.points[:-1] for s in strokes[:-1]] + [strokes[-1].points[:-1] if closed else strokes[-1].points]
    return Stroke(np.vstack(parts), closed, strokes[0].width)


def ellipse(x: float, y: float, a: float, b: float | None = None, turn: float = 0.0, count: int = 20) -> Stroke:
    """A closed ellipse."""
    t = 2.0 * np.pi * np.arange(count) / count
    c, s = np.cos(turn), np.sin(turn)
    flat = np.stack([a * np.cos(t), (a if b is None else b) * np.sin(t)], 1)
    return Stroke(flat @ np.array([[c, s], [-s, c]]) + (x, y), True)


def placed(at: Sequence[float], scale: float = 1.0, turn: float = 0.0, mirrored: bool = False) -> Warp:
    """A similarity; degrees."""
    c, s = np.cos(np.radians(turn)), np.sin(np.radians(turn))
    flip = np.array([1.0, -1.0 if mirrored else 1.0])
    return lambda p: scale * (np.asarray(p, float) * flip) @ np.array([[c, s], [-s, c]]) + np.asarray(at, float)


def along(spine: ArrayLike, start: float, end: float, sizes: Sequence[float] = (1.0, 1.0), side: float = 1.0) -> Warp:
    """The x axis from start to end bent to a smooth spine, growing by ``sizes`` along it; ``side`` -1 mirrors."""
    k = np.asarray(spine, float)
    at = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(k, axis=0), axis=1))])
    fine = CubicSpline(at, k)(np.linspace(0.0, at[-1], 2000))
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(fine, axis=0), axis=1))])
    x = np.linspace(start, end, 2000)
    size = (
        CubicSpline(np.linspace(start, end, len(sizes)), sizes, bc_type="natural")(x)
        if len(sizes) > 2
        else (np.interp(x, [start, end], sizes))
    )
    run = np.concatenate([[0.0], np.cumsum((size[1:] + size[:-1]) / 2 * np.diff(x))])
    unit = length[-1] / run[-1]
    place = np.stack([np.interp(run * unit, length, fine[:, i]) for i in range(2)], 1)
    heading = np.unwrap(np.arctan2(*np.gradient(place, axis=0).T[::-1]))
    heading = gaussian_filter1d(heading, 15.0, mode="nearest")

    def warp(points: Array) -> Array:
        p = np.asarray(points, float)
        inside = np.clip(p[:, 0], start, end)
        centre = np.stack([np.interp(inside, x, place[:, i]) for i in range(2)], 1)
        angle, grown = np.interp(inside, x, heading), np.interp(inside, x, size) * unit
        ahead, up = np.stack([np.cos(angle), np.sin(angle)], 1), np.stack([-np.sin(angle), np.cos(angle)], 1)
        beyond = (p[:, 0] - inside) * grown
        return centre + ahead * beyond[:, None] + up * (side * p[:, 1] * grown)[:, None]

    return warp


def pulled(handles: Sequence[tuple[Sequence[float], Sequence[float]]]) -> Warp:
    """The plane pulled smoothly so that each handle's first point comes to its second (thin-plate splines)."""
    source, target = (np.array([h[i] for h in handles], float) for i in (0, 1))

    def kernel(a: Array, b: Array) -> Array:
        square = ((a[:, None] - b[None]) ** 2).sum(2)
        return square * np.log(np.maximum(square, 1e-300))

    n = len(source)
    system = np.zeros((n + 3, n + 3))
    system[:n, :n] = kernel(source, source) + 1e-9 * np.eye(n)
    system[:n, n:] = system[n:, :n].T
    system[:n, n:] = np.column_stack([np.ones(n), source])
    system[n:, :n] = system[:n, n:].T
    weights = np.linalg.solve(system, np.vstack([target, np.zeros((3, 2))]))

    def warp(points: Array) -> Array:
        p = np.asarray(points, float)
        return kernel(p, source) @ weights[:n] + np.column_stack([np.ones(len(p)), p]) @ weights[n:]

    return warp


def then(first: Warp, *others: Warp) -> Warp:
    """One warp after the other."""

    def warp(points: Array) -> Array:
        p = first(np.asarray(points, float))
        for other in others:
            p = other(p)
        return p

    return warp


def inverse(warp: Warp, low: Sequence[float], high: Sequence[float]) -> Warp:
    """The inverse of a warp of a box, by Newton's method from the nearest point of a grid."""
    from scipy.spatial import cKDTree

    x, y = (np.linspace(a, b, 160) for a, b in zip(low, high, strict=True))
    grid = np.stack(np.meshgrid(x, y), 2).reshape(-1, 2)
    tree = cKDTree(warp(grid))
    step = 1e-5 * max(high[0] - low[0], high[1] - low[1])

    def back(points: Array) -> Array:
        goal = np.asarray(points, float)
        p = grid[tree.query(goal)[1]]
        for _ in range(4):
            here = warp(p)
            dx, dy = ((warp(p + d) - here) / step for d in ((step, 0.0), (0.0, step)))
            det = dx[:, 0] * dy[:, 1] - dx[:, 1] * dy[:, 0]
            det = np.where(np.abs(det) < 1e-12, 1e-12, det)
            gap = goal - here
            move = np.stack(
                [gap[:, 0] * dy[:, 1] - gap[:, 1] * dy[:, 0], gap[:, 1] * dx[:, 0] - gap[:, 0] * dx[:, 1]], 1
            )
            p = p + move / det[:, None]
        return p

    return back


def by_hand(strokes: Iterable[Stroke], size: float, generator: np.random.Generator) -> list[Stroke]:
    """Strokes drawn by an unsteady hand: each wanders by some thousandths of a size."""
    drawn = []
    for s in strokes:
        wander = generator.normal(size=s.points.shape)
        wander = gaussian_filter1d(wander, 2.5, axis=0, mode="wrap" if s.closed else "reflect")
        drawn.append(Stroke(s.points + size * wander / 3.0, s.closed, s.width))
    return drawn


def behind(strokes: Iterable[Stroke], fronts: Sequence[Array]) -> list[Stroke]:
    """What is left of strokes where closed outlines lie before them: lines with gaps."""
    import shapely

    cover = shapely.union_all([shapely.make_valid(shapely.polygons(f)) for f in fronts])
    left = []
    for s in strokes:
        line = s.polyline()[:: RESOLUTION // 3]
        if not shapely.intersects(cover, shapely.linestrings(line)):
            left.append(s)
            continue
        hidden = shapely.contains_xy(cover, line[:, 0], line[:, 1])
        if s.closed and not hidden.all():
            first = int(np.argmax(hidden))
            line, hidden = np.roll(line[:-1], -first, axis=0), np.roll(hidden[:-1], -first)
        change = np.flatnonzero(np.diff(hidden)) + 1
        pieces = zip(np.split(line, change), np.split(hidden, change), strict=True)
        left += [Stroke(piece, False, s.width) for piece, cut in pieces if not cut[0] and len(piece) > 3]
    return left
