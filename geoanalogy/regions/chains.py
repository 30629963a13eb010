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
from numpy.typing import NDArray

from ..geometry.contours import Complex, Contours, Floats, Indices
from .courses import lengths
from .query import Run

#: Grades of detail: distance, in extents of a line, within which vertices are no corners, and longest chord, as a share
#: of a line's length. What only one grade says is chance, what all of them say is the shape.
GRADES = tuple((corner, chord) for corner in (0.015, 0.01, 0.006) for chord in (1.0, 0.1))
#: Uncertainty of a corner's place, in extents of its line.
BLUR = 0.006
#: Chords that a chord may take in at most: two corners of either line may have no counterpart.
TAKEN_IN = 3
#: Corners that a chord of the query and one of the drawing take in: only one of the two passes over any.
CHORDS = ((1, 1), (1, 2), (1, 3), (2, 1), (3, 1))
#: Which of CHORDS take in so many corners of the query, and those of the drawing (less one) that they then may.
BY_QUERY = {1: (slice(0, 3), slice(0, 3)), 2: (slice(3, 4), slice(0, 1)), 3: (slice(4, 5), slice(0, 1))}
#: Corners of the drawing that are compared at once: what fits into the processor's cache.
WIDTH = 900
#: Of the drawing's stretches, those that the finer grades look at: the best of the coarsest grade, and more that are
#: worth this share of the best.
LEADING, MOST_LEADING, NEARLY = 12, 36, 0.6
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
#: Chains of every stretch that are kept, and the least score of one that is, in all and beside the best so far.
KEPT, LEAST_SCORE, WEAK = 3, 1.5, 0.2
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
    closed: bool
    corners: Complex
    mirrored: bool
    target: int

    @property
    def columns(self) -> slice:
        """Its corners in the row of all."""
        return slice(self.start, self.start + len(self.corners))


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
    targets = targets[:MOST_TARGETS]
    found: list[Chain] = []
    most = np.zeros((len(GRADES), len(sources)))
    promising = [np.arange(len(targets))] * len(sources)
    for g, grade in enumerate(GRADES):
        lines = [corners(contours.drawn[run.indices], run.closed, grade) for run in targets]
        for k, run in enumerate(sources):
            own = corners(contours.drawn[run.indices], run.closed, grade)
            joints = len(own) - (1 if run.closed else 2)
            if joints < 1:
                continue
            most[g, k] = joints * (TURN_GAIN + SCALE_GAIN)
            if run.closed and _area(own) < 0.0:
                own = own[::-1]
            best = np.zeros(len(targets))
            for row in _rows(lines, targets, promising[k], run.closed, mirrored):
                least = max(LEAST_SCORE, WEAK * best.max())
                for target, one in _Walk(own, run.closed, row).chains(g, k, least):
                    found.append(one)
                    best[target] = max(best[target], one.score)
            if g == 0:
                promising[k] = _leading(best)
    found.sort(key=lambda c: -c.score)
    return Chains(found, most)


def _leading(best: Floats) -> Indices:
    """Targets that are worth a closer look, in their order: the first LEADING, and some that are nearly as good."""
    order = np.argsort(-best, kind="stable")[:MOST_LEADING]
    return np.sort(order[(np.arange(len(order)) < LEADING) | (best[order] >= NEARLY * best[order[0]])])


def _area(ring: Complex) -> float:
    """Twice the signed area of a ring."""
    return float((np.conj(ring) * np.roll(ring, -1)).imag.sum())


def _rows(
    lines: list[Complex], targets: list[Run], which: Indices, source_closed: bool, mirrored: bool
) -> Iterator[list[_Block]]:
    """Every stretch of the drawing in every direction, mirrored or not, in rows of about WIDTH corners.

    Rings are compared counter-clockwise only: the other way round a region would be turned inside out.
    """
    start, corners_seen = 0, 0
    row: list[_Block] = []
    for k in which:
        own, closed = lines[k], targets[k].closed
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
                row.append(_Block(start, closed, way, flip, k))
                start += len(way)
        if start >= WIDTH:
            yield row
            start, row = 0, []
    if row:
        yield row


