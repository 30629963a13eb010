"""The mass: a base, a shaft with setbacks in one of three shapes, and a crown in one of three shapes (figure 5.6)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from geoanalogy.geometry.roof import Roof

from ..houses.recorder import Box, Draw, Recorder, Sheet
from .lots import LOT

#: Rings in a square of side 1: with the corners cut off, and round.
OCTAGON = tuple(
    (x, y)
    for x, y in ((0.5, -0.2), (0.5, 0.2), (0.2, 0.5), (-0.2, 0.5), (-0.5, 0.2), (-0.5, -0.2), (-0.2, -0.5), (0.2, -0.5))
)
ROUND = tuple((round(0.5 * float(np.cos(a)), 6), round(0.5 * float(np.sin(a)), 6)) for a in np.arange(12) * np.pi / 6)

#: Width of the notches in the corners of shafts with wings.
NOTCH = 2.6

#: Seeds of the choices of shapes and crowns: in the lots that are recorded, each is seen more than once.
SHAPES, CROWNS = 8, 0


def inset(along: float, across: float | None = None) -> Draw:
    """All of the sheet but a margin."""

    def draw(s: Sheet) -> Sequence[Box]:
        x0, y0, x1, y1 = s.edges
        v = along if across is None else across
        return [(x0 + along, y0 + v, x1 - along, y1 - v)]

    return draw


def share(of: float) -> Draw:
    """A share of the sheet's width and height, in its middle."""

    def draw(s: Sheet) -> Sequence[Box]:
        x0, y0, x1, y1 = s.edges
        u, v = (1 - of) / 2 * (x1 - x0), (1 - of) / 2 * (y1 - y0)
        return [(x0 + u, y0 + v, x1 - u, y1 - v)]

    return draw


def corners(size: float, rear: bool) -> Draw:
    """A box in both corners at the front, or at the rear."""

    def draw(s: Sheet) -> Sequence[Box]:
        x0, y0, x1, y1 = s.edges
        y = y1 - size if rear else y0
        return [(x, y, x + size, y + size) for x in (x0, x1 - size)]

    return draw


def wings(label: str) -> Draw:
    """On the left and on the right of what has a label, nearly as deep."""

    def draw(s: Sheet) -> Sequence[Box]:
        found = []
        for x0, y0, x1, y1 in s.boxes(label):
            found += [(x0 - 3, y0 + 4, x0, y1 - 4), (x1, y0 + 4, x1 + 3, y1 - 4)]
        return found

    return draw


def in_corner(width: float, depth: float, off: float, right: bool, rear: bool) -> Draw:
    """A box of a size near a corner."""

    def draw(s: Sheet) -> Sequence[Box]:
        x0, y0, x1, y1 = s.edges
        x = x1 - off - width if right else x0 + off
        y = y1 - off - depth if rear else y0 + off
        return [(x, y, x + width, y + depth)]

    return draw


