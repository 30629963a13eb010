"""Selecting what was made, and again the results that were selected before they were written anew."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import bpy

from .. import names


@dataclass(frozen=True)
class Selection:
    """The results of one operation that are selected in the view layer that is shown.

    Attributes
    ----------
    keys : frozenset of str
    active : str or None
        The key of the active one.
    """

    keys: frozenset[str]
    active: str | None

    @classmethod
    def of(cls, items: Iterable[bpy.types.Object]) -> "Selection":
        """What is selected now.

        Parameters
        ----------
        items : iterable of bpy.types.Object
            Results of one operation.

        Returns
        -------
        Selection
        """
        items = list(items)
        active = bpy.context.view_layer.objects.active
        keys = frozenset(item[names.KEY] for item in items if item.select_get())
        return cls(keys, active[names.KEY] if active in items else None)

    def restore(self, items: Iterable[bpy.types.Object]) -> None:
        """Select results of these keys, and make the one active that was.

        Parameters
        ----------
        items : iterable of bpy.types.Object
            Results of the same operation.
        """
        if not self.keys and self.active is None:
            return
        for item in items:
            # Children carry the key of the result that they belong to.
            if item.parent is None and _is_shown(item):
                if item[names.KEY] in self.keys:
                    item.select_set(True)
                if item[names.KEY] == self.active:
                    bpy.context.view_layer.objects.active = item


def select_only(items: Sequence[bpy.types.Object]) -> None:
    """Select objects and nothing else, the last one active, in the view layer that is shown.

    Parameters
    ----------
    items : sequence of bpy.types.Object
        Those that are excluded from the view layer are left out.
    """
    for other in bpy.context.selected_objects:
        other.select_set(False)
    for item in filter(_is_shown, items):
        item.select_set(True)
        bpy.context.view_layer.objects.active = item


def _is_shown(item: bpy.types.Object) -> bool:
    """Whether an object can be selected: it is in the view layer, and not only another one of its name."""
    # What has just been linked is in the layer once anything asks for selections; looking it up by name does not.
    item.select_get()
    return bpy.context.view_layer.objects.get(item.name) == item
