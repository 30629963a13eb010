"""What a unit of a scene is: defaults are metres, and as large in a scene that is built in centimetres."""

import bpy


def in_scene_units(scene: bpy.types.Scene, metres: float, power: int = 1) -> float:
    """A length in units of a scene.

    Parameters
    ----------
    scene : bpy.types.Scene
    metres : float
        Metres, or a power of them.
    power : int
        1 for lengths, -2 for densities per area.

    Returns
    -------
    float
    """
    return metres / float(scene.unit_settings.scale_length) ** power
