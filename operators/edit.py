"""What all operators share: errors are reported, and long work is done in slices that Esc can stop between."""

from collections.abc import Generator, Mapping
from pathlib import Path

import bpy
from bpy.props import StringProperty
from bpy_extras.io_utils import ImportHelper

from ..geoanalogy.blender.jobs import Job, at_work
from ..geoanalogy.blender.tree.store import recorded_nodes, tree_of
from ..geoanalogy.blender.units import in_scene_units
from ..geoanalogy.errors import InputError
from ..geoanalogy.progress import run


class Edit:
    """An operator that changes the scene at once."""

    bl_options = {"REGISTER", "UNDO"}

    def edit(self, context: bpy.types.Context) -> str:
        """Do it, and return what to tell the user; an InputError leaves the scene as it was."""
        raise NotImplementedError

    def execute(self, context):
        try:
            self.report({"INFO"}, self.edit(context))
        except InputError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


class AsksForLabel:
    """An operator that asks for a label first; whoever clicks it can type at once."""

    #: What else it asks for.
    asked: tuple[str, ...] = ()

    def invoke(self, context, event):
        return context.window_manager.invoke_props_dialog(self)

    def draw(self, context):
        # Of a split property, Blender would not activate the field.
        row = self.layout.row()
        row.activate_init = True
        row.prop(self, "label")
        for name in self.asked:
            self.layout.prop(self, name)


class FileImport(Edit, ImportHelper):
    """An operator that reads a file: one that is dropped onto a view, else one that is chosen in the file browser."""

    # The path of the last time would count as one that has been dropped.
    filepath: StringProperty(
        name="File", description="The file to read", subtype="FILE_PATH", options={"HIDDEN", "SKIP_SAVE"}
    )

    def invoke(self, context, event):
        if self.properties.is_property_set("filepath"):
            return self.execute(context)
        return super().invoke(context, event)


class LongEdit:
    """An operator that works for a while: modal in a window, at once in the background and in scripts."""

    bl_options = {"REGISTER", "UNDO"}

    #: Options whose defaults are metres, or powers of them: they are as large where a scene unit is something else.
    in_metres: Mapping[str, int] = {}

    def steps(self, context: bpy.types.Context) -> Generator[tuple[float, str], None, str]:
        """The work as a stepper, which returns what to tell the user and writes nothing before its last step."""
        raise NotImplementedError

    def execute(self, context):
        try:
            self.report({"INFO"}, run(self.steps(context)))
        except InputError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}

    def invoke(self, context, event):
        for name, power in self.in_metres.items():
            if not self.properties.is_property_set(name):
                setattr(self, name, in_scene_units(context.scene, getattr(self, name), power))
        if bpy.app.background or context.window is None:
            return self.execute(context)
        self._job = Job(self.steps(context))
        self._timer = context.window_manager.event_timer_add(0.01, window=context.window)
        context.window_manager.progress_begin(0.0, 1.0)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC" and event.value == "PRESS":
            self._job.cancel()
            self._end(context)
            self.report({"INFO"}, "Cancelled; nothing has changed")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"RUNNING_MODAL"}
        try:
            self._job.advance()
        except InputError as error:
            self._end(context)
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        except Exception:
            self._end(context)
            raise
        if self._job.finished:
            self._end(context)
            self.report({"INFO"}, self._job.result)
            return {"FINISHED"}
        context.window_manager.progress_update(self._job.fraction)
        context.workspace.status_text_set(f"{self._job.text} — {round(100 * self._job.fraction)} %, Esc cancels")
        return {"RUNNING_MODAL"}

    def cancel(self, context):
        """Stop where Blender closes the window or opens another file."""
        self._job.cancel()
        self._end(context)

    def _end(self, context):
        context.window_manager.event_timer_remove(self._timer)
        context.window_manager.progress_end()
        context.workspace.status_text_set(None)
        for area in context.screen.areas if context.screen else ():
            area.tag_redraw()


def chosen_file(filepath: str) -> Path:
    """The file that was chosen in the file browser, which may be left without choosing any."""
    path = Path(bpy.path.abspath(filepath))
    if not filepath or path.is_dir():
        raise InputError("no file is chosen; click one in the file browser")
    return path


def needs_object_mode(cls: type, context: bpy.types.Context) -> bool:
    """Whether the scene can be edited; where not, the operator says why."""
    if context.mode != "OBJECT":
        cls.poll_message_set("Leave to Object Mode first")
        return False
    if at_work():
        cls.poll_message_set("Something is being worked on: wait for it, or stop it with Esc in its window")
        return False
    return True


def needs_active_object(cls: type, context: bpy.types.Context) -> bool:
    """Whether an object is active; where not, the operator says so."""
    if not needs_object_mode(cls, context):
        return False
    if context.active_object is None:
        cls.poll_message_set("Click an object first")
        return False
    return True


def needs_operations(cls: type, context: bpy.types.Context) -> bool:
    """Whether the scene has operations; where not, the operator says so."""
    if not needs_object_mode(cls, context):
        return False
    if not recorded_nodes(tree_of(context.scene)):
        cls.poll_message_set("There are no operations yet: propagate an object first")
        return False
    return True


def active_operation(context: bpy.types.Context, name: str = "") -> bpy.types.Node:
    """The operation of a name; without one, that which is active in the list."""
    tree = tree_of(context.scene)
    nodes = recorded_nodes(tree)
    if name:
        if tree is None or tree.nodes.get(name) not in nodes:
            raise InputError(f"there is no operation {name!r}; click one in the list of step 5")
        return tree.nodes[name]
    active = tree.nodes.active if tree else None
    if active is None or active not in nodes:
        raise InputError("no operation is active; click one in the list of step 5")
    return active


def selected_active(context: bpy.types.Context) -> bpy.types.Object | None:
    """The active object, where it is selected too."""
    active = context.active_object
    return active if active is not None and active.select_get() else None
