"""THE table of relationship functions (sections 4.3, 4.7, 4.9 and 5.3).

A row names a relation, the type of element it is taken to, the kind of its value, and the function that evaluates it
for all elements at all points. To add a relation write its function and its row; both engines find it here.

Angles are signed, in the sense of section 4.3 with ``arctan2`` in place of the printed ``arccos``: rings run
counter-clockwise, so a pose to the left of a direction and one to its right differ, and the mirrored solution is the
business of section 4.6.
"""

import enum
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .elements import Elements, ElementType
from .observation import Directions, Observation

Array = NDArray[np.float64]


class Kind(enum.Enum):
    """What the value of a relation is: it decides how values are compared."""

    LENGTH = "length"  #: scene units
    RATIO = "ratio"  #: share of the element's own extent, 0 to 1
    ANGLE = "angle"  #: radians, compared modulo a full turn


@dataclass(frozen=True, eq=False)
class Directional:
    """A directional relation: the angle from a reference direction to the pose's (figure 4.5, bottom row).

    Attributes
    ----------
    name : str
    element : ElementType
    reference : callable
        (Observation) -> ndarray (elements, points): the reference direction in radians.
    """

    name: str
    element: ElementType
    reference: Callable[[Observation], Array]


@dataclass(frozen=True, eq=False)
class Positional:
    """A positional relation: it depends on the pose's position only (section 4.3, top row of figure 4.5).

    Attributes
    ----------
    name : str
    element : ElementType
    kind : Kind
    value : callable
        (Observation) -> ndarray (elements, points).
    slope : callable
        (Observation) -> ndarray (elements, points): the length of the value's gradient, per scene unit. It turns a
        difference in value into a distance in the plane, which is what a level set's width is (section 4.5 rasterises
        lines of fixed width).
    uphill : callable
        (Observation) -> complex ndarray (elements, points): the direction in which the value grows, of length 1.
    directional : Directional or None
        The directional relation it is intersected with (section 4.5); None: placements without direction only (chapter
        5).
    period : callable or None
        (Elements) -> ndarray (elements,): values that differ by it are equal (inf: none); None: values never wrap.
    """

    name: str
    element: ElementType
    kind: Kind
    value: Callable[[Observation], Array]
    slope: Callable[[Observation], Array]
    uphill: Callable[[Observation], Directions]
    directional: Directional | None = None
    period: Callable[[Elements], Array] | None = None


def _unit(like: Callable[[Observation], Array]) -> Callable[[Observation], Array]:
    return lambda seen: np.ones_like(like(seen))


def _boundary_distance(seen: Observation) -> Array:
    return seen.boundary.distance


def _segment_distance(seen: Observation) -> Array:
    return seen.segment.distance


def _corner_distance(seen: Observation) -> Array:
    return seen.corner[0]


def _segment_arc_length(seen: Observation) -> Array:
    return seen.segment.arc / seen.elements.segment_length[:, None]


def _segment_arc_slope(seen: Observation) -> Array:
    return seen.segment.between / seen.elements.segment_length[:, None]


def _corner_ratio(seen: Observation) -> Array:
    # Between the corner's edges 0 to 1, as printed. Beyond them it goes on from 1 to 2 over the exterior angle, so
    # that poses outside an object have a ratio as well and its level sets close at 0 = 2.
    inside, angle = seen.corner_side
    opening = seen.elements.corner_opening[:, None]
    ratio = np.where(inside, seen.corner_turn, seen.corner_turn - opening)
    ratio /= angle
    ratio += ~inside
    return ratio


def _corner_ratio_slope(seen: Observation) -> Array:
    with np.errstate(divide="ignore"):
        return 1.0 / (seen.corner[0] * seen.corner_side[1])


def _segment_period(elements: Elements) -> Array:
    return np.where(elements.segment_closed, 1.0, np.inf)


def _constant_period(element: ElementType, period: float) -> Callable[[Elements], Array]:
    return lambda elements: np.full(elements.count(element), period)


def _centroid_direction(seen: Observation) -> Array:
    return (seen.centroid[1] - seen.elements.polygon_orientation[:, None]) % (2 * np.pi)


def _centroid_direction_slope(seen: Observation) -> Array:
    with np.errstate(divide="ignore"):
        return 1.0 / seen.centroid[0]


def _fixed_start_arc_length(seen: Observation) -> Array:
    return seen.boundary.arc / seen.elements.edge_ring_length[seen.boundary.edge]


def _fixed_start_arc_slope(seen: Observation) -> Array:
    return seen.boundary.between / seen.elements.edge_ring_length[seen.boundary.edge]


def _box_coordinate(axis: int, origin: Callable[[Array, Array], Array]) -> Callable[[Observation], Array]:
    def value(seen: Observation) -> Array:
        points, low, high = seen.box
        return points[axis] - origin(low[:, axis], high[:, axis])[:, None]

    return value


