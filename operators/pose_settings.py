"""The options of propagation that several operators show in their redo panels."""

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, StringProperty

from ..geoanalogy.blender.pairs import read_pairs
from ..geoanalogy.blender.tree.recording import LEAST_IMPORTANCE
from ..geoanalogy.poses.options import PoseOptions
from ..geoanalogy.relations.table import POSE_RELATIONS

# Blender asks for these texts again and again: they must outlive the question.
RELATION_ITEMS = [
    (row.name, row.name.replace("_", " ").capitalize(), f"Whether {row.name.replace('_', ' ')} counts", 1 << i)
    for i, row in enumerate(POSE_RELATIONS)
]


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
    accumulation: EnumProperty(
        name="Search",
        items=[
            ("footprint", "Footprint", "Sides and corners of the footprint stand in relations as well as its centre"),
            ("plane", "Positions", "The origin alone stands in relations"),
            ("pose space", "Positions and Directions", "The origin alone, in every direction: slower"),
        ],
        default="footprint",
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
    level_set_width: FloatProperty(
        name="Tolerance",
        description="How far off a relation may be, as a share of the size of the example's polygon",
        min=0.001,
        max=0.5,
        default=PoseOptions().level_set_width,
    )

    clearance: StringProperty(
        name="Clearance",
        description="Width to keep free around polygons of a label, as in: door 0.9, window 0.3",
    )
    weights: StringProperty(
        name="Weights",
        description="How much a label or a relation counts, 0 is not at all and 1 as usual, as in: chair 0, "
        "corner distance 2",
    )

    def pose_options(self) -> PoseOptions:
        """The options as the engine takes them; an InputError where clearance or weights cannot be read."""
        return PoseOptions(
            relations=tuple(item[0] for item in RELATION_ITEMS if item[0] in self.relations),
            threshold=LEAST_IMPORTANCE,
            accumulation=self.accumulation,
            level_set_width=self.level_set_width,
            mirror={"AUTO": None, "YES": True, "NO": False}[self.mirror],
            symmetries=self.symmetries,
            scale=self.scale,
            labels=self.use_labels,
            validate=self.validate,
            clearance=read_pairs(self.clearance, "clearance"),
            relation_weights=read_pairs(self.weights, "weight"),
        )

    def draw_pose_settings(self, layout: bpy.types.UILayout) -> None:
        """Draw them into a redo panel."""
        for name in ("mirror", "scale", "accumulation", "level_set_width", "validate", "clearance"):
            layout.prop(self, name)
        for name in ("symmetries", "use_labels", "weights"):
            layout.prop(self, name)
        column = layout.column(heading="Relations")
        column.prop(self, "relations")
