"""What an asset is, and the register of all of them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np

from .solids import Solid


@dataclass(frozen=True)
class Asset:
    """One thing that can be placed.

    The local frame has its origin at the centre of the footprint on the floor, +X to the asset's front and +Z up;
    lengths are metres.

    Attributes
    ----------
    name, label : str
        Unique name, and what it counts as in relations ("bed" for both beds).
    family : str
        "furniture", "garden" or "crown".
    footprint : ndarray (n, 2)
        Ground outline in the local frame, counter-clockwise, without repeated last vertex.
    build : callable
        Makes the solid; called once, through :meth:`solid`.
    sharp_angle : float
        Edges bent by more degrees stay sharp when shaded; 0 shades every face flat, as facets are.
    """

    name: str
    label: str
    family: str
    footprint: np.ndarray
    build: Callable[[], Solid]
    sharp_angle: float = 35.0

    def solid(self) -> Solid:
        """The geometry."""
        return _built(self.name)


ASSETS: dict[str, Asset] = {}


@cache
def _built(name: str) -> Solid:
    return ASSETS[name].build()


def asset(
    name: str, family: str, footprint: np.ndarray, label: str | None = None, sharp_angle: float = 35.0
) -> Callable[[Callable[[], Solid]], Callable[[], Solid]]:
    """Enter the decorated builder into the register; the label is the name where none is given."""

    def enter(build: Callable[[], Solid]) -> Callable[[], Solid]:
        ASSETS[name] = Asset(name, label or name, family, np.asarray(footprint, dtype=float), build, sharp_angle)
        return build

    return enter
