"""The operators: each reads the selection, calls the engine and writes the result."""

from ..geoanalogy.blender.registration import register_in_order, unregister_in_order

MODULES: tuple[str, ...] = ()


def register():
    """Register the operators, in the order of `MODULES`."""
    register_in_order(__package__, MODULES)


def unregister():
    """Unregister them, last first."""
    unregister_in_order(__package__, MODULES)
