"""The bridge between the engine and Blender: the only package of the engine that knows Blender.

Its modules are imported by `register()`, so that reading this file asks for no Blender.

Reading order: `names`; `planes`, `shapes` and `ground`, from objects to scenes; `footprints`; `tree_types`,
`tree_store`, `tree_writing` and `tree_editing`, the operations tree in the .blend; `evaluating`, `sites`, `lessons` and
`recording`, from an example to its results; `instances`, which shows them; `refresh` and `corrections`, which sift
them; `replay`. `building` records what makes solids, `whole` evaluates trees that have such nodes, `masses` shows them.
`buildings` writes what a stored tree has built, by `shading` and `outdoors`.
"""

from .registration import register_in_order, unregister_in_order

MODULES = (".command", ".properties", ".tree_types", ".tree_links", ".showing", ".handlers")


def register():
    """Register the bridge's modules, in the order of `MODULES`."""
    register_in_order(__package__, MODULES)


def unregister():
    """Unregister them, last first."""
    unregister_in_order(__package__, MODULES)
