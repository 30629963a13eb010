"""Corners that persist over scales: what remains of a ring when the noise of its boundary is taken away (figure 4.21).

A hand-drawn or scanned outline falls apart into dozens of corners with tiny segments between them. Smallness does not
tell these from a window niche; noise is recognised by many turns to and fro, of all sizes. A noisy ring is explained by
the fewest straight lines and circular arcs that its own noise allows, and its corners are where they meet sharply:
corners that are there at every scale from the noise up. Clean rings stay as they are, to the last bit.

The vertices of a noisy ring are replaced, not only its corners: on the noisy line arc lengths would depend on the
tremor, tangents would be those of single strokes, and the nearest place would be a peak two deviations too near.
"""

from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from ..tolerances import (
    ARC_PRICE,
    CORNER_EVIDENCE,
    LARGEST_NOISE,
    LEAST_NOISY_TURNS,
    LINE_PRICE,
    NOISY_ALTERNATION,
    NOISY_SPREAD,
    NOISY_TURN,
    SMOOTH_TURN,
    SURE_TURN,
    VERTICES_PER_PIECE,
)
from .pieces import Line, Piece, cheapest_partition, deviations, fit_arc, fit_line, squared_deviations

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

#: Points that a ring is explained by at most: the work grows with their square. More vertices are averaged first.
_MOST_POINTS = 220
#: Edges longer than this many typical ones get points in between, since lines are fitted to points.
_LONG_EDGE = 4.0
#: Below this share of the size nothing is noise, and two vertices are one.
_LEAST_NOISE = 1e-6
#: Spread of turns that no noise needs to exceed (20 degrees): much of it makes hairpins, which are alike again.
_WIDE_SPREAD = np.radians(20.0)
#: Most that the root mean square of what is left may be, in deviations told from its third quartile (1.15 of them where
#: all tremble alike).
_HEAVY_TAIL = 2.0
#: Height of a step, in deviations of the noise, from which two lines side by side are not one.
_STEP = 4.0
#: Cosine of the angle between lines that go side by side (12 degrees): others meet.
_PARALLEL = np.cos(np.radians(12.0))
#: Scales at which a ring is explained, in estimates of its noise.
_SCALES = 2.0 ** np.array([-1, 0, 1])


@dataclass(frozen=True)
class ClearRing:
    """A ring without the noise of its boundary.

    Attributes
    ----------
    points : ndarray of shape (n, 2)
        Vertices without a repeated last one, those of the given ring where that is clean; the first is where the given
        ring's first vertex is nearest.
    sharp : ndarray of shape (n,), bool
        Which vertices are corners.
    labels : tuple of str
        A label per edge.
    noise : float
        Root mean square distance of the given vertices from this ring, in scene units; 0 for a clean ring.
    """

    points: Array
    sharp: Mask
    labels: tuple[str, ...]
    noise: float = 0.0


def sharp_vertices(ring: Array) -> Mask:
    """Which vertices of a clean ring are corners: those whose edges turn by more than the smooth limit (section 4.3).

    Parameters
    ----------
    ring : ndarray of shape (n, 2)
        Vertices without a repeated last one.

    Returns
    -------
    ndarray of shape (n,), bool

    Examples
    --------
    >>> octagon = np.exp(2j * np.pi * np.arange(8) / 8)
    >>> bool(sharp_vertices(np.stack([octagon.real, octagon.imag], 1)).all())
    True
    """
    after = np.concatenate([ring[1:], ring[:1]]) - ring
    after = after / np.hypot(after[:, 0], after[:, 1])[:, None]
    before = np.concatenate([after[-1:], after[:-1]])
    return np.einsum("ij,ij->i", before, after) <= SMOOTH_TURN


def clear_ring(ring: Array, labels: tuple[str, ...] = ()) -> ClearRing:
    """Take the noise from a ring.

    Parameters
    ----------
    ring : ndarray of shape (n, 2)
        Vertices without a repeated last one, distinct neighbours.
    labels : tuple of str
        A label per edge; empty: none has one.

    Returns
    -------
    ClearRing
        The ring itself where it is clean, or where no few pieces explain it.
    """
    labels = labels or ("",) * len(ring)
    if len(ring) >= LEAST_NOISY_TURNS:
        spread = _spread_of_turns(ring)
        explained = _explain(ring, spread) if spread >= NOISY_SPREAD else None
        if explained is not None:
            return _carry_over(ring, labels, *explained)
    return ClearRing(ring, sharp_vertices(ring), labels)


