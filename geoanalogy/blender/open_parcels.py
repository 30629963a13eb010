"""The parcels of the open file: what is labelled on its ground."""

import bpy

from ..formats.repair import sound_parcels
from ..geometry.scene import Scene
from . import register
from .reading.ground import read_grounds
from .reading.whereabouts import up_to_date


def open_parcels() -> tuple[Scene, list[str]]:
    """The parcels of the open file's scene, on the plane that holds most polygons.

    Returns
    -------
    Scene
    list of str
        What is wrong with those that are left out.

    Raises
    ------
    InputError
        Where nothing in the scene has a label.
    """
    if not hasattr(bpy.types.Scene, "geoanalogy"):
        register()
    grounds = read_grounds(bpy.context.scene, up_to_date(bpy.context))
    problems: list[str] = []
    largest = max(grounds, key=lambda ground: len(ground.scene))
    return sound_parcels("the open file", largest.scene, problems), problems
