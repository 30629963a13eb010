"""Make the edits as a user does: put the example there and call the add-on's operation, which records it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import bpy
import numpy as np

from geoanalogy import PoseOptions
from geoanalogy.blender import recording, register
from geoanalogy.poses.arrays import ArrayOptions
from geoanalogy.poses.local_mapping import TransferOptions
from geoanalogy.poses.scatter import ScatterOptions
from geoanalogy.progress import run

from ..library import ASSETS
from ..library.meshes import add_asset
from .edit import AnyEdit, ArrayEdit, Edit, GroupEdit, Place, ScatterEdit


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
    return recording.array_steps(context, start, end, edit.spacing, options, array, name=name)


def _group(context, edit: GroupEdit, holder, height, number):
    items = [_put(holder, asset, place, height) for asset, place in edit.items]
    return recording.transfer_steps(context, items, TransferOptions(**edit.transfer), name=f"{number} group")


_MAKE = {Edit: _single, ScatterEdit: _scatter, ArrayEdit: _array, GroupEdit: _group}
