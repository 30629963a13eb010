"""Write the library objects of the maps into a .blend: ``python -m sample_blends.city.library FILE.blend``."""

from __future__ import annotations

import argparse
from pathlib import Path

import bpy

from ..library import trees  # noqa: F401
from ..library.assets import ASSETS
from ..library.meshes import add_asset

TREES = ("broad-leaved tree", "small tree")


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("output", type=Path)
    arguments = parser.parse_args()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    for name in TREES:
        add_asset(ASSETS[name], bpy.context.scene.collection).name = name
    bpy.ops.wm.save_as_mainfile(filepath=str(arguments.output.absolute()), copy=True, compress=True)


if __name__ == "__main__":
    main()
