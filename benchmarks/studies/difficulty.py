"""Figure 4.20: three scenes that are increasingly hard, because less is said by relations and more by shapes.

In the first, many simple features surround the object. In the second there is only a jagged outline, stretched
unevenly. The third is a serrated leaf, bent and swollen: its teeth are all alike, and without them little is left.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

import geoanalogy as ga

from .furnishing import Array, box, piece, pose, rectangle

#: Distance from the intended place, as a share of the target's size, within which a result is at that place.
AT_PLACE = 0.07


@dataclass(frozen=True)
class Difficulty:
    """A scene with an example in the polygon "source" and the place it should get in "target".

    Attributes
    ----------
    scene : Scene
    footprint : ndarray of shape (n, 2)
    source, intended : Pose
    """

    scene: ga.Scene
    footprint: Array
    source: ga.Pose
    intended: ga.Pose


@dataclass(frozen=True)
class Outcome:
    """What propagation made of it.

    Attributes
    ----------
    model : PoseModel
    results : PoseResults
        In the target, best first.
    error : float
        Distance of the first from the intended place, as a share of the target's size.
    rank : int or None
        Of the first result at the intended place, 1 for the best; None: it is not among them.
    lead : float
        Importance of the first less that of the second: how pronounced the maximum is.
    """

    model: ga.PoseModel
    results: ga.PoseResults
    error: float
    rank: int | None
    lead: float


def many_simple_features() -> Difficulty:
    """A chair at the desk of a bedroom."""
    bed, wardrobe, desk = box(2.0, 1.6), box(0.6, 1.8), box(0.7, 1.4)
    scene = ga.Scene(
        [
            ga.Polygon(rectangle(0, 0, 4.2, 3.8), "bedroom", "source"),
            piece(pose(1.02, 2.6, 0), bed, "bed"),
            piece(pose(3.88, 1.2, 180), wardrobe, "wardrobe"),
            piece(pose(1.4, 0.37, 90), desk, "desk"),
            ga.Polygon(rectangle(4.9, 0, 3.6, 4.6), "bedroom", "target"),
            piece(pose(6.3, 3.58, -90), bed, "bed"),
            piece(pose(5.22, 1.3, 0), wardrobe, "wardrobe"),
            piece(pose(8.13, 1.5, 180), desk, "desk"),
        ]
    )
    return Difficulty(scene, box(0.5, 0.5), pose(1.4, 1.05, -90), pose(7.45, 1.5, 0))


def jagged_outline() -> Difficulty:
    """A place beside a tooth of an outline whose steps are all of other sizes in the target."""
    outline = np.array(
        [
            (0, 0),
            (6, 0),
            (6, 2.2),
            (5, 2.2),
            (5, 3.4),
            (4, 3.4),
            (4, 1.8),
            (2.6, 1.8),
            (2.6, 3.9),
            (1.2, 3.9),
            (1.2, 2.6),
            (0, 2.6),
        ]
    )
    at = np.array([3.3, 1.35])

    def stretched(p: Array) -> Array:
        x = np.interp(p[:, 0], [0, 1.2, 2.6, 4, 5, 6], [0, 0.9, 2.7, 4.4, 5.1, 6.6])
        y = np.interp(p[:, 1], [0, 1.8, 2.2, 2.6, 3.4, 3.9], [0, 1.5, 2.1, 2.4, 3.7, 4.0])
        return np.stack([x + 7.0, y], axis=1)

    return _warped(outline, at, np.pi / 2, stretched, box(0.5, 0.5))


def leaf() -> Difficulty:
    """A place beside a tooth of a serrated leaf; the target is the leaf, bent and swollen."""
    along = np.linspace(0, 1, 23)[1:-1]
    half = 1.5 * np.sin(np.pi * along**0.8) * (1 - 0.35 * along)
    teeth = np.where(np.arange(len(along)) % 2 == 0, 1.13, 0.92)
    upper = np.stack([6.5 * along - 0.12 * (teeth < 1), half * teeth], axis=1)
    outline = np.vstack([[(0, 0)], upper * (1, -1), [(6.5, 0)], upper[::-1]])
    at = np.array([2.35, -0.95])

    def bent(p: Array) -> Array:
        x = p[:, 0] / 6.5
        swollen = p[:, 1] * (0.75 + 0.7 * x)
        turn = 1.1 * x
        radius = 6.5 / 1.1
        across = radius - swollen
        return np.stack([across * np.sin(turn) + 7.4, radius - across * np.cos(turn) - 1.6], axis=1)

    return _warped(outline, at, 0.0, bent, box(0.4, 0.4))


SCENES: dict[str, Callable[[], Difficulty]] = {
    "many simple features": many_simple_features,
    "a jagged outline": jagged_outline,
    "a leaf": leaf,
}


def run(name: str) -> Outcome:
    """Propagate the example of one of the scenes.

    Parameters
    ----------
    name : str
        Of `SCENES`.

    Returns
    -------
    Outcome
    """
    case = SCENES[name]()
    model = ga.learn_pose(case.scene, case.source, case.footprint, ga.PoseOptions(mirror=False, cells=20_000))
    found = [r for r in model.place(case.scene) if r.parent.id == "target"]
    off = [float(np.hypot(*np.subtract(r.pose.position, case.intended.position))) / r.parent.size for r in found]
    rank = next((i for i, o in enumerate(off, 1) if o < AT_PLACE), None)
    lead = found[0].importance - (found[1].importance if len(found) > 1 else 0.0)
    return Outcome(model, ga.PoseResults(found, case.footprint), off[0], rank, lead)


def _warped(outline: Array, at: Array, angle: float, warp: Callable[[Array], Array], footprint: Array) -> Difficulty:
    """An outline and its image; the intended place is the image of the place."""
    ahead = at + 1e-4 * np.array([np.cos(angle), np.sin(angle)])
    image, image_ahead = warp(np.array([at, ahead]))
    towards = image_ahead - image
    scene = ga.Scene([ga.Polygon(outline, "ground", "source"), ga.Polygon(warp(outline), "ground", "target")])
    source = ga.Pose((float(at[0]), float(at[1])), angle)
    return Difficulty(scene, footprint, source, ga.Pose(tuple(image), float(np.arctan2(towards[1], towards[0]))))
