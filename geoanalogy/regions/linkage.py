"""Smooth transformation functions among refined correspondences: average linkage (section 3.5).

Choices where the text leaves them open, or cannot be taken literally:

- Gradients (eq. 3.5) are taken in the recentred form of appendix A, in units of the target: a translation gradient is a
  strain, a scale gradient a difference of logarithms, a rotation gradient wraps. The unit of length is the spacing of
  the query points, to which r_n (eq. 3.8) is tied too. The lesser of a_ij and a_ji is taken.
- n_ij stands in eq. 3.7 and again in eq. 3.10. It is taken once, as the weight of the average.
- The fold-over factor 2^(N_s - N_d) of eq. 3.9 spans a hundred orders of magnitude. N_s / (N_s + N_d) is 1 for sets
over
  different query points and 0 for sets over the same ones.
- Confidences enter as their square roots: a weak mode beside a strong one is still evidence (figure B.3).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import connected_components

from ..geometry.contours import Floats
from ..progress import Stepper
from .refinement import ROTATION, SCALE, Refined
from .transformation import Nodes

#: Strain that counts as much as scaling by 1.25 or turning by 45 degrees between neighbouring query points.
STRAIN = 0.35
#: Second-order similarity below which two correspondences have nothing in common: e^-4.5, three radii of eq. 3.6.
LEAST_SIMILARITY = np.exp(-4.5)
#: Merging stops at this share of the largest linkage weight (section 3.5).
STOP = 0.01
#: Pairs of sets whose linkage is computed at once.
MOST_AT_ONCE = 1_000_000


@dataclass(frozen=True)
class Cluster:
    """A set T of refined correspondences that approximates a transformation function.

    Attributes
    ----------
    members : (n,) int
        Indices of refined correspondences, at most one for each query point.
    tps : float
        Transformation parameter similarity (eq. 3.11), 0 to 1, times the share of the query points in it.
    """

    members: NDArray[np.intp]
    tps: float


def similarities(nodes: Nodes, refined: Refined, joint_tolerance: float = 0.0) -> csr_array:
    """Second-order similarities a_ij (eq. 3.6) of all pairs over neighbouring query points, symmetric and sparse.

    Parameters
    ----------
    nodes : Nodes
        Query points and their neighbourhood.
    refined : Refined
    joint_tolerance : float
        0 to 1: similarities are raised towards 1 by this share of the way that the strain alone allows, so that jumps
        of rotation and scale, as at a joint, do not part a region.

    Returns
    -------
    csr_array
    """
    order = np.argsort(refined.node, kind="stable")
    first = np.searchsorted(refined.node[order], np.arange(len(nodes.at) + 1))
    turn = np.log(refined.factor)
    x, y = refined.image.real, refined.image.imag
    reach = np.abs(refined.factor) ** 2
    rows, columns, values = [], [], []
    for i, j in zip(nodes.first, nodes.second, strict=True):
        if i >= j:
            continue
        left, right = order[first[i] : first[i + 1]], order[first[j] : first[j + 1]]
        if not len(left) or not len(right):
            continue
        step = nodes.at[j] - nodes.at[i]
        # squared strains: where each correspondence takes the other's query point, beside where the other takes it
        ahead = refined.image[left] + refined.factor[left] * step
        behind = refined.image[right] - refined.factor[right] * step
        forth = ((x[right] - ahead.real[:, None]) ** 2 + (y[right] - ahead.imag[:, None]) ** 2) / reach[left][:, None]
        back = ((behind.real - x[left][:, None]) ** 2 + (behind.imag - y[left][:, None]) ** 2) / reach[right]
        both = np.minimum(forth, back) if joint_tolerance > 0.0 else np.maximum(forth, back)
        p, q = np.nonzero(both <= -2.0 * np.log(LEAST_SIMILARITY) * (STRAIN * abs(step)) ** 2)
        same = refined.mirrored[left[p]] == refined.mirrored[right[q]]
        p, q = p[same], q[same]
        unit = 1.0 / (STRAIN * abs(step)) ** 2
        forth, back = forth[p, q] * unit, back[p, q] * unit
        ratio = turn[right[q]] - turn[left[p]]
        wrapped = (ratio.imag + np.pi) % (2.0 * np.pi) - np.pi
        change = ((ratio.real / SCALE) ** 2 + (wrapped / ROTATION) ** 2) * (nodes.spacing / abs(step)) ** 2
        alike = np.exp(-0.5 * (np.maximum(forth, back) + change))
        if joint_tolerance > 0.0:
            eased = np.exp(-0.5 * np.minimum(forth, back))
            alike = alike + joint_tolerance * (eased - np.minimum(eased, alike))
        good = alike > LEAST_SIMILARITY
        rows.append(left[p[good]])
        columns.append(right[q[good]])
        values.append(alike[good])
    n = len(refined)
    if not rows:
        return csr_array((n, n))
    r, c, v = np.concatenate(rows), np.concatenate(columns), np.concatenate(values)
    return coo_array((np.concatenate([v, v]), (np.concatenate([r, c]), np.concatenate([c, r]))), shape=(n, n)).tocsr()


def clusters(nodes: Nodes, refined: Refined, alike: csr_array, least: int) -> Stepper[list[Cluster]]:
    """Average linkage clustering (algorithm 3.3).

    Parameters
    ----------
    nodes : Nodes
    refined : Refined
    alike : (n, n) sparse
        Second-order similarities.
    least : int
        Fewest query points of a cluster that is returned.

    Returns
    -------
    list of Cluster
        Best first.

    Notes
    -----
    Sums of l_ij n_ij are kept per pair of clusters; the sums of n_ij follow from the numbers of members per query
    point, so that pairs without similarity cost nothing. Parts of the graph that no similarity joins are clustered
    one by one: the work grows with the largest of them, not with the drawing.
    """
    m = len(nodes.at)
    near = np.zeros((m, m))
    near[nodes.first, nodes.second] = nodes.weight
    strength = np.sqrt(refined.magnitude)
    links = alike.tocoo()
    value = (
        links.data * strength[links.row] * strength[links.col] * near[refined.node[links.row], refined.node[links.col]]
    )
    weight = coo_array((value, (links.row, links.col)), shape=alike.shape).tocsr()
    largest = float((links.data * strength[links.row] * strength[links.col]).max(initial=0.0))
    number, part = connected_components(weight, directed=False)
    groups = np.split(np.argsort(part, kind="stable"), np.cumsum(np.bincount(part, minlength=number))[:-1])
    found: list[Cluster] = []
    done = 0
    for members in groups:
        done += len(members)
        if len(np.unique(refined.node[members])) < least:
            continue
        local = weight[members][:, members].toarray()
        sets = yield from _merge(local, refined.node[members], near, STOP * largest, done / max(len(refined), 1))
        for s in sets:
            if len(s) < least or len(np.unique(refined.node[members[s]])) < least:
                continue
            cluster = _cluster(members[s], nodes, refined, alike)
            found.append(cluster)
    found.sort(key=lambda c: -c.tps)
    return found


def _merge(
    weight: Floats, node: NDArray[np.intp], near: Floats, stop: float, fraction: float
) -> Stepper[list[NDArray[np.intp]]]:
    """Average linkage of one part of the graph: the members of each final set."""
    n, m = len(node), len(near)
    count = np.zeros((n, m), np.float32)
    count[np.arange(n), node] = 1.0
    reach = count @ near.astype(np.float32)
    has = (count > 0).astype(np.float32)
    total = weight.astype(np.float32)
    np.fill_diagonal(total, 0.0)
    owner = np.arange(n)
    alive = np.ones(n, bool)

    def linkage(some: NDArray[np.intp], others: NDArray[np.intp]) -> NDArray[np.float32]:
        """Linkage weights (eq. 3.10) of some sets with others, (k, l)."""
        norm = np.maximum(reach[some] @ count[others].T, 1e-9)
        both = has[some] @ has[others].T
        either = has[some].sum(1)[:, None] + has[others].sum(1) - both
        between = total[some[0], others][None] if len(some) == 1 else total[some][:, others]
        return np.asarray(between / norm * ((either - both) / either), dtype=np.float32)

    best, partner = np.zeros(n, np.float32), np.zeros(n, int)

    def anew(some: NDArray[np.intp]) -> None:
        """Find the best partner of some sets."""
        there = np.flatnonzero(alive)
        for part in np.array_split(some, 1 + len(some) * len(there) // MOST_AT_ONCE):
            value = linkage(part, there)
            which = value.argmax(1)
            best[part], partner[part] = value[np.arange(len(part)), which], there[which]

    anew(np.arange(n))
    merged = 0
    while True:
        i = int(best.argmax())
        if best[i] <= stop:
            break
        j = int(partner[i])
        total[i] += total[j]
        total[:, i] = total[i]
        total[j] = total[:, j] = 0.0
        total[i, i] = 0.0
        count[i] += count[j]
        reach[i] += reach[j]
        has[i] = np.maximum(has[i], has[j])
        owner[owner == j] = i
        alive[j], best[j] = False, 0.0
        best[i] = 0.0
        others = np.flatnonzero(total[i])
        if len(others):
            value = linkage(np.array([i]), others)[0]
            k = int(value.argmax())
            best[i], partner[i] = value[k], others[k]
            better = value > best[others]
            best[others[better]], partner[others[better]] = value[better], i
            stale = others[~better & ((partner[others] == i) | (partner[others] == j))]
            if len(stale):
                anew(stale)
        merged += 1
        if merged % 50 == 0:
            yield fraction, "linking correspondences"
    return [np.flatnonzero(owner == i) for i in np.flatnonzero(alive)]


def _cluster(members: NDArray[np.intp], nodes: Nodes, refined: Refined, alike: csr_array) -> Cluster:
    """A set with the one correspondence of each query point that agrees best with the others, and its similarity.

    Eq. 3.11 takes a harmonic mean of weights that reach 0; similarities are raised to LEAST_SIMILARITY, which stands
    for "nothing in common", and the mean runs over pairs of neighbouring query points. |T| is taken as the share of
    all query points, so that the similarity does not depend on their number.
    """
    local = alike[members][:, members]
    agreement = np.asarray(local.sum(1)).ravel() * refined.magnitude[members]
    order = np.lexsort((-agreement, refined.node[members]))
    _, first = np.unique(refined.node[members][order], return_index=True)
    chosen = members[order[first]]
    at = np.full(len(nodes.at), -1)
    at[refined.node[chosen]] = chosen
    i, j = at[nodes.first], at[nodes.second]
    both = (i >= 0) & (j >= 0)
    if not both.any():
        return Cluster(chosen, 0.0)
    value = np.maximum(np.asarray(alike[i[both], j[both]]).ravel(), LEAST_SIMILARITY)
    weight = nodes.weight[both]
    return Cluster(chosen, float(weight.sum() / (weight / value).sum() * len(chosen) / len(nodes.at)))


def branched(cluster: Cluster, nodes: Nodes, refined: Refined, alike: csr_array) -> Cluster:
    """A set grown over the query points that it lacks, by correspondences that may be of other sets as well.

    Linkage gives every correspondence to one set, so that of two branches with a common trunk only one gets the trunk
    (section 6.2: branching shapes are branching surfaces in transformation space). The other one borrows it here, query
    point by query point, best agreement with its members first.

    Parameters
    ----------
    cluster : Cluster
    nodes : Nodes
    refined : Refined
    alike : csr_array

    Returns
    -------
    Cluster
    """
    members = list(cluster.members)
    free = np.ones(len(nodes.at), bool)
    free[refined.node[members]] = False
    agreement = np.asarray(alike[:, members].sum(1)).ravel()
    while free.any():
        value = agreement * refined.magnitude * free[refined.node]
        best = int(value.argmax())
        if value[best] <= 0.0:
            break
        members.append(best)
        free[refined.node[best]] = False
        agreement += alike[:, [best]].toarray().ravel()
    return _cluster(np.sort(np.array(members)), nodes, refined, alike)
