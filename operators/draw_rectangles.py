"""Draw rectangles on faces with the mouse, as examples."""

import bpy
from bpy.props import CollectionProperty, FloatProperty, FloatVectorProperty, StringProperty

from ..geoanalogy.blender.counting import counted
from ..geoanalogy.blender.overlay import Overlay
from ..geoanalogy.blender.rectangle_drawing import Sketch, add_rectangles, required_label, sites_to_draw_on
from ..geoanalogy.errors import InputError
from .edit import needs_object_mode
from .view_drawing import DONE_EVENTS, MOVES, ViewDrawing


class GEOANALOGY_PG_corners(bpy.types.PropertyGroup):
    """A rectangle by two opposite corners."""

    start: FloatVectorProperty(name="Start", subtype="TRANSLATION")
    end: FloatVectorProperty(name="End", subtype="TRANSLATION")
    target: FloatProperty(name="Preference", min=0.0, max=1.0, default=1.0, subtype="FACTOR")


class GEOANALOGY_OT_draw_rectangles(ViewDrawing, bpy.types.Operator):
    """Drag rectangles across labelled faces: examples of where something belongs, or of where it does not"""

    bl_idname = "geoanalogy.draw_rectangles"
    bl_label = "Draw Rectangles"

    rectangles: CollectionProperty(name="Rectangles", type=GEOANALOGY_PG_corners)
    label: StringProperty(name="Label", description="What they are; empty: the label of the panel")

    @classmethod
    def poll(cls, context):
        return needs_object_mode(cls, context)

    def edit(self, context):
        """Put the rectangles there."""
        corners = [(tuple(one.start), tuple(one.end), round(one.target, 6)) for one in self.rectangles]
        return counted(len(add_rectangles(context, corners, self._label(context))), "example")

    def _label(self, context):
        return self.label or context.scene.geoanalogy.rectangle_label

    def invoke(self, context, event):
        if context.area is None or context.area.type != "VIEW_3D":
            self.report({"ERROR"}, "rectangles are drawn in a 3D view; move the mouse over one")
            return {"CANCELLED"}
        try:
            required_label(self._label(context))
            self._sketch = Sketch(sites_to_draw_on(context))
        except InputError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.rectangles.clear()
        self._missed = False
        self._tell(context)
        return self.begin(context, Overlay(self._sketch.shapes), "CROSSHAIR")

    def modal(self, context, event):
        if not self.is_shown(context):
            return self.cancelled(context)
        self._area.tag_redraw()
        pressed = event.value == "PRESS"
        if event.type == "ESC" and pressed:
            return self.cancelled(context)
        if event.type in DONE_EVENTS and pressed:
            self.end(context)
            for start, end, target in self._sketch.done:
                one = self.rectangles.add()
                one.start, one.end, one.target = start, end, target
            return self.execute(context)
        if event.type in {"BACK_SPACE", "DEL"} and pressed:
            self._sketch.take_back()
        elif event.type == "N" and pressed:
            self._sketch.target = 1.0 - self._sketch.target
        elif event.type in MOVES and self._sketch.dragging:
            self._sketch.move(*self.sight(event))
        elif event.type == "LEFTMOUSE" and pressed:
            if not self.is_inside(event):
                return {"PASS_THROUGH"}
            # A report would be shown at the end only.
            self._missed = not self._sketch.press(*self.sight(event))
        elif event.type == "LEFTMOUSE" and event.value == "RELEASE" and self._sketch.dragging:
            self._sketch.move(*self.sight(event))
            self._sketch.release()
        elif self.is_of_view(event):
            return {"PASS_THROUGH"}
        self._tell(context)
        return {"RUNNING_MODAL"}

    def _tell(self, context):
        current = self._sketch.current()
        size = f"{current[1].width:.3g} × {current[1].height:.3g}" if current else f"{len(self._sketch.done)} drawn"
        kind = "wanted" if self._sketch.target else "not wanted"
        missed = "There is no labelled face here: Esc, and label the face in step 1. " if self._missed else ""
        context.workspace.status_text_set(
            f"{missed}{size}, {kind} — drag across a face; "
            "N: wanted or not, Backspace: take back, Enter: done, Esc: cancel"
        )

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "label")
        for one in self.rectangles:
            layout.prop(one, "target")


def register():
    """Register the operator and what it keeps of a rectangle."""
    bpy.utils.register_class(GEOANALOGY_PG_corners)
    bpy.utils.register_class(GEOANALOGY_OT_draw_rectangles)


def unregister():
    """Unregister them."""
    bpy.utils.unregister_class(GEOANALOGY_OT_draw_rectangles)
    bpy.utils.unregister_class(GEOANALOGY_PG_corners)
