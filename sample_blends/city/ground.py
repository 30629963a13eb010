"""The ground of maps without gaps: streets, pavements, walks and drives up to lots, and the grass between them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

from .lots import Lot

#: Half the width of carriageways, and with the pavements, metres.
CARRIAGEWAY, PAVEMENT = 3.6, 6.4

#: Least width of a pavement where plots come near to the street, metres.
NARROW = 1.6

#: How far a front garden may lie between a lot and its street, metres.
FRONT = 13.5

#: Strips up to this width between pavements and lots are paved, metres.
SLIVER = 0.8

#: Ways up to this width or length are part of the pavement, metres.
SHORT = 0.9

#: Least width of a polygon of its own, and distance of what touches, metres.
THINNEST, TOUCHING = 0.6, 0.002

#: Grass is divided into squares of this size, metres: polygons with a few holes each.
CELL = 60.0


@dataclass(frozen=True)
class Paved:
    """What is paved on a map.

    Attributes
    ----------
    street, pavement : geometry
    walks, drives : geometry
        Before lots, up to the pavement.
    """

    street: BaseGeometry
    pavement: BaseGeometry
    walks: BaseGeometry
    drives: BaseGeometry

    @property
    def whole(self) -> BaseGeometry:
        """All of it."""
        return shapely.union_all([self.street, self.pavement, self.walks, self.drives])


def strips(lot: Lot) -> list[tuple[str, shapely.Polygon]]:
    """The walks and drives of a lot's house, continued from its front to as far as its street may be."""
    a, b = lot.ring[:2]
    along = (b - a) / lot.width
    out = FRONT * np.array([along[1], -along[0]])
    found = []
    for kind, start, end in lot.ways:
        from_, to = a + start * along, a + end * along
        found.append((kind, shapely.Polygon([from_, from_ + out, to + out, to])))
    return found


def reaches(lot: Lot, carriageway: BaseGeometry, plots: BaseGeometry) -> bool:
    """Whether all walks and drives of a lot get to a street, and lead over no ground of others on the way there."""
    front = lot.front
    for _, strip in strips(lot):
        before = [p for p in shapely.get_parts(strip.difference(carriageway)) if p.distance(front) < 0.1]
        if len(before) != 1 or strip.intersection(carriageway).area < 0.5 or before[0].intersection(plots).area > 1.0:
            return False
    return True


def paved(lines: Sequence[shapely.LineString], lots: Sequence[Lot], beside: BaseGeometry) -> Paved:
    """Carriageways, pavements of one width, narrower where something is beside them, and ways from lots to these.

    Parameters
    ----------
    lines : sequence of LineString
        The middles of streets.
    lots : sequence of Lot
    beside : geometry
        What pavements give way to.
    """
    middle = shapely.union_all(lines)
    street = middle.buffer(CARRIAGEWAY, quad_segs=4)
    built = shapely.union_all([lot.shape for lot in lots])
    narrow = middle.buffer(CARRIAGEWAY + NARROW, quad_segs=4)
    pavement = middle.buffer(PAVEMENT, quad_segs=4).difference(beside.difference(narrow))
    # What is left between a pavement and the front of a lot is no garden.
    near = middle.buffer(PAVEMENT + SLIVER, quad_segs=4).difference(beside).difference(pavement)
    thin = near.difference(near.buffer(-SLIVER / 2).buffer(SLIVER / 2, join_style="mitre"))
    fronts = shapely.union_all([lot.front.buffer(SLIVER, cap_style="flat") for lot in lots])
    pavement = shapely.union_all([pavement, thin.intersection(fronts)]).difference(street).difference(built)
    ways: dict[str, list[BaseGeometry]] = {"walk": [], "drive": [], "short": []}
    for lot in lots:
        for kind, strip in strips(lot):
            before = [p for p in shapely.get_parts(strip.difference(street)) if p.distance(lot.front) < 0.1]
            rest = shapely.union_all(before).difference(pavement).difference(built)
            parts = [p for p in shapely.get_parts(rest) if p.area > 0.0]
            ways[kind] += [p for p in parts if p.area > SHORT * p.length / 2]
            ways["short"] += [p for p in parts if p.area <= SHORT * p.length / 2]
    walks, drives, short = (shapely.union_all(ways[kind]) for kind in ways)
    return Paved(street, pavement.union(short), walks, drives)


def cells(area: BaseGeometry) -> list[BaseGeometry]:
    """An area divided by a grid."""
    if area.is_empty:
        return []
    x0, y0, x1, y1 = area.bounds
    boxes = [shapely.box(x, y, x + CELL, y + CELL) for x in np.arange(x0, x1, CELL) for y in np.arange(y0, y1, CELL)]
    shapely.prepare(area)
    return [area.intersection(box) for box in boxes if area.intersects(box)]


def without_slivers(parts: Sequence[tuple[str, BaseGeometry]]) -> list[tuple[str, shapely.Polygon]]:
    """Labelled polygons, of which those too thin to be anything belong to what they share most of their edges with."""
    every = [(label, p) for label, shape in parts for p in shapely.get_parts(shape) if p.geom_type == "Polygon"]
    kept = [(label, p) for label, p in every if not is_thin(p)]
    labels, shapes = [label for label, _ in kept], [p for _, p in kept]
    thin = [p for _, p in every if is_thin(p)]
    while thin:
        tree = shapely.STRtree(shapes)
        joining: dict[int, list[shapely.Polygon]] = {}
        left = []  # thin ones that only others separate from all that is not
        for p in thin:
            near = tree.query(p, predicate="dwithin", distance=TOUCHING)
            shared = [shapes[i].buffer(TOUCHING).intersection(p.exterior).length for i in near]
            if len(near):
                joining.setdefault(int(near[int(np.argmax(shared))]), []).append(p)
            else:
                left.append(p)
        if len(left) == len(thin):
            break
        thin = left
        for i, more in joining.items():
            # Widened by what rounding has put between them.
            shapes[i] = shapely.union_all([shapes[i], *(p.buffer(TOUCHING, join_style="mitre") for p in more)])
    found = zip(labels, shapes, strict=True)
    return [(label, p) for label, shape in found for p in shapely.get_parts(shape) if not is_thin(p)]


def is_thin(polygon: shapely.Polygon) -> bool:
    """Whether a polygon is narrower than what maps are made of."""
    return bool(polygon.area <= THINNEST * polygon.length / 2)
