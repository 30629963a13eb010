"""Figure 4.13: what local importance I_l and matching accuracy I_m are for.

A bed with its head at the middle of a short wall is propagated with two relations, boundary distance and segment arc
length. Good places are at the middle of the walls of that length, facing into the room.
"""

from dataclasses import dataclass

import numpy as np

import geoanalogy as ga

from .furnishing import box, outline, pose, rectangle

BED = box(2.0, 1.6)
SOURCE = pose(1.5, 5.9, -90)
TURNED = pose(6.0, 0.4, 25)

#: The four cases of the figure: I_l and I_m.
CASES = {
    "a": ("constant", "constant"),
    "b": ("distance", "constant"),
    "c": ("constant", "features"),
    "d": ("distance", "features"),
}

SCENE = ga.Scene(
    [
        ga.Polygon(rectangle(0, 0, 3, 7), "bedroom", "source"),
        ga.Polygon(TURNED.to_scene(rectangle(0, 0, 3.2, 5.8)), "bedroom", "turned"),
        ga.Polygon(outline((0, 0), (7, 0), (7, 3), (3, 3), (3, 7), (0, 7), at=(9.5, 0)), "bedroom", "angled"),
    ]
)

#: The middles of short walls, a bed's length into the room.
GOOD = (
    pose(1.5, 1.1, 90),
    ga.Pose(tuple(TURNED.to_scene([(1.6, 1.1)])[0]), TURNED.angle + np.pi / 2),
    ga.Pose(tuple(TURNED.to_scene([(1.6, 4.7)])[0]), TURNED.angle - np.pi / 2),
    pose(11.0, 5.9, -90),
    pose(15.4, 1.5, 180),
)


#: Results whose importances differ by less are equally good.
TIE = 0.01


@dataclass(frozen=True)
class Case:
    """One of the four cases.

    Attributes
    ----------
    model : PoseModel
    results : PoseResults
    good : list of bool
        Per result, whether it is one of the good places.
    """

    model: ga.PoseModel
    results: ga.PoseResults
    good: list[bool]

    @property
    def leading(self) -> list[tuple[ga.PropagatedPose, bool]]:
        """As many results as there are good places, best first, and what ties with the last of them."""
        ranked = list(zip(self.results, self.good, strict=True))
        least = ranked[: len(GOOD)][-1][0].importance - TIE
        return [r for r in ranked if r[0].importance >= least]

    @property
    def poor(self) -> list[ga.PropagatedPose]:
        """The leading results that are not good places."""
        return [r for r, good in self.leading if not good]

    @property
    def margin(self) -> float:
        """Importance of the worst good place less that of the best poor one; -1 where a good place was not found."""
        found = [r.importance for r, good in zip(self.results, self.good, strict=True) if good]
        other = [r.importance for r, good in zip(self.results, self.good, strict=True) if not good]
        return min(found) - max(other, default=0.0) if len(found) == len(GOOD) else -1.0


def run(case: str) -> Case:
    """Propagate the bed in one of the four cases.

    Parameters
    ----------
    case : str
        "a", "b", "c" or "d".

    Returns
    -------
    Case
    """
    local_importance, matching_accuracy = CASES[case]
    options = ga.PoseOptions(
        relations=("boundary distance", "segment arc length"),
        accumulation="plane",
        scale="fixed",
        mirror=False,
        local_importance=local_importance,
        matching_accuracy=matching_accuracy,
    )
    model = ga.learn_pose(SCENE, SOURCE, BED, options)
    results = model.place(SCENE)
    return Case(model, results, [any(_is_at(r.pose, g) for g in GOOD) for r in results])


def _is_at(one: ga.Pose, other: ga.Pose) -> bool:
    """Whether poses agree within 0.3 metres and 15 degrees."""
    apart = np.hypot(*np.subtract(one.position, other.position))
    turn = abs(float(np.angle(np.exp(1j * (one.angle - other.angle)))))
    return bool(apart < 0.3 and turn < np.radians(15))
