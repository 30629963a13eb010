"""How long pose propagation takes and how much memory it needs, beside chapter 4 taken literally, in the same run.

    python -m benchmarks.poses_speed [--full]

The plan of apartments (62 rooms) is furnished by its 26 edits, the two crowns by theirs. `--full` adds a plan of 10 000
rooms.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from dataclasses import replace
from statistics import median

import numpy as np

import geoanalogy as ga
from geoanalogy.poses.arrangement import arrangement_of
from geoanalogy.relations.elements import ElementType
from sample_blends.edits import apartment as apartment_edits
from sample_blends.edits import crowns as crown_edits
from sample_blends.edits.recording import record, scene_of
from sample_blends.plans import apartment, crowns

from .measuring import Table, milliseconds, peak_megabytes, seconds, times
from .peers.rasterised import BINS, Raster, accumulate

CELLS = 100_000
#: The naive volume is accumulated over this share of the cells, and its time scaled up.
SHARE = 0.05


def fresh(scene: ga.Scene) -> ga.Scene:
    """The same scene, with nothing derived from it yet."""
    return ga.Scene([ga.Polygon(**p.to_dict()) for p in scene.polygons])


def stages(tree: ga.OperationsTree, scene: ga.Scene) -> Iterator[tuple[str, ga.PoseModel, ga.Scene]]:
    """Every propagation of a chain of operations: its name, its example, and the scene that it was learned in."""
    before = None
    for node in tree.nodes:
        seen = scene if before is None else tree.layout(scene, before).scene
        model = getattr(node.operation, "model", None)
        if isinstance(model, ga.PoseModel):
            yield node.id, model, seen
        before = node.id


def relearned(model: ga.PoseModel, scene: ga.Scene, **options: object) -> ga.PoseModel:
    """The example of a model, learned again with other options; without `footprint` as a point."""
    point = options.pop("point", False)
    changed = replace(model.options, **options)  # type: ignore[arg-type]
    return ga.learn_pose(scene, model.pose, None if point else model.footprint, changed)


def first_and_again(model: ga.PoseModel, scene: ga.Scene, runs: int = 5) -> tuple[float, float, int]:
    """Seconds of a propagation in a scene that nothing is known of yet, and of a later one; number of results."""
    plain = scene.to_dict()

    def anew() -> ga.Scene:
        return ga.Scene([ga.Polygon(**p) for p in plain["polygons"]])

    scenes = iter([anew() for _ in range(runs)])
    first = seconds(lambda: ga.PoseModel.from_dict(model.to_dict()).place(next(scenes)), runs)
    model.place(scene)
    return first, seconds(lambda: model.place(scene), runs), len(model.place(scene))


def apartment_tables(tree: ga.OperationsTree, plan: ga.Scene) -> Iterator[Table]:
    rows = []
    cases = list(stages(tree, plan))
    for name, model, scene in cases[::3]:
        model = relearned(model, scene, cells=CELLS)
        rows.append((name, len(model.targets(scene)), *first_and_again(model, scene)))
    first, again = median(r[2] for r in rows), median(r[3] for r in rows)
    shown = [(name, n, milliseconds(a), milliseconds(b), found) for name, n, a, b, found in rows]
    shown.append(("median", "", milliseconds(first), milliseconds(again), ""))
    last = cases[-1][2]
    yield Table(
        f"An operation in the apartment: {len(apartment.rooms())} rooms, {len(last)} polygons, {CELLS} cells",
        ("operation", "rooms that match", "first time", "fields kept", "results"),
        shown,
        "First time: nothing derived from the scene yet. Sides and corners of the footprints stand in relations.",
    )
    plain = tree.to_dict()
    whole = seconds(lambda: ga.OperationsTree.from_dict(plain).apply(fresh(plan), seed=0), 3)
    placed = len(ga.OperationsTree.from_dict(plain).apply(fresh(plan), seed=0))
    yield Table(
        "The apartment furnished from nothing",
        ("operations", "objects", "time"),
        [(len(tree.nodes), placed, milliseconds(whole))],
        "Median of 3 runs, without drawing.",
    )
    yield _against_the_naive(cases)


def _against_the_naive(cases: list[tuple[str, ga.PoseModel, ga.Scene]]) -> Table:
    """One operation whose example is a point, as in the thesis."""
    name, model, scene = next(c for c in cases if "night table" in c[0])
    point = relearned(model, scene, cells=CELLS, accumulation="plane", point=True, mirror=False)
    space = relearned(model, scene, cells=CELLS, accumulation="pose space", point=True, mirror=False)
    footprint = relearned(model, scene, cells=CELLS, mirror=False)
    raster, part = Raster.over(scene, CELLS), Raster.over(scene, int(CELLS * SHARE))
    naive = seconds(lambda: accumulate(point, scene, raster), 3)
    volume = seconds(lambda: accumulate(point, scene, part, volume=True), 1) * len(raster.points) / len(part.points)
    dense = 2 * 4 * BINS * len(raster.points) / 1e6
    rows = []
    for label, m in (("plane", point), ("pose space", space), ("footprint", footprint)):
        _, again, found = first_and_again(m, scene)
        peer = {"plane": naive, "pose space": volume, "footprint": naive}[label]
        rows.append(
            (
                label,
                milliseconds(again),
                times(peer, again),
                f"{peak_megabytes(lambda m=m: m.place(scene)):.3g} MB",
                found,
            )
        )
    ratio = float(rows[1][1].split()[0]) / float(rows[0][1].split()[0])
    rows.append(
        (
            "naive plane",
            milliseconds(naive),
            "",
            f"{peak_megabytes(lambda: accumulate(point, scene, raster)):.3g} MB",
            "",
        )
    )
    rows.append(("naive volume", milliseconds(volume), "", f"{dense:.3g} MB", ""))
    return Table(
        f"{name}: positions, positions with directions, and the thesis's method without its graphics hardware",
        ("accumulation", "time", "against the naive one", "memory at the peak", "results"),
        rows,
        f"Pose space takes {ratio:.2g} times as long as the plane. The naive volume was accumulated over {SHARE:.0%} of"
        " the cells, once, and scaled up; its memory is that of the volume and of one level set in it. Fields were"
        " kept.",
    )


def crown_table() -> Table:
    plan = scene_of(crowns.plan())
    tree = record(plan, crown_edits.EDITS)
    rows = []
    for name, model, scene in stages(tree, plan):
        targets = [arrangement_of(scene, p) for p in model.targets(scene)]
        features = sum(t.elements.count(e) for t in targets for e in ElementType)
        first, again, found = first_and_again(relearned(model, scene, cells=CELLS), scene)
        rows.append((name, len(targets), features, milliseconds(first), milliseconds(again), found))
    return Table(
        f"Two crowns, {CELLS} cells",
        ("operation", "parents", "features", "first time", "fields kept", "results"),
        rows,
    )


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


def growth_table(counts: tuple[int, ...]) -> Table:
    """Time and memory against the number of rooms, at equal resolution."""
    bed = [(-1.0, -0.8), (1.0, -0.8), (1.0, 0.8), (-1.0, 0.8)]
    rows = []
    for count in counts:
        scene = bedrooms(count)
        room = scene.polygon("r0")
        pose = ga.Pose((1.2, float(room.bounds[3]) - 1.0), -np.pi / 2)
        options = ga.PoseOptions(cells=2_000 * count, scale="fixed", max_per={"bedroom": 1})
        model = ga.learn_pose(scene, pose, bed, options)
        time = seconds(lambda m=model, s=scene: m.place(fresh(s)), 5 if count <= 100 else 1)
        peak = peak_megabytes(lambda m=model, s=scene: m.place(fresh(s))) if count <= 1000 else float("nan")
        rows.append(
            (count, milliseconds(time), f"{1e3 * time / count:.3g} ms", f"{peak:.3g} MB", len(model.place(scene)))
        )
    return Table(
        "A plan of many rooms, nothing derived yet",
        ("rooms", "time", "per room", "memory at the peak", "results"),
        rows,
        "A bed into bedrooms of different sizes, 2 000 cells a room. One run from 1 000 rooms on.",
    )


def tables(full: bool = False) -> Iterator[Table]:
    """The tables of this benchmark, one after the other."""
    plan = scene_of(apartment.plan())
    yield from apartment_tables(record(plan, apartment_edits.EDITS), plan)
    yield crown_table()
    yield growth_table((10, 100, 1_000, 10_000) if full else (10, 100, 1_000))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--full", action="store_true", help="up to 10 000 rooms")
    for table in tables(parser.parse_args().full):
        print(table.markdown(), flush=True)


if __name__ == "__main__":
    main()
