"""Living-room furniture: seats, tables, television, bookshelf, lamp, plant."""

from __future__ import annotations

import numpy as np

from ..plans.outlines import centred_rectangle, circle, rounded
from .assets import asset
from .solids import Solid, box, cushion, cylinder, ellipsoid, extruded, joined, lathe, legs, tube


@asset("dining table", "furniture", centred_rectangle(1.8, 0.95))
def dining_table() -> Solid:
    """Dining table, long along X, with a runner and a fruit bowl."""
    rng = np.random.default_rng(3)
    fruit = [
        ellipsoid((0.045, 0.045, 0.043), (x, y, 0.07), finish, 10, 6)
        for (x, y), finish in zip(
            rng.uniform(-0.07, 0.07, (6, 2)), ("fruit red", "fruit green", "mustard cloth") * 2, strict=True
        )
    ]
    bowl = lathe([(0.06, 0.0), (0.15, 0.07), (0.16, 0.09), (0.145, 0.085), (0.05, 0.02)], "porcelain", 20)
    return joined(
        [
            extruded(rounded(centred_rectangle(1.8, 0.95), 0.06, 4), 0.71, 0.75, "oak", 0.008),
            box((1.5, 0.04, 0.07), (0.0, 0.38, 0.64), "oak"),
            box((1.5, 0.04, 0.07), (0.0, -0.38, 0.64), "oak"),
            legs(1.6, 0.78, 0.71, 0.026, "oak", top=0.042),
            box((1.3, 0.3, 0.006), (0.0, 0.0, 0.75), "linen", 0.0),
            joined([bowl, *fruit]).moved(0.0, 0.0, 0.756),
        ]
    )


@asset("dining chair", "furniture", centred_rectangle(0.5, 0.46), label="chair")
def dining_chair() -> Solid:
    """Chair; +X is where the sitter looks."""
    parts = [
        cushion((0.44, 0.44, 0.05), (0.02, 0.0, 0.43), "mustard cloth", 0.022, puff=0.01),
        box((0.42, 0.42, 0.03), (0.02, 0.0, 0.405), "oak"),
    ]
    for y in (-0.19, 0.19):
        parts.append(tube([(0.2, y, 0.0), (0.18, y, 0.41)], (0.016, 0.022), "oak", 8))
        parts.append(tube([(-0.22, y, 0.0), (-0.18, y, 0.42), (-0.23, y, 0.92)], (0.016, 0.022, 0.017), "oak", 8))
    for z in (0.58, 0.72, 0.84):
        arch = [(-0.2 - (z - 0.42) * 0.1 - 0.03 * (1 - (y / 0.19) ** 2), y, z) for y in np.linspace(-0.19, 0.19, 5)]
        parts.append(tube(arch, 0.018, "oak", 6))
    return joined(parts)


def _sofa(depth: float, width: float, seats: int, cloth: str, seat: str, throws: tuple[str, ...]) -> Solid:
    arm, back = 0.16, 0.18
    parts = [
        cushion((depth, width, 0.24), (0.0, 0.0, 0.1), cloth, 0.05),
        cushion((back, width, 0.72), (-depth / 2 + back / 2, 0.0, 0.1), cloth, 0.07),
    ]
    for side in (-1, 1):
        parts.append(cushion((depth, arm, 0.5), (0.0, side * (width - arm) / 2, 0.1), cloth, 0.07))
        for x in (-1, 1):
            foot = (x * (depth / 2 - 0.1), side * (width / 2 - 0.1), 0.0)
            parts.append(cylinder(0.018, 0.11, foot, "walnut", sides=8, top=0.026))
    inner = (width - 2 * arm) / seats
    for i in range(seats):
        y = (i - (seats - 1) / 2) * inner
        parts.append(cushion((depth - back, inner - 0.015, 0.17), (back / 2 + 0.01, y, 0.31), seat, 0.055, puff=0.025))
        rest = cushion((0.17, inner - 0.02, 0.4), (0.0, 0.0, 0.0), seat, 0.07).turned(-12, "y")
        parts.append(rest.moved(-depth / 2 + back + 0.1, y, 0.45))
    for i, finish in enumerate(throws):
        y = (1 if i % 2 else -1) * (width / 2 - arm - 0.22)
        pad = cushion((0.13, 0.38, 0.38), (0.0, 0.0, 0.0), finish, 0.06).turned(-24, "y").turned(12 if i % 2 else -12)
        parts.append(pad.moved(-depth / 2 + back + 0.25, y, 0.49))
    return joined(parts)


