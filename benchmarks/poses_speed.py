"""How long pose propagation takes and how much memory it needs, beside chapter 4 taken literally, in the same run.

The plan of apartments is furnished by its 26 edits, the two crowns by theirs.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from statistics import median

import geoanalogy as ga
from sample_blends.edits import apartment as apartment_edits
from sample_blends.edits import crowns as crown_edits
from sample_blends.edits.recording import record, scene_of
from sample_blends.plans import apartment, crowns

from .measuring import RUNS, Table, duration, peak_megabytes, seconds, times
from .peers.rasterised import BINS, Raster, accumulate
from .studies import accumulation

CELLS = 100_000
#: Every so many-th edit of the apartment is measured.
EVERY = 3
#: The naive volume is accumulated over this share of the cells, and its time scaled up.
SHARE = 0.02

#: The edit that is compared with the naive method: many parents, and neighbours on which it depends.
COMPARED = "night table"


def fresh(scene: ga.Scene) -> ga.Scene:
    """The same scene, with nothing derived from it yet."""
    return ga.Scene([ga.Polygon(**p) for p in scene.to_dict()["polygons"]])


def first_and_again(model: ga.PoseModel, scene: ga.Scene) -> tuple[float, float, int]:
    """Seconds of a propagation in a scene that nothing is known of yet, and of a later one; number of results."""
    bare: list[tuple[ga.PoseModel, ga.Scene]] = []

    def forget() -> None:
        bare.append((ga.PoseModel.from_dict(model.to_dict()), fresh(scene)))

    first = seconds(lambda: bare[-1][0].place(bare[-1][1]), prepare=forget)
    known, there = bare[-1]
    found = len(known.place(there))
    return first, seconds(lambda: known.place(there)), found


def stages(tree: ga.OperationsTree, scene: ga.Scene) -> Iterator[tuple[str, ga.PoseModel, ga.Scene]]:
    """Every propagation of a chain of operations: its name, its example, and the scene that it was learned in."""
    before = None
    for node in tree.nodes:
        model = getattr(node.operation, "model", None)
        if isinstance(model, ga.PoseModel):
            yield node.id, model, scene if before is None else tree.layout(scene, before).scene
        before = node.id


def relearned(model: ga.PoseModel, scene: ga.Scene, point: bool = False, **options: object) -> ga.PoseModel:
    """The example of a model, learned again with other options; as a point, where that is said."""
    changed = replace(model.options, **options)  # type: ignore[arg-type]
    return ga.learn_pose(scene, model.pose, None if point else model.footprint, changed)


def operations_table(cases: Sequence[tuple[str, ga.PoseModel, ga.Scene]], title: str, note: str) -> Table:
    """First and later times of some operations."""
    measured = []
    for name, model, scene in cases:
        model = relearned(model, scene, cells=CELLS)
        measured.append((name, len(model.targets(scene)), len(scene), *first_and_again(model, scene)))
    rows: list[tuple[object, ...]] = [(*m[:3], duration(m[3]), duration(m[4]), m[5]) for m in measured]
    first, again = (median(m[k] for m in measured) for k in (3, 4))
    rows.append(("median", "", "", duration(first), duration(again), ""))
    header = ("operation", "parents that match", "polygons", "first time", "fields kept", "results")
    return Table(title, header, rows, note)


def replay_table(tree: ga.OperationsTree, plan: ga.Scene) -> Table:
    """All edits applied to the bare plan."""
    plain = tree.to_dict()
    placed: list[int] = []

    def replay() -> None:
        placed.append(len(ga.OperationsTree.from_dict(plain).apply(fresh(plan), seed=0)))

    taken = seconds(replay, 3)
    return Table(
        "The apartment furnished from nothing",
        ("operations", "objects", "time", "per operation"),
        [(len(tree.nodes), placed[-1], duration(taken), duration(taken / len(tree.nodes)))],
        "Without drawing; nothing derived before. Median of at most 3 runs.",
    )


def naive_table(name: str, model: ga.PoseModel, scene: ga.Scene) -> Table:
    """One operation in all modes, and by the thesis's method: with a point for its example, as there."""
    raster, part = Raster.over(scene, CELLS), Raster.over(scene, round(CELLS * SHARE))
    modes = {
        "footprint": relearned(model, scene, cells=CELLS, mirror=False),
        "plane": relearned(model, scene, True, cells=CELLS, accumulation="plane", mirror=False),
        "pose space": relearned(model, scene, True, cells=CELLS, accumulation="pose space", mirror=False),
    }
    plane = seconds(lambda: accumulate(modes["plane"], scene, raster), 3)
    volume = seconds(lambda: accumulate(modes["plane"], scene, part, volume=True), 1)
    volume *= len(raster.points) / len(part.points)
    rows: list[tuple[object, ...]] = []
    for label, m in modes.items():
        _, again, found = first_and_again(m, scene)
        memory = peak_megabytes(lambda m=m: m.place(fresh(scene)))
        peer = volume if label == "pose space" else plane
        rows.append((label, duration(again), times(peer, again), f"{memory:.3g} MB", found))
    memory = peak_megabytes(lambda: accumulate(modes["plane"], scene, raster))
    rows.append(("naive, plane", duration(plane), "", f"{memory:.3g} MB", ""))
    # The sum, and a level set on its way into it.
    dense = 2 * 4 * BINS * len(raster.points) / 1e6
    rows.append(("naive, pose space", duration(volume), "", f"{dense:.3g} MB", ""))
    return Table(
        f"{name} beside the naive method, {CELLS} cells",
        ("accumulation", "time, fields kept", "naive by this", "most memory", "results"),
        rows,
        "The naive method evaluates every relation to every feature at every cell of the whole plan, for every query,"
        f" and keeps nothing; its example is a point. Its pose space, with {BINS} directions, was run on {SHARE:.0%} of"
        " the cells and scaled up, and its memory is that of two dense volumes. Memory of the others: first time.",
    )


