"""The query: the region or stroke that a user selected, the lines in it, and its query points (section 3.4)."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

from ..errors import InputError
from ..geometry.contours import Complex, even, surrounding_circle
from ..geometry.drawing import Drawing
from ..tolerances import (
    LEAST_QUERY_TURN,
    LEAST_SIMPLE_SHARE,
    ON_OUTLINE,
    UNCLOSED_EDGES,
)
from .options import RegionOptions

#: Stretches of line from which on their places say something, however straight they are.
LEAST_MARKS = 12


@dataclass(frozen=True)
class Run:
    """A stretch of one line: consecutive points of the contours.

    Attributes
    ----------
    indices : (n,) int
        Indices into the contours' points, in order along the line (they wrap round in a closed line).
    closed : bool
        Whether the stretch is a whole closed line.
    """

    indices: NDArray[np.intp]
    closed: bool


@dataclass(frozen=True)
class Query:
    """What is matched.

    Attributes
    ----------
    shape : shapely geometry
        The region; for a stroke everything within its reach. In the drawing's frame.
    inside : (n,) bool
        Which points of the contours lie in the region; points on its outline count as inside.
    runs : list of Run
        The stretches of lines inside, longest first.
    rest : list of Run
        The stretches of lines outside: where targets are looked for.
    points : (m,) complex
        The query points.
    spacing : float
        Typical distance of neighbouring query points.
    size : float
        Extent of the query: diameter of the smallest circle round its points and lines.
    """

    shape: shapely.Geometry
    inside: NDArray[np.bool_]
    runs: list[Run]
    rest: list[Run]
    points: Complex
    spacing: float
    size: float

    @classmethod
    def of(cls, drawing: Drawing, query: ArrayLike | Sequence[ArrayLike], options: RegionOptions) -> "Query":
        """Read a query.

        Parameters
        ----------
        drawing : Drawing
        query : (n, 2) array, or sequence of them
            A ring (with or without its first point repeated) or an open stroke, in scene units; several are a brush:
            everything that lies in one of the rings or within reach of one of the strokes.
        options : RegionOptions
            `query_kind`, `query_points` and `reach` are used.

        Raises
        ------
        InputError
            When the query is no ring or stroke, crosses itself, holds no line of the drawing or only straight ones.
        """
        strokes = [_polyline(drawing, part) for part in parts_of(query)]
        rings = [_is_ring(z, options.query_kind) for z in strokes]
        longest = max(float(np.abs(np.diff(z)).sum()) for z in strokes)
        shape = shapely.union_all(
            [
                _region(z)
                if ring
                else shapely.linestrings(np.stack([z.real, z.imag], 1)).buffer(options.reach * longest)
                for z, ring in zip(strokes, rings, strict=True)
            ]
        )
        shapely.prepare(shape)
        contours = drawing.contours
        inside = _covered(shape, contours.drawn)
        if not inside.any():
            raise InputError("No line of the drawing lies in the query: draw the query round the lines to be matched.")
        runs, rest = _runs(drawing, inside)
        turn = sum(float(np.abs(np.diff(contours.heading[run.indices])).sum()) for run in runs)
        if turn < LEAST_QUERY_TURN and len(runs) < LEAST_MARKS:
            raise InputError(
                "The lines in the query are straight and match everywhere: include a bend or a corner in the query."
            )
        if rings[0] or len(strokes) > 1:
            points, spacing = _grids(shape, options.query_points)
        else:
            z = strokes[0]
            closed = z[0] == z[-1]
            points = even(z[:-1] if closed else z, bool(closed), options.query_points)
            spacing = float(np.abs(np.diff(points)).mean())
        _, size = surrounding_circle(np.concatenate([contours.points[inside], points]))
        return cls(shape, inside, runs, rest, points, spacing, size)


def parts_of(query: ArrayLike | Sequence[ArrayLike]) -> list[Any]:
    """The rings and strokes of a query: one, or several of a brush.

    Parameters
    ----------
    query : (n, 2) array, or sequence of them

    Returns
    -------
    list of array_like
    """
    if isinstance(query, list | tuple) and len(query) and np.ndim(query[0]) == 2:
        return list(query)
    return list(query) if isinstance(query, np.ndarray) and query.ndim == 3 and len(query) else [query]


def _polyline(drawing: Drawing, query: ArrayLike) -> Complex:
    """The query's vertices in the drawing's frame, without consecutive duplicates."""
    try:
        p = np.asarray(query, float)
    except (TypeError, ValueError, OverflowError):
        raise InputError("The query is no list of points: give pairs of numbers.") from None
    if p.ndim != 2 or p.shape[1] != 2:
        raise InputError(f"The query has the shape {p.shape}: give points as (n, 2).")
    if not np.isfinite(p).all():
        raise InputError("The query has a coordinate that is not a number: draw it again.")
    z = drawing.into_frame(p)
    z = z[np.concatenate([[True], np.diff(z) != 0.0])] if len(z) else z
    if len(z) < 2:
        raise InputError("The query has fewer than two different points: outline a region or draw a stroke.")
    return z


def _is_ring(z: Complex, kind: str) -> bool:
    """Whether a query is meant as a ring."""
    if kind != "auto":
        return kind == "region"
    return len(z) > 2 and abs(z[0] - z[-1]) <= UNCLOSED_EDGES * np.abs(np.diff(z)).max()


def _region(z: Complex) -> shapely.Geometry:
    """The polygon of a ring, without the small loop where a lasso ends; real crossings are refused."""
    if len(z) < 3:
        raise InputError("The query region has fewer than three corners: outline it again.")
    polygon = shapely.polygons(np.stack([z.real, z.imag], 1))
    if polygon.is_valid:
        return polygon
    parts = [g for g in shapely.get_parts(shapely.make_valid(polygon)) if g.geom_type == "Polygon"]
    area = sum(g.area for g in parts)
    largest = max(parts, key=lambda g: g.area, default=None)
    if largest is None or largest.area < LEAST_SIMPLE_SHARE * area:
        raise InputError("The outline of the query region crosses itself: outline it without crossings.")
    return largest


def _covered(shape: shapely.Geometry, z: Complex) -> NDArray[np.bool_]:
    """Which points lie in a shape or on its outline."""
    out = shapely.intersects_xy(shape, z.real, z.imag)
    left = np.flatnonzero(~out)
    near = shapely.dwithin(shape, shapely.points(z.real[left], z.imag[left]), ON_OUTLINE)
    out[left] = near
    return out


def _runs(drawing: Drawing, inside: NDArray[np.bool_]) -> tuple[list[Run], list[Run]]:
    """The stretches of lines inside and outside, each longest first."""
    contours = drawing.contours
    found: tuple[list[Run], list[Run]] = ([], [])
    for k, closed in enumerate(contours.closed):
        at = np.arange(contours.first[k], contours.first[k + 1])
        flag = inside[at]
        change = np.flatnonzero(np.diff(flag)) + 1
        if not len(change):
            found[0 if flag[0] else 1].append(Run(at, bool(closed)))
            continue
        pieces = np.split(at, change)
        if closed and flag[0] == flag[-1]:
            pieces = [np.concatenate([pieces[-1], pieces[0]]), *pieces[1:-1]]
        for piece in pieces:
            if len(piece) > 2:
                found[0 if inside[piece[0]] else 1].append(Run(piece, False))
    length = contours.weight
    for some in found:
        some.sort(key=lambda run: -round(float(length[run.indices].sum()), 9))
    return found


def _grids(shape: shapely.Geometry, count: int) -> tuple[Complex, float]:
    """Query points of a region of one or several parts, each with as many as its area says."""
    parts = shapely.get_parts(shape)
    found = [_grid(part, max(4, round(count * part.area / shape.area))) for part in parts]
    return np.concatenate([z for z, _ in found]), float(np.mean([spacing for _, spacing in found]))


def _grid(shape: shapely.Geometry, count: int) -> tuple[Complex, float]:
    """About `count` points on a regular grid inside a polygon, along the polygon's own axes.

    The thesis fills the bounding box; along the principal axes of the region the points turn with the drawing, and the
    spacing follows from the area, so that thin regions get as many points as round ones.
    """
    outline = even(_complex(shapely.get_exterior_ring(shape)), True, 256)
    middle = outline.mean()
    axis = np.exp(0.5j * np.angle(((outline - middle) ** 2).sum()))
    local = (outline - middle) / axis
    low, high = local.real.min() + 1j * local.imag.min(), local.real.max() + 1j * local.imag.max()
    spacing = np.sqrt(shape.area / count)
    best = np.zeros(0, complex)
    for shrink in (1.0, 0.85, 0.7, 0.5, 0.35):
        step = spacing * shrink
        x, y = (_centred(a, b, step) for a, b in ((low.real, high.real), (low.imag, high.imag)))
        grid = (x[:, None] + 1j * y[None, :]).ravel() * axis + middle
        best = grid[_covered(shape, grid)]
        if len(best) >= 0.8 * count:
            return best, float(step)
    if not len(best):
        best = np.array([_complex(shape.representative_point())[0]])
    return best, float(spacing * shrink)


def _centred(low: float, high: float, step: float) -> NDArray[np.float64]:
    """Values with a given step, symmetric about the middle of an interval."""
    n = max(1, int((high - low) / step))
    return np.asarray((low + high) / 2 + (np.arange(n) - (n - 1) / 2) * step, dtype=np.float64)


def _complex(geometry: shapely.Geometry) -> Complex:
    """Coordinates of a geometry as complex numbers; a ring's repeated last point is left out."""
    xy = shapely.get_coordinates(geometry)
    z = xy[:, 0] + 1j * xy[:, 1]
    return z[:-1] if len(z) > 1 and z[0] == z[-1] else z
