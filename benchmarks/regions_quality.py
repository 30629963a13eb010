"""How well regions are found and mapped on drawings that other people made, beside pycpd and a trivial baseline.

Reads `spine_articulated`, `chui_points`, `mpeg7_contours` and `fish_landmarks` below the folder named by
GEOANALOGY_DATA.
"""

from __future__ import annotations

import importlib.util
import json
import os
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from statistics import mean, median
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

import geoanalogy as ga
from geoanalogy.regions.fitting import ROUNDS, Fitter
from geoanalogy.regions.query import Query
from geoanalogy.regions.transformation import Nodes

from .measuring import Table, duration
from .peers import coherent_drift

Array = NDArray[np.float64]

#: Share of an outline that is cut away.
CUT = 0.3
#: Points that coherent point drift gets of each outline.
POINTS = 60
#: Corresponding points that the engine's functions are laid through where they are known.
PAIRS = 150
#: Cases of each kind in the short run: every so many of those there are.
EVERY = {"spine": 3, "chui": 18, "mpeg7": 5, "fish": 9}
#: A mapped point is right within so many per cent of the diagonal.
CLOSE = {"spine": 3.0, "chui": 2.0, "fish": 3.0}


@dataclass(frozen=True)
class Case:
    """Lines, a query, points of it and where they belong.

    The first of `middles` is the query's place, the second the target's; `sets` are points of both, for registration,
    `pairs` corresponding points of the lines that there are, where all are known.
    """

    kind: str
    name: str
    lines: list[Array]
    query: Array
    points: Array
    answer: Array
    middles: Array
    baseline: Array
    sets: tuple[Array, Array]
    pairs: tuple[Array, Array] | None = None


@dataclass
class Judged:
    """What was found."""

    first: list[bool] = field(default_factory=list)
    shown: list[bool] = field(default_factory=list)
    clean: list[bool] = field(default_factory=list)
    errors: list[float] = field(default_factory=list)
    known: list[float] = field(default_factory=list)
    close: list[float] = field(default_factory=list)
    base: list[float] = field(default_factory=list)
    drift: list[float] = field(default_factory=list)
    seconds: list[float] = field(default_factory=list)


def diagonal(points: Array) -> float:
    """Diagonal of a bounding box."""
    return float(np.hypot(*np.ptp(points, axis=0)))


def closed(points: Array) -> Array:
    """A ring as a closed line."""
    return np.vstack([points, points[:1]])


def around(points: Array) -> Array:
    """The ring that a user would draw round a shape: 1 % of its diagonal wider."""
    shape = shapely.make_valid(shapely.Polygon(points)).buffer(0.01 * diagonal(points), join_style="mitre")
    shape = max(shapely.get_parts(shape), key=lambda g: g.area)
    return shapely.get_coordinates(shape.exterior)[:-1]


def tossed(points: Array, rng: np.random.Generator, at: Array) -> Callable[[Array], Array]:
    """A random similarity that brings points to a place, their diagonal 0.6 to 1.5."""
    angle, middle = rng.uniform(0.0, 2.0 * np.pi), (points.min(0) + points.max(0)) / 2.0
    scale = rng.uniform(0.6, 1.5) / diagonal(points)
    turn = scale * np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    return lambda p: (np.asarray(p) - middle) @ turn + at


def evenly(line: Array) -> Array:
    """POINTS at equal distances along a line."""
    at = np.arange(POINTS) / POINTS
    return shapely.get_coordinates(shapely.LineString(line).interpolate(at, normalized=True))


def cells(count: int) -> Array:
    """Centres of a square grid two apart."""
    width = int(np.ceil(np.sqrt(count)))
    return np.array([(2.0 * (i % width), 2.0 * (i // width)) for i in range(count)])


def fitted(source: Array, target: Array, points: Array) -> Array:
    """Points moved by the best similarity between paired points."""
    x, y, p = (a @ np.array([1.0, 1j]) for a in (source, target, points))
    factor = np.vdot(x - x.mean(), y - y.mean()) / np.vdot(x - x.mean(), x - x.mean())
    z = factor * (p - x.mean()) + y.mean()
    return np.stack([z.real, z.imag], 1)


# ------------------------------------------------------------------------------------------------ cases


def inner(shape: dict[str, Any], rng: np.random.Generator, count: int = 200) -> Callable[[Array], Array]:
    """Where random points of a triangulated shape are, as a function of its vertices."""
    v, triangles = np.array(shape["setup"]), np.array(shape["triangles"])
    a, b = v[triangles[:, 1]] - v[triangles[:, 0]], v[triangles[:, 2]] - v[triangles[:, 0]]
    area = np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
    pick = triangles[rng.choice(len(triangles), count, p=area / area.sum())]
    weight = rng.dirichlet((1.0, 1.0, 1.0), count)[:, :, None]
    return lambda vertices: (np.asarray(vertices)[pick] * weight).sum(1)


def paired(rest: Array, bent: Array, begin: float = 0.0, share: float = 1.0) -> tuple[Array, Array]:
    """PAIRS corresponding points of two rings with corresponding vertices, along a share of the second's length."""
    one, other = closed(rest), closed(bent)
    arc = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(other, axis=0), axis=1))])
    at = (begin + np.arange(PAIRS) / PAIRS * share) % 1.0 * arc[-1]
    first, second = (np.stack([np.interp(at, arc, z) for z in ring.T], 1) for ring in (one, other))
    return first, second


