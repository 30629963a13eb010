"""Stopping what works on data before it is exchanged, and dropping what was derived of it: on undo, redo and load."""

import bpy
from bpy.app.handlers import persistent

from .jobs import stop_jobs
from .reading.ground import memory
from .regions.finding import forget_found
from .tree.evaluating import evaluations
from .tree.explanation import forget_explanations
from .tree.store import forget_operations


@persistent
def _before_exchange(*_):
    stop_jobs("the scene was undone or exchanged while it was being worked on; nothing else has changed, start again")


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


HANDLERS = (
    ("undo_pre", _before_exchange),
    ("redo_pre", _before_exchange),
    ("load_pre", _before_exchange),
    ("undo_post", _after_undo),
    ("redo_post", _after_undo),
    ("load_post", _after_load),
)


def register():
    """Listen to undo, redo and load."""
    for name, handler in HANDLERS:
        getattr(bpy.app.handlers, name).append(handler)


def unregister():
    """Listen no longer; what is at work cannot be told any more."""
    stop_jobs("the add-on was disabled")
    for name, handler in HANDLERS:
        getattr(bpy.app.handlers, name).remove(handler)
