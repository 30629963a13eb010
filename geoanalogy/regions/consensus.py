"""What fits of one place agree on: the last step of a match.

Lines hold a fit across themselves and hardly along: it stays as far along them as the chain or the alignment was that
it started from. Others that agree with it about the place lie a little further or less far, and limbs that one of them
misses another one has. So the best of them are fitted once more, with counterparts continued along the lines
(`growing`), and the functions are averaged, each weighed by how alike the target is by it.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from ..geometry.contours import Complex, Floats
from .fitting import Fit, Fitter
from .guides import Guides

#: How far chains and alignments must agree with a fit, and how many are fitted beside it.
LEAST_AGREEING, MOST = 0.25, 4
#: Stiffness of the functions at first and round by round: (strain, bend) weights.
START, ROUNDS = (0.03, 0.1), ((0.03, 0.1), (0.01, 0.1), (0.01, 0.1))
#: Mean distance from the fit, in extents of the query at the target's scale, from which on a function is another fit.
NEARBY = 0.06
#: Power of the similarity that a function is weighed by: one that is 2 % less alike counts half.
SHARPNESS = 40.0
#: Least similarity, where lines support none of them.
LEAST_ALIKE = 1e-9


def settled(
    fitter: Fitter,
    fit: Fit,
    guides: Guides,
    similarity: Callable[[list[Fit]], Floats],
) -> Fit:
    """The average of a fit and of those nearby that other chains and alignments lead to.

    Parameters
    ----------
    fitter : Fitter
    fit : Fit
    guides : Guides
    similarity : callable
        How alike the targets of fits are, (k,).

    Returns
    -------
    Fit
    """
    unknowns = _variants(fitter, fit, guides)
    mirrored = np.full(len(unknowns), fit.function.mirrored)
    average = averaged(unknowns, similarity(fitter.measured(unknowns, mirrored)), fitter.size)[None]
    # what lies between lines is no evidence: the average is laid onto them
    return fitter.measured(fitter.moved(fitter.sampling, average, mirrored[:1], ROUNDS[-1]), mirrored[:1])[0]


def averaged(unknowns: Complex, alike: Floats, size: float) -> Complex:
    """The average of functions near the first, by how alike the targets are.

    Parameters
    ----------
    unknowns : (k, 2m) complex
    alike : (k,) float
        Their similarities.
    size : float
        Extent of the query.

    Returns
    -------
    (2m,) complex
    """
    m = unknowns.shape[1] // 2
    unit = size * np.abs(unknowns[0, m:]).mean()
    near = np.abs(unknowns[:, :m] - unknowns[0, :m]).mean(1) < NEARBY * unit
    alike = np.maximum(alike, LEAST_ALIKE)
    weight = np.where(near, alike / alike[near].max(), 0.0) ** SHARPNESS
    return np.asarray(weight @ unknowns / weight.sum(), dtype=np.complex128)


def _variants(fitter: Fitter, fit: Fit, guides: Guides) -> Complex:
    """The unknowns of a fit, of the same with its counterparts continued, and of what agrees with it, (k, 2m)."""
    own = fit.function.unknowns
    share = guides.agreeing(own[None], np.array([fit.function.mirrored]))[0]
    best = np.argsort(-share * guides.worth, kind="stable")[:MOST]
    near = [guides.every[k] for k in best if share[k] > LEAST_AGREEING]
    unknowns = np.array([own, *(fitter.start(c.source, c.target, np.ones(len(c.source)), START) for c in near)])
    mirrored: NDArray[np.bool_] = np.full(len(unknowns), fit.function.mirrored)
    for number, stiffness in enumerate(ROUNDS):
        unknowns = fitter.moved(fitter.sampling, unknowns, mirrored, stiffness, growing=number < len(ROUNDS) - 1)
    return np.concatenate([own[None], unknowns])
