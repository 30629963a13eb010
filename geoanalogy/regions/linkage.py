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
from scipy.sparse import coo_array, csr_array, triu

from ..geometry.contours import Indices
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
MOST_AT_ONCE = 50_000


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
    Average linkage is reducible: merging two sets brings neither nearer to a third than the nearer of them was. So all
    pairs of sets that are each other's best may be merged at once, in any order, and the sets are the same; the text
    merges one pair at a time. Sums of l_ij n_ij are kept per pair of sets, sums of n_ij follow from the numbers of
    members per query point, and pairs without similarity cost nothing.
    """
    m, n = len(nodes.at), len(refined)
    near = np.zeros((m, m), np.float32)
    near[nodes.first, nodes.second] = nodes.weight
    strength = np.sqrt(refined.magnitude)
    links = coo_array(triu(alike, 1))
    first, second = links.row.astype(np.intp), links.col.astype(np.intp)
    value = links.data * strength[first] * strength[second]
    stop = STOP * float(value.max(initial=0.0))
    total = (value * near[refined.node[first], refined.node[second]]).astype(np.float32)
    owner, name = np.arange(n), np.arange(n)  # the set of each correspondence; the names of the sets that have pairs
    count = np.zeros((n, m), np.float32)
    count[name, refined.node] = 1.0
    weight = _linkage(first, second, total, count, near)
    while len(first):
        good = weight > stop
        first, second, total, weight = first[good], second[good], total[good], weight[good]
        merged = _mutual(first, second, weight, len(name))
        if not len(merged):
            break
        into, renamed = np.arange(len(name)), np.arange(n)
        into[second[merged]] = first[merged]
        renamed[name[second[merged]]] = name[first[merged]]
        owner = renamed[owner]
        count[first[merged]] += count[second[merged]]
        changed = np.zeros(len(name), bool)
        changed[first[merged]] = changed[second[merged]] = True
        same = ~(changed[first] | changed[second])
        i, j, between = _joined(into[first[~same]], into[second[~same]], total[~same], len(name))
        weight = np.concatenate([weight[same], _linkage(i, j, between, count, near)])
        total = np.concatenate([total[same], between])
        left, pair = np.unique(np.concatenate([first[same], i, second[same], j]), return_inverse=True)
        first, second = np.split(pair.ravel(), 2)
        name, count = name[left], count[left]
        yield 1.0 - len(name) / n, "linking correspondences"
    return sorted(_clusters(owner, least, nodes, refined, alike), key=lambda c: -c.tps)


def _linkage(
    first: Indices, second: Indices, total: NDArray[np.float32], count: NDArray[np.float32], near: NDArray[np.float32]
) -> NDArray[np.float32]:
    """Linkage weights (eq. 3.10) of pairs of sets, (k,)."""
    reach, has = count @ near, (count > 0.0).astype(np.float32)
    size = has.sum(1)
    out = np.empty(len(first), np.float32)
    for k in range(0, len(first), MOST_AT_ONCE):
        i, j = first[k : k + MOST_AT_ONCE], second[k : k + MOST_AT_ONCE]
        norm = np.einsum("ij,ij->i", reach[i], count[j])
        both = np.einsum("ij,ij->i", has[i], has[j])
        either = size[i] + size[j] - both
        out[k : k + MOST_AT_ONCE] = total[k : k + MOST_AT_ONCE] / np.maximum(norm, 1e-9) * ((either - both) / either)
    return out


def _mutual(first: Indices, second: Indices, weight: NDArray[np.float32], n: int) -> Indices:
    """Numbers of the pairs that are the best of both their sets; of equal ones the earliest counts as best."""
    best = np.zeros(n, np.float32)
    np.maximum.at(best, first, weight)
    np.maximum.at(best, second, weight)
    some = np.flatnonzero((weight == best[first]) & (weight == best[second]))
    some = some[np.lexsort((second[some], first[some]))]
    earliest = np.full(n, len(some))
    rank = np.arange(len(some))
    np.minimum.at(earliest, first[some], rank)
    np.minimum.at(earliest, second[some], rank)
    return some[(earliest[first[some]] == rank) & (earliest[second[some]] == rank)]


def _joined(
    first: Indices, second: Indices, total: NDArray[np.float32], n: int
) -> tuple[Indices, Indices, NDArray[np.float32]]:
    """Pairs of sets after some were merged: equal pairs are added up, pairs within one set dropped."""
    apart = first != second
    low, high = np.minimum(first, second)[apart], np.maximum(first, second)[apart]
    key, back = np.unique(low * n + high, return_inverse=True)
    return key // n, key % n, np.bincount(back, total[apart], len(key)).astype(np.float32)


def _clusters(owner: Indices, least: int, nodes: Nodes, refined: Refined, alike: csr_array) -> list[Cluster]:
    """Sets with the one correspondence of each query point that agrees best with the others, and their similarities.

    `owner` has the set of each correspondence, negative for none; sets over fewer than `least` query points are left
    out.

    Eq. 3.11 takes a harmonic mean of weights that reach 0; similarities are raised to LEAST_SIMILARITY, which stands
    for "nothing in common", and the mean runs over pairs of neighbouring query points. |T| is taken as the share of
    all query points, so that the similarity does not depend on their number.
    """
    n, m = len(refined), len(nodes.at)
    links = coo_array(alike)
    within = (owner[links.row] == owner[links.col]) & (owner[links.row] >= 0)
    row, column, value = links.row[within], links.col[within], links.data[within]
    agreement = np.bincount(row, value, n) * refined.magnitude
    order = np.lexsort((-agreement, refined.node, owner))
    order = order[owner[order] >= 0]
    place = owner[order] * m + refined.node[order]
    chosen = order[np.diff(place, prepend=-1) != 0]
    chosen = chosen[np.bincount(owner[chosen], minlength=1)[owner[chosen]] >= least]
    names, name, sizes = np.unique(owner[chosen], return_inverse=True, return_counts=True)
    has = np.zeros((len(names), m), bool)
    has[name, refined.node[chosen]] = True
    label = np.full(n, -1)
    label[chosen] = name
    link = np.full((m, m), -1)
    link[nodes.first, nodes.second] = np.arange(len(nodes.first))
    like = np.full((len(names), len(nodes.first)), LEAST_SIMILARITY)
    both = (label[row] >= 0) & (label[column] >= 0)
    row, column, value = row[both], column[both], value[both]
    like[label[row], link[refined.node[row], refined.node[column]]] = np.maximum(value, LEAST_SIMILARITY)
    weight = nodes.weight * (has[:, nodes.first] & has[:, nodes.second])
    total = weight.sum(1)
    mean = np.divide(total, (weight / like).sum(1), out=np.zeros(len(names)), where=total > 0.0)
    return [
        Cluster(members, float(mean[k] * len(members) / m))
        for k, members in enumerate(np.split(chosen, np.cumsum(sizes))[:-1])
    ]


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
    owner = np.full(len(refined), -1)
    owner[members] = 0
    return _clusters(owner, 1, nodes, refined, alike)[0]
