"""Candidates moved onto the exact maximum: a result must not move when the grid does (section 4.5)."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from .batch import Batch
from .candidates import Candidates
from .importance import Importance
from .kernels import WIDE_SHARE, WIDE_WIDTH
from .rivals import IsExample, Refined, Rivals, Stands
from .rows import Misses, Rows

Array = NDArray[np.float64]
Indices = NDArray[np.intp]

#: Iterations of reweighted least squares; fewer where no step is larger than this share of a half-width any more.
SETTLED = 1e-4
ITERATIONS = 6

#: Candidates of an arrangement kept after an iteration, by its number: at the most so many for each of its senses and
#: scales, within this share of the best importance. Falling behind early says little, falling behind late is final.
#: What candidates are worth where they begin says nothing: the best may begin three half-widths from its maximum.
KEPT = {1: (20, 0.35), 2: (16, 0.4), 3: (12, 0.4)}

#: How far into what the object may not be in candidates may be, in half-widths of level sets: at first, and once the
#: last have been dropped.
SLACK_AT_FIRST = 2.0
SLACK_AT_LAST = 0.5

#: Candidates that cannot be accepted are looked beside from this share of the best importance on.
WORTH_FREEING = 0.6

#: Pairs of features that can contribute less than this share of the strongest one do not pull at poses.
STRONG = 0.05

#: How far poses are expected to move, in half-widths of level sets and of directions: at first, and once the last
#: candidates have been dropped.
SEARCHING = (4.0, 2.0)
SETTLING = (1.0, 0.5)

#: Misses below this share of the width count as met when they are weighted: keeps the weights finite. Sharper with
#: every iteration.
MET = 0.6
SHARPER = 0.3

#: Steps to less than this share of the best importance are taken back.
FALL = 0.7

#: Leading candidates of an arrangement, for each of its senses and scales, around which is looked for better places,
#: and how far, in half-widths. Where samples disagree the importance has plateaus with narrow peaks; least squares
#: settle anywhere on them. And the iterations that follow.
PROBED = 4
PROBES = (0.15, 0.4, 1.0, 1.5, 2.0)
AGAIN = range(2, ITERATIONS + 1)

#: Leading poses of an arrangement, for each of its senses and scales, that go on uphill along position and direction,
#: if they come near the best by this share; their steps at first, in half-widths, and how many there are: least squares
#: may stop short of a narrow peak.
CLIMBING = 2
EQUALLY_GOOD = 0.98
FARTHEST_CLIMB = 0.1
CLIMBS = 8


def refine(
    importances: Sequence[Importance],
    candidates: Sequence[Candidates],
    factor: Sequence[float] | Array | None = None,
    stands: Stands | None = None,
    is_example: IsExample | None = None,
) -> Refined:
    """Move poses to the nearby maximum of the importance, in many arrangements at once.

    The kernel falls off linearly, so a maximum is where the weighted sum of distances from level sets is least: solved
    by least squares, each miss weighted by its inverse, for position and direction together. The best pose met on the
    way is returned; candidates that fall far behind the best one of their arrangement are dropped.

    Parameters
    ----------
    importances : sequence of Importance
        Of one query.
    candidates : sequence of Candidates
        Of each importance.
    factor : sequence of float or ndarray, optional
        What the importances are multiplied by before those of an arrangement are compared.
    stands : callable, optional
        Which poses may be accepted; None: all. The others are dropped where better ones are left.
    is_example : callable, optional
        Which poses are the example itself, which is no answer; None: none.

    Returns
    -------
    Refined
    """
    count = [len(c.angle) for c in candidates]
    if not sum(count):
        return Refined(np.zeros(0, dtype=np.intp), np.zeros((0, 2)), np.zeros(0), np.zeros(0))
    start = Refined(
        np.repeat(np.arange(len(importances)), count),
        np.concatenate([c.position for c in candidates]),
        np.concatenate([c.angle for c in candidates]),
        np.concatenate([c.strength for c in candidates]),
    )
    every = Batch(importances)
    strong = every.strongest(STRONG)
    factor = np.ones(len(importances)) if factor is None else np.array(factor)
    rivals = Rivals(importances, strong, factor, stands, is_example)
    start = start.of(rivals.standing(start, SLACK_AT_FIRST))
    start = replace(start, value=np.full(len(start.which), -1.0))
    found = _descend(strong, start, range(ITERATIONS + 1), rivals)
    found = _climb(strong, _probe(strong, found, rivals), rivals)
    value = every.importance(found.which, found.position, found.angle)
    return Refined(found.which, found.position, found.angle, value)


def _descend(batch: Batch, poses: Refined, iterations: range, rivals: Rivals | None = None) -> Refined:
    """The best poses met in iterations of reweighted least squares, and their importance.

    Without rivals all are kept.
    """
    best, best_step = poses, np.zeros((len(poses.which), 3))
    position, angle = poses.position, poses.angle
    near = _near(batch, poses, SETTLING if rivals is None else SEARCHING)
    own = np.arange(len(angle))
    rows = near.rows(own)
    for iteration in iterations:
        value, step = _step(near, rows, own, position, angle, MET * SHARPER**iteration)
        better = value > best.value
        # A step too far is taken again from the best pose, half as long.
        fell = (value < FALL * best.value)[:, None]
        best = best.bettered(position, angle, value)
        # Far steps lead to other maxima, which have candidates of their own.
        size = np.abs(step / near.unit[own]).max(axis=1, keepdims=True)
        step = step * np.minimum(1.0, 2.0 * 0.8**iteration / np.maximum(size, 1e-12))
        if iteration > max(KEPT) and size.max() < SETTLED:
            break
        best_step = np.where(better[:, None], step, np.where(fell, best_step / 2, best_step))
        step = np.where(fell, best_step, step)
        position = np.where(fell, best.position, position) + step[:, :2]
        angle = np.where(fell[:, 0], best.angle, angle) + step[:, 2]
        if iteration in KEPT and rivals is not None:
            kept = rivals.leading(best, *KEPT[iteration])
            if iteration == max(KEPT):
                best, kept = _freed(near, own, best, kept, rivals)
                moved = best.value < 0
                position[moved], angle[moved], best_step[moved] = best.position[moved], best.angle[moved], 0.0
            if len(kept) < len(angle):
                position, angle, best, best_step = position[kept], angle[kept], best.of(kept), best_step[kept]
                own = own[kept]
                rows = near.rows(own)
            if iteration == max(KEPT):
                near = _near(near, replace(best, which=own, position=position, angle=angle), SETTLING)
                own = np.arange(len(angle))
                rows = near.rows(own)
    return best


def _freed(batch: Batch, own: Indices, poses: Refined, chosen: Indices, rivals: Rivals) -> tuple[Refined, Indices]:
    """The chosen poses that may be accepted, and better places beside the others that may.

    Where the grid's points lie decides whether a place at a wall is begun from within the wall or from the room, and
    what is settled on inside it says nothing about the place in the room.

    Returns
    -------
    Refined
        All poses; those that were moved have the importance -1.
    ndarray of int
        The numbers of those to go on with, in order.
    """
    stand = rivals.standing(poses.of(chosen), SLACK_AT_LAST)
    fallen = np.delete(chosen, stand)
    fallen = fallen[np.delete(rivals.shares(poses.of(chosen)), stand) >= WORTH_FREEING]
    if not len(fallen):
        return poses, chosen[stand]
    before = poses.of(fallen)
    beside = _beside(batch, own[fallen], before, [far for far in PROBES if far > SLACK_AT_LAST])
    again = np.flatnonzero(beside.value > before.value)
    again = again[rivals.acceptable(beside.of(again), SLACK_AT_LAST)]
    moved = fallen[again]
    position, angle, value = poses.position.copy(), poses.angle.copy(), poses.value.copy()
    position[moved], angle[moved], value[moved] = beside.position[again], beside.angle[again], -1.0
    return Refined(poses.which, position, angle, value), np.sort(np.append(chosen[stand], moved))


def _probe(batch: Batch, poses: Refined, rivals: Rivals) -> Refined:
    """Look around the leading poses for better ones, and go on from those."""
    table = rivals.in_turn(poses, PROBED)
    lead = np.sort(table[table >= 0])
    leading = poses.of(lead)
    best = _beside(_near(batch, leading, (max(PROBES), 0.0)), np.arange(len(lead)), leading, PROBES)
    gains = np.flatnonzero(best.value > leading.value)
    if not len(gains):
        return poses
    start = replace(best.of(gains), value=np.full(len(gains), -1.0))
    found = _descend(batch, start, AGAIN)
    position, angle, value = poses.position.copy(), poses.angle.copy(), poses.value.copy()
    better = found.value > leading.value[gains]
    moved = lead[gains[better]]
    position[moved], angle[moved], value[moved] = found.position[better], found.angle[better], found.value[better]
    return Refined(poses.which, position, angle, value)


def _beside(batch: Batch, own: Indices, poses: Refined, far: Sequence[float]) -> Refined:
    """Each pose, or the best place ahead, behind or at a side of it that is worth more, so many half-widths away."""
    c, s = np.cos(poses.angle), np.sin(poses.angle)
    ways = np.stack([c, s, -c, -s, -s, c, s, -c], axis=1).reshape(-1, 4, 2) * batch.unit[own, None, :1]
    # All four ways at once: a call costs about as much as a thousand rows.
    rows = batch.rows(np.repeat(own, 4))
    every = np.arange(len(own))
    best = poses
    for step in far:
        around = poses.position[:, None] + step * ways
        offered = batch.total(rows, around.reshape(-1, 2), np.repeat(poses.angle, 4)).reshape(-1, 4)
        way = np.argmax(offered, axis=1)
        best = best.bettered(around[every, way], poses.angle, offered[every, way])
    return best


def _climb(batch: Batch, poses: Refined, rivals: Rivals) -> Refined:
    """Move the leading poses uphill in ever smaller steps."""
    table = rivals.in_turn(poses, CLIMBING)
    value = np.where(table >= 0, rivals.worth(poses)[table], -1.0)
    # Those that may turn out to be as good as the best are equally well served.
    lead = np.sort(table[value >= EQUALLY_GOOD * value[:, :1]])
    best = poses.of(lead)
    # All six ways at once: there are few poses, and a call costs about as much as a thousand rows.
    every = np.arange(len(lead))
    rows = _near(batch, best, (CLIMBS * FARTHEST_CLIMB,) * 2).rows(np.repeat(every, 6))
    reach = FARTHEST_CLIMB * batch.unit[best.which]
    for _ in range(CLIMBS):
        before = best.value
        position, angle = best.one_step_away(reach)
        offered = batch.total(rows, position.reshape(-1, 2), angle.ravel()).reshape(angle.shape)
        way = np.argmax(offered, axis=1)
        best = best.bettered(position[every, way], angle[every, way], offered[every, way])
        reach = np.where((best.value > before)[:, None], reach, reach / 2)
    position, angle, value = poses.position.copy(), poses.angle.copy(), poses.value.copy()
    position[lead], angle[lead], value[lead] = best.position, best.angle, best.value
    return Refined(poses.which, position, angle, value)


def _near(batch: Batch, poses: Refined, reach: tuple[float, float]) -> Batch:
    """What poses compare that move no further than `reach`, in half-widths of level sets and of directions."""
    turn = reach[1] * batch.query.options.direction_width
    return batch.near(poses.which, poses.position, poses.angle, reach[0], turn)


def _step(
    batch: Batch, rows: Sequence[Rows], which: Indices, position: Array, angle: Array, met: float
) -> tuple[Array, Array]:
    """The importance, shape (m,), and one step of reweighted least squares, shape (m, 3)."""
    m = len(angle)
    total = np.zeros(m)
    # The normal equations: the upper triangle of their matrix, row by row, and their right side.
    sums = np.zeros((9, m))
    unit = batch.unit[which]
    for r in rows:
        misses = r.misses(position, angle, uphill=True)
        kernel, directional = r.kernel(misses), r.directional(misses)
        worth = kernel if directional is None else kernel * directional
        pairs = r.of_pairs(worth)
        top = r.best(pairs)
        total += r.of_poses(top)
        wins = (pairs == np.repeat(top, r.per_feature)) & (pairs > 0)
        strength = np.repeat(wins * r.accuracy, r.per_pair) * r.weight
        pull = strength if directional is None else strength * directional
        sums += _pulls(r, misses, angle, pull, unit[0, 2], met)
        if misses.turn is not None:
            turn = misses.turn / unit[0, 2]
            off = np.abs(turn)
            kernel *= strength
            weight = kernel * ((off < 1) * r.directed / np.maximum(off, met))
            # Reference directions are taken as constant: those of straight segments are.
            sums[5] += r.summed(weight.sum(axis=0))
            sums[8] += r.summed((weight * turn).sum(axis=0))
    normal = sums[[0, 1, 2, 1, 3, 4, 2, 4, 5]].T.reshape(m, 3, 3)
    trace = sums[0] + sums[3] + sums[5]
    normal = normal + np.eye(3) * (1e-9 + 1e-7 * trace)[:, None, None]
    step = -np.linalg.solve(normal, sums[6:].T[..., None])[..., 0] * unit
    return batch.normalised(total), step


def _pulls(r: Rows, misses: Misses, angle: Array, pull: Array, turn_unit: float, met: float) -> Array:
    """What the misses of a type of element add to the normal equations; shape (9, m)."""
    miss = misses.place / r.width
    far = np.abs(miss)
    weight = (1 - WIDE_SHARE) * (far < 1)
    weight += WIDE_SHARE / WIDE_WIDTH * (far < WIDE_WIDTH)
    weight *= pull
    weight /= np.maximum(far, met)
    if misses.allowed is not None:
        weight *= misses.allowed
    assert misses.uphill is not None
    x, y = misses.uphill.real.copy(), misses.uphill.imag.copy()
    # A turn of the pose moves a sample at right angles to its arm.
    arm_x, arm_y = r.arms(angle)
    around = arm_x * y
    around -= arm_y * x
    around *= turn_unit / r.width
    wx, wy, wa = weight * x, weight * y, weight * around
    factors = ((wx, x), (wx, y), (wx, around), (wy, y), (wy, around), (wa, around), (wx, miss), (wy, miss), (wa, miss))
    terms = np.empty((9, miss.shape[1]))
    for term, (one, other) in zip(terms, factors, strict=True):
        np.einsum("kn,kn->n", one, other, out=term)
    return r.summed(terms)
