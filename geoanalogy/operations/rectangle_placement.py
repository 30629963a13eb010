"""Placement by several examples (chapter 5): rectangles that a learned rule finds, filled with a library object."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, Self

import numpy as np
import shapely
from numpy.typing import NDArray

from ..errors import InputError
from ..geometry.polygon import Polygon, signed_area
from ..geometry.rectangle import Rectangle
from ..geometry.scene import Scene
from ..placements.arrays import Fit, element_array
from ..placements.examples import Example, checked, parents_of
from ..placements.model import Placement, PlacementModel, learn_placement
from ..placements.options import PlacementOptions
from ..poses.pose import Pose
from ..progress import Stepper
from ..tolerances import CONTAINED_SHARE, SAME_POLYGON
from .element import Element, Ring
from .keys import key_of
from .layout import Layout
from .placing import PlacingOne, with_distinct_keys
from .settings import counts, flag, number, one_of, stored

#: Least score that is computed; the threshold, which sifts without computing, lies above it.
LEAST_SCORE = 0.1


@dataclass(frozen=True)
class DrawnIn:
    """The polygon that an example was drawn in, as an operation remembers it.

    Attributes
    ----------
    id : str
    bounds : (float, float, float, float)
        Its least and greatest coordinates (x0, y0, x1, y1).
    """

    id: str
    bounds: tuple[float, float, float, float]

    def is_in(self, scene: Scene) -> bool:
        """Whether a scene has it, in the same place.

        Parameters
        ----------
        scene : Scene

        Returns
        -------
        bool
        """
        found = next((p for p in scene.polygons if p.id == self.id), None)
        return found is not None and bool(
            np.abs(np.subtract(found.bounds, self.bounds)).max() <= SAME_POLYGON * found.size
        )


def _read_grounds(value: Any) -> tuple[DrawnIn, ...]:
    return tuple(DrawnIn(str(id), tuple(number(b) for b in bounds)) for id, *bounds in value)  # type: ignore[arg-type]


def _write_grounds(grounds: Sequence[DrawnIn]) -> list[list[Any]]:
    return [[g.id, *g.bounds] for g in grounds]


def _read_pair(value: Any) -> tuple[float, float]:
    x, y = value
    return number(x), number(y)


def _read_flags(value: Any) -> tuple[bool, ...]:
    return tuple(flag(one) for one in value)


def _read_ring(value: Any) -> Ring:
    return tuple(_read_pair(corner) for corner in value)


def _read_fit(value: Any) -> tuple[Fit, Fit]:
    read = one_of("scale", "repeat", "divide")
    along, across = value
    return read(along), read(across)  # type: ignore[return-value]


@dataclass(frozen=True, kw_only=True)
class RectanglePlacement(PlacingOne):
    """Put a library object into every rectangle that stands in the relations learned from a few of them.

    It holds the learned model, not the examples, and places in every polygon of the label that those were drawn in.

    Attributes
    ----------
    model : PlacementModel
        What the examples have in common.
    grounds : tuple of DrawnIn
        The polygons that the model's examples were drawn in, one per example: there, they are not placed a second time.
    size : (float, float)
        Width and height of the library object.
    outline : tuple of (float, float)
        What of a placement an element fills: a ring, counter-clockwise, in a square of side 1 about the origin, which
        is stretched over the placement. Empty: all of it.
    fit : (str, str)
        "scale", "repeat" or "divide", along a placement's width and along its height (section 5.6).
    gap : (float, float)
        Least distance between repeated objects, along either axis.
    fill : tuple of bool
        Per example, whether it is filled as well: it was drawn as a rectangle, and no object stands there. Empty: none.
    threshold : float
        Results below this score are not placed.
    max_per : mapping of str to int
        Most placements per parent of a label, the examples counted.
    """

    type = "placement"

    model: PlacementModel = field(metadata=stored(PlacementModel.from_dict, PlacementModel.to_dict))
    grounds: tuple[DrawnIn, ...] = field(metadata=stored(_read_grounds, _write_grounds))
    size: tuple[float, float] = field(metadata=stored(_read_pair, list))
    outline: Ring = field(default=(), metadata=stored(_read_ring, list))
    fit: tuple[Fit, Fit] = field(default=("scale", "scale"), metadata=stored(_read_fit, list))
    gap: tuple[float, float] = field(default=(0.0, 0.0), metadata=stored(_read_pair, list))
    fill: tuple[bool, ...] = field(default=(), metadata=stored(_read_flags, list))
    threshold: float = field(default=0.5, metadata=stored(number, late=True))
    max_per: dict[str, int] = field(default_factory=dict, metadata=stored(counts, dict, late=True))

    def __post_init__(self) -> None:
        taught = len(self.model.lesson.taught)
        if len(self.grounds) != taught or len(self.fill) not in (0, taught):
            raise InputError(
                f"there are {len(self.grounds)} polygons and {len(self.fill)} signs to fill for {taught} examples; "
                "give one of each per example"
            )
        if self.outline and not (len(self.outline) >= 3 and signed_area(np.array(self.outline)) > 0.0):
            raise InputError("the outline is no ring; give at least three corners, counter-clockwise")
        # A size, gap or fit that cannot be is found here, not in the middle of a replay.
        element_array(Rectangle(0.0, 0.0, *self.size), self.size, self.fit, self.gap)

    @classmethod
    def learned(
        cls,
        examples: Sequence[Example],
        options: PlacementOptions | None = None,
        *,
        fill: Sequence[bool] = (),
        **settings: Any,
    ) -> Self:
        """The operation that examples teach.

        Parameters
        ----------
        examples : sequence of Example
        options : PlacementOptions, optional
        fill : sequence of bool
            Per example; empty: none is filled.
        **settings
            Its other attributes.

        Returns
        -------
        RectanglePlacement

        Raises
        ------
        InputError
            For examples that nothing can be learned from.
        """
        kept = checked(examples)
        # An example that was given twice counts once.
        filled = tuple(bool(f) for e, f in zip(examples, fill, strict=bool(fill)) if any(e is k for k in kept))
        drawn = [DrawnIn(str(p.id), tuple(float(b) for b in p.bounds)) for p in parents_of(kept)]  # type: ignore[arg-type]
        return cls(model=learn_placement(kept, options), grounds=tuple(drawn), fill=filled, **settings)

    @property
    def footprint(self) -> NDArray[np.float64]:
        """The library object's rectangle about its centre, or what of that it fills."""
        if self.outline:
            return np.array(self.outline) * self.size
        return Rectangle(0.0, 0.0, *self.size).ring

    @property
    def places_in(self) -> frozenset[str]:
        """The label of the polygons that the example is in."""
        return frozenset({self.model.label})

    def propose(self, layout: Layout, node: str, seed: int) -> Stepper[tuple[Element, ...]]:
        """Place in every parent; then the examples that were drawn here, and no result across one of them."""
        scene = layout.scene
        # What equals the arrangement of an example, but is not where that was drawn, gets what was drawn there.
        elsewhere = not any(ground.is_in(scene) for ground in self.grounds)
        found = _each_once((yield from self.model.placing(scene, LEAST_SCORE, include_examples=elsewhere)))
        fill = self.fill or (False,) * len(self.grounds)
        drawn = [
            (taught.rectangle, taught.target, scene.polygon(ground.id), filled)
            for taught, ground, filled in zip(self.model.lesson.taught, self.grounds, fill, strict=True)
            if ground.is_in(scene)
        ]
        shown: list[Element] = []
        results: list[Placement] = [p for p in found if not self._is_drawn(p, drawn)]
        for rectangle, target, parent, filled in drawn:
            if target > 0 and filled:
                results.append(Placement(rectangle, target, parent, 0.0))
            elif target > 0:
                shown += self._elements([rectangle], Placement(rectangle, target, parent, 0.0), node, example=True)
        for p in sorted(results, key=lambda p: -p.score):
            filling = element_array(p.rectangle, self.size, self.fit, self.gap)
            shown += self._elements(_within(filling, p.parent) if "repeat" in self.fit else filling, p, node)
        return with_distinct_keys(shown)

    def _is_drawn(self, placement: Placement, drawn: Sequence[tuple[Rectangle, float, Polygon, bool]]) -> bool:
        """Whether a result overlaps an example, wanted or not, that was drawn in its parent.

        The model sees to that too, but only where the drawing is the same to the last bit.
        """
        shape = shapely.Polygon(placement.rectangle.ring)
        for rectangle, _, parent, _ in drawn:
            if parent.id == placement.parent.id:
                shared = shapely.area(shapely.intersection(shape, shapely.Polygon(rectangle.ring)))
                if shared > self.model.options.allow_overlaps * min(rectangle.area, placement.rectangle.area):
                    return True
        return False

    def _elements(
        self, rectangles: Sequence[Rectangle], placement: Placement, node: str, example: bool = False
    ) -> list[Element]:
        ring = tuple((float(x), float(y)) for x, y in self.footprint)
        # All objects of an array share the key of their placement, but for a number behind it.
        key = key_of((placement.rectangle.x, placement.rectangle.y), placement.parent)
        return [
            Element(
                self.label,
                self.mesh,
                str(placement.parent.id),
                Pose((r.x, r.y), r.angle),
                ring,
                node,
                key,
                importance=placement.score,
                example=example,
                stretch=(r.width / self.size[0], r.height / self.size[1]),
                novelty=placement.novelty,
            )
            for r in rectangles
        ]

    def chosen(self, results: Sequence[Element], examples: Sequence[Element], layout: Layout) -> Sequence[Element]:
        """The results above the threshold, at most so many placements per parent."""
        most = self.max_per.get(self.model.label, math.inf)
        standing: dict[str, set[str]] = {}
        for e in examples:
            standing.setdefault(e.parent, set()).add(placement_key(e.key))
        kept = []
        for e in results:
            placements = standing.setdefault(e.parent, set())
            if e.importance >= self.threshold and (placement_key(e.key) in placements or len(placements) < most):
                placements.add(placement_key(e.key))
                kept.append(e)
        return kept

    def reads(self, layout: Layout) -> list[Polygon]:
        """The polygons of the label that is placed in, and everything below them."""
        scene = layout.scene
        waiting = [p for p in scene.polygons if p.label == self.model.label]
        read = {p.id for p in waiting}
        while waiting:
            for member in scene.members_of(str(waiting.pop().id)):
                if member.id not in read:
                    read.add(member.id)
                    waiting.append(member)
        return [p for p in scene.polygons if p.id in read]


