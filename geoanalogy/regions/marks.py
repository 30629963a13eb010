"""Drawings of short marks: dots, dashes, broken outlines.

Where lines are short, there is no course to follow and no turn to measure; only the places of the marks say something.
The query's marks are laid over groups of marks in every direction, and moved onto them while the distance over which
they see each other shrinks: every mark is drawn to the average of the marks near its image, marks that nothing comes
near are left out, and the transformation is first a similarity, then a function that varies slowly over the region.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..geometry.contours import Complex, Contours, Floats
from .courses import Course, lengths
from .fitting import Fit, Fitter
from .groups import GAPS, groups
from .least_squares import Blended
from .options import RegionOptions
from .query import LEAST_MARKS, Query, Run
from .transformation import TransformationFunction

#: A query is one of marks where half of its many stretches are shorter than the first share of its extent, and none is
#: as long as the second: what has an outline has a line about as long as itself, whatever pattern is on its back.
SHORT, MAIN = 0.2, 0.85
#: Distance of the points that longer stretches are taken as, in extents of the query, and points in all.
APART, MOST_POINTS = 0.035, 400
#: Directions that are tried, groups that they are tried on, and starts that are followed to the end.
DIRECTIONS, MOST_GROUPS, FOLLOWED = 24, 8, 8
#: Factor by which a similarity's scale may move from that of its start.
RESIZED = 1.15
#: Points that the first rounds look at, of the query and of a group.
FEW, SOME = 60, 140
#: Distances over which marks see each other, in extents of the query at the target's scale: while similarities are
#: moved, and while functions are bent.
COARSE = tuple(np.geomspace(0.25, 0.05, 7))
FINE = tuple(np.geomspace(0.1, 0.012, 14))
#: Stiffness of the functions at the first and at the last of the fine rounds: (strain, bend).
STIFF, SOFT = (0.3, 0.3), (0.01, 0.03)
#: Squared distance, in units of the distance seen, at which a mark is as likely to have no counterpart.
ALONE = 4.0


@dataclass(frozen=True)
class Marked:
    """A fit of marks.

    Attributes
    ----------
    fit : Fit
        Its counterparts are those of the fitter's samples.
    coverage : float
        Share of the query's marks with a counterpart.
    near : float
        Root mean square distance of marks and counterparts, in extents of the query at the target's scale.
    own : float
        Share of the marks among the counterparts that have one: clutter between them has none.
    """

    fit: Fit
    coverage: float
    near: float
    own: float


def of_marks(contours: Contours, query: Query) -> bool:
    """Whether a query is one of marks.

    Parameters
    ----------
    contours : Contours
    query : Query

    Returns
    -------
    bool
    """
    own = lengths(contours, query.runs)
    return len(own) >= LEAST_MARKS and bool(np.median(own) < SHORT * query.size and own.max() < MAIN * query.size)


def places(contours: Contours, runs: list[Run], size: float) -> Complex:
    """The marks as points: the middle of short ones, points along the others.

    Parameters
    ----------
    contours : Contours
    runs : list of Run
    size : float
        Extent of the query.

    Returns
    -------
    (n,) complex
    """
    own = lengths(contours, runs)
    counts = np.maximum(1, np.round(own / (APART * size))).astype(int)
    if counts.sum() > MOST_POINTS:
        counts = np.maximum(1, (counts * MOST_POINTS / counts.sum()).astype(int))
    parts = []
    for run, count in zip(runs, counts, strict=True):
        line = Course.along(contours, run, 2 * int(count) + 1).points
        parts.append(line[1::2])
    return np.concatenate(parts)


def laid(fitter: Fitter, contours: Contours, query: Query, options: RegionOptions) -> list[Marked]:
    """Fits of a query of marks, best first.

    Parameters
    ----------
    fitter : Fitter
    contours : Contours
    query : Query
    options : RegionOptions
        `mirrored` and `largest_scale` are used.

    Returns
    -------
    list of Marked
    """
    source, target = places(contours, query.runs, query.size), places(contours, query.rest, query.size)
    starts: list[tuple[float, complex, complex, bool]] = []
    for flip in (False, True) if options.mirrored else (False,):
        for a, b in _starts(fitter, source, np.conj(target) if flip else target, options.largest_scale, flip):
            starts += _moved(source, np.conj(target) if flip else target, a, b, query.size, flip)
    starts.sort(key=lambda s: -s[0])
    kept: list[tuple[complex, complex, bool]] = []
    middle = source.mean()
    for _, p, q, flip in starts:
        if all(
            f != flip or abs(p * middle + q - c * middle - d) + abs(p - c) * query.size > 0.2 * abs(p) * query.size
            for c, d, f in kept
        ):
            kept.append((p, q, flip))
        if len(kept) == FOLLOWED:
            break
    return [_bent(fitter, source, target, *start) for start in kept]


def _starts(
    fitter: Fitter, source: Complex, target: Complex, largest_scale: float, flip: bool
) -> Iterator[tuple[Complex, Complex]]:
    """Similarities that lay the query over each group of marks, in every direction, at its size and at the query's."""
    spread = _spread(source)
    turn = np.exp(2j * np.pi * np.arange(DIRECTIONS) / DIRECTIONS)
    seen: set[int] = set()
    for gap in GAPS[::-1]:
        for group in groups(fitter.target, gap * fitter.size)[:MOST_GROUPS]:
            points = np.conj(fitter.target.points[group]) if flip else fitter.target.points[group]
            own = _spread(points) / spread
            if hash(group.tobytes()) in seen or not 0.5 / largest_scale < own < 2.0 * largest_scale:
                continue
            seen.add(hash(group.tobytes()))
            scales = np.repeat([own, 1.0] if 0.4 < own < 2.5 else [own], DIRECTIONS)
            a = scales * np.tile(turn, len(scales) // DIRECTIONS)
            yield a, points.mean() - a * source.mean()


def _moved(
    source: Complex, target: Complex, a: Complex, b: Complex, size: float, flip: bool
) -> list[tuple[float, complex, complex, bool]]:
    """Similarities moved onto marks, with the share of the query's marks that have a counterpart then."""
    x = source[:: max(1, len(source) // FEW)]
    near = np.abs(target - (a * source.mean() + b).mean()) < 1.5 * size * np.abs(a).max()
    y = target[near][:: max(1, int(near.sum()) // SOME)]
    if len(y) < 3:
        return []
    first = np.abs(a)
    for seen in COARSE:
        goal, weight = _drawn(a[:, None] * x + b[:, None], y, seen * size * first)
        share = weight / np.maximum(weight.sum(1, keepdims=True), 1e-12)
        cx, cy = (share * x).sum(1), (share * goal).sum(1)
        dx, dy = x - cx[:, None], goal - cy[:, None]
        a = (share * dy * np.conj(dx)).sum(1) / np.maximum((share * np.abs(dx) ** 2).sum(1), 1e-12)
        # what sees far is drawn to the middle: sizes would shrink, and what is small sees less and shrinks on
        grown = np.abs(a) / first
        way: Complex = np.where(grown > 0.0, a / np.maximum(grown, 1e-9), first.astype(complex))
        a = way * np.clip(grown, 1.0 / RESIZED, RESIZED)
        b = cy - a * cx
    _, weight = _drawn(a[:, None] * x + b[:, None], y, COARSE[-1] * size * first)
    return [
        (float(w), complex(p), complex(q), flip) for w, p, q in zip(np.minimum(weight, 1.0).mean(1), a, b, strict=True)
    ]


def _drawn(image: Complex, target: Complex, seen: Floats) -> tuple[Complex, Floats]:
    """Where each image is drawn, and how strongly, (h, n): the average of the marks that see it.

    Every mark shares itself among the images that it sees. Were it the images that chose, all would be drawn to the
    middle; so the outermost mark draws the outermost image.
    """
    square = (np.abs(target - image[:, :, None]) / seen[:, None, None]) ** 2
    pull = np.exp(-0.5 * square)
    pull /= pull.sum(1, keepdims=True) + np.exp(-0.5 * ALONE)
    weight = pull.sum(2)
    return (pull @ target) / np.maximum(weight, 1e-12), weight


def _bent(fitter: Fitter, source: Complex, target: Complex, a: complex, b: complex, flip: bool) -> Marked:
    """A similarity bent until the marks lie on each other."""
    y = np.conj(target) if flip else target
    blended = Blended(fitter.nodes, source)
    rows = blended.rows
    m = len(fitter.nodes.at)
    unknowns: Complex = np.concatenate([a * fitter.nodes.at + b, np.full(m, a)])
    for k, seen in enumerate(FINE):
        part = k / (len(FINE) - 1)
        stiffness = tuple(s ** (1 - part) * t**part for s, t in zip(STIFF, SOFT, strict=True))
        unit = fitter.size * float(np.abs(unknowns[m:]).mean())
        goal, weight = _drawn((rows @ unknowns)[None], y, np.array([seen * unit]))
        unknowns = fitter.solve(blended, goal, weight + 1e-6, (stiffness[0], stiffness[1]))[0]
    function = TransformationFunction(fitter.nodes, unknowns[:m], unknowns[m:], flip)
    unit = fitter.size * float(np.abs(unknowns[m:]).mean())
    image = rows @ unknowns
    gap = np.abs(y[None] - image[:, None]) / unit
    has = gap.min(1) < APART
    own = _inside(image, y, gap)
    near = float(np.sqrt((gap.min(1)[has] ** 2).mean())) if has.any() else np.inf
    return Marked(_counted(fitter, function), float(has.mean()), near, own)


def _inside(image: Complex, target: Complex, gap: Floats) -> float:
    """Share of the marks within the images' extent that are near an image."""
    reach = np.abs(image - image.mean()).max()
    within = np.abs(target - image.mean()) <= reach
    return float((gap.min(0)[within] < APART).mean()) if within.any() else 0.0


def _counted(fitter: Fitter, function: TransformationFunction) -> Fit:
    """A function as a fit: each sample's counterpart is the nearest point of a line, whichever way that runs."""
    image = function(fitter.sampling.samples.points)
    gap, near = fitter.target.tree.query(np.stack([image.real, image.imag], 1))
    gap = gap / (fitter.size * float(np.abs(function.factor).mean()))
    counterpart: NDArray[np.intp] = np.where(gap < APART, near, -1)
    return Fit(function, counterpart, np.where(counterpart >= 0, gap, np.inf), np.zeros(len(gap)))


def _spread(z: Complex) -> float:
    """Root mean square distance from the centre."""
    return float(np.sqrt((np.abs(z - z.mean()) ** 2).mean()))
