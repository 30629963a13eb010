"""Parts of facades: upright, the middle of their backs at the origin, their fronts towards -y."""

from __future__ import annotations

import numpy as np

from .parts import Part, entering
from .solids import Solid, box, cylinder

PARTS: dict[str, Part] = {}

part = entering(PARTS)


def _slab(x0: float, x1: float, z0: float, z1: float, depth: float, finish: str, bevel: float = 0.0) -> Solid:
    """A box on the wall between two corners."""
    return box((x1 - x0, depth, z1 - z0), ((x0 + x1) / 2, -depth / 2, z0), finish, bevel)


def _frame(x: float, z0: float, z1: float, post: float, depth: float, finish: str, bottom: bool = True) -> list[Solid]:
    """Posts at -x and x, a head and where asked a foot."""
    parts = [_slab(-x, -x + post, z0, z1, depth, finish), _slab(x - post, x, z0, z1, depth, finish)]
    parts.append(_slab(-x + post, x - post, z1 - post, z1, depth, finish))
    return [*parts, _slab(-x + post, x - post, z0, z0 + post, depth, finish)] if bottom else parts


@part("ground floor", 9.0, 3.6)
def ground_floor(width: float, height: float) -> list[Solid]:
    """Courses of stone between a plinth and a string course."""
    x, z = width / 2, -height / 2
    plinth, top, courses = 0.35, 0.2, 6
    rise = (height - plinth - top) / courses
    parts = [_slab(-x, x, z, z + plinth, 0.12, "granite", 0.02), _slab(-x, x, -z - top, -z, 0.14, "sandstone", 0.03)]
    parts.append(_slab(-x, x, z + plinth, -z - top, 0.02, "granite"))
    for i in range(courses):
        low = z + plinth + i * rise
        parts.append(_slab(-x, x, low + 0.015, low + rise - 0.015, 0.06, "sandstone", 0.012))
    return parts


@part("cornice", 9.0, 0.6)
def cornice(width: float, height: float) -> list[Solid]:
    """Three steps on a row of brackets."""
    x, z = width / 2, -height / 2
    parts = [
        _slab(-x, x, z, z + 0.12, 0.08, "marble", 0.01),
        _slab(-x, x, z + 0.12, z + 0.34, 0.14, "marble"),
        _slab(-x, x, z + 0.34, z + 0.44, 0.34, "marble", 0.01),
        _slab(-x, x, z + 0.44, -z, 0.46, "marble", 0.03),
    ]
    for centre in np.linspace(-x + 0.2, x - 0.2, 15):
        parts.append(_slab(centre - 0.09, centre + 0.09, z + 0.14, z + 0.34, 0.3, "marble", 0.02))
    return parts


@part("floor", 9.0, 3.2)
def floor(width: float, height: float) -> list[Solid]:
    """Quoins at both ends, a string course at the foot."""
    x, z = width / 2, -height / 2
    parts = [_slab(-x, x, z, z + 0.14, 0.08, "marble", 0.02)]
    stones, low = 6, z + 0.14
    rise = (height - 0.14) / stones
    for i in range(stones):
        wide = 0.26 if i % 2 else 0.18
        for x0, x1 in ((-x, -x + wide), (x - wide, x)):
            gap = 0.0 if i == stones - 1 else 0.015
            parts.append(_slab(x0, x1, low + i * rise, low + (i + 1) * rise - gap, 0.05, "marble"))
    return parts


@part("window", 1.1, 1.7)
def window(width: float, height: float) -> list[Solid]:
    """Two sashes in a surround of stone."""
    x, z = width / 2, height / 2
    parts = _frame(x, -z, z, 0.1, 0.1, "marble", bottom=False)
    parts.append(_slab(-x, x, z - 0.1, z, 0.15, "marble"))
    x, z0, z1 = x - 0.1, -z, z - 0.1
    parts.append(_slab(-x, x, z0, z1, 0.03, "pane"))
    parts += _frame(x, z0, z1, 0.06, 0.07, "white lacquer")
    parts.append(_slab(-0.035, 0.035, z0, z1, 0.07, "white lacquer"))
    parts.append(_slab(-x, x, z0 + 1.05, z0 + 1.1, 0.065, "white lacquer"))
    return parts


@part("sill", 1.4, 0.15)
def sill(width: float, height: float) -> list[Solid]:
    """A slab of stone on two brackets."""
    x, z = width / 2, height / 2
    parts = [_slab(-x, x, z - 0.09, z, 0.24, "marble", 0.015)]
    for centre in (-x + 0.15, x - 0.15):
        parts.append(_slab(centre - 0.07, centre + 0.07, -z, z - 0.09, 0.16, "marble", 0.01))
    return parts


@part("shutter", 0.5, 1.7)
def shutter(width: float, height: float) -> list[Solid]:
    """Slats in a frame."""
    x, z = width / 2, height / 2
    parts = _frame(x, -z, z, 0.06, 0.06, "shutter green")
    parts.append(_slab(-x, x, -0.04, 0.04, 0.06, "shutter green"))
    for low, high in ((-z + 0.06, -0.04), (0.04, z - 0.06)):
        count = 9
        for i in range(count):
            at = low + (i + 0.5) * (high - low) / count
            slat = box((width - 0.1, 0.012, 0.085), (0.0, 0.0, -0.0425), "shutter green", 0.0).turned(-35, "x")
            parts.append(slat.moved(0.0, -0.035, at))
    return parts


