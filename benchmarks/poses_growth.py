"""How time and memory of pose propagation grow with the number of rooms, beside the naive method."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

import geoanalogy as ga

from .measuring import Table, duration, peak_megabytes, seconds, times
from .peers.rasterised import Raster, accumulate
from .poses_speed import fresh

ROOMS = (10, 30, 100, 300, 1_000, 3_000, 10_000)
CELLS_PER_ROOM = 1_000
#: A number of rooms is left out where, at the rate of the one before, it would take longer than this: seconds.
LONGEST = 40.0
#: Tracing memory makes a run slower; it is left out where the run itself takes longer than this: seconds.
LONGEST_TRACED = 6.0
#: Cells of the naive grid times polygons that it is run with; where there are more, on a part of the cells.
NAIVE_WORK = 2e6

BED = [(-1.0, -0.8), (1.0, -0.8), (1.0, 0.8), (-1.0, 0.8)]


def bedrooms(count: int, seed: int = 0) -> ga.Scene:
    """A plan of bedrooms of different sizes, each with a door, a window and a wardrobe."""
    rng = np.random.default_rng(seed)
    columns = int(np.ceil(np.sqrt(count)))
    polygons = []

    def box(x: float, y: float, width: float, height: float, label: str, name: str, parent: str | None) -> None:
        ring = [(x, y), (x + width, y), (x + width, y + height), (x, y + height)]
        polygons.append(ga.Polygon(ring, label, name, parent=parent))

    for k in range(count):
        x, y = 7.0 * (k % columns), 6.0 * (k // columns)
        width, height = rng.uniform(4.2, 6.0), rng.uniform(3.2, 5.0)
        box(x, y, width, height, "bedroom", f"r{k}", None)
        box(x + rng.uniform(2.2, width - 1), y, 0.9, 0.9, "door", f"d{k}", f"r{k}")
        box(x, y + rng.uniform(0.3, height - 1.6), 0.15, 1.2, "window", f"w{k}", f"r{k}")
        box(x + width - 1.8, y + height - 0.6, 1.8, 0.6, "wardrobe", f"c{k}", f"r{k}")
    return ga.Scene(polygons)


def bed_in(scene: ga.Scene, point: bool = False) -> ga.PoseModel:
    """A bed in the first room, its head at the top; as a point, where that is said."""
    top = float(scene.polygon("r0").bounds[3])
    cells = CELLS_PER_ROOM * (len(scene) // 4)
    options = ga.PoseOptions(cells=cells, scale="fixed", max_per={"bedroom": 1}, mirror=False)
    return ga.learn_pose(scene, ga.Pose((1.2, top - 1.0), -np.pi / 2), None if point else BED, options)


def naive_seconds(scene: ga.Scene) -> float:
    """Seconds of the naive method with as many cells, scaled up from a part where that takes too long."""
    model = bed_in(scene, point=True)
    cells = CELLS_PER_ROOM * (len(scene) // 4)
    whole = Raster.over(scene, cells)
    part = Raster.over(scene, max(50, min(cells, round(NAIVE_WORK / len(scene)))))
    return seconds(lambda: accumulate(model, scene, part), 3) * len(whole.points) / len(part.points)


def measured(count: int, full: bool) -> tuple[float, tuple[object, ...]]:
    """Seconds of a propagation into so many rooms, and the row of the table."""
    scene = bedrooms(count)
    model = bed_in(scene)
    bare: list[ga.Scene] = []
    found: list[ga.PoseResults] = []

    def forget() -> None:
        bare[:] = [fresh(scene)]

    taken = seconds(lambda: found.append(model.place(bare[0])), 3, forget)
    traced = full or taken <= LONGEST_TRACED
    memory = f"{peak_megabytes(lambda: model.place(fresh(scene))):.3g} MB" if traced else "not traced"
    naive = naive_seconds(scene)
    ours = (count, duration(taken), duration(taken / count), memory, len(found[-1]))
    return taken, (*ours, duration(naive), times(naive, taken))


def tables(full: bool = False) -> Iterator[Table]:
    """The table of this benchmark; `full` measures all numbers of rooms, however long they take."""
    rows: list[tuple[object, ...]] = []
    rate = 0.0
    left_out = []
    for count in ROOMS:
        if rate * count > LONGEST and not full:
            left_out.append(f"{count:,}".replace(",", " "))
            continue
        taken, row = measured(count, full)
        rate = taken / count
        rows.append(row)
    note = (
        f"A bed into bedrooms of different sizes with door, window and wardrobe, {CELLS_PER_ROOM} cells a room, nothing"
        " derived before, at most 3 runs. The naive method has as many cells and a point for an example; it is run on a"
        " part of them where the whole would take long, and scaled up."
    )
    if left_out:
        note += f" Left out because they would take more than {LONGEST:g} s each: {', '.join(left_out)} rooms."
    header = ("rooms", "time", "per room", "most memory", "results", "naive", "naive by this")
    yield Table("A plan of many rooms", header, rows, note)
