"""Drawing with the mouse in a 3D view: what all operators that do it have in common."""

from bpy_extras.view3d_utils import region_2d_to_origin_3d, region_2d_to_vector_3d

from .edit import Edit

#: Events that turn and move the view.
VIEW_EVENTS = {"MIDDLEMOUSE", "WHEELUPMOUSE", "WHEELDOWNMOUSE", "TRACKPADPAN", "TRACKPADZOOM", "MOUSEROTATE"}

#: Events that end drawing.
DONE_EVENTS = {"RET", "NUMPAD_ENTER", "SPACE", "RIGHTMOUSE"}

#: Where the window takes long to draw, all but the last place of the mouse come as moves in between.
MOVES = {"MOUSEMOVE", "INBETWEEN_MOUSEMOVE"}


class ViewDrawing(Edit):
    """An operator whose input is drawn in a 3D view, and which then does its edit at once."""

    def begin(self, context, overlay, cursor):
        """Follow the mouse in the view from now on, with an overlay that is shown until the end."""
        self._area = context.area
        self._place = context.area.as_pointer()
        self._region = next(region for region in context.area.regions if region.type == "WINDOW")
        self._overlay = overlay
        context.window.cursor_modal_set(cursor)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def end(self, context):
        """Leave the view as it was."""
        self._overlay.remove()
        if context.window is not None:
            context.window.cursor_modal_restore()
        if context.workspace is not None:
            context.workspace.status_text_set(None)
        if self.is_shown(context):
            self._area.tag_redraw()

    def cancel(self, context):
        """End where Blender closes the window or opens another file."""
        self.end(context)

    def is_shown(self, context):
        """Whether the view is still there: its area may be closed, and another workspace may be chosen."""
        areas = context.screen.areas if context.screen is not None else ()
        return self._place in [area.as_pointer() for area in areas]

    def cancelled(self, context):
        """End without an edit."""
        self.end(context)
        self.report({"INFO"}, "Cancelled; nothing has changed")
        return {"CANCELLED"}

    def is_inside(self, event):
        """Whether the mouse is over the view, and over none of its sidebars."""
        x, y = event.mouse_x - self._region.x, event.mouse_y - self._region.y
        over = any(
            r.x <= event.mouse_x < r.x + r.width and r.y <= event.mouse_y < r.y + r.height
            for r in self._area.regions
            if r != self._region and r.width > 1 and r.height > 1
        )
        return 0 <= x < self._region.width and 0 <= y < self._region.height and not over

    def is_of_view(self, event):
        """Whether an event is the view's or another area's, and not for drawing."""
        return event.type in VIEW_EVENTS or event.type.startswith("NUMPAD_") or not self.is_inside(event)

    def sight(self, event, aside=0):
        """The line of sight under the mouse, or some pixels beside it: a point and a direction."""
        at = event.mouse_x - self._region.x + aside, event.mouse_y - self._region.y
        view = self._area.spaces.active.region_3d
        return region_2d_to_origin_3d(self._region, view, at), region_2d_to_vector_3d(self._region, view, at)
