"""Contour descriptors of appendix A: shape contexts that hold distance and mean tangent per bin.

A descriptor's scale is the walk along the line, centred on the sample, that turns by a fixed angle in all (left and
right add up); its orientation is the tangent. Tangents have no sign, so bins average doubled angles: the average of u
and -u is u, and two averages are compared by their difference, 0 for parallel lines and 2 for perpendicular ones.
"""

from dataclasses import dataclass
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from ..geometry.contours import Contours, Floats, Indices
from ..geometry.drawing import Drawing
from ..tolerances import MOST_SAMPLES, SAMPLE_SPACING, SAMPLE_TURN

#: Total turns, in radians, whose walks set the scale: a corner or two, and once round a convex shape.
TURNS = (0.75 * np.pi, 1.75 * np.pi)
#: Radius of a descriptor in lengths of the walk: once round a disc of diameter d is 3.1 d, and its radius then d.
RADIUS = 0.32
#: Rings and sectors of bins; the sectors are a multiple of 4, so that half turns and reflections permute bins.
RINGS, SECTORS = 4, 12
#: Width of the band round the lines in radii (d_max of appendix A).
BAND = 0.3
#: Fewest samples of a line.
LEAST_SAMPLES = 16
#: Points of the lines that a bin looks at, and their spacing in radii.
NEIGHBOURS, GRAIN = 6, 0.08


@dataclass(frozen=True)
class Descriptors:
    """Descriptors at one turn.

    Attributes
    ----------
    index : (n,) int
        Points of the contours they stand on.
    walk : (n,) float
        Arc length of the walk: the scale.
    near : (n, RINGS * SECTORS) float32
        1 - distance / (BAND radius) of each bin's centre to the lines, at least 0.
    tangent : (n, RINGS * SECTORS) complex64
        Average of exp(2i angle) over the lines in the band, relative to the descriptor's orientation.
    """

    index: Indices
    walk: Floats
    near: NDArray[np.float32]
    tangent: NDArray[np.complex64]


#: Descriptors of all samples of a drawing, one entry per turn; gone with the drawing.
_kept: WeakKeyDictionary[Drawing, list[Descriptors]] = WeakKeyDictionary()


def descriptors_of(drawing: Drawing) -> list[Descriptors]:
    """The descriptors of a drawing, one entry per turn; computed once and kept as long as the drawing.

    Parameters
    ----------
    drawing : Drawing

    Returns
    -------
    list[Descriptors]
    """
    if drawing not in _kept:
        contours = drawing.contours
        every = np.ones(len(contours.points), bool)
        _kept[drawing] = [describe(contours, samples_of(contours), turn, every) for turn in TURNS]
    return _kept[drawing]


def samples_of(contours: Contours) -> Indices:
    """Where the descriptors stand: denser where a line turns, at most about MOST_SAMPLES.

    Parameters
    ----------
    contours : Contours

    Returns
    -------
    ndarray of int
    """
    spacing, turn = SAMPLE_SPACING, SAMPLE_TURN
    index = contours.samples(spacing, turn, LEAST_SAMPLES)
    while len(index) > MOST_SAMPLES and turn < np.pi:
        grow = len(index) / MOST_SAMPLES
        spacing, turn = spacing * grow, turn * grow
        index = contours.samples(spacing, turn, max(4, int(LEAST_SAMPLES / grow)))
    return index[:: int(np.ceil(len(index) / (1.2 * MOST_SAMPLES)))]


