"""SL0 regression with targets (section 5.4) on a gram matrix that is made valid."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

#: Least eigenvalue of a gram matrix, as a share of its largest: it takes the place of the regularisation λ of eq. 5.6.
#: Where examples differ by more than that, an example's score is its target, which λ would spoil.
LEAST_EIGENVALUE = 1e-4


def valid_gram(gram: Array) -> Array:
    """A symmetric positive definite matrix near a gram matrix (eq. 5.7).

    Appendix C embeds the examples one after another in disjoint blocks of a larger space, which says nothing about
    their similarities to each other: a similarity maximised over assignments is not positive semi-definite in general
    (three examples whose pairs are matched by assignments that do not compose). The matrix is symmetrised and its
    eigenvalues are raised to a least one.

    Parameters
    ----------
    gram : ndarray of shape (m, m)

    Returns
    -------
    ndarray of shape (m, m)
    """
    values, vectors = np.linalg.eigh((gram + gram.T) / 2)
    values = np.maximum(values, LEAST_EIGENVALUE * max(values[-1], 1e-12))
    return (vectors * values) @ vectors.T


def predicted_targets(similarities: Array, gram: Array, targets: Array) -> Array:
    """Targets predicted by kernel regression (eq. 5.6), in [0, 1].

    Divided by what the same regression predicts for targets that are all 1, so that a placement which resembles
    nothing well keeps the preference of what it resembles most; how well it resembles is said by the similarities.

    Similarities are shares of each example's with itself, so that those of two examples to each other differ. The
    kernel is the product of two placements' similarities to all examples, which is symmetric and never indefinite; a
    placement with the similarities of an example gets the target of that example.

    Parameters
    ----------
    similarities : ndarray of shape (n, m)
        Of each placement to each example.
    gram : ndarray of shape (m, m)
    targets : ndarray of shape (m,)

    Returns
    -------
    ndarray of shape (n,)
    """
    if (targets == targets[0]).all():
        return np.full(len(similarities), float(targets[0]))
    weights = np.linalg.solve(valid_gram(gram @ gram.T), np.stack([targets, np.ones_like(targets)], axis=1))
    wanted, whole = (similarities @ gram.T @ weights).T
    return np.clip(wanted / np.maximum(whole, 1e-9), 0.0, 1.0)
