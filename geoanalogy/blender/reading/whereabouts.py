"""Where objects stand, whether or not Blender evaluates them.

Blender evaluates neither what is disabled in viewports nor what is in an excluded collection, and stores no world
matrices: after loading and undo, those of such objects are the identity. A plan that is hidden for rendering would be
replayed as if all of it stood at the origin.
"""

import bpy
import numpy as np
from mathutils import Matrix

#: Kinds of parents whose own matrix alone places their children.
PLAIN_PARENTS = {"OBJECT", "ARMATURE", "LATTICE"}

#: Entries of matrices that are no further apart are equal, as shares of their size: single precision.
ROUNDING = 1e-5


def up_to_date(context: bpy.types.Context) -> bpy.types.Depsgraph:
    """Bring the scene up to date, with the world matrices of what Blender does not evaluate.

    Parameters
    ----------
    context : bpy.types.Context

    Returns
    -------
    bpy.types.Depsgraph
        Of the view layer. What is not evaluated stands where its parents and its transformation put it; its modifiers
        do not count.
    """
    context.view_layer.update()
    hidden = {item.name_full: item for item in context.scene.objects if _may_be_left_out(item)}
    if hidden:
        _place(hidden)
    return context.evaluated_depsgraph_get()


def _may_be_left_out(item: bpy.types.Object) -> bool:
    """Whether an object is not seen, and stands where its parents and its transformation put it."""
    return not item.visible_get() and not item.constraints and item.parent_type in PLAIN_PARENTS


def _place(hidden: dict[str, bpy.types.Object]) -> None:
    """Set the matrices that are wrong; assigning them one by one would change the transformations too."""
    found: dict[str, Matrix] = {}
    wrong = {name for name, item in hidden.items() if not _equal(_world(item, hidden, found), item.matrix_world)}
    if not wrong:
        return
    every = bpy.data.objects
    matrices = np.empty((len(every), 4, 4), np.float32)
    every.foreach_get("matrix_world", matrices.ravel())
    for i, item in enumerate(every):
        if item.name_full in wrong:
            # Blender keeps matrices by their columns.
            matrices[i] = np.array(found[item.name_full]).T
    every.foreach_set("matrix_world", matrices.ravel())


def _world(item: bpy.types.Object, hidden: dict[str, bpy.types.Object], found: dict[str, Matrix]) -> Matrix:
    name = item.name_full
    if name not in hidden:
        return item.matrix_world
    if name not in found:
        over, own = item.parent, item.matrix_basis
        found[name] = own if over is None else _world(over, hidden, found) @ item.matrix_parent_inverse @ own
    return found[name]


def _equal(one: Matrix, other: Matrix) -> bool:
    a, b = np.array(one), np.array(other)
    return bool(np.abs(a - b).max() <= ROUNDING * max(np.abs(a).max(), np.abs(b).max()))
