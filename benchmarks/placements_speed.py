"""How long learning and placing rectangles take, beside chapter 5 taken literally, in the same run.

Facades with windows that are off the grid by a few centimetres, a door, a lintel above every other window; sills are
shown below some of the windows of the first facade.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

import geoanalogy as ga

from .measuring import Table, duration, peak_megabytes, seconds, times
from .peers.sample_models import SampleModels

#: Cells along the longer side of the naive grid: a cell is about a tenth of a window.
CELLS = 200
#: Points of the naive grid that are evaluated; the time of all is scaled from theirs.
NAIVE_POINTS = 10
#: The facade of the requirement: 96 windows and lintels and a door, four examples.
COLUMNS, ROWS, EXAMPLES = 8, 8, 4


def polygon(x: float, y: float, width: float, height: float, label: str, id: str | None = None) -> ga.Polygon:
    """An upright rectangle from its least corner."""
    return ga.Polygon([(x, y), (x + width, y), (x + width, y + height), (x, y + height)], label, id)


def street(facades: int, columns: int, rows: int, seed: int = 0) -> tuple[ga.Scene, list[tuple[float, float]]]:
    """Facades side by side, and the least corners of their windows."""
    rng = np.random.default_rng(seed)
    width, height = columns * 3.0 + 1, rows * 3.0 + 3
    polygons, windows = [], []
    for k in range(facades):
        x = k * (width + 2)
        polygons.append(polygon(x, 0, width, height, "facade", f"f{k}"))
        polygons.append(polygon(x + width / 2 - 0.6, 0, 1.2, 2.2, "door"))
        for i in range(columns):
            for j in range(rows):
                dx, dy = rng.normal(0, 0.03, 2)
                at = float(x + 1.4 + 3 * i + dx), float(3.5 + 3 * j + dy)
                windows.append(at)
                polygons.append(polygon(*at, 1.2, 1.5, "window"))
                if (i + j) % 2:
                    polygons.append(polygon(at[0] - 0.1, at[1] + 1.6, 1.4, 0.3, "lintel"))
    return ga.Scene(polygons), windows


def sills(windows: list[tuple[float, float]], count: int, within: int) -> list[ga.Rectangle]:
    """Sills below some of the first windows, spread evenly."""
    step = max(1, within // count)
    return [ga.Rectangle(x + 0.6, y - 0.1, 1.4, 0.2) for x, y in windows[:within:step][:count]]


def measured(facades: int, columns: int, rows: int, count: int) -> tuple[object, ...]:
    """A row of the cost curves: first, with the fields kept, another threshold, most memory."""
    scene, windows = street(facades, columns, rows)
    shown = sills(windows, count, columns * rows)
    fresh: list[ga.Scene] = []

    def learned(where: ga.Scene) -> ga.PlacementModel:
        return ga.learn_placement([ga.Example(where, r) for r in shown])

    first = seconds(
        lambda: learned(fresh[-1]).place(fresh[-1]), prepare=lambda: fresh.append(ga.Scene(list(scene.polygons)))
    )
    again = seconds(lambda: learned(scene).place(scene))
    model = learned(scene)
    found = len(model.place(scene))
    slider = seconds(lambda: model.place(scene, threshold=0.6))
    memory = peak_megabytes(lambda: learned(scene).place(scene))
    return (
        facades,
        len(scene),
        count,
        duration(first),
        duration(again),
        duration(slider),
        f"{memory:.3g} MB",
        found,
    )


HEADER = ("facades", "elements", "examples", "first time", "fields kept", "another threshold", "most memory", "results")


def naive_table() -> Table:
    """The facade of the requirement, and by the thesis's method."""
    scene, windows = street(1, COLUMNS, ROWS)
    shown = sills(windows, EXAMPLES, COLUMNS * ROWS)
    again = seconds(lambda: ga.learn_placement([ga.Example(scene, r) for r in shown]).place(scene))
    models = SampleModels(scene, "facade", shown)
    parent = scene.polygon("f0")
    low, high = parent.points.min(axis=0), parent.points.max(axis=0)
    whole = int(np.prod(np.ceil((high - low) / ((high - low).max() / CELLS))))
    at = np.random.default_rng(0).uniform(low, high, (NAIVE_POINTS, 2))
    share = seconds(lambda: [models.predicted(i, parent, at) for i in range(5)], 1)
    naive = share * whole / NAIVE_POINTS
    rows = [
        ("by predicted edges", duration(again), ""),
        ("naive, every grid point", duration(naive), times(naive, again)),
    ]
    return Table(
        f"One facade with {len(scene)} elements, {EXAMPLES} examples",
        ("method", "time", "by the first"),
        rows,
        f"Naive: the five sample models at {whole} grid points, every assignment by the Hungarian algorithm; evaluated"
        f" at {NAIVE_POINTS} points and scaled up, without the pairing of maxima that follows.",
    )


def tables(full: bool = False) -> Iterator[Table]:
    """The tables of this benchmark, one after the other; `full` adds the large ones."""
    yield naive_table()
    elements = [(1, 3, 2, 4), (1, 5, 4, 4), (1, 8, 8, 4), (1, 12, 12, 4), *([(1, 20, 20, 4)] if full else [])]
    yield Table("By number of elements", HEADER, [measured(*c) for c in elements])
    examples = [(1, COLUMNS, ROWS, k) for k in (1, 2, 4, 6, 10)]
    yield Table("By number of examples", HEADER, [measured(*c) for c in examples])
    facades = [(n, 4, 4, 4) for n in (1, 4, 16, *([64] if full else []))]
    yield Table("By number of facades", HEADER, [measured(*c) for c in facades])
