"""Local views: a 3D view that is restricted to some objects shows the results of those that it shows, too."""

from collections.abc import Sequence

import bpy


def show_locally(made: Sequence[bpy.types.Object], examples: Sequence[bpy.types.Object]) -> None:
    """Show objects in every local view that shows one of others.

    Parameters
    ----------
    made : sequence of bpy.types.Object
        What a window's view layer lacks is left out.
    examples : sequence of bpy.types.Object
    """
    for window in bpy.context.window_manager.windows:
        spaces = [area.spaces.active for area in window.screen.areas if area.type == "VIEW_3D"]
        for space in spaces:
            if space.local_view is None or not any(i.local_view_get(space) for i in _in(window.view_layer, examples)):
                continue
            for item in _in(window.view_layer, made):
                item.local_view_set(space, True)


def _in(layer: bpy.types.ViewLayer, items: Sequence[bpy.types.Object]) -> list[bpy.types.Object]:
    """Those of some objects that are in a view layer, and not only others of their names."""
    # What has just been linked is in the layer once anything asks for what is active; looking it up does not.
    objects = layer.objects
    _ = objects.active
    return [item for item in items if objects.get(item.name) == item]
