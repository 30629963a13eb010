"""The examples a user gives: their parents and the directions of their frames (sections 5.2 and 5.6)."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from ..arguments import given, listed, real, shown
from ..errors import InputError
from ..geometry.polygon import Polygon
from ..geometry.rectangle import Rectangle
from ..geometry.scene import Scene
from ..relations.elements import Elements
from ..relations.observation import Observation
from ..tolerances import CONTAINED_SHARE, JUTTING_MEAN, JUTTING_SHARE, NEAR_PARENT, PARALLEL_ANGLE, SAME_RECTANGLE

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Example:
    """One placement that the user drew, and how much it is wanted.

    Attributes
    ----------
    scene : Scene
    rectangle : Rectangle
        In the scene's coordinates.
    target : float
        From 1 (wanted) to 0 (a counter-example: nothing of the kind is wanted).

    Raises
    ------
    InputError
        For a target outside [0, 1].
    """

    scene: Scene
    rectangle: Rectangle
    target: float = 1.0

    def __post_init__(self) -> None:
        given(self.scene, Scene, "the scene of an example", "Scene([polygon, …])")
        given(self.rectangle, Rectangle, "the rectangle of an example", "Rectangle(x, y, width, height, angle)")
        if not 0 <= real(self.target) <= 1:
            raise InputError(
                f"the example at x {self.rectangle.x:.6g}, y {self.rectangle.y:.6g} has the target "
                f"{shown(self.target)}; give a number from 0 (not wanted) to 1 (wanted)"
            )
        object.__setattr__(self, "target", float(self.target))


@dataclass(frozen=True)
class Orientation:
    """How the frame of a placement follows from its surroundings.

    Section 5.7 names oriented boxes as future work. Here a frame is turned by a fixed angle against the parent's main
    orientation, or against the parent's segment that is nearest to the placement's centre.

    Attributes
    ----------
    by_segment : bool
    offset : float
        Radians.
    """

    by_segment: bool = False
    offset: float = 0.0

    def to_dict(self) -> dict[str, Any]:
        """Plain data, as it is written to JSON."""
        return {"by_segment": self.by_segment, "offset": self.offset}

    def frame_at(self, parent: Polygon, point: Array) -> float:
        """Direction in radians of the frame of a placement with its centre at a point.

        Parameters
        ----------
        parent : Polygon
        point : ndarray of shape (2,)

        Returns
        -------
        float
        """
        base = float(nearest_directions(parent, point[None])[0]) if self.by_segment else parent.main_orientation
        return base + self.offset

    def frames(self, parent: Polygon) -> list[float]:
        """Every frame that placements in a parent can have.

        Parameters
        ----------
        parent : Polygon

        Returns
        -------
        list of float
        """
        if not self.by_segment:
            return [parent.main_orientation + self.offset]
        elements = Elements.of([parent])
        found: list[float] = []
        for angle in np.arctan2(elements.edge_vector[:, 1], elements.edge_vector[:, 0]):
            if all(abs(_turn(angle - other, 2 * np.pi)) > PARALLEL_ANGLE for other in found):
                found.append(float(angle))
        return [angle + self.offset for angle in found]


def nearest_directions(parent: Polygon, points: Array) -> Array:
    """Direction in radians of the parent's boundary at the place nearest to each point.

    Parameters
    ----------
    parent : Polygon
    points : ndarray of shape (n, 2)

    Returns
    -------
    ndarray of shape (n,)
    """
    return Observation(Elements.of([parent]), points).boundary.tangent[0]


def _turn(angle: float | Array, period: float) -> Any:
    return (np.asarray(angle) + period / 2) % period - period / 2


def orientation_of(examples: Sequence[Example], parents: Sequence[Polygon]) -> Orientation:
    """The rule for the frame that the examples' angles fit best; the parent's own frame where both fit.

    Parameters
    ----------
    examples : sequence of Example
    parents : sequence of Polygon
        Of each example.

    Returns
    -------
    Orientation
    """
    angles = np.array([e.rectangle.angle for e in examples])
    centres = np.array([(e.rectangle.x, e.rectangle.y) for e in examples])
    tried = []
    for by_segment in (False, True):
        base = np.array(
            [
                nearest_directions(p, c[None])[0] if by_segment else p.main_orientation
                for p, c in zip(parents, centres, strict=True)
            ]
        )
        off = angles - base
        mean = float(np.angle(np.exp(4j * off).sum()) / 4)
        spread = float(np.abs(_turn(off - mean, np.pi / 2)).max())
        # Drawn parallel, or nearly so, is meant parallel.
        tried.append((spread, Orientation(by_segment, 0.0 if abs(mean) <= PARALLEL_ANGLE else mean)))
    by_parent, by_segment_ = tried
    return by_segment_[1] if by_parent[0] > 2 * PARALLEL_ANGLE and by_segment_[0] < by_parent[0] / 2 else by_parent[1]


def checked(examples: Sequence[Example]) -> list[Example]:
    """The examples without repetitions.

    Parameters
    ----------
    examples : sequence of Example

    Returns
    -------
    list of Example

    Raises
    ------
    InputError
        For no examples, targets that are all 0, or one rectangle with two targets.
    """
    kept: list[Example] = []
    for example in listed(examples, "what is given as examples", "a list of them"):
        if not isinstance(example, Example):
            raise InputError(
                f"examples are of the type Example, not {type(example).__name__}; give Example(scene, Rectangle(…))"
            )
        twin = next((k for k in kept if k.scene is example.scene and _same(k.rectangle, example.rectangle)), None)
        if twin is None:
            kept.append(example)
        elif twin.target != example.target:
            r = example.rectangle
            raise InputError(
                f"the rectangle at x {r.x:.6g}, y {r.y:.6g} is given twice, with the targets {twin.target:g} and "
                f"{example.target:g}; keep one of them"
            )
    if not kept:
        raise InputError("there are no examples to learn from; draw at least one rectangle")
    if not any(e.target > 0 for e in kept):
        raise InputError("all examples have the target 0; give at least one rectangle that is wanted a target above 0")
    return kept


def _same(a: Rectangle, b: Rectangle) -> bool:
    limit = SAME_RECTANGLE * max(a.width, a.height)
    return bool((np.abs(np.sort(a.ring, axis=0) - np.sort(b.ring, axis=0)) <= limit).all())


def parents_of(examples: Sequence[Example]) -> list[Polygon]:
    """The parent of every example: polygons of one label, the smallest of which one contains each example.

    Drawn boxes jut out of drawn outlines: 95 % of its area is enough for an example to be contained, and one of several
    may jut out further where the others do not. Where no label contains them all (a window beyond the edge of a
    photograph), the one that contains most does, and the others belong to the polygon of that label nearest to them.

    Parameters
    ----------
    examples : sequence of Example

    Returns
    -------
    list of Polygon

    Raises
    ------
    InputError
        For an example that lies in no polygon and near none of the label that contains the others.
    """
    found = [_holding(e) for e in examples]
    shares = {label: [of.get(label, (0.0, None))[0] for of in found] for label in {name for of in found for name in of}}
    if not shares:
        raise InputError(f"{_named(examples[0])} lies in no polygon of its scene; draw it inside one")

    def size(label: str) -> tuple[float, str]:
        return float(np.mean([of[label][1].area for of in found if label in of])), label

    def contains(share: list[float]) -> bool:
        within = np.array(share)
        return bool(
            np.median(within) >= CONTAINED_SHARE and within.mean() >= JUTTING_MEAN and within.min() >= JUTTING_SHARE
        )

    labels = [label for label, share in shares.items() if contains(share)]
    if not labels:
        count = {label: sum(s >= JUTTING_SHARE for s in share) for label, share in shares.items()}
        labels = [label for label in count if count[label] == max(count.values())]
    label = min(labels, key=size)
    return [of[label][1] if label in of else _nearest(e, label) for e, of in zip(examples, found, strict=True)]


def _holding(example: Example) -> dict[str, tuple[float, Polygon]]:
    """The polygon of each label that holds most of an example, and the share: the smallest that holds 95 % of it."""
    shape = shapely.Polygon(example.rectangle.ring)
    found: dict[str, tuple[float, Polygon]] = {}
    r = example.rectangle
    for polygon in example.scene.polygons:
        x0, y0, x1, y1 = polygon.bounds
        if not (x0 <= r.x <= x1 and y0 <= r.y <= y1):
            continue
        share = float(shapely.area(shapely.intersection(polygon.shape, shape)) / shape.area)
        if share < JUTTING_SHARE:
            continue
        known, best = found.get(polygon.label, (0.0, polygon))
        enough, known_enough = share >= CONTAINED_SHARE, known >= CONTAINED_SHARE
        if (enough and known_enough and polygon.area < best.area) or (share > known and not known_enough):
            found[polygon.label] = share, polygon
    return found


def _nearest(example: Example, label: str) -> Polygon:
    shape = shapely.Polygon(example.rectangle.ring)
    some = [p for p in example.scene.polygons if p.label == label]
    away = [float(shapely.distance(p.shape, shape)) for p in some]
    best = min(range(len(some)), key=lambda i: (away[i], some[i].area), default=None)
    if best is None or away[best] > NEAR_PARENT * some[best].size:
        raise InputError(
            f"{_named(example)} lies outside every polygon labelled {label!r}, which hold the other examples; "
            "draw it inside one"
        )
    return some[best]


def _named(example: Example) -> str:
    return f"the example at x {example.rectangle.x:.6g}, y {example.rectangle.y:.6g}"
