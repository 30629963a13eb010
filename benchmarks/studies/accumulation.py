"""Figure 4.17: level sets accumulated over positions ("plane") and over positions and directions ("pose space").

Six edits furnish bedrooms, toilets and closets. The bed of the room on the far right stands across a corner: a
television set at the place that all relations ask for can be parallel to the wall or face the bed, not both.
"""

import time
import tracemalloc
from collections.abc import Sequence
from dataclasses import dataclass
from statistics import median

import numpy as np

import geoanalogy as ga
from geoanalogy.relations.table import CENTROID_DIRECTION, POSE_RELATIONS

from .furnishing import Edit, Step, box, furnish, piece, pose, rectangle

MODES = ("plane", "pose space")
BED, TELEVISION = box(2.0, 1.6), box(0.3, 0.7)

SOURCE = pose(2.5, 0.45, 90)
#: Where the television set's level sets meet in the far room; and its two directions there.
CONFLICT = np.array([14.5, 0.45])
PARALLEL, FACING = np.pi / 2, np.pi / 4


def _scene() -> ga.Scene:
    diagonal = np.array([np.sqrt(0.5), np.sqrt(0.5)])
    bed = CONFLICT + (1.75 + 1.0) * diagonal
    low, right, top = 11.1, 18.4, 4.6
    bevel = (CONFLICT + (1.75 + 2.1) * diagonal).sum()
    far = [(low, 0), (right, 0), (right, bevel - right), (bevel - top, top), (low, top)]
    toilets = [rectangle(0, -3.0, 1.5, 2.4), rectangle(2.2, -3.0, 2.2, 1.6), rectangle(5.1, -3.2, 1.7, 2.6)]
    doors = [rectangle(0.4, -3.05, 0.7, 0.1), rectangle(2.15, -2.7, 0.1, 0.7), rectangle(5.6, -3.25, 0.7, 0.1)]
    closets = [rectangle(8.0, -2.6, 1.6, 2.0), rectangle(10.3, -2.6, 2.1, 1.7)]
    return ga.Scene(
        [
            ga.Polygon(rectangle(0, 0, 5, 4.3), "bedroom", "source"),
            ga.Polygon(rectangle(5.5, 0, 5.2, 4.6), "bedroom", "middle"),
            ga.Polygon(far, "bedroom", "far"),
            piece(pose(2.5, 3.2, -90), BED, "bed"),
            piece(pose(8.1, 3.5, -90), BED, "bed"),
            piece(pose(*bed, -135), BED, "bed"),
            *(ga.Polygon(t, "toilet", f"toilet {i}") for i, t in enumerate(toilets)),
            *(ga.Polygon(d, "door") for d in doors),
            *(ga.Polygon(c, "closet", f"closet {i}") for i, c in enumerate(closets)),
        ]
    )


SCENE = _scene()
ROOMS = tuple(str(p.id) for p in SCENE.polygons if p.label in ("bedroom", "toilet", "closet"))


def edits(mode: str) -> list[Edit]:
    """The six edits.

    Parameters
    ----------
    mode : str
        Of `MODES`.

    Returns
    -------
    list of Edit
        The television set's results are all kept, of the others one per room.
    """

    def options(relations: Sequence[str], **more: object) -> ga.PoseOptions:
        return ga.PoseOptions(accumulation=mode, relations=tuple(relations), mirror=False, scale="fixed", **more)

    every = [r.name for r in (*POSE_RELATIONS, CENTROID_DIRECTION)]
    one = options(every, max_per={"bedroom": 1, "toilet": 1, "closet": 1})
    return [
        Edit("television", TELEVISION, SOURCE, options(("boundary distance", "corner distance", "centroid direction"))),
        Edit("night table", box(0.4, 0.4), pose(1.4, 4.02, -90), one),
        Edit("bench", box(0.45, 1.4), pose(2.5, 1.92, -90), one),
        Edit("toilet seat", box(0.65, 0.4), pose(0.75, -0.95, -90), one),
        Edit("lavatory", box(0.4, 0.5), pose(1.28, -2.1, 180), one),
        Edit("shelf", box(0.35, 1.2), pose(8.2, -1.6, 0), one),
    ]


