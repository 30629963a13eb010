"""Put copies of the active object where chance falls."""

import bpy
from bpy.props import EnumProperty, FloatProperty, IntProperty

from ..geoanalogy.blender import names
from ..geoanalogy.blender.tree.recording import scatter_steps
from ..geoanalogy.poses.scatter import ScatterOptions
from .edit import LongEdit, needs_active_object, selected_active
from .pose_settings import PoseSettings


class GEOANALOGY_OT_scatter(PoseSettings, LongEdit, bpy.types.Operator):
    """Put copies of the active object at random, likelier where they stand in the same relations"""

    bl_idname = "geoanalogy.scatter"
    bl_label = "Scatter"

    in_metres = {"density": -2}

    amount: EnumProperty(
        name="Amount",
        items=[
            ("COUNT", "Per Polygon", "So many in every polygon like the example's"),
            ("DENSITY", "Per Area", "So many per squared unit"),
        ],
    )
    count: IntProperty(
        name="Count", description="Objects in every polygon like the example's", min=0, soft_max=200, default=10
    )
    density: FloatProperty(name="Density", description="Objects per squared unit", min=0.0, default=0.1)
    width: FloatProperty(
        name="Irregularity",
        description="How far from the best places objects may fall, as a share of the polygon's size",
        min=0.001,
        soft_max=1.0,
        default=0.15,
    )
    spacing: FloatProperty(
        name="Spacing", description="Least distance; 0 is the object's own extent", min=0.0, subtype="DISTANCE"
    )
    directions: EnumProperty(
        name="Directions",
        items=[
            ("best", "As the Example", "Objects take the direction that the relations give"),
            ("random", "Any", "Objects are turned at random"),
        ],
    )
    sharpness: FloatProperty(
        name="Sharpness", description="The more, the closer to the best places", min=0.0, default=1.0
    )
    seed: IntProperty(name="Seed", description="For another draw", min=0)

    @classmethod
    def poll(cls, context):
        return needs_active_object(cls, context)

    def steps(self, context):
        """Learn, draw and record."""
        by_count = self.amount == "COUNT"
        options = ScatterOptions(
            count=self.count if by_count else None,
            density=None if by_count else self.density,
            width=self.width,
            spacing=self.spacing or None,
            directions=self.directions,
            sharpness=self.sharpness,
        )
        node = yield from scatter_steps(context, selected_active(context), options, self.pose_options(), seed=self.seed)
        return f"{node[names.COUNT]} scattered"

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "amount")
        layout.prop(self, "count" if self.amount == "COUNT" else "density")
        for name in ("width", "spacing", "directions", "sharpness", "seed"):
            layout.prop(self, name)
        self.draw_pose_settings(layout)


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_scatter)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_scatter)
