"""Turning the 3D view to something."""

from collections.abc import Sequence

import bpy
import numpy as np
from mathutils import Vector

#: How much larger what the view shows is than what is looked at.
ROOM = 1.5

#: Cosine between a face and the direction to the viewer below which it is seen from the edge, and turned to.
EDGE_ON = 0.3


def look_at(context: bpy.types.Context, ring: Sequence[Sequence[float]]) -> None:
    """Move the 3D view to an outline, and turn it there where it would be seen from the edge or from behind.

    Parameters
    ----------
    context : bpy.types.Context
        Without a 3D view, nothing happens.
    ring : sequence of (float, float, float)
        World coordinates, counter-clockwise as seen from its front.
    """
    area = context.area
    if area is None or area.type != "VIEW_3D":
        return
    points = np.array(ring)
    view = area.spaces.active.region_3d
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    normal = Vector(np.cross(points - middle, np.roll(points - middle, -1, axis=0)).sum(axis=0)).normalized()
    if normal.dot(view.view_rotation @ Vector((0.0, 0.0, 1.0))) < EDGE_ON:
        view.view_rotation = normal.to_track_quat("Z", "Y")
    view.view_location = middle
    view.view_distance = ROOM * float(np.linalg.norm(np.ptp(points, axis=0)))
