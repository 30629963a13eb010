"""The region transfer as an operation: its query, its lines, and where it finds them again."""

import json

import numpy as np
import pytest

from geoanalogy import InputError, OperationsTree, Polygon, RegionOptions, Scene
from geoanalogy.operations.node import Node
from geoanalogy.operations.region_transfer import RegionTransfer
from geoanalogy.progress import run

TURN = np.linspace(0.0, 2.0 * np.pi, 60)
RING = np.stack([0.2 + 1.9 * np.cos(TURN), 1.6 * np.sin(TURN)], 1)


def leaf(at=(0.0, 0.0), scale=1.0, angle=0.0, mirrored=False):
    """A lopsided leaf with a vein and a stem."""
    rim = np.stack([1.2 * np.cos(TURN) + 0.3 * np.cos(2 * TURN), 0.7 * np.sin(TURN) + 0.25 * np.cos(TURN) ** 2], 1)
    vein = np.stack([np.linspace(-0.8, 1.4, 12), 0.2 * np.linspace(-0.8, 1.4, 12) ** 2], 1)
    twig = np.array([(0.2, 0.0), (0.5, 0.3), (0.6, 0.5)])
    turn = np.array([(np.cos(angle), -np.sin(angle)), (np.sin(angle), np.cos(angle))])
    flip = np.array([1.0, -1.0 if mirrored else 1.0])
    return [scale * (line * flip) @ turn.T + at for line in (rim, vein, twig)]


def moved(points, at=(0.0, 0.0), scale=1.0, angle=0.0):
    turn = np.array([(np.cos(angle), -np.sin(angle)), (np.sin(angle), np.cos(angle))])
    return scale * np.asarray(points) @ turn.T + at


PLACES = [((6.0, 1.0), 1.3, 0.8), ((1.0, 6.0), 0.8, 2.5)]
DRAWING = [line for place in [((0.0, 0.0), 1.0, 0.0), *PLACES] for line in leaf(*place)]


def test_it_finds_the_copies_and_maps_to_them():
    found = run(RegionTransfer.of(DRAWING, RING).find_steps(DRAWING))
    assert found.here
    shown = [t for t in found.targets if t.similarity >= found.threshold]
    assert len(shown) == 2
    inner = RING * 0.5
    for place in PLACES:
        true = moved(inner, *place)
        gaps = [np.abs(t.map(inner) - true).max() for t in shown]
        assert min(gaps) < 0.05
        assert shown[int(np.argmin(gaps))].confidence(inner).min() > 0.5


def test_in_another_drawing_its_own_lines_are_looked_for():
    operation = RegionTransfer.of(DRAWING, RING)
    place = ((40.0, -3.0), 1.5, -0.7)
    other = leaf(*place)
    assert operation.is_in(DRAWING) and not operation.is_in(other)
    found = run(operation.find_steps(other))
    assert not found.here
    inner = RING * 0.5
    # How exact a mapping is, the tests of matching say; here, that it starts from where the query was drawn.
    assert np.abs(found.targets[0].map(inner) - moved(inner, *place)).max() < 0.1 * np.ptp(other[0], axis=0).max()


def test_other_lines_in_the_same_place_are_not_its_own():
    operation = RegionTransfer.of(DRAWING, RING)
    assert not operation.is_in([*DRAWING, RING[:20] * 0.5])
    assert not operation.is_in([line * (1.0, 1.1) for line in DRAWING])
    assert operation.is_in([line.astype(np.float32) for line in DRAWING])


def test_lines_that_leave_the_query_are_cut_there():
    through = np.array([(-10.0, 0.0), (10.0, 0.0)])
    operation = RegionTransfer.of([*leaf(), through], RING)
    cut = np.array(operation.lines[-1])
    assert len(operation.lines) == 4
    assert np.allclose(sorted(cut[:, 0]), (-1.7, 2.1), atol=0.05)


def test_a_stroke_takes_what_is_within_its_reach():
    stroke = [(-0.8, 0.13), (0.3, 0.02), (1.4, 0.4)]
    operation = RegionTransfer.of(DRAWING, stroke, RegionOptions(query_kind="stroke", reach=0.05))
    assert operation.region.area == pytest.approx(2 * 0.05 * 2.27 * 2.27, rel=0.1)
    assert len(operation.lines) >= 1


def test_it_is_stored_and_passes_on_what_polygons_come_in():
    options = RegionOptions(threshold=0.2, mirrored=False, query_points=40)
    operation = RegionTransfer.of(DRAWING, RING, options)
    again = RegionTransfer.from_dict(json.loads(json.dumps(operation.to_dict())))
    assert again == operation
    rooms = Scene([Polygon([(0, 0), (4, 0), (4, 3), (0, 3)], label="room")])
    assert OperationsTree([Node("fish", again)]).apply(rooms) == []


@pytest.mark.parametrize(
    ("query", "message"),
    [
        (RING + 100.0, "No line of the drawing lies in the query"),
        (RING * np.nan, "The query is no line of finite points"),
        (RING[:1], "The query is no line of finite points"),
        ([[1.0, 2.0, 3.0], [1.0, 2.0, 4.0]], "The query is no line of finite points"),
    ],
)
def test_a_query_that_cannot_be_used_is_refused(query, message):
    with pytest.raises(InputError, match=message):
        RegionTransfer.of(DRAWING, query)


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("query", [[0.0, 0.0]], "setting 'query': a line has fewer than two points"),
        ("query", [[0.0, "x"], [1.0, 2.0]], "setting 'query': 'x' is no finite number"),
        ("lines", 3, "has a damaged setting 'lines'; record it again"),
        ("options", {"colour": 1}, "colour is no option of regions; it may come from a newer version"),
        ("options", {"threshold": 7.0}, "the option threshold is 7.0; give a number from 0 to 1"),
    ],
)
def test_a_damaged_setting_is_named(name, value, message):
    plain = RegionTransfer.of(DRAWING, RING).to_dict()
    with pytest.raises(InputError, match=message):
        RegionTransfer.from_dict({**plain, name: value})
