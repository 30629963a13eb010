"""What a part of a wall or a worktop is: something of a width and a height that is fixed to a surface."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache

from .solids import Solid, joined

Builder = Callable[[float, float], Sequence[Solid]]


@dataclass(frozen=True)
class Part:
    """One part.

    Attributes
    ----------
    name, label : str
    size : (float, float)
        Width and height in metres.
    build : callable
        Makes the solid; called once, through :meth:`solid`.
    """

    name: str
    label: str
    size: tuple[float, float]
    build: Builder

    def solid(self) -> Solid:
        """The geometry."""
        return _built(self)


@cache
def _built(part: Part) -> Solid:
    return joined(part.build(*part.size))


def entering(register: dict[str, Part]) -> Callable[..., Callable[[Builder], Builder]]:
    """The decorator that enters builders into a register.

    Parameters
    ----------
    register : dict of str to Part

    Returns
    -------
    callable
        (name, width, height, label) -> decorator; the label is the name where none is given.
    """

    def part(name: str, width: float, height: float, label: str | None = None) -> Callable[[Builder], Builder]:
        def enter(build: Builder) -> Builder:
            register[name] = Part(name, label or name, (width, height), build)
            return build

        return enter

    return part
