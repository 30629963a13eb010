"""What fits of one place agree on: the last step of a match.

Lines hold a fit across themselves and hardly along: it stays as far along them as the chain or the alignment was that
it started from. Others that agree with it about the place lie a little further or less far, and limbs that one of them
misses another one has. So the best of them are fitted once more, with counterparts continued along the lines
(`growing`), and the functions are averaged, each weighed by how alike the target is by it.

What is drawn keeps its widths and lengths when it bends. So these last rounds hold functions to one scale, softly: what
lines leave open, along them and where a part is missing, is then turned rather than stretched.
"""

from collections.abc import Callable

import numpy as np

from ..geometry.contours import Complex, Floats, Indices
from .fitting import FITTING, Costs, Fit, Fitter
from .guides import Guides

#: How far chains and alignments must agree with a fit, and how many are fitted beside it.
LEAST_AGREEING, MOST = 0.25, 4
#: Stiffness of the functions at first and round by round: (strain, bend) weights.
START, ROUNDS = (0.03, 0.1), ((0.03, 0.1), (0.01, 0.1))
#: Weight of one scale beside a mean squared distance of 1.
RIGIDITY = 0.1
#: Near the end lines are where they belong, and a sample without a counterpart is dearer than while fitting.
SETTLING = Costs(FITTING.stretch, FITTING.turn, 0.3)
#: Mean distance from the fit, in extents of the query at the target's scale, from which on a function is another fit.
NEARBY = 0.06
#: Power of the similarity that a function is weighed by: one that is 2 % less alike counts half.
SHARPNESS = 40.0
#: Least similarity, where lines support none of them.
LEAST_ALIKE = 1e-9


def settled(fitter: Fitter, fits: list[Fit], guides: Guides, similarity: Callable[[list[Fit]], Floats]) -> list[Fit]:
    """The averages of fits and of those nearby that other chains and alignments lead to.

    Parameters
    ----------
    fitter : Fitter
    fits : list of Fit
        Of different places: all of them are fitted at once, which takes little longer than one.
    guides : Guides
    similarity : callable
        How alike the targets of fits are, (k,).

    Returns
    -------
    list of Fit
    """
    if not fits:
        return []
    unknowns, of = _variants(fitter, fits, guides)
    mirrored = np.array([fit.function.mirrored for fit in fits])
    alike = similarity(fitter.measured(unknowns, mirrored[of]))
    average = np.array([averaged(unknowns[of == k], alike[of == k], fitter.size) for k in range(len(fits))])
    # what lies between lines is no evidence: the averages are laid onto them
    laid = fitter.moved(fitter.sampling, average, mirrored, ROUNDS[-1], SETTLING, RIGIDITY)
    return fitter.measured(laid, mirrored)


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


def _variants(fitter: Fitter, fits: list[Fit], guides: Guides) -> tuple[Complex, Indices]:
    """The unknowns of fits, the same with their counterparts continued, and of what agrees with them, (k, 2m).

    And of which fit each is; the fits' own come first.
    """
    own = np.array([fit.function.unknowns for fit in fits])
    mirrored = np.array([fit.function.mirrored for fit in fits])
    share = guides.agreeing(own, mirrored)
    best = np.argsort(-share * guides.worth, axis=1, kind="stable")[:, :MOST]
    near = [(k, guides.every[g]) for k, row in enumerate(best) for g in row if share[k, g] > LEAST_AGREEING]
    of = np.array([*range(len(fits)), *(k for k, _ in near)])
    led = [fitter.start(g.source, g.target, np.ones(len(g.source)), START) for _, g in near]
    unknowns = np.array([*own, *led])
    for number, stiffness in enumerate(ROUNDS):
        growing = number < len(ROUNDS) - 1
        unknowns = fitter.moved(fitter.sampling, unknowns, mirrored[of], stiffness, SETTLING, RIGIDITY, growing)
    return np.concatenate([own, unknowns]), np.concatenate([np.arange(len(fits)), of])
