"""Versions: of the libraries that run, and what differs between Blenders."""

from functools import cache

import bpy
import numpy
import scipy
import shapely


@cache
def library_versions() -> tuple[tuple[str, str], ...]:
    """The versions of the libraries in use: another extension may have brought them.

    Returns
    -------
    tuple of (str, str)
        Name and version.
    """
    return tuple((module.__name__, module.__version__) for module in (numpy, scipy, shapely))


def grease_pencils() -> bpy.types.bpy_prop_collection:
    """The file's grease pencils of the present kind.

    Returns
    -------
    bpy.types.bpy_prop_collection
        Blender 4.5 has the former kind under that name.
    """
    return bpy.data.grease_pencils if bpy.app.version >= (5, 0, 0) else bpy.data.grease_pencils_v3
