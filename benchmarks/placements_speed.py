"""Seconds that learning and placing take, beside the naive method of chapter 5 on the same facade.

    python benchmarks/placements_speed.py [--repeats N] [--naive-points N]

The naive method evaluates the five sample models at every point of a dense grid and solves every assignment with the
Hungarian algorithm; it is timed on part of the grid and scaled up. Medians over repeats.
"""

import argparse
import pathlib
import statistics
import sys
import time

import numpy as np
from scipy.optimize import linear_sum_assignment

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))

import geoanalogy as ga
from geoanalogy.placements.arrangement import arrangement_of
from geoanalogy.placements.signature import signature

#: Cells along the longer side of the naive grid: a cell is about a tenth of a window.
CELLS = 200


def polygon(x, y, width, height, label, **more):
    return ga.Polygon([(x, y), (x + width, y), (x + width, y + height), (x, y + height)], label, **more)


def street(facades, columns, rows, seed=0):
    """Facades side by side, their windows off the grid by a few centimetres; a lintel above every other window."""
    rng = np.random.default_rng(seed)
    width, height = columns * 3.0 + 1, rows * 3.0 + 3
    polygons, windows = [], []
    for k in range(facades):
        x = k * (width + 2)
        polygons.append(polygon(x, 0, width, height, "facade", id=f"f{k}"))
        polygons.append(polygon(x + width / 2 - 0.6, 0, 1.2, 2.2, "door"))
        for i in range(columns):
            for j in range(rows):
                dx, dy = rng.normal(0, 0.03, 2)
                at = x + 1.4 + 3 * i + dx, 3.5 + 3 * j + dy
                windows.append(at)
                polygons.append(polygon(*at, 1.2, 1.5, "window"))
                if (i + j) % 2:
                    polygons.append(polygon(at[0] - 0.1, at[1] + 1.6, 1.4, 0.3, "lintel"))
    return ga.Scene(polygons), windows


def sills(scene, windows, count, within):
    step = max(1, within // count)
    return [ga.Example(scene, ga.Rectangle(x + 0.6, y - 0.1, 1.4, 0.2)) for x, y in windows[:within:step][:count]]


def timed(repeats, work):
    seconds = []
    for _ in range(repeats):
        start = time.perf_counter()
        result = work()
        seconds.append(time.perf_counter() - start)
    return statistics.median(seconds), result


def measured(repeats, facades, columns, rows, examples):
    """Seconds of the first placing (scene and fields included), and of a later one; number of results."""
    first = []
    for i in range(repeats):
        scene, windows = street(facades, columns, rows, seed=i)
        start = time.perf_counter()
        model = ga.learn_placement(sills(scene, windows, examples, columns * rows))
        model.place(scene)
        first.append(time.perf_counter() - start)
    again, found = timed(repeats, lambda: model.place(scene))
    return statistics.median(first), again, len(found), len(scene)


def naive(scene, windows, examples, points):
    """Seconds for the grids of the five samples with the Hungarian algorithm everywhere, from some of the points."""
    model = ga.learn_placement(sills(scene, windows, examples, len(windows)))
    arrangement = arrangement_of(scene, scene.polygon("f0"), 0.0)
    low, high = arrangement.parent_box[:2], arrangement.parent_box[2:]
    cell = (high - low).max() / CELLS
    whole = int(np.prod(np.ceil((high - low) / cell)))
    at = np.random.default_rng(0).uniform(low, high, (points, 2))
    start = time.perf_counter()
    size = model.lesson.sizes.mean(axis=0)
    for sample in ((0, 0), (1, 0), (1, 1), (0, 1), (0.5, 0.5)):
        boxes = np.hstack([at - size * sample, at + size * (1 - np.array(sample))])
        seen = signature(arrangement, boxes, len(windows), model.lesson.labels)
        for key, kept in model.lesson.kept.boxes.items():
            there = seen.boxes[key]
            for i in range(points):
                for j in range(examples):
                    difference = np.nan_to_num(there[i, :, None] - kept[j][None, :], nan=np.inf)
                    utility = np.exp(-0.5 * (difference / 0.1) ** 2).sum(axis=(2, 3, 4))
                    linear_sum_assignment(utility, maximize=True)
    return (time.perf_counter() - start) * whole / points, whole


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--naive-points", type=int, default=20)
    args = parser.parse_args()
    print("facades columns rows examples | elements results | first s  again s")
    cases = [
        (1, 4, 3, 4),
        (1, 8, 8, 1),
        (1, 8, 8, 2),
        (1, 8, 8, 4),
        (1, 8, 8, 10),
        (1, 14, 14, 4),
        (5, 8, 8, 4),
        (20, 8, 8, 4),
    ]
    for facades, columns, rows, examples in cases:
        first, again, found, elements = measured(args.repeats, facades, columns, rows, examples)
        print(
            f"{facades:7d} {columns:7d} {rows:4d} {examples:8d} | {elements:8d} {found:7d} | "
            f"{first:7.3f}  {again:7.3f}",
            flush=True,
        )
    scene, windows = street(1, 8, 8)
    seconds, whole = naive(scene, windows, 4, args.naive_points)
    print(
        f"naive, 1 facade of 8 by 8 with 4 examples, {whole} grid points: {seconds:.1f} s "
        f"(scaled from {args.naive_points} points)"
    )


if __name__ == "__main__":
    main()
