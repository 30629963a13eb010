"""Chains of chords: corners of the query laid along corners of the drawing.

Elastic alignment (`alignment`) compares how lines turn; where a shape has few but sharp corners, or a part of it is
missing, the corners themselves and the chords between them say more. A chord of the query laid on a chord of the
drawing is a first-order correspondence: it has a scale and a rotation. Two that follow each other along both lines are
as alike as their transformations are, which is the similarity of section 3.2 taken along the line. A chain of them
needs no position, no scale and no rotation, and it ends where the line was cut. Between two corners that is, as a rule:
a chord to the end of an open line is shorter than its counterpart, so that its rotation says something, and of its
scale only whether it is too large.

The score of a chain is a logarithm of odds: every joint of two chords adds what its change of scale and of rotation
says for one shape that was bent rather than two that have nothing in common, every corner that only one line has costs.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import shapely

from ..geometry.contours import Complex, Contours, Floats, Indices
from .chords import SCALE_GAIN, TURN_GAIN, Block, Walk
from .courses import lengths
from .query import Run

#: Grades of detail: distance, in extents of a line, within which vertices are no corners, and longest chord, as a share
#: of a line's length. What only one grade says is chance, what all of them say is the shape.
GRADES = tuple((corner, chord) for corner in (0.015, 0.01, 0.006) for chord in (1.0, 0.1))
#: Corners of the drawing that are compared at once: what fits into the processor's cache.
WIDTH = 900
#: Of the drawing's stretches, those that the finer grades look at: the best of the coarsest grade, and more that are
#: worth this share of the best.
LEADING, MOST_LEADING, NEARLY = 12, 36, 0.6
#: Stretches of the query and of the drawing, longest first, and corners in all, that are compared.
MOST_SOURCES, MOST_TARGETS, MOST_CORNERS = 4, 80, 1_500
#: Length of a stretch of the query, in lengths of the longest, below which it is left out.
LEAST_LENGTH = 0.2
#: Corners of a stretch at most; of lines with more the smallest are left out.
MOST_OF_LINE = 90
#: Chains that are kept, best first, and the least score of one that is, in all and beside the best so far.
MOST_CHAINS, LEAST_SCORE, WEAK = 500, 1.5, 0.2
#: Pairs of points that a chain is sampled with: where they lie along it.
EVENLY = np.linspace(0.0, 1.0, 48)


@dataclass(frozen=True)
class Chain:
    """Corners of the query and their counterparts.

    Attributes
    ----------
    source, target : (n,) complex
        Corresponding points, evenly along the query's line; the target's are conjugated where mirrored.
    mirrored : bool
    score : float
        Logarithm of odds.
    grade : int
        Number of the grade of detail.
    run : int
        Number of the query's stretch.
    """

    source: Complex
    target: Complex
    mirrored: bool
    score: float
    grade: int
    run: int


@dataclass(frozen=True)
class Chains:
    """All chains of a query.

    Attributes
    ----------
    found : list of Chain
        Best first.
    most : (g, k) float
        Score, by grade and stretch of the query, that an identical copy would have.
    """

    found: list[Chain]
    most: Floats


def corners(line: Complex, closed: bool, grade: tuple[float, float]) -> Complex:
    """The corners of a line: the vertices of a simpler line that is nearly the same.

    Parameters
    ----------
    line : (n,) complex
    closed : bool
    grade : (float, float)
        One of GRADES.

    Returns
    -------
    (k,) complex
        Closed lines begin at the point that is farthest from their centre, wherever they were begun.
    """
    return _divided(_simpler(line, closed, grade[0]), closed, grade[1])


def _simpler(line: Complex, closed: bool, near: float) -> Complex:
    """The vertices of a simpler line within a distance in extents of the line; closed ones repeat the first."""
    extent = float(np.hypot(np.ptp(line.real), np.ptp(line.imag)))
    if closed:
        line = np.roll(line, -int(np.abs(line - line.mean()).round(9).argmax()))
        line = np.append(line, line[0])
    tolerance, whole = near * extent, shapely.linestrings(np.stack([line.real, line.imag], 1))
    while True:
        xy = shapely.get_coordinates(shapely.simplify(whole, tolerance))
        if len(xy) <= MOST_OF_LINE:
            return np.asarray(xy[:, 0] + 1j * xy[:, 1], dtype=np.complex128)
        tolerance *= 1.5


def _divided(z: Complex, closed: bool, longest: float) -> Complex:
    """A line whose chords are no longer than a share of its length; of closed ones without the repeated first point."""
    step = np.abs(np.diff(z))
    parts = np.maximum(1, np.round(step / (longest * step.sum()))).astype(int)
    if (parts > 1).any():
        within = np.concatenate([np.arange(n) / n for n in parts])
        z = np.append(np.repeat(z[:-1], parts) + np.repeat(np.diff(z), parts) * within, z[-1])
    return z[:-1] if closed else z


def compared(contours: Contours, runs: list[Run]) -> list[Run]:
    """The stretches of a query that are compared with the drawing: the longest, of about its length.

    Parameters
    ----------
    contours : Contours
    runs : list of Run
        Longest first.

    Returns
    -------
    list of Run
    """
    length = lengths(contours, runs[:MOST_SOURCES])
    return [run for run, own in zip(runs, length, strict=False) if own >= LEAST_LENGTH * length[0]]


class _Lines:
    """Stretches of line and their corners, each found when it is first asked for.

    Parameters
    ----------
    contours : Contours
    runs : list of Run
    """

    def __init__(self, contours: Contours, runs: list[Run]):
        self.contours, self.runs = contours, runs
        self._simpler: dict[tuple[int, float], Complex] = {}

    def corners(self, k: int, grade: tuple[float, float]) -> Complex:
        """The corners of a stretch at a grade of detail."""
        run, key = self.runs[k], (k, grade[0])
        if key not in self._simpler:
            self._simpler[key] = _simpler(self.contours.drawn[run.indices], run.closed, grade[0])
        return _divided(self._simpler[key], run.closed, grade[1])


def chain(contours: Contours, sources: list[Run], targets: list[Run], mirrored: bool) -> Chains:
    """The best chains of stretches of the query with stretches of the drawing.

    Parameters
    ----------
    contours : Contours
    sources : list of Run
        Stretches of the query, longest first; those shorter than a fifth of the longest are left out.
    targets : list of Run
        Stretches where matches are looked for, longest first.
    mirrored : bool
        Whether mirror images are wanted.

    Returns
    -------
    Chains
    """
    sources = compared(contours, sources)
    own_lines, lines = _Lines(contours, sources), _Lines(contours, targets[:MOST_TARGETS])
    found: list[_Found] = []
    most = np.zeros((len(GRADES), len(sources)))
    promising = [np.arange(len(lines.runs))] * len(sources)
    for g, grade in enumerate(GRADES):
        for k, run in enumerate(sources):
            own = own_lines.corners(k, grade)
            joints = len(own) - (1 if run.closed else 2)
            if joints < 1:
                continue
            most[g, k] = joints * (TURN_GAIN + SCALE_GAIN)
            if run.closed and _area(own) < 0.0:
                own = own[::-1]
            best = np.zeros(len(lines.runs))
            for row in _rows(lines, grade, promising[k], run.closed, mirrored):
                walk = Walk(own, run.closed, row)
                least = max(LEAST_SCORE, WEAK * best.max())
                for block, value in zip(row, walk.best, strict=True):
                    best[block.target] = max(best[block.target], value if value > least else 0.0)
                if len(found) > MOST_CHAINS:
                    found = sorted(found, key=lambda f: -f.score)[:MOST_CHAINS]
                    least = max(least, found[-1].score)
                found += [_Found(*way, walk.source, run.closed, g, k) for way in walk.ways(least)]
            if g == 0:
                promising[k] = _leading(best)
    found = sorted(found, key=lambda f: -f.score)[:MOST_CHAINS]
    return Chains([f.chain() for f in found], most)


@dataclass(frozen=True)
class _Found:
    """A chain before it is sampled: its score, the corners it visits, and where they are."""

    score: float
    block: Block
    way: Indices
    source: Complex
    closed: bool
    grade: int
    run: int

    def chain(self) -> Chain:
        """The chain, sampled evenly along the query's line."""
        q, t = self.way.T
        n = len(self.block.corners)
        line, way = self.source[q[0] : q[-1] + 1], self.block.corners[np.arange(t[0], t[-1] + 1) % n]
        arc, goal = _arc(line), _arc(way)
        own, other = arc[q - q[0]], goal[t - t[0]]
        if self.closed and not self.block.closed and len(q) > 3:
            # where the line was cut, it ends somewhere on the way to the corner, as its scale says
            scale = (other[-2] - other[1]) / (own[-2] - own[1])
            if t[0] == 0:
                own[0] = max(own[0], own[1] - (other[1] - other[0]) / scale)
            if t[-1] == n - 1:
                own[-1] = min(own[-1], own[-2] + (other[-1] - other[-2]) / scale)
        where = own[0] + (own[-1] - own[0]) * EVENLY
        points, there = np.interp(where, arc, line), np.interp(np.interp(where, own, other), goal, way)
        return Chain(points, there, self.block.mirrored, self.score, self.grade, self.run)