def _spread_of_turns(ring: Array) -> float:
    """The range in radians that the sizes of the turns fill; 0 where few turns alternate.

    A comb, a stair and a star turn to and fro as noise does, but by one or two angles; noise turns by any.
    """
    edges = np.roll(ring, -1, axis=0) - ring
    before = np.roll(edges, 1, axis=0)
    turns = np.arctan2(before[:, 0] * edges[:, 1] - before[:, 1] * edges[:, 0], (before * edges).sum(axis=1))
    turns = turns[np.abs(turns) > NOISY_TURN]
    n = len(turns)
    if n < LEAST_NOISY_TURNS or np.mean((turns > 0) != (np.roll(turns, 1) > 0)) < NOISY_ALTERNATION:
        return 0.0
    # Of how many pairs are the turns alike? The share of a range that a window of five degrees takes.
    window = 5
    counts = np.histogram(np.degrees(np.abs(turns)), bins=180, range=(0.0, 180.0))[0].astype(float)
    kernel = 1 - np.abs(np.arange(-window, window + 1)) / window
    alike = (counts @ np.convolve(counts, kernel, mode="same") - n) / (n * (n - 1))
    return float(np.radians(window) / max(alike, window / 180))


@dataclass(frozen=True)
class _Stretch:
    """A piece, the points that it explains, and where these begin and end; a step explains none."""

    piece: Piece
    points: Array
    first: Array
    last: Array

    @classmethod
    def through(cls, points: Array, bent: bool) -> "_Stretch":
        """The arc or line through points."""
        return cls((fit_arc if bent else fit_line)(points), points, points[0], points[-1])

    @property
    def direction_error(self) -> float:
        """Standard deviation, in radians, of the direction at an end, for deviations of the points by one."""
        return self.piece.direction_error / max(self.piece.length * max(len(self.points), 2) ** 0.5, 1e-9)


