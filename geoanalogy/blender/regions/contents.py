"""What is carried over to similar regions: the points of objects, and copies of objects with other points.

Meshes keep UVs, materials, vertex groups and attributes; curves and strokes stay editable, and their thickness grows
with the region; of anything else the place, the direction and the size are carried.
"""

from dataclasses import dataclass, field

import bpy
import numpy as np
from mathutils import Matrix
from numpy.typing import NDArray

from ...errors import InputError
from .. import names
from ..linked import own_copy
from ..reading.curves import shown_drawings
from ..reading.planes import Plane

Array = NDArray[np.float64]

#: Points that a content may have: each is stored with every target.
MOST_POINTS = 100_000

#: Length of the axes by which a rigid object is carried, scene units.
AXIS = 1e-2


@dataclass(frozen=True)
class Places:
    """Where points are carried to.

    Attributes
    ----------
    points : ndarray of shape (n, 3)
        Plane coordinates (x, y, height).
    scale : ndarray of shape (n,)
        Local size of the mapping.
    confidence : ndarray of shape (n,)
    mirrored : bool
        Whether the mapping reflects.
    """

    points: Array
    scale: Array
    confidence: Array
    mirrored: bool


def world_matrix(item: bpy.types.Object) -> Array:
    """The matrix of an object, which Blender does not evaluate where it is in no scene.

    Parameters
    ----------
    item : bpy.types.Object

    Returns
    -------
    ndarray of shape (4, 4)
    """
    return np.array(item.matrix_world if item.users_scene else item.matrix_basis)


def points_of(item: bpy.types.Object) -> Array:
    """All points of an object that are carried over.

    Parameters
    ----------
    item : bpy.types.Object

    Returns
    -------
    ndarray of shape (n, 3)
        In the world.

    Raises
    ------
    InputError
        Where there are none, too many, or some that are not finite.
    """
    name = f"object {item.name!r}"
    matrix = world_matrix(item)
    if item.type in ("MESH", "CURVE", "GREASEPENCIL"):
        parts = [_get(one) @ one.matrix[:3, :3].T + one.matrix[:3, 3] for one in _arrays(item)]
        local = np.vstack(parts) if parts else np.zeros((0, 3))
    else:
        # The axes of a rigid object, in its own coordinates.
        local = np.vstack([np.zeros(3), AXIS * np.eye(3)])
        matrix = matrix.copy()
        matrix[:3, :3] /= np.linalg.norm(matrix[:3, :3], axis=0).clip(1e-30)
    if not len(local):
        raise InputError(f"{name} has no points to carry over; draw something with it first")
    if len(local) > MOST_POINTS:
        raise InputError(f"{name} has {len(local)} points; simplify it to {MOST_POINTS}")
    if not (np.isfinite(local).all() and np.isfinite(matrix).all()):
        raise InputError(f"{name} has a point that is not finite (NaN or infinity); delete that point")
    return local @ matrix[:3, :3].T + matrix[:3, 3]


def carried(item: bpy.types.Object, places: Places, source: Plane, plane: Plane, name: str) -> bpy.types.Object:
    """A copy of an object with its points elsewhere; it is in no collection yet.

    Its origin and axes go with the points, by the similarity that comes nearest to the mapping: what depends on them,
    a mirroring modifier or a texture by object coordinates, acts on the copy as on the original.

    Parameters
    ----------
    item : bpy.types.Object
    places : Places
        Of the points that `points_of` gives.
    source, plane : Plane
        Where the object lies, and where its copy goes.
    name : str

    Returns
    -------
    bpy.types.Object
    """
    made = own_copy(item)
    made.name = name
    made.parent = None
    made.animation_data_clear()
    for constraint in list(made.constraints):
        made.constraints.remove(constraint)
    if item.type not in ("MESH", "CURVE", "GREASEPENCIL"):
        _place_rigid(made, item, places.points, plane)
        return made
    made.data = item.data.copy()
    size, moved = _similarity(source.to_plane(points_of(item)), places)
    _set_matrix(made, plane.matrix @ moved @ np.linalg.inv(source.matrix) @ world_matrix(item))
    # Blender keeps a place, a turn and a size, in single precision: the points make up for what that leaves. An object
    # that is scaled flat has no inverse.
    kept = np.array(made.matrix_basis)
    local, start = (plane.to_world(places.points) - kept[:3, 3]) @ np.linalg.pinv(kept[:3, :3]).T, 0
    if item.type == "MESH" and made.data.shape_keys is not None:
        made.shape_key_clear()
    trusted = []
    for one in _arrays(made):
        part = slice(start, start + len(one.points))
        back = np.linalg.inv(one.matrix)
        _set(one, local[part] @ back[:3, :3].T + back[:3, 3])
        if one.radii is not None:
            radii = np.empty(len(one.radii), np.float32)
            one.radii.foreach_get(one.radius, radii)
            one.radii.foreach_set(one.radius, (radii * places.scale[part] / size).astype(np.float32))
        if one.attributes is not None:
            trusted.append((one.attributes, places.confidence[part]))
        start = part.stop
    # A new attribute may move the others in memory: all coordinates are written by now.
    for attributes, values in trusted:
        known = attributes.get(names.CONFIDENCE)
        attribute = known or attributes.new(names.CONFIDENCE, "FLOAT", "POINT")
        attribute.data.foreach_set("value", values.astype(np.float32))
    if item.type == "MESH":
        made.data.update()
    else:
        made.data.update_tag()
    return made


