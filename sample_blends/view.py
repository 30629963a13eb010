"""Draw what another camera of a .blend sees: ``python -m sample_blends.view FILE.blend CAMERA PICTURE.png``."""

from __future__ import annotations

import sys
from pathlib import Path

import bpy

from geoanalogy.blender.writing.picture import draw_picture


def main() -> int:
    blend, camera, picture = sys.argv[-3:]
    bpy.ops.wm.open_mainfile(filepath=str(Path(blend).resolve()))
    scene = bpy.context.scene
    scene.camera = scene.objects[camera]
    draw_picture(scene, Path(picture))
    return 0


if __name__ == "__main__":
    sys.exit(main())
