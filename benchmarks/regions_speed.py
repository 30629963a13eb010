"""How long matching regions takes: descriptors, queries of growing drawings, and the worst case, circles."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

import geoanalogy as ga
from geoanalogy.regions.descriptors import descriptors_of, samples_of

from .measuring import Table, duration, peak_megabytes
from .regions_scenes import SCENES, Scene, butterfly, fish, moved, scene, snake, wave

Array = NDArray[np.float64]

#: Rows and columns of fish, and the query points that make as many refined correspondences as the thesis has in its
#: snakes (2 551) and in its own fish (7 810).
SHOALS = ((3, 34), (5, 102))
#: Runs of which the median processor time is reported.
RUNS = 3


def processor_seconds(work: Callable[[], object]) -> float:
    """Median processor time of RUNS runs."""
    taken = []
    for _ in range(RUNS):
        start = time.process_time()
        work()
        taken.append(time.process_time() - start)
    return statistics.median(taken)


def shoal(count: int) -> Scene:
    """A fish, and count x count bent ones of other sizes with waves between them."""
    rng = np.random.default_rng(count)
    targets, more = [], []
    for k in range(count * count):
        x, y = 1.6 * (k % count), -1.5 * (k // count + 1)
        targets.append(moved(x, y, rng.uniform(0.5, 1.1), rng.uniform(-3, 3), rng.uniform(-0.9, 0.9)))
        more.append(wave(rng, (x + 0.4, y + 0.7), 0.9))
    return scene(f"{count * count} fish", fish(), targets, more)


def dense_snake() -> Scene:
    """Snakes with many marks on their backs: repeating patterns make the most correspondences."""
    return scene(
        "three snakes",
        snake(9),
        [moved(0.0, -1.2, 0.8, 0.2, -0.9), moved(0.2, -2.4, 1.1, 0.0, 0.8), moved(2.6, 0.3, 0.6, -0.8, 0.5)],
        [line for k in range(3) for line in butterfly_at(2.6 + 1.3 * (k % 2), -1.2 - 1.4 * k)],
    )


def butterfly_at(x: float, y: float) -> list[Array]:
    """A butterfly as clutter."""
    return [moved(x, y, 0.9, 0.4 * x)(line) for line in butterfly()]


def circles() -> tuple[list[Array], Array]:
    """Circles of several sizes: every pair of points is alike."""
    turn = np.linspace(0.0, 2.0 * np.pi, 200)
    one = np.stack([np.cos(turn), np.sin(turn)], 1)
    lines = [one] + [r * one + (3.0 * k + 3.0, 0.0) for k, r in enumerate((0.5, 1.0, 1.4))]
    return lines, np.array([(-1.1, -1.1), (1.1, -1.1), (1.1, 1.1), (-1.1, 1.1)])


def row(
    name: str, lines: list[Array], query: Array, targets: int, options: ga.RegionOptions | None = None
) -> tuple[object, ...]:
    """One drawing: samples, time of the descriptors, time of a query, memory."""

    def fresh() -> ga.Drawing:
        drawing = ga.Drawing(lines)
        _ = drawing.contours.turning
        return drawing

    prepared = fresh()
    samples = len(samples_of(prepared.contours))
    first = processor_seconds(lambda: descriptors_of(fresh()))
    descriptors_of(prepared)
    found: list[ga.Matches] = []
    taken = processor_seconds(lambda: found.append(ga.match_regions(prepared, query, options)))
    memory = peak_megabytes(lambda: ga.match_regions(prepared, query, options))
    refined = found[-1].refined
    return (
        name,
        samples,
        duration(first),
        (options or ga.RegionOptions()).query_points,
        0 if refined is None else len(refined),
        duration(taken),
        f"{memory:.0f} MB",
        f"{len(found[-1])} of {targets}",
    )


def tables(full: bool = False) -> Iterator[Table]:
    """The table of this benchmark; `full` adds the other drawings with known truth."""
    cases = [SCENES[name]() for name in (SCENES if full else ("snakes", "butterflies"))]
    rows = [row(c.name, c.lines, c.query, len(c.targets)) for c in [*cases, dense_snake()]]
    for count, points in SHOALS:
        c = shoal(count)
        rows.append(row(c.name, c.lines, c.query, len(c.targets), ga.RegionOptions(query_points=points)))
    rows.append(row("circles", *circles(), 3))
    yield Table(
        "From a selected region to its matches",
        (
            "drawing",
            "samples",
            "descriptors",
            "query points",
            "refined correspondences",
            "query",
            "most memory",
            "matches",
        ),
        rows,
        f"Processor time, medians of {RUNS} runs. Descriptors are computed once for a drawing and kept"
        " between queries; the query's time is that of a drawing whose descriptors are known. In circles every pair of"
        " points is alike.",
    )
