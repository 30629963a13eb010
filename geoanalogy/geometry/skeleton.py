"""The weighted straight skeleton of a polygon with holes: its edges move inwards and leave a roof behind."""

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..tolerances import SAME_VERTEX
from .loops import linked_loops, uncancelled

Array = NDArray[np.float64]
Loop = list[int]


@dataclass(frozen=True, eq=False)
class Skeleton:
    """What the moving edges of a polygon swept.

    Attributes
    ----------
    points : ndarray of shape (n, 2)
        Where edges met; first the polygon's own vertices, ring by ring.
    times : ndarray of shape (n,)
        When: the distance that an edge of speed 1 had moved.
    faces : list of (int, int, list of list of int)
        Per edge and stage (times between marks): number of the edge, of the stage, and the loops of points round what
        it swept, counter-clockwise in the coordinates (along the edge, time).
    tops : list of list of int
        Loops of points of what was left when it was stopped, the interior on the left.
    """

    points: Array
    times: Array
    faces: list[tuple[int, int, list[Loop]]]
    tops: list[Loop]


def straight_skeleton(
    rings: Sequence[Array], speeds: Array | None = None, stop: float = np.inf, marks: Sequence[float] = ()
) -> Skeleton:
    """Move the edges of a polygon inwards, each in parallel, and record where they meet.

    The wavefront is advanced from event to event. At each, all vertices that coincide and all that touch an edge are
    joined at once, what folded up is cancelled, and the rest is linked anew; so simultaneous events, which regular
    plans are full of, need no order among them.

    Parameters
    ----------
    rings : sequence of ndarray of shape (n, 2)
        Outline counter-clockwise, holes clockwise.
    speeds : ndarray, optional
        Speed of every edge, ring by ring, not negative; edge i of a ring starts at its vertex i. None: all 1. Edges of
        speed 0 stay: a gable stands on them.
    stop : float
        Time at which to stop.
    marks : sequence of float
        Times at which faces are divided.

    Returns
    -------
    Skeleton

    Raises
    ------
    InputError
        Where the wavefront does not fold up: two parallel edges of different speeds meet.
    """
    return _Wavefront(rings, speeds).swept(stop, sorted(marks))


