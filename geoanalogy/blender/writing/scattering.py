"""Thousands of equal objects as points with "Instance on Points": some arrays, whatever their number."""

import bpy
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Single = NDArray[np.float32]

#: Name of the node group, and of the attributes of the points.
GROUP, ROTATION, SCALE = "GeoAnalogy instances", "rotation", "scale"


def quaternions(matrices: Array) -> Array:
    """Rotations as unit quaternions.

    Parameters
    ----------
    matrices : ndarray of shape (n, 3, 3)
        Rotations.

    Returns
    -------
    ndarray of shape (n, 4)
        w, x, y, z.
    """
    m = np.asarray(matrices, float)
    x, y, z = m[:, 0, 0], m[:, 1, 1], m[:, 2, 2]
    # Of the four ways to solve for them, the one with the largest divisor is exact for each rotation.
    squares = 1 + np.stack([x + y + z, x - y - z, y - x - z, z - x - y], axis=1)
    best = squares.argmax(axis=1)
    sums, differences = m + m.transpose(0, 2, 1), m - m.transpose(0, 2, 1)
    a, b, c = differences[:, 2, 1], differences[:, 0, 2], differences[:, 1, 0]
    xy, xz, yz = sums[:, 0, 1], sums[:, 0, 2], sums[:, 1, 2]
    rows = np.stack(
        [
            np.stack([squares[:, 0], a, b, c], axis=1),
            np.stack([a, squares[:, 1], xy, xz], axis=1),
            np.stack([b, xy, squares[:, 2], yz], axis=1),
            np.stack([c, xz, yz, squares[:, 3]], axis=1),
        ],
        axis=1,
    )
    found = rows[np.arange(len(m)), best]
    return found / np.linalg.norm(found, axis=1, keepdims=True)


def scattered(
    name: str, source: bpy.types.Object, positions: Single, rotations: Single, scales: Single
) -> bpy.types.Object:
    """An object that shows another one at many places.

    Parameters
    ----------
    name : str
    source : bpy.types.Object
        What is shown; its own place does not matter.
    positions : ndarray of shape (n, 3)
    rotations : ndarray of shape (n, 4)
        Unit quaternions.
    scales : ndarray of shape (n, 3)

    Returns
    -------
    bpy.types.Object
        In no collection yet.
    """
    points = bpy.data.meshes.new(name)
    points.vertices.add(len(positions))
    points.attributes["position"].data.foreach_set("vector", positions.ravel())
    turned = points.attributes.new(ROTATION, "QUATERNION", "POINT")
    turned.data.foreach_set("value", rotations.ravel())
    sized = points.attributes.new(SCALE, "FLOAT_VECTOR", "POINT")
    sized.data.foreach_set("vector", scales.ravel())
    points.update()
    made = bpy.data.objects.new(name, points)
    modifier = made.modifiers.new("Instances", "NODES")
    modifier.node_group = _group()
    socket = next(s for s in modifier.node_group.interface.items_tree if s.name == "Object")
    if hasattr(modifier, "properties"):  # Blender from 5.2 on
        getattr(modifier.properties.inputs, socket.identifier).value = source
    else:
        modifier[socket.identifier] = source
    return made


def _group() -> bpy.types.NodeTree:
    """The file's node group, made at its first use."""
    existing = bpy.data.node_groups.get(GROUP)
    if existing is not None and existing.library is None:
        return existing
    group = bpy.data.node_groups.new(GROUP, "GeometryNodeTree")
    group.is_modifier = True
    group.interface.new_socket("Geometry", in_out="INPUT", socket_type="NodeSocketGeometry")
    group.interface.new_socket("Object", in_out="INPUT", socket_type="NodeSocketObject")
    group.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    nodes, links = group.nodes, group.links
    given, result = nodes.new("NodeGroupInput"), nodes.new("NodeGroupOutput")
    info, put = nodes.new("GeometryNodeObjectInfo"), nodes.new("GeometryNodeInstanceOnPoints")
    info.inputs["As Instance"].default_value = True
    links.new(given.outputs["Object"], info.inputs["Object"])
    links.new(given.outputs["Geometry"], put.inputs["Points"])
    links.new(info.outputs["Geometry"], put.inputs["Instance"])
    for name, kind, x in ((ROTATION, "QUATERNION", "Rotation"), (SCALE, "FLOAT_VECTOR", "Scale")):
        attribute = nodes.new("GeometryNodeInputNamedAttribute")
        attribute.data_type = kind
        attribute.inputs["Name"].default_value = name
        links.new(next(s for s in attribute.outputs if s.enabled and s.name == "Attribute"), put.inputs[x])
    links.new(put.outputs["Instances"], result.inputs["Geometry"])
    for k, node in enumerate((given, info, put, result)):
        node.location = (220.0 * k, 0.0)
    return group
