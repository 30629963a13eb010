"""Rows, columns and rhythm: what people place by the dozen stands in lines at regular distances."""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from .boxes import interval_overlap

Array = NDArray[np.float64]

#: Distance of their middles, in sizes, within which two boxes stand in one row.
SAME_ROW = 0.35
#: Steps of a rhythm that may lie between two neighbouring rows.
MOST_MISSED = 5
#: Least step, in sizes: neighbours do not overlap.
LEAST_STEP = 1.1
#: Distance from its beat, in sizes, up to which a row keeps the rhythm.
OFF_BEAT = 0.3
#: Difference of two steps, as a share, below which they are one.
SAME_STEP = 0.04
#: Steps, in sizes, at which things usually stand in line; the trust in others falls off with their logarithm.
USUAL_STEP, STEP_SPREAD = 1.9, 0.45
#: Trust below which a rhythm is not followed.
LEAST_TRUST = 0.1
#: Extents that a rhythm may have: a parent of a thousand steps is no facade.
MOST_BEATS = 60


def rows_of(extents_along: Array) -> Array:
    """Mean extents of rows: neighbours whose middles are nearer than a part of their size are one; ascending.

    Parameters
    ----------
    extents_along : ndarray of shape (n, 2)

    Returns
    -------
    ndarray of shape (r, 2)
    """
    if not len(extents_along):
        return extents_along
    middle = extents_along.mean(axis=1)
    order = np.argsort(middle, kind="stable")
    limit = SAME_ROW * (extents_along[:, 1] - extents_along[:, 0]).mean()
    number = np.concatenate([[0], np.cumsum(np.diff(middle[order]) > limit)])
    count = np.bincount(number)[:, None]
    return np.stack([np.bincount(number, column) for column in extents_along[order].T], axis=1) / count


def rhythm(extents_along: Array) -> Array:
    """Where rows (or columns) go on: the steps between neighbouring rows repeated outwards, halved and thirded.

    A facade shows ten windows of three of its six floors; the floors between and above them are where the others are.

    Parameters
    ----------
    extents_along : ndarray of shape (n, 2)
        Low and high edges of examples along one axis.

    Returns
    -------
    ndarray of shape (m, 2)
        Extents of rows that no example stands in.
    """
    rows = rows_of(extents_along)
    if len(rows) < 2:
        return np.zeros((0, 2))
    middle, size = rows.mean(axis=1), rows[:, 1] - rows[:, 0]
    steps = np.diff(middle)
    found = []
    for i, step in enumerate(steps):
        parts = [n for n in (2, 3) if step / n > min(size[i], size[i + 1])]
        for n in parts:
            found += [(middle[i] + step * j / n, size[i] if 2 * j <= n else size[i + 1]) for j in range(1, n)]
        for part in [step, *(step / n for n in parts)]:
            found += [(middle[0] - part, size[0]), (middle[-1] + part, size[-1])]
    at, of = np.array(found).T
    free = (np.abs(at[:, None] - middle[None]) > SAME_ROW * of[:, None]).all(axis=1)
    return np.stack([at - of / 2, at + of / 2], axis=1)[free]


def beats(extents_along: Array, low: float, high: float) -> tuple[Array, Array]:
    """Where the rows of examples would be if all rows stood at one distance, for every distance that may be meant.

    Parameters
    ----------
    extents_along : ndarray of shape (n, 2)
        Low and high edges of examples along one axis.
    low, high : float
        Extent of the parent.

    Returns
    -------
    extents : ndarray of shape (m, 2)
        Within the parent, rows of examples included.
    trust : ndarray of shape (m,)
        In the rhythm each belongs to, 0 to 1: the share of rows that keep it, times the share of its beats between the
        outermost rows that are rows, times how usual its step is.
    """
    return _beats(tuple((float(a), float(b)) for a, b in extents_along), float(low), float(high))


#: Sets of rows whose beats are remembered: every look at an arrangement asks for those of its examples again.
BEATS_KEPT = 64


@lru_cache(maxsize=BEATS_KEPT)
def _beats(extents_along: tuple[tuple[float, float], ...], low: float, high: float) -> tuple[Array, Array]:
    """`beats` of extents as numbers; the arrays are shared by all who ask."""
    rows = rows_of(np.array(extents_along, dtype=np.float64).reshape(-1, 2))
    nothing = np.zeros((0, 2)), np.zeros(0)
    if len(rows) < 2:
        return nothing
    middle, size = rows.mean(axis=1), float((rows[:, 1] - rows[:, 0]).mean())
    apart = (middle[None] - middle[:, None])[np.triu_indices(len(middle), 1)]
    steps = np.sort((apart[:, None] / np.arange(1, MOST_MISSED + 1)).ravel())
    steps = steps[steps >= LEAST_STEP * size]
    found, trusts = [], []
    done: list[float] = []
    for step in steps:
        if any(abs(step - other) <= SAME_STEP * other for other in done):
            continue
        number = np.round((middle[None] - middle[:, None]) / step)
        off = np.abs(middle[None] - middle[:, None] - number * step)
        keeps = off <= OFF_BEAT * size
        first = int(np.argmax(keeps.sum(axis=1)))
        own, number = keeps[first], number[first]
        if len(np.unique(number[own])) < 2:
            continue
        fitted, start = np.polyfit(number[own], middle[own], 1)
        done += [float(step), float(fitted)]
        whole = number[own].max() - number[own].min() + 1
        usual = np.exp(-0.5 * (np.log(fitted / size / USUAL_STEP) / STEP_SPREAD) ** 2)
        trust = own.mean() * len(np.unique(number[own])) / whole * usual
        if trust < LEAST_TRUST:
            continue
        count = np.arange(np.ceil((low - start + size / 4) / fitted), np.floor((high - start - size / 4) / fitted) + 1)
        if len(count) > MOST_BEATS:
            continue
        at = start + fitted * count
        found.append(np.stack([at - size / 2, at + size / 2], axis=1))
        trusts.append(np.full(len(at), trust))
    return (np.concatenate(found), np.concatenate(trusts)) if found else nothing


