"""Candidate poses: maxima of the accumulated level sets on a grid (section 4.5).

Three ways to accumulate, by the option of that name. All three only *find* places; what a place is worth is
`importance`, evaluated exactly.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..relations.table import Kind, Positional
from .fields import Fields
from .importance import Importance
from .kernels import WIDE_SHARE, WIDE_WIDTH, level_set, wrap
from .matching import Answers

Array = NDArray[np.float64]
Array32 = NDArray[np.float32]
Indices = NDArray[np.intp]

#: Maxima taken on to exact evaluation, per grid.
MAXIMA = 12

#: Directions tried at a maximum in the plane, besides that of its strongest level set.
AGREED_DIRECTIONS = 3


@dataclass(frozen=True)
class Candidates:
    """Places worth an exact look.

    Attributes
    ----------
    position : ndarray of shape (m, 2)
    angle : ndarray of shape (m,)
    strength : ndarray of shape (m,)
        What the level sets accumulate to there, 1 for a perfect copy.
    """

    position: Array
    angle: Array
    strength: Array

    def of(self, chosen: NDArray[np.bool_] | Indices) -> "Candidates":
        """Some of the places.

        Parameters
        ----------
        chosen : ndarray of bool or int

        Returns
        -------
        Candidates
        """
        return Candidates(self.position[chosen], self.angle[chosen], self.strength[chosen])

    def joined(self, more: "Candidates") -> "Candidates":
        """These places and others.

        Parameters
        ----------
        more : Candidates

        Returns
        -------
        Candidates
        """
        return Candidates(
            np.concatenate([self.position, more.position]),
            np.append(self.angle, more.angle),
            np.append(self.strength, more.strength),
        )


def find_candidates(
    importance: Importance, fields: Fields, blocked: NDArray[np.bool_], taken: NDArray[np.bool_]
) -> Candidates:
    """The maxima of the accumulated level sets.

    Parameters
    ----------
    importance : Importance
        Of the arrangement, for one sense and scale.
    fields : Fields
        The arrangement's, with the importance's relations evaluated.
    blocked : ndarray of shape (points,), bool
        Grid points where no part of the object may be.
    taken : ndarray of shape (points,), bool
        Grid points where its position may not be.

    Returns
    -------
    Candidates
    """
    free = np.flatnonzero(~blocked & ~taken)
    in_space = importance.query.options.accumulation == "pose space"
    found = (_in_pose_space if in_space else _in_plane)(importance, fields, free)
    upright = importance.query.is_upright(found.angle, importance.mirrored)
    return found.of(upright)


# ------------------------------------------------------------------------------------------------ plane


def _away(
    relation: Positional, a: Answers, k: int, importance: Importance, fields: Fields, chosen: Indices, index: Indices
) -> Array32:
    """Distance in the plane from the level sets of some entries; shape (chosen, points)."""
    target = a.target[chosen]
    value = a.value[k, chosen] * (importance.scale if relation.kind is Kind.LENGTH else 1.0)
    miss = fields.value(relation, index) - value[:, None].astype(np.float32)
    if relation.period is not None:
        period = relation.period(importance.target.elements)[target][:, None].astype(np.float32)
        cyclic = np.isfinite(period[:, 0])
        miss[cyclic] = wrap(miss[cyclic], period[cyclic])
    miss = np.abs(miss)
    if relation.kind is not Kind.LENGTH:
        miss *= fields.reach(relation, index)
    return miss


def _level_sets(importance: Importance, fields: Fields, free: Indices):  # type: ignore[no-untyped-def]
    """The level sets of every relation and pair at free grid points: kernel times I_m, and the direction wanted there.

    Yields per source feature and relation its weight I_l, the accuracies I_m (pairs,), the kernels (pairs, points) and
    the directions (pairs, points).
    """
    width = np.float32(importance.width)
    for element, a in importance.answers.items():
        for start, end in zip(a.feature_start, np.append(a.feature_start[1:], len(a.accuracy)), strict=True):
            entry = a.pair_start[start:end]  # one sample: an entry is a pair
            index = fields.index(element, a.target[entry], free)
            for k, relation in enumerate(a.relations):
                away = _away(relation, a, k, importance, fields, entry, index)
                away /= width
                kernel = level_set(away)
                accuracy = a.accuracy[start:end].astype(np.float32)
                kernel *= accuracy[:, None]
                towards = fields.direction(relation, index)
                towards = towards + a.turn[k, entry, None].astype(np.float32)
                yield float(a.weight[k, entry[0]]), accuracy, kernel, towards


def accumulate_in_plane(importance: Importance, fields: Fields, free: Indices) -> tuple[Array32, Array32]:
    """I_p and phi_max of section 4.5 at grid points.

    Parameters
    ----------
    importance : Importance
        With the centre as its only sample.
    fields : Fields
        Evaluated.
    free : ndarray of int
        Grid points.

    Returns
    -------
    importance, direction : ndarray of shape (free,), float32
        The positional importance, divided by that of a perfect copy, and the direction of the strongest level set,
        radians.
    """
    total = np.zeros(len(free), dtype=np.float32)
    strongest = np.zeros(len(free), dtype=np.float32)
    direction = np.zeros(len(free), dtype=np.float32)
    column = np.arange(len(free))
    for weight, _, kernel, towards in _level_sets(importance, fields, free):
        best = np.argmax(kernel, axis=0)
        value = kernel[best, column] * np.float32(weight)
        total += value
        stronger = value > strongest
        strongest[stronger] = value[stronger]
        direction[stronger] = towards[best[stronger], column[stronger]]
    return total / np.float32(importance.query.total), direction


def _in_plane(importance: Importance, fields: Fields, free: Indices) -> Candidates:
    score, strongest = accumulate_in_plane(importance, fields, free)
    grid = fields.grid
    sheet = np.full(len(grid), -1.0, dtype=np.float32)
    sheet[free] = score
    best = _maxima(sheet.reshape(grid.rows, grid.columns), max(1, int(2 * importance.width / grid.spacing)))
    best = best[: 4 * MAXIMA]
    place = np.zeros(len(grid), dtype=np.intp)
    place[free] = np.arange(len(free))
    maximum, direction = _agreed_directions(importance, fields, best)
    cell = np.append(best, best[maximum])
    direction = np.append(strongest[place[best]], direction).astype(np.float64)
    return Candidates(grid.points[cell], direction, score[place[cell]].astype(np.float64))


def _agreed_directions(importance: Importance, fields: Fields, cells: Indices) -> tuple[Indices, Array]:
    """Directions at maxima that most level sets agree on.

    Of level sets that are about equally strong, the grid decides which one is the strongest at a point of it: its
    direction alone would make results depend on the grid.

    Returns
    -------
    maximum : ndarray of shape (k,), int
        Number of the cell.
    direction : ndarray of shape (k,)
    """
    bins = int(np.ceil(4 * np.pi / importance.query.options.direction_width))
    share = np.zeros((bins, len(cells)))
    column = np.arange(len(cells))
    for weight, _, kernel, towards in _level_sets(importance, fields, cells):
        middle = np.rint(towards * (bins / (2 * np.pi))).astype(np.intp) % bins
        np.add.at(share, (middle, np.broadcast_to(column, middle.shape)), weight * kernel)
    share += np.roll(share, 1, axis=0) + np.roll(share, -1, axis=0)
    peak = (share >= np.roll(share, 1, axis=0)) & (share > np.roll(share, -1, axis=0))
    ranked = np.sort(np.where(peak, share, 0.0), axis=0)[::-1]
    agreed = peak & (share >= ranked[AGREED_DIRECTIONS - 1]) & (share > 0.5 * ranked[0])
    direction, maximum = np.nonzero(agreed)
    return maximum, 2 * np.pi * direction / bins


def _maxima(sheet: Array32, radius: int) -> Indices:
    """Flat indices of the local maxima of a sheet of values, best first (non-maximum suppression).

    Negative values are no places.
    """
    from scipy.ndimage import maximum_filter

    top = maximum_filter(sheet, size=2 * radius + 1, mode="constant", cval=-1.0)
    at = np.flatnonzero((sheet == top).ravel() & (sheet.ravel() > 0))
    return at[np.argsort(-sheet.ravel()[at], kind="stable")]


# ------------------------------------------------------------------------------------------------ pose space


def accumulate_in_pose_space(importance: Importance, fields: Fields, free: Indices) -> Array32:
    """I of section 4.5 on a grid of positions and directions, without the approximation of the plane.

    Sparse in work: every level set touches only the cells it passes and the few directions around the one it asks for.
    One room's sheet at a time is held, not the scene's.

    Parameters
    ----------
    importance : Importance
        With the centre as its only sample.
    fields : Fields
        Evaluated.
    free : ndarray of int
        Grid points.

    Returns
    -------
    ndarray of shape (free, direction bins), float32
        Importance divided by that of a perfect copy; bin b stands for the direction ``2 pi b / bins``.
    """
    bins = importance.query.options.direction_bins
    bin_width = 2 * np.pi / bins
    spread = int(np.ceil(importance.query.options.direction_width / bin_width))
    around = np.arange(-spread, spread + 1)
    fall = np.float32(bin_width / importance.query.options.direction_width)
    # Padded, so that the directions around one are neighbours in memory; the pads are folded back at the end.
    padded = bins + 2 * spread
    total = np.zeros(len(free) * padded, dtype=np.float32)
    best = np.zeros_like(total)
    for weight, accuracy, kernel, towards in _level_sets(importance, fields, free):
        drawn = kernel > LEAST_KERNEL * accuracy[:, None]
        touched = []
        for pair in range(len(kernel)):
            # In one pair's level set a cell occurs once, so that plain indexing finds the maximum over the pairs.
            cell = np.flatnonzero(drawn[pair])
            exact = towards[pair, cell] / np.float32(bin_width)
            middle = np.rint(exact)
            key = (cell * padded + middle.astype(np.intp) % bins)[:, None] + (around + spread)
            value = 1 - fall * np.abs(around.astype(np.float32) - (exact - middle)[:, None])
            value = np.maximum(0, value) * (kernel[pair, cell] * np.float32(weight))[:, None]
            best[key] = np.maximum(best[key], value)
            touched.append(key.ravel())
        keys = np.concatenate(touched)
        # Cells that occur in several pairs are written several times with the same sum.
        total[keys] += best[keys]
        best[keys] = 0
    volume = total.reshape(len(free), padded)
    volume[:, bins : bins + spread] += volume[:, :spread]
    volume[:, spread : 2 * spread] += volume[:, bins + spread :]
    return volume[:, spread : bins + spread] / np.float32(importance.query.total)


#: Level sets are drawn into pose space where their kernel is above this: the narrow part, without its wide foot.
LEAST_KERNEL = WIDE_SHARE * (1 - 1 / WIDE_WIDTH)

#: Maxima of pose space below this share of the greatest are left out.
LEAST_MAXIMUM = 0.3


def _in_pose_space(importance: Importance, fields: Fields, free: Indices) -> Candidates:
    from scipy.ndimage import maximum_filter

    volume = accumulate_in_pose_space(importance, fields, free)
    grid, bins = fields.grid, volume.shape[1]
    # A maximum is one among its directions and its neighbours' best; directions are cyclic.
    own = maximum_filter(volume, size=(1, 5), mode="wrap")
    cell, b = np.nonzero((volume == own) & (volume > LEAST_MAXIMUM * volume.max(initial=0.0)))
    strength = volume[cell, b]
    order = np.argsort(-strength, kind="stable")
    radius = max(1.0, 2 * importance.width / grid.spacing)
    row, column = np.divmod(free[cell], grid.columns)
    kept: list[int] = []
    for i in order:
        if len(kept) >= 4 * MAXIMA:
            break
        ks = np.array(kept, dtype=np.intp)
        turn = np.abs((b[ks] - b[i] + bins // 2) % bins - bins // 2)
        near = (np.abs(row[ks] - row[i]) <= radius) & (np.abs(column[ks] - column[i]) <= radius) & (turn <= 3)
        if not near.any():
            kept.append(int(i))
    chosen = np.array(kept, dtype=np.intp)
    place = grid.points[free[cell[chosen]]]
    return Candidates(place, 2 * np.pi * b[chosen] / bins, strength[chosen].astype(np.float64))
