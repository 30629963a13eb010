"""What transformation parameter similarity cannot match (figure 3.12), and what the engine makes of it.

Each case is a drawing with known truth, and names the parts of its shape.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import shapely
from numpy.typing import NDArray

import geoanalogy as ga
from geoanalogy.regions.correspondences import described
from geoanalogy.regions.query import Query

from ..regions_scenes import Array, Scene, moved, scene, spline

#: Distance of a correspondence's target from the truth, in extents of the query, up to which it is right.
RIGHT = 0.05


@dataclass(frozen=True)
class Limitation:
    """A drawing whose target differs from the query in a way that the thesis says cannot be matched.

    Attributes
    ----------
    case : Scene
    parts : dict of str to (n,) bool
        Which points of the scene lie in which part of the shape.
    """

    case: Scene
    parts: dict[str, NDArray[np.bool_]]


@dataclass(frozen=True)
class Outcome:
    """The best match of a case.

    Attributes
    ----------
    similarity, coverage : float
    map, confidence : callable
    errors : dict of str to float
        Mean distance from the truth in each part, per cent of the target's diagonal.
    trust : dict of str to float
        Mean confidence in each part.
    """

    similarity: float
    coverage: float
    map: Callable[[Array], Array]
    confidence: Callable[[Array], Array]
    errors: dict[str, float]
    trust: dict[str, float]


def run(limitation: Limitation, **options: float) -> Outcome:
    """Match a case, whatever the similarity of its best match."""
    case = limitation.case
    drawing = ga.Drawing(case.lines)
    best = ga.match_regions(drawing, case.query, ga.RegionOptions(threshold=0.0, contrast=0.0, **options))[0]
    truth = case.targets[0]
    size = np.linalg.norm(np.ptp(truth(case.outline), axis=0))
    error = 100.0 * np.linalg.norm(best.map(case.points) - truth(case.points), axis=1) / size
    trust = best.confidence(case.points)
    each = ({name: float(v[own].mean()) for name, own in limitation.parts.items()} for v in (error, trust))
    return Outcome(best.similarity, best.coverage, best.map, best.confidence, *each)


def right_correspondences(limitation: Limitation, part: shapely.Geometry) -> float:
    """Share of the query's samples in a part with a first-order correspondence (appendix A) to where they belong."""
    case = limitation.case
    drawing = ga.Drawing(case.lines)
    query = Query.of(drawing, case.query, ga.RegionOptions())
    noisy = described(drawing, query, True, 12.0)
    at = drawing.out_of_frame(noisy.source)
    goal = drawing.into_frame(case.targets[0](at))
    image = np.where(noisy.mirrored, np.conj(noisy.image), noisy.image)
    right = ~noisy.mirrored & (np.abs(image - goal) < RIGHT * query.size)
    inside = shapely.contains_xy(part, *at.T)
    samples, number = np.unique(noisy.source[inside], return_inverse=True)
    hit = np.zeros(len(samples), bool)
    hit[number[right[inside]]] = True
    return float(hit.mean()) if len(hit) else 0.0


# ------------------------------------------------------------------------------------------------ a: horses


