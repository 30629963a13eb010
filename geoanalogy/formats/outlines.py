"""What the readers of all formats produce: outlines, and what the file says of them, to be polygons of a scene."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from ..errors import InputError
from ..geometry.polygon import Polygon, signed_area
from ..geometry.scene import Scene
from ..tolerances import FAR_FROM_ORIGIN, LARGEST_COORDINATE, NEARLY_CLOSED

Points = NDArray[np.float64]

#: Offsets are whole thousands of units: they can be read and typed, and adding them back loses nothing.
_OFFSET_STEP = 1000.0


@dataclass(frozen=True)
class Outline:
    """One area of a file.

    Attributes
    ----------
    where : str
        What the file calls it, for messages: "feature 3", "path 'bed'".
    rings : sequence of ndarray of shape (n, 2)
        The outline, then its holes, in scene units and not yet moved.
    properties : dict
        Further arguments for `Polygon`.
    """

    where: str
    rings: Sequence[Points]
    properties: dict[str, Any] = field(default_factory=dict)


def make_scene(file: str, outlines: Sequence[Outline], problems: list[str] | None = None) -> Scene:
    """The scene of a file's outlines, brought near the origin where they lie far from it.

    Parameters
    ----------
    file : str
        The file's name, for messages.
    outlines : sequence of Outline
    problems : list of str, optional
        Takes a sentence for every outline that makes no polygon, and the rest is read; None: the first such is raised.

    Returns
    -------
    Scene
        Its `offset` is what was taken from the coordinates.

    Raises
    ------
    InputError
        For no outlines at all, rings that are none, and stated parents that are not there.
    """
    if not outlines:
        raise InputError(f"{file} holds no closed shape; draw the outlines of rooms and objects as closed shapes")
    offset = _offset(outlines)
    polygons = []
    for outline in outlines:
        try:
            if max(np.abs(r).max(initial=0.0) for r in outline.rings) > LARGEST_COORDINATE:
                raise InputError(
                    f"it lies more than {LARGEST_COORDINATE:g} units from the origin; move the drawing near the origin"
                )
            first, *holes = (r - offset for r in outline.rings)
            polygons.append(Polygon(first, holes=holes, **outline.properties))
        except InputError as error:
            if problems is None:
                raise InputError(f"{file}, {outline.where}: {error}") from None
            problems.append(f"{file}, {outline.where}: {error}")
    scene = Scene(polygons, offset=(float(offset[0]), float(offset[1])))
    try:
        for polygon in scene.polygons[:1]:
            scene.parent(str(polygon.id))  # finds the hierarchy of all, and what is wrong with stated parents
    except InputError as error:
        raise InputError(f"{file}: {error}") from None
    return scene


def _offset(outlines: Sequence[Outline]) -> Points:
    every = np.concatenate([o.rings[0] for o in outlines])
    every = every[np.isfinite(every).all(axis=1)]
    if not len(every):
        return np.zeros(2)
    low, high = every.min(axis=0), every.max(axis=0)
    centre = low / 2 + high / 2
    if np.abs(centre).max() <= max(FAR_FROM_ORIGIN, float((high / 2 - low / 2).max()) * 2):
        return np.zeros(2)
    return np.round(centre / _OFFSET_STEP) * _OFFSET_STEP


def joined(points: Points) -> Points:
    """A ring without the last points that are the first again, rounding aside.

    Parameters
    ----------
    points : ndarray of shape (n, 2)

    Returns
    -------
    ndarray of shape (m, 2), m <= n
    """
    _, length = _gap(points)
    while len(points) > 3 and _gap(points)[0] <= NEARLY_CLOSED**2 * length:
        points = points[:-1]
    return points


def is_closed(points: Points, file: str, where: str) -> bool:
    """Whether a line that is not marked as closed ends where it starts.

    Parameters
    ----------
    points : ndarray of shape (n, 2)
    file, where : str
        For messages.

    Returns
    -------
    bool

    Raises
    ------
    InputError
        Where the ends nearly meet: an outline that was meant to be closed, and would be lost as a line.
    """
    gap, length = _gap(points)
    if len(points) < 4 or gap > NEARLY_CLOSED * length:
        return False
    if gap > NEARLY_CLOSED**2 * length:
        raise InputError(f"{file}, {where}: the ring is open, its ends are {gap:.3g} units apart; close it")
    return True


def _gap(points: Points) -> tuple[float, float]:
    """Distance from a line's last point to its first, and its length."""
    return float(np.hypot(*(points[-1] - points[0]))), float(np.hypot(*np.diff(points, axis=0).T).sum())


def with_holes(rings: Sequence[Points]) -> list[list[Points]]:
    """Rings of one shape, each outer ring with its holes: a ring in another is its hole, one in a hole is outer.

    Parameters
    ----------
    rings : sequence of ndarray of shape (n, 2)

    Returns
    -------
    list of list of ndarray
        Outer ring first; a ring that is broken stands alone, for `Polygon` to say what is wrong with it.
    """
    if len(rings) == 1:
        return [list(rings)]
    sound = [i for i, r in enumerate(rings) if len(r) > 3 and np.isfinite(r).all() and shapely.Polygon(r).is_valid]
    result = [[r] for i, r in enumerate(rings) if i not in set(sound)]
    sound.sort(key=lambda i: -abs(signed_area(rings[i])))  # what holds a ring comes before it
    shapes = {i: shapely.Polygon(rings[i]) for i in sound}
    outer: dict[int, list[Points]] = {}
    holders: dict[int, list[int]] = {}
    for place, i in enumerate(sound):
        inside = shapes[i].representative_point()
        holders[i] = [k for k in sound[:place] if shapes[k].contains(inside)]
        if len(holders[i]) % 2:
            outer[holders[i][-1]].append(rings[i])
        else:
            outer[i] = [rings[i]]
    return result + list(outer.values())
