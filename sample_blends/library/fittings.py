"""Fittings of kitchens: the middle of their backs at the origin, x to the right, y up, z out of what they are fixed to.

On a worktop, y runs away from the wall.
"""

from __future__ import annotations

import numpy as np

from .parts import Part, entering
from .solids import Solid, box, cylinder, ellipsoid, lathe, loft, tube

FITTINGS: dict[str, Part] = {}

fitting = entering(FITTINGS)


def _panel(
    x0: float, y0: float, x1: float, y1: float, out: float, finish: str, back: float = 0.0, bevel: float = 0.004
) -> Solid:
    """A box between two corners, from and to so far out of the surface."""
    return box((x1 - x0, y1 - y0, out - back), ((x0 + x1) / 2, (y0 + y1) / 2, back), finish, bevel)


def _bar(start: tuple[float, float], end: tuple[float, float], out: float, finish: str = "steel") -> Solid:
    """A handle: a bar on two feet."""
    (x0, y0), (x1, y1) = start, end
    path = [(x0, y0, 0.0), (x0, y0, out), (x1, y1, out), (x1, y1, 0.0)]
    return tube(path, 0.006, finish, 6)


@fitting("cabinet door", 0.5, 0.74)
def cabinet_door(width: float, height: float) -> list[Solid]:
    """A drawer over a door."""
    x, y = width / 2 - 0.003, height / 2 - 0.003
    split = y - 0.17
    return [
        _panel(-x, -y, x, split, 0.02, "sage lacquer"),
        _panel(-x, split + 0.006, x, y, 0.02, "sage lacquer"),
        _bar((-0.07, y - 0.08), (0.07, y - 0.08), 0.045, "brass"),
        _bar((-0.07, split - 0.06), (0.07, split - 0.06), 0.045, "brass"),
    ]


@fitting("drawers", 0.7, 0.74)
def drawers(width: float, height: float) -> list[Solid]:
    """Three wide drawers."""
    x, made = width / 2 - 0.003, []
    for low, high in ((0.0, 0.36), (0.36, 0.74), (0.74, 1.0)):
        y0, y1 = (low - 0.5) * height + 0.003, (high - 0.5) * height - 0.003
        made += [
            _panel(-x, y0, x, y1, 0.02, "sage lacquer"),
            _bar((-0.12, y1 - 0.06), (0.12, y1 - 0.06), 0.045, "brass"),
        ]
    return made


@fitting("wall door", 0.5, 0.7)
def wall_door(width: float, height: float) -> list[Solid]:
    """The door of a wall cabinet."""
    x, y = width / 2 - 0.003, height / 2 - 0.003
    return [_panel(-x, -y, x, y, 0.02, "cream lacquer"), _bar((-0.06, -y + 0.05), (0.06, -y + 0.05), 0.045, "brass")]


@fitting("glass door", 0.5, 0.7)
def glass_door(width: float, height: float) -> list[Solid]:
    """The glazed door of a wall cabinet."""
    x, y, post = width / 2 - 0.003, height / 2 - 0.003, 0.06
    posts = [
        _panel(-x, -y, -x + post, y, 0.02, "cream lacquer"),
        _panel(x - post, -y, x, y, 0.02, "cream lacquer"),
        _panel(-x + post, -y, x - post, -y + post, 0.02, "cream lacquer"),
        _panel(-x + post, y - post, x - post, y, 0.02, "cream lacquer"),
    ]
    return [
        *posts,
        _panel(-x + post, -y + post, x - post, y - post, 0.008, "porcelain"),
        _bar((x - 0.03, -0.08), (x - 0.03, 0.08), 0.045, "brass"),
    ]


@fitting("oven", 0.6, 0.74)
def oven(width: float, height: float) -> list[Solid]:
    """The front of an oven: knobs over a door with a window."""
    x, y = width / 2 - 0.003, height / 2 - 0.003
    knobs = [cylinder(0.018, 0.03, (u, y - 0.055, 0.02), "plastic", 0.004, 12) for u in (-0.22, -0.14, 0.14, 0.22)]
    return [
        _panel(-x, y - 0.11, x, y, 0.02, "steel"),
        _panel(-0.08, y - 0.08, 0.08, y - 0.03, 0.023, "screen", 0.02, 0.0),
        _panel(-x, -y + 0.12, x, y - 0.115, 0.025, "steel"),
        _panel(-x + 0.07, -y + 0.19, x - 0.07, y - 0.23, 0.028, "screen", 0.02, 0.0),
        _bar((-x + 0.05, y - 0.17), (x - 0.05, y - 0.17), 0.07),
        _panel(-x, -y, x, -y + 0.115, 0.02, "sage lacquer"),
        *knobs,
    ]


