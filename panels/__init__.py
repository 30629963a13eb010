"""The panels of the sidebar: each draws what is already there."""

from ..geoanalogy.blender.registration import register_in_order, unregister_in_order

MODULES = (
    ".plan",
    ".example",
    ".propagation",
    ".placement",
    ".building",
    ".results",
    ".operations",
    ".drawings",
    ".diagnostics",
    ".node_editor",
    ".menu",
    ".dropped_files",
)


def register():
    """Register the panels, in the order of `MODULES`."""
    register_in_order(__package__, MODULES)


def unregister():
    """Unregister them, last first."""
    unregister_in_order(__package__, MODULES)
