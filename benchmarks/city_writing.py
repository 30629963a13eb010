"""What it costs to write thousands of library objects into a .blend and to open it, beside an object for each.

    python -m benchmarks city_writing [--full]

The objects are of some kinds, as those of a city are, each turned and sized in its own way, and there is a file that
holds them all. Opened means until everything is shown: each instance is counted.
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path

from .in_blender import in_blender
from .measuring import Table, duration, times

#: Numbers of instances, and those that objects of their own take long for.
COUNTS, MANY = (1000, 10_000, 50_000, 200_000), 50_000

#: Runs of which the quickest counts.
RUNS = 3

#: The library and the places: the same for both routes.
GIVEN = """
KINDS = 20
folder, count = Path(sys.argv[1]), int(sys.argv[2])
rng = np.random.default_rng(1)
library, output = folder / "library.blend", folder / "city.blend"
def cleared():
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
cleared()
cube = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
faces = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
for k in range(KINDS):
    mesh = bpy.data.meshes.new(f"thing {k}")
    mesh.from_pydata((cube * rng.uniform(0.5, 2.0, 3)).tolist(), [], faces)
    bpy.context.scene.collection.objects.link(bpy.data.objects.new(f"thing {k}", mesh))
bpy.ops.wm.save_as_mainfile(filepath=str(library), copy=True)
cleared()
kinds = [f"thing {k}" for k in rng.integers(KINDS, size=count)]
angles, sizes = rng.uniform(0.0, 6.28, count), rng.uniform(0.8, 1.2, (count, 3))
places = np.zeros((count, 4, 4))
places[:, 0, 0] = places[:, 1, 1] = np.cos(angles)
places[:, 1, 0], places[:, 0, 1] = np.sin(angles), -np.sin(angles)
places[:, 2, 2] = places[:, 3, 3] = 1.0
places[:, :3, 3] = rng.uniform(0.0, 1000.0, (count, 3))
least = peak()
"""

#: Opens what has been written, and counts what is shown.
OPENED = """
written, clock, most, size = time.process_time() - begin, time.perf_counter() - started, peak(), output.stat().st_size
begin, started = time.process_time(), time.perf_counter()
bpy.ops.wm.open_mainfile(filepath=str(output))
there = [(one.is_instance, one.object.type) for one in bpy.context.evaluated_depsgraph_get().object_instances]
shown = sum(instance for instance, _ in there) or sum(kind == "MESH" for _, kind in there)
assert count <= shown <= count + 1, shown  # and the ground
end(written, clock, most - least, size / 1e6, time.process_time() - begin, time.perf_counter() - started)
"""

#: As cities are written.
WRITTEN = (
    GIVEN
    + """
from geoanalogy.batch.placed import Placed
from geoanalogy.batch.product import Product, masses_of
from geoanalogy.blender.writing import buildings
from geoanalogy.geometry.scene import Scene
placed = Placed(places, sizes, np.zeros((count, 3)), np.ones((count, 3)), np.full(count, -1), kinds, kinds,
                ["node"] * count, [f"key {k}" for k in range(count)], [])
begin, started = time.process_time(), time.perf_counter()
buildings.write(Scene([]), [("tile", Product(masses_of([]), placed, {}))], buildings.Results(output, None, library))
"""
    + OPENED
)

#: An object for each, which share their meshes.
NAIVE = (
    GIVEN
    + """
from mathutils import Matrix
begin, started = time.process_time(), time.perf_counter()
with bpy.data.libraries.load(str(library)) as (there, brought):
    brought.objects = sorted(set(kinds))
data = {thing.name: thing.data for thing in brought.objects}
for kind, place, size in zip(kinds, places, sizes):
    made = bpy.data.objects.new("thing", data[kind])
    made.matrix_world = Matrix(place) @ Matrix.Diagonal((*size, 1.0))
    bpy.context.scene.collection.objects.link(made)
for thing in brought.objects:
    bpy.data.objects.remove(thing)
bpy.ops.wm.save_as_mainfile(filepath=str(output), copy=True, compress=True)
"""
    + OPENED
)

#: How the columns of both routes are called.
HEADER = ("written", "by the clock", "memory", "file", "opened", "by the clock")


def _quickest(program: str, count: int) -> list[float] | None:
    """The figures of the run that wrote in the least time."""
    with tempfile.TemporaryDirectory() as folder:
        runs = [in_blender(program, Path(folder), count) for _ in range(RUNS if count < MANY else 1)]
    found = [run for run in runs if run is not None]
    return min(found, default=None)


def _cells(found: list[float]) -> tuple[str, ...]:
    written, clock, memory, size, opened, opening = found
    return (
        duration(written),
        duration(clock),
        f"{memory:.0f} MB",
        f"{size:.2g} MB",
        duration(opened),
        duration(opening),
    )


def tables(full: bool = False) -> Iterator[Table]:
    """From a thousand instances on, and as many objects."""
    ours: dict[int, list[float]] = {}
    naive: dict[int, list[float]] = {}
    for count in COUNTS if full else COUNTS[:2]:
        for program, into in ((WRITTEN, ours), (NAIVE, naive)):
            found = _quickest(program, count) if program == WRITTEN or count <= MANY else None
            if found is not None:
                into[count] = found
    note = (
        f"Processor time and the clock's of the quickest of {RUNS} runs, of one from {MANY} on; memory beyond what "
        "Blender takes when it starts. The aim: 200 000 written in 1 s and opened in 10 s."
    )
    yield Table("Instances", ("instances", *HEADER), [(count, *_cells(found)) for count, found in ours.items()], note)
    rows = [
        (count, *_cells(found), times(found[0], ours[count][0]), times(found[4], ours[count][4]))
        for count, found in naive.items()
    ]
    note = "One object an instance, all of a kind with one mesh."
    header = ("objects", *HEADER, "to write, as long", "to open, as long")
    yield Table("An object for each", header, rows, note)
