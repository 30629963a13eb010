"""Refined correspondences (section 3.4): modes of the noisy ones near each query point."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.distance import cdist

from ..geometry.contours import Complex, Floats
from ..progress import Stepper
from .correspondences import Correspondences

#: Normalisation of the transformation space: a translation by a tenth of the query (at the target's scale) is as much
#: as scaling by 1.25 or turning by 45 degrees. The thesis takes 0.03 of the drawing's diagonal, which says the same
#: where a query takes up a third of the drawing, but not in a larger one.
TRANSLATION, SCALE, ROTATION = 0.1, np.log(1.25), np.pi / 4
#: Noisy correspondences that a query point listens to at most, heaviest first.
MOST_NEAR = 250
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
        count = np.bincount(back)
        density = np.exp(-0.5 * (cdist(pairs, pairs) / radius) ** 2) @ count
        weight_all = noisy.confidence / density[back]
    for flip in (False, True):
        own = np.flatnonzero(noisy.mirrored == flip)
        if not len(own):
            continue
        c = noisy.chosen(own)
        for k, q in enumerate(points):
            weight = np.exp(-0.5 * (np.abs(c.source - q) / radius) ** 2) * weight_all[own]
            heavy = np.flatnonzero(weight >= 0.01 * weight.max())
            if len(heavy) > MOST_NEAR:
                heavy = heavy[np.argsort(-weight[heavy], kind="stable")[:MOST_NEAR]]
            image, factor, magnitude = modes(
                c.image[heavy] + c.factor[heavy] * (q - c.source[heavy]), c.factor[heavy], weight[heavy], size
            )
            n = len(image)
            parts.append((np.full(n, k), image, factor, np.full(n, flip), magnitude))
            yield (k + 1) / len(points) * 0.5 + 0.5 * flip, "refining correspondences"
    if not parts:
        none = np.zeros(0, complex)
        return Refined(np.zeros(0, np.intp), none, none, np.zeros(0, bool), np.zeros(0))
    node, image, factor, mirrored, magnitude = (np.concatenate(p) for p in zip(*parts, strict=True))
    magnitude = magnitude / magnitude.max()
    good = magnitude >= LEAST_MAGNITUDE
    return Refined(node[good], image[good], factor[good], mirrored[good], magnitude[good])


def modes(image: Complex, factor: Complex, weight: Floats, size: float) -> tuple[Complex, Complex, Floats]:
    """Dominant modes of weighted similarities by mean shift with a kernel of radius one.

    Parameters
    ----------
    image : (n,) complex
        Where each similarity takes the query point.
    factor : (n,) complex
    weight : (n,) float
    size : float
        Extent of the query.

    Returns
    -------
    image, factor : (k,) complex
    magnitude : (k,) float
        Density at the modes, descending.

    Notes
    -----
    Mean shift starts from the heaviest correspondences that are farther than SEED_GAP from each other; from the ones
    between them it would end in the same modes.
    """
    space = np.stack([image.real, image.imag, np.log(np.abs(factor)) / SCALE, *_direction(factor)]).astype(np.float32)
    unit = (1.0 / (TRANSLATION * size * np.abs(factor))).astype(np.float32)
    order = np.argsort(-weight, kind="stable")
    apart = _squares(space, unit, space) > SEED_GAP**2
    alive = np.ones(len(order), bool)
    seeds: list[int] = []
    for i in order:
        if alive[i]:
            seeds.append(int(i))
            alive &= apart[i]
            if len(seeds) == MOST_MODES:
                break
    at: NDArray = space[:, seeds]
    for _ in range(SHIFTS):
        pull = np.exp(-0.5 * _squares(at, np.exp(-at[2] * SCALE) / (TRANSLATION * size), space)) * weight
        at = (pull @ space.T / pull.sum(1)[:, None]).T
        at[3:] /= np.hypot(at[3], at[4]) * ROTATION
    unit = np.exp(-at[2] * SCALE) / (TRANSLATION * size)
    magnitude = np.exp(-0.5 * _squares(at, unit, space)) @ weight
    close = _squares(at, unit, at) < MERGED_GAP**2
    kept: list[int] = []
    for i in np.argsort(-magnitude, kind="stable"):
        if not close[i, kept].any():
            kept.append(int(i))
    at = at[:, kept]
    return at[0] + 1j * at[1], np.exp(at[2] * SCALE + 1j * np.arctan2(at[4], at[3])), magnitude[kept]


def _direction(factor: Complex) -> tuple[Floats, Floats]:
    """Rotation as a point on a circle on which ROTATION is a unit of arc: differences wrap by themselves."""
    way = factor / (np.abs(factor) * ROTATION)
    return way.real, way.imag


def _squares(at: NDArray, unit: NDArray, space: NDArray) -> NDArray:
    """Squared distances in the normalised transformation space from (5, k) points to (5, n) ones, (k, n).

    A unit of translation is one at the scale of the first point, `unit` (k,) its inverse.
    """
    move = (at[0][:, None] - space[0]) ** 2 + (at[1][:, None] - space[1]) ** 2
    rest = at[2:].T @ space[2:]
    own, other = (at[2:] ** 2).sum(0), (space[2:] ** 2).sum(0)
    return move * (unit**2)[:, None] + np.maximum(own[:, None] + other - 2.0 * rest, 0.0)
