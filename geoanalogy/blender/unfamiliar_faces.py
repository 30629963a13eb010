"""The faces that are unlike the examples of the active operation, outlined in the 3D view while they are wanted."""

from collections.abc import Iterator

import bpy

from .overlay import Overlay, Shape
from .tree.learned import unfamiliar_of
from .tree.store import tree_of

#: Colours of these faces, and of the one that was clicked.
UNFAMILIAR, CLICKED = (0.95, 0.7, 0.2, 1.0), (1.0, 0.45, 0.1, 1.0)


def shapes() -> Iterator[Shape]:
    """What is to be drawn in the scene that is shown.

    Yields
    ------
    Shape
        Nothing where no placement is active, or its faces are not wanted.
    """
    settings = bpy.context.scene.geoanalogy
    tree = tree_of(bpy.context.scene)
    if settings.show_unfamiliar and tree is not None:
        for i, face in enumerate(unfamiliar_of(tree.nodes.active)):
            yield Shape(face.ring, CLICKED if i == settings.unfamiliar_index else UNFAMILIAR, closed=True)


#: What shows them: one, or none in the background.
_shown: list[Overlay] = []


def register():
    """Show them, where there is a window."""
    if not bpy.app.background:
        _shown.append(Overlay(shapes))


def unregister():
    """Show them no longer."""
    while _shown:
        _shown.pop().remove()
