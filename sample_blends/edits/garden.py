"""The 27 edits that plant and furnish the palace garden."""

from __future__ import annotations

import numpy as np

from ..library.flowers import RING_CENTRE
from ..plans.garden import CENTRE, ROUND_EAST
from .edit import AnyEdit, ArrayEdit, Edit, GroupEdit, Place, ScatterEdit

FIXED = {"scale": "fixed"}
MIRRORED = {**FIXED, "mirror": True}
#: In the middle of a parcel all sides count alike: by the distance alone, none would.
CENTRED = {**FIXED, "accumulation": "plane", "local_importance": "constant"}

ROUND_BED = (11.4, 58.2)


#: Away from all that is laid out.
WILD = {**FIXED, "clearance": {"flower bed": 12.0, "small fountain": 4.0, "bush": 1.0}}

#: Not between the trees of a row.
HEDGE = {**MIRRORED, "clearance": {"conifer": 1.6}}


def _about(centre: tuple[float, float], radius: float, angle: float, look: float) -> Place:
    """Place on a circle; ``look`` is its direction relative to the way out."""
    a = np.radians(angle)
    return (centre[0] + radius * float(np.cos(a)), centre[1] + radius * float(np.sin(a)), angle + look)


def _flowers() -> tuple[tuple[str, Place], ...]:
    """What stands within the border of the round bed: a ring of flowers about a topiary."""
    kinds = ("violet flower", "white flower")
    ring = [(kinds[i % 2], _about(ROUND_BED, 0.72, 60.0 * i, 0.0)) for i in range(6)]
    return (*ring, ("topiary spiral", (*ROUND_BED, 0.0)))


EDITS: list[AnyEdit] = [
    # fountains, and bushes around them
    Edit("fountain", (*CENTRE, 0.0), threshold=0.6, options=CENTRED),
    ArrayEdit("bush", _about(CENTRE, 3.7, 15.0, 0.0), None, 1.75, FIXED, {"even": True}),
    Edit("small fountain", (*ROUND_EAST, 0.0), most=1, threshold=0.4, options=CENTRED),
    ArrayEdit("bush", _about(ROUND_EAST, 2.4, 0.0, 0.0), None, 1.5, FIXED, {"even": True}),
    # flower beds
    Edit("hollow flower bed", (17.5, 43.5, 0.0), most=1, threshold=0.5, options=CENTRED),
    Edit("ring flower bed", _about(CENTRE, RING_CENTRE, 45.0, 180.0), most=1, threshold=0.5, options=MIRRORED),
    Edit("rectangular flower bed", (14.25, 0.0, 0.0), most=1, threshold=0.75, options=CENTRED),
    Edit("round flower bed", (*ROUND_BED, 0.0), most=1, threshold=0.5, options={**CENTRED, "mirror": True}),
    # single things in the parcels
    Edit("pagoda", (44.0, 51.0, 0.0), most=1, threshold=0.5, options=MIRRORED),
    Edit("statue", (6.0, 47.4, -90.0), most=2, threshold=0.5, options=MIRRORED),
    # rows on the ways
    ArrayEdit("topiary spiral", (2.8, -5.0, 90.0), (2.8, 18.4, 90.0), 2.6, MIRRORED),
    ArrayEdit("lantern", (26.2, -5.0, 90.0), (26.2, 48.5, 90.0), 9.0, MIRRORED),
    ArrayEdit("bench", _about(CENTRE, 9.6, 22.5, 180.0), None, 7.54, FIXED, {"even": True}),
    # rows of trees, and trees at random where there are no flowers
    ArrayEdit("conifer", (48.8, 43.8, 90.0), (48.8, 55.8, 90.0), 3.0, {**WILD, "mirror": True}),
    ArrayEdit("small tree", (22.8, 35.4, 90.0), (22.8, 47.8, 90.0), 3.1, MIRRORED),
    ArrayEdit("flower urn", (6.4, 53.0, 0.0), None, 5.0, MIRRORED),
    ScatterEdit("broad-leaved tree", (44.0, 70.0, 0.0), {"count": 9, "spacing": 4.4}, options=WILD),
    # flowers, and hedges around the parcels
    ArrayEdit(
        "red flower", _about(ROUND_BED, 1.42, 0.0, 0.0), None, 0.72, FIXED, {"even": True, "threshold": 0.1}, 0.1
    ),
    GroupEdit(_flowers(), {"corners": False}),
    ArrayEdit("box hedge", (4.8, 49.4, 180.0), (24.4, 34.2, 90.0), 1.25, HEDGE, {"way": "right"}),
]
