"""Replay all operations on what stands there now."""

import bpy

from ..geoanalogy.blender.tree.replay import replay_steps
from .edit import LongEdit, needs_operations


class GEOANALOGY_OT_replay(LongEdit, bpy.types.Operator):
    """Replay all operations; examples that were moved are learned again"""

    bl_idname = "geoanalogy.replay"
    bl_label = "Replay"

    @classmethod
    def poll(cls, context):
        return needs_operations(cls, context)

    def steps(self, context):
        """Evaluate what has changed, and show everything anew."""
        report = yield from replay_steps(context)
        return report.text


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_replay)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_replay)
