"""Drawings with known truth: lines an illustrator could have drawn, and where each target's points really are."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

Array = NDArray[np.float64]
Deformation = Callable[[Array], Array]

#: Points inside the query at which mappings are compared with the truth.
POINTS = 150


@dataclass(frozen=True)
class Scene:
    """A drawing, a query and the truth.

    Attributes
    ----------
    name : str
    lines : list of (n, 2) float
        The query's lines first.
    query : (k, 2) float
        A ring round the query's lines.
    outline : (n, 2) float
        Closed outline of the query's shape.
    points : (POINTS, 2) float
        Inside it.
    targets : list of callables
        The true mapping to each target.
    """

    name: str
    lines: list[Array]
    query: Array
    outline: Array
    points: Array
    targets: list[Deformation]

    def error(self, mapped: Array, target: Deformation) -> float:
        """Mean distance of mapped points from the truth, in per cent of the target's diagonal."""
        truth = target(self.points)
        gap = np.linalg.norm(mapped - truth, axis=1)
        return float(100.0 * gap.mean() / np.linalg.norm(np.ptp(target(self.outline), axis=0)))


def scene(name: str, own: Sequence[Array], targets: Sequence[Deformation], more: Sequence[Array] = ()) -> Scene:
    """A scene from the query's lines, the first of which is its outline, and deformations of them all."""
    outline = own[0]
    shape = shapely.make_valid(shapely.Polygon(outline))
    ring = shape.convex_hull.buffer(0.03 * np.sqrt(shape.area))
    rng = np.random.default_rng(len(name))
    low, high = outline.min(0), outline.max(0)
    some = rng.uniform(low, high, (60 * POINTS, 2))
    points = some[shapely.contains_xy(shape, *some.T)][:POINTS]
    lines = [*own, *(t(line) for t in targets for line in own), *more]
    return Scene(
        name, [np.asarray(line) for line in lines], shapely.get_coordinates(ring)[:-1], outline, points, list(targets)
    )


# ------------------------------------------------------------------------------------------------ lines


def spline(points: Sequence[tuple[float, float]], closed: bool = False, count: int = 160) -> Array:
    """A smooth line through points."""
    p = np.asarray(points, float)
    p = np.vstack([p, p[:1]]) if closed else p
    t = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(p, axis=0), axis=1))])
    return CubicSpline(t, p, bc_type="periodic" if closed else "natural")(np.linspace(0.0, t[-1], count))


def fish() -> list[Array]:
    """A fish that heads left: outline, gill, lateral line and eye."""
    outline = [(0, 0.02), (0.1, 0.12), (0.26, 0.2), (0.38, 0.33), (0.5, 0.21), (0.66, 0.13), (0.8, 0.06), (1, 0.22)]
    outline += [(0.93, 0.02), (0.97, -0.12), (0.8, -0.02), (0.62, -0.11), (0.52, -0.2), (0.46, -0.14), (0.24, -0.14)]
    turn = np.linspace(0, 2 * np.pi, 25)
    eye = np.stack([0.12 + 0.02 * np.cos(turn), 0.055 + 0.02 * np.sin(turn)], 1)
    gill = spline([(0.22, 0.13), (0.25, 0.06), (0.25, -0.02), (0.22, -0.08)], count=20)
    side = spline([(0.32, 0.04), (0.45, 0.06), (0.6, 0.04), (0.72, 0.03)], count=20)
    return [spline([*outline, (0.08, -0.07)], True), gill, side, eye]


def snake(marks: int = 8) -> list[Array]:
    """A straight snake of length 2: a head with eyes, a tail with a rattle, and marks that repeat on its back."""
    top = [(0.0, 0.02), (0.05, 0.1), (0.14, 0.14), (0.22, 0.11), (0.28, 0.075), (0.5, 0.1), (0.9, 0.11), (1.3, 0.09)]
    top += [(1.62, 0.05), (1.74, 0.03), (1.8, 0.055), (1.86, 0.035), (1.92, 0.05), (2.0, 0.01)]
    half = spline(top, count=100)
    outline = np.vstack([half, half[::-1] * (1, -1), half[:1]])
    turn = np.linspace(0, 2 * np.pi, 17)
    eye = np.stack([0.09 + 0.016 * np.cos(turn), 0.055 + 0.016 * np.sin(turn)], 1)
    lozenge = np.array([(-0.06, 0), (0, 0.045), (0.06, 0), (0, -0.045), (-0.06, 0)])
    skin = [lozenge * (1.0 - 0.04 * k) + (0.4 + 0.15 * k, 0.0) for k in range(marks)]
    return [outline, eye, eye * (1, -1), *skin]


def butterfly() -> list[Array]:
    """A butterfly: two pairs of wings with spots, and two thin feelers."""
    side = [(0.02, 0.3), (0.1, 0.42), (0.34, 0.6), (0.52, 0.52), (0.5, 0.3), (0.36, 0.12), (0.46, -0.05), (0.4, -0.3)]
    side += [(0.22, -0.36), (0.06, -0.12), (0.02, -0.3)]
    right = spline(side, count=90)
    outline = np.vstack([right, right[::-1] * (-1, 1), right[:1]])
    feeler = spline([(0.015, 0.32), (0.05, 0.5), (0.14, 0.62), (0.2, 0.6)], count=24)
    spot = np.stack([0.36 + 0.06 * np.cos(t := np.linspace(0, 2 * np.pi, 25)), 0.42 + 0.05 * np.sin(t)], 1)
    return [outline, feeler, feeler * (-1, 1), spot, spot * (-1, 1)]


