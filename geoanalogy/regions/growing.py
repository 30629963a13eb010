"""Growing counterparts along the lines of the drawing.

Counterparts are looked for near the images of samples. Where a limb bends away further than that, none is found for
it, and it is carried on stiffly from the rest. But the line goes on there: beyond both ends of what has counterparts
they are continued along the lines that these lie on, by arc length, for as long as the lines turn about alike. They
weigh less than those that were found, and have to be found themselves in the last round.
"""

import numpy as np
from numpy.typing import NDArray

from ..geometry.contours import Complex, Floats
from .samples import Sampling
from .target import Target

#: Samples that counterparts are continued by in a round.
REACH = 6
#: Weight of a continued counterpart, and difference of turns, in radians, at which it is 0.6 of that.
LIGHT, BENT = 0.3, 0.5


def grown(
    sampling: Sampling,
    target: Target,
    unknowns: Complex,
    mirrored: NDArray[np.bool_],
    found: tuple[NDArray[np.intp], Complex, Floats],
) -> tuple[Complex, Floats]:
    """Continue counterparts beyond both ends of every stretch of samples that has some.

    Parameters
    ----------
    sampling : Sampling
    target : Target
    unknowns : (h, 2m) complex
    mirrored : (h,) bool
    found : (array, array, array)
        Counterparts (h, s) as indices into the target's points, -1 for none; where they are, conjugated where mirrored;
        their weights.

    Returns
    -------
    goal : (h, s) complex
        Where the counterparts are, conjugated where mirrored.
    weight : (h, s) float
    """
    at, goal, weight = found[0], found[1].copy(), found[2].copy()
    s = sampling.samples
    scale = np.abs(unknowns[:, unknowns.shape[1] // 2 :]).mean(1)
    sign = np.where(mirrored, -1.0, 1.0)
    way = np.angle(unknowns @ sampling.ahead.T - unknowns @ sampling.rows.T) * sign[:, None]
    side = np.sign(np.cos(target.heading[at] - way))
    for sense, back in ((1.0, s.before), (-1.0, s.after)):
        pending = at < 0
        anchor = np.arange(len(s.points))
        for count in range(1, REACH + 1):
            anchor = np.where(anchor >= 0, back[anchor], -1)
            r, i = np.nonzero(pending & (anchor >= 0) & (at[:, anchor] >= 0))
            a = anchor[i]
            begin = at[r, a]
            walked = sense * side[r, a] * count * s.spacing[i] * scale[r] / target.spacing[begin]
            here = target.walk(begin, np.round(walked).astype(np.intp))
            miss = target.heading[here] - target.heading[begin] - sign[r] * (s.heading[i] - s.heading[a])
            miss = (miss + np.pi) % (2.0 * np.pi) - np.pi
            light = LIGHT * np.exp(-0.5 * (miss / BENT) ** 2)
            better = (here >= 0) & (light > weight[r, i])
            r, i, here = r[better], i[better], here[better]
            point = target.points[here]
            goal[r, i] = np.where(mirrored[r], np.conj(point), point)
            weight[r, i] = light[better]
            pending &= (anchor < 0) | (at[:, anchor] < 0)
    return goal, weight
