"""Outlines drawn over the 3D view: of a sketch while an operator runs, of unfamiliar faces while they are wanted."""

from collections.abc import Sequence

import bpy
import gpu
from gpu_extras.batch import batch_for_shader
from mathutils import Vector
from mathutils.geometry import tessellate_polygon

from .rectangle_drawing import Sketch
from .tree.learned import unfamiliar_of
from .tree.store import tree_of

#: Colours of what is wanted, and of what is not.
WANTED, UNWANTED = (0.25, 0.8, 0.45, 1.0), (0.95, 0.35, 0.25, 1.0)

#: Colours of unfamiliar faces, and of the one that was clicked.
UNFAMILIAR, CLICKED = (0.95, 0.7, 0.2, 1.0), (1.0, 0.45, 0.1, 1.0)

#: Width of lines in pixels.
LINE = 2.5

#: Opacity of what lines enclose.
FILL = 0.15


class Overlay:
    """The outlines of a sketch, shown in all 3D views until it is removed.

    Parameters
    ----------
    sketch : Sketch
    """

    def __init__(self, sketch: Sketch) -> None:
        self._sketch = sketch
        self._handle = bpy.types.SpaceView3D.draw_handler_add(self._draw, (), "WINDOW", "POST_VIEW")

    def remove(self) -> None:
        """Show them no longer."""
        bpy.types.SpaceView3D.draw_handler_remove(self._handle, "WINDOW")

    def _draw(self) -> None:
        for corners, target in self._sketch.outlines:
            _draw_ring(corners.tolist(), _graded(target))
        current = self._sketch.current()
        if current is not None:
            _draw_ring(current[0].tolist(), _graded(self._sketch.target))


def _graded(target: float) -> tuple[float, ...]:
    """The colour of an example that is so much wanted."""
    return tuple(target * a + (1.0 - target) * b for a, b in zip(WANTED, UNWANTED, strict=True))


def _draw_unfamiliar() -> None:
    settings = bpy.context.scene.geoanalogy
    tree = tree_of(bpy.context.scene)
    if settings.show_unfamiliar and tree is not None:
        for i, face in enumerate(unfamiliar_of(tree.nodes.active)):
            _draw_ring(face.ring, CLICKED if i == settings.unfamiliar_index else UNFAMILIAR)


def _draw_ring(corners: Sequence[Sequence[float]], colour: tuple[float, ...]) -> None:
    gpu.state.blend_set("ALPHA")
    _fill(corners, (*colour[:3], FILL))
    shader = gpu.shader.from_builtin("POLYLINE_UNIFORM_COLOR")
    batch = batch_for_shader(shader, "LINE_STRIP", {"pos": [*corners, corners[0]]})
    shader.bind()
    shader.uniform_float("viewportSize", gpu.state.viewport_get()[2:])
    shader.uniform_float("lineWidth", LINE)
    shader.uniform_float("color", colour)
    batch.draw(shader)
    gpu.state.blend_set("NONE")


def _fill(corners: Sequence[Sequence[float]], colour: tuple[float, ...]) -> None:
    shader = gpu.shader.from_builtin("UNIFORM_COLOR")
    triangles = tessellate_polygon([[Vector(corner) for corner in corners]])
    batch = batch_for_shader(shader, "TRIS", {"pos": list(corners)}, indices=triangles)
    shader.bind()
    shader.uniform_float("color", colour)
    batch.draw(shader)


#: The handle of what is always drawn; Blender gives it back to nobody.
_always = []


def register():
    """Draw unfamiliar faces, where there is a window to draw in."""
    if not bpy.app.background:
        _always.append(bpy.types.SpaceView3D.draw_handler_add(_draw_unfamiliar, (), "WINDOW", "POST_VIEW"))


def unregister():
    """Draw them no longer."""
    while _always:
        bpy.types.SpaceView3D.draw_handler_remove(_always.pop(), "WINDOW")
