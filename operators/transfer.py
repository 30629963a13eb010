"""Take a group of objects to polygons of other shapes."""

import bpy
from bpy.props import BoolProperty, EnumProperty

from ..geoanalogy.blender import names
from ..geoanalogy.blender.counting import counted
from ..geoanalogy.blender.tree.recording import is_mark, transfer_steps
from ..geoanalogy.errors import InputError
from ..geoanalogy.poses.local_mapping import TransferOptions
from .edit import LongEdit, needs_object_mode


class GEOANALOGY_OT_transfer(LongEdit, bpy.types.Operator):
    """Take the selected objects of one polygon to every polygon like it"""

    bl_idname = "geoanalogy.transfer"
    bl_label = "Transfer Group"
    bl_description = (
        "Take the selected objects of one polygon to every polygon like it, following the shape of its boundary. "
        "Plain empties selected with them, one per polygon, mark where lengths along the boundary start, or the corner"
    )

    system: EnumProperty(
        name="Coordinates",
        items=[
            ("boundary", "Boundary", "Distance from the boundary and length along it"),
            ("corner", "Corner", "Distance and direction from one corner"),
        ],
    )
    distance: EnumProperty(
        name="Distances",
        items=[
            ("inscribed", "In Proportion", "In proportion to the largest circle inside the polygon"),
            ("absolute", "Fixed", "As they are"),
            ("depth", "Fill", "In proportion to the way to the middle: reaches every part of the polygon"),
        ],
    )
    shape: EnumProperty(
        name="Shape",
        items=[
            ("rigid", "Kept", "Objects are moved and turned, and share the data of the example"),
            ("outline", "Bent", "Meshes and curves are bent with the boundary, and have data of their own"),
        ],
    )
    corners: BoolProperty(
        name="Corner to Corner",
        description="Lengths run from corner to corner where there are equally many",
        default=True,
    )
    everything: BoolProperty(
        name="Everything", description="Place objects too for which a polygon has no room; they stand in its middle"
    )

    @classmethod
    def poll(cls, context):
        return needs_object_mode(cls, context)

    def steps(self, context):
        """Learn, transfer and record."""
        if self.system == "corner" and self.distance == "depth":
            raise InputError("from a corner, distances cannot fill a polygon; choose In Proportion or Fixed")
        chosen = sorted(context.selected_objects, key=lambda item: item.name)
        marks = [item for item in chosen if is_mark(item)]
        items = [item for item in chosen if item not in marks]
        options = TransferOptions(system=self.system, distance=self.distance, corners=self.corners, shape=self.shape)
        node = yield from transfer_steps(context, items, options, marks, everything=self.everything)
        return f"{counted(node[names.COUNT], 'object')} transferred"

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        for name in ("system", "distance", "shape"):
            layout.prop(self, name)
        if self.system == "boundary":
            layout.prop(self, "corners")
        layout.prop(self, "everything")


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_transfer)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_transfer)