def _explain(ring: Array, spread: float) -> tuple[Array, Mask, float] | None:
    """The vertices and corners of the fewest pieces that explain a ring, and the noise they leave.

    None where they do not explain it, or where what they leave is no noise.
    """
    size = float(np.sqrt(shapely.Polygon(ring).area))
    centre = ring.mean(axis=0)
    points, count, noise = _points_to_explain((ring - centre) / size)
    sums = squared_deviations(points)
    runs, _, _ = _fewest_runs(*sums, count, noise)
    if len(runs) > 1:  # once more, cut where a piece ends
        points = np.roll(points, -runs[len(runs) // 2][0], axis=0)
        sums = squared_deviations(points)
    runs, bent, noise = _fewest_runs(*sums, count, noise)
    stretches = [_Stretch.through(points[i : j + 1], arc) for (i, j), arc in zip(runs, bent, strict=True)]
    if len(ring) < VERTICES_PER_PIECE * len(stretches):
        return None
    # So much noise on edges so short turns by about so much; regular turns fill less.
    edge = sum(s.piece.length for s in stretches) / len(ring)
    if spread < min(np.sqrt(6 * np.pi) * noise / edge / 2, _WIDE_SPREAD):
        return None
    vertices, sharp = _joined(_with_steps(stretches, noise), noise)
    outline = shapely.Polygon(vertices) if len(vertices) > 2 else shapely.Polygon()
    if not outline.is_valid or abs(outline.area - 1) > 3 * LARGEST_NOISE:
        return None
    # Most vertices tremble; where a few stick out far and the others do not move, these are features.
    left = shapely.distance(shapely.points((ring - centre) / size), outline.exterior)
    noise = float(np.sqrt(np.mean(left**2)))
    if noise > min(LARGEST_NOISE, _HEAVY_TAIL * float(np.quantile(left, 0.75)) / 1.15):
        return None
    return vertices * size + centre, sharp, noise * size


def _fewest_runs(
    line_sums: Array, arc_sums: Array, count: float, noise: float
) -> tuple[list[tuple[int, int]], list[bool], float]:
    """The runs that are one piece each, whether each is an arc, and the noise that remains.

    Every scale of noise has its own best runs. Of these, those are taken that say most with least: the logarithm of
    what remains, once per point, plus the prices.
    """
    found = []
    line_price, arc_price = LINE_PRICE * np.log(count), ARC_PRICE * np.log(count)
    for scale in noise * _SCALES:
        line_cost, arc_cost = line_sums / scale**2 + line_price, arc_sums / scale**2 + arc_price
        runs = cheapest_partition(np.minimum(line_cost, arc_cost))
        bent = [bool(arc_cost[run] < line_cost[run]) for run in runs]
        remains = sum(arc_sums[run] if arc else line_sums[run] for run, arc in zip(runs, bent, strict=True))
        price = sum(arc_price if arc else line_price for arc in bent)
        freedom = max(count - 2 * len(runs) - sum(bent), 1.0)
        deviation = float(np.sqrt(max(remains / freedom, _LEAST_NOISE**2)))
        found.append((count * np.log(max(remains / count, _LEAST_NOISE**2)) + price, runs, bent, deviation))
    _, runs, bent, deviation = min(found, key=lambda f: f[0])
    return runs, bent, deviation


def _points_to_explain(ring: Array) -> tuple[Array, float, float]:
    """Points at about equal distance along a ring from where it is widest, how many of them tremble, and how much."""
    # Each vertex against the middle of its neighbours, across the way the ring takes there.
    bump = ring - (np.roll(ring, 1, axis=0) + np.roll(ring, -1, axis=0)) / 2
    way = np.roll(ring, -4, axis=0) - np.roll(ring, 4, axis=0)
    way = way / np.maximum(np.hypot(*way.T), 1e-12)[:, None]
    across = np.abs(bump[:, 1] * way[:, 0] - bump[:, 0] * way[:, 1])
    # The median of normal deviations is 0.6745; the bump's variance is one and a half times the vertices'.
    noise = max(float(np.median(across)) / 0.6745 / np.sqrt(1.5), _LEAST_NOISE)
    edges = np.roll(ring, -1, axis=0) - ring
    lengths = np.hypot(*edges.T)
    typical = np.median(lengths)
    parts = np.where(lengths > _LONG_EDGE * typical, np.ceil(lengths / typical), 1).astype(np.intp)
    parts = np.minimum(parts, 1 + _MOST_POINTS // 4)
    share = np.concatenate([np.arange(k) / k for k in parts])
    points = np.repeat(ring, parts, axis=0) + share[:, None] * np.repeat(edges, parts, axis=0)
    widest = int(np.argmax(np.hypot(*(points - points.mean(axis=0)).T)))
    points = np.roll(points, -widest, axis=0)
    group = -(-len(points) // _MOST_POINTS)
    if group > 1:
        points = np.array([part.mean(axis=0) for part in np.array_split(points, len(points) // group)])
    # What lies on a long edge between its ends has no tremor of its own.
    return points, len(ring) / parts.sum() * len(points), noise / np.sqrt(group)


def _with_steps(stretches: list[_Stretch], noise: float) -> list[_Stretch]:
    """The stretches and, where lines go side by side, the step from one to the other: a jog too short to be a piece."""
    result = []
    for before, after in zip([stretches[-1], *stretches[:-1]], stretches, strict=True):
        a, b = before.piece, after.piece
        # Arcs are too uncertain at their ends to tell.
        if isinstance(a, Line) and isinstance(b, Line) and a is not b and a.direction @ b.direction >= _PARALLEL:
            between = (before.last + after.first) / 2
            start, end = a.nearest(between), b.nearest(between)
            height = float(np.hypot(*(end - start)))
            if _STEP * noise < height < min(a.length, b.length) and _meeting(before, after, noise) is None:
                step = Line(between, (end - start) / height, height)
                result.append(_Stretch(step, np.zeros((0, 2)), start, end))
        result.append(after)
    return result


def _joined(stretches: list[_Stretch], noise: float) -> tuple[Array, Mask]:
    """The vertices where stretches meet and along their arcs, and which of them are corners."""
    if len(stretches) == 1:
        start = stretches[0].piece.nearest(stretches[0].first)
        vertices = np.vstack([start, stretches[0].piece.between(start, start)])
        return vertices, np.zeros(len(vertices), dtype=bool)
    joints, sharp = [], []
    for before, after in zip([stretches[-1], *stretches[:-1]], stretches, strict=True):
        joint = _meeting(before, after, noise)
        if joint is None:
            between = (before.last + after.first) / 2
            joint = (before.piece.nearest(between) + after.piece.nearest(between)) / 2
        joints.append(joint)
        sharp.append(_is_corner(before, after, joint, noise))
    every, corners = [], []
    for k, stretch in enumerate(stretches):
        along = stretch.piece.between(joints[k], joints[(k + 1) % len(joints)])
        every.append(np.vstack([joints[k], along]))
        corners += [sharp[k], *[False] * len(along)]
    vertices, is_corner = np.concatenate(every), np.array(corners)
    doubled = np.hypot(*(np.roll(vertices, -1, axis=0) - vertices).T) < _LEAST_NOISE
    is_corner |= np.roll(is_corner & doubled, 1)
    return vertices[~doubled], is_corner[~doubled]


def _meeting(before: _Stretch, after: _Stretch, noise: float) -> Array | None:
    """Where two pieces meet, by turns the nearest point of each; None where they do not near the points between."""
    between = place = (before.last + after.first) / 2
    for _ in range(60):
        place = after.piece.nearest(before.piece.nearest(place))
    reach = float(np.hypot(*(after.first - before.last))) + 4 * noise
    apart = float(np.hypot(*(before.piece.nearest(place) - place)))
    return place if apart <= noise and np.hypot(*(place - between)) <= reach else None


def _is_corner(before: _Stretch, after: _Stretch, joint: Array, noise: float) -> bool:
    """Whether two pieces meet sharply, their directions being as uncertain as they are."""
    a, b = before.piece.direction_at(joint), after.piece.direction_at(joint)
    turn = float(np.arctan2(abs(a[0] * b[1] - a[1] * b[0]), a @ b))
    error = noise * float(np.hypot(before.direction_error, after.direction_error))
    if turn - error <= np.arccos(SMOOTH_TURN):
        return False
    if turn >= SURE_TURN or not len(before.points) or not len(after.points):
        return True
    # A bend of this size may be part of a curve: is one arc through both sides much worse than the corner?
    side = min(before.piece.length, after.piece.length)
    left, right = (max(2, round(len(s.points) * side / s.piece.length)) for s in (before, after))
    both = np.vstack([before.points[-left:], after.points[:right]])
    arc = (deviations(fit_arc(both), both) ** 2).sum()
    corner = (deviations(before.piece, before.points[-left:]) ** 2).sum()
    corner += (deviations(after.piece, after.points[:right]) ** 2).sum()
    return bool(arc - corner > CORNER_EVIDENCE * noise**2)


def _carry_over(ring: Array, labels: tuple[str, ...], points: Array, sharp: Mask, noise: float) -> ClearRing:
    """The clear ring with the labels and the first vertex of the given one."""
    line = shapely.LineString(np.vstack([points, points[:1]]))
    arcs = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line.coords, axis=0).T))])

    def place(vertex: Array) -> float:
        """Arc length of the nearest place; that of a vertex where one is as near as the noise."""
        at = float(line.line_locate_point(shapely.Point(vertex)))
        nearest = float(arcs[np.argmin(np.abs(arcs - at))])
        return nearest % float(arcs[-1]) if abs(nearest - at) <= 2 * noise else at

    start = place(ring[0])
    changes = {place(ring[i]): labels[i] for i in range(len(ring)) if labels[i - 1] != labels[i]} or {start: labels[0]}
    added = sorted({start, *changes} - set(arcs.tolist()))
    every = np.concatenate([arcs[:-1], added])
    order = np.argsort((every - start) % arcs[-1], kind="stable")
    points = np.vstack([points, shapely.get_coordinates(line.interpolate(added))])[order]
    sharp = np.concatenate([sharp, np.zeros(len(added), dtype=bool)])[order]
    keys = np.array(sorted(changes))
    names = tuple(changes[float(keys[np.searchsorted(keys, at, side="right") - 1])] for at in every[order])
    return ClearRing(points, sharp, names, noise)
