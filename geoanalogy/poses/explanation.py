"""Which relations carry a pose (figure 4.14)."""

import numpy as np
from numpy.typing import NDArray

from ..relations.elements import ElementType
from .arrangement import Arrangement
from .batch import Batch
from .importance import Importance
from .results import RelationShare

Array = NDArray[np.float64]


def explain(importance: Importance, position: Array, angle: float) -> tuple[RelationShare, ...]:
    """Which relations carry one pose, with what weight.

    Parameters
    ----------
    importance : Importance
    position : ndarray of shape (2,)
    angle : float

    Returns
    -------
    tuple of RelationShare
        Largest first; their weights add up to the importance.
    """
    query = importance.query
    shares = []
    for rows in Batch([importance]).rows(np.zeros(1, dtype=np.intp)):
        element, a = rows.element, importance.answers[rows.element]
        misses = rows.misses(position[None], np.array([angle]))
        kernel, directional = rows.kernel(misses), rows.directional(misses)
        if directional is not None:
            kernel *= directional
        per_relation = np.add.reduceat(a.weight * kernel, a.pair_start, axis=1) * a.accuracy
        for start, end in zip(a.feature_start, np.append(a.feature_start[1:], len(a.accuracy)), strict=True):
            best = start + int(np.argmax(per_relation[:, start:end].sum(axis=0)))
            source = _place(query.arrangement, element, a.source_feature[best])
            target = _place(importance.target, element, a.target_feature[best])
            for relation, weight in zip(a.relations, per_relation[:, best], strict=True):
                if weight > 0:
                    share = float(weight / query.total)
                    shares.append(RelationShare(relation.name, source[0], target[0], source[1], target[1], share))
    return tuple(sorted(shares, key=lambda s: -s.weight))


def _place(arrangement: Arrangement, element: ElementType, feature: int) -> tuple[str, int]:
    """Id of the polygon of a feature, and the feature's number in it."""
    polygon_of = arrangement.elements.polygon_of(element)
    polygon = polygon_of[feature]
    return str(arrangement.elements.polygons[polygon].id), int(feature - np.flatnonzero(polygon_of == polygon)[0])
