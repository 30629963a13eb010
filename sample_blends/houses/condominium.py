"""The condominium: three to five storeys under a mansard or a flat roof with an attic, loggias to the garden."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from geoanalogy.geometry.roof import Roof

from .parts import GARDEN, PAVED, SIDE, STREET, bars, over, windows
from .recorder import Box, Recorder, Sheet

PLOT = "condominium"

#: From floor to floor, and what walls are higher than their floors, metres.
STOREY, ABOVE = 3.1, 1.0


def tall(storeys: int) -> float:
    """Height of walls, so that their front and their rear have the same rows."""
    return STOREY * storeys + ABOVE


def body(s: Sheet) -> Sequence[Box]:
    x0, y0, x1, _ = s.edges
    return [(x0 + 2, y0 + 4, x1 - 4, y0 + 16)]


def wing(s: Sheet) -> Sequence[Box]:
    return [(x1 - 10, y1 - 1.0, x1, y1 + 4.4) for _, _, x1, y1 in s.boxes("block")]


def risalit(s: Sheet) -> Sequence[Box]:
    return [((x0 + x1) / 2 - 3, y0 - 1.2, (x0 + x1) / 2 + 3, y0 + 1.0) for x0, y0, x1, _ in s.boxes("block")]


def cornice(s: Sheet) -> Sequence[Box]:
    x0, _, x1, y1 = s.edges
    return [(x0, y1 - 0.45, x1, y1 - 0.1)]


def entrance(s: Sheet) -> Sequence[Box]:
    x0, y0, x1, _ = s.edges
    return [((x0 + x1) / 2 - 1.0, y0, (x0 + x1) / 2 + 1.0, y0 + 2.4)]


def street_windows(s: Sheet) -> Sequence[Box]:
    x0, y0, x1, y1 = s.edges
    return [(x0 + 1.2, y0 + 1.2, x1 - 1.2, y1 - 1.1)] if s.width > 4 else []


def stair_windows(s: Sheet) -> Sequence[Box]:
    x0, _, x1, y1 = s.edges
    return [((x0 + x1) / 2 - 0.8, d[3] + 0.9, (x0 + x1) / 2 + 0.8, y1 - 0.8) for d in s.boxes("entrance")]


def side_windows(s: Sheet) -> Sequence[Box]:
    x0, y0, x1, y1 = s.edges
    return [(x0 + 1.8, y0 + 1.2, x1 - 1.8, y1 - 1.1)] if s.width > 8 else []


def loggias(s: Sheet) -> Sequence[Box]:
    x0, y0, x1, y1 = s.edges
    return [(x0 + 1.0, y0 + 0.9, x1 - 1.0, y1 - 0.8)] if s.width > 8 else []


def parapet(s: Sheet) -> Sequence[Box]:
    """Along the outer edge of a loggia's floor."""
    x0, y0, x1, _ = s.edges
    return [(x0, y0 + 0.05, x1, y0 + 0.17)]


def attic(s: Sheet) -> Sequence[Box]:
    x0, y0, x1, y1 = s.edges
    return [(x0 + 1.5, y0 + 1.5, x1 - 1.5, y1 - 1.5)] if s.height > 10 else []


def attic_windows(s: Sheet) -> Sequence[Box]:
    x0, y0, x1, y1 = s.edges
    return [(x0 + 1.2, y0 + 0.6, x1 - 1.2, y1 - 0.5)]


def plant(s: Sheet) -> Sequence[Box]:
    x0, y0, x1, y1 = s.edges
    return (
        [((x0 + x1) / 2 - 1.5, (y0 + y1) / 2 - 1.2, (x0 + x1) / 2 + 1.5, (y0 + y1) / 2 + 1.2)] if s.height > 6 else []
    )


def parking(s: Sheet) -> Sequence[Box]:
    x0, _, x1, y1 = s.edges
    return [(x0 + 1, y1 - 5.5, x1 - 0.4, y1 - 0.5)]


def drive(s: Sheet) -> Sequence[Box]:
    """Along the right side, from the street into the parking."""
    _, y0, x1, _ = s.edges
    return [(x1 - 3.4, y0, x1 - 0.4, p[1] + 0.4) for p in s.boxes("parking")]


def walk(s: Sheet) -> Sequence[Box]:
    _, y0, _, _ = s.edges
    return [((b[0] + b[2]) / 2 - 1.2, y0, (b[0] + b[2]) / 2 + 1.2, b[1]) for b in s.boxes("stairs")]


