"""Extrusion: polygons become solids, whose faces are surfaces (section 5.6)."""

from collections.abc import Hashable, Iterator, Mapping
from dataclasses import asdict, dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..geometry.extrusion import FaceLabels, extrude
from ..geometry.polygon import Polygon
from ..geometry.roof import Roof
from ..geometry.solid import Solid
from ..geometry.surface import GROUND, Surface
from ..poses.pose import Pose
from ..progress import Stepper
from .chance import share
from .element import DIGITS, Element
from .keys import key_of
from .layout import Layout
from .operation import Operation
from .settings import flag, number, one_of, stored, text

Array = NDArray[np.float64]

#: Cosine of the angle between the outward normals of a side and of a labelled edge up to which the side faces the edge.
FACING = float(np.cos(np.radians(45.0)))


def _read_range(value: Any) -> tuple[float, float]:
    low, high = value
    return number(low), number(high)


def _read_roof(value: Mapping[str, Any]) -> Roof:
    plain: dict[str, Any] = {name: None if v is None else number(v) for name, v in value.items() if name != "kind"}
    kind: Any = one_of("flat", "hip", "gable", "mansard")(value.get("kind", "flat"))
    return Roof(kind=kind, **plain)


def _read_labels(value: Mapping[str, Any]) -> FaceLabels:
    return FaceLabels(**{str(name): text(label) for name, label in value.items()})


@dataclass(frozen=True, kw_only=True)
class Extrusion(Operation):
    """Extrude every polygon of a label along the normal of its surface.

    Polygons are elements that have no solid yet, polygons of the ground, and surfaces.

    Attributes
    ----------
    label : str
        Of what is extruded. What was no element before becomes one of this label.
    height : float
        Scene units, positive.
    factor : (float, float)
        Least and greatest random multiplier of the height, drawn for every element on its own.
    inwards : bool
        Whether it reaches below the surface, for what will be subtracted.
    roof : Roof
        At the far end.
    walls : float
        Thickness of walls and floor: the polygon becomes a room that is open at the far end, whose sides look inwards;
        0: a full body.
    faces : FaceLabels
        What the new surfaces are called. Sides that face a labelled edge of the polygon below get that edge's label in
        front, "street facade"; sides on an upright surface that look up or down "upper" or "lower".
    """

    type = "extrusion"
    random = True

    label: str = field(metadata=stored(text))
    height: float = field(metadata=stored(number))
    factor: tuple[float, float] = field(default=(1.0, 1.0), metadata=stored(_read_range, list))
    inwards: bool = field(default=False, metadata=stored(flag))
    roof: Roof = field(default_factory=Roof, metadata=stored(_read_roof, asdict))
    walls: float = field(default=0.0, metadata=stored(number))
    faces: FaceLabels = field(default_factory=FaceLabels, metadata=stored(_read_labels, asdict))

    def propose(self, layout: Layout, node: str, seed: int) -> Stepper[tuple[tuple[Element, ...], tuple[str, ...]]]:
        """The elements with their solids, and what could not be extruded."""
        made, problems = [], []
        targets = list(self._targets(layout, node))
        for i, (element, polygon, labels) in enumerate(targets):
            if i % 64 == 0:
                yield i / len(targets), f"extruding {self.label} {i + 1} of {len(targets)}"
            try:
                low, high = self.factor
                height = self.height * (low + (high - low) * share(seed, element.id))
                solid = self._solid(element, polygon, height, labels, layout)
                made.append(element.changed(base=solid, solid=solid))
            except InputError as error:
                problems.append(f"node {node!r}: {self.label} {element.id!r} is left flat: {error}")
        return tuple(made), tuple(problems)

    def _solid(
        self, element: Element, polygon: Polygon, height: float, labels: tuple[str, ...], layout: Layout
    ) -> Solid:
        if not height > 0.0:
            raise InputError(f"the height is {height:g}; give a positive one")
        up = np.round(element.place.axes[:, 2], 9) + 0.0
        rings = tuple(ring.tobytes() for ring in polygon.rings)
        name = ("extruded", rings, height, self.inwards, self.walls, self.faces, self.roof, labels, tuple(up.tolist()))
        solid: Solid = layout.ground.memory.recall(
            name,
            lambda: extrude(
                polygon, -height if self.inwards else height, self.faces, self.roof, labels, up, self.walls
            ),
        )
        return solid

    def _targets(self, layout: Layout, node: str) -> Iterator[tuple[Element, Polygon, tuple[str, ...]]]:
        """What is extruded: elements, their outlines in their own frames, and the labels of the edges of these."""
        yield from layout.derived(("extruded", self.label), lambda: self._standing(layout))
        extruded = {e.parent for e in layout.visible if e.node == node}
        for polygon in layout.scene.polygons if self.label else ():
            if polygon.label == self.label and polygon.id not in layout.by_id and polygon.id not in extruded:
                e, own = _element_of(polygon, node)
                yield e, own, self._labels(own, e, layout)
        for surface in layout.surfaces({self.label}):
            if surface.label == self.label:
                e, own = _element_of(surface.polygon, node, surface)
                yield e, own, self._labels(own, e, layout)

    def _standing(self, layout: Layout) -> list[tuple[Element, Polygon, tuple[str, ...]]]:
        """`_targets` among the elements."""
        return [
            (e, e.outline, self._labels(e.outline, e, layout))
            for e in layout.visible
            if e.label == self.label and e.solid is None and not e.absorbed_by and e.outline is not None
        ]

    def _labels(self, own: Polygon, element: Element, layout: Layout) -> tuple[str, ...]:
        """A label per edge of an outline in its element's frame: its own, that of the edge it faces, or its side."""
        edges = np.roll(own.points, -1, axis=0) - own.points
        normals = np.column_stack([edges[:, 1], -edges[:, 0]]) / np.hypot(*edges.T)[:, None]
        if any(own.segment_labels):
            return own.segment_labels
        if element.surface != GROUND:
            heights = normals @ element.place.axes[:2, 2]
            return tuple("upper" if h > FACING else "lower" if h < -FACING else "" for h in heights)
        below = layout.scene.polygon(element.parent) if element.parent in layout.polygon_ids else None
        while below is not None and not any(below.segment_labels):
            below = layout.scene.parent(str(below.id))
        return ("",) * len(own.points) if below is None else _facing(normals, element.pose.angle, below)

    def decide(self, proposed: tuple[tuple[Element, ...], tuple[str, ...]], layout: Layout, node: str) -> tuple[Layout]:
        """The layout with the solids."""
        elements, problems = proposed
        return (layout.with_elements(elements).with_problems(problems),)

    def content(self, layout: Layout) -> tuple[Hashable, ...]:
        """The settings, the outlines, and the labels of their edges."""
        return (self._lesson, *((e, own.content, labels) for e, own, labels in self._targets(layout, "")))