def televisions(mode: str) -> tuple[Step, list[ga.PropagatedPose]]:
    """The first edit, and its results at the place of the conflict.

    Parameters
    ----------
    mode : str

    Returns
    -------
    step : Step
    there : list of PropagatedPose
    """
    edit = edits(mode)[0]
    model = ga.learn_pose(SCENE, edit.pose, edit.footprint, edit.options)
    found = model.place(SCENE)
    there = [r for r in found if np.hypot(*(np.array(r.pose.position) - CONFLICT)) < 0.1]
    return Step(edit, model, SCENE, SCENE, found), there


def sequences() -> dict[str, list[Step]]:
    """All six edits in both modes; the television set is put where it is best.

    Returns
    -------
    dict of str to list of Step
        By mode.
    """
    result = {}
    for mode in MODES:
        steps = []
        scene = SCENE
        for edit in edits(mode):
            step = furnish(scene, [edit])[0]
            best = step.results.max_per("bedroom", 1)
            kept = [piece(edit.pose, edit.footprint, edit.label)]
            kept += [piece(r.pose, edit.footprint, edit.label) for r in best]
            scene = scene.with_polygons(kept)
            steps.append(Step(edit, step.model, step.before, scene, best))
        result[mode] = steps
    return result


def agreement(sequence: dict[str, list[Step]]) -> tuple[int, int]:
    """How many pieces stand in the same place in both modes.

    Parameters
    ----------
    sequence : dict of str to list of Step

    Returns
    -------
    same, all : int
        Same: within 0.1 metres and 15 degrees.
    """
    same = total = 0
    for one, other in zip(sequence["plane"], sequence["pose space"], strict=True):
        there = {r.parent.id: r.pose for r in other.results}
        for r in one.results:
            total += 1
            p = there.get(r.parent.id)
            if p is not None and np.hypot(*np.subtract(p.position, r.pose.position)) < 0.1:
                same += bool(abs(np.angle(np.exp(1j * (p.angle - r.pose.angle)))) < np.radians(15))
    return same, total


@dataclass(frozen=True)
class Cost:
    """What a mode costs, for one operation.

    Attributes
    ----------
    seconds : float
        Median, the relation fields being there.
    megabytes : float
        Most memory allocated at any time during the operation, fields included.
    """

    seconds: float
    megabytes: float


def costs(sequence: dict[str, list[Step]], runs: int = 5) -> dict[str, Cost]:
    """Time and memory of both modes on the same edits, taken in turns.

    Parameters
    ----------
    sequence : dict of str to list of Step
    runs : int
        Times that every edit is timed in each mode.

    Returns
    -------
    dict of str to Cost
        Processor time of this process, so that other programs do not count.
    """
    seconds: dict[str, list[float]] = {mode: [] for mode in MODES}
    for _ in range(runs):
        for mode in MODES:
            start = time.process_time()
            for step in sequence["plane"]:
                _in_mode(step, mode).place(step.before)
            seconds[mode].append((time.process_time() - start) / len(sequence["plane"]))
    megabytes = {}
    for mode in MODES:
        peak = 0
        for step in sequence["plane"]:
            model, fresh = _in_mode(step, mode), ga.Scene(step.before.polygons)
            tracemalloc.start()
            model.place(fresh)
            peak = max(peak, tracemalloc.get_traced_memory()[1])
            tracemalloc.stop()
        megabytes[mode] = peak / 1e6
    return {mode: Cost(median(seconds[mode]), megabytes[mode]) for mode in MODES}


def _in_mode(step: Step, mode: str) -> ga.PoseModel:
    edit = next(e for e in edits(mode) if e.label == step.edit.label)
    return ga.learn_pose(step.before, edit.pose, edit.footprint, edit.options)
