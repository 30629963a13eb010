"""Fronts of openings: what has to stay free before doors and windows so that they can be used (section 4.8).

Plans draw doors and windows as thin strips along the walls. Their labels are anybody's, so they are told by their
shape. Unlike what stands in a room, a front may be stood in at a price: some rooms are too small for a rule.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from ..geometry.polygon import Polygon

Array = NDArray[np.float64]

#: Greatest depth of an opening, in sizes of its parent and in its own widths: a leaf or a sill, not a thing that stands
#: there.
THIN = 0.1
FLAT = 0.5

#: Share of a front beyond what the example covers at which a place is in the way; and the factor on its importance
#: there: it is taken after others, but it is a place.
COVERED = 0.25
IN_THE_WAY = 0.5


@dataclass(frozen=True)
class Fronts:
    """What has to stay free before the openings of a parent: squares of their width, as far as they are in the parent.

    Attributes
    ----------
    labels : tuple of str
        Those of the openings.
    shapes : ndarray of shape (k,), object
    areas : ndarray of shape (k,)
    """

    labels: tuple[str, ...]
    shapes: NDArray[np.object_]
    areas: Array

    @property
    def nbytes(self) -> int:
        """Memory held, in bytes, about."""
        return 500 * len(self.labels)

    @classmethod
    def of(cls, parent: Polygon, members: Sequence[Polygon]) -> "Fronts":
        """The fronts of those members that are openings.

        Parameters
        ----------
        parent : Polygon
        members : sequence of Polygon

        Returns
        -------
        Fronts
        """
        found = [(m.label, ring) for m in members if (ring := _front(parent, m)) is not None]
        rings = shapely.polygons([ring for _, ring in found]) if found else np.zeros(0, dtype=object)
        shapes = shapely.intersection(rings, parent.shape)
        return cls(tuple(label for label, _ in found), shapes, shapely.area(shapes))

    def __len__(self) -> int:
        return len(self.labels)

    def covered_by(self, outline: shapely.Polygon) -> dict[str, float]:
        """How much of fronts an object covers.

        Parameters
        ----------
        outline : shapely.Polygon

        Returns
        -------
        dict of str to float
            By the label of openings, the largest share of one front.
        """
        covered: dict[str, float] = {}
        for label, share in zip(self.labels, self._shares(np.array([outline]))[0].tolist(), strict=True):
            covered[label] = max(share, covered.get(label, 0.0))
        return covered

    def passable(self, outlines: NDArray[np.object_], usual: Mapping[str, float]) -> Array:
        """The factor on the importance of places for what they leave of fronts.

        Parameters
        ----------
        outlines : ndarray of shape (m,), object
            The object at each place.
        usual : mapping of str to float
            Shares of fronts that it may cover as the example does, by the label of openings.

        Returns
        -------
        ndarray of shape (m,)
            1 where no front is covered more than that.
        """
        more = self._shares(outlines) - [usual.get(label, 0.0) for label in self.labels]
        return 1 - (1 - IN_THE_WAY) * np.clip(more.max(axis=1, initial=0.0) / COVERED, 0.0, 1.0)

    def _shares(self, outlines: NDArray[np.object_]) -> Array:
        """The share that objects cover of every front; shape (m, k)."""
        return shapely.area(shapely.intersection(outlines[:, None], self.shapes)) / self.areas  # type: ignore[no-any-return]


def may_be_opening(parent: Polygon, member: Polygon) -> bool:
    """Whether a member is not deep in every direction: most are, and are told at once.

    Parameters
    ----------
    parent, member : Polygon

    Returns
    -------
    bool
    """
    left, low, right, high = member.bounds.tolist()
    return member.area <= THIN * parent.size * math.hypot(right - left, high - low)


def _front(parent: Polygon, member: Polygon) -> Array | None:
    """The square before an opening and the opening itself as a ring, shape (4, 2); None for what is no opening."""
    if not may_be_opening(parent, member):
        return None
    edges = np.roll(member.points, -1, axis=0) - member.points
    length = np.hypot(*edges.T)
    x = edges[length.argmax()] / length.max()
    frame = np.array([x, (-x[1], x[0])])
    (left, low), (right, high) = (f((member.points @ frame.T), axis=0) for f in (np.min, np.max))
    width, depth = right - left, high - low
    if depth > min(THIN * parent.size, FLAT * width):
        return None
    # There is room just before an opening, and none just behind it.
    beyond = np.array([((left + right) / 2, y) for y in (low - depth / 2, high + depth / 2)])
    below, above = shapely.intersects_xy(parent.shape, *(beyond @ frame).T)
    if below == above:
        return None
    low, high = (low, high + width) if above else (low - width, high)
    return np.array([(left, low), (right, low), (right, high), (left, high)]) @ frame  # type: ignore[no-any-return]
