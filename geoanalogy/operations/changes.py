"""Changes of a solid: what is merged into it or subtracted from it, as a record that branches can join."""

from collections.abc import Iterable
from dataclasses import dataclass

from ..errors import InputError
from ..geometry.boolean import Kind, combined, is_square
from ..geometry.cutting import with_openings
from ..geometry.frame import SPACE, Frame
from ..geometry.memory import Memory
from ..geometry.solid import Solid

Standing = tuple[Solid, Frame]


@dataclass(frozen=True)
class Change:
    """One boolean of a solid with those that stand on its surfaces, or beside it.

    Attributes
    ----------
    node : str
        Id of the node that did it.
    kind : str
        "merge" or "subtract".
    groups : tuple of (str, tuple of (Solid, Frame))
        Name of the face that they stand on, "" where they stand beside it; and with each the frame that it stands in,
        in the coordinates of the solid.
    """

    node: str
    kind: Kind
    groups: tuple[tuple[str, tuple[Standing, ...]], ...]

    def applied(self, solid: Solid) -> Solid:
        """The solid after the change.

        Parameters
        ----------
        solid : Solid

        Returns
        -------
        Solid

        Raises
        ------
        InputError
            Where a face is no longer there, and what `combined` raises.
        """
        waiting: dict[Frame, list[Standing]] = {}
        for name, parts in self.groups:
            frame, rest = SPACE, list(parts)
            if name:
                if name not in solid.by_name:
                    raise InputError("its surface is no longer there")
                face = solid.by_name[name]
                solid = solid.with_domain(face)
                frame = solid.faces[face].frame
                if self.kind == "subtract":
                    solid, rest = with_openings(solid, face, rest)
            # All planes that are square to the solid's axes share a grid.
            waiting.setdefault(SPACE if is_square(frame) else frame, []).extend(rest)
        for frame, parts_there in waiting.items():
            if parts_there:
                solid = combined(solid, parts_there, self.kind, frame)
        return solid


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
