"""Lines and filled outlines drawn over all 3D views."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import bpy
import gpu
from gpu_extras.batch import batch_for_shader
from mathutils import Vector
from mathutils.geometry import tessellate_polygon

#: Width of lines in pixels.
LINE = 2.5

#: Opacity of what outlines enclose.
FILL = 0.15


@dataclass(frozen=True)
class Shape:
    """Something to draw.

    Attributes
    ----------
    points : sequence of (float, float, float)
        World coordinates.
    colour : tuple of four float
    closed : bool
        Whether it is an outline, which is filled.
    """

    points: Sequence[Sequence[float]]
    colour: tuple[float, ...]
    closed: bool = False


class Overlay:
    """Shapes, shown in all 3D views until they are removed.

    Parameters
    ----------
    shapes : callable () -> iterable of Shape
        Asked whenever a view is drawn.
    """

    def __init__(self, shapes: Callable[[], Iterable[Shape]]) -> None:
        self._shapes = shapes
        self._handle = bpy.types.SpaceView3D.draw_handler_add(self._draw, (), "WINDOW", "POST_VIEW")

    def remove(self) -> None:
        """Show them no longer."""
        bpy.types.SpaceView3D.draw_handler_remove(self._handle, "WINDOW")

    def _draw(self) -> None:
        gpu.state.blend_set("ALPHA")
        for shape in self._shapes():
            points = [tuple(map(float, point)) for point in shape.points]
            if shape.closed:
                _fill(points, (*shape.colour[:3], FILL))
            _line([*points, points[0]] if shape.closed else points, shape.colour)
        gpu.state.blend_set("NONE")


def _line(points: Sequence[Sequence[float]], colour: tuple[float, ...]) -> None:
    shader = gpu.shader.from_builtin("POLYLINE_UNIFORM_COLOR")
    batch = batch_for_shader(shader, "LINE_STRIP", {"pos": points})
    shader.bind()
    shader.uniform_float("viewportSize", gpu.state.viewport_get()[2:])
    shader.uniform_float("lineWidth", LINE)
    shader.uniform_float("color", colour)
    batch.draw(shader)


def _fill(points: Sequence[Sequence[float]], colour: tuple[float, ...]) -> None:
    shader = gpu.shader.from_builtin("UNIFORM_COLOR")
    triangles = tessellate_polygon([[Vector(point) for point in points]])
    batch = batch_for_shader(shader, "TRIS", {"pos": points}, indices=triangles)
    shader.bind()
    shader.uniform_float("color", colour)
    batch.draw(shader)