def _leading(best: Floats) -> Indices:
    """Targets that are worth a closer look, in their order: the first LEADING, and some that are nearly as good."""
    order = np.argsort(-best, kind="stable")[:MOST_LEADING]
    return np.sort(order[(np.arange(len(order)) < LEADING) | (best[order] >= NEARLY * best[order[0]])])


def _area(ring: Complex) -> float:
    """Twice the signed area of a ring."""
    return float((np.conj(ring) * np.roll(ring, -1)).imag.sum())


def _rows(
    lines: _Lines, grade: tuple[float, float], which: Indices, source_closed: bool, mirrored: bool
) -> Iterator[list[Block]]:
    """Every stretch of the drawing in every direction, mirrored or not, in rows of about WIDTH corners.

    Rings are compared counter-clockwise only: the other way round a region would be turned inside out.
    """
    start, corners_seen = 0, 0
    row: list[Block] = []
    for k in which:
        own, closed = lines.corners(k, grade), lines.runs[k].closed
        if len(own) < 3:
            continue
        if corners_seen > MOST_CORNERS:
            break
        corners_seen += len(own)
        for flip in (False, True) if mirrored else (False,):
            one = np.conj(own) if flip else own
            if closed and _area(one) < 0.0:
                one = one[::-1]
            for way in (one,) if closed and source_closed else (one, one[::-1]):
                row.append(Block(start, closed, way, flip, k))
                start += len(way)
        if start >= WIDTH:
            yield row
            start, row = 0, []
    if row:
        yield row


def _arc(line: Complex) -> Floats:
    """Arc length at the vertices of a line."""
    return np.concatenate([[0.0], np.cumsum(np.abs(np.diff(line)))])