@part("door", 1.3, 2.6)
def door(width: float, height: float) -> list[Solid]:
    """A panelled leaf below a light, in a surround of stone, on a step."""
    x, z = width / 2, height / 2
    parts = _frame(x, -z, z, 0.16, 0.18, "marble", bottom=False)
    parts.append(_slab(-x, x, z - 0.18, z, 0.26, "marble", 0.02))
    x -= 0.16
    parts.append(_slab(-x, x, -z, -z + 0.12, 0.3, "granite", 0.01))
    parts.append(_slab(-x, x, -z + 0.12, z - 0.62, 0.09, "door green"))
    parts.append(_slab(-x, x, z - 0.62, z - 0.56, 0.11, "door green"))
    parts.append(_slab(-x, x, z - 0.56, z - 0.18, 0.08, "pane"))
    parts.append(_slab(-0.02, 0.02, z - 0.56, z - 0.18, 0.11, "door green"))
    for low, high in ((-z + 0.25, -z + 0.85), (-z + 1.0, z - 0.75)):
        for x0, x1 in ((-x + 0.08, -0.05), (0.05, x - 0.08)):
            parts.append(_slab(x0, x1, low, high, 0.12, "door green", 0.02))
    knob = cylinder(0.035, 0.1, (0.0, 0.0, 0.0), "brass", 0.01, 12).turned(90, "x")
    return [*parts, knob.moved(x - 0.06, -0.09, -0.2)]


@part("shop window", 1.7, 2.0)
def shop_window(width: float, height: float) -> list[Solid]:
    """Panes over a panelled riser."""
    x, z = width / 2, height / 2
    parts = _frame(x, -z, z, 0.09, 0.16, "dark lacquer")
    riser = -z + 0.5
    parts.append(_slab(-x + 0.09, x - 0.09, -z + 0.09, riser, 0.08, "door green"))
    parts.append(_slab(-x + 0.2, x - 0.2, -z + 0.17, riser - 0.08, 0.12, "door green", 0.02))
    parts.append(_slab(-x, x, riser, riser + 0.07, 0.2, "dark lacquer", 0.01))
    parts.append(_slab(-x + 0.09, x - 0.09, riser + 0.07, z - 0.09, 0.1, "shop pane"))
    for at in (-x / 3, x / 3):
        parts.append(_slab(at - 0.02, at + 0.02, z - 0.45, z - 0.09, 0.14, "dark lacquer"))
    parts.append(_slab(-x, x, z - 0.47, z - 0.42, 0.14, "dark lacquer"))
    return parts


@part("awning", 1.9, 0.5)
def awning(width: float, height: float) -> list[Solid]:
    """Striped cloth that slopes over the pavement, and its valance."""
    x, z, reach, hem, stripes = width / 2, height / 2, 0.95, 0.16, 8
    parts = []
    step = width / stripes
    for i in range(stripes):
        finish = "awning red" if i % 2 else "linen"
        x0, x1 = -x + i * step, -x + (i + 1) * step
        profile = [(0.0, z), (0.0, z - 0.03), (-reach, -z + hem - 0.03), (-reach, -z), (-reach - 0.02, -z)]
        profile.append((-reach - 0.02, -z + hem))
        vertices = [(px, y, at) for px in (x0, x1) for y, at in profile]
        count = len(profile)
        sides = [(k, (k + 1) % count, count + (k + 1) % count, count + k) for k in range(count)]
        faces = [tuple(range(count))[::-1], tuple(range(count, 2 * count)), *sides]
        parts.append(Solid(np.array(vertices), faces, [finish] * len(faces)))
    return parts


@part("balcony", 1.9, 0.85)
def balcony(width: float, height: float) -> list[Solid]:
    """A slab on two consoles, with a railing of iron."""
    x, z, reach = width / 2, height / 2, 0.55
    parts = [_slab(-x, x, -z, -z + 0.13, reach, "marble", 0.02)]
    bars = 17
    for i in range(bars):
        at = -x + 0.05 + i * (width - 0.1) / (bars - 1)
        parts.append(box((0.022, 0.022, height - 0.17), (at, -reach + 0.05, -z + 0.13), "black metal", 0.0))
    for side in (-x + 0.05, x - 0.05):
        for k in range(5):
            parts.append(
                box(
                    (0.022, 0.022, height - 0.17), (side, -0.04 - k * (reach - 0.09) / 5, -z + 0.13), "black metal", 0.0
                )
            )
        parts.append(box((0.045, reach - 0.03, 0.04), (side, -reach / 2, z - 0.04), "black metal", 0.0))
    parts.append(box((width, 0.05, 0.04), (0.0, -reach + 0.05, z - 0.04), "black metal", 0.0))
    return parts


@part("lamp", 0.26, 0.5)
def lamp(width: float, height: float) -> list[Solid]:
    """A lantern on a bracket."""
    z = height / 2
    glass = cylinder(0.075, 0.22, (0.0, -0.2, -z + 0.05), "lantern light", 0.0, 6, top=0.11)
    hood = cylinder(width / 2, 0.12, (0.0, -0.2, -z + 0.27), "black metal", 0.0, 6, top=0.02)
    foot = cylinder(0.05, 0.05, (0.0, -0.2, -z), "black metal", 0.0, 6)
    arm = box((0.03, 0.2, 0.03), (0.0, -0.1, z - 0.1), "black metal", 0.0)
    return [glass, hood, foot, arm, _slab(-0.05, 0.05, z - 0.22, z, 0.03, "black metal")]
