"""Refined correspondences (section 3.4): modes of the noisy ones near each query point."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.distance import cdist

from ..geometry.contours import Complex, Floats, Indices
from ..progress import Stepper
from .correspondences import Correspondences

#: Normalisation of the transformation space: a translation by a tenth of the query (at the target's scale) is as much
#: as scaling by 1.25 or turning by 45 degrees. The thesis takes 0.03 of the drawing's diagonal, which says the same
#: where a query takes up a third of the drawing, but not in a larger one.
TRANSLATION, SCALE, ROTATION = 0.1, np.log(1.25), np.pi / 4
#: Noisy correspondences that a query point listens to at most, heaviest first.
MOST_NEAR = 250
#: Pairs of query points and noisy correspondences that are weighed at once.
MOST_AT_ONCE = 400_000
#: Modes of a query point at most, and their least magnitude beside the greatest of all.
MOST_MODES, LEAST_MAGNITUDE = 40, 0.01
#: Distances in the transformation space between the points from which mean shift starts, and below which two modes
#: are one.
SEED_GAP, MERGED_GAP = 1.5, 0.7
#: Steps of the mean shift.
SHIFTS = 3


@dataclass(frozen=True)
class Refined:
    """Refined correspondences (q, tau).

    Attributes
    ----------
    node : (n,) int
        Query point.
    image : (n,) complex
        Where it goes; conjugated where mirrored.
    factor : (n,) complex
        Scale and rotation.
    mirrored : (n,) bool
    magnitude : (n,) float
        Magnitude h of the mode, 1 for the greatest.
    """

    node: NDArray[np.intp]
    image: Complex
    factor: Complex
    mirrored: NDArray[np.bool_]
    magnitude: Floats

    def __len__(self) -> int:
        return len(self.node)

    def chosen(self, which: NDArray) -> "Refined":
        """Some of them, by mask or by index."""
        return Refined(
            self.node[which], self.image[which], self.factor[which], self.mirrored[which], self.magnitude[which]
        )

    def distances(self, image: Complex, factor: Complex, size: float) -> Floats:
        """Distance in the normalised transformation space to one other transformation of each query point, (n,)."""
        unit = TRANSLATION * size * np.sqrt(np.abs(self.factor * factor))
        ratio = np.log(factor / self.factor)
        move = np.abs(image - self.image) / unit
        return np.sqrt(move**2 + (ratio.real / SCALE) ** 2 + (ratio.imag / ROTATION) ** 2)


def refine(points: Complex, noisy: Correspondences, size: float, radius: float) -> Stepper[Refined]:
    """Find the dominant modes at each query point (algorithm 3.2).

    Parameters
    ----------
    points : (m,) complex
        Query points.
    noisy : Correspondences
        The set C.
    size : float
        Extent of the query.
    radius : float
        r_s of eq. 3.3, as a length.

    Returns
    -------
    Refined
        The set C' without modes of less than a hundredth of the greatest magnitude (section 3.6).
    """
    parts: list[tuple[NDArray, Complex, Complex, NDArray, Floats]] = []
    places, back = np.unique(noisy.source, return_inverse=True)
    back = back.ravel()
    if len(noisy):
        pairs = np.stack([places.real, places.imag], 1)
        density = np.exp(-0.5 * (cdist(pairs, pairs) / radius) ** 2) @ np.bincount(back)
        share = noisy.confidence / density[back]
    for flip in (False, True):
        own = np.flatnonzero(noisy.mirrored == flip)
        if not len(own):
            continue
        c, rows = noisy.chosen(own), np.arange(len(points))
        for some in np.array_split(rows, 1 + len(rows) * len(own) // MOST_AT_ONCE):
            q = points[some][:, None]
            weight = np.exp(-0.5 * (np.abs(places - q) / radius) ** 2)[:, back[own]] * share[own]
            near = np.argsort(-weight, axis=1, kind="stable")[:, :MOST_NEAR]
            weight = np.take_along_axis(weight, near, 1)
            weight[weight < 0.01 * weight[:, :1]] = 0.0
            node, image, factor, magnitude = modes(
                c.image[near] + c.factor[near] * (q - c.source[near]), c.factor[near], weight, size
            )
            parts.append((some[node], image, factor, np.full(len(node), flip), magnitude))
            yield (some[-1] + 1) / len(points) * 0.5 + 0.5 * flip, "refining correspondences"
    if not parts:
        none = np.zeros(0, complex)
        return Refined(np.zeros(0, np.intp), none, none, np.zeros(0, bool), np.zeros(0))
    node, image, factor, mirrored, magnitude = (np.concatenate(p) for p in zip(*parts, strict=True))
    magnitude = magnitude / magnitude.max()
    good = magnitude >= LEAST_MAGNITUDE
    return Refined(node[good], image[good], factor[good], mirrored[good], magnitude[good])


def modes(image: Complex, factor: Complex, weight: Floats, size: float) -> tuple[Indices, Complex, Complex, Floats]:
    """Dominant modes of weighted similarities by mean shift with a kernel of radius one, for several query points.

    Parameters
    ----------
    image : (m, n) complex
        Where each similarity takes its query point.
    factor : (m, n) complex
    weight : (m, n) float
        Descending along each row; 0 for those that do not count.
    size : float
        Extent of the query.

    Returns
    -------
    row : (k,) int
        Query point of each mode.
    image, factor : (k,) complex
    magnitude : (k,) float
        Density at the modes, descending for each query point.

    Notes
    -----
    Mean shift starts from the heaviest correspondences that are farther than SEED_GAP from each other; from the ones
    between them it would end in the same modes.
    """
    space = np.stack([image.real, image.imag, np.log(np.abs(factor)) / SCALE, *_direction(factor)], 1)
    space, weight = space.astype(np.float32), weight.astype(np.float32)
    rows = np.arange(len(space))
    alive = weight > 0.0
    seeds: list[Indices] = []
    used: list[NDArray[np.bool_]] = []
    while len(seeds) < MOST_MODES and alive.any():
        first = alive.argmax(1)  # the heaviest that is left
        seeds.append(first)
        used.append(alive[rows, first])
        one = space[rows, :, first][:, :, None]
        alive &= _squares(one, _unit(one, size), space)[:, 0] > SEED_GAP**2
    some = np.stack(seeds, 1)
    at = np.take_along_axis(space, some[:, None], 2)
    for _ in range(SHIFTS):
        pull = np.exp(-0.5 * _squares(at, _unit(at, size), space)) * weight[:, None]
        at = (pull @ space.transpose(0, 2, 1) / pull.sum(2, keepdims=True)).transpose(0, 2, 1)
        at[:, 3:] /= np.hypot(at[:, 3], at[:, 4])[:, None] * np.float32(ROTATION)
    unit = _unit(at, size)
    magnitude = (np.exp(-0.5 * _squares(at, unit, space)) @ weight[:, :, None])[:, :, 0]
    magnitude[~np.stack(used, 1)] = -1.0
    close = _squares(at, unit, at) < MERGED_GAP**2
    order = np.argsort(-magnitude, axis=1, kind="stable")
    kept = np.zeros(magnitude.shape, bool)
    for i in order.T:
        kept[rows, i] = (magnitude[rows, i] > 0.0) & ~(close[rows, i] & kept).any(1)
    row, rank = np.nonzero(np.take_along_axis(kept, order, 1))
    which = order[row, rank]
    x, y, scale, cosine, sine = at[row, :, which].T.astype(float)
    return row, x + 1j * y, np.exp(scale * SCALE + 1j * np.arctan2(sine, cosine)), magnitude[row, which].astype(float)


def _direction(factor: Complex) -> tuple[Floats, Floats]:
    """Rotation as a point on a circle on which ROTATION is a unit of arc: differences wrap by themselves."""
    way = factor / (np.abs(factor) * ROTATION)
    return way.real, way.imag


def _unit(at: NDArray[np.float32], size: float) -> NDArray[np.float32]:
    """Inverse of a unit of translation at the scale of each point, (m, k)."""
    scale = np.exp(-at[:, 2] * np.float32(SCALE))
    return np.asarray(scale / np.float32(TRANSLATION * size), dtype=np.float32)


def _squares(at: NDArray[np.float32], unit: NDArray[np.float32], space: NDArray[np.float32]) -> NDArray[np.float32]:
    """Squared distances in the normalised transformation space from (m, 5, k) points to (m, 5, n) ones, (m, k, n)."""
    move: NDArray[np.float32] = np.square(at[:, 0, :, None] - space[:, 0, None])
    move += np.square(at[:, 1, :, None] - space[:, 1, None])
    move *= np.square(unit)[:, :, None]
    rest = at[:, 2:].transpose(0, 2, 1) @ space[:, 2:]
    rest *= np.float32(-2.0)
    rest += (at[:, 2:] ** 2).sum(1)[:, :, None]
    rest += (space[:, 2:] ** 2).sum(1)[:, None]
    move += np.maximum(rest, np.float32(0.0), out=rest)
    return move