def walks(contours: Contours, index: Indices, turn: float) -> Floats:
    """Arc length of the walk, centred on each point, that turns by a given angle in all; nan where no walk does.

    Parameters
    ----------
    contours : Contours
    index : (n,) int
        Points.
    turn : float
        Radians.

    Returns
    -------
    Floats
    """
    out = np.full(len(index), np.nan)
    for k in np.unique(contours.line[index]):
        s = contours.slice_of(int(k))
        here = contours.line[index] == k
        at, n = index[here] - s.start, s.stop - s.start
        total = np.concatenate([[0.0], np.cumsum(contours.turning[s])])
        closed = contours.closed[k]

        def turned(i: Indices, total: Floats = total, closed: bool = bool(closed), n: int = n) -> Floats:
            return total[i % n] + (i // n) * total[-1] if closed else total[np.clip(i, 0, n)]

        low, high = np.zeros(len(at), int), np.full(len(at), n // 2 if closed else n)
        reached = turned(at + high + 1) - turned(at - high) >= turn
        for _ in range(int(np.ceil(np.log2(n))) + 1):
            middle = (low + high) // 2
            enough = turned(at + middle + 1) - turned(at - middle) >= turn
            low, high = np.where(enough, low, middle + 1), np.where(enough, middle, high)
        half = np.minimum(high, n)
        ends = (at + half, at - half) if closed else (np.minimum(at + half, n - 1), np.maximum(at - half, 0))
        length = np.maximum(ends[0] - ends[1], 2) * contours.spacing[k]
        out[here] = np.where(reached, length, np.nan)
    return out


def describe(contours: Contours, index: Indices, turn: float, visible: NDArray[np.bool_]) -> Descriptors:
    """Descriptors at points of the contours.

    Parameters
    ----------
    contours : Contours
    index : (n,) int
        Points; those without a walk of the turn get no descriptor.
    turn : float
        Total turn that sets the scale, radians.
    visible : (len(contours.points),) bool
        Which points of the lines the bins see: a query sees its own lines only.

    Returns
    -------
    Descriptors
    """
    walk = walks(contours, index, turn)
    index, walk = index[np.isfinite(walk)], walk[np.isfinite(walk)]
    radius = RADIUS * walk
    ring = (np.arange(RINGS) + 1.0) / RINGS
    bins = (ring[:, None] * np.exp(2j * np.pi * np.arange(SECTORS) / SECTORS)).ravel()
    near = np.zeros((len(index), len(bins)), np.float32)
    tangent = np.zeros((len(index), len(bins)), np.complex64)
    octave = np.floor(np.log2(radius)).astype(int)
    for o in np.unique(octave):
        some = np.flatnonzero(octave == o)
        stride = np.maximum(1, np.round(GRAIN * 2.0**o / contours.spacing)).astype(int)
        place = np.arange(len(contours.points)) - contours.first[contours.line]
        seen = np.flatnonzero(visible & (place % stride[contours.line] == 0))
        if not len(seen):
            continue
        p = contours.points[seen]
        tree = cKDTree(np.stack([p.real, p.imag], 1))
        r, way = radius[some, None], np.exp(1j * contours.heading[index[some]])[:, None]
        centre = contours.points[index[some]][:, None] + r * way * bins
        gap, which = tree.query(
            np.stack([centre.real, centre.imag], -1), NEIGHBOURS, distance_upper_bound=BAND * 2.0 ** (o + 1)
        )
        weight = np.maximum(0.0, 1.0 - gap / (BAND * r[:, :, None]))
        double = np.append(np.exp(2j * contours.heading[seen]), 0.0)[which]
        near[some] = weight[:, :, 0]
        tangent[some] = (weight * double).sum(2) / np.maximum(weight.sum(2), 1e-9) / way**2
    return Descriptors(index, walk, near, tangent)


def confidences(query: Descriptors, target: Descriptors, half_turn: bool, mirrored: bool) -> NDArray[np.float32]:
    """Matching confidence f_ij of appendix A of all pairs, (n, m), as two matrix products.

    Parameters
    ----------
    query, target : Descriptors
        Of the same turn.
    half_turn : bool
        Whether the target is taken the other way round: a tangent has no sign, both orientations are tested.
    mirrored : bool
        Whether the target is reflected across its tangent.

    Returns
    -------
    NDndarray[np.float32]

    Notes
    -----
    f_ij = sum d_i d_j (1 - |g_i - g_j|^2 / 2) / sum d_i d_j, with the doubled angles in g the second factor is 1 for
    parallel and -1 for perpendicular lines. It is taken times the square root of sum d_i d_j / sum d_i^2, at most 1:
    the share of the query's own bins that are matched. Without it a descriptor that shares a single bin with the
    query is perfect. Unmatched bins of the target, which clutter makes, cost nothing.
    """
    k = np.arange(RINGS * SECTORS).reshape(RINGS, SECTORS)
    if mirrored:
        k = k[:, (-np.arange(SECTORS)) % SECTORS]
    if half_turn:
        k = np.roll(k, -SECTORS // 2, axis=1)
    order = k.ravel()
    dj, gj = target.near[:, order], target.tangent[:, order]
    if mirrored:
        gj = np.conj(gj)
    di, gi = query.near, query.tangent
    shared = di @ dj.T
    left = np.concatenate([di * (1.0 - 0.5 * np.abs(gi) ** 2), -0.5 * di, di * gi.real, di * gi.imag], 1)
    right = np.concatenate([dj, dj * np.abs(gj) ** 2, dj * gj.real, dj * gj.imag], 1)
    alike = left @ right.T
    own = np.maximum((di**2).sum(1, keepdims=True), 1e-6)
    out = alike / np.maximum(shared, 1e-6) * np.sqrt(np.minimum(1.0, shared / own))
    return np.maximum(out, 0.0).astype(np.float32)
