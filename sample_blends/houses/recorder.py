"""Record operations as a user does: draw a few rectangles in the example scene, let the rule be learned, go on."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

import geoanalogy as ga
from geoanalogy.geometry.extrusion import FaceLabels
from geoanalogy.geometry.roof import Roof
from geoanalogy.operations.boolean import Boolean
from geoanalogy.operations.extrusion import Extrusion
from geoanalogy.operations.layout import Layout, OnSurface
from geoanalogy.operations.node import Link, Node
from geoanalogy.operations.operation import Operation
from geoanalogy.operations.rectangle_placement import RectanglePlacement
from geoanalogy.operations.selection import Selection

#: Left, lower, right and upper edge.
Box = tuple[float, float, float, float]


@dataclass(frozen=True)
class Sheet:
    """A polygon that the user draws in, its own frame upright: x to the right along its front, y away from it.

    Attributes
    ----------
    scene : Scene
    polygon : Polygon
    """

    scene: ga.Scene
    polygon: ga.Polygon

    def box(self, ring: np.ndarray) -> Box:
        c, s = np.cos(self.polygon.main_orientation), np.sin(self.polygon.main_orientation)
        turned = ring @ np.array([[c, -s], [s, c]])
        return (*turned.min(axis=0).tolist(), *turned.max(axis=0).tolist())

    @property
    def edges(self) -> Box:
        return self.box(self.polygon.points)

    @property
    def width(self) -> float:
        x0, _, x1, _ = self.edges
        return x1 - x0

    @property
    def height(self) -> float:
        _, y0, _, y1 = self.edges
        return y1 - y0

    def boxes(self, label: str) -> list[Box]:
        """What of a label stands in it, from left to right."""
        inside = [p for p in self.scene.polygons if p.label == label and self.polygon.shape.contains(p.shape.centroid)]
        return sorted(self.box(p.points) for p in inside if p is not self.polygon)

    def rectangle(self, box: Box) -> ga.Rectangle:
        return ga.Rectangle.from_box(np.array(box, float), self.polygon.main_orientation)


#: What of the settings of a placement says how it is learned.
OPTIONS = ("tau", "area_tolerance", "aspect_tolerance", "forbid_intersections")

#: Draws what belongs on a sheet: boxes in its frame; none where the user would leave it alone.
Draw = Callable[[Sheet], Sequence[Box]]


class Recorder:
    """An operations tree that grows by what is drawn in one scene.

    Attributes
    ----------
    tree : OperationsTree
    at : tuple of Link
        What the next operation builds on: the chosen leaf.
    """

    def __init__(self, scene: ga.Scene) -> None:
        self.scene = scene
        self.tree = ga.OperationsTree()
        self.at: tuple[Link, ...] = ()

    def record(self, name: str, operation: Operation) -> str:
        """Add an operation after the chosen leaf, and choose it."""
        id = f"{len(self.tree.nodes) + 1:02d} {name}"
        self.tree = self.tree.with_node(Node(id, operation, self.at))
        self.at = (Link(id),)
        return id

    def layout(self) -> Layout:
        return self.tree.layout(self.scene, self.at) if self.at else Layout(self.scene)

    def sheets(self, label: str) -> Iterator[Sheet]:
        """The polygons of a label to draw in: on the ground, and on surfaces."""
        layout = self.layout()
        for polygon in layout.scene.polygons:
            if polygon.label == label:
                yield Sheet(layout.scene, polygon)
        for surface in layout.surfaces({label}):
            there = OnSurface(layout.ground, surface=surface, standing=tuple(layout.elements_on(surface)))
            for polygon in there.scene.polygons:
                if polygon.label == label:
                    yield Sheet(there.scene, polygon)

    def place(self, label: str, on: str, draw: Draw, examples: int = 5, **settings: Any) -> str:
        """Draw examples on the first few sheets that they belong on, and place what is like them."""
        options = {name: settings.pop(name) for name in OPTIONS if name in settings}
        drawn: list[ga.Example] = []
        distinct: dict[tuple[float, float], Sheet] = {}
        again = []  # a second sheet of the same size teaches nothing, but one example alone is ambiguous
        for sheet in self.sheets(on):
            if distinct.setdefault((round(sheet.width, 2), round(sheet.height, 2)), sheet) is not sheet:
                again.append(sheet)
        for k, sheet in enumerate([*distinct.values(), *again]):
            if len(drawn) >= examples or (k >= len(distinct) and len(drawn) >= 2):
                break
            boxes = [box for box in draw(sheet) if box[2] > box[0] and box[3] > box[1]]  # where there is room
            drawn += [ga.Example(sheet.scene, sheet.rectangle(box)) for box in boxes]
        settings = {"mesh": "", "size": (1.0, 1.0), "threshold": 0.6, **settings}
        operation = RectanglePlacement.learned(
            drawn[: max(examples, 1)],
            ga.PlacementOptions(**options),
            label=label,
            fill=(True,) * len(drawn[: max(examples, 1)]),
            **settings,
        )
        return self.record(f"place {label}", operation)

    def extrude(
        self,
        label: str,
        height: float,
        factor: tuple[float, float] = (1.0, 1.0),
        inwards: bool = False,
        roof: Roof | None = None,
        walls: float = 0.0,
        **faces: str,
    ) -> str:
        labels = {"side": label, "top": label, "bottom": label, **faces}
        operation = Extrusion(
            label=label,
            height=height,
            factor=factor,
            inwards=inwards,
            roof=roof or Roof(),
            walls=walls,
            faces=FaceLabels(**labels),
        )
        return self.record(f"extrude {label}", operation)

    def merge(self, label: str, target: str = "surface") -> str:
        return self.record(f"merge {label}", Boolean(label=label, kind="merge", target=target))  # type: ignore[arg-type]

    def subtract(self, label: str, target: str = "surface") -> str:
        return self.record(f"subtract {label}", Boolean(label=label, kind="subtract", target=target))  # type: ignore[arg-type]

    def select(self, label: str, weights: Sequence[float], seed: int = 0) -> list[Link]:
        """Divide what is of a label; the links of the sets, none of which is chosen yet."""
        id = self.record(f"select {label}", Selection(label=label, weights=tuple(weights), seed=seed))
        return [Link(id, k) for k in range(len(weights))]

    def recess(self, label: str, depth: float, back: str, reveal: str = "reveal") -> None:
        """Push rectangles in: two operations."""
        self.extrude(label, depth, inwards=True, top=back, side=reveal)
        self.subtract(label)

    def attach(self, label: str, height: float, **faces: str) -> None:
        """Pull rectangles out: two operations."""
        self.extrude(label, height, **faces)
        self.merge(label)
