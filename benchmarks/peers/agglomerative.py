"""Agglomerative correspondence clustering: ACC of figure 3.9, and its dissimilarity in place of the TPS (3.10).

After Cho, Lee and Lee, "Feature correspondence and deformable object matching via agglomerative correspondence
clustering" (2009). Two correspondences are as dissimilar as their transformations miss each other's points (equation 1:
the symmetric projection error, in both images); sets of correspondences are merged by adaptive partial linkage, the
average of the k least dissimilarities between them, until the least is above a threshold.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from geoanalogy.regions.correspondences import Correspondences
from geoanalogy.regions.refinement import Refined
from geoanalogy.regions.transformation import Nodes

Complex = NDArray[np.complex128]
Array = NDArray[np.float64]

#: Least dissimilarities that a linkage averages, and the dissimilarity at which merging ends: extents of the query.
PARTIAL, STOP = 10, 0.06
#: Correspondences that take part at most, most confident first, and fewest of a set that is a match.
MOST, LEAST_MEMBERS = 500, 6


@dataclass(frozen=True)
class Cluster:
    """Correspondences that move alike, with the share of confidence that they hold."""

    source: Complex
    image: Complex
    factor: Complex
    mirrored: bool
    weight: float

    def carry(self, z: Complex, width: float) -> Complex:
        """Points carried by the Gaussian-weighted average of the correspondences' transformations."""
        square = np.abs(z[:, None] - self.source[None]) ** 2 / (2.0 * width**2)
        weight = np.exp(square.min(1, keepdims=True) - square)
        weight /= weight.sum(1, keepdims=True)
        image = (weight * (self.image + self.factor * (z[:, None] - self.source))).sum(1)
        return np.conj(image) if self.mirrored else image


def projection_error(source: Complex, image: Complex, factor: Complex) -> Array:
    """Symmetric projection error of all pairs of correspondences, (n, n): equation 1 of the paper."""
    ahead = image[:, None] + factor[:, None] * (source[None] - source[:, None]) - image[None]
    back = source[:, None] + (image[None] - image[:, None]) / factor[:, None] - source[None]
    one = (np.abs(ahead) + np.abs(back)) / 2.0
    return np.asarray((one + one.T) / 2.0, dtype=np.float64)


def clustered(noisy: Correspondences, size: float) -> list[Cluster]:
    """Sets of correspondences, most confident first.

    Parameters
    ----------
    noisy : Correspondences
        First-order correspondences.
    size : float
        Extent of the query.
    """
    out: list[Cluster] = []
    for flip in (False, True):
        own = np.flatnonzero(noisy.mirrored == flip)
        own = own[np.argsort(-noisy.confidence[own], kind="stable")[:MOST]]
        if len(own) < LEAST_MEMBERS:
            continue
        c = noisy.chosen(own)
        apart = projection_error(c.source, c.image, c.factor) / size
        for members in _merged(apart):
            if len(np.unique(c.source[members])) >= LEAST_MEMBERS:
                some = c.chosen(members)
                out.append(Cluster(some.source, some.image, some.factor, flip, float(some.confidence.sum())))
    return sorted(out, key=lambda k: -k.weight)


def _merged(apart: Array) -> list[NDArray[np.intp]]:
    """Adaptive partial linkage."""
    n = len(apart)
    sets: dict[int, NDArray[np.intp]] = {i: np.array([i]) for i in range(n)}
    linkage = apart.copy()
    np.fill_diagonal(linkage, np.inf)
    while len(sets) > 1:
        i, j = np.unravel_index(int(linkage.argmin()), linkage.shape)
        if linkage[i, j] > STOP:
            break
        sets[i] = np.concatenate([sets[i], sets.pop(j)])
        linkage[j] = linkage[:, j] = np.inf
        for k in sets:
            if k == i:
                continue
            between = apart[np.ix_(sets[i], sets[k])].ravel()
            count = min(PARTIAL, len(between))
            linkage[i, k] = linkage[k, i] = np.partition(between, count - 1)[:count].mean()
    return list(sets.values())


def projected_similarities(nodes: Nodes, refined: Refined, unit: float) -> csr_array:
    """Second-order similarities from the projection error in place of the gradient (section 3.6).

    Parameters
    ----------
    nodes : Nodes
    refined : Refined
    unit : float
        Projection error that is one radius of the Gaussian, as a length.

    Returns
    -------
    csr_array
        As `geoanalogy.regions.linkage.similarities` returns them.
    """
    error = projection_error(nodes.at[refined.node], refined.image, refined.factor)
    near = np.zeros((len(nodes.at), len(nodes.at)), bool)
    near[nodes.first, nodes.second] = True
    alike = np.exp(-0.5 * (error / unit) ** 2)
    alike[~near[np.ix_(refined.node, refined.node)]] = 0.0
    alike[refined.mirrored[:, None] != refined.mirrored[None]] = 0.0
    alike[alike < np.exp(-4.5)] = 0.0
    return csr_array(alike)