@fitting("dishwasher front", 0.6, 0.74, "dishwasher")
def dishwasher_front(width: float, height: float) -> list[Solid]:
    """The front of a dishwasher."""
    x, y = width / 2 - 0.003, height / 2 - 0.003
    return [
        _panel(-x, -y, x, y - 0.115, 0.022, "steel"),
        _panel(-x, y - 0.11, x, y, 0.022, "grey lacquer"),
        _panel(0.04, y - 0.08, 0.2, y - 0.035, 0.025, "screen", 0.02, 0.0),
        _bar((-x + 0.06, y - 0.16), (x - 0.06, y - 0.16), 0.06),
    ]


@fitting("fridge doors", 0.64, 2.0, "fridge")
def fridge_doors(width: float, height: float) -> list[Solid]:
    """The doors of a fridge over those of a freezer."""
    x, y = width / 2 - 0.004, height / 2 - 0.004
    split = -y + 0.34 * height
    return [
        _panel(-x, -y, x, split - 0.004, 0.04, "white lacquer", bevel=0.01),
        _panel(-x, split + 0.004, x, y, 0.04, "white lacquer", bevel=0.01),
        _bar((-x + 0.05, split - 0.4), (-x + 0.05, split - 0.06), 0.09),
        _bar((-x + 0.05, split + 0.06), (-x + 0.05, split + 0.55), 0.09),
        _panel(0.05, split + 0.5, 0.16, split + 0.64, 0.043, "book yellow", 0.04, 0.0),
        _panel(-0.1, split + 0.66, -0.02, split + 0.76, 0.043, "book red", 0.04, 0.0),
    ]


@fitting("chimney hood", 0.6, 1.0, "hood")
def chimney_hood(width: float, height: float) -> list[Solid]:
    """A hood under a chimney."""
    x, y = width / 2, height / 2
    low = [(-x, -y, 0.0), (x, -y, 0.0), (x, -y, 0.5), (-x, -y, 0.5)]
    lip = [(u, v + 0.06, w) for u, v, w in low]
    neck = [(-0.13, -y + 0.26, 0.0), (0.13, -y + 0.26, 0.0), (0.13, -y + 0.26, 0.26), (-0.13, -y + 0.26, 0.26)]
    top = [(u, y, w) for u, _, w in neck]
    return [loft([np.array(ring, float)[::-1] for ring in (low, lip, neck, top)], "steel")]


@fitting("flat hood", 0.6, 1.0, "hood")
def flat_hood(width: float, height: float) -> list[Solid]:
    """A flat hood with a square chimney."""
    x, y = width / 2, height / 2
    return [
        _panel(-x, -y, x, -y + 0.06, 0.5, "steel", bevel=0.008),
        _panel(-x + 0.02, -y + 0.06, x - 0.02, -y + 0.07, 0.48, "screen", bevel=0.0),
        _panel(-0.15, -y + 0.07, 0.15, y, 0.3, "steel", bevel=0.006),
    ]


@fitting("inset sink", 0.84, 0.46, "sink")
def inset_sink(width: float, height: float) -> list[Solid]:
    """A basin with a drainer and a tap, on a worktop."""
    x, y = width / 2, height / 2
    tap = [
        (-0.2, -y + 0.05, 0.0),
        (-0.2, -y + 0.05, 0.26),
        (-0.2, -y + 0.1, 0.31),
        (-0.2, -y + 0.2, 0.3),
        (-0.2, -y + 0.22, 0.25),
    ]
    grooves = [
        _panel(u, -y + 0.08, u + 0.012, y - 0.05, 0.008, "grey lacquer", 0.005, 0.0)
        for u in (0.08, 0.15, 0.22, 0.29, 0.36)
    ]
    return [
        _panel(-x, -y, x, y, 0.006, "steel"),
        _panel(-x + 0.04, -y + 0.09, -0.01, y - 0.03, 0.0075, "grey lacquer", 0.004, 0.0),
        _panel(-x + 0.07, -y + 0.12, -0.04, y - 0.06, 0.0085, "plastic", 0.004, 0.0),
        *grooves,
        cylinder(0.028, 0.03, (-0.2, -y + 0.05, 0.0), "steel", 0.006, 14),
        tube(tap, 0.013, "steel", 10),
        tube([(-0.17, -y + 0.05, 0.06), (-0.11, -y + 0.07, 0.09)], 0.008, "steel", 6),
    ]


