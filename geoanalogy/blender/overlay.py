"""Outlines drawn over the 3D view while an operator runs."""

from collections.abc import Iterable

import bpy
import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader
from numpy.typing import NDArray

from .rectangle_drawing import Sketch

#: Colours of what is wanted, and of what is not.
WANTED, UNWANTED = (0.25, 0.8, 0.45, 1.0), (0.95, 0.35, 0.25, 1.0)

#: Width of lines in pixels.
LINE = 2.5


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
            _draw_ring(corners, target)
        current = self._sketch.current()
        if current is not None:
            _draw_ring(current[0], self._sketch.target)


def _draw_ring(corners: NDArray[np.float64], target: float) -> None:
    colour = tuple(target * a + (1.0 - target) * b for a, b in zip(WANTED, UNWANTED, strict=True))
    points = [tuple(map(float, p)) for p in (*corners, corners[0])]
    gpu.state.blend_set("ALPHA")
    _fill(points[:4], (*colour[:3], 0.15))
    shader = gpu.shader.from_builtin("POLYLINE_UNIFORM_COLOR")
    batch = batch_for_shader(shader, "LINE_STRIP", {"pos": points})
    shader.bind()
    shader.uniform_float("viewportSize", gpu.state.viewport_get()[2:])
    shader.uniform_float("lineWidth", LINE)
    shader.uniform_float("color", colour)
    batch.draw(shader)
    gpu.state.blend_set("NONE")


def _fill(points: Iterable[tuple[float, ...]], colour: tuple[float, ...]) -> None:
    shader = gpu.shader.from_builtin("UNIFORM_COLOR")
    batch = batch_for_shader(shader, "TRIS", {"pos": list(points)}, indices=[(0, 1, 2), (0, 2, 3)])
    shader.bind()
    shader.uniform_float("color", colour)
    batch.draw(shader)