def horse(arched: bool = False) -> list[Array]:
    """A horse that looks right: outline, far legs, tail, mane, eye and nostril; arched, with another neck and tail."""
    crest = [(0.75, 1.72), (1.02, 1.95), (1.3, 2.3), (1.55, 2.62)]
    throat = [(1.9, 2.12), (1.72, 2.1), (1.55, 1.85), (1.42, 1.55), (1.4, 1.3)]
    if arched:
        crest = [(0.75, 1.72), (0.78, 2.25), (1.05, 2.62), (1.55, 2.62)]
        throat = [(1.9, 2.12), (1.6, 2.3), (1.3, 2.05), (1.55, 1.7), (1.4, 1.3)]
    head = [(1.55, 2.62), (1.6, 2.82), (1.7, 2.64), (1.95, 2.45), (2.32, 2.08), (2.3, 1.95), (2.18, 1.93), (1.9, 2.12)]
    front = [(1.4, 1.3), (1.28, 1.05), (1.3, 0.6), (1.24, 0.3), (1.33, 0.0), (1.1, 0.0), (1.1, 0.3), (1.05, 0.8)]
    belly = [(1.05, 0.8), (0.6, 0.78), (0.1, 0.8), (-0.25, 0.92)]
    hind = [(-0.25, 0.92), (-0.42, 0.75), (-0.52, 0.5), (-0.5, 0.25), (-0.4, 0.0), (-0.64, 0.0), (-0.7, 0.28)]
    hind += [(-0.74, 0.55), (-0.78, 0.95), (-0.86, 1.3)]
    back = [(-0.86, 1.3), (-0.8, 1.62), (-0.5, 1.72), (0.1, 1.6), (0.75, 1.72)]
    parts = [spline(p, count=40) for p in (crest, head, throat, front, belly, hind, back)]
    outline = np.vstack([*(p[:-1] for p in parts), parts[0][:1]])
    tail = [
        (-0.84, 1.55),
        (-1.1, 1.45),
        (-1.2, 1.0),
        (-1.12, 0.6),
        (-1.3, 0.35),
        (-1.05, 0.5),
        (-1.0, 1.0),
        (-0.86, 1.35),
    ]
    if arched:
        tail = [(-0.84, 1.55), (-1.05, 1.8), (-1.4, 1.92), (-1.75, 1.6), (-1.5, 1.7), (-1.15, 1.62), (-0.86, 1.35)]
    far = [(0.9, 0.78), (0.92, 0.4), (0.8, 0.22), (0.84, 0.0)], [(-0.3, 0.82), (-0.22, 0.5), (-0.3, 0.25), (-0.18, 0.0)]
    turn = np.linspace(0, 2 * np.pi, 17)
    eye = np.stack([1.82 + 0.04 * np.cos(turn), 2.42 + 0.03 * np.sin(turn)], 1)
    shoulder = spline([(1.05, 1.5), (1.22, 1.3), (1.2, 1.08)], count=16)
    thigh = spline([(-0.45, 1.45), (-0.22, 1.25), (-0.28, 1.0)], count=16)
    return [outline, spline(tail, count=60), *(spline(f, count=24) for f in far), eye, shoulder, thigh]


#: Neck and tail of the horse.
NECK = shapely.box(0.9, 1.65, 1.75, 2.4)
TAIL = shapely.box(-1.4, 0.3, -0.9, 1.6)


def horses() -> Limitation:
    """Figure 3.12 a: the second horse has another neck and tail; all else is bent and turned."""
    warp = moved(4.2, 0.3, 0.9, 0.1, 0.15)
    case = scene("horses", horse(), [warp])
    own = len(horse())
    case.lines[own:] = [warp(line) for line in horse(arched=True)]
    body, tail = shapely.Polygon(horse()[0]), shapely.Polygon(horse()[1])
    ring = shapely.union_all([body, tail]).convex_hull.buffer(0.05)
    points = np.vstack([case.points, _inside(tail, 20)])
    case = replace(case, query=shapely.get_coordinates(ring)[:-1])
    neck, behind = _in(points, NECK), _in(points, TAIL)
    return Limitation(replace(case, points=points), {"neck": neck, "tail": behind, "the rest": ~neck & ~behind})


# ------------------------------------------------------------------------------------------------ b: flowers


def flower() -> list[Array]:
    """A flower along the x axis: pot, blossom of seven uneven petals with a heart, and a bare stem of two lines."""
    pot = np.array([(0.0, 0.32), (-0.12, 0.36), (-0.14, 0.27), (-0.62, 0.19), (-0.6, -0.22), (-0.14, -0.26)])
    pot = np.vstack([pot, [(-0.12, -0.36), (0.0, -0.33)], pot[:1]])
    turn = np.linspace(0.0, 2.0 * np.pi, 240)
    petal = 0.24 + (0.2 + 0.05 * np.sin(turn + 0.6)) * np.abs(np.sin(3.5 * turn)) ** 0.7
    blossom = np.stack([2.55 + petal * np.cos(turn), petal * np.sin(turn)], 1)
    heart = np.stack([2.55 + 0.12 * np.cos(turn[::8]), 0.1 * np.sin(turn[::8])], 1)
    stem = np.stack([np.linspace(0.0, 2.28, 40), np.full(40, 0.035)], 1)
    return [pot, blossom, heart, stem, stem * (1, -1)]


#: The stem of the flower, without its ends.
STEM = shapely.box(0.35, -0.1, 2.0, 0.1)


