"""The best poses that may be accepted, where the best maximum of the importance may not (section 4.8).

In a room that is smaller or fuller than the example's, what the relations ask for is inside an obstacle or juts out of
the room. The object then gives way: it stands at the best place beside.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..relations.runs import run_starts
from .batch import Batch
from .candidates import Candidates
from .importance import Importance
from .rivals import Refined, Rivals, Stands

#: How deep inside an obstacle a part of the object may be, in half-widths of level sets: at a candidate, less than it
#: is moved aside; and where it stands, no more than what touches may share.
FREE = 0.5
TOUCHING = 0.02

#: Candidates of each importance that are looked at; how far around one is looked for a free pose, in half-widths, and
#: in how many directions: candidates are a little more than a half-width apart, and what stands in the way is deeper.
STRONGEST = 8
AROUND = (0.0, 0.6, 1.2, 2.4)
WAYS = 8

#: Free poses that go on uphill: of each arrangement at the most so many for each of its senses and scales, within this
#: share of the best. A room that is the same turned about has two places that are as good.
KEPT = 2
EQUALLY_GOOD = 0.98

#: Steps uphill at first, in half-widths, and how many there are: steps are halved where nothing gains, so that poses
#: come to rest well within a thousandth of a room's size.
FARTHEST = 0.6
STEPS = 14


def give_way(
    importances: Sequence[Importance],
    candidates: Sequence[Candidates],
    factor: Sequence[float] | NDArray[np.float64],
    stands: Stands,
) -> Refined:
    """Move the best free poses uphill as far as nothing is in their way.

    Parameters
    ----------
    importances : sequence of Importance
        Of one query.
    candidates : sequence of Candidates
        Of each importance.
    factor : sequence of float or ndarray
        What the importances are multiplied by before those of an arrangement are compared.
    stands : callable
        Which poses may stand.

    Returns
    -------
    Refined
        Of each arrangement the best, and what is nearly as good in other places.
    """
    turns = np.arange(WAYS) * (2 * np.pi / WAYS)
    rings = np.array([(far * np.cos(t), far * np.sin(t)) for far in AROUND for t in turns[: WAYS if far else 1]])
    positions, angles = [np.zeros((0, 2))], [np.zeros(0)]
    for importance, every in zip(importances, candidates, strict=True):
        c = every.of(np.argsort(-every.strength, kind="stable")[:STRONGEST])
        cos, sin = np.cos(c.angle)[:, None], np.sin(c.angle)[:, None]
        x, y = importance.width * rings.T
        around = np.stack([cos * x - sin * y, sin * x + cos * y], axis=-1) + c.position[:, None]
        positions.append(around.reshape(-1, 2))
        angles.append(np.repeat(c.angle, len(rings)))
    which = np.repeat(np.arange(len(importances)), [len(a) for a in angles[1:]])
    poses = Refined(which, np.concatenate(positions), np.concatenate(angles), np.zeros(len(which)))
    free = stands(importances, poses, TOUCHING)
    poses, beside = poses.of(free), np.flatnonzero(free) // len(rings)
    if not len(poses.angle):
        return poses
    batch = Batch(importances)
    poses = replace(poses, value=batch.importance(poses.which, poses.position, poses.angle))
    order = np.lexsort((-poses.value, beside))
    poses = poses.of(order[run_starts(beside[order])])
    rivals = Rivals(importances, batch, np.asarray(factor))
    return _uphill(batch, importances, poses.of(rivals.leading(poses, KEPT, EQUALLY_GOOD)), stands)


def _uphill(batch: Batch, importances: Sequence[Importance], poses: Refined, stands: Stands) -> Refined:
    """Poses moved in ever smaller steps, never to one that may not stand."""
    every = np.arange(len(poses.which))
    far = STEPS * FARTHEST
    rows = batch.near(poses.which, poses.position, poses.angle, far, far * batch.unit[0, 2]).rows(np.repeat(every, 6))
    reach = FARTHEST * batch.unit[poses.which]
    for _ in range(STEPS):
        before = poses.value
        position, angle = poses.one_step_away(reach)
        offered = batch.total(rows, position.reshape(-1, 2), angle.ravel()).reshape(angle.shape)
        better = offered > before[:, None]
        of, way = np.nonzero(better)
        offers = Refined(poses.which[of], position[better], angle[better], offered[better])
        better[of, way] = stands(importances, offers, TOUCHING)
        offered = np.where(better, offered, -1.0)
        way = np.argmax(offered, axis=1)
        poses = poses.bettered(position[every, way], angle[every, way], offered[every, way])
        reach = np.where((poses.value > before)[:, None], reach, reach / 2)
    return poses
