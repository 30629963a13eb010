"""The bridge between the engine and Blender: the only package of the engine that knows Blender.

Its modules are imported by `register()`, so that reading this file asks for no Blender.
"""

from .registration import register_in_order, unregister_in_order

MODULES = (".command",)


def register():
    """Register the bridge's modules, in the order of `MODULES`."""
    register_in_order(__package__, MODULES)


def unregister():
    """Unregister them, last first."""
    unregister_in_order(__package__, MODULES)