def flowers() -> Limitation:
    """Figure 3.12 b: two flowers whose stems are bare and differently bent."""
    base = scene("flowers", flower(), [moved(3.6, -0.4, 0.9, 0.2, 0.35)])
    pot, blossom = shapely.Polygon(flower()[0]), shapely.Polygon(flower()[1])
    points = np.vstack([_inside(pot, 40), _inside(blossom, 40), _inside(STEM.intersection(_strip()), 40)])
    ring = shapely.union_all([pot, blossom, _strip()]).buffer(0.08)
    query = shapely.get_coordinates(ring.exterior.simplify(0.01))[:-1]
    outline = np.vstack([flower()[0], flower()[1]])
    parts = {"pot": points[:, 0] < 0.0, "stem": _in(points, STEM), "blossom": points[:, 0] > 2.2}
    return Limitation(replace(base, points=points, query=query, outline=outline), parts)


def painted(name: str) -> shapely.Geometry:
    """The inside of a case's shape, with all its parts."""
    parts = {"horses": horse()[:2], "flowers": flower()[:2], "joint": [*claw()[:1], claw()[2]]}[name]
    shapes = [shapely.make_valid(shapely.Polygon(part)) for part in parts]
    if name == "flowers":
        shapes.append(_strip())
    if name == "joint":
        shapes[0] = shapely.Polygon(np.vstack([claw()[0], claw()[1][::-1]]))
    return shapely.union_all(shapes)


def _strip() -> shapely.Polygon:
    return shapely.box(0.0, -0.035, 2.28, 0.035)


# ------------------------------------------------------------------------------------------------ c: a joint


def claw() -> list[Array]:
    """Two limbs along the x axis with a claw at the end: the outer limb begins at x = 1."""
    upper = [(-0.1, 0.0), (0.0, 0.2), (0.3, 0.24), (0.55, 0.15), (0.9, 0.13)]
    lower = [(-0.1, 0.0), (0.02, -0.17), (0.4, -0.15), (0.7, -0.2), (0.9, -0.12)]
    end = [(1.1, 0.12), (1.35, 0.2), (1.7, 0.15), (1.85, 0.3), (2.2, 0.26), (2.05, 0.1), (1.8, 0.03), (2.1, -0.12)]
    end += [(1.95, -0.25), (1.7, -0.15), (1.4, -0.1), (1.1, -0.11)]
    spot = np.linspace(0, 2 * np.pi, 21)
    knot = np.stack([0.3 + 0.07 * np.cos(spot), 0.03 + 0.05 * np.sin(spot)], 1)
    mark = np.array([(1.3, 0.02), (1.42, 0.1), (1.52, -0.02), (1.62, 0.06)])
    return [spline(upper, count=50), spline(lower, count=50), spline(end, count=120), knot, mark]


def swung(turn: float) -> Callable[[Array], Array]:
    """The outer limb turned about the joint."""
    c, s = np.cos(turn), np.sin(turn)

    def swing(points: Array) -> Array:
        p = np.asarray(points, float)
        outer = (p - (1.0, 0.0)) @ np.array([[c, s], [-s, c]]) + (1.0, 0.0)
        return np.where(p[:, :1] > 1.0, outer, p)

    return swing


def joint(turn: float = 1.2) -> Limitation:
    """Figure 3.12 c: a limb that turns at a joint, without anything that bends between."""
    place, swing = moved(3.4, -0.2, 0.95, 0.15), swung(turn)
    case = scene("joint", claw(), [lambda p: place(swing(p))])
    outline = np.vstack([claw()[0], claw()[2], claw()[1][::-1]])
    inner, outer = shapely.Polygon(np.vstack([claw()[0], claw()[1][::-1]])), shapely.Polygon(claw()[2])
    points = np.vstack([_inside(inner, 60), _inside(outer, 60)])
    ring = shapely.MultiPoint(outline).convex_hull.buffer(0.06)
    case = replace(case, points=points, outline=outline, query=shapely.get_coordinates(ring)[:-1])
    return Limitation(case, {"upper limb": points[:, 0] < 1.0, "lower limb": points[:, 0] > 1.0})


CASES = {build.__name__: build for build in (horses, flowers, joint)}


def _inside(shape: shapely.Geometry, count: int) -> Array:
    """Points in a shape."""
    x0, y0, x1, y1 = shape.bounds
    some = np.random.default_rng(count).uniform((x0, y0), (x1, y1), (40 * count, 2))
    return some[shapely.contains_xy(shapely.make_valid(shape), *some.T)][:count]


def _in(points: Array, *parts: shapely.Geometry) -> NDArray[np.bool_]:
    return shapely.contains_xy(shapely.union_all(parts), *points.T)
