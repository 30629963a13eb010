"""The options of propagation that several operators show in their redo panels."""

from dataclasses import replace
from typing import Any

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty

from ..geoanalogy.blender.pairs import read_counts, read_pairs
from ..geoanalogy.blender.tree.recording import LEAST_IMPORTANCE, THRESHOLD
from ..geoanalogy.poses.options import PoseOptions
from ..geoanalogy.relations.table import POSE_RELATIONS

# Blender asks for these texts again and again: they must outlive the question.
RELATION_ITEMS = [
    (row.name, row.name.replace("_", " ").capitalize(), f"Whether {row.name.replace('_', ' ')} counts", 1 << i)
    for i, row in enumerate(POSE_RELATIONS)
]

#: What is shown at once, and what only where more is asked for.
SHOWN = ("mirror", "scale", "validate", "clearance")
MORE = ("symmetries", "use_labels", "other_parents", "weights", "local_importance", "matching_accuracy")

_PLAIN = PoseOptions()


class PoseSettings:
    """Properties that become `PoseOptions`."""

    mirror: EnumProperty(
        name="Mirrored Results",
        items=[
            ("AUTO", "If Symmetric", "Mirrored places count where the object looks the same mirrored"),
            ("YES", "Yes", "Mirrored places count, and the object is mirrored there"),
            ("NO", "No", "Mirrored places do not count"),
        ],
        default="AUTO",
    )
    scale: EnumProperty(
        name="Size",
        items=[
            ("fixed", "Fixed", "Objects keep their size, and lengths count as they are"),
            ("room", "With the Room", "Lengths and objects may grow and shrink with the polygon they are in"),
        ],
        default="fixed",
    )
    relations: EnumProperty(
        name="Relations",
        description="What must be alike",
        items=RELATION_ITEMS,
        options={"ENUM_FLAG"},
        default={item[0] for item in RELATION_ITEMS},
    )
    validate: BoolProperty(
        name="Validate", description="Leave out results that intersect what the example does not", default=True
    )
    symmetries: BoolProperty(
        name="Symmetry Axes", description="Count places mirrored about the axes of single edges and corners too"
    )
    use_labels: BoolProperty(name="Labels", description="Only match polygons of the same label", default=True)
    clearance: StringProperty(
        name="Clearance",
        description="Width to keep free around polygons of a label, as in: door 0.9, window 0.3",
    )
    weights: StringProperty(
        name="Weights",
        description="How much a label or a relation counts, 0 is not at all and 1 as usual, as in: chair 0, "
        "corner distance 2",
    )
    other_parents: BoolProperty(
        name="Other Rooms",
        description="Polygons of another label than the example's may get results too, where what stands in them is "
        "alike",
        default=_PLAIN.other_parents,
    )
    local_importance: EnumProperty(
        name="Importance",
        items=[
            ("distance", "Nearer Counts More", "What is near the object counts more than what is far from it"),
            ("constant", "All Alike", "Near and far count alike"),
        ],
        default=_PLAIN.local_importance,
    )
    matching_accuracy: EnumProperty(
        name="Matching",
        items=[
            ("features", "By Likeness", "Edges and corners count the more, the more alike they are"),
            ("constant", "All Alike", "Edges of any length and corners of any angle count alike"),
        ],
        default=_PLAIN.matching_accuracy,
    )
    more: BoolProperty(name="More Options", description="Show the options that are seldom needed")

    shown, shown_more = SHOWN, MORE

    def pose_options(self) -> PoseOptions:
        """The options as the engine takes them; an InputError where clearance or weights cannot be read."""
        return PoseOptions(
            relations=tuple(item[0] for item in RELATION_ITEMS if item[0] in self.relations),
            threshold=LEAST_IMPORTANCE,
            mirror={"AUTO": None, "YES": True, "NO": False}[self.mirror],
            symmetries=self.symmetries,
            scale=self.scale,
            labels=self.use_labels,
            validate=self.validate,
            clearance=read_pairs(self.clearance, "clearance"),
            relation_weights=read_pairs(self.weights, "weight"),
            other_parents=self.other_parents,
            local_importance=self.local_importance,
            matching_accuracy=self.matching_accuracy,
        )

    def counts(self, name: str) -> bool:
        """Whether an option does anything as the others are set."""
        return True

    def draw_pose_settings(self, layout: bpy.types.UILayout) -> None:
        """Draw them into a redo panel."""
        for name in self.shown:
            layout.prop(self, name)
        layout.prop(self, "more")
        if not self.more:
            return
        for name in self.shown_more:
            row = layout.row()
            row.active = self.counts(name)
            row.prop(self, name)
        column = layout.column(heading="Relations")
        column.prop(self, "relations")


