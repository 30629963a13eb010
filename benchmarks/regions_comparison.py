"""Regions beside L2E, ACC and coherent point drift on drawings with known truth (figures 3.9 and 3.10).

All get the same drawing and the same query. L2E and coherent point drift are given evenly spaced points of the lines,
query and rest, and answer with one mapping; ACC gets the first-order correspondences that the engine itself starts
from, and its sets are extended over the query by the Gaussian-weighted average of their transformations.
"""

from __future__ import annotations

import importlib.util
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

import geoanalogy as ga
from geoanalogy.regions.correspondences import Correspondences, described
from geoanalogy.regions.fitting import Fitter
from geoanalogy.regions.linkage import clusters, similarities
from geoanalogy.regions.query import Query
from geoanalogy.regions.refinement import Refined, refine
from geoanalogy.regions.transformation import Nodes

from .measuring import Table, duration
from .peers import agglomerative, coherent_drift, robust_l2
from .regions_scenes import SCENES, Scene, butterfly, moved, scene, snake

Array = NDArray[np.float64]
Mapping = Callable[[Array], Array]

#: Mean error, in per cent of a target's diagonal, up to which it counts as found.
FOUND = 5.0
#: Points that L2E and coherent point drift get of the query, and of the rest.
SAMPLES, MOST_SAMPLES = 120, 360
#: Normalisations of the projection error (figure 3.10): shares of the query's extent.
UNITS = (0.02, 0.06)


def spread(lines: list[Array], count: int) -> Array:
    """About `count` points at equal distances along lines."""
    shapes = [shapely.LineString(line) for line in lines]
    step = sum(s.length for s in shapes) / count
    parts = [
        shapely.get_coordinates(
            s.interpolate((np.arange(n := max(2, round(s.length / step))) + 0.5) / n, normalized=True)
        )
        for s in shapes
    ]
    return np.concatenate(parts)


def parts(case: Scene) -> tuple[Array, Array]:
    """Points of the query's lines and of all others, equally dense relative to what they show."""
    region = shapely.Polygon(case.query)
    own = [line for line in case.lines if region.contains(shapely.LineString(line))]
    rest = [line for line in case.lines if not region.contains(shapely.LineString(line))]
    length = [sum(shapely.LineString(line).length for line in some) for some in (own, rest)]
    return spread(own, SAMPLES), spread(rest, min(MOST_SAMPLES, round(SAMPLES * length[1] / length[0])))


def ours(case: Scene) -> list[Mapping]:
    """The engine, with its default options."""
    return [m.map for m in ga.match_regions(ga.Drawing(case.lines), case.query)]


def l2e(case: Scene) -> list[Mapping]:
    """L2E's one mapping."""
    return [robust_l2.register(*parts(case))]


def drift(case: Scene) -> list[Mapping]:
    """Coherent point drift's one mapping."""
    return [coherent_drift.register(*parts(case))]


def acc(case: Scene) -> list[Mapping]:
    """ACC's sets, most confident first: twice as many as there are targets."""
    drawing = ga.Drawing(case.lines)
    query = Query.of(drawing, case.query, ga.RegionOptions())
    noisy = described(drawing, query, True, 12.0)
    found = agglomerative.clustered(noisy, query.size)[: 2 * len(case.targets)]
    width = 0.1 * query.size

    def mapping(c: agglomerative.Cluster) -> Mapping:
        return lambda p: drawing.out_of_frame(c.carry(drawing.into_frame(p), width))

    return [mapping(c) for c in found]


METHODS: dict[str, Callable[[Scene], list[Mapping]]] = {"ours": ours, "L2E": l2e, "ACC": acc, "CPD": drift}


@dataclass(frozen=True)
class Outcome:
    """The best mapping to each target, its error in per cent, and processor seconds."""

    errors: list[float]
    best: list[Mapping | None]
    seconds: float

    @property
    def found(self) -> int:
        """Targets within FOUND."""
        return sum(e <= FOUND for e in self.errors)


def run(method: str, case: Scene) -> Outcome:
    """Run one method on one scene."""
    start = time.process_time()
    mappings = METHODS[method](case)
    taken = time.process_time() - start
    errors, best = [], []
    for target in case.targets:
        each = [case.error(m(case.points), target) for m in mappings]
        errors.append(min(each, default=np.inf))
        best.append(mappings[int(np.argmin(each))] if each else None)
    return Outcome(errors, best, taken)


def methods() -> list[str]:
    """The methods that are installed."""
    return [m for m in METHODS if m != "CPD" or importlib.util.find_spec("pycpd")]


# ------------------------------------------------------------------------------------------------ figure 3.10


def two_scales() -> Scene:
    """A snake, and two of clearly different scales, tail to head."""
    return scene("two scales", snake(6), [moved(0.0, -1.0, 1.0, 0.0, 0.3), moved(2.35, -0.72, 0.5, 0.3, 0.4)])


