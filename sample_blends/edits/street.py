"""The edits that dress the street: two houses are shown how, the others follow.

Coordinates are those of a facade: x from its left edge, y from the pavement, in metres.
"""

from __future__ import annotations

from math import inf

from ..plans.street import CORNICE, FLOOR, FRIEZE, GROUND_FLOOR, house
from .edit import FacadeBox, PlacementEdit

#: The houses on which examples are given: the narrowest and the widest, the lowest and the highest.
SHOWN = ("house 1", "house 2")
#: What spans a facade may be of any size.
SPANNING = {"aspect_tolerance": inf, "area_tolerance": inf, "tau": 0.5}
#: Windows of a floor: their distance from the ends, and from the floor's foot; and from each other at least.
MARGIN, SILL_HEIGHT, GAP = 0.95, 0.95, 1.3
WINDOW = (1.1, 1.7)


def _across(low: float, high: float, left: float = 0.0, right: float = 0.0) -> tuple[FacadeBox, ...]:
    """A box across each of the shown facades; heights below 0 are measured from the top."""
    boxes = []
    for id in SHOWN:
        top = house(id).height
        low_, high_ = (y if y >= 0 else top + y for y in (low, high))
        boxes.append((id, left, low_, house(id).width - right, high_))
    return tuple(boxes)


def floor_foot(id: str, floor: int) -> float:
    """Height of the foot of a floor: they share what the frieze leaves."""
    spare = FRIEZE / (house(id).floors - 1)
    return GROUND_FLOOR + floor * (FLOOR + spare)


def _row(id: str, floor: int) -> FacadeBox:
    low = floor_foot(id, floor) + SILL_HEIGHT
    return (id, MARGIN, low, house(id).width - MARGIN, low + WINDOW[1])


def window_middle(id: str, floor: int, i: int) -> tuple[float, float]:
    """Centre of a window, as the repetition along the row puts it."""
    _, x0, low, x1, high = _row(id, floor)
    count = int((x1 - x0 + GAP) / (WINDOW[0] + GAP) + 1e-9)
    step = (x1 - x0 - WINDOW[0]) / (count - 1)
    return x0 + WINDOW[0] / 2 + i * step, (low + high) / 2


def _about(windows: tuple[tuple[str, int, int], ...], x: float, low: float, high: float) -> tuple[FacadeBox, ...]:
    """Boxes that reach so far to either side of the middles of windows, and so far up."""
    boxes = []
    for id, floor, i in windows:
        cx, cy = window_middle(id, floor, i)
        boxes.append((id, cx - x, cy + low, cx + x, cy + high))
    return tuple(boxes)


#: Doors: distance from the left edge, and size.
DOOR = (0.8, 1.3, 2.6)
SHOP_LEFT, SHOP_GAP, SHOP = 2.7, 0.45, 1.7


_WINDOWS = (
    ("house 1", 0, 0),
    ("house 1", 1, 1),
    ("house 2", 0, 1),
    ("house 2", 1, 2),
    ("house 2", 2, 3),
    ("house 2", 3, 0),
)
_ROWS = (("house 1", 0), ("house 1", 1), ("house 2", 1), ("house 2", 3))

EDITS = [
    PlacementEdit("ground floor", _across(0.0, GROUND_FLOOR), most=1, options=SPANNING),
    PlacementEdit("cornice", _across(-CORNICE, -1e-9), most=1, options=SPANNING),
    PlacementEdit("floor", _across(GROUND_FLOOR, -CORNICE), fit=("scale", "repeat"), most=1, options=SPANNING),
    PlacementEdit(
        "window",
        tuple(_row(id, floor) for id, floor in _ROWS),
        fit=("repeat", "scale"),
        gap=(GAP, 0.0),
        most=1,
        options=SPANNING,
    ),
    PlacementEdit("sill", _about(_WINDOWS, 0.7, -1.0, -0.85), threshold=0.67, options={"tau": 0.2}),
    # Both shutters of a window are one row of two, flush with its ends.
    PlacementEdit(
        "shutter", _about(_WINDOWS, 1.08, -0.85, 0.85), fit=("repeat", "scale"), gap=(1.0, 0.0), threshold=0.3
    ),
    PlacementEdit("door", tuple((id, DOOR[0], 0.0, DOOR[0] + DOOR[1], DOOR[2]) for id in SHOWN), most=1),
    PlacementEdit(
        "shop window",
        _across(0.35, 2.35, SHOP_LEFT, DOOR[0]),
        fit=("repeat", "scale"),
        gap=(SHOP_GAP, 0.0),
        most=1,
        options=SPANNING,
    ),
    PlacementEdit(
        "awning",
        _across(2.5, 3.0, SHOP_LEFT - 0.1, DOOR[0] - 0.1),
        fit=("repeat", "scale"),
        gap=(SHOP_GAP - 0.2, 0.0),
        most=1,
        options=SPANNING,
    ),
    # Wider than the windows of the row above by as much as they are less far apart: each is below one.
    PlacementEdit(
        "balcony",
        _across(GROUND_FLOOR - 0.1, GROUND_FLOOR + 0.78, MARGIN - 0.4, MARGIN - 0.4),
        fit=("repeat", "scale"),
        gap=(GAP - 0.8, 0.0),
        most=1,
        options=SPANNING,
    ),
    PlacementEdit("lamp", tuple((id, 2.24, 1.75, 2.5, 2.25) for id in SHOWN), most=1),
]
