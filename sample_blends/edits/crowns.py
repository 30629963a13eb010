"""The edits that set the gems of the two crowns, on their unrolled outlines."""

from __future__ import annotations

import numpy as np

from ..plans.crowns import crown
from .edit import AnyEdit, ArrayEdit, Edit

#: A crown has many answers to one gem.
FIXED = {"scale": "fixed", "candidates": 30}
MIRRORED = {**FIXED, "mirror": True}
#: No two in one hollow.
APART = {**FIXED, "spacing": 0.03}

_ROYAL, _DUCAL = crown("royal crown"), crown("ducal crown")
#: The third peak of the royal crown, and the middle of the hollow to its left.
PEAK = float(_ROYAL.rim()[np.isclose(_ROYAL.rim()[:, 1], _ROYAL.height), 0][2])
HOLLOW = PEAK - _ROYAL.length / _ROYAL.periods / 2
#: The third low arch of the ducal crown, half a period before its third peak.
_DUCAL_PEAK = float(_DUCAL.rim()[np.isclose(_DUCAL.rim()[:, 1], _DUCAL.height), 0][2])
LOW_ARCH = _DUCAL_PEAK - _DUCAL.length / _DUCAL.periods / 2
UP = 90.0


def near(label: str, **options: object) -> dict[str, object]:
    """Options where above all the place beside one gem counts."""
    return {**FIXED, "relation_weights": {label: 4.0}, **options}


EDITS: list[AnyEdit] = [
    Edit("fleur-de-lis", (PEAK, 0.090, UP), threshold=0.25, options=FIXED),
    Edit("ruby", (PEAK, 0.052, UP), threshold=0.6, options=FIXED),
    Edit("diamond", (PEAK + 0.021, 0.050, UP), threshold=0.5, options=MIRRORED),
    Edit("pearl", (PEAK, 0.1115, UP), threshold=0.5, options=near("ornament")),
    Edit("emerald", (HOLLOW, 0.047, UP), threshold=0.5, options=APART),
    Edit("emerald", (LOW_ARCH, _DUCAL.origin[1] + 0.054, UP), threshold=0.5, options=APART),
    ArrayEdit("pearl", (0.0064, 0.0064, UP), (_ROYAL.length - 0.0064, 0.0064, UP), 0.0104, FIXED, {"way": "left"}),
]
