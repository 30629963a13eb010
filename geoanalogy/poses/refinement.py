"""Candidates moved onto the exact maximum: a result must not move when the grid does (section 4.5)."""

import numpy as np
from numpy.typing import NDArray

from ..relations.elements import ElementType
from .importance import WIDE_SHARE, WIDE_WIDTH, Importance, Misses

Array = NDArray[np.float64]

#: Iterations of reweighted least squares; fewer where no step is larger than this share of a half-width any more.
SETTLED = 1e-4
ITERATIONS = 6

#: The number of results per parent that the numbers kept below are meant for; where more are wanted, more are kept.
PER_PARENT = 12

#: Candidates kept after an iteration, by its number: at the most so many, within this share of the best importance.
#: Falling behind early says little, falling behind late is final.
KEPT = {0: (24, 0.4), 1: (20, 0.4), 2: (16, 0.4), 3: (12, 0.4)}

#: Pairs of features that can contribute less than this share of the strongest one do not pull at poses.
STRONG = 0.05

#: Candidates nearer than this, in half-widths of level sets, have come to the same maximum.
SAME_MAXIMUM = 0.1

#: Misses below this share of the width count as met when they are weighted: keeps the weights finite. Sharper with
#: every iteration.
MET = 0.6
SHARPER = 0.3

#: Leading candidates around which is looked for better places, and how far, in half-widths. Where samples disagree the
#: importance has plateaus with narrow peaks; least squares settle anywhere on them. And the iterations that follow.
PROBED = 6
PROBES = (0.1, 0.2, 0.4, 0.8, 1.4, 2.0)
AGAIN = range(2, ITERATIONS + 1)


def refine(importance: Importance, position: Array, angle: Array, floor: float = 0.0) -> tuple[Array, Array, Array]:
    """Move poses to the nearby maximum of the importance.

    The kernel falls off linearly, so a maximum is where the weighted sum of distances from level sets is least: solved
    by least squares, each miss weighted by its inverse, for position and direction together. The best pose met on the
    way is returned; candidates that fall far behind are dropped.

    Parameters
    ----------
    importance : Importance
    position : ndarray of shape (m, 2)
    angle : ndarray of shape (m,)
    floor : float
        The best importance known elsewhere in the arrangement: what falls behind it is dropped too.

    Returns
    -------
    position, angle, importance : ndarray
        Of shapes (k, 2), (k,) and (k,), k <= m.
    """
    unit = np.array([importance.width, importance.width, importance.query.options.direction_width])
    strong = importance.of_strongest(STRONG)
    position, angle, value = _descend(strong, position, angle, unit, range(ITERATIONS + 1), floor)
    if not len(position):
        return position, angle, value
    position, angle = _probe(strong, position, angle, value, unit)
    return position, angle, importance(position, angle)


def _descend(
    strong: Importance, position: Array, angle: Array, unit: Array, iterations: range, floor: float | None = None
) -> tuple[Array, Array, Array]:
    """The best poses met in iterations of reweighted least squares, and their importance for the strong pairs.

    Without a floor all are kept.
    """
    best_position, best_angle, best = position, angle, np.full(len(position), -1.0)
    for iteration in iterations:
        if not len(position):
            break
        misses = strong.misses(position, angle, uphill=True)
        value, step = _step(strong, misses, angle, unit, MET * SHARPER**iteration)
        better = value > best
        best_position = np.where(better[:, None], position, best_position)
        best_angle = np.where(better, angle, best_angle)
        best = np.maximum(best, value)
        # Far steps lead to other maxima, which have candidates of their own.
        size = np.abs(step / unit).max(axis=1, keepdims=True)
        step = step * np.minimum(1.0, 2.0 * 0.8**iteration / np.maximum(size, 1e-12))
        if iteration > max(KEPT) and size.max() < SETTLED:
            break
        position, angle = position + step[:, :2], angle + step[:, 2]
        if iteration in KEPT and floor is not None:
            most, share = KEPT[iteration]
            most = most * max(PER_PARENT, strong.query.options.candidates) // PER_PARENT
            kept = _leading(best_position, best_angle, best, unit, floor, most, share)
            position, angle = position[kept], angle[kept]
            best_position, best_angle, best = best_position[kept], best_angle[kept], best[kept]
    return best_position, best_angle, best


