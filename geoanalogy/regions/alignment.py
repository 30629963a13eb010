"""Elastic alignment of stretches of contour: the longer neighbourhood of evidence.

The descriptors of appendix A see a neighbourhood of fixed turning angle. Shapes with few features (strands, capes,
arms) need the whole course of their outline to be told apart, and near-symmetric ones to be told from their own
upside-down copy. Elastic alignment compares turning angles along two lines while either may be stretched; bends that
are spread over a line cost little, corners that only one line has cost much. It needs neither position, rotation nor
scale.

All stretches of the drawing are compared at once: their samples stand in one row, the dynamic programme walks along the
query's stretch, and every step of it is a handful of operations on that row.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..geometry.contours import Complex, Contours, Floats
from .courses import Course, lengths
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
#: Stretches between two columns: as many as the longest step of the target.
BARRIER = 3


@dataclass(frozen=True)
class Alignment:
    """A stretch of the query laid along a stretch of the drawing.

    Attributes
    ----------
    source, target : (n,) complex
        Corresponding points.
    source_heading, target_heading : (n,) float
        Directions of the two lines there; the target's already points the way of the query's (mirrored where mirrored).
    mirrored : bool
        Whether the target is a mirror image.
    score : float
        Reward less cost; GAIN for a perfect alignment of the longest query stretch.
    """

    source: Complex
    target: Complex
    source_heading: Floats
    target_heading: Floats
    mirrored: bool
    score: float


@dataclass(frozen=True)
class _Block:
    """A target stretch at one sampling: where its samples stand in the row of columns."""

    start: int
    period: int
    course: Course
    mirrored: bool


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
    for run, length in zip(sources, lengths(contours, sources), strict=True):
        count = round(SAMPLES * length / longest)
        if count < LEAST_SAMPLES:
            break
        source = Course.along(contours, run, count)
        if run.closed and source.clockwise:
            source = source.backward()
        blocks = list(_blocks(contours, targets, count, run.closed, mirrored))
        if blocks:
            out += _walk(source, blocks, length / longest)
    out.sort(key=lambda a: -a.score)
    return out[:most]


def _blocks(
    contours: Contours, targets: list[Run], count: int, source_closed: bool, mirrored: bool
) -> Iterator[_Block]:
    """Every target stretch at every sampling, in every direction, mirrored or not.

    Closed lines are compared in one direction only, counter-clockwise with counter-clockwise: the other one would
    turn a region inside out.
    """
    start = BARRIER
    for run in targets:
        for share in SHARES:
            n = round(share * count)
            if n < LEAST_SAMPLES or len(run.indices) < LEAST_SAMPLES:
                continue
            course = Course.along(contours, run, n)
            if run.closed and course.clockwise:
                course = course.backward()
            for flip in (False, True) if mirrored else (False,):
                one = course.reflected() if flip else course
                if run.closed and flip:
                    one = one.backward()
                both = (one,) if run.closed and source_closed else (one, one.backward())
                for c in both:
                    period = n if run.closed else 0
                    yield _Block(start, period, c.twice() if run.closed else c, flip)
                    start += (2 * n if run.closed else n) + BARRIER


def _walk(source: Course, blocks: list[_Block], share: float) -> list[Alignment]:
    """Local alignment of one query stretch with all blocks."""
    count = len(source.points)
    if source.closed:
        source = source.twice()
    heading, corners = source.heading, source.corners
    rows, width = len(source.points), blocks[-1].start + len(blocks[-1].course.points) + BARRIER
    barrier = np.ones(width, bool)
    angle, room = np.zeros(width, np.float32), np.full(width, 10**6, np.int32)
    corner = np.zeros(width, np.float32)
    for block in blocks:
        course = block.course
        here = slice(block.start, block.start + len(course.points))
        barrier[here], angle[here], corner[here] = False, course.heading - course.heading[0], course.corners
        if block.period:
            room[here] = block.period
    open_ = ~barrier
    turn = {b: angle[b:] - angle[:-b] for _, b in STEPS}
    passed = {b: corner[b:] - corner[:-b] for _, b in STEPS}
    reward = {s: np.float32(share / count * (GAIN * min(s) - STRETCH * s[0] * np.log(s[1] / s[0]) ** 2)) for s in STEPS}
    score = np.zeros((rows, width), np.float32)
    score[:, barrier] = -np.inf
    step = np.full((rows, width), -1, np.int8)
    origin = np.empty((rows, width), np.int32)  # column where the alignment began
    begin = np.empty((rows, width), np.int16)  # row where it began
    columns = np.arange(width, dtype=np.int32)
    for i in range(rows):
        best, chosen = score[i], step[i]
        origin[i], begin[i] = columns, i
        for k, s in enumerate(STEPS):
            a, b = s
            if a > i:
                continue
            turned, met = np.float32(heading[i] - heading[i - a]), np.float32(corners[i] - corners[i - a])
            value = score[i - a, :-b] + (reward[s] - (turn[b] - turned) ** 2 - CORNER * (passed[b] - met) ** 2)
            better = (value > best[b:]) & open_[b:]
            better &= i - begin[i - a, :-b] <= count
            better &= columns[b:] - origin[i - a, :-b] <= room[b:]
            at = np.flatnonzero(better)
            best[at + b], chosen[at + b] = value[at], k
            origin[i, at + b], begin[i, at + b] = origin[i - a, at], begin[i - a, at]
    out = []
    for block in blocks:
        out += _best_of(block, score, step, source, count)
    return out


def _best_of(
    block: _Block, score: NDArray[np.float32], step: NDArray[np.int8], source: Course, count: int, keep: int = 3
) -> list[Alignment]:
    """The best alignments that end in a block, with clearly different courses."""
    here = score[:, block.start : block.start + len(block.course.points)].copy()
    share = block.period or len(block.course.points)
    rows, columns = np.indices(here.shape)
    period = float(share if source.closed or block.period else 10**6)
    diagonal = np.asarray((columns - rows * (share / count)) % period, dtype=np.float64)
    out: list[Alignment] = []
    while len(out) < keep:
        i, j = divmod(int(here.argmax()), here.shape[1])
        value = float(here[i, j])
        if value < 0.15 * GAIN:
            break
        path = [(i, j)]
        while step[path[-1][0], path[-1][1] + block.start] >= 0:
            a, b = STEPS[step[path[-1][0], path[-1][1] + block.start]]
            path.append((path[-1][0] - a, path[-1][1] - b))
        q, t = np.array(path[::-1]).T
        c = block.course
        out.append(Alignment(source.points[q], c.points[t], source.heading[q], c.heading[t], block.mirrored, value))
        gap = np.abs(diagonal - diagonal[i, j])
        gap = np.minimum(gap, period - gap)
        here[gap < 0.15 * share] = -np.inf
    return out
