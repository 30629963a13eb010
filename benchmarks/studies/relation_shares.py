"""Figure 4.14: which relations carry which piece, in a sequence of edits."""

from collections.abc import Iterable

import geoanalogy as ga

from .bathrooms import EDITS, OPTIONS, SCENE
from .furnishing import Step, furnish

RELATIONS = OPTIONS.relations
SEQUENCE = "abcde"

#: Share of a result's importance from which a relation is used.
USED = 0.02


def run() -> list[Step]:
    """Apply the five edits one after the other.

    Returns
    -------
    list of Step
    """
    return furnish(SCENE, [EDITS[name] for name in SEQUENCE])


def shares(result: ga.PropagatedPose) -> dict[str, float]:
    """What each relation contributes to a result, by its name.

    Parameters
    ----------
    result : PropagatedPose

    Returns
    -------
    dict of str to float
        They add up to the result's importance before it was lowered for being scaled.
    """
    total = dict.fromkeys(RELATIONS, 0.0)
    for share in result.relations:
        total[share.relation] += share.weight
    return total


def asked(step: Step) -> dict[str, float]:
    """What each relation contributes to a perfect copy: the histogram of the example itself.

    Parameters
    ----------
    step : Step

    Returns
    -------
    dict of str to float
        They add up to 1.
    """
    query = step.model.query
    weights = {
        relation.name: float(question.weight[k].sum() / query.total)
        for question in query.questions.values()
        for k, relation in enumerate(question.relations)
    }
    return {name: weights[name] for name in RELATIONS}


def used(steps: Iterable[Step]) -> list[set[str]]:
    """The relations that each edit's results use.

    Parameters
    ----------
    steps : iterable of Step

    Returns
    -------
    list of set of str
    """
    return [
        {name for r in step.results for name, share in shares(r).items() if share >= USED * r.importance}
        for step in steps
    ]
