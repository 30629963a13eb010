"""What surrounds a placement: a parent polygon and everything in it, in the parent's frame (section 5.6)."""

import hashlib
from collections import defaultdict
from dataclasses import dataclass
from functools import cached_property
from weakref import WeakKeyDictionary

import numpy as np
import shapely
from numpy.typing import NDArray

from ..geometry.polygon import Polygon
from ..geometry.scene import Scene
from ..relations.elements import Elements
from ..tolerances import PARALLEL_SHARE
from .boxes import areas, gaps_between, shared_areas

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Arrangement:
    """A parent polygon and the polygons below it, as boxes in a frame.

    Everything below the parent counts, not its children alone: drawn objects nest by accident (a window that lies
    within a shutter), and the elements of every label are cut down to the nearest few anyway.

    Attributes
    ----------
    parent : Polygon
    members : tuple of Polygon
        Children of the parent, what straddles its boundary, and their children.
    frame : float
        Direction in radians of the x axis of all boxes.
    """

    parent: Polygon
    members: tuple[Polygon, ...]
    frame: float

    def turned(self, points: Array) -> Array:
        """Points in the frame.

        Parameters
        ----------
        points : ndarray of shape (..., 2)
            Scene coordinates.

        Returns
        -------
        ndarray of shape (..., 2)
        """
        c, s = np.cos(self.frame), np.sin(self.frame)
        return points @ np.array([[c, -s], [s, c]])

    def unturned(self, points: Array) -> Array:
        """Points of the frame in scene coordinates: the inverse of `turned`.

        Parameters
        ----------
        points : ndarray of shape (..., 2)

        Returns
        -------
        ndarray of shape (..., 2)
        """
        c, s = np.cos(self.frame), np.sin(self.frame)
        return points @ np.array([[c, s], [-s, c]])

    def box_of(self, polygon: Polygon) -> Array:
        """(x0, y0, x1, y1) of a polygon in the frame.

        Parameters
        ----------
        polygon : Polygon

        Returns
        -------
        ndarray of shape (4,)
        """
        ring = self.turned(polygon.points)
        return np.hstack([ring.min(axis=0), ring.max(axis=0)])

    @cached_property
    def parent_box(self) -> Array:
        """`box_of` the parent."""
        return self.box_of(self.parent)

    @cached_property
    def drawn(self) -> dict[str, Array]:
        """Boxes (n, 4) of the members in the frame, by label."""
        of = defaultdict(list)
        for polygon, box, _ in self._laid:
            of[polygon.label].append(box)
        return {label: np.array(of[label]) for label in sorted(of)}

    @cached_property
    def boxes(self) -> dict[str, Array]:
        """`drawn`, and the gaps between neighbours as elements under labels of their own."""
        return self.drawn | gaps_between(self.drawn)

    @cached_property
    def outlines(self) -> dict[str, Elements]:
        """Elements with segments and corners by role.

        Those of the parent, and those of members that are no rectangles in the frame. A rectangle's segments and
        corners say nothing that its box coordinates do not.
        """
        of: dict[str, list[Polygon]] = defaultdict(list)
        for polygon, _, whole in self._laid:
            if not whole:
                of[polygon.label].append(polygon)
        groups = {PARENT: Elements.of([self.parent], self.frame)}
        return groups | {f"{OUTLINE}{label}": Elements.of(of[label], self.frame) for label in sorted(of)}

    @cached_property
    def _laid(self) -> list[tuple[Polygon, Array, bool]]:
        """The members with their boxes, and whether these are rectangles, by where they are.

        Of elements that are equally near the first one counts; which one that is must not depend on the order in which
        they were drawn.
        """
        low, size = self.parent_box[:2], (self.parent_box[2:] - self.parent_box[:2]).max()

        def place(points: Array) -> list[float]:
            return np.round((points - low) / size, PLACE_DIGITS).ravel().tolist()  # type: ignore[no-any-return]

        laid = []
        for polygon in self.members:
            box = self.box_of(polygon)
            whole = _fills(polygon, box)
            ring = [] if whole else sorted(place(point) for point in self.turned(polygon.points))
            laid.append((place(box.reshape(2, 2)), ring, polygon, box, whole))
        laid.sort(key=lambda one: one[:2])
        return [one[2:] for one in laid]

    @cached_property
    def parent_fills_box(self) -> bool:
        """Whether the parent is a rectangle in the frame."""
        return _fills(self.parent, self.parent_box)

    def share_outside(self, boxes: Array) -> Array:
        """Share of each box's area that lies outside the parent.

        Parameters
        ----------
        boxes : ndarray of shape (n, 4)

        Returns
        -------
        ndarray of shape (n,)
        """
        size = areas(boxes)
        if self.parent_fills_box:
            inside = shared_areas(boxes, self.parent_box[None])[:, 0]
        else:
            # Most boxes lie inside as a whole, which a prepared outline tells at once.
            drawn = shapely.box(*boxes.T)
            inside = size.copy()
            partly = ~shapely.covers(self._outline, drawn)
            inside[partly] = shapely.area(shapely.intersection(drawn[partly], self._outline))
        return np.clip(1.0 - inside / size, 0.0, 1.0)

    @cached_property
    def _outline(self) -> shapely.Polygon:
        """The parent in the frame, prepared for many questions."""
        holes = [self.turned(np.asarray(h)) for h in self.parent.holes]
        shape = shapely.Polygon(self.turned(self.parent.points), holes)
        shapely.prepare(shape)
        return shape

    @cached_property
    def fingerprint(self) -> str:
        """A digest of the parent, its members and where they are: equal for equal drawings in any order of elements."""
        rows = sorted(
            (p.label, np.roll(p.points, -int(np.lexsort(p.points.T)[0]), axis=0).tobytes()) for p in self.members
        )
        first = np.roll(self.parent.points, -int(np.lexsort(self.parent.points.T)[0]), axis=0)
        digest = hashlib.sha256(repr((self.parent.label, first.tobytes(), rows)).encode())
        return digest.hexdigest()[:32]


def _fills(polygon: Polygon, box: Array) -> bool:
    """Whether a polygon is the rectangle that its box is."""
    return polygon.area >= PARALLEL_SHARE * float((box[2:] - box[:2]).prod())


#: Digits of places, in the parent's size, that are no rounding errors.
PLACE_DIGITS = 9
#: Name of the group of the parent's own segments, corners and boundary.
PARENT = "parent"
#: Prefix of the groups of the outlines of members that are no rectangles.
OUTLINE = "outline of "


_known: WeakKeyDictionary[Scene, dict[tuple[str, float], Arrangement]] = WeakKeyDictionary()


def arrangement_of(scene: Scene, parent: Polygon, frame: float) -> Arrangement:
    """The arrangement below a polygon; kept as long as the scene, which never changes.

    Parameters
    ----------
    scene : Scene
    parent : Polygon
    frame : float
        Direction in radians of the boxes' x axis.

    Returns
    -------
    Arrangement
    """
    kept = _known.setdefault(scene, {})
    key = (str(parent.id), frame)
    if key not in kept:
        kept[key] = Arrangement(parent, tuple(_below(scene, parent)), frame)
    return kept[key]


def _below(scene: Scene, parent: Polygon) -> list[Polygon]:
    found: dict[str, Polygon] = {}
    waiting = [parent]
    while waiting:
        for member in scene.members_of(str(waiting.pop().id)):
            if str(member.id) not in found and member.id != parent.id:
                found[str(member.id)] = member
                waiting.append(member)
    return list(found.values())
