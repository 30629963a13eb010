"""Solids and assets as Blender meshes and objects."""

from __future__ import annotations

import math

import bpy
import numpy as np

from .assets import Asset
from .materials import material
from .solids import Solid


def mesh_of(name: str, solid: Solid, sharp_angle: float = 35.0) -> bpy.types.Mesh:
    """A mesh of a solid; edges bent by more than ``sharp_angle`` degrees stay sharp, 0 keeps every face flat."""
    mesh = bpy.data.meshes.new(name)
    names = sorted(set(solid.materials))
    for finish in names:
        mesh.materials.append(material(finish))
    totals = np.array([len(face) for face in solid.faces], dtype=np.int32)
    corners = np.fromiter((index for face in solid.faces for index in face), dtype=np.int32, count=int(totals.sum()))
    mesh.vertices.add(len(solid.vertices))
    mesh.vertices.foreach_set("co", solid.vertices.astype(np.float32).ravel())
    mesh.loops.add(len(corners))
    mesh.loops.foreach_set("vertex_index", corners)
    mesh.polygons.add(len(totals))
    mesh.polygons.foreach_set("loop_start", np.concatenate(([0], np.cumsum(totals)[:-1])).astype(np.int32))
    slots = {finish: slot for slot, finish in enumerate(names)}
    mesh.polygons.foreach_set("material_index", np.array([slots[m] for m in solid.materials], dtype=np.int32))
    mesh.update(calc_edges=True)
    mesh.polygons.foreach_set("use_smooth", np.full(len(totals), sharp_angle > 0))
    if sharp_angle > 0:
        mesh.set_sharp_from_angle(angle=math.radians(sharp_angle))
    mesh.update()
    return mesh


def asset_mesh(asset: Asset) -> bpy.types.Mesh:
    """The asset's mesh, made at its first use in this file."""
    existing = bpy.data.meshes.get(asset.name)
    return existing if existing is not None else mesh_of(asset.name, asset.solid(), asset.sharp_angle)


def add_asset(
    asset: Asset,
    collection: bpy.types.Collection,
    position: tuple[float, float] = (0.0, 0.0),
    angle: float = 0.0,
    z: float = 0.0,
    mirrored: bool = False,
    scale: float = 1.0,
) -> bpy.types.Object:
    """An object of the asset at a pose of the plan (angle in radians), linked to a collection.

    All objects of an asset share its mesh. A mirrored one has its left and right exchanged.
    """
    placed = bpy.data.objects.new(asset.name, asset_mesh(asset))
    placed.location = (*position, z)
    placed.rotation_euler = (0.0, 0.0, angle)
    placed.scale = (scale, -scale if mirrored else scale, scale)
    placed["ga_label"] = asset.label
    # The ground outline in the object's own frame, flat: x0, y0, x1, y1, …
    placed["ga_footprint"] = [float(c) for c in asset.footprint.ravel()]
    collection.objects.link(placed)
    return placed


def add_solid(name: str, solid: Solid, collection: bpy.types.Collection, sharp_angle: float = 35.0) -> bpy.types.Object:
    """An object of a solid that is no asset: walls, floors, ways."""
    made = bpy.data.objects.new(name, mesh_of(name, solid, sharp_angle))
    collection.objects.link(made)
    return made
