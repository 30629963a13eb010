"""Chains of chords: corners of the query laid along corners of the drawing.

Elastic alignment (`alignment`) compares how lines turn; where a shape has few but sharp corners, or a part of it is
missing, the corners themselves and the chords between them say more. A chord of the query laid on a chord of the
drawing is a first-order correspondence: it has a scale and a rotation. Two that follow each other along both lines are
as alike as their transformations are, which is the similarity of section 3.2 taken along the line. A chain of them
needs no position, no scale and no rotation, and it ends where the line was cut.

The score of a chain is a logarithm of odds: every joint of two chords adds what its change of scale and of rotation
says for one shape that was bent rather than two that have nothing in common, every corner that only one line has costs.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from ..geometry.contours import Complex, Contours, Floats, Indices
from .courses import lengths
from .query import Run

#: Grades of detail: distance, in extents of a line, within which vertices are no corners, and longest chord, as a share
#: of a line's length. What only one grade says is chance, what all of them say is the shape.
GRADES = tuple((corner, chord) for corner in (0.006, 0.01, 0.015) for chord in (1.0, 0.1))
#: Uncertainty of a corner's place, in extents of its line.
BLUR = 0.006
#: Chords that a chord may take in at most: two corners of either line may have no counterpart.
TAKEN_IN = 3
#: Standard deviation of the change of rotation, and of the logarithm of scale, at a joint of one bent shape.
TURN, SCALE = np.radians(14.0), 0.28
#: What a joint without any change is worth, for its rotation and for its scale, and the most that one costs.
TURN_GAIN, SCALE_GAIN, MOST_COST = 1.2, 1.0, 3.0
#: What a corner without counterpart costs, and how much more where it stands out by SALIENT of the chord's length.
MISSED, MISSED_MORE, SALIENT = 0.4, 1.5, 0.12
#: Stretches of the query and of the drawing, longest first, and corners in all, that are compared.
MOST_SOURCES, MOST_TARGETS, MOST_CORNERS = 4, 80, 1_500
#: Length of a stretch of the query, in lengths of the longest, below which it is left out.
LEAST_LENGTH = 0.2
#: Corners of a stretch at most; of lines with more the smallest are left out.
MOST_OF_LINE = 90
#: Chains of every stretch that are kept, and the least score of one that is.
KEPT, LEAST_SCORE = 3, 1.5
#: Pairs of points that a chain is sampled with.
PAIRS = 48


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


@dataclass(frozen=True)
class _Block:
    """A stretch of the drawing, in one direction, mirrored or not, and where its corners stand in the row of all."""

    start: int
    period: int
    corners: Complex
    mirrored: bool


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
    extent = float(np.hypot(np.ptp(line.real), np.ptp(line.imag)))
    if closed:
        line = np.roll(line, -int(np.abs(line - line.mean()).round(9).argmax()))
        line = np.append(line, line[0])
    tolerance = grade[0] * extent
    while True:
        kept = shapely.simplify(shapely.linestrings(np.stack([line.real, line.imag], 1)), tolerance)
        xy = shapely.get_coordinates(kept)
        if len(xy) <= MOST_OF_LINE:
            break
        tolerance *= 1.5
    z = np.asarray(xy[:, 0] + 1j * xy[:, 1], dtype=np.complex128)
    step = np.abs(np.diff(z))
    parts = np.maximum(1, np.round(step / (grade[1] * step.sum()))).astype(int)
    within = np.concatenate([np.arange(n) / n for n in parts])
    z = np.append(np.repeat(z[:-1], parts) + np.repeat(np.diff(z), parts) * within, z[-1])
    return z[:-1] if closed else z


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
    length = lengths(contours, sources[:MOST_SOURCES])
    sources = [run for run, own in zip(sources, length, strict=False) if own >= LEAST_LENGTH * length[0]]
    found: list[Chain] = []
    most = np.zeros((len(GRADES), len(sources)))
    for g, grade in enumerate(GRADES):
        blocks: dict[bool, list[_Block]] = {}
        for k, run in enumerate(sources):
            own = corners(contours.drawn[run.indices], run.closed, grade)
            joints = len(own) - (1 if run.closed else 2)
            if joints < 1:
                continue
            most[g, k] = joints * (TURN_GAIN + SCALE_GAIN)
            if run.closed not in blocks:
                blocks[run.closed] = list(_blocks(contours, targets, run.closed, mirrored, grade))
            if blocks[run.closed]:
                if run.closed and _area(own) < 0.0:
                    own = own[::-1]
                found += _Walk(own, run.closed, blocks[run.closed]).chains(g, k)
    found.sort(key=lambda c: -c.score)
    return Chains(found, most)


def _area(ring: Complex) -> float:
    """Twice the signed area of a ring."""
    return float((np.conj(ring) * np.roll(ring, -1)).imag.sum())


def _blocks(
    contours: Contours, targets: list[Run], source_closed: bool, mirrored: bool, grade: tuple[float, float]
) -> Iterator[_Block]:
    """Every stretch of the drawing in every direction, mirrored or not; rings are compared counter-clockwise only."""
    start = 0
    for run in targets[:MOST_TARGETS]:
        own = corners(contours.drawn[run.indices], run.closed, grade)
        if len(own) < 3:
            continue
        if start > MOST_CORNERS * (4 if mirrored else 2):
            break
        for flip in (False, True) if mirrored else (False,):
            one = np.conj(own) if flip else own
            if run.closed and _area(one) < 0.0:
                one = one[::-1]
            for way in (one,) if run.closed and source_closed else (one, one[::-1]):
                z = np.tile(way, 2) if run.closed else way
                yield _Block(start, len(way) if run.closed else 0, z, flip)
                start += len(z) + TAKEN_IN


class _Walk:
    """The dynamic programme along one stretch of the query, over all blocks at once.

    A state is a pair of chords: (corner e where the query's ends, corners a it takes in; b corners that the target's
    takes in, corner of the row of blocks where it ends). Arrays are (rows, a, b, columns).
    """

    def __init__(self, source: Complex, closed: bool, blocks: list[_Block]):
        self.blocks = blocks
        self.count, self.closed = len(source), closed
        extent = float(np.hypot(np.ptp(source.real), np.ptp(source.imag)))
        self.source = np.tile(source, 2) if closed else source
        rows, width = len(self.source), blocks[-1].start + len(blocks[-1].corners) + TAKEN_IN
        row = np.full(width, np.nan, complex)
        room = np.full(width, 10**6)
        for block in blocks:
            here = slice(block.start, block.start + len(block.corners))
            row[here] = block.corners / np.hypot(np.ptp(block.corners.real), np.ptp(block.corners.imag))
            if block.period:
                room[here] = block.period
        shape = (rows, TAKEN_IN, TAKEN_IN, width)
        self.score = np.full(shape, -np.inf, np.float32)
        self.back = np.full(shape, -1, np.int8)
        self.begin_row, self.begin_column = np.zeros(shape, np.int16), np.zeros(shape, np.int32)
        self._fill(self.source / extent, row, room)

    def _fill(self, source: Complex, row: Complex, room: Indices) -> None:
        """All states, row by row."""
        width = len(row)
        change = np.zeros(self.score.shape[1:], np.complex64)  # of the row of states at hand
        blur = np.zeros(self.score.shape[1:], np.float32)
        column = np.arange(width)
        begin = np.stack([np.roll(column, b) for b in range(1, TAKEN_IN + 1)])  # where chords that end here begin
        begin = np.where(begin > column, 0, begin)
        chord = row[None] - row[begin]
        chord[np.abs(chord) == 0.0] = np.nan
        missed = np.stack([_missed(row, begin[b - 1], b, chord[b - 1]) for b in range(1, TAKEN_IN + 1)])
        with np.errstate(invalid="ignore"):
            length, own_blur = np.log(chord).astype(np.complex64), (BLUR / np.abs(chord)).astype(np.float32) ** 2
        possible = np.isfinite(length.real)
        recent: dict[int, tuple[NDArray, ...]] = {}
        for e in range(len(source)):
            for a in range(1, min(TAKEN_IN, e) + 1):
                s = e - a
                step = source[e] - source[s]
                if step == 0.0:
                    continue
                price = _missed(source, np.array([s]), a, np.array([step]))[0]
                now = length - np.complex64(np.log(step))  # (b, columns)
                doubt = own_blur + np.float32((BLUR / abs(step)) ** 2)
                # the chords before: (a', b', b, columns), where this one begins
                score, ratio, turned, unsure, first_row, first_column = recent[s]
                unsure = unsure + doubt
                turn = now.imag - turned
                turn -= np.float32(2.0 * np.pi) * np.round(turn * np.float32(0.5 / np.pi))
                most = np.float32(MOST_COST)
                worth = score - np.minimum(turn**2 / (np.float32(2.0 * TURN**2) + 2.0 * unsure), most)
                worth -= np.minimum((now.real - ratio) ** 2 / (np.float32(2.0 * SCALE**2) + 2.0 * unsure), most)
                fits = column - first_column <= room
                if self.closed:
                    fits &= e - first_row <= self.count
                worth = np.where(fits & (worth > 0.0), worth, 0.0).reshape(-1, TAKEN_IN, width)
                best = worth.argmax(0)
                value = np.take_along_axis(worth, best[None], 0)[0]
                goes_on = value > 0.0
                at = np.unravel_index(best, (TAKEN_IN, TAKEN_IN))
                self.score[e, a - 1] = np.where(possible, value - price - missed, -np.inf)
                self.back[e, a - 1] = np.where(goes_on, best, -1)
                self.begin_row[e, a - 1] = np.where(goes_on, self.begin_row[s][at[0], at[1], begin], s)
                self.begin_column[e, a - 1] = np.where(goes_on, self.begin_column[s][at[0], at[1], begin], begin)
                change[a - 1], blur[a - 1] = now, doubt
            ended = change[:, :, begin]
            recent[e] = (
                self.score[e][:, :, begin] + np.float32(TURN_GAIN + SCALE_GAIN),
                ended.real.copy(),
                ended.imag.copy(),
                blur[:, :, begin],
                self.begin_row[e][:, :, begin],
                self.begin_column[e][:, :, begin],
            )
            recent.pop(e - TAKEN_IN, None)

    def chains(self, grade: int, run: int) -> list[Chain]:
        """The best chains of every block, each with another beginning."""
        out: list[Chain] = []
        for block in self.blocks:
            here = slice(block.start, block.start + len(block.corners))
            score = self.score[:, :, :, here].copy()
            first = self.begin_row[:, :, :, here] % self.count if self.closed else self.begin_row[:, :, :, here]
            second = self.begin_column[:, :, :, here] - block.start
            if block.period:
                second = second % block.period
            for _ in range(KEPT):
                best = int(score.argmax())
                value = float(score.ravel()[best])
                if not value > LEAST_SCORE:
                    break
                e, a, b, c = np.unravel_index(best, score.shape)
                out.append(self._traced(block, (int(e), int(a), int(b), int(c) + block.start), value, grade, run))
                score[(first == first[e, a, b, c]) & (second == second[e, a, b, c])] = -np.inf
        return out

    def _traced(self, block: _Block, state: tuple[int, int, int, int], value: float, grade: int, run: int) -> Chain:
        """The chain that ends in a state, sampled evenly along the query's line."""
        e, a, b, c = state
        pairs = [(e, c)]
        while True:
            before = int(self.back[e, a, b, c])
            e, c = e - a - 1, c - b - 1
            pairs.append((e, c))
            if before < 0:
                break
            a, b = divmod(before, TAKEN_IN)
        q, t = np.array(pairs[::-1]).T
        t = t - block.start
        way, goal = _arc(self.source), _arc(block.corners)
        at = np.linspace(way[q[0]], way[q[-1]], PAIRS)
        there = np.interp(at, way[q], goal[t])
        return Chain(
            _along(self.source, way, at), _along(block.corners, goal, there), block.mirrored, value, grade, run
        )


def _missed(line: Complex, begin: Indices, taken_in: int, chord: Complex) -> Floats:
    """What the corners cost that chords pass over."""
    price = np.zeros(len(chord))
    with np.errstate(invalid="ignore"):
        for k in range(1, taken_in):
            beside = np.abs(((line[np.minimum(begin + k, len(line) - 1)] - line[begin]) / chord).imag)
            price += MISSED + MISSED_MORE * np.minimum(1.0, np.nan_to_num(beside, nan=1.0) / SALIENT)
    return price


def _arc(line: Complex) -> Floats:
    """Arc length at the vertices of a line."""
    return np.concatenate([[0.0], np.cumsum(np.abs(np.diff(line)))])


def _along(line: Complex, arc: Floats, at: Floats) -> Complex:
    """Points of a line at arc lengths."""
    return np.asarray(np.interp(at, arc, line.real) + 1j * np.interp(at, arc, line.imag), dtype=np.complex128)
