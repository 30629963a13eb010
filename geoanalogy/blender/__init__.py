"""The bridge between the engine and Blender: the only package of the engine that knows Blender.

Its modules are imported by `register()`, so that reading this file asks for no Blender.

Reading order: `names`; `reading`, from objects to scenes (`planes`, `shapes`, `ground`, `footprints`); `tree`, the
operations tree in the .blend (`node_tree`, `store`, `editing`), from an example to its results (`evaluating`, `sites`,
`lessons`, `recording`), sifting them (`refresh`, `corrections`), `replay`, and trees that make solids (`building`,
`whole`); `writing`, what is made of results (`instances`, `masses`) and of what a stored tree has built (`buildings`);
`regions`, the same from drawings for chapter 3.
"""

from .registration import register_in_order, unregister_in_order

MODULES = (
    ".command",
    ".regions.settings",
    ".properties",
    ".tree.node_tree",
    ".tree.links",
    ".tree.renaming",
    ".tree.showing",
    ".unfamiliar_faces",
    ".handlers",
)


def register():
    """Register the bridge's modules, in the order of `MODULES`."""
    register_in_order(__package__, MODULES)


def unregister():
    """Unregister them, last first."""
    unregister_in_order(__package__, MODULES)
