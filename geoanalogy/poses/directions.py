"""The directions that a footprint is tried in: along the features that answer (section 4.5)."""

import numpy as np
from numpy.typing import NDArray

from ..relations.elements import ElementType
from ..relations.table import Positional
from .importance import Importance
from .kernels import wrap

Array = NDArray[np.float64]

#: Most directions a footprint is tried in; the strongest suggestions that are tried as the middle of one; and the share
#: of all suggestions below which what is left is not worth a direction.
MOST_DIRECTIONS = 24
LEADS = 64
LEAST_SUGGESTED = 0.02

#: Number of different suggestions up to which all are compared with all at once.
FEW_DIRECTIONS = 256

#: Suggested directions nearer than this, in radians, are the same but for rounding.
SAME_DIRECTION = 1e-9


def directions_read(importance: Importance) -> list[Positional]:
    """The relations whose reference directions are read from fields.

    The places of the samples tell directions from corners better, and a straight segment has one everywhere.

    Parameters
    ----------
    importance : Importance

    Returns
    -------
    list of Positional
    """
    fixed = {ElementType.CORNER}
    if importance.target.elements.heading(ElementType.SEGMENT) is not None:
        fixed.add(ElementType.SEGMENT)
    return [r for r in importance.relations if r.element not in fixed]


def directions(importance: Importance) -> Array:
    """The directions a footprint may take: along the features that answer, as the example is along its own.

    Parameters
    ----------
    importance : Importance

    Returns
    -------
    ndarray of shape (d,)
        Radians; strongest first, at least most of the directional kernel's width apart.
    """
    a = importance.answers.get(ElementType.SEGMENT)
    if a is None:
        base = importance.target.parent.main_orientation - importance.query.arrangement.parent.main_orientation
        quarters = base + importance.query.pose.angle + np.arange(4) * np.pi / 2
        return quarters[importance.query.is_upright(quarters, importance.mirrored)]
    e = importance.target.elements
    strength = a.weight.sum(axis=0) * np.repeat(a.accuracy, a.per_pair)
    # A suggestion per edge and entry of its segment.
    if e.heading(ElementType.SEGMENT) is not None:  # an edge each
        entry = np.argsort(a.target, kind="stable")
        edge = a.target[entry]
        weight = strength[entry]
    else:
        edge, entry = np.nonzero(e.edge_segment[:, None] == a.target)
        weight = strength[entry] * (e.edge_length / e.segment_length[e.edge_segment])[edge]
    angle = (e.edge_heading[edge] + a.turn[0, entry]) % (2 * np.pi)
    upright = importance.query.is_upright(angle, importance.mirrored)
    angle, weight = angle[upright], weight[upright]
    # Most suggest one of a few directions.
    group = np.rint(angle / SAME_DIRECTION)
    _, first, same = np.unique(group, return_index=True, return_inverse=True)
    angle, weight = angle[first], np.bincount(same.ravel(), weights=weight)
    apart = 0.9 * importance.query.options.direction_width
    least = LEAST_SUGGESTED * weight.sum()
    left = weight.copy()
    few = len(angle) <= FEW_DIRECTIONS
    beside = np.abs(wrap(angle[:, None] - angle)) < apart if few else None
    result: list[float] = []
    while len(result) < MOST_DIRECTIONS and left.max(initial=0.0) > 0:
        # The angle that gathers most around it, then the mean of what it gathers.
        lead = np.argsort(-left, kind="stable")[:LEADS]
        near = np.abs(wrap(angle[lead][:, None] - angle)) < apart if beside is None else beside[lead]
        gathered = near @ left
        most = int(np.argmax(gathered))
        if result and gathered[most] < least:
            break
        best, middle = near[most], angle[lead[most]]
        share = np.maximum(left[best], 1e-12)
        mean = middle + (wrap(angle[best] - middle) @ share) / share.sum()
        result.append(float(mean % (2 * np.pi)))
        left[best] = 0.0
    return np.array(result)