def _box_axis(axis: int) -> Callable[[Observation], Directions]:
    def uphill(seen: Observation) -> Directions:
        direction = np.exp(1j * (seen.elements.frame + axis * np.pi / 2))
        return np.full((len(seen.elements.polygons), len(seen.points)), direction)

    return uphill


def _normalised_box_coordinate(axis: int) -> Callable[[Observation], Array]:
    def value(seen: Observation) -> Array:
        points, low, high = seen.box
        return (points[axis] - low[:, axis, None]) / (high - low)[:, axis, None]

    return value


def _normalised_box_slope(axis: int) -> Callable[[Observation], Array]:
    def slope(seen: Observation) -> Array:
        _, low, high = seen.box
        return np.broadcast_to(1.0 / (high - low)[:, axis, None], (len(low), len(seen.points)))

    return slope


BOUNDARY_ANGLE = Directional("boundary angle", ElementType.POLYGON, lambda seen: seen.boundary.tangent)
SEGMENT_ANGLE = Directional("segment angle", ElementType.SEGMENT, lambda seen: seen.segment.tangent)
CORNER_ANGLE = Directional("corner angle", ElementType.CORNER, lambda seen: seen.corner[1])
CENTROID_ANGLE = Directional("centroid angle", ElementType.POLYGON, lambda seen: seen.centroid[1])

#: Section 4.3: the relations of single-example propagation, each with its directional partner.
POSE_RELATIONS: tuple[Positional, ...] = (
    Positional(
        "boundary distance",
        ElementType.POLYGON,
        Kind.LENGTH,
        _boundary_distance,
        _unit(_boundary_distance),
        lambda seen: seen.away(seen.boundary),
        BOUNDARY_ANGLE,
    ),
    Positional(
        "segment distance",
        ElementType.SEGMENT,
        Kind.LENGTH,
        _segment_distance,
        _unit(_segment_distance),
        lambda seen: seen.away(seen.segment),
        SEGMENT_ANGLE,
    ),
    Positional(
        "segment arc length",
        ElementType.SEGMENT,
        Kind.RATIO,
        _segment_arc_length,
        _segment_arc_slope,
        lambda seen: seen.along(seen.segment),
        SEGMENT_ANGLE,
        _segment_period,
    ),
    Positional(
        "corner distance",
        ElementType.CORNER,
        Kind.LENGTH,
        _corner_distance,
        _unit(_corner_distance),
        lambda seen: seen.from_corner,
        CORNER_ANGLE,
    ),
    Positional(
        "corner ratio",
        ElementType.CORNER,
        Kind.RATIO,
        _corner_ratio,
        _corner_ratio_slope,
        lambda seen: -1j * seen.from_corner,
        CORNER_ANGLE,
        _constant_period(ElementType.CORNER, 2.0),
    ),
)

#: Section 4.9: the direction to an object's centroid, against the object's principal direction.
CENTROID_DIRECTION = Positional(
    "centroid direction",
    ElementType.POLYGON,
    Kind.ANGLE,
    _centroid_direction,
    _centroid_direction_slope,
    lambda seen: -1j * np.exp(1j * seen.centroid[1]),
    CENTROID_ANGLE,
    _constant_period(ElementType.POLYGON, 2 * np.pi),
)

#: Section 4.7: arc length from a fixed start, the second axis of a local coordinate system.
FIXED_START_ARC_LENGTH = Positional(
    "fixed-start arc length",
    ElementType.POLYGON,
    Kind.RATIO,
    _fixed_start_arc_length,
    _fixed_start_arc_slope,
    lambda seen: seen.along(seen.boundary),
    BOUNDARY_ANGLE,
    _constant_period(ElementType.POLYGON, 1.0),
)

#: Section 5.3: coordinates in the polygon's bounding box, from its least corner, its centre and its greatest corner,
#: and normalised.
BOX_RELATIONS: tuple[Positional, ...] = tuple(
    Positional(f"box {origin} {'xy'[axis]}", ElementType.POLYGON, Kind.LENGTH, value, _unit(value), _box_axis(axis))
    for origin, at in (("minimum", lambda a, b: a), ("centre", lambda a, b: (a + b) / 2), ("maximum", lambda a, b: b))
    for axis in (0, 1)
    for value in [_box_coordinate(axis, at)]
) + tuple(
    Positional(
        f"box share {'xy'[axis]}",
        ElementType.POLYGON,
        Kind.RATIO,
        _normalised_box_coordinate(axis),
        _normalised_box_slope(axis),
        _box_axis(axis),
    )
    for axis in (0, 1)
)

#: Every relation by its name.
RELATIONS: dict[str, Positional] = {
    r.name: r for r in (*POSE_RELATIONS, CENTROID_DIRECTION, FIXED_START_ARC_LENGTH, *BOX_RELATIONS)
}
