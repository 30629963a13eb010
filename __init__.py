"""GeoAnalogy, the Blender extension: one edit, made wherever the surroundings are alike.

`geoanalogy/` is the engine, and its folder `blender/` the bridge between the engine and Blender's data; `operators/`
and `panels/` are what a user sees. Nothing is imported here before Blender calls `register()`, because test runners
import this file where there is no Blender.
"""

LAYERS = (".geoanalogy.blender", ".operators", ".panels")


def register():
    """Register the bridge, the operators and the panels, in this order."""
    from .geoanalogy.blender.registration import register_in_order

    register_in_order(__package__, LAYERS)


def unregister():
    """Unregister what `register()` registered, last first."""
    from .geoanalogy.blender.registration import unregister_in_order

    unregister_in_order(__package__, LAYERS)
