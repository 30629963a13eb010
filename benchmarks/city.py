"""What a city costs: buildings, operations, processes and workers, by stages, beside the naive route.

    python -m benchmarks city [--full]

Parcels are those of the generated maps, repeated side by side where more are asked for, so that they are equal only as
often as parcels of a city are. Stages are processor time, summed over processes; beside it what the clock says. The
naive route puts a box where each window is as an object of its own, cuts it out by a boolean modifier, and remembers
nothing. How far it is goes to the standard error.
"""

from __future__ import annotations

import itertools
import resource
import shutil
import statistics
import sys
import tempfile
import time
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

import geoanalogy as ga
from geoanalogy.batch import computing
from geoanalogy.batch.generation import Choices, Job, generate, merged
from geoanalogy.batch.product import added, together
from sample_blends.city.maps import HERE
from sample_blends.houses.plots import TYPES

from .in_blender import in_blender
from .measuring import Table, duration, times

TREES = HERE.parent / "houses"
MAPS = ("closes", "curves", "grid")

#: Parcels of a tile: enough tiles to share out, however few parcels there are.
PER_TILE = 6

#: Numbers of buildings, and those that take long.
COUNTS, MANY = (10, 30), (100, 1000, 10_000)

#: Processes that build them.
JOBS = 2

#: Parts of a job, in the order in which its tiles are finished, that are compared; tiles that there are to do so.
PARTS, ENOUGH_TILES = 5, 25

#: Seconds between two words about how far it is.
OFTEN = 20.0

#: Distance between two maps, and between two copies of one, metres.
APART = 2000.0