def _element_of(polygon: Polygon, node: str, surface: Surface | None = None) -> tuple[Element, Polygon]:
    """A polygon of the ground, or a surface, as an element that can be extruded, and its outline in its own frame."""
    x, y = polygon.centroid
    pose = Pose((float(x), float(y)), polygon.main_orientation)
    c, s = np.cos(pose.angle), np.sin(pose.angle)
    turn = np.array([[c, -s], [s, c]])
    rings = [np.round((ring - pose.position) @ turn, DIGITS) + 0.0 for ring in polygon.rings]
    own = Polygon(rings[0], polygon.label, None, rings[1:], segment_labels=polygon.segment_labels)
    footprint = tuple((float(u), float(v)) for u, v in own.points)
    key = key_of(pose.position, polygon)
    e = Element(polygon.label, "", str(polygon.id), pose, footprint, node, key)
    if surface is not None:
        e = e.changed(surface=surface.id, owner=surface.parent, frame=surface.frame)
    return e, own


def _facing(normals: Array, angle: float, below: Polygon) -> tuple[str, ...]:
    """The label of the labelled edge of a polygon that each normal of a frame turned by an angle points to."""
    edges = np.roll(below.points, -1, axis=0) - below.points
    c, s = np.cos(angle), np.sin(angle)
    outwards = np.column_stack([edges[:, 1], -edges[:, 0]]) / np.hypot(*edges.T)[:, None] @ np.array([[c, -s], [s, c]])
    named = [i for i, label in enumerate(below.segment_labels) if label]
    along = normals @ outwards[named].T
    best = along.argmax(axis=1)
    return tuple(below.segment_labels[named[k]] if row[k] >= FACING else "" for row, k in zip(along, best, strict=True))