def _within(rectangles: Sequence[Rectangle], parent: Polygon) -> list[Rectangle]:
    """Those of the objects of an array that lie in a parent of any shape."""
    shapes = shapely.polygons([r.ring for r in rectangles])
    held = shapely.area(shapely.intersection(shapes, parent.shape)) / shapely.area(shapes)
    return [r for r, share in zip(rectangles, held, strict=True) if share >= CONTAINED_SHARE]


def _each_once(placements: Sequence[Placement]) -> list[Placement]:
    """Placements without repetitions: two examples may have been drawn alike in equal arrangements."""
    once: dict[tuple[object, ...], Placement] = {}
    for p in placements:
        r = p.rectangle
        once.setdefault((p.parent.id, *np.round([r.x, r.y, r.width, r.height], 6).tolist()), p)
    return list(once.values())


def siblings(key: str, keys: Sequence[str]) -> list[str]:
    """The keys of the objects that fill the same placement as one of them.

    Parameters
    ----------
    key : str
    keys : sequence of str
        Of all results.

    Returns
    -------
    list of str
        In order, itself included.
    """
    return [other for other in keys if placement_key(other) == placement_key(key)]


def placement_key(key: str) -> str:
    """The key of the placement that an object of an array fills.

    Parameters
    ----------
    key : str

    Returns
    -------
    str
    """
    parent, _, place = key.rpartition("@")
    return f"{parent}@{','.join(place.split(',')[:2])}"


def outline_of(elements: Sequence[Element]) -> Rectangle:
    """The rectangle that the objects of one placement fill.

    Parameters
    ----------
    elements : sequence of Element
        At least one; all of one direction.

    Returns
    -------
    Rectangle
    """
    angle = elements[0].pose.angle
    points = np.vstack([e.ring for e in elements if e.ring is not None])
    c, s = np.cos(angle), np.sin(angle)
    turned = points @ np.array([[c, -s], [s, c]])
    return Rectangle.from_box(np.hstack([turned.min(axis=0), turned.max(axis=0)]), angle)
