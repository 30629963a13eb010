"""Objects bent to the outline that a group has been mapped to: the only results that have data of their own."""

from collections.abc import Mapping
from itertools import chain

import bpy
import numpy as np
from numpy.typing import NDArray

from ...geometry.cage import cage_coordinates, is_bent
from ...operations.element import Element
from ...operations.group_placement import GroupPlacement
from .. import names
from ..tree.store import engine_node

Array = NDArray[np.float64]

#: Types of the objects that can be bent.
BENDING = ("MESH", "CURVE")


class Bender:
    """Bends results, those of one outline all to the same data.

    Parameters
    ----------
    outlines : mapping of str to ndarray of shape (n, 2)
        By the names of objects in the operation, their outlines in the frames of their poses, before they are bent.
    """

    def __init__(self, outlines: Mapping[str, Array]) -> None:
        self._outlines = outlines
        self._made: dict[tuple, bpy.types.ID] = {}

    @classmethod
    def of(cls, node: bpy.types.Node) -> "Bender | None":
        """What bends the results of a node.

        Parameters
        ----------
        node : bpy.types.Node

        Returns
        -------
        Bender or None
            None where it bends none.
        """
        stored = node.get(names.OPERATION)
        if not hasattr(stored, "items") or stored.get("type") != GroupPlacement.type:
            return None
        outlines = engine_node(node).operation.bent_outlines
        return cls(outlines) if outlines else None

    def bend(self, made: bpy.types.Object, element: Element, rest: Array) -> None:
        """Bend a result to its element's outline.

        Parameters
        ----------
        made : bpy.types.Object
            Anything but meshes and curves is left as it is.
        element : Element
        rest : ndarray of shape (4, 4)
            From the object's coordinates to the frame of its pose.
        """
        outline = self._outlines.get(element.mesh)
        if outline is None or made.type not in BENDING or element.footprint is None:
            return
        bent = np.array(element.footprint)
        # The example itself has its own outline, without the vertices between its corners.
        if not is_bent(outline, bent):
            return
        if abs(np.linalg.det(rest)) == 0.0:
            return  # it is flat, and cannot be told from where its points are
        kind = (element.mesh, element.footprint)
        if kind not in self._made:
            self._made[kind] = bent_data(made.data, outline, bent, rest)
            self._made[kind][names.KEY] = element.key
        made.data = self._made[kind]


def bent_data(data: bpy.types.ID, outline: Array, bent: Array, rest: Array) -> bpy.types.ID:
    """A mesh or a curve bent as its outline is.

    Parameters
    ----------
    data : bpy.types.Mesh or bpy.types.Curve
        Stays as it is.
    outline, bent : ndarray of shape (n, 2)
        Vertex by vertex, in the frame of a pose.
    rest : ndarray of shape (4, 4)
        From the data's coordinates to that frame.

    Returns
    -------
    bpy.types.ID
        A copy.
    """
    made = data.copy()
    for points, name in _points_of(made):
        _bend_points(points, name, outline, bent, rest)
    return made


def _points_of(data: bpy.types.ID) -> list[tuple[bpy.types.bpy_prop_collection, str]]:
    """The collections of points of a mesh or a curve, and how their places are called."""
    keys = data.shape_keys.key_blocks if data.shape_keys else ()
    if isinstance(data, bpy.types.Mesh):
        return [(data.vertices, "co"), *((key.data, "co") for key in keys)]
    handles = ("co", "handle_left", "handle_right")
    curved = [((spline.bezier_points, name) for name in handles) for spline in data.splines if spline.type == "BEZIER"]
    return [*chain(*curved), *((spline.points, "co") for spline in data.splines if spline.type != "BEZIER")]


def _bend_points(points: bpy.types.bpy_prop_collection, name: str, outline: Array, bent: Array, rest: Array) -> None:
    if not len(points):
        return
    wide = len(getattr(points[0], name))  # points of splines have a weight
    flat = np.empty(len(points) * wide, dtype=np.float32)
    points.foreach_get(name, flat)
    places = flat.reshape(-1, wide)
    standing = places[:, :3].astype(float) @ rest[:3, :3].T + rest[:3, 3]
    standing[:, :2] = cage_coordinates(standing[:, :2], outline) @ bent
    places[:, :3] = (standing - rest[:3, 3]) @ np.linalg.inv(rest[:3, :3]).T
    points.foreach_set(name, places.ravel())
