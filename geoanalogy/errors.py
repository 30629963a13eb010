"""The two exceptions of the engine."""


class InputError(ValueError):
    """What the user gave cannot be used.

    The message is one sentence that names the thing (file, feature, polygon) and the remedy. Blender operators report
    it unchanged; the batch program prints it and exits with the code for bad input.
    """


class Cancelled(Exception):
    """Long work was stopped by its progress callback; nothing has been changed."""
