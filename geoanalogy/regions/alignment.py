"""Elastic alignment of stretches of contour: the longer neighbourhood of evidence.

The descriptors of appendix A see a neighbourhood of fixed turning angle. Shapes with few features (strands, capes,
arms) need the whole course of their outline to be told apart, and near-symmetric ones to be told from their own
upside-down copy. Elastic alignment compares turning angles along two lines while either may be stretched; bends that
are spread over a line cost little, corners that only one line has cost much. It needs neither position, rotation nor
scale.

Many stretches of the drawing are compared at once: their samples stand in one row, the dynamic programme walks along
the query's stretch, and every step of it is a handful of operations on that row. Coarse samples tell which stretches,
and how much of them, are worth being aligned finely.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..geometry.contours import Complex, Contours, Floats, Indices
from .courses import Course, Stretch, lengths
from .largest import largest
from .query import Run

#: Samples of the longest query stretch.
SAMPLES = 72
#: Fewest samples of a stretch that is aligned.
LEAST_SAMPLES = 10
#: Stretches of the query, longest first, that are aligned; the descriptors see the others.
MOST_SOURCES = 4
#: Stretches of the drawing, longest first, that they are aligned with: the work grows with their number.
MOST_TARGETS = 60
#: Lengths of a target stretch in lengths of the query stretch that are tried: the target may be a part of the query's
#: counterpart (below 1) or contain it (above).
SHARES = (0.5, 0.6, 0.71, 0.84, 1.0, 1.19, 1.41, 2.0)
#: Steps of the alignment: (samples of the query, samples of the target).
STEPS = ((1, 1), (1, 2), (2, 1), (2, 3), (3, 2), (1, 3), (3, 1))
#: Reward of aligning the whole query stretch, in square radians: the cost at which an alignment is worth nothing.
GAIN = 3.0
#: Cost of stretching the whole query stretch by a factor of e.
STRETCH = 1.5
#: Cost of a corner without counterpart, in square radians.
CORNER = 0.15
#: Columns before every stretch: as many as the longest step of the target. Those of closed lines repeat its last.
MARGIN = 3
#: Samples of a first, coarse alignment as a share of those of the second; samplings of each stretch of the drawing, and
#: in all, that get the second.
COARSE, EACH_TARGET, MOST_BLOCKS = 0.4, 3, 40
#: Columns that are compared at once: what fits into the processor's cache.
WIDTH = 4_000
#: Number by which samples of the query are counted beside samples of the target.
PAST = 1 << 12


@dataclass(frozen=True)
class Alignment:
    """A stretch of the query laid along a stretch of the drawing.

    Attributes
    ----------
    source, target : (n,) complex
        Corresponding points.
    mirrored : bool
        Whether the target is a mirror image.
    score : float
        Reward less cost; GAIN for a perfect alignment of the longest query stretch.
    """

    source: Complex
    target: Complex
    mirrored: bool
    score: float


@dataclass(frozen=True)
class _Block:
    """A target stretch at one sampling, in one direction.

    Attributes
    ----------
    target : int
        Number of the stretch.
    share : float
        Its length in lengths of the query's stretch, if its samples were as dense.
    flip, backward : bool
        Whether it is mirrored, and walked the other way.
    """

    target: int
    share: float
    flip: bool
    backward: bool


def align(contours: Contours, sources: list[Run], targets: list[Run], mirrored: bool, most: int) -> list[Alignment]:
    """The best alignments of stretches of the query with stretches of the drawing.

    Parameters
    ----------
    contours : Contours
    sources : list of Run
        Stretches of the query, longest first; those shorter than a fifth of the longest are left to the descriptors.
    targets : list of Run
        Stretches where matches are looked for.
    mirrored : bool
        Whether mirror images are wanted.
    most : int
        Alignments returned at most, best first.

    Returns
    -------
    list[Alignment]
    """
    longest = float(lengths(contours, sources[:1])[0])
    out: list[Alignment] = []
    sources, targets = sources[:MOST_SOURCES], targets[:MOST_TARGETS]
    lines = [Stretch.of(contours, run) for run in targets]
    for run, length in zip(sources, lengths(contours, sources), strict=True):
        count = round(SAMPLES * length / longest)
        if count < LEAST_SAMPLES:
            break
        line = Stretch.of(contours, run)
        coarse = max(LEAST_SAMPLES, round(COARSE * count))
        blocks = list(_blocks(targets, count, run.closed, mirrored))
        if len(blocks) > EACH_TARGET:
            walks = _walks(lines, blocks, _oriented(line, coarse), length / longest)
            best = np.concatenate([walk.best() for walk in walks])
            blocks = [blocks[i] for i in _leading(blocks, best)]
        for walk in _walks(lines, blocks, _oriented(line, count), length / longest):
            out += walk.alignments()
    out.sort(key=lambda a: -a.score)
    return out[:most]


def _oriented(line: Stretch, count: int) -> Course:
    """A stretch sampled with `count` points; closed ones counter-clockwise."""
    course = line.course(count)
    return course.backward() if line.closed and course.clockwise else course


def _blocks(targets: list[Run], count: int, source_closed: bool, mirrored: bool) -> Iterator[_Block]:
    """Every target stretch at every sampling, in every direction, mirrored or not.

    Closed lines are compared in one direction only, counter-clockwise with counter-clockwise: the other one would
    turn a region inside out.
    """
    for k, run in enumerate(targets):
        for share in SHARES:
            if round(share * count) < LEAST_SAMPLES or len(run.indices) < LEAST_SAMPLES:
                continue
            for flip in (False, True) if mirrored else (False,):
                for backward in (False,) if run.closed and source_closed else (False, True):
                    yield _Block(k, share, flip, backward)


def _leading(blocks: list[_Block], best: Floats) -> list[int]:
    """Numbers of the best blocks of every target, and of those the best in all, in their order."""
    seen: dict[int, int] = {}
    kept: list[int] = []
    for i in np.argsort(-best, kind="stable"):
        number = seen.get(blocks[i].target, 0)
        if number < EACH_TARGET and len(kept) < MOST_BLOCKS:
            kept.append(int(i))
            seen[blocks[i].target] = number + 1
    return sorted(kept)


def _walks(lines: list[Stretch], blocks: Iterable[_Block], source: Course, share: float) -> Iterator["_Walk"]:
    """Local alignments of a stretch of the query with blocks, as many at once as are WIDTH columns."""
    count = len(source.points)
    courses: list[tuple[Course, bool]] = []
    width = 0
    sampled: dict[tuple[int, int], Course] = {}
    for block in blocks:
        line, n = lines[block.target], max(4, round(block.share * count))
        if (block.target, n) not in sampled:
            sampled[block.target, n] = _oriented(line, n)
        course = sampled[block.target, n]
        if block.flip:
            course = course.reflected().backward() if line.closed else course.reflected()
        courses.append((course.backward() if block.backward else course, block.flip))
        width += n + MARGIN
        if width > WIDTH:
            yield _Walk(source, courses, share)
            courses, width = [], 0
    if courses:
        yield _Walk(source, courses, share)


class _Walk:
    """Local alignment of one stretch of the query with a row of courses.

    Parameters
    ----------
    source : Course
    courses : list of (Course, bool)
        Each with whether it is mirrored.
    share : float
        Length of the query's stretch in lengths of the longest one: what a perfect alignment is worth.
    """

    def __init__(self, source: Course, courses: list[tuple[Course, bool]], share: float):
        self.source, self.courses, self.count = source, courses, len(source.points)
        self.share = share
        sizes = np.array([len(c.points) for c, _ in courses])
        self.start = np.cumsum(sizes + MARGIN) - sizes
        width = int(self.start[-1] + sizes[-1])
        rows = 2 * self.count if source.closed else self.count
        self.score = np.zeros((rows, width), np.float32)
        self.step = np.full((rows, width), -1, np.int8)
        # samples since the alignment began: of the query times PAST, and of the target
        self.since = np.zeros((rows, width), np.int32)
        self._fill()

    def _row(self) -> tuple[NDArray[np.float32], NDArray[np.float32], NDArray[np.int32], Indices, Indices]:
        """Of every column heading, count of corners, length of its course if closed; margins, and those that wrap."""
        width = self.score.shape[1]
        heading, corner = np.zeros(width, np.float32), np.zeros(width, np.float32)
        room = np.full(width, PAST, np.int32)
        margin = (self.start[:, None] - np.arange(MARGIN, 0, -1)).ravel()
        wrapped = np.repeat([course.closed for course, _ in self.courses], MARGIN)
        for (course, _), start in zip(self.courses, self.start, strict=True):
            n = len(course.points)
            here, before, last = slice(start, start + n), slice(start - MARGIN, start), slice(-MARGIN, None)
            heading[here], corner[here] = course.heading - course.heading[0], course.corners
            if course.closed:
                around, more = course.once_round
                room[here] = n
                heading[before], corner[before] = heading[here][last] - around, corner[here][last] - more
        return heading, corner, room, margin, margin[wrapped]

    def _fill(self) -> None:
        """All states, row by row."""
        single, rows, width = np.float32, *self.score.shape
        heading, corner, room, margin, wrapped = self._row()
        period = room[wrapped + MARGIN]
        walked = self.source.twice() if self.source.closed else self.source
        unit = self.share / self.count
        reward = [single(unit * (GAIN * min(s) - STRETCH * s[0] * np.log(s[1] / s[0]) ** 2)) for s in STEPS]
        turn, met = np.zeros((2, len(STEPS), width), single)
        own_turn, own_met = np.zeros((2, rows, len(STEPS), 1), single)
        weight = single(np.sqrt(CORNER))
        for k, (a, b) in enumerate(STEPS):
            turn[k, b:], met[k, b:] = heading[b:] - heading[:-b], weight * (corner[b:] - corner[:-b])
            own_turn[a:, k, 0] = walked.heading[a:] - walked.heading[:-a]
            own_met[a:, k, 0] = weight * (walked.corners[a:] - walked.corners[:-a])
        back = np.array([a * width + b for a, b in STEPS])  # to the state before, in the flat arrays of all states
        passed = np.array([a * PAST + b for a, b in STEPS], np.int32)
        value, cost, missed = np.empty((3, len(STEPS), width), single)
        top, best = np.empty(width, single), np.empty(width, np.int8)
        columns, since = np.arange(width), self.since.reshape(-1)
        going: dict[int, NDArray[np.float32]] = {}  # scores of rows, by steps that closed courses have left
        for i in range(rows):
            for k, (a, b) in enumerate(STEPS):
                value[k, :b] = -np.inf
                if a > i:
                    value[k] = -np.inf
                    continue
                np.add(going[i - a][b - 1, :-b], reward[k], out=value[k, b:])
                if i >= self.count:
                    too_far = self.since[i - a, :-b] >= (self.count - a + 1) * PAST
                    np.copyto(value[k, b:], single(-np.inf), where=too_far)
            np.subtract(turn, own_turn[i], out=cost)
            cost *= cost
            np.subtract(met, own_met[i], out=missed)
            missed *= missed
            cost += missed
            value -= cost
            largest(value, top, best)
            top[margin] = 0.0
            on = top > 0.0
            np.maximum(top, single(0.0), out=self.score[i])
            self.step[i] = np.where(on, best, np.int8(-1))
            np.multiply(
                since.take(i * width + columns - back.take(best), mode="clip") + passed.take(best),
                on,
                out=self.since[i],
            )
            reached = self.score[i].copy()
            reached[margin] = -np.inf
            reached[wrapped] = reached[wrapped + period]
            self.score[i, margin] = -np.inf
            self.since[i, wrapped] = self.since[i, wrapped + period]
            going[i] = np.empty((MARGIN, width), single)
            gone = self.since[i] % PAST
            for b in range(1, MARGIN + 1):
                going[i][b - 1, :-b] = np.where(gone[:-b] + b > room[b:], single(-np.inf), reached[:-b])
            going.pop(i - MARGIN, None)

    def best(self) -> Floats:
        """The best score of every course, (n,)."""
        ends = np.maximum.reduceat(self.score.max(0), self.start)
        return np.asarray(ends, dtype=np.float64)

    def alignments(self, keep: int = 3) -> Iterator[Alignment]:
        """The best alignments that end in each course, with clearly different ways."""
        rows = np.arange(len(self.score))[:, None]
        for (course, mirrored), start in zip(self.courses, self.start, strict=True):
            n = len(course.points)
            here = self.score[:, start : start + n].copy()
            ring = self.source.closed or course.closed
            period = float(n if ring else 10**6)
            diagonal = (np.arange(n) - rows * (n / self.count)) % period
            for _ in range(keep):
                i, j = divmod(int(here.argmax()), n)
                value = float(here[i, j])
                if value < 0.15 * GAIN:
                    break
                yield self._traced(i, j, start, course, mirrored, value)
                gap = np.abs(diagonal - diagonal[i, j])
                gap = np.minimum(gap, period - gap)
                here[gap < 0.15 * n] = -np.inf

    def _traced(self, i: int, j: int, start: int, course: Course, mirrored: bool, value: float) -> Alignment:
        """The alignment that ends at a sample of the query and one of a course."""
        n, path = len(course.points), [(i, j)]
        while (k := int(self.step[i, start + j % n])) >= 0:
            i, j = i - STEPS[k][0], j - STEPS[k][1]
            path.append((i, j))
        q, t = np.array(path[::-1]).T
        return Alignment(self.source.points[q % self.count], course.points[t % n], mirrored, value)
