"""GeoAnalogy's batch program, inside Blender or with the bpy module.

    blender -b FILE.blend --python batch.py -- replay --output OUT.blend --render OUT.png
    python batch.py replay FILE.blend --output OUT.blend --render OUT.png

Exit codes: 0 done, 1 internal error, 2 usage, 3 bad input, 4 cancelled, 5 a write failed. The commands themselves are
in geoanalogy/command_line.py.
"""

import importlib
import sys
from pathlib import Path

INSIDE_BLENDER = "bpy" in sys.modules
BAD_INPUT = 3


def command_line():
    """The program's module: that of the enabled add-on, else that beside this file.

    Inside Blender the enabled add-on comes first, because the types of its nodes are registered and its libraries are
    on the path; a second copy of the engine would know neither.
    """
    if INSIDE_BLENDER:
        import bpy

        for name in bpy.context.preferences.addons.keys():
            if name.startswith("bl_ext.") and name.endswith(".geoanalogy"):
                return importlib.import_module(f"{name}.geoanalogy.command_line")
    sys.path.insert(0, str(Path(__file__).resolve().parent))
    return importlib.import_module("geoanalogy.command_line")


def arguments():
    """What stands behind Blender's `--`, or behind this file's name where Python runs it."""
    if "--" in sys.argv:
        return sys.argv[sys.argv.index("--") + 1 :]
    return [] if INSIDE_BLENDER else sys.argv[1:]


if __name__ == "__main__":
    try:
        program = command_line()
    except ModuleNotFoundError as error:
        print(f"geoanalogy: the module {error.name} is missing: install it, or enable the add-on.", file=sys.stderr)
        sys.exit(BAD_INPUT)
    program.leave(program.main(arguments()))
