"""Candidate poses: maxima of the accumulated level sets on a grid (section 4.5).

Three ways to accumulate, by the option of that name. All three only *find* places; what a place is worth is
`importance`, evaluated exactly.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..relations.elements import ElementType
from ..relations.table import Kind, Positional
from .fields import FAR, Fields
from .importance import Importance
from .kernels import WIDE_SHARE, WIDE_WIDTH, level_set, wrap
from .matching import Answers

Array = NDArray[np.float64]
Array32 = NDArray[np.float32]
Indices = NDArray[np.intp]

#: Least distance between neighbouring candidate places of a footprint (the next whole step of the grid), and
#: half-width of the level sets they are found with, in half-widths of the exact ones: coarse enough to be cheap, so
#: wide that every exact maximum has a candidate on its slope.
FOOTPRINT_STEP = 1.2
FOOTPRINT_WIDTH = 3.0

#: How deep inside an obstacle a sample at a candidate place may be, in the same unit: its maximum is up to a step away.
FOOTPRINT_SLACK = 1.5

#: Pairs of features that can contribute less than this share of the strongest one are left out where places are only
#: looked for.
STRONG = 0.15

#: Values held at once while level sets are accumulated: 16 MB an array.
MOST_VALUES = 4 << 20

#: Most directions a footprint is tried in.
MOST_DIRECTIONS = 24

#: Candidates of a footprint whose wide importance is below this share of the best one's are not refined.
WORTH_REFINING = 0.45

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
    """

    position: Array
    angle: Array


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
    if importance.query.rigid:
        return _of_footprint(importance, fields, blocked, taken)
    free = np.flatnonzero(~blocked & ~taken)
    in_space = importance.query.options.accumulation == "pose space"
    found = (_in_pose_space if in_space else _in_plane)(importance, fields, free)
    upright = importance.query.is_upright(found.angle, importance.mirrored)
    return Candidates(found.position[upright], found.angle[upright])


# ------------------------------------------------------------------------------------------------ footprint


def _of_footprint(
    importance: Importance, fields: Fields, blocked: NDArray[np.bool_], taken: NDArray[np.bool_]
) -> Candidates:
    """Accumulate for all samples of the footprint, moved rigidly, in the few directions that the features suggest."""
    grid = fields.grid
    stride = max(1, math.ceil(FOOTPRINT_STEP * importance.width / grid.spacing))
    importance = importance.of_strongest(STRONG)
    rows, columns = np.arange(0, grid.rows, stride), np.arange(0, grid.columns, stride)
    position, angle, strength = [], [], []
    for direction in directions(importance):
        c, s = np.cos(direction), np.sin(direction)
        steps = grid.steps(importance.samples @ np.array([[c, s], [-s, c]]))
        row = rows[(rows + steps[:, 1].min() >= 0) & (rows + steps[:, 1].max() < grid.rows)]
        column = columns[(columns + steps[:, 0].min() >= 0) & (columns + steps[:, 0].max() < grid.columns)]
        if not len(row) or not len(column):
            continue
        cells = (row[:, None] * grid.columns + column).ravel()
        offsets = steps[:, 1] * grid.columns + steps[:, 0]
        free = cells[~taken[cells] & ~blocked[cells[:, None] + offsets].any(axis=1)]
        if not len(free):
            continue
        score = _accumulate(importance, fields, free, offsets, direction)
        sheet = np.full(len(grid), -1.0, dtype=np.float32)
        sheet[free] = score
        sheet = sheet.reshape(grid.rows, grid.columns)[np.ix_(rows, columns)]
        best = _maxima(sheet, 1)[: max(MAXIMA, importance.query.options.candidates)]
        r, k = np.divmod(best, len(columns))
        position.append(grid.points[rows[r] * grid.columns + columns[k]])
        angle.append(np.full(len(best), direction))
        strength.append(sheet.ravel()[best])
    found = np.concatenate(strength) if strength else np.zeros(0, dtype=np.float32)
    if not len(found):
        return Candidates(np.zeros((0, 2)), np.zeros(0))
    order = np.argsort(-found, kind="stable")[: 2 * max(MAXIMA, importance.query.options.candidates)]
    order = order[found[order] >= WORTH_REFINING * found[order[0]]]
    return Candidates(np.concatenate(position)[order], np.concatenate(angle)[order])