def spine(folder: Path, every: int) -> Iterator[Case]:
    """Shapes of game figures and a bent pose of each, whole and cut, among 2 to 5 shapes of other figures."""
    shapes = [json.loads(f.read_text("utf-8")) for f in sorted(folder.glob("*.json"))]
    poses = [(s, p) for s in shapes for p in sorted(s["poses"], key=lambda p: -p["nonrigid_rms_pct_diag"])[:2]]
    for number, (shape, pose) in list(enumerate(poses))[::every]:
        for cut in (False, True):
            rng = np.random.default_rng([number, cut])
            hull, at = shape["hull"], cells(7)
            rest, bent = np.array(shape["setup"]), np.array(pose["vertices"])
            place, move = tossed(rest, rng, at[0]), tossed(bent, rng, at[1])
            where = inner(shape, rng)
            rest, bent = place(rest), move(bent)
            outline = closed(bent[:hull])
            pairs = paired(rest[:hull], bent[:hull])
            if cut:
                line, start = shapely.LineString(outline), rng.random()
                pairs = paired(rest[:hull], bent[:hull], start, 1.0 - CUT)
                share = (start + np.arange(0.0, 1.0 - CUT + 0.01, 0.01)) % 1.0
                outline = shapely.get_coordinates(line.interpolate(share, normalized=True))
            others = [s for s in shapes if s["source"] != shape["source"]]
            lines = [closed(rest[:hull]), outline]
            for k, other in enumerate(rng.choice(len(others), rng.integers(2, 6), replace=False)):
                o = np.array(others[other]["setup"])[: others[other]["hull"]]
                lines.append(closed(tossed(o, rng, at[2 + k])(o)))
            base = fitted(rest[:hull], bent[:hull], where(rest))
            kind = "spine, cut" if cut else "spine, whole"
            sets = (evenly(closed(rest[:hull])), evenly(outline))
            ring, places = around(rest[:hull]), at[: len(lines)]
            yield Case(kind, shape["id"], lines, ring, where(rest), where(bent), places, base, sets, pairs)


def joined(points: Array) -> list[Array]:
    """Lines through points: neighbours within 1.5 times their distance to the nearest are joined, others are dots."""
    gap = np.linalg.norm(points[:, None] - points[None], axis=2)
    np.fill_diagonal(gap, np.inf)
    nearest, second = np.sort(gap, 1)[:, 0], np.sort(gap, 1)[:, 1]
    near = (gap <= 1.5 * np.maximum(nearest[:, None], nearest)) & (gap <= np.maximum(second[:, None], second))
    near &= gap < 2.5 * np.median(nearest)
    pairs = [points[[i, j]] for i, j in np.argwhere(np.triu(near))]
    merged = shapely.line_merge(shapely.multilinestrings([shapely.linestrings(p) for p in pairs])) if pairs else None
    lines = [shapely.get_coordinates(g) for g in shapely.get_parts(merged)] if pairs else []
    dot = (0.1 * np.median(nearest), 0.0)
    return lines + [np.vstack([p, p + dot]) for p in points[~near.any(1)]]


def chui(folder: Path, every: int) -> Iterator[Case]:
    """Point sets that were deformed, disturbed, thinned or turned; neighbours joined to lines."""
    for path in sorted(folder.glob("*.json")):
        kind = path.stem.split("_")[1]
        trials = json.loads(path.read_text("utf-8"))
        if kind == "gmmreg":
            continue
        for trial in trials[::every]:
            x, y = np.array(trial["x"]), np.array(trial["y"])
            known = np.array([i for i, j in enumerate(trial["truth"]) if j is not None])
            shift = np.array([2.0 * max(diagonal(x), diagonal(y)), 0.0])
            answer = (y + shift)[[trial["truth"][i] for i in known]]
            alike = [(p - p.mean(0)) / p.std() for p in (x, y)]
            rows, columns = linear_sum_assignment(np.linalg.norm(alike[0][:, None] - alike[1][None], axis=2))
            still = dict(zip(rows, columns, strict=True))
            base = np.array([y[still[i]] + shift if i in still else (np.nan, np.nan) for i in known])
            hull = shapely.MultiPoint(x).convex_hull.buffer(0.05 * diagonal(x))
            middles = np.array([x.mean(0), y.mean(0) + shift])
            query = shapely.get_coordinates(hull.exterior)[:-1]
            lines = joined(x) + joined(y + shift)
            yield Case(f"chui, {kind}", path.stem, lines, query, x[known], answer, middles, base, (x, y + shift))


