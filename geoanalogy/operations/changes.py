"""Changes of a solid: what is merged into it or subtracted from it, as a record that branches can join."""

from collections.abc import Iterable
from dataclasses import dataclass

from ..geometry.boolean import Kind, combined
from ..geometry.cutting import with_openings
from ..geometry.frame import Frame
from ..geometry.memory import Memory
from ..geometry.solid import Solid


@dataclass(frozen=True)
class Change:
    """One boolean of a solid with those that stand on one of its surfaces, or beside it.

    Attributes
    ----------
    node : str
        Id of the node that did it.
    kind : str
        "merge" or "subtract".
    face : str
        Name of the face that they stand on; "" where they stand beside it.
    parts : tuple of (Solid, Frame)
        With the frame that each stands in, in the coordinates of the solid.
    """

    node: str
    kind: Kind
    face: str
    parts: tuple[tuple[Solid, Frame], ...]

    def applied(self, solid: Solid) -> Solid:
        """The solid after the change.

        Parameters
        ----------
        solid : Solid

        Returns
        -------
        Solid
        """
        if not self.face:
            return combined(solid, self.parts, self.kind)
        kept = solid.with_domains()
        index = kept.by_name[self.face]
        rest = list(self.parts)
        if self.kind == "subtract":
            kept, rest = with_openings(kept, index, rest)
        return combined(kept, rest, self.kind, kept.faces[index].frame) if rest else kept


def changed(base: Solid, changes: Iterable[Change], memory: Memory) -> Solid:
    """A solid after changes.

    Parameters
    ----------
    base : Solid
    changes : iterable of Change
    memory : Memory
        Where what has been computed is kept.

    Returns
    -------
    Solid
    """
    solid = base
    for change in changes:
        before = solid
        solid = memory.recall(("change", before, change), lambda b=before, c=change: c.applied(b))  # type: ignore[misc]
    return solid


def joined(one: tuple[Change, ...], other: tuple[Change, ...]) -> tuple[Change, ...]:
    """The changes that two branches have made, each once; those they share come first.

    Parameters
    ----------
    one, other : tuple of Change

    Returns
    -------
    tuple of Change
    """
    return (*one, *(change for change in other if change not in one))
