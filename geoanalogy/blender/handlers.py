"""Dropping what was derived when the data under it is exchanged: on undo, redo and load."""

import bpy
from bpy.app.handlers import persistent

from .reading.ground import memory
from .regions.finding import forget_found
from .tree.evaluating import evaluations
from .tree.explanation import forget_explanations
from .tree.store import forget_operations


@persistent
def _after_undo(scene, depsgraph=None):
    forget_explanations()


@persistent
def _after_load(path):
    forget_explanations()
    evaluations.clear()
    memory.clear()
    forget_found()
    forget_operations()


HANDLERS = (("undo_post", _after_undo), ("redo_post", _after_undo), ("load_post", _after_load))


def register():
    """Listen to undo, redo and load."""
    for name, handler in HANDLERS:
        getattr(bpy.app.handlers, name).append(handler)


def unregister():
    """Listen no longer."""
    for name, handler in HANDLERS:
        getattr(bpy.app.handlers, name).remove(handler)