@dataclass(frozen=True)
class _Array:
    """Coordinates in an object's data.

    Attributes
    ----------
    points : bpy_prop_collection
    key : str
        Of the coordinates.
    width : int
        How many there are to a point.
    matrix : ndarray of shape (4, 4)
        Of their layer.
    radii : bpy_prop_collection or None
        Where the thickness of the line is, one to a point.
    radius : str
        Its key.
    attributes : bpy_prop_collection or None
        Where further values of the points are kept.
    """

    points: bpy.types.bpy_prop_collection
    key: str
    width: int = 3
    matrix: Array = field(default_factory=lambda: np.eye(4))
    radii: bpy.types.bpy_prop_collection | None = None
    radius: str = ""
    attributes: bpy.types.bpy_prop_collection | None = None


def _arrays(item: bpy.types.Object) -> list[_Array]:
    """The coordinates of an object's data."""
    data = item.data
    if item.type == "MESH":
        return [_Array(data.vertices, "co", attributes=data.attributes)] if len(data.vertices) else []
    found = []
    if item.type == "CURVE":
        for spline in data.splines:
            if spline.type == "BEZIER":
                knots = spline.bezier_points
                found.append(_Array(knots, "co", radii=knots, radius="radius"))
                found += [_Array(knots, key) for key in ("handle_left", "handle_right")]
            else:
                found.append(_Array(spline.points, "co", 4, radii=spline.points, radius="radius"))
        return found
    for layer, drawing in shown_drawings(data):
        attributes, placed = drawing.attributes, np.array(layer.matrix_local)
        radii = attributes.get("radius")
        for key in ("position", "handle_left", "handle_right"):
            attribute = attributes.get(key)
            if attribute is not None and len(attribute.data):
                own = radii.data if radii is not None and key == "position" else None
                kept = attributes if key == "position" else None
                found.append(_Array(attribute.data, "vector", 3, placed, own, "value", kept))
    return found


def _similarity(before: Array, places: Places) -> tuple[float, Array]:
    """The size and the matrix of the similarity between planes that takes points nearest to their places."""
    middles = before.mean(axis=0), places.points.mean(axis=0)
    a, b = ((p - middle)[:, :2] @ (1.0, 1.0j) for p, middle in zip((before, places.points), middles, strict=True))
    a = a.conj() if places.mirrored else a
    spread = float((a.conj() @ a).real)
    # Of a single point, and of points that all lie above each other, no turn is known.
    grown = complex(a.conj() @ b / spread) if spread > 0.0 else 0j
    size = abs(grown) or float(places.scale.mean()) or 1.0
    turn = grown / size if grown else 1.0
    x = np.array((turn.real, turn.imag))
    y = np.array((-turn.imag, turn.real)) * (-1.0 if places.mirrored else 1.0)
    matrix = np.eye(4)
    matrix[:2, 0], matrix[:2, 1] = size * x, size * y
    matrix[2, 2] = size
    matrix[:3, 3] = middles[1] - matrix[:3, :3] @ middles[0]
    return size, matrix


def _get(one: _Array) -> Array:
    values = np.empty(len(one.points) * one.width, np.float32)
    one.points.foreach_get(one.key, values)
    return values.reshape(-1, one.width)[:, :3].astype(float)


def _set(one: _Array, points: Array) -> None:
    values = np.empty(len(points) * one.width, np.float32)
    # The weight of a NURBS point, its fourth number, stays.
    one.points.foreach_get(one.key, values)
    values.reshape(-1, one.width)[:, :3] = points
    one.points.foreach_set(one.key, values)


def _place_rigid(made: bpy.types.Object, item: bpy.types.Object, points: Array, plane: Plane) -> None:
    """Turn, reflect and scale an object as its axes are."""
    world = plane.to_world(points)
    axes = (world[1:] - world[0]).T / AXIS
    frame = np.eye(4)
    frame[:3, :3] = axes * np.linalg.norm(world_matrix(item)[:3, :3], axis=0)
    frame[:3, 3] = world[0]
    _set_matrix(made, frame)


def _set_matrix(made: bpy.types.Object, frame: Array) -> None:
    made.rotation_mode = "XYZ"
    made.matrix_parent_inverse.identity()
    made.delta_location = made.delta_rotation_euler = (0.0, 0.0, 0.0)
    made.delta_scale = (1.0, 1.0, 1.0)
    made.matrix_basis = Matrix(frame.tolist())
