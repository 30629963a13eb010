"""Applying a tree as it is to a scene, or to some of its parcels."""

import json

import bpy

from ...errors import InputError
from ...progress import Stepper
from .. import names
from ..reading.ground import labels_of
from ..reading.identity import ids_of
from .evaluating import parcels_of, read_surroundings
from .store import require_operations
from .whole import Shown, whole_steps, write_whole


def selected_parcels(context: bpy.types.Context) -> list[str]:
    """Ids of the selected objects of the plan.

    Parameters
    ----------
    context : bpy.types.Context

    Returns
    -------
    list of str

    Raises
    ------
    InputError
        Where there are none.
    """
    labels, ids = labels_of(context.scene), ids_of(context.scene)
    found = sorted(ids[i.name] for i in context.selected_objects if i.name in labels and names.KEY not in i)
    if not found:
        raise InputError("no parcel is selected; select labelled outlines of the plan")
    return found


def apply_steps(context: bpy.types.Context, chosen: list[str] | None = None, *, more: bool = False) -> Stepper[Shown]:
    """Apply the scene's tree as it was learned, and show what comes of it.

    Parameters
    ----------
    context : bpy.types.Context
    chosen : list of str, optional
        Ids of the objects of the plan that it is applied to from now on; empty: everything; None: as before.
    more : bool
        Whether it stays applied to what it was applied to before.

    Returns
    -------
    generator of (float, str)
        Returns what stands in the scene.

    Raises
    ------
    InputError
        Where the scene has no operations, or they cannot be evaluated; then everything is as it was.
    """
    tree = require_operations(context.scene)
    if chosen is None:
        chosen = parcels_of(tree)
    elif more and chosen:
        chosen = sorted({*chosen, *parcels_of(tree)})
    every = read_surroundings(context, chosen=chosen)
    layouts = yield from whole_steps(every)
    tree[names.APPLIED_TO] = json.dumps(chosen)
    return write_whole(context.scene, tree, every, layouts)