@asset("sofa", "furniture", centred_rectangle(0.95, 2.1))
def sofa() -> Solid:
    """Sofa for three; +X is where the sitters look."""
    return _sofa(0.95, 2.1, 3, "sofa cloth", "sofa seat", ("mustard cloth", "linen"))


@asset("armchair", "furniture", centred_rectangle(0.88, 0.86))
def armchair() -> Solid:
    """Armchair; +X is where the sitter looks."""
    return _sofa(0.88, 0.86, 1, "rust cloth", "rust seat", ())


@asset("coffee table", "furniture", centred_rectangle(0.62, 1.15))
def coffee_table() -> Solid:
    """Low table, long across +X, with magazines and a tray."""
    return joined(
        [
            extruded(rounded(centred_rectangle(0.62, 1.15), 0.14, 6), 0.36, 0.4, "walnut", 0.01),
            extruded(rounded(centred_rectangle(0.5, 1.0), 0.12, 5), 0.14, 0.16, "walnut", 0.006),
            legs(0.42, 0.9, 0.36, 0.016, "brass"),
            box((0.3, 0.22, 0.012), (0.02, 0.3, 0.4), "book red", 0.002),
            box((0.28, 0.2, 0.012), (0.02, 0.3, 0.412), "paper", 0.002).turned(4).moved(0.02, 0.0),
            cylinder(0.15, 0.015, (0.0, -0.25, 0.4), "brass", 0.005, 22),
            lathe([(0.03, 0.0), (0.045, 0.08), (0.04, 0.08), (0.025, 0.01)], "porcelain", 14, (0.04, -0.2, 0.415)),
            lathe([(0.03, 0.0), (0.045, 0.08), (0.04, 0.08), (0.025, 0.01)], "porcelain", 14, (-0.05, -0.3, 0.415)),
        ]
    )


@asset("television", "furniture", centred_rectangle(0.45, 1.6), label="television")
def television() -> Solid:
    """Television on a low board; the screen faces +X."""
    parts = [
        box((0.42, 1.6, 0.36), (-0.015, 0.0, 0.09), "oak", 0.008),
        box((0.34, 1.5, 0.09), (-0.02, 0.0, 0.0), "dark lacquer", 0.0),
        box((0.2, 0.44, 0.015), (-0.04, 0.0, 0.45), "black metal", 0.004),
        box((0.04, 0.1, 0.1), (-0.07, 0.0, 0.46), "black metal", 0.004),
        box((0.05, 1.28, 0.74), (-0.04, 0.0, 0.53), "black metal", 0.01),
        box((0.004, 1.24, 0.69), (-0.014, 0.0, 0.555), "screen image", 0.0),
        box((0.1, 0.9, 0.06), (0.08, 0.0, 0.45), "plastic", 0.015),
    ]
    for i in range(3):
        parts.append(box((0.02, 0.52, 0.32), (0.205, (i - 1) * 0.53, 0.11), "white lacquer", 0.006))
    return joined(parts)


@asset("bookshelf", "furniture", centred_rectangle(0.34, 1.2))
def bookshelf() -> Solid:
    """Open shelf full of books; +X is the side of their backs."""
    rng = np.random.default_rng(11)
    finishes = ("book red", "book blue", "book green", "book yellow", "book grey", "paper")
    parts = [
        box((0.34, 0.03, 2.0), (0.0, -0.585, 0.0), "oak", 0.004),
        box((0.34, 0.03, 2.0), (0.0, 0.585, 0.0), "oak", 0.004),
        box((0.34, 0.025, 1.9), (0.0, 0.0, 0.06), "oak", 0.004),
        box((0.012, 1.16, 1.96), (-0.16, 0.0, 0.02), "oak", 0.0),
    ]
    for z in np.linspace(0.05, 1.975, 6):
        parts.append(box((0.33, 1.15, 0.025), (0.0, 0.0, float(z)), "oak", 0.003))
    for z in np.linspace(0.05, 1.975, 6)[:-1]:
        for start in (-0.565, 0.02):
            y, end = start, start + float(rng.uniform(0.38, 0.54))
            while y < end:
                thick, tall, deep = rng.uniform(0.03, 0.065), rng.uniform(0.22, 0.32), rng.uniform(0.19, 0.25)
                at = (-0.03 + deep / 2 - 0.11, y + thick / 2, float(z) + 0.025)
                parts.append(box((deep, thick * 0.92, tall), at, finishes[rng.integers(len(finishes))], 0.0))
                y += thick
    parts.append(box((0.2, 0.28, 0.16), (0.0, -0.3, 2.0), "wicker", 0.01))
    parts.append(lathe([(0.06, 0.0), (0.09, 0.08), (0.05, 0.16), (0.06, 0.18)], "terracotta", 16, (0.0, 0.35, 2.0)))
    return joined(parts)