def harlequin() -> list[Array]:
    """A figure with a pointed hat, a zigzag collar and a wide coat."""
    points = [(0.0, 1.0), (0.12, 0.78), (0.1, 0.62), (0.3, 0.66), (0.2, 0.54), (0.34, 0.5), (0.24, 0.36), (0.42, 0.0)]
    points += [(0.2, 0.06), (0.1, -0.04), (0.0, 0.06), (-0.1, -0.04), (-0.2, 0.06), (-0.42, 0.0), (-0.24, 0.36)]
    points += [(-0.34, 0.5), (-0.2, 0.54), (-0.3, 0.66), (-0.1, 0.62), (-0.16, 0.8), (-0.3, 0.86)]
    outline = np.array([*points, points[0]])
    belt = np.array([(-0.27, 0.28), (-0.1, 0.24), (0.1, 0.24), (0.27, 0.28)])
    staff = np.array([(0.2, 0.3), (0.5, 0.42), (0.56, 0.5), (0.5, 0.56)])
    return [outline, belt, staff]


def wave(rng: np.random.Generator, middle: tuple[float, float], size: float) -> Array:
    """An open wavy line: clutter."""
    turn = np.cumsum(rng.normal(0.0, 0.35, 40))
    walk = np.cumsum(np.stack([np.cos(turn), np.sin(turn)], 1), axis=0)
    return (walk - walk.mean(0)) / np.ptp(walk, axis=0).max() * size + middle


# ------------------------------------------------------------------------------------------------ deformations


def moved(
    x: float,
    y: float,
    scale: float = 1.0,
    turn: float = 0.0,
    bend: float = 0.0,
    grow: float = 0.0,
    mirrored: bool = False,
) -> Deformation:
    """Bent about the y direction by `bend` radians per unit of x, growing by `grow` per unit of x, then moved."""

    def move(points: Array) -> Array:
        p = np.asarray(points, float) * ((1.0, -1.0) if mirrored else (1.0, 1.0))
        s, rate = p[:, 0], grow if grow else 1e-9
        # the middle line grows by exp(rate s) and turns evenly: its points are an integral in closed form
        k = rate + 1j * (bend if bend else 1e-9)
        middle = (np.exp(k * s) - 1.0) / k
        z = middle + 1j * p[:, 1] * np.exp(k * s)
        z = z * scale * np.exp(1j * turn) + (x + 1j * y)
        return np.stack([z.real, z.imag], 1)

    return move


def swung(x: float, y: float, scale: float, turn: float, swing: float, waves: float) -> Deformation:
    """Bent to and fro along x, then moved."""

    def move(points: Array) -> Array:
        p = np.asarray(points, float)
        s = np.linspace(-1.0, 3.0, 2001)
        heading = swing * np.sin(waves * s)
        line = np.cumsum(np.exp(1j * heading)) * (s[1] - s[0])
        at = np.interp(p[:, 0], s, line.real) + 1j * np.interp(p[:, 0], s, line.imag)
        z = at + 1j * p[:, 1] * np.exp(1j * swing * np.sin(waves * p[:, 0]))
        z = z * scale * np.exp(1j * turn) + (x + 1j * y)
        return np.stack([z.real, z.imag], 1)

    return move


# ------------------------------------------------------------------------------------------------ scenes


def snakes() -> Scene:
    """Figure 3.1: a snake, and a bent one that grows along its body."""
    return scene("snakes", snake(), [moved(0.0, -1.2, 0.7, 0.2, -1.2, 0.3)])


def shoal() -> Scene:
    """Three fish, bent and of other sizes, one with its tail hidden, among waves."""
    rng = np.random.default_rng(5)
    targets = [moved(1.6, 0.2, 0.7, 0.4, 0.8), moved(0.2, -1.3, 1.2, -0.2, -0.7), moved(2.1, -1.2, 0.5, 2.0, 0.5)]
    more = [wave(rng, (2.4, 1.0), 1.1), wave(rng, (1.4, -2.2), 1.2), wave(rng, (-0.8, -0.6), 1.0)]
    full = scene("shoal", fish(), targets, more)
    hidden = 2 * len(fish())  # the second target's outline
    full.lines[hidden] = full.lines[hidden][:105]
    return full


def skins() -> Scene:
    """Figure 3.7 f: two snakes with the same repeating pattern, the second bent to and fro."""
    return scene("skins", snake(9), [swung(-0.2, -1.0, 0.9, 0.1, 0.9, 3.4)])


def butterflies() -> Scene:
    """Figure 3.7 g: butterflies of other sizes over clutter, one ten times smaller."""
    rng = np.random.default_rng(8)
    targets = [moved(1.6, 0.1, 0.8, 0.5, 0.5), moved(0.1, -1.4, 0.5, -0.6, -0.5), moved(1.4, -1.0, 0.1, 1.0, 0.3)]
    more = [wave(rng, (rng.uniform(-1, 2.4), rng.uniform(-2.2, 1.2)), 0.8) for _ in range(6)]
    return scene("butterflies", butterfly(), targets, more)


def harlequins() -> Scene:
    """Figure 3.6 e: a figure and two bent ones, one of them mirrored."""
    upright = [line[:, ::-1] for line in harlequin()]
    return scene(
        "harlequins", upright, [moved(1.6, 0.0, 0.9, 0.3, 0.7), moved(0.1, -1.4, 0.8, -0.3, 0.6, mirrored=True)]
    )


SCENES = {build.__name__: build for build in (snakes, shoal, skins, butterflies, harlequins)}