class _Walk:
    """The dynamic programme along one stretch of the query, over the blocks of a row at once.

    A state is a pair of chords that end at a corner of the query and at a corner of the row; CHORDS says how many
    corners the two take in. Arrays are (rows, chords, columns); columns of closed lines wrap round.
    """

    def __init__(self, source: Complex, closed: bool, blocks: list[_Block]):
        self.blocks = blocks
        self.count, self.closed = len(source), closed
        extent = float(np.hypot(np.ptp(source.real), np.ptp(source.imag)))
        self.source = np.tile(source, 2) if closed else source
        width = blocks[-1].columns.stop
        row, room = np.empty(width, complex), np.full(width, 10**4, np.int16)
        begin = np.empty((TAKEN_IN, width), int)  # where chords that end here begin, -1 beyond the end of an open line
        for block in blocks:
            here, n = block.columns, len(block.corners)
            row[here] = block.corners / np.hypot(np.ptp(block.corners.real), np.ptp(block.corners.imag))
            back = np.arange(n) - np.arange(1, TAKEN_IN + 1)[:, None]
            if block.closed:
                room[here] = n
            begin[:, here] = np.where(back >= 0, back, back % n if block.closed else -1 - block.start) + block.start
        shape = (len(self.source), len(CHORDS), width)
        self.score = np.full(shape, -np.inf, np.float32)
        self.back = np.full(shape, -1, np.int8)
        self.passed = np.zeros(shape, np.int16)  # corners of the query since the chain began
        self.gone = np.zeros(shape, np.int16)  # corners of the target
        self._fill(self.source / extent, row, begin, room)

    def _fill(self, source: Complex, row: Complex, begin: Indices, room: NDArray[np.int16]) -> None:
        """All states, row by row."""
        single, number, width = np.float32, len(CHORDS), len(row)
        chord = row - row[begin]
        chord[(begin < 0) | (chord == 0.0)] = np.nan
        with np.errstate(invalid="ignore", divide="ignore"):
            ratio = np.log(np.abs(chord)).astype(single)
            way = (np.angle(chord) / (2.0 * np.pi)).astype(single)  # in whole turns, which wrap by rounding
            doubt = ((BLUR / np.abs(chord)) ** 2).astype(single)
        possible = np.isfinite(ratio)
        price = np.zeros(chord.shape)
        for span in range(1, TAKEN_IN):
            price[span] = _missed(row[begin[:span]], row[begin[span]], chord[span])
        ratio, way, doubt = (np.where(possible, x, 0.0).astype(single) for x in (ratio, way, doubt))
        last, first = self._ends()
        price = np.where(possible, price, np.inf).astype(single)
        # the states at the corners where chords begin, by corner of the query: (chords, chords of the target, columns)
        recent: dict[int, tuple[NDArray, ...]] = {}
        scale, turn = np.zeros((number, width), single), np.zeros((number, width), single)
        blur = np.zeros((number, width), single)
        turned = single((2.0 * np.pi * SCALE / TURN) ** 2)  # so that scale and turn have one deviation
        column, taken = np.arange(width), np.array([b for _, b in CHORDS], np.int16)[:, None]
        room = room - np.arange(1, TAKEN_IN + 1, dtype=np.int16)[:, None]
        for e in range(len(source)):
            self.score[e, :, :] = -np.inf
            for a in range(1, min(TAKEN_IN, e) + 1):
                s = e - a
                step = source[e] - source[s]
                if step == 0.0:
                    continue
                own, beside = BY_QUERY[a]
                cost = float(_missed(source[s + 1 : e], source[s], step))
                now_scale = ratio[beside] - single(np.log(abs(step)))
                now_turn = way[beside] - single(np.angle(step) / (2.0 * np.pi))
                now_blur = doubt[beside] + single((BLUR / abs(step)) ** 2)
                score, was_scale, was_turn, was_blur, passed, gone = (x[:, beside] for x in recent[s])
                doubtful = was_blur + (now_blur + single(SCALE**2))
                np.divide(single(0.5), doubtful, out=doubtful)
                miss = now_turn - was_turn
                miss -= np.rint(miss)
                miss *= miss
                miss *= doubtful
                worth = score - np.minimum(miss * turned, single(MOST_COST))
                np.subtract(now_scale, was_scale, out=miss)
                if self.closed:  # what ends where a line was cut is shorter than it was: only a larger scale is a miss
                    miss[:, :, last] = np.maximum(miss[:, :, last], single(0.0))
                    miss[first[a]] = np.minimum(miss[first[a]], single(0.0))
                miss *= miss
                miss *= doubtful
                worth -= np.minimum(miss, single(MOST_COST), out=miss)
                if self.closed and e > self.count:
                    worth[passed + a > self.count] = -np.inf
                best = worth.argmax(0)
                at = (best, np.arange(len(best))[:, None], column)
                value = worth[at]
                goes_on = value > 0.0
                self.score[e, own] = np.where(goes_on, value, 0.0) - (price[beside] + single(cost))
                self.back[e, own] = np.where(goes_on, best, -1)
                self.passed[e, own] = np.where(goes_on, passed[at], 0) + a
                self.gone[e, own] = np.where(goes_on, gone[at], 0) + taken[own]
                scale[own], turn[own], blur[own] = now_scale, now_turn, now_blur
            gone = self.gone[e][:, begin]
            reached = self.score[e][:, begin] + single(TURN_GAIN + SCALE_GAIN)
            reached[gone > room] = -np.inf
            recent[e] = (reached, scale[:, begin], turn[:, begin], blur[:, begin], self.passed[e][:, begin], gone)
            recent.pop(e - TAKEN_IN, None)

    def _ends(self) -> tuple[Indices, dict[int, tuple[Indices, ...]]]:
        """Where chords end at the end of an open line of the drawing, and where those before begin at its beginning."""
        last = [block.columns.stop - 1 for block in self.blocks if not block.closed]
        first: dict[int, tuple[Indices, ...]] = {}
        for a, (_, spans) in BY_QUERY.items():
            at = [
                (k, span - 1, block.start + b + span)
                for block in self.blocks
                if not block.closed
                for k, (_, b) in enumerate(CHORDS)
                for span in range(1, spans.stop + 1)
                if b + span < len(block.corners)
            ]
            first[a] = tuple(np.reshape(at, (-1, 3)).astype(np.intp).T)
        return np.array(last, np.intp), first

    def chains(self, grade: int, run: int, least: float) -> Iterator[tuple[int, Chain]]:
        """The best chains of every block, each with another beginning, and the number of their target."""
        e = np.arange(len(self.source))[:, None, None]
        for block in self.blocks:
            score = self.score[:, :, block.columns]
            value = float(score.max())
            if not value > least:
                continue
            score, n = score.copy(), len(block.corners)
            first = (e - self.passed[:, :, block.columns]) % self.count
            second = (np.arange(n) - self.gone[:, :, block.columns]) % n
            for _ in range(KEPT):
                best = np.unravel_index(int(score.argmax()), score.shape)
                value = float(score[best])
                if not value > least:
                    break
                state = (int(best[0]), int(best[1]), int(best[2]))
                yield block.target, self._traced(block, state, value, grade, run)
                score[(first == first[best]) & (second == second[best])] = -np.inf

    def _traced(self, block: _Block, state: tuple[int, int, int], value: float, grade: int, run: int) -> Chain:
        """The chain that ends in a state, sampled evenly along the query's line."""
        e, k, column = state
        n = len(block.corners)
        t = n if block.closed else column  # a closed line is unrolled so that it ends where the chain does
        way = block.corners[(column - t + np.arange(t + 1)) % n]
        pairs = [(e, t)]
        while k >= 0:
            a, b = CHORDS[k]
            k = int(self.back[e, k, block.start + column])
            e, t, column = e - a, t - b, (column - b) % n
            pairs.append((e, t))
        q, t = np.array(pairs[::-1]).T
        arc, goal = _arc(self.source), _arc(way)
        own, other = arc[q], goal[t]
        if self.closed and not block.closed and len(q) > 3:
            # where the line was cut, it ends somewhere on the way to the corner, as its scale says
            scale = (other[-2] - other[1]) / (own[-2] - own[1])
            if t[0] == 0:
                own[0] = max(own[0], own[1] - (other[1] - other[0]) / scale)
            if t[-1] == n - 1:
                own[-1] = min(own[-1], own[-2] + (other[-1] - other[-2]) / scale)
        where = np.linspace(own[0], own[-1], PAIRS)
        there = np.interp(where, own, other)
        return Chain(_along(self.source, arc, where), _along(way, goal, there), block.mirrored, value, grade, run)


def _missed(between: Complex, begin: Complex | complex, chord: Complex | complex) -> Floats:
    """What the corners cost that chords pass over, added over the first axis."""
    with np.errstate(invalid="ignore"):
        beside = np.abs(((between - begin) / chord).imag)
    price: Floats = (MISSED + MISSED_MORE * np.minimum(1.0, np.nan_to_num(beside, nan=1.0) / SALIENT)).sum(0)
    return price


def _arc(line: Complex) -> Floats:
    """Arc length at the vertices of a line."""
    return np.concatenate([[0.0], np.cumsum(np.abs(np.diff(line)))])


def _along(line: Complex, arc: Floats, at: Floats) -> Complex:
    """Points of a line at arc lengths."""
    return np.asarray(np.interp(at, arc, line.real) + 1j * np.interp(at, arc, line.imag), dtype=np.complex128)