def _probe(strong: Importance, position: Array, angle: Array, value: Array, unit: Array) -> tuple[Array, Array]:
    """Look around the leading poses for better ones, and go on from those."""
    lead = np.argsort(-value, kind="stable")[:PROBED]
    c, s = np.cos(angle[lead]), np.sin(angle[lead])
    ways = np.stack([np.stack([c, s], axis=1), np.stack([-s, c], axis=1)])
    steps = unit[0] * np.concatenate([sign * far * ways for far in PROBES for sign in (1, -1)])
    around = position[lead] + steps
    found = strong(around.reshape(-1, 2), np.tile(angle[lead], len(steps))).reshape(len(steps), len(lead))
    best = np.argmax(found, axis=0)
    gains = np.flatnonzero(found.max(axis=0) > value[lead])
    if len(gains):
        moved = lead[gains]
        new = _descend(strong, around[best[gains], gains], angle[moved], unit, AGAIN)
        better = new[2] > value[moved]
        position[moved[better]], angle[moved[better]] = new[0][better], new[1][better]
    return position, angle


def _leading(
    position: Array, angle: Array, value: Array, unit: Array, floor: float, most: int, share: float
) -> NDArray[np.intp]:
    """The best candidates, one per maximum."""
    order = np.argsort(-value, kind="stable")
    order = order[value[order] >= share * max(floor, value[order[0]])]
    pose = np.column_stack([position, np.cos(angle) * unit[0] / unit[2], np.sin(angle) * unit[0] / unit[2]])[order]
    near = np.abs(pose[:, None] - pose).max(axis=2) < SAME_MAXIMUM * unit[0]
    # One that has a better one beside it is the same.
    alone = ~np.tril(near, -1).any(axis=1)
    return order[alone][:most]


def _step(
    importance: Importance, misses: dict[ElementType, Misses], angle: Array, unit: Array, met: float
) -> tuple[Array, Array]:
    """The importance, shape (m,), and one step of reweighted least squares, shape (m, 3)."""
    m = len(angle)
    total = np.zeros(m)
    normal = np.zeros((m, 3, 3))
    right = np.zeros((m, 3))
    # A turn of the pose moves a sample at right angles to its arm.
    arms = importance.sample_points(np.zeros((m, 2)), angle)
    for element, missed in misses.items():
        a = importance.answers[element]
        kernel = importance.kernel(missed)
        directional = importance.directional(element, missed)
        pairs = importance.of_pairs(element, kernel * directional)
        top = np.maximum.reduceat(pairs, a.feature_start, axis=0)
        total += top.sum(axis=0)
        per_feature = np.diff(np.append(a.feature_start, len(a.accuracy)))
        wins = (pairs == np.repeat(top, per_feature, axis=0)) & (pairs > 0)
        per_pair = np.diff(np.append(a.pair_start, len(a.target)))
        strength = np.repeat(wins * a.accuracy[:, None], per_pair, axis=0) * a.weight[:, :, None]
        far = np.abs(missed.place) / importance.width
        pull = ((1 - WIDE_SHARE) * (far < 1) + WIDE_SHARE / WIDE_WIDTH * (far < WIDE_WIDTH)) * strength * directional
        assert missed.uphill is not None
        c, s = np.cos(missed.uphill), np.sin(missed.uphill)
        arm = arms[a.sample]
        around = (arm[..., 0] * s - arm[..., 1] * c) * unit[2] / importance.width
        slope = np.stack([c, s, around], axis=-1)
        weight = pull * missed.allowed / np.maximum(far, met)
        _add(normal, right, missed.place / importance.width, slope, weight)
        directed = importance.directed(element)
        if directed.any():
            turn = missed.turn / unit[2]
            off = np.abs(turn)
            weight = (off < 1) * directed[:, None] * strength * kernel / np.maximum(off, met)
            # Reference directions are taken as constant: those of straight segments are.
            normal[:, 2, 2] += weight.sum(axis=(0, 1))
            right[:, 2] += (weight * turn).sum(axis=(0, 1))
    normal += np.eye(3) * (1e-9 + 1e-7 * np.trace(normal, axis1=1, axis2=2)[:, None, None])
    step = -np.linalg.solve(normal, right[..., None])[..., 0] * unit
    return total / importance.query.total if importance.query.total else total, step


def _add(normal: Array, right: Array, miss: Array, slope: Array, weight: Array) -> None:
    """Add weighted misses (relations, entries, m), with their slopes in three unknowns, to the normal equations."""
    miss = np.where(weight > 0, miss, 0.0)
    weighted = weight[..., None] * slope
    right += np.einsum("remi,rem->mi", weighted, miss)
    normal += np.einsum("remi,remj->mij", weighted, slope)
