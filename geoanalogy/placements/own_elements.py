"""Elements that examples have for themselves: where all of these have one, what is beside none follows another rule.

Two sills below two windows say that sills are below windows, and where these are all the windows there are, nothing is
left to place: that columns of examples may go on past the windows is no reason for a sill there.
"""

import numpy as np
from numpy.typing import NDArray

from .arrangement import Arrangement
from .boxes import areas, distances
from .lesson import Lesson, Match
from .signature import BOX

Array = NDArray[np.float64]

#: Exceptions that every rule has before any example confirms it: half an observation, as little as says nothing
#: (Jeffreys).
UNSEEN = 0.5
#: Agreement of examples in where they are beside their elements that is as good as none.
NO_AGREEMENT = 0.5
#: Power of the share of elements that have an example: the rate at which they have one, and once more since whoever
#: draws examples leaves elements free on purpose, for results or for nothing.
SHARE_POWER = 2.0


def astray(lesson: Lesson, arrangement: Arrangement, matches: dict[str, Match], present: Array) -> Array:
    """What elements that examples have for themselves say against boxes that are beside none of them.

    Of the rule that a placement is beside an element of a label, every further element with an example is a
    confirmation, as far as examples agree in where they are beside it; the others are exceptions. By the rule of
    succession, the odds of another exception are these and half a one to all of them and that half. That holds as far
    as the elements of the label have their examples: where most are free, whether they are meant to have one is open.
    The label counts that says most against a box, by how little the box agrees with examples in it; elements that are
    smaller than examples do not, for those are drawn at placements, and not placements at them.

    Parameters
    ----------
    lesson : Lesson
    arrangement : Arrangement
    matches : dict of str to Match
        Of the boxes with all examples.
    present : ndarray of shape (m, 4)
        Positive examples drawn here.

    Returns
    -------
    ndarray of shape (n,)
        Logarithms of the factors of the odds, not above 0; 0 where none was drawn here.
    """
    against = np.zeros(len(next(iter(matches.values())).joint))
    if not len(present):
        return against
    for label, elements in arrangement.drawn.items():
        if BOX + label not in matches:
            continue
        own = np.unique(np.argmin(distances(present, elements), axis=1))
        if np.median(areas(elements[own])) < np.median(areas(present)):
            continue
        confirmations = len(own) - 1
        doubt = min((1.0 - lesson.reliability[BOX + label][2]) / NO_AGREEMENT, 1.0)
        value = np.log((confirmations * doubt + UNSEEN) / (confirmations + UNSEEN))
        missed = 1.0 - matches[BOX + label].joint[:, lesson.positive].max(axis=1)
        against = np.minimum(against, value * (len(own) / len(elements)) ** SHARE_POWER * missed)
    return against