def joined_tails() -> Scene:
    """Figure 3.10 a: a snake, and two of different scales whose tails lie over each other."""
    first, bent = moved(0.0, -1.4, 1.0, 0.0, 0.3), moved(0.0, 0.0, 0.6, 0.0, 0.4)
    tail = np.array([(1.9, 0.0), (1.91, 0.0)])
    (at, ahead), (own, beyond) = first(tail), bent(tail)
    heading = [complex(*(b - a)) for a, b in ((at, ahead), (own, beyond))]
    turn = np.exp(0.3j) * heading[0] / heading[1]
    turn /= abs(turn)
    rotation = np.array([(turn.real, turn.imag), (-turn.imag, turn.real)])
    return scene("joined tails", snake(6), [first, lambda points: (bent(points) - own) @ rotation + at])


def feelers() -> Scene:
    """Figure 3.10 c: a butterfly with thin feelers, and one bent and grown."""
    return scene("feelers", butterfly(), [moved(1.7, 0.0, 0.9, 0.3, 0.9, 0.3)])


LINKED = {
    "two snakes of different scale": two_scales,
    "two snakes, tail over tail": joined_tails,
    "butterfly with feelers": feelers,
}


def correspondences(case: Scene) -> tuple[ga.Drawing, Fitter, Nodes, Refined]:
    """The refined correspondences of a query (section 3.4), from descriptors alone."""
    drawing = ga.Drawing(case.lines)
    query = Query.of(drawing, case.query, ga.RegionOptions())
    nodes = Nodes.of(query.points, query.spacing, 1.5)
    noisy: Correspondences = described(drawing, query, True, 12.0)
    steps = refine(query.points, noisy, query.size, 0.15 * query.size)
    while True:
        try:
            next(steps)
        except StopIteration as end:
            return drawing, Fitter(drawing.contours, query, nodes), nodes, end.value


@dataclass(frozen=True)
class Linked:
    """A set of refined correspondences, by their numbers, and the smoothest mapping through them."""

    members: NDArray[np.intp]
    map: Mapping


def linked(case: Scene, unit: float | None) -> list[Linked]:
    """Sets of correspondences linked by the TPS, or by the projection error where its unit is given."""
    drawing, fitter, nodes, refined = correspondences(case)
    alike = (
        similarities(nodes, refined)
        if unit is None
        else agglomerative.projected_similarities(nodes, refined, unit * fitter.size)
    )
    steps = clusters(nodes, refined, alike, max(3, len(nodes.at) // 7))
    while True:
        try:
            next(steps)
        except StopIteration as end:
            sets = end.value
            break

    def mapping(members: NDArray[np.intp]) -> Mapping:
        u = fitter.through(
            refined.node[members], refined.image[members], refined.factor[members], refined.magnitude[members]
        )
        mirrored = bool(refined.mirrored[members[0]])

        def carry(p: Array) -> Array:
            z = nodes.rows(drawing.into_frame(p)) @ u
            return drawing.out_of_frame(np.conj(z) if mirrored else z)

        return carry

    return [Linked(s.members, mapping(s.members)) for s in sets[: 4 * len(case.targets)]]


def tables(full: bool = False) -> Iterator[Table]:
    """The tables of this benchmark; `full` changes nothing."""
    rows = []
    for name, build in SCENES.items():
        case = build()
        for method in methods():
            o = run(method, case)
            errors = ", ".join("—" if not np.isfinite(e) else f"{e:.1f}" for e in o.errors)
            rows.append((name, method, f"{o.found} of {len(case.targets)}", errors, duration(o.seconds)))
    yield Table(
        "Regions beside other methods (figure 3.9)",
        ("drawing", "method", "targets found", "error of each target, %", "processor time"),
        rows,
        f"Mean error of points inside the query, in per cent of the target's diagonal; found: at most {FOUND:g} %."
        " L2E and CPD register all lines outside the query at once and have one mapping. The time includes the"
        " descriptors of the drawing.",
    )
    rows = []
    for name, build in LINKED.items():
        case = build()
        ways: list[tuple[str, float | None]] = [("TPS", None)]
        ways += [(f"projection error, unit {100 * u:g} % of the query", u) for u in UNITS]
        for way, unit in ways:
            sets = linked(case, unit)
            each = [min((case.error(s.map(case.points), t) for s in sets), default=np.inf) for t in case.targets]
            rows.append((name, way, ", ".join(f"{e:.1f}" for e in each)))
    yield Table(
        "Second-order similarity by the projection error in place of the TPS (figure 3.10)",
        ("drawing", "similarity", "error of each target, %"),
        rows,
        "Sets of refined correspondences as linkage leaves them, before anything is fitted to lines; correspondences"
        " from the descriptors alone, default options.",
    )
