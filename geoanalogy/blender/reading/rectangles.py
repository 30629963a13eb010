"""Objects as rectangles on the plane they lie on: the examples of placements."""

import bpy
import numpy as np
from numpy.typing import NDArray

from ...errors import InputError
from ...geometry.rectangle import Rectangle
from ...poses.pose import Pose
from .. import names
from .footprints import footprint_ring_of, rest_of
from .planes import Plane
from .shapes import solid_points

Array = NDArray[np.float64]

#: Shares of axes in a plane that differ by less are equal.
SAME_SHARE = 1e-3

#: Cosine of the angle between an object's axis and the direction that it is stretched along: half a degree.
UPRIGHT = 0.99996


def target_of(item: bpy.types.Object) -> float:
    """How much an example is wanted.

    Parameters
    ----------
    item : bpy.types.Object

    Returns
    -------
    float

    Raises
    ------
    InputError
        Where the property is no number from 0 to 1.
    """
    target = item.get(names.TARGET, 1.0)
    if isinstance(target, bool) or not isinstance(target, int | float) or not 0 <= target <= 1:
        raise InputError(f"object {item.name!r} has the preference {target!r}; give a number from 0 to 1")
    # A float of Blender's interface has single precision: 0.4 is meant, not 0.4000000059.
    return round(float(target), 6)


def middle_of(item: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> Array:
    """The middle of the box around an object and its children.

    Parameters
    ----------
    item : bpy.types.Object
    depsgraph : bpy.types.Depsgraph
        Modifiers are evaluated in it.

    Returns
    -------
    ndarray of shape (3,)
        World coordinates.

    Raises
    ------
    InputError
        Where it has no points, or points that are not finite.
    """
    points = solid_points(item, depsgraph)
    if not len(points):
        raise InputError(f"object {item.name!r} has no extent; choose an object that can be seen")
    if not np.isfinite(points).all():
        raise InputError(f"object {item.name!r} has a location that is not finite; clear its transform")
    return (points.min(axis=0) + points.max(axis=0)) / 2


def rectangle_of(item: bpy.types.Object, plane: Plane, depsgraph: bpy.types.Depsgraph) -> Rectangle:
    """The rectangle that an object takes up on a plane.

    Parameters
    ----------
    item : bpy.types.Object
    plane : Plane
    depsgraph : bpy.types.Depsgraph
        Modifiers are evaluated in it.

    Returns
    -------
    Rectangle
        In plane coordinates; its width runs along the first of the object's own axes that lies in the plane.

    Raises
    ------
    InputError
        Where the object has no extent there.
    """
    axes = plane.matrix[:3, :3].T @ np.array(item.matrix_world)[:3, :3]
    lengths = np.linalg.norm(axes, axis=0)
    share = np.hypot(axes[0], axes[1]) / np.where(lengths > 0, lengths, 1.0)
    along = axes[:2, int(np.argmax(share >= share.max() - SAME_SHARE))]
    angle = float(np.arctan2(along[1], along[0]))
    if names.FOOTPRINT in item or item.type in ("CURVE", "GREASEPENCIL"):
        flat = footprint_ring_of(item, plane, depsgraph)
    else:
        flat = plane.to_plane(solid_points(item, depsgraph))[:, :2]
    c, s = np.cos(angle), np.sin(angle)
    turned = flat @ np.array([[c, -s], [s, c]])
    if not len(turned) or np.ptp(turned, axis=0).min() <= 1e-6 * np.ptp(turned, axis=0).max():
        raise InputError(f"object {item.name!r} has no extent on the face; turn it, or choose another object")
    return Rectangle.from_box(np.hstack([turned.min(axis=0), turned.max(axis=0)]), angle)


def rest_on(item: bpy.types.Object, rectangle: Rectangle, plane: Plane) -> Array:
    """How an object rests on its rectangle.

    Parameters
    ----------
    item : bpy.types.Object
    rectangle : Rectangle
    plane : Plane

    Returns
    -------
    ndarray of shape (4, 4)
        From the object's coordinates to the frame of the rectangle: its centre and its directions.
    """
    return rest_of(item, Pose((rectangle.x, rectangle.y), rectangle.angle), plane)


def require_stretchable(item: bpy.types.Object, rest: Array) -> None:
    """Refuse an object that cannot be stretched along a rectangle's sides: it stands askew to them.

    Parameters
    ----------
    item : bpy.types.Object
    rest : ndarray of shape (4, 4)
        How it rests on its rectangle.

    Raises
    ------
    InputError
    """
    axes = rest[:3, :3] / np.linalg.norm(rest[:3, :3], axis=0)
    if np.abs(axes).max(axis=0).min() < UPRIGHT:
        raise InputError(
            f"object {item.name!r} stands askew on the face and cannot be stretched; turn it parallel to the face, or "
            "repeat it along both sides"
        )