def left_hedge(s: Sheet) -> Sequence[Box]:
    x0, y0, _, _ = s.edges
    return [(x0 + 0.3, y0 + 0.3, w[0] - 0.8, y0 + 1.0) for w in s.boxes("walk")]


def right_hedge(s: Sheet) -> Sequence[Box]:
    _, y0, _, _ = s.edges
    return [(w[2] + 0.8, y0 + 0.3, d[0] - 0.6, y0 + 1.0) for w in s.boxes("walk") for d in s.boxes("drive")]


def record(r: Recorder) -> None:
    """Record the operations on the plots of the recorder's scene."""
    steep = Roof("mansard", float(np.radians(15.0)), float(np.radians(68.0)), 2.4)
    r.place("block", PLOT, body, 4, max_per={PLOT: 1})
    r.place("stairs", PLOT, risalit, 4, max_per={PLOT: 1})
    low, high, lower, higher = r.select(PLOT, (1.0, 1.0, 1.0, 1.0))
    ends = []
    for chosen, storeys in ((low, 3), (high, 4)):
        r.at = (chosen,)
        r.extrude("block", tall(storeys), roof=steep, side="wall")
        ends += r.at
    r.at = (lower, higher)
    r.place("wing", PLOT, wing, 4, max_per={PLOT: 1})
    r.extrude("wing", tall(2), side="wall", top="wing terrace")
    (winged,) = r.at
    for chosen, storeys in ((lower, 4), (higher, 5)):
        r.at = (chosen,)
        r.extrude("block", tall(storeys), side="wall", top="terrace")
        ends += r.at
    r.at = (*ends, winged)
    r.extrude("stairs", 8.9, side="stair wall", top="porch terrace")
    r.merge("block", "siblings")
    # What takes a solid as a whole comes before the many things on its walls, which it would have to carry along.
    r.place("attic", "terrace", attic, 4, max_per={"terrace": 1})
    r.extrude("attic", 2.6, side="attic wall", top="attic terrace")
    r.merge("attic")
    side = "attic wall"
    r.place(
        "attic window",
        side,
        attic_windows,
        4,
        size=(1.8, 1.5),
        gap=(1.4, 1.0),
        fit=("repeat", "repeat"),
        max_per={side: 1},
    )
    r.recess("attic window", 0.15, "attic glass")
    r.place("plant", "attic terrace", plant, 4, max_per={"attic terrace": 1})
    r.attach("plant", 1.1)

    front = "street stair wall"
    r.place("entrance", front, entrance, 4, max_per={front: 1})
    r.recess("entrance", 0.5, "entrance door")
    r.place("canopy", front, over("entrance", 0.5, 0.1, 0.3), 4, max_per={front: 1})
    r.attach("canopy", 1.2)
    windows(r, "stair window", front, stair_windows, (1.6, 1.5), (1.0, 1.5))
    r.place("cornice", STREET, cornice, 4, max_per={STREET: 1})
    r.attach("cornice", 0.2)
    windows(r, "window", STREET, street_windows, (1.5, 1.6), (1.3, 1.5))
    bars(r, "window")

    windows(r, "side window", SIDE, side_windows, (1.1, 1.6), (2.4, 1.5))
    r.place(
        "loggia", GARDEN, loggias, 5, size=(2.6, 2.3), gap=(0.9, 0.8), fit=("repeat", "repeat"), max_per={GARDEN: 1}
    )
    r.recess("loggia", 1.2, "loggia glass", "loggia reveal")
    floor = "lower loggia reveal"
    r.place("balcony", floor, parapet, 2, max_per={floor: 1})
    r.attach("balcony", 1.0)

    r.place("parking", PLOT, parking, 4, max_per={PLOT: 1})
    r.extrude("parking", 1.5 * PAVED)
    r.place("drive", PLOT, drive, 4, max_per={PLOT: 1})
    r.extrude("drive", PAVED)
    r.place("walk", PLOT, walk, 4, max_per={PLOT: 1})
    r.extrude("walk", PAVED)
    r.place("hedge", PLOT, left_hedge, 4, max_per={PLOT: 1})
    r.place("hedge", PLOT, right_hedge, 4, max_per={PLOT: 1})
    r.extrude("hedge", 0.9, (0.8, 1.3))