@asset("shelf", "furniture", centred_rectangle(0.45, 1.2))
def shelf() -> Solid:
    """Storage rack with boxes and baskets; +X is the open side."""
    rng = np.random.default_rng(17)
    parts = []
    for x in (-0.21, 0.21):
        for y in (-0.58, 0.58):
            parts.append(box((0.03, 0.03, 1.8), (x, y, 0.0), "grey lacquer", 0.0))
    for z in (0.12, 0.62, 1.12, 1.75):
        parts.append(box((0.44, 1.18, 0.03), (0.0, 0.0, z), "birch", 0.004))
        for y in (-0.38, 0.0, 0.38):
            height = float(rng.uniform(0.2, 0.34)) if z < 1.7 else float(rng.uniform(0.14, 0.26))
            finish = ("wicker", "paper", "coat blue", "birch", "towel")[rng.integers(5)]
            parts.append(box((0.36, 0.34, height), (0.01, y, z + 0.03), finish, 0.012))
            parts.append(box((0.375, 0.355, 0.03), (0.01, y, z + 0.03 + height), finish, 0.008))
    return joined(parts)


@asset("floor lamp", "furniture", circle(0.22, count=24), label="lamp")
def floor_lamp() -> Solid:
    """Floor lamp with a linen shade."""
    return joined(
        (
            cylinder(0.15, 0.03, (0.0, 0.0, 0.0), "brass", 0.01, 24),
            cylinder(0.013, 1.4, (0.0, 0.0, 0.03), "brass", sides=10),
            lathe([(0.22, 1.32), (0.15, 1.66), (0.145, 1.66), (0.215, 1.325)], "lamp shade", 28),
        )
    )


@asset("potted plant", "furniture", circle(0.3, count=24), label="plant")
def potted_plant() -> Solid:
    """Rubber plant in a terracotta pot."""
    rng = np.random.default_rng(23)
    parts = [
        lathe([(0.14, 0.0), (0.2, 0.34), (0.215, 0.34), (0.215, 0.4), (0.185, 0.4), (0.18, 0.34)], "terracotta", 22),
        cylinder(0.18, 0.01, (0.0, 0.0, 0.34), "soil", sides=22),
    ]
    for i in range(34):
        turn, reach = 137.5 * i, float(rng.uniform(0.22, 0.42))
        base, rise = 0.36 + 0.022 * i, float(rng.uniform(0.1, 0.25))
        reach *= 1.0 - 0.011 * i
        across = 0.24 * reach
        # A leaf is a gutter of three quads along its midrib, seen from both sides.
        rib = np.array([(0.02, 0.0), (0.35 * reach, 0.7 * rise), (0.75 * reach, rise), (1.05 * reach, 0.72 * rise)])
        breadth = np.array([0.01, across, across, 0.005])
        vertices = [
            (x, side * w, z + (0.02 if side else 0.0))
            for (x, z), w in zip(rib, breadth, strict=True)
            for side in (-1, 0, 1)
        ]
        faces = [(3 * k + s, 3 * k + 3 + s, 3 * k + 4 + s, 3 * k + 1 + s) for k in range(3) for s in (0, 1)]
        leaf = Solid(np.array(vertices), faces, ["pale leaf" if i % 5 == 0 else "leaf"] * len(faces))
        parts.append(leaf.turned(turn).moved(0.0, 0.0, base))
    parts.append(tube([(0.0, 0.0, 0.3), (0.015, 0.01, 0.8), (0.0, 0.0, 1.2)], (0.02, 0.015, 0.006), "bark", 6))
    return joined(parts)