def pose_space_table() -> Table:
    """The six edits of figure 4.17 in both modes."""
    sequence = accumulation.sequences()
    same, all_results = accumulation.agreement(sequence)
    costs = accumulation.costs(sequence, runs=RUNS)
    ratio = costs["pose space"].seconds / costs["plane"].seconds
    rows = [(mode, duration(c.seconds), f"{c.megabytes:.3g} MB") for mode, c in costs.items()]
    return Table(
        "Positions, or positions and directions (figure 4.17)",
        ("accumulation", "processor time per operation", "most memory"),
        rows,
        f"Pose space takes {ratio:.2g} times as long; {same} of {all_results} results are the same. The thesis: 1.4 to"
        " 4.3 s and 9 MB against 39 to 85 s and 763 MB.",
    )


def populated(tree: ga.OperationsTree, plan: ga.Scene) -> Iterator[tuple[str, ga.PoseModel, ga.Scene]]:
    """Every propagation once more, among all that the others have placed."""
    everything = tree.layout(plan).scene
    for name, model, _ in stages(tree, plan):
        kept = [p for p in everything.polygons if not str(p.id).startswith(f"{name}/")]
        scene = ga.Scene(kept)
        yield name, ga.learn_pose(scene, model.pose, model.footprint, model.options), scene


def tables(full: bool = False) -> Iterator[Table]:
    """The tables of this benchmark, one after the other; `full` measures every edit."""
    plan = scene_of(apartment.plan())
    tree = record(plan, apartment_edits.EDITS)
    cases = list(stages(tree, plan))
    yield operations_table(
        cases if full else cases[::EVERY],
        f"An operation in the apartment: {len(apartment.rooms())} rooms, {CELLS} cells",
        "First time: nothing derived from the scene yet. The thesis: 1.4 to 4.3 s. Sides and corners of footprints"
        " stand in relations here, as well as their centres.",
    )
    yield replay_table(tree, plan)
    yield naive_table(*next(c for c in cases if COMPARED in c[0]))
    yield pose_space_table()
    crown = scene_of(crowns.plan())
    gems = record(crown, crown_edits.EDITS)
    yield operations_table(
        list(populated(gems, crown)),
        f"An operation in the two crowns, all other gems set, {CELLS} cells",
        "The worst case of the thesis (15 s): everything stands in two parents.",
    )
