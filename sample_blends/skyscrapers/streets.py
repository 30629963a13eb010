"""Streets round the lots: pavements with kerbs and trees, roads with lanes and crossings, and a park beyond."""

from __future__ import annotations

import itertools
from collections.abc import Iterator

import numpy as np
import shapely

import geoanalogy as ga
from geoanalogy.geometry.extrusion import FaceLabels, extrude
from geoanalogy.geometry.frame import Frame
from geoanalogy.geometry.mesh import Mesh

from ..library import trees  # noqa: F401
from ..library.assets import ASSETS
from ..pictures import engine_mesh

#: Metres: how far pavements reach round a lot along and across the row, the radius of their corners, the kerb's height,
#: and the road round all.
BESIDE, BEFORE, CORNER, KERB, AVENUE = 3.5, 5.0, 2.5, 0.14, 18.0

#: Lanes: length, gap and width of the dashes, and how thick the paint is drawn.
DASH, GAP, LINE, PAINT = 3.0, 4.0, 0.18, 0.02

#: Stripes of crossings: length, width and distance.
STRIPE, STRIPE_WIDTH, STRIPES_APART = 3.0, 0.5, 1.0

#: Trees on pavements: how far from the kerb and from each other; and in the park, how far from the road.
FROM_KERB, TREES_APART, IN_PARK = 1.1, 9.0, 9.0

#: Width of the park.
PARK = 60.0

Box = tuple[float, float, float, float]


def _slab(shape: shapely.Polygon, low: float, high: float, top: str, side: str) -> Mesh:
    ring = shapely.get_coordinates(shapely.orient_polygons(shape).exterior)[:-1]
    holes = [shapely.get_coordinates(hole)[:-1] for hole in shape.interiors]
    body = extrude(ga.Polygon(ring, holes=holes), high - low, FaceLabels(side, top, side))
    return body.mesh.placed(Frame((0.0, 0.0, low)))


def blocks(lots: ga.Scene) -> list[Box]:
    """The pavement round every lot: as deep as the deepest lot of its row."""
    every = [tuple(float(v) for v in lot.bounds) for lot in lots.polygons]
    found = []
    for x0, y0, x1, _ in every:
        back = max(top for _, front, _, top in every if front == y0)
        found.append((x0 - BESIDE, y0 - BEFORE, x1 + BESIDE, back + BEFORE))
    return found


def surroundings(lots: ga.Scene) -> Iterator[Mesh]:
    """All that there is round the buildings, whose bases lie at height 0."""
    pavements = blocks(lots)
    low, high = np.min(pavements, axis=0)[:2], np.max(pavements, axis=0)[2:]
    whole = shapely.box(*(low - AVENUE), *(high + AVENUE))
    yield _slab(whole, -KERB - 0.3, -KERB, "asphalt", "asphalt")
    for box in pavements:
        shape = shapely.box(*box).buffer(-CORNER).buffer(CORNER)
        yield _slab(shape, -KERB, -0.005, "pavement", "kerb")
    park = whole.buffer(PARK, join_style="mitre")
    path = whole.buffer(BEFORE, join_style="mitre")
    yield _slab(path - whole, -KERB, -0.005, "pavement", "kerb")
    yield _slab(park - path, -KERB, -0.02, "lawn", "lawn")
    for box in _paint(pavements, low, high):
        yield _slab(shapely.box(*box), -KERB - PAINT, -KERB + PAINT, "paper", "paper")
    tree, small = (engine_mesh(ASSETS[name].solid()) for name in ("broad-leaved tree", "small tree"))
    rng = np.random.default_rng(1)
    for mesh, places in ((small, _street_trees(pavements)), (tree, _park_trees(whole))):
        for x, y in places:
            turn = rng.uniform(0.0, 2.0 * np.pi)
            yield mesh.placed(Frame((float(x), float(y), 0.0)).moved(0.0, 0.0, float(turn)))


def _paint(pavements: list[Box], low: np.ndarray, high: np.ndarray) -> Iterator[Box]:
    """Dashes between the lanes of the streets along the rows, and crossings of the streets across."""
    rows = sorted({(y0, y1) for _, y0, _, y1 in pavements})
    levels = [rows[0][0] - AVENUE / 2, *((a[1] + b[0]) / 2 for a, b in itertools.pairwise(rows))]
    for y in (*levels, rows[-1][1] + AVENUE / 2):
        for x in np.arange(low[0] - AVENUE / 2, high[0] + AVENUE / 2, DASH + GAP):
            yield (float(x), y - LINE / 2, float(x) + DASH, y + LINE / 2)
    for y0, y1 in rows:
        along = sorted((x0, x1) for x0, front, x1, _ in pavements if front == y0)
        for (_, a), (b, _) in itertools.pairwise(along):
            for x in np.arange(a + STRIPE_WIDTH, b - STRIPE_WIDTH, STRIPES_APART):
                for y in (y0 + CORNER, y1 - CORNER - STRIPE):
                    yield (float(x), y, float(x) + STRIPE_WIDTH, y + STRIPE)


def _street_trees(pavements: list[Box]) -> Iterator[tuple[float, float]]:
    """Along the kerbs before and behind the lots."""
    for x0, y0, x1, y1 in pavements:
        for x in np.linspace(x0 + 4.0, x1 - 4.0, max(round((x1 - x0 - 8.0) / TREES_APART), 1) + 1):
            yield from ((float(x), y0 + FROM_KERB), (float(x), y1 - FROM_KERB))


def _park_trees(streets: shapely.Polygon) -> Iterator[tuple[float, float]]:
    """Rows of trees along the inner edge of the park, and some behind them."""
    rng = np.random.default_rng(2)
    for away, apart in ((IN_PARK, 12.0), (2.5 * IN_PARK, 17.0), (4.5 * IN_PARK, 23.0)):
        line = streets.buffer(away, join_style="mitre").exterior
        for s in np.arange(0.0, line.length, apart):
            x, y = shapely.get_coordinates(line.interpolate(s + rng.uniform(-2.0, 2.0)))[0]
            yield float(x), float(y) + float(rng.uniform(-1.5, 1.5))