def shafts(r: Recorder) -> None:
    """Three shapes: with setbacks, octagonal, and with wings and notched corners."""
    podium, shaft = dict(side="base wall", top="podium terrace"), dict(side="middle wall", top="shaft terrace")
    ends = []
    stepped, octagonal, winged = r.select(LOT, (1.0, 1.0, 1.0), SHAPES)

    r.at = (stepped,)
    r.place("podium", LOT, inset(1.0), 4, max_per={LOT: 1})
    r.extrude("podium", 17.0, (0.85, 1.2), **podium)
    r.place("shaft", "podium terrace", inset(2.0, 3.0), 4, max_per={"podium terrace": 1})
    r.extrude("shaft", 52.0, (0.8, 1.3), side="middle wall", top="setback terrace")
    r.merge("shaft")
    r.place("setback", "setback terrace", inset(2.5), 4, max_per={"setback terrace": 1})
    r.extrude("setback", 30.0, (0.7, 1.3), **shaft)
    r.merge("setback")
    ends += r.at

    r.at = (octagonal,)
    r.place("podium", LOT, inset(1.5), 4, max_per={LOT: 1})
    r.extrude("podium", 15.0, (0.85, 1.2), **podium)
    r.place("drum", "podium terrace", inset(2.0), 4, outline=OCTAGON, max_per={"podium terrace": 1})
    r.extrude("drum", 78.0, (0.8, 1.25), **shaft)
    r.merge("drum")
    ends += r.at

    r.at = (winged,)
    r.place("podium", LOT, inset(0.8), 4, max_per={LOT: 1})
    r.extrude("podium", 18.0, (0.85, 1.2), **podium)
    r.place("shaft", "podium terrace", inset(5.0, 3.0), 4, max_per={"podium terrace": 1})
    r.place("wing", "podium terrace", wings("shaft"), 4, max_per={"podium terrace": 2})
    r.extrude("shaft", 84.0, (0.8, 1.25), side="winged wall", top="shaft terrace")
    r.extrude("wing", 46.0, (0.7, 1.2), side="middle wall", top="wing terrace")
    r.merge("shaft")
    r.merge("wing")
    for rear in (False, True):
        r.place("notch", "shaft terrace", corners(NOTCH, rear), 6, max_per={"shaft terrace": 2})
    r.extrude("notch", 26.0, (0.7, 1.3), inwards=True, side="notch wall", top="notch terrace")
    r.subtract("notch")
    r.at = (*ends, *r.at)


def crowns(r: Recorder) -> None:
    """A tower on the shaft; on that a pyramid, a flat roof with tanks, or steps and a spire."""
    r.place("tower", "shaft terrace", share(0.62), 5, max_per={"shaft terrace": 1})
    r.extrude("tower", 20.0, (0.7, 1.4), side="top wall", top="tower terrace")
    r.merge("tower")
    pointed, flat, stepped = r.select("tower terrace", (1.0, 1.0, 1.0), CROWNS)
    ends = []

    r.at = (pointed,)
    r.place("attic", "tower terrace", inset(0.8), 4, max_per={"tower terrace": 1})
    r.extrude("attic", 6.0, (0.8, 1.3), roof=Roof("hip", float(np.radians(58.0))), side="top wall")
    r.merge("attic")
    ends += r.at

    r.at = (flat,)
    r.place("parapet", "tower terrace", inset(0.0), 4, max_per={"tower terrace": 1})
    r.attach("parapet", 1.4, top="parapet top")
    r.place("well", "parapet top", inset(0.7), 4, max_per={"parapet top": 1})
    r.recess("well", 1.2, "roof deck", "parapet")
    r.place("bulkhead", "roof deck", in_corner(4.0, 3.4, 1.0, True, True), 4, max_per={"roof deck": 1})
    r.extrude("bulkhead", 4.2, (0.8, 1.3), side="bulkhead wall", top="bulkhead roof")
    r.place("tank stand", "roof deck", in_corner(3.0, 3.0, 1.2, False, False), 4, max_per={"roof deck": 1})
    r.extrude("tank stand", 2.4, side="tank stand", top="tank deck")
    r.place("tank", "tank deck", inset(0.0), 4, outline=ROUND, max_per={"tank deck": 1})
    r.extrude("tank", 3.6, roof=Roof("hip", float(np.radians(32.0))))
    ends += r.at

    r.at = (stepped,)
    r.place("lantern", "tower terrace", share(0.7), 4, outline=OCTAGON, max_per={"tower terrace": 1})
    r.extrude("lantern", 9.0, (0.8, 1.4), side="top wall", top="lantern terrace")
    r.merge("lantern")
    r.place("cupola", "lantern terrace", share(0.6), 4, outline=OCTAGON, max_per={"lantern terrace": 1})
    r.extrude("cupola", 5.0, (0.8, 1.4), roof=Roof("hip", float(np.radians(66.0))), side="cupola wall")
    r.merge("cupola")
    r.place("spire", "lantern terrace", share(0.14), 4, outline=OCTAGON, max_per={"lantern terrace": 1})
    r.extrude("spire", 16.0, (0.8, 1.3), roof=Roof("hip", float(np.radians(84.0))))
    r.at = (*ends, *r.at)


def record(r: Recorder) -> None:
    """Record the mass."""
    shafts(r)
    crowns(r)
