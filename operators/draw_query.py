"""Draw the query with the mouse: a lasso round a region, a brush over it, a stroke along a thin shape."""

import bpy
from bpy.props import BoolProperty, CollectionProperty, EnumProperty, FloatProperty, FloatVectorProperty, StringProperty

from ..geoanalogy.blender.overlay import Overlay
from ..geoanalogy.blender.regions.drawings import read_drawn_lines
from ..geoanalogy.blender.regions.queries import add_query
from ..geoanalogy.blender.regions.sketch import QuerySketch
from ..geoanalogy.errors import InputError
from .edit import needs_object_mode
from .view_drawing import DONE_EVENTS, MOVES, ViewDrawing

MODES = [
    ("LASSO", "Lasso", "Drag round the region", "BORDERMOVE", 0),
    ("BRUSH", "Brush", "Paint over the region, in as many strokes as need be; Enter when it is done", "BRUSH_DATA", 1),
    ("STROKE", "Stroke", "Drag along a thin shape: a coral, a stalk", "GREASEPENCIL", 2),
]

HELP = {
    "LASSO": "drag round the region",
    "BRUSH": "paint over the region; [ and ]: size, Backspace: take back, Enter: done",
    "STROKE": "drag along the shape",
}


class GEOANALOGY_PG_query_point(bpy.types.PropertyGroup):
    """A point of a query."""

    co: FloatVectorProperty(name="Point", subtype="TRANSLATION")
    first: BoolProperty(name="First", description="Whether a stroke of the brush begins here")


class GEOANALOGY_OT_draw_query(ViewDrawing, bpy.types.Operator):
    """Outline the region of the drawing that is to be found elsewhere"""

    bl_idname = "geoanalogy.draw_query"
    bl_label = "Draw Query"

    mode: EnumProperty(name="Tool", items=MODES)
    points: CollectionProperty(name="Points", type=GEOANALOGY_PG_query_point)
    radius: FloatProperty(name="Radius", description="Of the brush", min=0.0, subtype="DISTANCE")
    name: StringProperty(name="Name", description="Of the query and its operation; empty: query")

    @classmethod
    def poll(cls, context):
        return needs_object_mode(cls, context)

    @classmethod
    def description(cls, context, properties):
        return next(text for key, _, text, *_ in MODES if key == properties.mode)

    def edit(self, context):
        """Make the query."""
        strokes = []
        for point in self.points:
            if point.first or not strokes:
                strokes.append([])
            strokes[-1].append(tuple(point.co))
        if self.mode == "BRUSH" and not self.radius:
            raise InputError("the brush has no radius; give it one")
        radius = self.radius if self.mode == "BRUSH" else 0.0
        item = add_query(context, strokes, self.mode != "STROKE", radius, self.name)
        return f"Query {item.name!r}; find similar regions"

    def invoke(self, context, event):
        if context.area is None or context.area.type != "VIEW_3D":
            self.report({"ERROR"}, "queries are drawn in a 3D view; move the mouse over one")
            return {"CANCELLED"}
        try:
            self._sketch = QuerySketch(read_drawn_lines(context).plane, self.mode)
        except InputError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.points.clear()
        self._dragging = False
        context.workspace.status_text_set(f"{HELP[self.mode]} — Esc: cancel")
        return self.begin(context, Overlay(self._sketch.shapes), "PAINT_CROSS" if self.mode == "BRUSH" else "CROSSHAIR")

    def modal(self, context, event):
        if not self.is_shown(context):
            return self.cancelled(context)
        self._area.tag_redraw()
        pressed, settings = event.value == "PRESS", context.scene.geoanalogy
        if event.type == "ESC" and pressed:
            return self.cancelled(context)
        if event.type in DONE_EVENTS and pressed:
            return self._finish(context)
        if event.type in {"BACK_SPACE", "DEL"} and pressed:
            self._sketch.take_back()
        elif event.type in {"LEFT_BRACKET", "RIGHT_BRACKET"} and pressed:
            settings.brush = round(settings.brush * (1.2 if event.type == "RIGHT_BRACKET" else 1 / 1.2))
        elif event.type in MOVES and self._dragging:
            self._drag(context, event)
        elif event.type == "LEFTMOUSE" and pressed:
            point = self._point(event) if self.is_inside(event) else None
            if point is None:
                return {"PASS_THROUGH"}
            self._dragging = True
            beside = self._point(event, settings.brush)
            if beside is not None:
                self._sketch.radius = float(sum((a - b) ** 2 for a, b in zip(point, beside, strict=True)) ** 0.5)
            self._sketch.press(point)
        elif event.type == "LEFTMOUSE" and event.value == "RELEASE" and self._dragging:
            self._drag(context, event)
            self._dragging = False
            if self.mode != "BRUSH":
                return self._finish(context)
        elif self.is_of_view(event):
            return {"PASS_THROUGH"}
        return {"RUNNING_MODAL"}

    def _drag(self, context, event):
        point = self._point(event)
        if point is not None:
            self._sketch.move(point)

    def _finish(self, context):
        self.end(context)
        for stroke in self._sketch.strokes:
            for i, co in enumerate(stroke):
                point = self.points.add()
                point.co, point.first = co, i == 0
        self.radius = self._sketch.radius if self.mode == "BRUSH" else 0.0
        return self.execute(context)

    def _point(self, event, aside=0):
        """The point of the drawing's plane under the mouse, or some pixels beside it."""
        return self._sketch.sight(*self.sight(event, aside))

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "name")
        if self.mode == "BRUSH":
            layout.prop(self, "radius")


def register():
    """Register the operator and what it keeps of a point."""
    bpy.utils.register_class(GEOANALOGY_PG_query_point)
    bpy.utils.register_class(GEOANALOGY_OT_draw_query)


def unregister():
    """Unregister them."""
    bpy.utils.unregister_class(GEOANALOGY_OT_draw_query)
    bpy.utils.unregister_class(GEOANALOGY_PG_query_point)
