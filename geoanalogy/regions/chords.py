"""Chords that follow each other: the dynamic programme that finds chains of them."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..geometry.contours import Complex, Floats, Indices
from .largest import largest, picked

#: Uncertainty of a corner's place, in extents of its line.
BLUR = 0.006
#: Chords that a chord may take in at most: two corners of either line may have no counterpart.
TAKEN_IN = 3
#: Corners that a chord of the query and one of the drawing take in: only one of the two passes over any.
CHORDS = ((1, 1), (1, 2), (1, 3), (2, 1), (3, 1))
#: Standard deviation of the change of rotation, and of the logarithm of scale, at a joint of one bent shape.
TURN, SCALE = np.radians(14.0), 0.28
#: What a joint without any change is worth, for its rotation and for its scale, and the most that one costs.
TURN_GAIN, SCALE_GAIN, MOST_COST = 1.2, 1.0, 3.0
#: What a corner without counterpart costs, and how much more where it stands out by SALIENT of the chord's length.
MISSED, MISSED_MORE, SALIENT = 0.4, 1.5, 0.12
#: Chains of every block that are kept.
KEPT = 3
#: Number by which corners of the query are counted beside corners of the row.
PAST = 1 << 12


@dataclass(frozen=True)
class Block:
    """A stretch of the drawing, in one direction, mirrored or not.

    Attributes
    ----------
    start : int
        Where its corners begin in the row of all.
    closed : bool
    corners : (n,) complex
    mirrored : bool
    target : int
        Number of the stretch.
    """

    start: int
    closed: bool
    corners: Complex
    mirrored: bool
    target: int

    @property
    def columns(self) -> slice:
        """Where its corners stand in the row of all."""
        return slice(self.start, self.start + len(self.corners))


@dataclass(frozen=True)
class Chords:
    """Chords of a line by their length in corners, less one, and the corner they end at: (TAKEN_IN, n).

    Attributes
    ----------
    scale, turn : (TAKEN_IN, n) float32
        Logarithm of length, and direction in whole turns, which wrap by rounding.
    doubt : (TAKEN_IN, n) float32
        Variance of both that is due to the uncertainty of corners.
    price : (TAKEN_IN, n) float32
        What the corners cost that they pass over; infinite where there is no chord.
    """

    scale: NDArray[np.float32]
    turn: NDArray[np.float32]
    doubt: NDArray[np.float32]
    price: NDArray[np.float32]

    @classmethod
    def of(cls, line: Complex, begin: Indices) -> "Chords":
        """The chords of a line in units of its extent; `begin`, (TAKEN_IN, n), is negative where there is none."""
        chord = line - line[begin]
        chord[(begin < 0) | (chord == 0.0)] = np.nan
        length = np.abs(chord)
        possible = np.isfinite(length)
        price = np.zeros(chord.shape)
        for span in range(1, TAKEN_IN):
            price[span] = _missed(line[begin[:span]], line[begin[span]], chord[span])
        found = np.log(length), np.angle(chord) / (2.0 * np.pi), (BLUR / length) ** 2
        scale, turn, doubt = (np.where(possible, x, 0.0).astype(np.float32) for x in found)
        return cls(scale, turn, doubt, np.where(possible, price, np.inf).astype(np.float32))


class Walk:
    """The dynamic programme along one stretch of the query, over the blocks of a row at once.

    A state is a pair of chords that end at a corner of the query and at a corner of the row; CHORDS says how many
    corners the two take in. Arrays are (rows, chords, columns); columns of closed lines wrap round.

    Parameters
    ----------
    source : (n,) complex
        Corners of the query's stretch.
    closed : bool
    blocks : list of Block

    Attributes
    ----------
    best : (b,) float32
        What the best chain of each block is worth.
    """

    def __init__(self, source: Complex, closed: bool, blocks: list[Block]):
        self.blocks = blocks
        self.count, self.closed = len(source), closed
        extent = float(np.hypot(np.ptp(source.real), np.ptp(source.imag)))
        self.source = np.tile(source, 2) if closed else source
        width = blocks[-1].columns.stop
        row, room = np.empty(width, complex), np.full(width, 10**4, np.int32)
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
        self.since = np.zeros(shape, np.int32)  # corners since the chain began: of the query times PAST, and of the row
        own = np.arange(len(self.source)) - np.arange(1, TAKEN_IN + 1)[:, None]
        self._fill(Chords.of(self.source / extent, own), Chords.of(row, begin), np.maximum(begin, 0), room)
        self.best = np.maximum.reduceat(self.score.max((0, 1)), [block.start for block in blocks])

    def _fill(self, own: Chords, other: Chords, begin: Indices, room: NDArray[np.int32]) -> None:
        """All states, row by row."""
        single, number, width = np.float32, len(CHORDS), len(room)
        passing, taken = np.array(CHORDS).T - 1
        # what two chords say that follow each other: (chord before, chord, column), and (row, chord before, chord)
        scale, turn = (x[taken] - x[:, begin[taken]][taken] for x in (other.scale, other.turn))
        doubt = other.doubt[taken] + other.doubt[:, begin[taken]][taken]
        rows = np.arange(len(self.source))
        at = (passing[:, None], np.maximum(rows[:, None] - passing - 1, 0)[:, None, :])
        own_scale, own_turn = ((x[at] - x[passing].T[:, None])[..., None] for x in (own.scale, own.turn))
        own_doubt = (own.doubt[at] + own.doubt[passing].T[:, None] + single(SCALE**2))[..., None]
        price = other.price[taken] + own.price[passing].T[:, :, None]
        turned = single((2.0 * np.pi * SCALE / TURN) ** 2)  # so that scale and turn have one deviation
        room = room - np.arange(1, TAKEN_IN + 1, dtype=np.int32)[:, None]
        passed = np.array([[a * PAST + b] for a, b in CHORDS], np.int32)
        # the last rows, at the corners where chords begin
        reached = np.full((TAKEN_IN + 1, number, TAKEN_IN, width), -np.inf, single)
        since = np.zeros((TAKEN_IN + 1, number, TAKEN_IN, width), np.int32)
        worth, miss, sure = np.empty((3, number, number, width), single)
        gone = np.empty((number, number, width), np.int32)
        value, best = np.empty((number, width), single), np.empty((number, width), np.int8)
        column = np.arange(number * width).reshape(number, width)
        last, first = self._cut()
        for e in rows:
            for c, (a, b) in enumerate(CHORDS):
                before = (e - a) % len(reached)
                worth[:, c], gone[:, c] = reached[before, :, b - 1], since[before, :, b - 1]
            np.add(doubt, own_doubt[e], out=sure)
            np.divide(single(0.5), sure, out=sure)
            np.add(turn, own_turn[e], out=miss)
            miss -= np.rint(miss)
            miss *= miss
            miss *= sure
            miss *= turned
            worth -= np.minimum(miss, single(MOST_COST), out=miss)
            np.add(scale, own_scale[e], out=miss)
            if self.closed:  # what ends where a line was cut is shorter than it was: only a larger scale is a miss
                miss[:, :, last] = np.maximum(miss[:, :, last], single(0.0))
                miss[first] = np.minimum(miss[first], single(0.0))
            miss *= miss
            miss *= sure
            worth -= np.minimum(miss, single(MOST_COST), out=miss)
            if self.closed and e > self.count:
                worth[gone + passed >= (self.count + 1) * PAST] = -np.inf
            largest(worth, value, best)
            goes_on = value > 0.0
            self.score[e] = np.where(goes_on, value, single(0.0)) - price[e]
            self.back[e] = np.where(goes_on, best, np.int8(-1))
            self.since[e] = np.where(goes_on, picked(gone, best, column), 0) + passed
            now = e % len(reached)
            self.score[e].take(begin, axis=1, out=reached[now], mode="clip")
            self.since[e].take(begin, axis=1, out=since[now], mode="clip")
            reached[now] += single(TURN_GAIN + SCALE_GAIN)
            reached[now][since[now] % PAST > room] = -np.inf

    def _cut(self) -> tuple[Indices, tuple[Indices, ...]]:
        """Where chords end at the end of an open line of the drawing, and where those before begin at its beginning."""
        cut = [block for block in self.blocks if not block.closed]
        start, n = np.array([(block.start, len(block.corners)) for block in cut], np.intp).reshape(-1, 2).T
        k, c = (x.ravel() for x in np.indices((len(CHORDS), len(CHORDS))))
        along = np.array([own + other for _, own in CHORDS for _, other in CHORDS])
        some, pair = np.nonzero(along < n[:, None])
        return start + n - 1, (k[pair], c[pair], start[some] + along[pair])

    def ways(self, least: float) -> Iterator[tuple[float, Block, Indices]]:
        """The best chains of every block, each with another beginning.

        Parameters
        ----------
        least : float
            What chains must be worth more than.

        Yields
        ------
        float
            What the chain is worth.
        Block
        (n, 2) int
            The corners of the query and of the block that it visits; those of closed lines go on past the last.
        """
        e = np.arange(len(self.source), dtype=np.int32)[:, None, None]
        for block in (b for b, most in zip(self.blocks, self.best, strict=True) if most > least):
            score, n = self.score[:, :, block.columns].copy(), len(block.corners)
            since = self.since[:, :, block.columns]
            first = (e - since // PAST) % self.count
            second = (np.arange(n, dtype=np.int32) - since % PAST) % n
            for _ in range(KEPT):
                best = np.unravel_index(int(score.argmax()), score.shape)
                value = float(score[best])
                if not value > least:
                    break
                yield value, block, self._way(block, int(best[0]), int(best[1]), int(best[2]))
                score[(first == first[best]) & (second == second[best])] = -np.inf

    def _way(self, block: Block, e: int, k: int, column: int) -> Indices:
        """The corners that a chain visits which ends in a state."""
        t = column + len(block.corners) if block.closed else column
        pairs = [(e, t)]
        while k >= 0:
            a, b = CHORDS[k]
            k = int(self.back[e, k, block.start + column])
            e, t, column = e - a, t - b, (column - b) % len(block.corners)
            pairs.append((e, t))
        return np.array(pairs[::-1])


def _missed(between: Complex, begin: Complex | complex, chord: Complex | complex) -> Floats:
    """What the corners cost that chords pass over, added over the first axis."""
    with np.errstate(invalid="ignore"):
        beside = np.abs(((between - begin) / chord).imag)
    price: Floats = (MISSED + MISSED_MORE * np.minimum(1.0, np.nan_to_num(beside, nan=1.0) / SALIENT)).sum(0)
    return price
