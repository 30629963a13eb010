"""Labelled polygons: the shapes of an arrangement (section 4.2)."""

from collections.abc import Sequence
from functools import cached_property
from typing import Any

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

from ..arguments import listed, real, shown
from ..errors import InputError
from ..tolerances import LARGEST_COORDINATE, ZERO_LENGTH
from .persistence import ClearRing, clear_ring


def signed_area(ring: NDArray[np.float64]) -> float:
    """Area of a ring, positive where it runs counter-clockwise.

    Parameters
    ----------
    ring : ndarray of shape (n, 2)
        Vertices without a repeated last one, scene units.

    Returns
    -------
    float
        Signed area in squared scene units.

    Examples
    --------
    >>> signed_area(np.array([(0, 0), (2, 0), (2, 1), (0, 1)], float))
    2.0
    """
    # Near the origin there is no cancellation at large coordinates, and the edges at the first vertex add nothing.
    x, y = (ring - ring[0]).T
    return float(0.5 * (np.dot(x[:-1], y[1:]) - np.dot(y[:-1], x[1:])))


def clean_ring(points: ArrayLike, name: str) -> tuple[NDArray[np.float64], NDArray[np.intp]]:
    """A ring in canonical form: distinct neighbours, counter-clockwise, last vertex not repeated.

    The first vertex stays the first even where the ring is turned round: the fixed-start arc length of section 4.7
    begins there.

    Parameters
    ----------
    points : array_like of shape (n, 2)
        Vertices in either direction, scene units; the first may be repeated at the end.
    name : str
        What the ring is called in messages.

    Returns
    -------
    ring : ndarray of shape (m, 2), float64
        Counter-clockwise vertices.
    edges : ndarray of shape (m,), int
        The edge of `points` that each edge of `ring` was; edge i runs from vertex i to vertex i + 1.

    Raises
    ------
    InputError
        For anything that is no simple ring with an area.
    """
    try:
        ring = np.asarray(points, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        raise InputError(f"{name} has coordinates that are not numbers; give an array of x, y pairs") from None
    if ring.ndim != 2 or ring.shape[1] != 2:
        raise InputError(f"{name} has an array of shape {ring.shape}; give vertices as an array of shape (n, 2)")
    if not np.isfinite(ring).all():
        raise InputError(f"{name} has a coordinate that is not finite (NaN or infinity); correct or delete that vertex")
    if np.abs(ring).max(initial=0.0) > LARGEST_COORDINATE:
        raise InputError(
            f"{name} lies more than {LARGEST_COORDINATE:g} units from the origin; move the scene near the origin"
        )
    extent = float(np.ptp(ring, axis=0).max()) if len(ring) else 0.0
    kept, edges = _distinct(ring, ZERO_LENGTH * extent)
    if len(kept) < 3:
        raise InputError(
            f"{name} has {len(kept)} distinct {'vertex' if len(kept) == 1 else 'vertices'}; "
            "a polygon needs at least three"
        )
    ring = ring[kept]
    area = signed_area(ring)
    outline = None if _is_convex_quadrangle(ring) else shapely.Polygon(ring - ring[0])
    # The loops of a ring that crosses itself may cancel: only one that lies on a line encloses nothing.
    nothing = ZERO_LENGTH * extent * extent
    if abs(area) <= nothing and (outline is None or shapely.make_valid(outline).area <= nothing):
        raise InputError(f"{name} has no area; give a ring that encloses one")
    if outline is not None and not outline.is_valid:
        where = shapely.is_valid_reason(outline).partition("[")
        x, y = (float(v) for v in where[2].rstrip("]").split()) if where[2] else (0.0, 0.0)
        place = f"x {x + ring[0, 0]:.6g}, y {y + ring[0, 1]:.6g}"
        raise InputError(f"{name} crosses or touches itself near {place}; redraw it as a simple ring")
    if area > 0:
        return ring, edges
    return np.roll(ring[::-1], 1, axis=0), edges[::-1].copy()


def _is_convex_quadrangle(ring: NDArray[np.float64]) -> bool:
    """Whether a ring has four vertices that all turn the same way: it cannot cross itself then."""
    if len(ring) != 4:
        return False
    (ax, ay), (bx, by), (cx, cy), (dx, dy) = ring.tolist()
    turns = (
        (bx - ax) * (cy - by) - (by - ay) * (cx - bx),
        (cx - bx) * (dy - cy) - (cy - by) * (dx - cx),
        (dx - cx) * (ay - dy) - (dy - cy) * (ax - dx),
        (ax - dx) * (by - ay) - (ay - dy) * (bx - ax),
    )
    return min(turns) > 0.0 or max(turns) < 0.0


def _distinct(ring: NDArray[np.float64], shortest: float) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Indices of the vertices that stay when coincident neighbours are merged, and of the edges that leave them."""
    kept = edges = np.arange(len(ring))
    while len(kept) > 1:
        here = ring[kept]
        gaps = np.abs(np.concatenate([here[1:], here[:1]]) - here).max(axis=1)
        long = np.flatnonzero(gaps > shortest)
        if len(long) == len(kept):
            break
        # A vertex gives way to the one before it; only the last gives way to the first.
        stays = np.roll(gaps > shortest, 1)
        if not stays[0]:
            stays[0], stays[-1] = True, False
        staying = np.flatnonzero(stays)
        if len(long):
            edges = edges[long[np.searchsorted(long, staying) % len(long)]]
        kept = kept[staying]
    return kept, edges[: len(kept)]


def main_directions(outlines: NDArray[np.float64]) -> NDArray[np.float64]:
    """The directions in which most of the length of outlines runs, modulo 90 degrees (section 5.6).

    Parameters
    ----------
    outlines : ndarray of shape (n, vertices, 2)
        Without the noise of their boundaries.

    Returns
    -------
    ndarray of shape (n,)
        Radians, at most an eighth of a turn from the x axis; 0 without any preferred direction (a circle).
    """
    edges = np.concatenate([outlines[:, 1:], outlines[:, :1]], axis=1) - outlines
    lengths = np.hypot(edges[..., 0], edges[..., 1])
    angles = np.arctan2(edges[..., 1], edges[..., 0]) % (np.pi / 2)
    # Twice two turns make a quarter turn one full turn, where lengths add up as vectors; the mean is then sharpened on
    # the edges that agree with it, so that a bevelled corner does not tilt a rectangular room.
    total = (lengths * np.exp(4j * angles)).sum(axis=1)
    mean = np.angle(total) / 4
    for width in (np.pi / 8, np.pi / 24):
        off = (angles - mean[:, None] + np.pi / 4) % (np.pi / 2) - np.pi / 4
        near = np.where(np.abs(off) <= width, lengths, 0.0)
        along = near.sum(axis=1)
        mean = mean + (off * near).sum(axis=1) / np.where(along > 0, along, 1.0)
    aimless = np.abs(total) < 0.05 * lengths.sum(axis=1)
    return np.where(aimless, 0.0, (mean + np.pi / 4) % (np.pi / 2) - np.pi / 4)


class Polygon:
    """A labelled polygon of a scene.

    Parameters
    ----------
    points : array_like of shape (n, 2)
        Outline in scene units, in either direction, with or without a repeated last vertex.
    label : str
        What kind of thing it is ("bedroom", "bed"); only polygons of equal label are matched (section 4.8).
    id : str, optional
        Name in its scene; a scene names the polygons that have none.
    holes : sequence of array_like of shape (m, 2)
        Rings inside the outline that do not belong to it.
    parent : str, optional
        Id of the parent; None: found by containment.
    orientation : float, optional
        Direction of the polygon's x axis in radians, counter-clockwise from the scene's; None: derived (section 5.6).
    segment_labels : sequence of str, optional
        A label per edge of `points` as given (edge i runs from vertex i to vertex i + 1), such as the wall that has
        the door.

    Attributes
    ----------
    points : ndarray of shape (n, 2), float64
        Counter-clockwise outline from the first vertex given, without a repeated last one; read-only.
    holes : tuple of ndarray
        Clockwise rings; the polygon's interior is on their left as well.
    segment_labels : tuple of str
        A label per edge of `points`, "" where none was given.

    Raises
    ------
    InputError
        For fewer than three distinct vertices, coordinates that are not finite or huge, self-crossings, no area, holes
        outside the outline, or a number of segment labels that is not the number of edges.

    Examples
    --------
    >>> room = Polygon([(0, 0), (0, 3), (4, 3), (4, 0)], label="bedroom")
    >>> room.area, room.points.tolist()
    (12.0, [[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [0.0, 3.0]])
    """

    def __init__(
        self,
        points: ArrayLike,
        label: str = "",
        id: str | None = None,
        holes: Sequence[ArrayLike] = (),
        parent: str | None = None,
        orientation: float | None = None,
        segment_labels: Sequence[str] | None = None,
    ) -> None:
        self.label = "" if label is None else str(label)
        self.id = None if id is None else str(id)
        self.parent = None if parent is None else str(parent)
        name = f"polygon {self.id!r}" if self.id is not None else f"a polygon labelled {self.label!r}"
        if orientation is not None and not np.isfinite(real(orientation)):
            raise InputError(
                f"{name} has the orientation {shown(orientation)}, which is not finite; give radians or leave it out"
            )
        self.orientation = None if orientation is None else float(orientation)
        self.points, edges = clean_ring(points, name)
        self.points.flags.writeable = False
        self.segment_labels = ("",) * len(edges)
        if segment_labels is not None:
            segment_labels = listed(segment_labels, f"what {name} has as segment labels", "a label per edge")
            count = len(np.asarray(points))
            closed = edges.max() < count - 1
            if not count - closed <= len(segment_labels) <= count:
                raise InputError(
                    f"{name} has {len(segment_labels)} segment labels for {count - closed} edges; give one per edge"
                )
            self.segment_labels = tuple("" if segment_labels[i] is None else str(segment_labels[i]) for i in edges)
        rings = listed(() if holes is None else holes, f"what {name} has as holes", "a list of rings")
        clean = (clean_ring(h, f"hole {i} of {name}")[0] for i, h in enumerate(rings))
        self.holes = tuple(np.roll(ring[::-1], 1, axis=0) for ring in clean)
        if self.holes and not self.shape.is_valid:
            raise InputError(
                f"{name} has a hole that leaves its outline or meets another hole; move or delete that hole"
            )
        for hole in self.holes:
            hole.flags.writeable = False

    def __repr__(self) -> str:
        return f"Polygon({len(self.points)} vertices, label={self.label!r}, id={self.id!r})"

    @cached_property
    def content(self) -> tuple[object, ...]:
        """All there is to know of the polygon, hashable: equal polygons have equal contents."""
        rings = tuple(ring.tobytes() for ring in self.rings)
        return (self.id, self.label, self.parent, self.orientation, self.segment_labels, rings)

    @cached_property
    def shape(self) -> shapely.Polygon:
        """The polygon as a shapely geometry."""
        return shapely.Polygon(self.points, self.holes)

    @property
    def rings(self) -> tuple[NDArray[np.float64], ...]:
        """The outline, then the holes; the interior is always on the left."""
        return (self.points, *self.holes)

    @cached_property
    def clear_rings(self) -> tuple[ClearRing, ...]:
        """The rings without the noise of their boundaries, which is what features are taken from."""
        labels = (self.segment_labels, *[()] * len(self.holes))
        return tuple(clear_ring(ring, names) for ring, names in zip(self.rings, labels, strict=True))

    @cached_property
    def area(self) -> float:
        """Area in squared scene units, without the holes."""
        return abs(signed_area(self.points)) - sum(abs(signed_area(h)) for h in self.holes)

    @cached_property
    def centroid(self) -> NDArray[np.float64]:
        """Centre of area, shape (2,)."""
        return shapely.get_coordinates(self.shape.centroid)[0]

    @cached_property
    def bounds(self) -> NDArray[np.float64]:
        """Smallest and largest x and y: (x0, y0, x1, y1)."""
        return np.hstack([self.points.min(axis=0), self.points.max(axis=0)])

    @cached_property
    def size(self) -> float:
        """The side of a square of equal area, in scene units: what lengths in the polygon are compared with."""
        return float(np.sqrt(self.area))

    @cached_property
    def inscribed_radius(self) -> float:
        """Radius of the largest circle inside (the n of section 4.4 for a pose inside)."""
        return float(shapely.length(shapely.maximum_inscribed_circle(self.shape, tolerance=0.002 * self.size)))

    @cached_property
    def enclosing_radius(self) -> float:
        """Radius of the smallest circle around (half the n of section 4.4 for a pose outside)."""
        return float(shapely.minimum_bounding_radius(self.shape))

    @cached_property
    def main_orientation(self) -> float:
        """Direction of the polygon's x axis, in radians (section 5.6).

        The one given; else the direction in which most of the outline's length runs, directions being taken modulo 90
        degrees, and of its four quarter turns the one nearest to the scene's x axis. A ring without any preferred
        direction (a circle) keeps the scene's.
        """
        if self.orientation is not None:
            return self.orientation
        return float(main_directions(self.clear_rings[0].points[None])[0])

    def to_dict(self) -> dict[str, Any]:
        """Plain data, as it is written to JSON.

        Returns
        -------
        dict
            Arguments for `Polygon`; what has its default is left out.
        """
        plain: dict[str, Any] = {"points": self.points.tolist(), "label": self.label, "id": self.id}
        if self.holes:
            plain["holes"] = [h.tolist() for h in self.holes]
        if self.parent is not None:
            plain["parent"] = self.parent
        if self.orientation is not None:
            plain["orientation"] = self.orientation
        if any(self.segment_labels):
            plain["segment_labels"] = list(self.segment_labels)
        return plain
