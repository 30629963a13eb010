"""Find the regions of a drawing that are similar to the query."""

import bpy
from bpy.props import BoolProperty, FloatProperty

from ..geoanalogy.blender import names
from ..geoanalogy.blender.counting import counted
from ..geoanalogy.blender.regions.recording import region_steps
from ..geoanalogy.blender.regions.results import uncertain_results
from ..geoanalogy.blender.regions.settings import SETTINGS, MatchingSettings, options_of
from .edit import LongEdit, needs_object_mode


class GEOANALOGY_OT_find_regions(MatchingSettings, LongEdit, bpy.types.Operator):
    """Find every region of the drawing that is like the query: bent, turned, scaled, partly hidden"""

    bl_idname = "geoanalogy.find_regions"
    bl_label = "Find Similar"

    automatic: BoolProperty(
        name="Automatic Threshold", description="Show what stands out from the clutter", default=True
    )
    threshold: FloatProperty(name="Threshold", description="Least similarity", min=0.0, max=1.0, default=0.3)

    @classmethod
    def poll(cls, context):
        return needs_object_mode(cls, context)

    def steps(self, context):
        """Match and record."""
        matching = context.scene.geoanalogy.matching
        for name in SETTINGS:
            if not self.properties.is_property_set(name):
                setattr(self, name, getattr(matching, name))
        threshold = None if self.automatic else round(self.threshold, 6)
        query = context.scene.geoanalogy.query
        node = yield from region_steps(context, query, options_of(self), threshold=threshold)
        # What the redo panel has changed is shown in the sidebar, and holds for the next query.
        for name in SETTINGS:
            setattr(matching, name, getattr(self, name))
        uncertain, shown = len(uncertain_results(node)), node[names.COUNT]
        return counted(shown, "similar region") + (f", {uncertain} uncertain" if uncertain else "")

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
