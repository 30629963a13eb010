"""The library of assets: furniture, garden, crown.

Everything but :mod:`.meshes` and :mod:`.materials` imports without Blender, so that names, labels, footprints and
geometry can be used by engine tests.
"""

from . import bathroom, bedroom, flowers, garden, gems, hall, kitchen, living, openings, trees
from .assets import ASSETS, Asset

__all__ = [
    "ASSETS",
    "Asset",
    "bathroom",
    "bedroom",
    "flowers",
    "garden",
    "gems",
    "hall",
    "kitchen",
    "living",
    "openings",
    "trees",
]
