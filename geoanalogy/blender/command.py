"""The batch program as a command of Blender: ``blender -b FILE.blend --command geoanalogy replay …``.

Where the add-on is enabled, this needs no file beside it.
"""

import bpy

from ..command_line import main

_commands = []


def register():
    """Make the command known to Blender."""
    _commands.append(bpy.utils.register_cli_command("geoanalogy", main))


def unregister():
    """Take the command back."""
    bpy.utils.unregister_cli_command(_commands.pop())