def fish(folder: Path, every: int) -> Iterator[Case]:
    """Landmarks of pupfish: the runs of near ones as lines, each fish matched to another one."""
    fishes = json.loads((folder / "pupfish.json").read_text("utf-8"))
    marks = [np.array(f["landmarks"]) for f in fishes]
    for number in range(0, len(marks) - 1, every):
        rng = np.random.default_rng(number)
        at = cells(2)
        rest, bent = marks[number], marks[-1 - number]
        rest, bent = tossed(rest, rng, at[0])(rest), tossed(bent, rng, at[1])(bent)
        lines = runs(rest) + runs(bent)
        hull = shapely.MultiPoint(rest).convex_hull.buffer(0.05 * diagonal(rest))
        query = shapely.get_coordinates(hull.exterior)[:-1]
        yield Case("fish landmarks", str(number), lines, query, rest, bent, at, fitted(rest, bent, rest), (rest, bent))


def runs(points: Array) -> list[Array]:
    """Consecutive landmarks that are near each other as lines, the others as dots."""
    step = np.linalg.norm(np.diff(points, axis=0), axis=1)
    breaks = np.flatnonzero(step > 2.5 * np.median(step)) + 1
    parts = np.split(points, breaks)
    return [p if len(p) > 1 else np.vstack([p, p + 1e-3 * diagonal(points)]) for p in parts]


# ------------------------------------------------------------------------------------------------ judging


def lands(points: Array, middles: Array) -> int:
    """Number of the place that most points fall on."""
    nearest = np.argmin(np.linalg.norm(points[:, None] - middles[None], axis=2), 1)
    return int(np.bincount(nearest).argmax())


def smoothest(case: Case, pairs: tuple[Array, Array]) -> Array:
    """The points of a case by the smoothest function through known pairs: the engine's answer if it knew them."""
    drawing, options = ga.Drawing(case.lines), ga.RegionOptions()
    query = Query.of(drawing, case.query, options)
    nodes = Nodes.of(query.points, query.spacing, options.neighbourhood)
    source, target = (drawing.into_frame(p) for p in pairs)
    unknowns = Fitter(drawing.contours, query, nodes).start(source, target, np.ones(len(source)), ROUNDS[-1])
    return drawing.out_of_frame(nodes.rows(drawing.into_frame(case.points)) @ unknowns)


def judge(cases: Iterator[Case], judged: dict[str, Judged]) -> None:
    """Match every case, and compare with the truth."""
    drift = importlib.util.find_spec("pycpd") is not None
    for case in cases:
        j = judged.setdefault(case.kind, Judged())
        size = diagonal(case.answer)
        start = time.process_time()
        matches = ga.match_regions(ga.Drawing(case.lines), case.query)
        j.seconds.append(time.process_time() - start)
        mapped = [m.map(case.points) for m in matches.every]
        places = [lands(p, case.middles) for p in mapped]
        right = next((p for p, place in zip(mapped, places, strict=True) if place == 1), None)
        away = np.full(len(case.answer), np.inf)
        if right is not None:
            away = 100.0 * np.linalg.norm(right - case.answer, axis=1) / size
            j.errors.append(float(away.mean()))
        if case.pairs:
            miss = smoothest(case, case.pairs) - case.answer
            j.known.append(float(100.0 * np.linalg.norm(miss, axis=1).mean() / size))
        near = CLOSE[case.kind.split(",")[0].split()[0]]
        j.first.append(bool(places) and places[0] == 1)
        j.shown.append(j.first[-1] and len(matches) > 0)
        j.clean.append(not any(p > 1 for p in places[: len(matches)]))
        j.close.append(float((away < near).mean()))
        base = 100.0 * np.linalg.norm(case.baseline - case.answer, axis=1) / size
        j.base.append(float((base < near).mean()))
        if drift:
            there = coherent_drift.register(*case.sets)(case.points)
            j.drift.append(float((100.0 * np.linalg.norm(there - case.answer, axis=1) / size < near).mean()))


