"""The pose of an object on a plane, its footprint there, and how it rests on the pose."""

import bpy
import numpy as np
import shapely
from numpy.typing import NDArray

from ...errors import InputError
from ...poses.pose import Pose
from .. import names
from .planes import PARALLEL, Plane, extent
from .shapes import rings_of, solid_points

Array = NDArray[np.float64]

#: Vertices of a hull that are nearer than this share of its size to the line of their neighbours are left out: rounded
#: edges and turned legs are no corners of a footprint.
HULL_DETAIL = 0.01


def pose_of(item: bpy.types.Object, plane: Plane) -> Pose:
    """The pose of an object: its origin and the direction of its own x axis, on a plane.

    Parameters
    ----------
    item : bpy.types.Object
    plane : Plane

    Returns
    -------
    Pose
        Never mirrored: how a mirrored object rests on it is left to `rest_of`.

    Raises
    ------
    InputError
        Where its x axis stands on the plane, or its scale is 0.
    """
    matrix = np.array(item.matrix_world)
    x, y, _ = plane.to_plane([matrix[:3, 3]])[0]
    axis = plane.matrix[:3, :3].T @ matrix[:3, 0]
    if not axis.any():
        raise InputError(f"object {item.name!r} has no size, since its scale is 0; give it another")
    if np.hypot(axis[0], axis[1]) <= PARALLEL * np.linalg.norm(axis):
        raise InputError(f"object {item.name!r} has its x axis upright on the plan; turn it, x is where it faces")
    return Pose((x, y), float(np.arctan2(axis[1], axis[0])))


def frame_of(pose: Pose, plane: Plane) -> Array:
    """The frame of a pose in the world: origin at its position, x along its direction, z the plane's normal.

    Parameters
    ----------
    pose : Pose
        Its mirror flag plays no part.
    plane : Plane

    Returns
    -------
    ndarray of shape (4, 4)
    """
    c, s = np.cos(pose.angle), np.sin(pose.angle)
    placed = np.eye(4)
    placed[:2, :2] = ((c, -s), (s, c))
    placed[:2, 3] = pose.position
    return plane.matrix @ placed


def rest_of(item: bpy.types.Object, pose: Pose, plane: Plane) -> Array:
    """How an object rests on its pose: its height, tilt and scale.

    Parameters
    ----------
    item : bpy.types.Object
    pose : Pose
    plane : Plane

    Returns
    -------
    ndarray of shape (4, 4)
        From the object's coordinates to the frame of its pose.
    """
    return np.linalg.inv(frame_of(pose, plane)) @ np.array(item.matrix_world)


def footprint_ring_of(item: bpy.types.Object, plane: Plane, depsgraph: bpy.types.Depsgraph) -> Array:
    """The footprint of an object in plane coordinates.

    Parameters
    ----------
    item : bpy.types.Object
    plane : Plane
    depsgraph : bpy.types.Depsgraph
        Modifiers are evaluated in it.

    Returns
    -------
    ndarray of shape (n, 2)
        Its own (see `names.FOOTPRINT`); else the outline of what is drawn flat; else the convex hull of all its points.

    Raises
    ------
    InputError
        Where it has no extent on the plane.
    """
    stored = item.get(names.FOOTPRINT)
    if stored is not None:
        try:
            own = np.asarray(list(stored), float).reshape(-1, 2)
        except (TypeError, ValueError):
            raise InputError(
                f"object {item.name!r} has a footprint that is no list of x, y pairs; take it anew in step 2"
            ) from None
        local = np.column_stack([own, np.zeros(len(own)), np.ones(len(own))])
        return plane.to_plane((local @ np.array(item.matrix_world).T)[:, :3])[:, :2]
    if item.type in ("CURVE", "GREASEPENCIL"):
        rings = rings_of(item, depsgraph)
        if len(rings) == 1:
            return plane.to_plane(rings[0].points)[:, :2]
    return hull_of(item, plane, depsgraph)


def hull_of(item: bpy.types.Object, plane: Plane, depsgraph: bpy.types.Depsgraph) -> Array:
    """The convex hull of an object in plane coordinates.

    Parameters
    ----------
    item : bpy.types.Object
    plane : Plane
    depsgraph : bpy.types.Depsgraph

    Returns
    -------
    ndarray of shape (n, 2)

    Raises
    ------
    InputError
        Where it has no extent on the plane.
    """
    hull = shapely.convex_hull(shapely.MultiPoint(plane.to_plane(solid_points(item, depsgraph))[:, :2]))
    hull = shapely.simplify(hull, HULL_DETAIL * extent(shapely.get_coordinates(hull)))
    if hull.geom_type != "Polygon" or not hull.area:
        raise InputError(f"object {item.name!r} has no extent on the plan; give it a square footprint in step 2")
    return shapely.get_coordinates(hull)[:-1]


def footprint_of(item: bpy.types.Object, plane: Plane, depsgraph: bpy.types.Depsgraph) -> Array:
    """The footprint of an object in the frame of its pose.

    Parameters
    ----------
    item : bpy.types.Object
    plane : Plane
    depsgraph : bpy.types.Depsgraph

    Returns
    -------
    ndarray of shape (n, 2)

    Raises
    ------
    InputError
        Where it has no extent on the plane, or its x axis stands on it.
    """
    return pose_of(item, plane).to_frame(footprint_ring_of(item, plane, depsgraph))


def outline_of(item: bpy.types.Object, plane: Plane, depsgraph: bpy.types.Depsgraph) -> Array:
    """The exact outline of an object's faces seen along a plane's normal, in plane coordinates.

    Parameters
    ----------
    item : bpy.types.Object
        A mesh.
    plane : Plane
    depsgraph : bpy.types.Depsgraph

    Returns
    -------
    ndarray of shape (n, 2)
        Of the largest part, without its holes.

    Raises
    ------
    InputError
        Where it has no faces.
    """
    evaluated = item.evaluated_get(depsgraph)
    mesh = evaluated.to_mesh() if item.type == "MESH" else None
    if mesh is None or not len(mesh.polygons):
        raise InputError(f"object {item.name!r} has no faces; choose the hull for its footprint")
    mesh.calc_loop_triangles()
    corners = np.empty(3 * len(mesh.loop_triangles), dtype=np.int32)
    mesh.loop_triangles.foreach_get("vertices", corners)
    points = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", points)
    evaluated.to_mesh_clear()
    matrix = np.array(item.matrix_world)
    flat = plane.to_plane(points.reshape(-1, 3).astype(float) @ matrix[:3, :3].T + matrix[:3, 3])[:, :2]
    triangles = shapely.polygons(flat[corners.reshape(-1, 3)])
    solid = shapely.union_all(
        triangles[shapely.area(triangles) > 1e-9 * extent(flat) ** 2], grid_size=1e-6 * extent(flat)
    )
    largest = max(shapely.get_parts(solid), key=shapely.area)
    return shapely.get_coordinates(shapely.simplify(largest.exterior, HULL_DETAIL * extent(flat)))[:-1]
