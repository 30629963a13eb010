"""Extrude everything of a label."""

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, FloatVectorProperty, StringProperty

from ..geoanalogy.blender.tree.building import extrusion_of, label_here, operation_steps
from ..geoanalogy.blender.tree.node_settings import FACES, HEIGHT, OVERHANG, PITCH, ROOFS
from ..geoanalogy.geometry.extrusion import FaceLabels
from ..geoanalogy.geometry.roof import Roof
from .edit import LongEdit, needs_object_mode


def _face(part, name):
    """The label of a part of the solid: whatever the last extrusion made of it, the next one begins with the usual."""
    usual = getattr(FaceLabels(), part)
    return StringProperty(name=name, description=FACES[part], default=usual, options={"SKIP_SAVE"})


class GEOANALOGY_OT_extrude(LongEdit, bpy.types.Operator):
    """Extrude everything of a label off its surface; the faces become surfaces that operations can work on"""

    bl_idname = "geoanalogy.extrude"
    bl_label = "Extrude"

    in_metres = {"height": 1}

    label: StringProperty(
        name="Label",
        description="Of what is extruded; empty: that of the active object, else of the active operation",
        options={"SKIP_SAVE"},
    )
    height: FloatProperty(name="Height", description=HEIGHT, default=3.0, subtype="DISTANCE")
    factor: FloatVectorProperty(
        name="Random Factor",
        description="Least and greatest multiplier of the height",
        size=2,
        default=(1.0, 1.0),
        options={"SKIP_SAVE"},
    )
    inwards: BoolProperty(
        name="Inwards",
        description="Below the surface, for what will be subtracted from it",
        options={"SKIP_SAVE"},
    )
    roof: EnumProperty(name="Roof", items=ROOFS, options={"SKIP_SAVE"})
    pitch: FloatProperty(name="Pitch", description=PITCH, default=Roof().pitch, min=0.02, max=1.5, subtype="ANGLE")
    overhang: FloatProperty(name="Overhang", description=OVERHANG, min=0.0, subtype="DISTANCE", options={"SKIP_SAVE"})
    walls: FloatProperty(
        name="Walls",
        description="Thickness of the walls of a room that is open above; 0: a full body",
        min=0.0,
        subtype="DISTANCE",
        options={"SKIP_SAVE"},
    )
    side: _face("side", "Sides")
    top: _face("top", "Top")
    bottom: _face("bottom", "Bottom")
    roof_label: _face("roof", "Roof Faces")
    gable: _face("gable", "Gables")

    @classmethod
    def poll(cls, context):
        return needs_object_mode(cls, context)

    def steps(self, context):
        """Extrude, show and record."""
        roof = Roof(self.roof, round(self.pitch, 6), overhang=round(self.overhang, 6))
        faces = FaceLabels(side=self.side, top=self.top, bottom=self.bottom, roof=self.roof_label, gable=self.gable)
        operation = extrusion_of(
            label_here(context, self.label),
            round(self.height, 6),
            (round(self.factor[0], 6), round(self.factor[1], 6)),
            inwards=self.inwards,
            roof=roof,
            walls=round(self.walls, 6),
            faces=faces,
        )
        _, shown = yield from operation_steps(context, operation)
        return shown.text

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        for name in ("label", "height", "factor", "inwards", "walls", "roof"):
            layout.prop(self, name)
        if self.roof != "flat":
            layout.prop(self, "pitch")
            layout.prop(self, "overhang")
        layout.separator()
        for name in ("side", "bottom", *(("top",) if self.roof == "flat" else ("roof_label", "gable"))):
            layout.prop(self, name)


def register():
    """Register the operator."""
    bpy.utils.register_class(GEOANALOGY_OT_extrude)


def unregister():
    """Unregister it."""
    bpy.utils.unregister_class(GEOANALOGY_OT_extrude)