def silhouettes(folder: Path, every: int) -> Iterator[tuple[str, list[Array], Array]]:
    """Silhouettes by class: its name, the query, two others of its class and six of other classes, and their places."""
    classes = {
        f.stem: [np.array(m["contour"]) for m in json.loads(f.read_text("utf-8"))]
        for f in sorted(folder.glob("*.json"))
        if f.stem != "bream_video"
    }
    names = list(classes)
    for number, name in list(enumerate(names))[::every]:
        rng = np.random.default_rng(number)
        own = [classes[name][i] for i in rng.permutation(len(classes[name]))[:3]]
        others = [n for n in names if n != name]
        strangers = [classes[n][rng.integers(len(classes[n]))] for n in rng.choice(others, 6, replace=False)]
        at = cells(9)
        yield name, [tossed(s, rng, a)(s) for s, a in zip(own + strangers, at, strict=True)], at


def retrieved(shapes: list[Array], at: Array) -> tuple[bool, bool, bool, float]:
    """Whether the best match is of the query's class: of all, of those shown, by Fourier descriptors; and seconds.

    The baseline compares magnitudes of Fourier coefficients.
    """
    start = time.process_time()
    matches = ga.match_regions(ga.Drawing([closed(s) for s in shapes]), around(shapes[0]))
    taken = time.process_time() - start
    first = bool(matches.every) and lands(matches.every[0].map(shapes[0]), at) in (1, 2)
    features = [frequencies(s) for s in shapes]
    base = 1 + int(np.argmin([np.linalg.norm(f - features[0]) for f in features[1:]])) in (1, 2)
    return first, first and len(matches) > 0, base, taken


def frequencies(points: Array, count: int = 20) -> Array:
    """Magnitudes of an outline's Fourier coefficients, scale taken out."""
    f = np.abs(np.fft.fft(points @ np.array([1.0, 1j])))
    return np.concatenate([f[2:count], f[-count:]]) / f[[1, -1]].max()


def share(values: Sequence[float]) -> str:
    """A mean as text."""
    return f"{mean(values):.2f}" if values else "—"


def tables(full: bool = False) -> Iterator[Table]:
    """The tables of this benchmark; `full` takes all cases."""
    root = Path(os.environ.get("GEOANALOGY_DATA") or "nowhere")
    folders = {n: root / n / "dev" for n in ("spine_articulated", "chui_points", "mpeg7_contours", "fish_landmarks")}
    if not all(f.is_dir() for f in folders.values()):
        print(f"GEOANALOGY_DATA names no folder with {', '.join(folders)}: the quality of regions is not measured.")
        return
    step = {k: 1 if full else n for k, n in EVERY.items()}
    judged: dict[str, Judged] = {}
    judge(spine(folders["spine_articulated"], step["spine"]), judged)
    judge(chui(folders["chui_points"], step["chui"]), judged)
    judge(fish(folders["fish_landmarks"], step["fish"]), judged)
    rows = [
        (
            kind,
            len(j.first),
            share(j.first),
            share(j.shown),
            share(j.clean),
            f"{median(j.errors):.1f}" if j.errors else "—",
            f"{median(j.known):.1f}" if j.known else "—",
            share(j.close),
            share(j.base),
            share(j.drift),
            duration(mean(j.seconds)),
        )
        for kind, j in judged.items()
    ]
    yield Table(
        "Bent shapes among clutter, point sets and landmarks",
        (
            "cases",
            "n",
            "first",
            "shown",
            "clean",
            "median error, %",
            "by known pairs",
            "close",
            "baseline close",
            "pycpd close",
            "processor time",
        ),
        rows,
        "First: the true target is the best match; shown: by default settings as well. Clean: nothing else is"
        " shown. Error: mean over the points of a case, per cent of the target's diagonal; by known pairs: that of the"
        " smoothest function through the true correspondences of the lines that are left. Close: share of the"
        " points within 3 % (point sets: 2 %); what is not found counts as far. Baseline: the best similarity with"
        " the pairs known; for point sets the best assignment of the centred and scaled points. pycpd is given the"
        " right target alone and keeps the best of eight directions. 30 % of the cut outlines is missing.",
    )
    some = [retrieved(shapes, at) for _, shapes, at in silhouettes(folders["mpeg7_contours"], step["mpeg7"])]
    yield Table(
        "Silhouettes: is the best match of the query's class?",
        ("cases", "right", "right and shown", "Fourier descriptors", "chance", "processor time"),
        [
            (
                len(some),
                share([s[0] for s in some]),
                share([s[1] for s in some]),
                share([s[2] for s in some]),
                "0.25",
                duration(mean(s[3] for s in some)),
            )
        ],
        "Two of the class among six of others.",
    )
