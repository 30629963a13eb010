"""Pose validation: no unwanted intersections (section 4.8)."""

from collections.abc import Sequence
from functools import cached_property
from weakref import WeakKeyDictionary

import numpy as np
import shapely
from numpy.typing import NDArray

from ..geometry.polygon import Polygon
from ..relations.runs import run_starts
from ..tolerances import TOUCHING_SHARE
from .arrangement import Arrangement
from .fields import Fields
from .options import PoseOptions
from .pose import Pose, outlines_at

Array = NDArray[np.float64]

#: Share of the footprint that may jut out of the parent beyond what the example's does.
JUTTING_SHARE = 0.03

#: Share of the footprint's width and height that is left at the least where a margin is taken off all around it.
LEAST_CORE = 0.1

#: Share of its box that a footprint fills which is taken for that box.
BOX_SHARE = 0.99


class Validation:
    """What poses of an object may intersect: the labels that the example intersects, and no others.

    Intersecting means sharing more than a sliver of area: furniture touches walls and each other.

    Parameters
    ----------
    source : Arrangement
        The example's.
    pose : Pose
        The example's.
    footprint : ndarray of shape (n, 2) or None
        Ring in the pose's frame; None: a point, which must only lie in the parent.
    options : PoseOptions
    """

    def __init__(self, source: Arrangement, pose: Pose, footprint: Array | None, options: PoseOptions) -> None:
        self._source = source
        self._pose = pose
        self._footprint = footprint
        self._options = options
        #: The last slack and what it blocks: the same in all senses.
        self._blocked: WeakKeyDictionary[Fields, tuple[float, NDArray[np.bool_]]] = WeakKeyDictionary()
        #: The obstacles of arrangements, by the margin taken off them; and what is left of the object, by its margin.
        self._trees: WeakKeyDictionary[Arrangement, dict[float, shapely.STRtree]] = WeakKeyDictionary()
        self._cores: dict[float, tuple[Array, float]] = {}

    @cached_property
    def _at_example(self) -> tuple[float, frozenset[str]]:
        """Share of the example's area inside its parent, and the labels of the members that it intersects."""
        if self._footprint is None:
            return 1.0, frozenset()
        outline = shapely.Polygon(self._pose.to_scene(self._footprint))
        inside = outline.intersection(self._source.parent.shape).area / outline.area
        members = self._source.members
        outlines = np.full(len(members), outline, dtype=object)
        hit = _share_more_than_a_sliver(outlines, np.array([self._obstacle(m) for m in members], dtype=object))
        return inside, frozenset(m.label for m, h in zip(members, hit, strict=True) if h)

    @property
    def may_jut_out(self) -> bool:
        """Whether the object may straddle its parent's boundary: where the example does, or nothing is validated."""
        if self._footprint is None:
            return False
        return not self._options.validate or self._at_example[0] < 1 - JUTTING_SHARE

    def _obstacle(self, member: Polygon) -> shapely.Geometry:
        """A member's outline, or what stands for it: a door with its swing."""
        ring = self._options.alternative_geometry.get(str(member.id))
        shape = member.shape if ring is None else shapely.make_valid(shapely.Polygon(np.asarray(ring, float)))
        width = self._options.clearance.get(member.label, 0.0)
        return shapely.buffer(shape, width, join_style="mitre") if width else shape

    def obstacles(self, target: Arrangement) -> list[tuple[int, Polygon]]:
        """The members that the object may not intersect, with their number among the arrangement's polygons.

        Parameters
        ----------
        target : Arrangement

        Returns
        -------
        list of (int, Polygon)
        """
        if not self._options.validate:
            return []
        allowed = self._at_example[1]
        return [(i, m) for i, m in enumerate(target.members, start=1) if m.label not in allowed]

    def blocked(self, target: Arrangement, fields: Fields, slack: float) -> NDArray[np.bool_]:
        """Grid points where no part of the object may be: outside the parent or inside an obstacle.

        Parameters
        ----------
        target : Arrangement
        fields : Fields
            The arrangement's.
        slack : float
            How far outside or inside, scene units.

        Returns
        -------
        ndarray of shape (points,), bool
        """
        known = self._blocked.get(fields)
        if known is not None and known[0] == slack:
            return known[1]
        if self.may_jut_out:
            blocked = np.zeros(len(fields.grid), dtype=bool)
        else:
            blocked = ~fields.covered(0) & (fields.parent_distance > slack)
        for points, depth in fields.inside([i for i, _ in self.obstacles(target)]):
            blocked[points[depth > slack]] = True
        self._blocked[fields] = slack, blocked
        return blocked

    def accepts(
        self,
        target: Arrangement,
        position: Array,
        angle: Array,
        mirrored: NDArray[np.bool_] | bool,
        scale: Array | float,
    ) -> NDArray[np.bool_]:
        """Which poses intersect nothing that the example does not.

        Parameters
        ----------
        target : Arrangement
        position : ndarray of shape (m, 2)
        angle : ndarray of shape (m,)
        mirrored : bool or ndarray of shape (m,), bool
        scale : float or ndarray of shape (m,)
            Of the footprint.

        Returns
        -------
        ndarray of shape (m,), bool
        """
        if self._footprint is None or not self._options.validate:
            return shapely.intersects_xy(target.parent.shape, *position.T)  # type: ignore[no-any-return]
        outlines = outlines_at(self._footprint, position, angle, mirrored, scale)
        # What lies in the parent whole need not be measured.
        shapely.prepare(target.parent.shape)
        accepted: NDArray[np.bool_] = shapely.covers(target.parent.shape, outlines)
        jutting = np.flatnonzero(~accepted)
        inside = shapely.area(shapely.intersection(outlines[jutting], target.parent.shape))
        accepted[jutting] = inside / shapely.area(outlines[jutting]) >= self._at_example[0] - JUTTING_SHARE
        tree = self._tree(target)
        which, hit = tree.query(outlines, predicate="intersects")
        accepted[which[_share_more_than_a_sliver(outlines[which], tree.geometries[hit])]] = False
        return accepted

    def hopeless(
        self,
        targets: Sequence[Arrangement],
        which: NDArray[np.intp],
        position: Array,
        angle: Array,
        mirrored: NDArray[np.bool_],
        scale: Array,
        slack: float,
    ) -> NDArray[np.bool_]:
        """Which poses would have to move further than `slack` to be accepted.

        Parameters
        ----------
        targets : sequence of Arrangement
        which : ndarray of shape (m,), int
            The number of each pose's arrangement; equal ones are neighbours.
        position : ndarray of shape (m, 2)
        angle : ndarray of shape (m,)
        mirrored : ndarray of shape (m,), bool
        scale : ndarray of shape (m,)
            Of the footprint.
        slack : float
            Scene units, for an object of scale 1: larger ones may move further.

        Returns
        -------
        ndarray of shape (m,), bool
        """
        hopeless = np.zeros(len(angle), dtype=bool)
        if self._footprint is None or not self._options.validate or not len(angle):
            return hopeless
        core, left = self._core(slack)
        # What the object is too thin for is added to the room and taken off the obstacles: it may begin in a wall.
        rest = left * scale
        outlines = outlines_at(core, position, angle, mirrored, scale)
        first = run_starts(which).tolist()
        for start, end in zip(first, [*first[1:], len(which)], strict=True):
            target = targets[which[start]]
            there, off = outlines[start:end], float(rest[start:end].max())
            if not self.may_jut_out:
                room = target.parent.shape.buffer(off, join_style="mitre") if off else target.parent.shape
                shapely.prepare(room)
                hopeless[start:end] = ~shapely.covers(room, there)
            hopeless[start + self._tree(target, off).query(there, predicate="intersects")[0]] = True
        return hopeless

    def _core(self, slack: float) -> tuple[Array, float]:
        """The object without a margin all around: what that still hits is hit so deeply.

        Returns
        -------
        core : ndarray of shape (k, 2)
            Ring in the pose's frame, at scale 1.
        left : float
            How much of the slack the object is too thin for.
        """
        known = self._cores.get(slack)
        if known is not None:
            return known
        assert self._footprint is not None
        low, high = self._footprint.min(axis=0), self._footprint.max(axis=0)
        outline = shapely.Polygon(self._footprint)
        if outline.area >= BOX_SHARE * float(np.prod(high - low)):
            middle, extent = (low + high) / 2, (high - low) / 2
            margin = min(slack, (1 - LEAST_CORE) * float(extent.min()))
            core = middle + np.maximum(1 - slack / extent, LEAST_CORE) * (self._footprint - middle)
        else:
            # One that is no box may have a notch, in which others can stand.
            margin = slack
            while (eroded := outline.buffer(-margin, join_style="mitre")).is_empty:
                margin /= 2
            core = shapely.get_coordinates(max(shapely.get_parts(eroded), key=shapely.area).exterior)[:-1]
        known = self._cores[slack] = core, slack - margin
        return known

    def _tree(self, target: Arrangement, off: float = 0.0) -> shapely.STRtree:
        """The obstacles of an arrangement, without a margin all around."""
        trees = self._trees.setdefault(target, {})
        tree = trees.get(off)
        if tree is None:
            shapes = np.array([self._obstacle(m) for _, m in self.obstacles(target)], dtype=object)
            tree = trees[off] = shapely.STRtree(shapely.buffer(shapes, -off, join_style="mitre") if off else shapes)
        return tree


def _share_more_than_a_sliver(outlines: NDArray[np.object_], obstacles: NDArray[np.object_]) -> NDArray[np.bool_]:
    """Whether outlines share more than a sliver with obstacles, pair by pair."""
    shared = shapely.area(shapely.intersection(outlines, obstacles))
    smaller = np.minimum(shapely.area(outlines), shapely.area(obstacles))
    return shared > TOUCHING_SHARE * smaller  # type: ignore[no-any-return]