class _Wavefront:
    def __init__(self, rings: Sequence[Array], speeds: Array | None) -> None:
        self.points: list[Array] = [point for ring in rings for point in np.asarray(ring, float)]
        self.times = [0.0] * len(self.points)
        every = np.array(self.points)
        self.origin = every.mean(axis=0)
        self.eps = SAME_VERTEX * float(np.ptp(every, axis=0).max())
        self.loops: list[list[tuple[int, int]]] = []  # vertex, and the edge that leaves it
        directions: list[Array] = []
        for ring in rings:
            start = len(directions)
            self.loops.append([(start + i, start + i) for i in range(len(ring))])
            edges = np.roll(ring, -1, axis=0) - ring
            directions += list(edges / np.hypot(*edges.T)[:, None])
        self.along = np.array(directions)
        self.inward = np.column_stack([-self.along[:, 1], self.along[:, 0]])
        self.speed = np.ones(len(self.along)) if speeds is None else np.asarray(speeds, float)
        self.quads: defaultdict[tuple[int, int], list[Loop]] = defaultdict(list)

    def swept(self, stop: float, marks: list[float]) -> Skeleton:
        stage, time = 0, 0.0
        for _ in range(20 * len(self.points) + 20):
            if not self.loops or time >= stop:
                break
            step = self._until_event()
            limit = min([stop, *(m for m in marks[stage : stage + 1])]) - time
            if not np.isfinite(min(step, limit)):
                raise InputError("the roof does not close; give fewer gables or another pitch")
            time += min(step, limit)
            self._advance(min(step, limit), time, stage)
            stage += stage < len(marks) and time >= marks[stage]
        else:
            raise InputError("the roof does not close; simplify the outline")
        faces = []
        for (edge, part), quads in sorted(self.quads.items()):
            faces.append((edge, part, self._outline(edge, quads)))
        tops = [[vertex for vertex, _ in loop] for loop in self.loops]
        return Skeleton(np.array(self.points), np.array(self.times), faces, tops)

    def _arrays(self) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.intp], NDArray[np.intp]]:
        """Vertex, edge that leaves it, edge that reaches it, and place of the next vertex, for all loops."""
        vertex: list[int] = []
        leaving: list[int] = []
        reaching: list[int] = []
        following: list[int] = []
        for loop in self.loops:
            start = len(vertex)
            vertex += [v for v, _ in loop]
            leaving += [e for _, e in loop]
            reaching += [loop[i - 1][1] for i in range(len(loop))]
            following += [start + (i + 1) % len(loop) for i in range(len(loop))]
        return np.array(vertex), np.array(leaving), np.array(reaching), np.array(following)

    def _velocities(self, reaching: NDArray[np.intp], leaving: NDArray[np.intp]) -> Array:
        """Where vertices move so that both of their edges stay in parallel."""
        a, b = self.inward[reaching], self.inward[leaving]
        p, q = self.speed[reaching], self.speed[leaving]
        det = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
        straight = np.abs(det) < 1e-7
        if (straight & ((a * b).sum(axis=1) < 0)).any():
            raise InputError("two walls of the outline meet in a needle; simplify the outline")
        safe = np.where(straight, 1.0, det)
        moved = np.column_stack([p * b[:, 1] - q * a[:, 1], a[:, 0] * q - b[:, 0] * p]) / safe[:, None]
        return np.where(straight[:, None], a * np.maximum(p, q)[:, None], moved)

    def _until_event(self) -> float:
        """Time until an edge vanishes or a reflex vertex meets an edge."""
        vertex, leaving, reaching, following = self._arrays()
        at = np.array(self.points)[vertex]
        move = self._velocities(reaching, leaving)
        along, inward = self.along[leaving], self.inward[leaving]
        length = ((at[following] - at) * along).sum(axis=1)
        growth = ((move[following] - move) * along).sum(axis=1)
        shrinking = growth < -1e-12
        times = [np.inf, *np.maximum(-length[shrinking] / growth[shrinking], 0.0)]
        turn = self.along[reaching, 0] * self.along[leaving, 1] - self.along[reaching, 1] * self.along[leaving, 0]
        reflex = np.flatnonzero(turn < -1e-7)
        if len(reflex):
            gap = ((at[reflex][:, None] - at[None]) * inward[None]).sum(axis=2)
            rate = move[reflex] @ inward.T - self.speed[leaving][None]
            own = (leaving[None] == leaving[reflex][:, None]) | (leaving[None] == reaching[reflex][:, None])
            meets = (rate < -1e-12) & (gap > -self.eps) & ~own
            when = np.where(meets, -np.maximum(gap, 0.0) / np.where(meets, rate, 1.0), np.inf)
            finite = np.where(np.isfinite(when), when, 0.0)[..., None]
            there = at[reflex][:, None] + move[reflex][:, None] * finite
            start = at[None] + move[None] * finite
            place = ((there - start) * along[None]).sum(axis=2)
            extent = length[None] + growth[None] * finite[..., 0]
            hits = meets & (place >= -self.eps) & (place <= extent + self.eps)
            times += list(when[hits])
        return float(min(times))

    def _advance(self, step: float, time: float, stage: int) -> None:
        """Move all vertices, record what the edges swept, and link what is left."""
        vertex, leaving, reaching, following = self._arrays()
        at = np.array(self.points)[vertex] + step * self._velocities(reaching, leaving)
        new, spots = self._joined(at, time)
        ids = np.array(sorted(set(new)))
        remaining: list[tuple[int, int, int]] = []
        for i in range(len(vertex)):
            chain = self._chain(new[i], new[following[i]], ids, spots, self.along[leaving[i]])
            quad = [int(vertex[i]), int(vertex[following[i]]), *chain[::-1]]
            self.quads[int(leaving[i]), stage].append(quad)
            remaining += [(a, b, int(leaving[i])) for a, b in pairwise(chain)]
        self.loops = self._linked(remaining)

    def _joined(self, at: Array, time: float) -> tuple[list[int], Array]:
        """New points, one for all that coincide; their number for each vertex, and all points."""
        near = np.abs(at[:, None] - at[None]).max(axis=2) <= 4 * self.eps
        new: list[int] = []
        for i in range(len(at)):
            first = int(near[i].argmax())
            if first < i:
                new.append(new[first])
            else:
                new.append(len(self.points))
                self.points.append(at[i])
                self.times.append(time)
        return new, np.array(self.points)

    def _chain(self, start: int, end: int, ids: NDArray[np.intp], points: Array, along: Array) -> Loop:
        """The points from one end of an edge to the other, with those between that touch it."""
        if start == end:
            return [start]
        offset = points[ids] - points[start]
        length = float((points[end] - points[start]) @ along)
        place = offset @ along
        off = np.abs(offset[:, 0] * along[1] - offset[:, 1] * along[0])
        between = (off <= 4 * self.eps) & (place > 0) & (place < length) & (ids != start) & (ids != end)
        return [start, *ids[between][np.argsort(place[between])].tolist(), end]

    def _linked(self, edges: list[tuple[int, int, int]]) -> list[list[tuple[int, int]]]:
        """Loops of what is left of the edges, where those that run back and forth have cancelled."""
        loops = []
        for loop in linked_loops(uncancelled(edges), np.array(self.points), self.along):
            if len(loop) < 3:
                raise InputError("the roof folds over itself; simplify the outline")
            loops.append(loop)
        return loops

    def _outline(self, edge: int, quads: list[Loop]) -> list[Loop]:
        """The loops round all that an edge swept."""
        sides = []
        for quad in quads:
            sides += [(a, b, 0) for a, b in zip(quad, quad[1:] + quad[:1], strict=True) if a != b]
        flat = np.column_stack([(np.array(self.points) - self.origin) @ self.along[edge], self.times])
        return [[vertex for vertex, _ in loop] for loop in linked_loops(uncancelled(sides), flat)]
