"""Figure 4.15: the same edits in another order give another result, as good."""

import numpy as np

from .bathrooms import EDITS, ROOMS, SCENE
from .furnishing import Step, furnish

ORDERS = ("abcde", "eacbd")


def run(order: str) -> dict[str, Step]:
    """Apply the five edits in an order.

    Parameters
    ----------
    order : str
        The edits' names, one letter each.

    Returns
    -------
    dict of str to Step
        By the edit's name.
    """
    return dict(zip(order, furnish(SCENE, [EDITS[name] for name in order]), strict=True))


def differences(one: dict[str, Step], other: dict[str, Step], apart: float = 0.3) -> list[tuple[str, str]]:
    """The pieces that stand in different places after two orders.

    Parameters
    ----------
    one, other : dict of str to Step
        As `run` returns them.
    apart : float
        Least distance that counts, metres.

    Returns
    -------
    list of (str, str)
        Edit and room.
    """
    result = []
    for name in sorted(one):
        places = [{r.parent.id: r.pose.position for r in steps[name].results} for steps in (one, other)]
        for room in ROOMS[1:]:
            here = [p.get(room) for p in places]
            if None in here:
                if here != [None, None]:
                    result.append((name, room))
            elif np.hypot(*np.subtract(*here)) > apart:
                result.append((name, room))
    return result
