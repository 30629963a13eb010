"""Mapping one polygon to another by equal local coordinates (section 4.7)."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

from ..arguments import count, flag, points_of, shown, word
from ..errors import InputError
from ..geometry.polygon import Polygon
from ..options import Options, each, option, optional
from .correspondence import corner_costs, corresponding_arcs
from .local_coordinates import BoundarySystem, CornerSystem, Located
from .pose import Pose

Array = NDArray[np.float64]


def _place(value: Any, name: str) -> tuple[float, float]:
    """One point."""
    place = points_of(value, name)
    if place.shape != (2,):
        raise InputError(f"{name} is {shown(value)}; give one point")
    return float(place[0]), float(place[1])


@dataclass(frozen=True)
class TransferOptions(Options):
    """How groups are transferred.

    Attributes
    ----------
    system : {"boundary", "corner"}
        The coordinates: R_bd and R_bf, or R_cd and R_cr.
    distance : {"inscribed", "absolute", "depth"}
        The unit of distances. "inscribed": the radius of the largest inscribed circle, so that a pattern fits a bed of
        another size. "absolute": scene units, as printed. "depth" (boundary only): the distance to the medial axis at
        the same arc length, which maps the interiors of convex polygons onto each other and reaches everything.
    corners : bool
        Whether arc length runs from corner to corresponding corner, where there are equally many; else it runs from
        the fixed start as a share of the perimeter, as printed.
    shape : {"rigid", "outline"}
        What is mapped: an object's position and direction, or its whole footprint as well.
    corner : int or None
        The source's corner; None: the one nearest to the middle of the group.
    start : (float, float) or None
        A place on the source's boundary that `starts` refer to.
    starts : mapping of str to (float, float)
        Per target's id, the place on its boundary that corresponds to `start`. For others it is found by the likeness
        of the corners and the polygons' main orientations.
    upright : bool
        Whether the polygons are parts of walls, whose y axis points up: what is below stays below, and objects keep
        their directions.
    """

    subject = "transfers"

    system: Literal["boundary", "corner"] = option("boundary", word, "boundary", "corner")
    distance: Literal["inscribed", "absolute", "depth"] = option("inscribed", word, "inscribed", "absolute", "depth")
    corners: bool = option(True, flag)
    shape: Literal["rigid", "outline"] = option("rigid", word, "rigid", "outline")
    corner: int | None = option(None, optional(count))
    start: tuple[float, float] | None = option(None, optional(_place))
    starts: Mapping[str, tuple[float, float]] = option({}, each("a place per target's id", _place))
    upright: bool = option(False, flag)

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.system == "corner" and self.distance == "depth":
            raise InputError("a corner has no depth; choose inscribed or absolute distances for the corner's system")
        if self.starts and self.start is None:
            raise InputError("starts are given without the source's start; give the place that they correspond to")


@dataclass(frozen=True)
class Mapped:
    """Where a mapping takes points.

    Attributes
    ----------
    points : ndarray of shape (n, 2)
    turn : ndarray of shape (n,)
        What directions at the points turn by, radians.
    reached : ndarray of shape (n,), bool
        Whether the target has a point of these coordinates; where not, the nearest on the way there is returned.
    """

    points: Array
    turn: Array
    reached: NDArray[np.bool_]


class LocalMapping:
    """The mapping of one polygon to another by equal local coordinates.

    Parameters
    ----------
    source, target : Polygon
    options : TransferOptions
    near : array_like of shape (2,), optional
        Where the group is, to find the source's corner.

    Raises
    ------
    InputError
        Where a polygon has no corner and the corner's system is asked for.
    """

    def __init__(
        self, source: Polygon, target: Polygon, options: TransferOptions | None = None, near: ArrayLike | None = None
    ) -> None:
        self.options = options or TransferOptions()
        self.source, self.target = BoundarySystem(source), BoundarySystem(target)
        if self.options.system == "corner":
            self._from, self._to = self._corner_systems(near)
        else:
            self._knots = self._corresponding(target)

    def _corner_systems(self, near: ArrayLike | None) -> tuple[CornerSystem, CornerSystem]:
        places = [s.places(s.corner_arcs) for s in (self.source, self.target)]
        for system, corners in zip((self.source, self.target), places, strict=True):
            if not len(corners):
                raise InputError(
                    f"polygon {system.polygon.id!r} has no corner; choose the boundary's coordinates instead"
                )
        chosen = self.options.corner
        if chosen is None:
            centre = self.source.polygon.centroid if near is None else np.asarray(near, dtype=np.float64)
            chosen = int(np.argmin(np.hypot(*(places[0] - centre).T)))
        origin = CornerSystem(self.source.polygon, chosen)
        if len(places[0]) == len(places[1]):
            arcs = corresponding_arcs(self.source, self.target, corners=True, upright=self.options.upright)
            answer = int(np.searchsorted(self.target.corner_arcs, arcs[1][chosen]))
        else:
            answer = int(np.argmin(corner_costs(self.source, self.target, self.options.upright)[chosen].round(9)))
        return origin, CornerSystem(self.target.polygon, answer)

    def _corresponding(self, target: Polygon) -> tuple[Array, Array]:
        if self.options.start is not None and target.id in self.options.starts:
            begin = self.source.locate([self.options.start]).arc
            end = self.target.locate([self.options.starts[str(target.id)]]).arc
            counts = len(self.source.corner_arcs), len(self.target.corner_arcs)
            if not (self.options.corners and counts[0] == counts[1]):
                return begin, end
            # From the given start on, corner by corner.
            runs = []
            for system, at in ((self.source, begin), (self.target, end)):
                after = np.sort((system.corner_arcs - at) % system.perimeter)
                runs.append(np.concatenate([at, at + after[after > 0]]))
            return (runs[0], runs[1]) if len(runs[0]) == len(runs[1]) else (begin, end)
        return corresponding_arcs(self.source, self.target, self.options.corners, self.options.upright)

    def inverse(self) -> "LocalMapping":
        """The mapping back.

        Returns
        -------
        LocalMapping
            It undoes this one where that reaches; in fans only where both polygons have the vertex.
        """
        back = object.__new__(LocalMapping)
        back.options, back.source, back.target = self.options, self.target, self.source
        if self.options.system == "corner":
            back._from, back._to = self._to, self._from
        else:
            back._knots = self._knots[1], self._knots[0]
        return back

    def map(self, points: ArrayLike) -> Mapped:
        """Take points to the target.

        Parameters
        ----------
        points : array_like of shape (n, 2)
            Scene coordinates, inside or outside of the source.

        Returns
        -------
        Mapped
        """
        given = np.asarray(points, dtype=np.float64).reshape(-1, 2)
        mapped = self._by_corner(given) if self.options.system == "corner" else self._by_boundary(given)
        return replace(mapped, turn=np.zeros(len(given))) if self.options.upright else mapped

    @property
    def _scale(self) -> float:
        if self.options.distance == "absolute":
            return 1.0
        return self.target.inscribed_radius / self.source.inscribed_radius

    def _by_corner(self, points: Array) -> Mapped:
        distance, ratio = self._from.locate(points)
        there = self._to.points(distance * self._scale, ratio)
        held = [shapely.intersects_xy(s.polygon.shape, *p.T) for s, p in ((self.source, points), (self.target, there))]
        return Mapped(there, self._to.directions(ratio) - self._from.directions(ratio), held[0] == held[1])

    def _by_boundary(self, points: Array) -> Mapped:
        at = self.source.locate(points)
        arc = self._carried(at.arc)
        inside = at.distance >= 0
        depth = np.full(len(points), np.inf)
        depth[inside] = self.target.depth(arc[inside], at.share[inside])
        distance = at.distance * self._scale
        if self.options.distance == "depth":
            own = self.source.depth(at.arc[inside], at.share[inside])
            share = np.divide(at.distance[inside], own, out=np.zeros(len(own)), where=own > 0)
            distance[inside] = np.minimum(share, 1.0) * depth[inside]
        wanted = Located(arc, distance, at.share)
        reached = self.target.reached(wanted)
        held = Located(arc, np.minimum(distance, depth), at.share)
        turn = self.target.tangent(arc, at.share) - self.source.tangent(at.arc, at.share)
        return Mapped(self.target.points(held), turn, reached)

    def _carried(self, arc: Array) -> Array:
        """Arc lengths of the target that correspond to the source's, in proportion between the knots."""
        begin, end = self._knots
        own = np.append((begin - begin[0]) % self.source.perimeter, self.source.perimeter)
        other = np.append((end - end[0]) % self.target.perimeter, self.target.perimeter)
        along = (arc - begin[0]) % self.source.perimeter
        # A rounding error before the start is the start.
        along = np.where(self.source.perimeter - along < 1e-12 * self.source.perimeter, 0.0, along)
        return (np.interp(along, own, other) + end[0]) % self.target.perimeter  # type: ignore[no-any-return]

    def pose(self, pose: Pose) -> tuple[Pose, bool]:
        """Take a pose to the target: its position, and its direction relative to the boundary (or to the corner).

        Parameters
        ----------
        pose : Pose

        Returns
        -------
        pose : Pose
        reached : bool
        """
        to = self.map([pose.position])
        x, y = to.points[0]
        return Pose((x, y), pose.angle + float(to.turn[0]), pose.mirrored), bool(to.reached[0])
