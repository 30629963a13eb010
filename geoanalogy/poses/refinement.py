"""Candidates moved onto the exact maximum: a result must not move when the grid does (section 4.5)."""

import numpy as np
from numpy.typing import NDArray

from ..relations.elements import ElementType
from .importance import WIDE_SHARE, WIDE_WIDTH, Importance

Array = NDArray[np.float64]

#: Iterations of reweighted least squares; the last ones only sharpen.
ITERATIONS = 8

#: Steps of the numerical derivative, as a share of the level sets' width, and in radians.
STEP = 1e-4

#: Misses below this share of the width count as met when they are weighted: keeps the weights finite.
MET = 1e-3


def refine(importance: Importance, position: Array, angle: Array) -> tuple[Array, Array, Array]:
    """Move poses to the nearby maximum of the importance.

    The kernel falls off linearly, so a maximum is where the weighted sum of distances from level sets is least: solved
    by least squares, each miss weighted by its inverse, for position and direction together. The best pose met on the
    way is returned.

    Parameters
    ----------
    importance : Importance
    position : ndarray of shape (m, 2)
    angle : ndarray of shape (m,)

    Returns
    -------
    position, angle, importance : ndarray
        Of shapes (m, 2), (m,) and (m,).
    """
    position, angle = position.copy(), angle.copy()
    value = importance(position, angle)
    best_position, best_angle, best = position.copy(), angle.copy(), value
    unit = np.array([importance.width, importance.width, importance.query.options.direction_width])
    for iteration in range(ITERATIONS):
        step = _step(importance, position, angle, unit)
        # Far steps lead to other maxima, which have candidates of their own.
        size = np.abs(step / unit).max(axis=1, keepdims=True)
        step = step * np.minimum(1.0, 2.0 * 0.8**iteration / np.maximum(size, 1e-12))
        position, angle = position + step[:, :2], angle + step[:, 2]
        value = importance(position, angle)
        better = value > best
        best_position[better], best_angle[better] = position[better], angle[better]
        best = np.maximum(best, value)
    return best_position, best_angle, best


def _step(importance: Importance, position: Array, angle: Array, unit: Array) -> Array:
    """One step of reweighted least squares; shape (m, 3)."""
    at = importance.misses(position, angle)
    moved = []
    for axis in range(3):
        nudge = np.zeros(3)
        nudge[axis] = STEP * unit[axis]
        moved.append(importance.misses(position + nudge[:2], angle + nudge[2]))
    normal = np.zeros((len(position), 3, 3))
    right = np.zeros((len(position), 3))
    for element, misses in at.items():
        a = importance.answers[element]
        kernel = importance.kernel(misses)
        directional = importance.directional(element, misses)
        entries = np.einsum("re,rem->em", a.weight, kernel * directional)
        pairs = np.add.reduceat(entries, a.pair_start, axis=0) * a.accuracy[:, None]
        top = np.maximum.reduceat(pairs, a.feature_start, axis=0)
        per_feature = np.diff(np.append(a.feature_start, len(a.accuracy)))
        wins = (pairs == np.repeat(top, per_feature, axis=0)) & (pairs > 0)
        per_pair = np.diff(np.append(a.pair_start, len(a.target)))
        wins = np.repeat(wins, per_pair, axis=0)
        strength = a.weight[:, :, None] * np.repeat(a.accuracy, per_pair)[:, None] * wins * (kernel > 0)
        far = np.abs(misses.place) / importance.width
        pull = ((1 - WIDE_SHARE) * (far < 1) + WIDE_SHARE / WIDE_WIDTH * (far < WIDE_WIDTH)) * strength * directional
        slope = [(m[element].place - misses.place) / STEP / importance.width for m in moved]
        _add(normal, right, misses.place / importance.width, slope, pull / np.maximum(far, MET))
        if not (element is ElementType.CORNER and importance.query.rigid):
            turn = misses.turn / unit[2]
            off = np.abs(turn)
            slope = [(m[element].turn - misses.turn) / STEP / unit[2] for m in moved]
            _add(normal, right, turn, slope, (off < 1) * strength * kernel / np.maximum(off, MET))
    normal += np.eye(3) * (1e-9 + 1e-6 * np.trace(normal, axis1=1, axis2=2)[:, None, None])
    return -np.linalg.solve(normal, right[..., None])[..., 0] * unit


def _add(normal: Array, right: Array, miss: Array, slope: list[Array], weight: Array) -> None:
    """Add weighted misses (relations, entries, m) to the normal equations."""
    # Where a nearest place jumps between two edges the difference is no derivative.
    steady = np.logical_and.reduce([np.isfinite(s) & (np.abs(s) < 50) for s in slope])
    weight = np.where(steady & np.isfinite(miss), weight, 0.0)
    miss = np.where(weight > 0, miss, 0.0)
    slope = [np.where(weight > 0, s, 0.0) for s in slope]
    for i in range(3):
        weighted = weight * slope[i]
        right[:, i] += np.einsum("rem,rem->m", weighted, miss)
        for j in range(i, 3):
            normal[:, i, j] += np.einsum("rem,rem->m", weighted, slope[j])
            normal[:, j, i] = normal[:, i, j]
