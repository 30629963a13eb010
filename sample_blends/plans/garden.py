"""A palace garden (figure 4.11): parcels that guide the placement, labelled way, garden and palace.

The middle is symmetric about the axis x = 0; the outer parcels have shapes of their own. The palace stands at the upper
edge; +y is north.
"""

from __future__ import annotations

import numpy as np

from .outlines import PlanPolygon, arc, circle, ellipse, mirrored, rectangle, rounded, smoothed

# The round place in the middle, and half the breadths of the axis and of the way that crosses it there.
CENTRE = (0.0, 30.0)
PLACE = 11.0
AXIS = 3.5
CROSS = 3.0
# The side ways run between these distances from the axis.
SIDE = (25.0, 31.0)
TERRACE = 50.0
SOUTH, NORTH = -6.0, 80.0
EDGE = 52.0
ROUND_EAST, ROUND_WEST = (41.0, 30.0), (-41.0, 30.0)
ROUND_WAY = 10.0

# The walls of the palace, and how far its portico and the stairs before it reach into the court.
WALLS = np.array([(-27, 58), (-18, 58), (-18, 66), (18, 66), (18, 58), (27, 58), (27, 78), (-27, 78)], dtype=float)
_STAIRS = np.array([(-5.6, 66.0), (-5.6, 61.2), (5.6, 61.2), (5.6, 66.0)])
PALACE = np.vstack((WALLS[:3], _STAIRS, WALLS[3:]))


def _quarter(low: float, high: float) -> np.ndarray:
    """Parcel right of the axis, above (``low`` < ``high``) or below the cross way, hollowed by the round place."""
    sign = 1.0 if high > low else -1.0
    first = np.degrees(np.arcsin(CROSS / PLACE))
    last = np.degrees(np.arccos(AXIS / PLACE))
    hollow = arc(CENTRE, PLACE, sign * last, sign * first, 11)
    ring = np.vstack(((SIDE[0], low), (SIDE[0], high), (AXIS, high), hollow))
    return ring if sign > 0 else ring[::-1]


def _way_from_place(to: float) -> np.ndarray:
    """Piece of the axis from the round place to the height ``to``."""
    sign = 1.0 if to > CENTRE[1] else -1.0
    last = np.degrees(np.arccos(AXIS / PLACE))
    end = arc(CENTRE, PLACE, sign * (180 - last), sign * last, 9)
    ring = np.vstack(((AXIS, to), (-AXIS, to), end))
    return ring if sign > 0 else ring[::-1]


def _cross_way() -> np.ndarray:
    """Piece of the cross way to the right of the round place."""
    first = np.degrees(np.arcsin(CROSS / PLACE))
    end = arc(CENTRE, PLACE, first, -first, 7)
    return np.vstack(((SIDE[0], CENTRE[1] - CROSS), (SIDE[0], CENTRE[1] + CROSS), end))


def parcels() -> list[PlanPolygon]:
    """The parcels, which together cover the domain but for narrow gravel strips."""
    north = _quarter(CENTRE[1] + CROSS, TERRACE)
    south = _quarter(CENTRE[1] - CROSS, 6.0)
    strip = rounded(rectangle(5.5, -3.0, 23.0, 3.0), 1.2, 4)
    court = np.array([(7.0, 53.5), (15.8, 53.5), (15.8, 60.3), (13.0, 63.5), (7.0, 63.5)])
    side = rectangle(SIDE[0], SOUTH, SIDE[1], TERRACE)
    gardens = {
        "garden north-east": north,
        "garden north-west": mirrored(north),
        "garden south-east": south,
        "garden south-west": mirrored(south),
        "garden strip east": strip,
        "garden strip west": mirrored(strip),
        "garden court east": court,
        "garden court west": mirrored(court),
        "garden round east": circle(7.0, ROUND_EAST, 56),
        "garden round west": ellipse(15.0, 11.5, 56) + ROUND_WEST,
        "garden outer north-east": np.array([(32.5, 42.5), (50, 42.5), (50, 57), (37.5, 57), (32.5, 52.0)]),
        "garden outer north-west": np.vstack(
            ((-32.5, 42.5), (-32.5, 57.0), (-45.0, 57.0), arc((-45.0, 52.0), 5.0, 100, 180, 9), (-50.0, 42.5))
        ),
        "garden outer south-east": np.array([(32.5, 5), (41, -3), (50, -3), (50, 17.5), (32.5, 17.5)]),
        "garden outer south-west": smoothed(
            np.array([(-33, 17), (-40, 18.5), (-50, 17), (-51, 5), (-46, -4), (-37, -3), (-35, 4), (-31.5, 9)]), 3
        ),
        "garden palace east": rectangle(32.5, 61.0, 50.0, 78.0),
        "garden palace west": np.array([(-50, 61), (-32.5, 61), (-32.5, 69), (-40, 78), (-50, 78)], dtype=float),
    }
    ways = {
        "way round place": circle(PLACE, CENTRE, 72),
        "way axis south": _way_from_place(SOUTH),
        "way axis north": _way_from_place(TERRACE),
        "way cross east": _cross_way(),
        "way cross west": mirrored(_cross_way()),
        "way side east": side,
        "way side west": mirrored(side),
        "way round east": circle(ROUND_WAY, ROUND_EAST, 72),
        "way round west": circle(ROUND_WAY, ROUND_WEST, 72),
        "way terrace": np.vstack(
            ((-31, 50), (31, 50), (31, 58), (18, 58), (18, 66), _STAIRS[::-1], (-18, 66), (-18, 58), (-31, 58))
        ),
    }
    made = [PlanPolygon("palace", "palace", PALACE)]
    made += [PlanPolygon("way", name, ring) for name, ring in ways.items()]
    inside = {"court": "way terrace", "round east": "way round east", "round west": "way round west"}
    for name, ring in gardens.items():
        parent = next((way for key, way in inside.items() if key in name), None)
        made.append(PlanPolygon("garden", name, ring, parent))
    return [PlanPolygon(p.label, p.id, _counter_clockwise(p.ring), p.parent) for p in made]


def _counter_clockwise(ring: np.ndarray) -> np.ndarray:
    x, y = ring[:, 0], ring[:, 1]
    return ring if np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y) > 0 else ring[::-1]


def plan() -> list[PlanPolygon]:
    """All labelled polygons."""
    return parcels()


def domain() -> np.ndarray:
    """Rectangle of the whole garden."""
    return rectangle(-EDGE, SOUTH, EDGE, NORTH)
