"""Find the regions of a drawing that are similar to the query."""

import bpy
from bpy.props import BoolProperty, FloatProperty, IntProperty

from ..geoanalogy.blender import names
from ..geoanalogy.blender.regions.recording import region_steps
from ..geoanalogy.blender.regions.results import uncertain_results
from ..geoanalogy.regions.options import RegionOptions
from .edit import LongEdit, needs_object_mode

_PLAIN = RegionOptions()

#: The settings that are options of the engine.
SETTINGS = (
    "mirrored",
    "branches",
    "joint_tolerance",
    "largest_scale",
    "query_points",
    "reach",
    "smoothing_radius",
    "neighbourhood",
    "contrast",
    "most",
)


class GEOANALOGY_OT_find_regions(LongEdit, bpy.types.Operator):
    """Find every region of the drawing that is like the query: bent, turned, scaled, partly hidden"""

    bl_idname = "geoanalogy.find_regions"
    bl_label = "Find Similar"

    automatic: BoolProperty(
        name="Automatic Threshold", description="Show what stands out from the clutter", default=True
    )
    threshold: FloatProperty(name="Threshold", description="Least similarity", min=0.0, max=1.0, default=0.3)
    mirrored: BoolProperty(name="Mirrored", description="Whether mirror images count as well", default=_PLAIN.mirrored)
    largest_scale: FloatProperty(
        name="Largest Scale",
        description="How many times larger, or smaller, than the query a region may be",
        min=1.0,
        max=100.0,
        default=_PLAIN.largest_scale,
    )
    joint_tolerance: FloatProperty(
        name="Joints",
        description="0: shapes that bend smoothly; towards 1: limbs that turn at a joint",
        min=0.0,
        max=1.0,
        default=_PLAIN.joint_tolerance,
        subtype="FACTOR",
    )
    branches: BoolProperty(
        name="Branches", description="Several regions may share lines, as twigs share a trunk", default=_PLAIN.branches
    )
    query_points: IntProperty(
        name="Query Points",
        description="How densely the region is sampled: more for thin parts",
        min=8,
        max=400,
        default=_PLAIN.query_points,
    )
    reach: FloatProperty(
        name="Reach",
        description="Lines this near to a stroke belong to it, as a share of its length",
        min=0.001,
        max=1.0,
        default=_PLAIN.reach,
    )
    smoothing_radius: FloatProperty(
        name="Smoothing",
        description="How far the evidence of single points reaches, as a share of the query's extent",
        min=0.01,
        max=1.0,
        default=_PLAIN.smoothing_radius,
    )
    neighbourhood: FloatProperty(
        name="Neighbourhood",
        description="How far shapes must deform alike, in distances between query points: more bridges what is hidden",
        min=0.5,
        max=10.0,
        default=_PLAIN.neighbourhood,
    )
    contrast: FloatProperty(
        name="Contrast",
        description="Least similarity as a share of the best region's: what is much less alike is clutter",
        min=0.0,
        max=1.0,
        default=_PLAIN.contrast,
        subtype="FACTOR",
    )
    most: IntProperty(name="At Most", description="How many regions are kept", min=1, max=1000, default=_PLAIN.most)

    @classmethod
    def poll(cls, context):
        return needs_object_mode(cls, context)

    def steps(self, context):
        """Match and record."""
        values = {name: getattr(self, name) for name in SETTINGS}
        options = RegionOptions(**{k: round(v, 6) if isinstance(v, float) else v for k, v in values.items()})
        threshold = None if self.automatic else round(self.threshold, 6)
        node = yield from region_steps(context, context.scene.geoanalogy.query, options, threshold=threshold)
        uncertain, shown = len(uncertain_results(node)), node[names.COUNT]
        return f"{shown} similar regions" + (f", {uncertain} uncertain" if uncertain else "")

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "automatic")
        row = layout.row()
        row.active = not self.automatic
        row.prop(self, "threshold")
        for name in SETTINGS:
            layout.prop(self, name)


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_find_regions)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_find_regions)
