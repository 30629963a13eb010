"""What the operations tree costs: houses by the recorded trees, and random masses, beside the naive routes.

    python -m benchmarks operations_speed [--full]

All times are processor time, which does not depend on what else the machine does. The naive route for houses evaluates
every surface of its own, though equal ones were evaluated before. That for masses builds each boolean from the bare
meshes, and finds the surfaces of all faces after every one.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

import geoanalogy as ga
from geoanalogy.batch.computing import TimedEvaluations
from geoanalogy.geometry.boolean import combined
from geoanalogy.geometry.extrusion import extrude
from geoanalogy.geometry.solid import Solid
from geoanalogy.progress import Stepper
from sample_blends.houses.plots import TYPES, quarter

from .measuring import Table

TREES = Path(__file__).resolve().parent.parent / "sample_blends" / "houses"
OPERATIONS = 50


class ForgetfulEvaluations(TimedEvaluations):
    """Timed evaluations that evaluate every surface anew."""

    def _on_surface(self, *arguments: object) -> Stepper[tuple[ga.Element, ...]]:
        self._surfaces.clear()
        self._layouts.clear()  # what placements remember of a scene goes with it
        found: tuple[ga.Element, ...] = yield from super()._on_surface(*arguments)  # type: ignore[arg-type]
        return found


def houses(forget: bool, count: int) -> tuple[list[tuple[object, ...]], float, int]:
    """A row per type, the seconds of all, and how many operations times houses that were."""
    every = quarter().polygons
    rows, whole, done = [], 0.0, 0
    for label in TYPES:
        scene = ga.Scene([p for p in every if p.label == label][:count])
        tree = ga.OperationsTree.load(TREES / f"{label}.json")
        tree = ga.OperationsTree(tree.nodes, ForgetfulEvaluations() if forget else TimedEvaluations())
        begin = time.process_time()
        applied = tree.apply(scene, seed=7)
        taken = time.process_time() - begin
        parts = tree.evaluations.seconds  # type: ignore[attr-defined]
        rows.append(
            (
                label,
                len(scene.polygons),
                len(tree.nodes),
                len(applied),
                f"{taken:.1f} s",
                f"{parts['placement']:.1f} s",
                f"{parts['extrusion']:.1f} s",
                f"{parts['boolean']:.1f} s",
                f"{applied.hit_rate:.0%}",
            )
        )
        whole += taken
        done += len(scene.polygons) * len(tree.nodes)
    return rows, whole, done


def mass(seed: int, look: Callable[[Solid], object]) -> tuple[float, bool]:
    """Seconds of the operations on a random mass, and whether it was closed after each."""
    rng = np.random.default_rng(seed)
    solid = extrude(ga.Polygon([(0, 0), (20, 0), (20, 20), (0, 20)]), 12.0)
    taken, closed, done = 0.0, True, 0
    while done < OPERATIONS:
        face = int(rng.choice(np.unique(solid.face)))
        surfaces = solid.surfaces_of(face)
        if not surfaces:
            continue
        _, frame, polygon = surfaces[0]
        low = rng.integers(0, 7, 2) / 8
        high = np.minimum(low + rng.integers(1, 5, 2) / 8, 1)
        x0, y0, x1, y1 = polygon.bounds
        a, b = (np.array([x0, y0]) + share * (x1 - x0, y1 - y0) for share in (low, high))
        if (b - a).min() < 1e-2:
            continue
        height = float(rng.integers(1, 6)) / 2
        kind = "merge" if rng.random() < 0.6 else "subtract"
        outline = ga.Polygon([a, (b[0], a[1]), b, (a[0], b[1])])
        begin = time.process_time()
        part = extrude(outline, height if kind == "merge" else -height).renamed(f"part {done}")
        solid = combined(solid, [(part, frame)], kind, frame)  # type: ignore[arg-type]
        look(solid)
        taken += time.process_time() - begin
        closed &= solid.is_closed
        done += 1
    return taken, closed


def _naively(solid: Solid) -> None:
    solid.derived.clear()
    for face in np.unique(solid.face):
        solid.surfaces_of(int(face))


def tables(full: bool = False) -> Iterator[Table]:
    """The houses, then the masses."""
    header = ("type", "plots", "operations", "elements", "all", "placing", "extruding", "booleans", "known surfaces")
    rows, whole, done = houses(False, 10 if full else 2)
    per = 1000 * whole / done
    note = (
        f"{whole:.1f} s for {done} operations on one house each, {per:.1f} ms an operation: 30 houses by 45 operations "
        f"take {1.35 * per:.1f} s."
    )
    yield Table("Houses by recorded trees", header, rows, note)
    count = 3 if full else 1
    _, with_memory, _ = houses(False, count)
    again, without, _ = houses(True, count)
    yield Table(
        "Without remembering equal surfaces",
        header,
        again,
        f"Plots of each type: {count}. {without:.1f} s instead of {with_memory:.1f} s.",
    )
    masses = []
    routes = (("as the tree does", lambda _: None, 40 if full else 8), ("naively", _naively, 2))
    for name, look, count in routes:
        results = [mass(seed, look) for seed in range(count)]
        per_operation = np.median([taken for taken, _ in results]) / OPERATIONS * 1000
        masses.append((name, len(results), OPERATIONS, f"{per_operation:.2f} ms", sum(not ok for _, ok in results)))
    yield Table("Random masses", ("route", "masses", "operations", "an operation", "with an open edge"), masses)