def _accumulate(
    importance: Importance,
    fields: Fields,
    cells: Indices,
    offsets: Indices,
    direction: float,
) -> Array32:
    """The importance of grid cells for one direction, with wide level sets; shape (cells,)."""
    total = np.zeros(len(cells), dtype=np.float32)
    width = np.float32(FOOTPRINT_WIDTH * importance.width)
    # Where each sample of the footprint is.
    places = cells + offsets[:, None]
    parts = ((e, part) for e, a in importance.answers.items() for part in a.blocks(MOST_VALUES // len(cells) + 1))
    for element, a in parts:
        entries = np.zeros((len(a.target), len(cells)), dtype=np.float32)
        for k, relation in enumerate(a.relations):
            chosen, aligned = _aligned(importance, fields, element, relation, a, k, places, direction)
            away = _away(relation, a, k, importance, fields, chosen, places[a.sample[chosen]])
            away *= -1 / width
            away += 1
            weight = np.maximum(away, 0, out=away)
            weight *= a.weight[k, chosen, None].astype(np.float32)
            if aligned is not None:
                weight *= aligned
            entries[chosen] += weight
        pairs = np.add.reduceat(entries, a.pair_start, axis=0)
        pairs *= a.accuracy[:, None].astype(np.float32)
        total += np.maximum.reduceat(pairs, a.feature_start, axis=0).sum(axis=0)
    return total


def _aligned(
    importance: Importance,
    fields: Fields,
    element: ElementType,
    relation: Positional,
    a: Answers,
    k: int,
    places: Indices,
    direction: float,
) -> tuple[Indices, Array32 | None]:
    """The entries whose directional level sets have a direction somewhere, and their kernels there.

    The places of a footprint's samples tell directions from corners better.
    """
    every = np.arange(len(a.target))
    if element is ElementType.CORNER:
        return every, None
    tolerance = importance.query.options.direction_width
    heading = importance.target.elements.heading(element)
    if heading is not None:  # the same everywhere
        kernel = 1 - np.abs(wrap(direction - heading[a.target] - a.turn[k])) / tolerance
        chosen = np.flatnonzero(kernel > 0)
        return chosen, kernel[chosen, None].astype(np.float32)
    miss = fields.direction(relation, a.target, places[a.sample])
    miss = wrap(np.float32(direction) - miss - a.turn[k][:, None].astype(np.float32))
    aligned = np.maximum(0, 1 - np.abs(miss) / np.float32(tolerance))
    chosen = np.flatnonzero(aligned.any(axis=1))
    return chosen, aligned[chosen]


def _away(
    relation: Positional, a: Answers, k: int, importance: Importance, fields: Fields, chosen: Indices, where: Indices
) -> Array32:
    """Distance in the plane from the level sets of some entries at grid points; shape (chosen, points)."""
    target = a.target[chosen]
    value = a.value[k, chosen] * (importance.scale if relation.kind is Kind.LENGTH else 1.0)
    miss = fields.value(relation, target, where) - value[:, None].astype(np.float32)
    if relation.period is not None:
        period = relation.period(importance.target.elements)[target][:, None].astype(np.float32)
        cyclic = np.isfinite(period[:, 0])
        miss[cyclic] = wrap(miss[cyclic], period[cyclic])
    miss = np.abs(miss)
    if relation.kind is not Kind.LENGTH:
        miss *= np.minimum(fields.reach(relation, target, where), np.float32(FAR / 100))
    return miss


def directions(importance: Importance) -> list[float]:
    """The directions a footprint may take: along the features that answer, as the example is along its own.

    Parameters
    ----------
    importance : Importance

    Returns
    -------
    list of float
        Radians; strongest first, at least most of the directional kernel's width apart.
    """
    suggested, weight = [], []
    for element, a in importance.answers.items():
        if element is not ElementType.SEGMENT:
            continue
        e = importance.target.elements
        heading = np.arctan2(e.edge_vector[:, 1], e.edge_vector[:, 0])
        pair_of = np.repeat(np.arange(len(a.pair_start)), np.diff(np.append(a.pair_start, len(a.target))))
        strength = a.weight.sum(axis=0) * a.accuracy[pair_of]
        for edge, length in enumerate(e.edge_length):
            mine = a.target == e.edge_segment[edge]
            suggested.append((heading[edge] + a.turn[0, mine]) % (2 * np.pi))
            weight.append(strength[mine] * length / e.segment_length[e.edge_segment[edge]])
    if not suggested:
        base = importance.target.parent.main_orientation - importance.query.arrangement.parent.main_orientation
        quarters = base + importance.query.pose.angle + np.arange(4) * np.pi / 2
        return [float(q) for q in quarters[importance.query.is_upright(quarters, importance.mirrored)]]
    angle, strength = np.concatenate(suggested), np.concatenate(weight)
    upright = importance.query.is_upright(angle, importance.mirrored)
    angle, strength = angle[upright], strength[upright]
    apart = 0.9 * importance.query.options.direction_width
    result: list[float] = []
    left = strength.copy()
    while len(result) < MOST_DIRECTIONS and left.max(initial=0.0) > 0:
        order = np.flatnonzero(left > 0)
        # The angle that gathers most around it, then the mean of what it gathers.
        lead = order[np.argsort(-left[order], kind="stable")][:64]
        near = np.abs(wrap(angle[lead][:, None] - angle)) < apart
        best = near[np.argmax((near * left).sum(axis=1))]
        first = angle[np.flatnonzero(best)[0]]
        mean = first + np.average(wrap(angle[best] - first), weights=np.maximum(left[best], 1e-12))
        if result and (left * best).sum() < 0.02 * strength.sum():
            break
        result.append(float(mean % (2 * np.pi)))
        left[best] = 0.0
    return result


# ------------------------------------------------------------------------------------------------ plane


def _level_sets(importance: Importance, fields: Fields, free: Indices):  # type: ignore[no-untyped-def]
    """The level sets of every relation and pair at free grid points: kernel times I_m, and the direction wanted there.

    Yields per source feature and relation its weight I_l, the accuracies I_m (pairs,), the kernels (pairs, points) and
    the directions (pairs, points).
    """
    width = np.float32(importance.width)
    for a in importance.answers.values():
        for start, end in zip(a.feature_start, np.append(a.feature_start[1:], len(a.accuracy)), strict=True):
            entry = a.pair_start[start:end]  # one sample: an entry is a pair
            for k, relation in enumerate(a.relations):
                away = _away(relation, a, k, importance, fields, entry, free)
                away /= width
                kernel = level_set(away)
                accuracy = a.accuracy[start:end].astype(np.float32)
                kernel *= accuracy[:, None]
                towards = fields.direction(relation, a.target[entry], free)
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
    return Candidates(grid.points[cell], np.append(strongest[place[best]], direction).astype(np.float64))


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
    return Candidates(grid.points[free[cell[chosen]]], 2 * np.pi * b[chosen] / bins)
