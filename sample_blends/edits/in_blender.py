"""Make the edits as a user does: put the example there and call the add-on's operation, which records it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import bpy
import numpy as np
from mathutils import Matrix, Vector

from geoanalogy import PlacementOptions, PoseOptions
from geoanalogy.blender import names, register
from geoanalogy.blender.rectangle_drawing import add_rectangles
from geoanalogy.blender.tree import recording
from geoanalogy.blender.tree.placement_recording import placement_steps
from geoanalogy.poses.arrays import ArrayOptions
from geoanalogy.poses.local_mapping import TransferOptions
from geoanalogy.poses.scatter import ScatterOptions
from geoanalogy.progress import run

from .. import stage
from ..library import ASSETS
from ..library.facades import PARTS
from ..library.meshes import add_asset, mesh_of
from ..library.parts import Part
from .edit import AnyEdit, ArrayEdit, Edit, GroupEdit, Place, PlacementEdit, ScatterEdit

# What is upright stands on a wall: its z along the wall's y, its front along the wall's z.
UPRIGHT = Matrix.Rotation(-np.pi / 2, 4, "X")
# Depth below the ground at which parts stand aside.
ASIDE = -40.0


def make_edits(
    context: bpy.types.Context,
    edits: Sequence[AnyEdit],
    holder: bpy.types.Collection,
    height: Callable[[AnyEdit], float],
) -> Iterator[bpy.types.Node]:
    """Make one edit after the other; yields the node of each.

    The examples are put into a collection; ``height`` says how many metres above the plan's origin each stands.
    """
    if not hasattr(bpy.types.Scene, "geoanalogy"):
        register()
    for number, edit in enumerate(edits, start=1):
        steps = _MAKE[type(edit)]
        yield run(steps(context, edit, holder, height(edit), f"{number:02d}"))


def _put(holder: bpy.types.Collection, asset: str, place: Place, height: float) -> bpy.types.Object:
    return add_asset(ASSETS[asset], holder, place[:2], float(np.radians(place[2])), height)


def _single(context, edit: Edit, holder, height, number):
    item = _put(holder, edit.asset, edit.place, height)
    most = None if edit.most is None else {"": edit.most}
    options = PoseOptions(**edit.options)
    name = f"{number} {edit.asset}"
    return recording.pose_steps(context, item, options, threshold=edit.threshold, max_per=most, name=name)


def _scatter(context, edit: ScatterEdit, holder, height, number):
    item = _put(holder, edit.asset, edit.place, height)
    scatter, options = ScatterOptions(**edit.scatter), PoseOptions(**edit.options)
    name = f"{number} {edit.asset}"
    return recording.scatter_steps(context, item, scatter, options, seed=edit.seed, name=name)


def _array(context, edit: ArrayEdit, holder, height, number):
    start = _put(holder, edit.asset, edit.place, height)
    end = None
    if edit.end is not None:
        end = bpy.data.objects.new(f"{number} end", None)
        end.empty_display_type = "ARROWS"
        end.empty_display_size = 0.1
        end.location = (*edit.end[:2], height)
        end.rotation_euler = (0.0, 0.0, float(np.radians(edit.end[2])))
        holder.objects.link(end)
    options, array = PoseOptions(**edit.options), ArrayOptions(**edit.array)
    name = f"{number} {edit.asset} row"
    return recording.array_steps(context, start, end, edit.spacing, options, array, threshold=edit.threshold, name=name)


def _group(context, edit: GroupEdit, holder, height, number):
    items = [_put(holder, asset, place, height) for asset, place in edit.items]
    return recording.transfer_steps(context, items, TransferOptions(**edit.transfer), name=f"{number} group")


def _placement(context, edit: PlacementEdit, holder, height, number):
    part = PARTS[edit.part]
    element, wanted = None, []
    if "repeat" in edit.fit:
        element = _part(part, Matrix.Translation((0.0, 0.0, ASIDE)), aside(context.scene))
    for facade, x0, y0, x1, y1 in edit.wanted:
        where = context.scene.objects[facade].matrix_world
        if element is not None:
            ends = (tuple(where @ Vector((x, y, 0.0))) for x, y in ((x0, y0), (x1, y1)))
            wanted += add_rectangles(context, [(*ends, 1.0)], part.label)
        else:
            item = _part(part, where @ Matrix.Translation(((x0 + x1) / 2, (y0 + y1) / 2, 0.0)) @ UPRIGHT, holder)
            item.scale = ((x1 - x0) / part.size[0], 1.0, (y1 - y0) / part.size[1])
            wanted.append(item)
    return placement_steps(
        context,
        wanted,
        element,
        PlacementOptions(**edit.options),
        fit=edit.fit,
        gap=edit.gap,
        threshold=edit.threshold,
        max_per=None if edit.most is None else {"": edit.most},
        name=f"{number} {edit.part}",
    )


def _part(part: Part, matrix: Matrix, holder: bpy.types.Collection) -> bpy.types.Object:
    mesh = bpy.data.meshes.get(part.name) or mesh_of(part.name, part.solid())
    item = bpy.data.objects.new(part.name, mesh)
    holder.objects.link(item)
    item.matrix_world = matrix
    item[names.LABEL] = part.label
    return item


def aside(scene: bpy.types.Scene) -> bpy.types.Collection:
    """The collection of parts that stand aside: they are not rendered, their copies are."""
    holder = stage.collection(scene, "Aside")
    holder.hide_render = True
    return holder


_MAKE = {Edit: _single, ScatterEdit: _scatter, ArrayEdit: _array, GroupEdit: _group, PlacementEdit: _placement}