def parcels(count: int) -> ga.Scene:
    """So many lots of the generated maps, in an order that makes few like many; every copy is sized differently."""
    rng = np.random.default_rng(1)
    maps = [ga.read_scene(HERE / f"{name}.geojson").polygons for name in MAPS]
    lots = [(p, APART * i) for i, every in enumerate(maps) for p in every if p.label in TYPES]
    lots = [lots[i] for i in rng.permutation(len(lots))]
    made: list[ga.Polygon] = []
    for k in range(count):
        p, y = lots[k % len(lots)]
        # The second time round no parcel has the size that it had.
        size = 1.0 if k < len(lots) else rng.uniform(0.94, 1.0)
        centre = p.points.mean(axis=0)
        ring = (p.points - centre) * size + centre + (APART * (k // len(lots)), y)
        made.append(ga.Polygon(ring, p.label, f"p{k}", (), None, p.orientation, p.segment_labels))
    return ga.Scene(made)


def tree(operations: int | None = None) -> ga.OperationsTree:
    """The three recorded types grown together, or the first so many operations of each."""
    every = [(name, ga.OperationsTree.load(TREES / f"{name}.json")) for name in TYPES]
    if operations is not None:
        every = [(name, ga.OperationsTree(one.nodes[: max(operations // 3, 1)])) for name, one in every]
    return merged(every)


def built(whole: ga.OperationsTree, scene: ga.Scene, jobs: int = 1, scheduler: str = "") -> tuple[Job, float, Path]:
    """A job from nothing, its seconds, and its folder."""
    computing._worker.cache_clear()
    folder = Path(tempfile.mkdtemp(prefix="city-"))
    begin = said = time.perf_counter()

    def report(_: float, text: str) -> bool:
        nonlocal said
        if time.perf_counter() - said > OFTEN:
            said = time.perf_counter()
            print(f"{time.strftime('%H:%M:%S')} {text}", file=sys.stderr, flush=True)
        return True

    job = generate(whole, scene, folder, Choices(seed=7, jobs=jobs, scheduler=scheduler, per_tile=PER_TILE), report)
    return job, time.perf_counter() - begin, folder


def cost(tiles: Sequence[Mapping[str, Any]]) -> float:
    """Median over tiles of the processor time of a building, seconds."""
    return statistics.median(tile["seconds"]["all"] / len(tile["parcels"]) for tile in tiles)


def facts(job: Job) -> dict[str, float]:
    """Seconds by stage, and counts."""
    whole = added(job.facts.values())
    return {**whole["seconds"], "elements": whole["elements"], "known": whole["known"] / max(whole["surfaces"], 1)}


#: Writes the tiles of a folder as a .blend and opens it again; run by a process of its own.
WRITE = """
from geoanalogy.batch.product import Product
from geoanalogy.blender.writing import buildings
from geoanalogy.geometry.scene import Scene
folder = Path(sys.argv[1])
begin = time.process_time()
products = ((p.stem, Product.from_bytes(p.read_bytes())) for p in sorted(folder.glob("*.npz")))
buildings.write(Scene([]), products, buildings.Results(folder / "city.blend"))
written = time.process_time() - begin
memory = peak()
begin = time.process_time()
bpy.ops.wm.open_mainfile(filepath=str(folder / "city.blend"))
end(written, memory, time.process_time() - begin, os.path.getsize(folder / "city.blend") / 1e6)
"""

#: Cuts windows out of one wall after the other, as objects and modifiers do.
NAIVE = """
bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
count, windows = int(sys.argv[1]), int(sys.argv[2])
def box(x, y, w, d, h, z=0.0):
    mesh = bpy.data.meshes.new("box")
    corners = [(a, b, c) for c in (z, z + h) for b in (y, y + d) for a in (x, x + w)]
    mesh.from_pydata(corners, [], [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)])
    made = bpy.data.objects.new("box", mesh)
    bpy.context.scene.collection.objects.link(made)
    return made
begin = time.process_time()
for k in range(count):
    house = box(30.0 * k, 0.0, 20.0, 10.0, 10.0)
    for i in range(windows):
        hole = box(30.0 * k + 1 + 1.8 * (i % 10), -0.2, 1.0, 0.5, 1.5, 1.0 + 2.0 * (i // 10 % 4))
        cut = house.modifiers.new("window", "BOOLEAN")
        cut.operation, cut.object = "DIFFERENCE", hole
        hole.hide_render = True
bpy.context.evaluated_depsgraph_get().update()
end(time.process_time() - begin)
"""


def buildings(full: bool) -> Iterator[Table]:
    """From ten buildings on: all of it, and one part of the largest city after the other."""
    whole, rows, done = tree(), [], []
    for count in (*COUNTS, *MANY) if full else COUNTS:
        job, seconds, folder = built(whole, parcels(count), JOBS)
        # Of the processes that have ended so far, none of which was Blender: the largest.
        done.append((count, job, seconds, folder, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1e3))
    for count, job, seconds, folder, memory in done:
        found = facts(job)
        written = in_blender(WRITE, folder)
        shutil.rmtree(folder)
        blend = ("no bpy module",) * 4
        if written is not None:
            blend = (duration(written[0]), duration(written[2]), f"{written[3]:.1f} MB", f"{written[1]:.0f} MB")
        rows.append(
            (
                count,
                found["elements"],
                duration(seconds),
                duration(found["all"]),
                f"{1e3 * found['all'] / count:.0f} ms",
                f"{1e3 * cost(list(job.facts.values())):.0f} ms",
                duration(found.get("placement", 0.0)),
                duration(found.get("extrusion", 0.0)),
                duration(found.get("boolean", 0.0)),
                f"{found['known']:.0%}",
                f"{memory:.0f} MB",
                *blend,
            )
        )
    header = (
        "buildings",
        "elements",
        "by the clock",
        "processor",
        "a building",
        "median",
        "place",
        "extrude",
        "boolean",
    )
    header = (*header, "known surfaces", "memory of a process", "written", "opened", "file", "memory to write")
    note = (
        f"{len(whole.nodes)} operations, about 60 on each building; {JOBS} processes, each of which begins without any "
        "surface. The median is that of the tiles. What bounds it is placing, on surfaces that no equal one was "
        "before. The aim: 1 000 buildings by 45 operations in 120 s and 4 GB, a file of 100 MB."
    )
    yield Table("Buildings", header, rows, note)
    count, job, *_ = done[-1]
    tiles = list(job.facts.values())
    if len(tiles) >= ENOUGH_TILES:
        ends = [len(tiles) * k // PARTS for k in range(PARTS + 1)]
        parts = [tiles[a:b] for a, b in itertools.pairwise(ends)]
        first = cost(parts[0])
        rows = [
            (f"{k + 1} of {PARTS}", f"{1e3 * cost(part):.0f} ms", times(cost(part), first))
            for k, part in enumerate(parts)
        ]
        note = (
            "Processor time of a building, the median over tiles, as these are finished one after the other. Aim: flat."
        )
        yield Table(
            f"One part of {count} buildings after the other", ("part", "a building", "of the first"), rows, note
        )


def operations(full: bool) -> Table:
    """From ten operations on."""
    scene = parcels(100 if full else 12)
    rows = []
    for count in (9, 30, 90, 178):
        found = facts(built(tree(count), scene)[0])
        rows.append((count, found["elements"], duration(found["all"]), f"{1e3 * found['all'] / count:.0f} ms"))
    title = f"Operations, on {len(scene)} buildings of three types"
    return Table(title, ("operations", "elements", "built", "an operation"), rows)


def processes(full: bool) -> Table:
    """One and two, and what they make."""
    scene, whole = parcels(200 if full else 24), tree()
    rows, taken, first = [], 0.0, None
    for jobs in (1, 2):
        job, seconds, _ = built(whole, scene, jobs)
        content = together(product for _, product in job.products()).content()
        taken, first = taken or seconds, first or content
        rows.append((jobs, duration(seconds), times(taken, seconds), "yes" if content == first else "NO"))
    note = f"{len(scene)} buildings, by the clock, starting included. The aim: two at least 1.6 times as fast as one."
    return Table("Processes", ("processes", "time", "faster", "the same result"), rows, note)


def workers(full: bool) -> Table | None:
    """One, two and four of a local Dask cluster."""
    try:
        import distributed
    except ImportError:
        return None
    scene, whole = parcels(200 if full else 24), tree()
    rows, taken, first = [], 0.0, None
    for count in (1, 2, 4):
        with distributed.LocalCluster(n_workers=count, threads_per_worker=1, dashboard_address=None) as cluster:
            job, seconds, _ = built(whole, scene, 1, cluster.scheduler_address)
        content = together(product for _, product in job.products()).content()
        taken, first = taken or seconds, first or content
        rows.append((count, duration(seconds), times(taken, seconds), "yes" if content == first else "NO"))
    note = f"{len(scene)} buildings; more workers than processors gain nothing."
    return Table("Workers of a Dask cluster", ("workers", "time", "faster", "the same result"), rows, note)


def naive(full: bool) -> Table:
    """An object a window, a modifier a boolean."""
    rows = []
    for count in (1, 2, 5, 10) if full else (1, 2):
        taken = in_blender(NAIVE, count, 40)
        rows.append((count, 40 * count, "no bpy module" if taken is None else duration(taken[0])))
    note = "Windows alone, 40 a building, without bars and sills, and with their places given."
    return Table("The naive route", ("buildings", "windows", "time"), rows, note)


def tables(full: bool = False) -> Iterator[Table]:
    """Buildings, operations, processes, workers, then the naive route."""
    yield from buildings(full)
    yield operations(full)
    yield processes(full)
    found = workers(full)
    if found is not None:
        yield found
    yield naive(full)
