"""Write every asset and fitting as an object of its name, for ``batch.py apply --library``; needs Blender.

python -m sample_blends.library LIBRARY.blend
"""

from __future__ import annotations

import sys
from pathlib import Path

import bpy

from .. import stage
from . import ASSETS
from .fittings import FITTINGS
from .meshes import add_asset, add_solid


def main() -> int:
    scene = stage.clear()
    holder = stage.collection(scene, "Library")
    for asset in ASSETS.values():
        add_asset(asset, holder)
    for name, fitting in FITTINGS.items():
        add_solid(name, fitting.solid(), holder)["ga_label"] = fitting.label
    bpy.ops.wm.save_as_mainfile(filepath=str(Path(sys.argv[-1]).resolve()), compress=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