@fitting("hob", 0.58, 0.5)
def hob(width: float, height: float) -> list[Solid]:
    """Four rings, and a pot on one of them."""
    places = ((-0.15, -0.1, 0.085), (0.15, -0.1, 0.07), (-0.15, 0.12, 0.07), (0.15, 0.12, 0.09))
    pot = [(0.085, 0.0), (0.09, 0.01), (0.09, 0.12), (0.095, 0.125), (0.0, 0.14)]
    return [
        _panel(-width / 2, -height / 2, width / 2, height / 2, 0.008, "hob"),
        *(cylinder(radius, 0.003, (x, y, 0.008), "hot ring", sides=24) for x, y, radius in places),
        lathe(pot, "steel", 22, (0.15, -0.1, 0.011)),
        cylinder(0.014, 0.03, (0.15, -0.1, 0.15), "plastic", 0.004, 10),
    ]


@fitting("kettle", 0.2, 0.2)
def kettle(width: float, height: float) -> list[Solid]:
    """An electric kettle."""
    body = [(0.075, 0.0), (0.08, 0.02), (0.065, 0.17), (0.05, 0.19), (0.0, 0.2)]
    return [
        lathe(body, "steel", 20),
        tube([(0.06, 0.0, 0.18), (0.12, 0.0, 0.16), (0.11, 0.0, 0.06), (0.07, 0.0, 0.04)], 0.01, "plastic", 8),
    ]


@fitting("jars", 0.4, 0.16)
def jars(width: float, height: float) -> list[Solid]:
    """Three jars and a bottle."""
    made = [
        cylinder(0.055, tall, (x, 0.0, 0.0), finish, 0.01, 16)
        for x, tall, finish in ((-0.13, 0.2, "terracotta"), (0.0, 0.16, "porcelain"), (0.1, 0.13, "porcelain"))
    ]
    return [
        *made,
        lathe(
            [(0.03, 0.0), (0.032, 0.16), (0.012, 0.21), (0.012, 0.27), (0.0, 0.275)], "coat blue", 12, (0.18, 0.03, 0.0)
        ),
    ]


@fitting("bread board", 0.4, 0.26)
def bread_board(width: float, height: float) -> list[Solid]:
    """A board with a loaf on it."""
    loaf = ellipsoid((0.13, 0.06, 0.06), (0.02, 0.0, 0.06), "wicker", 16, 8)
    return [_panel(-width / 2, -height / 2, width / 2, height / 2, 0.02, "birch", bevel=0.006), loaf]


@fitting("clock", 0.3, 0.3)
def clock(width: float, height: float) -> list[Solid]:
    """A round clock at ten past ten."""
    hands = [
        _panel(-0.006, 0.0, 0.006, 0.08, 0.034, "black metal", 0.03, 0.0).turned(52),
        _panel(-0.005, 0.0, 0.005, 0.115, 0.036, "black metal", 0.03, 0.0).turned(-60),
    ]
    return [
        cylinder(width / 2, 0.03, (0.0, 0.0, 0.0), "black metal", 0.006, 28),
        cylinder(width / 2 - 0.015, 0.002, (0.0, 0.0, 0.03), "porcelain", sides=28),
        *hands,
    ]


@fitting("radiator", 1.0, 0.6)
def radiator(width: float, height: float) -> list[Solid]:
    """A row of ribs."""
    count = 12
    return [
        _panel(
            (i / count - 0.5) * width + 0.008,
            -height / 2,
            ((i + 1) / count - 0.5) * width - 0.008,
            height / 2,
            0.11,
            "white lacquer",
            0.03,
            0.01,
        )
        for i in range(count)
    ]


@fitting("door handle", 0.14, 0.2)
def door_handle(width: float, height: float) -> list[Solid]:
    """A handle on its plate."""
    path = [(0.04, 0.04, 0.0), (0.04, 0.04, 0.05), (-0.07, 0.04, 0.05)]
    return [_panel(0.02, -height / 2, 0.06, height / 2, 0.008, "steel", bevel=0.002), tube(path, 0.009, "steel", 8)]


@fitting("light switch", 0.08, 0.08)
def light_switch(width: float, height: float) -> list[Solid]:
    """A switch."""
    return [
        _panel(-0.04, -0.04, 0.04, 0.04, 0.01, "white lacquer"),
        _panel(-0.025, -0.03, 0.025, 0.03, 0.014, "porcelain", 0.01, 0.002),
    ]
