"""The fields of relations on a grid: what is kept of polygons that come and go (section 4.5)."""

import numpy as np
import pytest
import shapely
from shapes import CIRCLE, HOLED_ROOM, L_ROOM, STAR, rectangle

from geoanalogy import Polygon
from geoanalogy.poses import sheets as sheets_module
from geoanalogy.poses.fields import Fields
from geoanalogy.poses.sheets import STALE, Grid, Sheets
from geoanalogy.relations.table import RELATIONS

ROOM = Polygon(rectangle(12, 9, (-6, -4)), "room")


@pytest.mark.parametrize("at_once", [1, 50, 1 << 16])
def test_points_inside_polygons_and_how_deep_they_are(monkeypatch, at_once):
    """Also of polygons that jut out of the grid, lie outside it, have holes or no point inside."""
    monkeypatch.setattr(sheets_module, "MOST_EDGES", at_once)
    sheets = Sheets(Grid(ROOM, 0.25, 1.0))
    hole = HOLED_ROOM[:3] * 0.1 + HOLED_ROOM.mean(axis=0)
    outlines = [
        L_ROOM,
        CIRCLE - 3,
        STAR,
        rectangle(9, 2, (3, -1)),
        rectangle(1, 1, (40, 0)),
        rectangle(0.1, 0.1, (0.05, 0.05)),
    ]
    polygons = [Polygon(o) for o in outlines] + [Polygon(HOLED_ROOM, holes=[hole])]
    for first in (polygons[:2], polygons):  # some are there already
        found = sheets.inside(first)
        assert len(found) == len(first)
    points = sheets.grid.points
    for polygon, (where, depth) in zip(polygons, found, strict=True):
        assert where.tolist() == np.flatnonzero(sheets.covered(polygon)).tolist()
        boundary = shapely.boundary(polygon.shape)
        assert depth == pytest.approx(shapely.distance(boundary, shapely.points(points[where])), abs=1e-6)


def test_relations_are_evaluated_only_to_polygons_that_are_asked_for():
    bed, chair = Polygon(rectangle(2, 1), "bed"), Polygon(rectangle(0.5, 0.5, (3, 3)), "chair")
    relation = RELATIONS["corner distance"]
    grid = Grid(ROOM, 0.5, 1.0)
    some, every = Fields((ROOM, bed, chair), Sheets(grid)), Fields((ROOM, bed, chair), Sheets(grid))
    some.evaluate([relation], polygons=[0, 2])
    every.evaluate([relation])
    where = np.arange(len(grid))
    corners = np.array([*range(4), *range(8, 12)])
    one, other = (f.value(relation, f.index(relation.element, corners, where)) for f in (some, every))
    assert one.tolist() == other.tolist()
    # The rest follows when it is wanted.
    some.evaluate([relation], polygons=[1])
    corners = np.arange(12)
    one, other = (f.value(relation, f.index(relation.element, corners, where)) for f in (some, every))
    assert one.tolist() == other.tolist()


def test_fields_that_are_forgotten_are_evaluated_anew():
    relation = RELATIONS["boundary distance"]
    sheets = Sheets(Grid(ROOM, 0.5, 1.0))
    first = Fields((ROOM,), sheets)
    first.evaluate([relation])
    expected = first.parent_distance.tolist()
    for k in range(2 * STALE):  # each with another member, which is gone then
        Fields((ROOM, Polygon(rectangle(1, 1, (k / 2, 0)))), sheets).evaluate([relation])
    again = Fields((ROOM, Polygon(rectangle(1, 1, (0, 3)))), sheets)
    assert sheets.forgotten == 1
    again.evaluate([relation])
    assert again.parent_distance.tolist() == expected
    first.evaluate([RELATIONS["boundary distance"], RELATIONS["corner distance"]])
    zero = np.zeros(1, dtype=np.intp)
    where = np.arange(len(sheets.grid))
    assert first.value(relation, first.index(relation.element, zero, where))[0].tolist() == expected
