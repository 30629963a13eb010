"""The other places of a result: where else in its polygon the object answers the example (section 4.5).

A mirrored room has as good a place on the other side, and only the user knows which one is meant.
"""

from collections.abc import Sequence

import numpy as np

from ..geometry.polygon import Polygon
from .decisions import Decisions, Pin
from .element import Element
from .keys import find
from .pose_placement import too_near

#: Pins closer than this, in sizes of their polygon, are the same place.
SAME_PIN = 1e-6


def other_places(
    own: Element,
    proposed: Sequence[Element],
    standing: Sequence[Element],
    rejected: Sequence[str],
    spacing: float | None,
) -> list[Element]:
    """All places of a result's polygon that what else stands there leaves room for.

    Parameters
    ----------
    own : Element
        The result, as its operation proposed it.
    proposed : sequence of Element
        All that the operation proposed, best first.
    standing : sequence of Element
        What of it stands in the scene.
    rejected : sequence of str
        Keys of results that are not wanted.
    spacing : float or None
        Least distance between two of one polygon, scene units; None: as long as they do not intersect.

    Returns
    -------
    list of Element
        Best first; the result's own place among them, unless another one has been taken there.
    """
    others = [e for e in standing if _shares_polygon(e, own) and e.key != own.key]
    unwanted = set(find(rejected, [e.key for e in proposed]).values())
    return [
        e
        for e in proposed
        if _shares_polygon(e, own)
        and not e.example
        and e.key not in unwanted
        and not any(too_near(e, other, spacing) for other in others)
    ]


def taken_on(
    decisions: Decisions, own: Element, places: Sequence[Element], parent: Polygon, step: int
) -> Decisions | None:
    """The decisions with a result taken to another of its places, from the last one on to the first.

    Parameters
    ----------
    decisions : Decisions
        About the results by their present keys.
    own : Element
        The result, as its operation proposed it.
    places : sequence of Element
        As `other_places` returns them.
    parent : Polygon
        The polygon of the scene that they are in.
    step : int
        How many places further; negative: back.

    Returns
    -------
    Decisions or None
        None: there is no other place. What stands at none of them, moved by hand, comes to the first one.
    """
    pins = [Pin.of(e.pose, parent, e.scale) for e in places]
    stands = decisions.pinned.get(own.key) or Pin.of(own.pose, parent, own.scale)
    here = next((i for i, pin in enumerate(pins) if _is_same(pin, stands)), None)
    if not pins or (len(pins) == 1 and here == 0):
        return None
    to = ((step - (step > 0)) if here is None else here + step) % len(pins)
    if places[to].key != own.key:
        return decisions.pin(own.key, pins[to])
    back = decisions.forget(own.key)
    return back.accept(own.key) if own.key in decisions.accepted else back


def _shares_polygon(one: Element, other: Element) -> bool:
    return (one.surface, one.parent) == (other.surface, other.parent)


def _is_same(one: Pin, other: Pin) -> bool:
    turned = abs(np.angle(np.exp(1j * (one.angle - other.angle))))
    apart = np.hypot(*np.subtract(one.position, other.position))
    return one.parent == other.parent and one.mirrored == other.mirrored and max(turned, apart) < SAME_PIN