def on_beat(boxes: Array, axis: int, extents: Array, trust: Array) -> Array:
    """How well boxes keep a trusted rhythm along an axis, shape (n,), 0 to 1.

    Parameters
    ----------
    boxes : ndarray of shape (n, 4)
    axis : int
    extents : ndarray of shape (m, 2)
    trust : ndarray of shape (m,)
        See `beats`.

    Returns
    -------
    ndarray
    """
    if not len(extents):
        return np.zeros(len(boxes))
    return (interval_overlap(boxes, np.repeat(extents, 2, axis=1), axis) * trust).max(axis=1)


def mirrored_extents(extents_along: Array, low: float, high: float) -> Array:
    """Extents reflected about the parent's middle: facades are symmetrical more often than not.

    Parameters
    ----------
    extents_along : ndarray of shape (n, 2)
    low, high : float
        Extent of the parent.

    Returns
    -------
    ndarray of shape (n, 2)
    """
    return low + high - extents_along[:, ::-1]


#: Width of the Gaussian of distances, in sizes, at which boxes stand in line.
IN_LINE = 0.12
#: How much of an arrangement is in line with one element, in the same width.
ABREAST_WIDTH = 2.5
#: Elements that are longer, in sizes, stand in no line: they run across it.
LARGEST_IN_LINE = 3.0


def alignment(boxes: Array, present: Array, drawn: dict[str, Array], axis: int) -> tuple[Array, Array]:
    """How well boxes stand in line with elements as examples do, wherever in the arrangement these are.

    Of each label counts by how much more of the examples stand in line with an element of it than chance would put
    there.

    Parameters
    ----------
    boxes : ndarray of shape (n, 4)
    present : ndarray of shape (m, 4)
        Positive examples drawn here.
    drawn : dict of str to ndarray of shape (e, 4)
        Elements by label.
    axis : int
        Along which positions are compared: 0 for columns, 1 for rows.

    Returns
    -------
    aligned, missed : ndarray of shape (n,)
        With the label that says most, and without the one that is missed most; 0 to 1.
    """
    aligned, missed = np.zeros(len(boxes)), np.zeros(len(boxes))
    if not len(present):
        return aligned, missed
    # Rows of examples rather than examples: one row is one observation.
    lines = np.repeat(rows_of(present[:, [axis, axis + 2]]), 2, axis=1)
    size = float((present[:, axis + 2] - present[:, axis]).mean())
    reach = float(np.ptp(np.concatenate([lines[:, [0, 2]].ravel(), *(e[:, axis] for e in drawn.values())])))
    wide = ABREAST_WIDTH * IN_LINE * size
    for elements in drawn.values():
        similar = elements[(elements[:, axis + 2] - elements[:, axis]) <= LARGEST_IN_LINE * size]
        if not len(similar):
            continue
        surest, line = 0.0, np.zeros(len(boxes))
        for share in (0.5, 0.0, 1.0):
            at = np.sort(_at(similar, axis, share))
            covered = wide + float(np.minimum(np.diff(at), wide).sum())
            chance = min(1.0, covered / max(reach, size))
            seen = (_near(_at(lines, axis, share), at, size).sum() + chance) / (len(lines) + 1)
            sure = max(float(seen) - chance, 0.0)
            if sure > surest:
                surest, line = sure, _near(_at(boxes, axis, share), at, size)
        aligned = np.maximum(aligned, surest * line)
        missed = np.maximum(missed, surest * (1 - line))
    return aligned, missed


def _at(boxes: Array, axis: int, share: float) -> Array:
    """A position on each box along an axis: its low edge, its middle or its high edge."""
    return boxes[:, axis] * (1 - share) + boxes[:, axis + 2] * share


def _near(values: Array, places: Array, size: float) -> Array:
    """How near each value is to the nearest of sorted places, 0 to 1."""
    after = np.minimum(np.searchsorted(places, values), len(places) - 1)
    off = np.minimum(np.abs(values - places[after]), np.abs(values - places[np.maximum(after - 1, 0)]))
    return np.exp(-0.5 * (off / (IN_LINE * size)) ** 2)
