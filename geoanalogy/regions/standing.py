"""How far matches stand out of their drawing: which are shown.

The same similarity does not say the same everywhere. A rich silhouette is never matched as well as a plain one, and
what resembles it by chance even less; a part with few corners resembles many things. What else the drawing has tells:
a match stands out so far as it is alike by itself, or much more so than the clutter of its own drawing. And what
belongs together is alike to about one degree: below the widest gap between the similarities of a drawing lies clutter.

And some of what is alike is so by chance: where few corners fall on corners, as many may do so anywhere. What may be
chance is shown only as the best match.
"""

import numpy as np

from ..geometry.contours import Floats

#: Similarity at which a match stands out halfway whatever else there is, and how steeply it does so more and less.
HALFWAY, STEEP = 0.5, 3.0
#: Share of the other places, least alike first, that are taken as clutter: the rest may be right as well.
CLUTTER = 0.67
#: Similarity of clutter where the drawing shows none, and how many places that counts as.
USUAL, USUAL_WEIGHT = 0.1, 0.5
#: Evidence of corners, as a share of what is enough, from which on a match is no chance; or its similarity.
CERTAIN, ALIKE = 0.6, 0.65


def standing(similarity: Floats, every: Floats) -> Floats:
    """How far similarities stand out of a drawing.

    Parameters
    ----------
    similarity : (k,) float
    every : (n,) float
        The best similarity of every place of the drawing, descending; the first is no clutter.

    Returns
    -------
    (k,) float
        0 to 1; 1 for an identical copy, and ascending with the similarity.
    """
    others = np.sort(every[1:])[: int(np.ceil(CLUTTER * len(every[1:])))]
    clutter = (others.sum() + USUAL * USUAL_WEIGHT) / (len(others) + USUAL_WEIGHT)
    s = np.clip(similarity, 1e-9, 1.0)
    alone = 1.0 / (1.0 + ((1.0 - s) / s * HALFWAY / (1.0 - HALFWAY)) ** STEEP)
    beside = np.maximum(0.0, 1.0 - clutter / s) ** 2
    return np.asarray(1.0 - (1.0 - alone) * (1.0 - beside), dtype=np.float64)


def least_shown(every: Floats, corners: Floats, threshold: float, contrast: float) -> float:
    """Least similarity of a match that is shown.

    Parameters
    ----------
    every : (n,) float
        The best similarity of every place of the drawing, descending.
    corners : (n,) float
        Their evidence of corners, as a share of what is enough.
    threshold : float
        How far a match must stand out, 0 to 1.
    contrast : float
        The same as a share of how far the best does.

    Returns
    -------
    float
        0 where all are shown; else no less than the middle of the widest gap, and more than what may be chance.
    """
    if not len(every):
        return 0.0
    needed = max(threshold, contrast * float(standing(every[:1], every)[0]))
    if needed <= 0.0:
        return 0.0
    low, high = 0.0, 1.0
    for _ in range(50):  # standing ascends: bisection, to the last digit
        middle = 0.5 * (low + high)
        if standing(np.array([middle]), every)[0] < needed:
            low = middle
        else:
            high = middle
    return max(low, middle_of_gap(every), above_chance(every, corners))


def above_chance(every: Floats, corners: Floats) -> float:
    """The similarity below which the first match lies that may be chance, and is not the best.

    Parameters
    ----------
    every : (n,) float
        Descending.
    corners : (n,) float
        Evidence of corners, as a share of what is enough.

    Returns
    -------
    float
        The middle between it and the one before; 0 where none may be chance.
    """
    chance = (corners < CERTAIN) & (every < ALIKE)
    chance[:1] = False
    if not chance.any():
        return 0.0
    first = int(chance.argmax())
    return float(every[first - 1 : first + 1].mean())


def middle_of_gap(every: Floats) -> float:
    """The middle of the widest gap between similarities.

    Parameters
    ----------
    every : (n,) float
        Descending. Below all of them is the usual clutter, which a drawing may not show.

    Returns
    -------
    float
    """
    steps = np.maximum(np.append(every, USUAL), USUAL)
    widest = int(np.argmax(-np.diff(steps)))
    return float(steps[widest : widest + 2].mean())
