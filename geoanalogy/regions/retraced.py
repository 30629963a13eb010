"""Chains retraced along fits: corners compared once more where a fit leads.

Chains are looked for along whole lines, the longest of the drawing (`chains`). What counts as a corner depends on the
extent of a line, so a part of a large outline has fewer corners than the same part by itself, and a small shape among
many long lines is not looked at at all. Where a fit says which part of a line is the counterpart of which stretch of
the query, the corners of that part alone can be compared with those of the stretch.
"""

import numpy as np

from ..geometry.contours import Contours, Floats, Indices
from .chains import LEADING, chain, compared
from .evidence import support
from .fitting import PLACE, Fit, Fitter
from .guides import Guides
from .query import Query, Run

#: Mean evidence at the samples from which on a fit is worth being retraced.
LEAST_SUPPORT = 0.75
#: Counterparts of a stretch of the query on one line, fewer of which say nothing.
LEAST_COUNTERPARTS = 4
#: Points of a closed line, in typical gaps between counterparts, without any from which on only a part is meant.
LEFT_OUT = 4.0


def wanting(fitter: Fitter, fits: list[Fit], met: Floats) -> Indices:
    """The fits that want evidence of chains, at places where none has enough of it.

    Beside one that has enough, others would be given more than it has, since it is not retraced.

    Parameters
    ----------
    fitter : Fitter
    fits : list of Fit
    met : (n,) float
        Evidence of chains as a share of what is enough.

    Returns
    -------
    (k,) int
    """
    unknowns = np.array([f.function.unknowns for f in fits])
    centre, extent = fitter.places(unknowns, np.array([f.function.mirrored for f in fits]))
    near = np.abs(centre[:, None] - centre) < PLACE * np.minimum(extent[:, None], extent)
    return np.flatnonzero(~(near & (met >= 1.0)).any(1))


def retraced(contours: Contours, query: Query, fitter: Fitter, fits: list[Fit], mirrored: bool) -> Floats:
    """Evidence of chains along fits, found on the counterparts alone.

    Parameters
    ----------
    contours : Contours
    query : Query
    fitter : Fitter
    fits : list of Fit
    mirrored : bool
        Whether mirror images are wanted.

    Returns
    -------
    (n,) float
        As `Guides.agreement` has it; 0 for fits that are supported too little.
    """
    out = np.zeros(len(fits))
    sources = compared(contours, query.runs)
    which = [i for i, fit in enumerate(fits) if support(fit).mean() >= LEAST_SUPPORT]
    for begin in range(0, len(which), LEADING):
        some = [fits[i] for i in which[begin : begin + LEADING]]
        unknowns = np.array([f.function.unknowns for f in some])
        flipped = np.array([f.function.mirrored for f in some])
        for k, source in enumerate(sources):
            parts = [part for part in (counterpart(fit, fitter, k) for fit in some) if part is not None]
            chains = chain(contours, [source], parts, mirrored)
            out[which[begin : begin + LEADING]] += Guides(fitter, chains, []).agreement(unknowns, flipped)[0]
    return out


def counterpart(fit: Fit, fitter: Fitter, number: int) -> Run | None:
    """The part of a line that most counterparts of a stretch of the query lie on.

    Parameters
    ----------
    fit : Fit
    fitter : Fitter
    number : int
        Of the stretch, longest first.

    Returns
    -------
    Run or None
        None where there are too few of them.
    """
    target = fitter.target
    of = np.cumsum(fitter.sampling.samples.step == 0.0) - 1
    at = fit.counterpart[(of == number) & (fit.counterpart >= 0)]
    if len(at) < LEAST_COUNTERPARTS:
        return None
    line = int(np.bincount(target.stretch[at]).argmax())
    place = np.unique(target.place[at[target.stretch[at] == line]])
    if len(place) < LEAST_COUNTERPARTS:
        return None
    start, n, low, high = int(target.begin[line]), int(target.count[line]), int(place[0]), int(place[-1])
    if target.closed[line]:
        gap = np.diff(np.append(place, low + n))
        widest = int(gap.argmax())
        if gap[widest] <= LEFT_OUT * np.median(gap):
            return Run(target.index[start + np.arange(n)], True)
        high = int(place[widest])
        low = int(place[(widest + 1) % len(place)]) - (n if widest + 1 < len(place) else 0)
    return Run(target.index[start + np.arange(low, high + 1) % n], False)
