"""Put the active object in rows along boundaries."""

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty

from ..geoanalogy.blender import names
from ..geoanalogy.blender.counting import counted
from ..geoanalogy.blender.tree.recording import THRESHOLD, array_steps, is_mark
from ..geoanalogy.errors import InputError
from ..geoanalogy.poses.arrays import ArrayOptions
from .edit import LongEdit, needs_active_object, selected_active
from .pose_settings import SearchSettings


class GEOANALOGY_OT_array(SearchSettings, LongEdit, bpy.types.Operator):
    """Put copies of the active object along the boundary it stands at, up to the selected empty; so in like places"""

    bl_idname = "geoanalogy.array"
    bl_label = "Array"

    in_metres = {"spacing": 1}

    spacing: FloatProperty(
        name="Spacing",
        description="Distance between two objects along the path",
        min=0.0,
        default=1.0,
        subtype="DISTANCE",
    )
    even: BoolProperty(name="Fit", description="Change the spacing a little, so that the last object stands at the end")
    corners: EnumProperty(
        name="Corners",
        items=[
            ("round", "Round", "The path keeps its distance from the boundary's corners"),
            ("mitre", "Sharp", "The path has corners where the boundary has"),
        ],
    )
    way: EnumProperty(
        name="Way",
        items=[
            ("shorter", "Shorter", "The shorter way from the first object to the end"),
            ("left", "With the Boundary", "With the inside of the polygon on the left"),
            ("right", "Against the Boundary", "With the inside of the polygon on the right"),
        ],
    )
    threshold: FloatProperty(
        name="Threshold",
        description="Least importance of an array",
        min=0.0,
        max=1.0,
        default=THRESHOLD,
        subtype="FACTOR",
    )

    @classmethod
    def poll(cls, context):
        return needs_active_object(cls, context)

    def steps(self, context):
        """Learn, propagate and record."""
        start = selected_active(context)
        ends = [item for item in context.selected_objects if item != start]
        if len(ends) > 1:
            raise InputError("several objects mark the array's end; select one empty and the first object")
        if ends and is_mark(start) and not is_mark(ends[0]):
            # Whoever clicks the empty last means the same.
            start, ends = ends[0], [start]
        node = yield from array_steps(
            context,
            start,
            ends[0] if ends else None,
            self.spacing,
            self.pose_options(),
            ArrayOptions(self.corners, self.even, validate=self.validate, way=self.way),
            threshold=round(self.threshold, 6),
        )
        return f"{counted(node[names.COUNT], 'object')} in arrays"

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        for name in ("spacing", "even", "corners", "way", "threshold"):
            layout.prop(self, name)
        self.draw_pose_settings(layout)


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_array)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_array)
