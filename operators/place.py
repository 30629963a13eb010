"""Learn from the selected examples, and fill every place like them."""

import math

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, FloatVectorProperty, IntProperty, StringProperty

from ..geoanalogy.blender import names
from ..geoanalogy.blender.counting import counted
from ..geoanalogy.blender.tree.placement_recording import THRESHOLD, placement_steps
from ..geoanalogy.placements.options import PlacementOptions
from .edit import LongEdit, needs_object_mode

FITS = [
    ("scale", "Stretch", "One object, stretched to fill the place"),
    ("repeat", "Repeat", "As many objects of their own size as fit"),
    ("divide", "Divide", "As many objects as fit best, stretched to fill the place"),
]

#: How far a place may be from the examples in shape; any size is without bounds.
TOLERANCES = ("aspect_tolerance", "area_tolerance")

_PLAIN = PlacementOptions()


class GEOANALOGY_OT_place(LongEdit, bpy.types.Operator):
    """Learn what the selected examples have in common, and put the object wherever that holds"""

    bl_idname = "geoanalogy.place"
    bl_label = "Learn and Place"

    threshold: FloatProperty(
        name="Threshold",
        description="Least score of a result",
        min=0.0,
        max=1.0,
        default=THRESHOLD,
        subtype="FACTOR",
    )
    along: EnumProperty(name="Along", description="Along the width of a place", items=FITS)
    across: EnumProperty(name="Across", description="Along the height of a place", items=FITS)
    gap: FloatVectorProperty(
        name="Distance",
        description="Least distance between repeated objects, along and across",
        size=2,
        min=0.0,
        subtype="XYZ_LENGTH",
    )
    most: IntProperty(name="At Most per Face", description="The examples counted; 0 is any number", min=0)
    tau: FloatProperty(
        name="Tolerance",
        description="Below 1 for places that are exactly like the examples, above for looser ones",
        min=0.05,
        max=20.0,
        default=_PLAIN.tau,
    )
    any_size: BoolProperty(
        name="Any Size", description="Places may be much larger or smaller than the examples, and of other proportions"
    )
    mirrored: BoolProperty(
        name="Mirrored",
        description="Places count too that are found turned inside out, with what bounds them on the wrong side",
        default=_PLAIN.mirrored,
    )
    forbid_intersections: BoolProperty(
        name="No Intersections",
        description="Leave out every place that intersects something of a label which no example intersects; without "
        "it, such places only score lower",
        default=_PLAIN.forbid_intersections,
    )
    overlap: FloatProperty(
        name="Overlap",
        description="Share of the smaller of two places that they may have in common",
        min=0.0,
        max=1.0,
        default=_PLAIN.allow_overlaps,
        subtype="FACTOR",
    )
    neighbours: IntProperty(
        name="Neighbours",
        description="How many of every label a place has relations to, the nearest ones",
        min=1,
        soft_max=10,
        default=_PLAIN.neighbours,
    )
    between: BoolProperty(
        name="Between Neighbours",
        description="The gap between two neighbours counts where most examples lie in one: between window and door",
        default=_PLAIN.between,
    )
    aspect_tolerance: FloatProperty(
        name="Proportions",
        description="How far the proportions of a place may be from those of the examples",
        min=0.01,
        soft_max=5.0,
        default=_PLAIN.aspect_tolerance,
    )
    area_tolerance: FloatProperty(
        name="Areas",
        description="How far the area of a place may be from that of the examples",
        min=0.01,
        soft_max=5.0,
        default=_PLAIN.area_tolerance,
    )
    more: BoolProperty(name="More Options", description="Show the options that are seldom needed")
    name: StringProperty(name="Name", description="Of the operation; empty: the label of what is placed")

    @classmethod
    def poll(cls, context):
        return needs_object_mode(cls, context)

    def steps(self, context):
        """Learn, place and record."""
        element = context.scene.geoanalogy.element
        chosen = sorted(context.selected_objects, key=lambda item: item.name)
        # What is to be placed may stand aside, and be selected all the same.
        examples = [item for item in chosen if item != element] or chosen
        node = yield from placement_steps(
            context,
            examples,
            element,
            self._options(),
            fit=(self.along, self.across),
            gap=tuple(self.gap),
            threshold=round(self.threshold, 6),
            max_per={"": self.most} if self.most else None,
            name=self.name.strip() or None,
        )
        return f"{counted(node[names.COUNT], 'object')} placed"

    def _options(self):
        tolerances = {name: math.inf if self.any_size else round(getattr(self, name), 6) for name in TOLERANCES}
        return PlacementOptions(
            tau=round(self.tau, 6),
            neighbours=self.neighbours,
            mirrored=self.mirrored,
            allow_overlaps=round(self.overlap, 6),
            forbid_intersections=self.forbid_intersections,
            between=self.between,
            **tolerances,
        )

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        for name in ("threshold", "along", "across", "gap", "most", "tau", "any_size", "name", "more"):
            layout.prop(self, name)
        if not self.more:
            return
        for name in ("forbid_intersections", "mirrored", "overlap", "neighbours", "between"):
            layout.prop(self, name)
        column = layout.column()
        column.active = not self.any_size
        for name in TOLERANCES:
            column.prop(self, name)


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_place)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_place)