class SearchSettings(PoseSettings):
    """The same, with how the best places are searched: where chance draws places, that counts for nothing."""

    accumulation: EnumProperty(
        name="Search",
        items=[
            ("footprint", "Footprint", "Sides and corners of the footprint stand in relations as well as its centre"),
            ("plane", "Positions", "The origin alone stands in relations"),
            ("pose space", "Positions and Directions", "The origin alone, in every direction: slower"),
        ],
        default="footprint",
    )
    level_set_width: FloatProperty(
        name="Tolerance",
        description="How far off a relation may be, as a share of the size of the example's polygon",
        min=0.001,
        max=0.5,
        default=_PLAIN.level_set_width,
    )
    direction_width: FloatProperty(
        name="Turn Tolerance",
        description="How far off a direction may be",
        min=0.01,
        max=3.14,
        default=_PLAIN.direction_width,
        subtype="ANGLE",
    )
    cells: IntProperty(
        name="Grid Points",
        description="In all polygons together: more finds places that are narrow, and takes longer",
        min=100,
        soft_max=1_000_000,
        default=_PLAIN.cells,
    )
    direction_bins: IntProperty(
        name="Directions",
        description="How many directions are searched by Positions and Directions",
        min=4,
        soft_max=360,
        default=_PLAIN.direction_bins,
    )
    candidates: IntProperty(
        name="Candidates",
        description="Most places that are kept per polygon, whatever the threshold",
        min=1,
        soft_max=100,
        default=_PLAIN.candidates,
    )

    shown = (*SHOWN[:2], "accumulation", "level_set_width", *SHOWN[2:])
    shown_more = (*MORE, "direction_width", "cells", "direction_bins", "candidates")

    def counts(self, name: str) -> bool:
        """Whether an option does anything as the others are set."""
        return name != "direction_bins" or self.accumulation == "pose space"

    def pose_options(self) -> PoseOptions:
        """The options as the engine takes them; an InputError where clearance or weights cannot be read."""
        return replace(
            super().pose_options(),
            accumulation=self.accumulation,
            level_set_width=self.level_set_width,
            direction_width=round(self.direction_width, 6),
            cells=self.cells,
            direction_bins=self.direction_bins,
            candidates=self.candidates,
        )


class SiftedPoses(SearchSettings):
    """The same, with what sifts results: a threshold, how many a polygon may hold, and how near they may be."""

    threshold: FloatProperty(
        name="Threshold",
        description="Least importance of a result",
        min=0.0,
        max=1.0,
        default=THRESHOLD,
        subtype="FACTOR",
    )
    most: IntProperty(
        name="At Most",
        description="Most objects in every polygon like the example's, the example counted; 0 is any number",
        min=0,
        default=1,
    )
    most_of: StringProperty(
        name="In Others", description="Most objects in polygons of other labels, as in: room 2, corridor 1"
    )
    spacing: FloatProperty(
        name="Spacing",
        description="Least distance between two results; 0 is as near as they do not touch",
        min=0.0,
        subtype="DISTANCE",
    )

    def sifting(self) -> dict[str, Any]:
        """The arguments of what records; an InputError where the numbers cannot be read."""
        most = ({"": self.most} if self.most else {}) | read_counts(self.most_of, "number")
        return {"threshold": round(self.threshold, 6), "max_per": most or None, "spacing": self.spacing or None}

    def draw_sifting(self, layout: bpy.types.UILayout) -> None:
        """Draw them into a redo panel."""
        for name in ("threshold", "most", "spacing"):
            layout.prop(self, name)
        if self.other_parents or not self.use_labels:
            layout.prop(self, "most_of")
