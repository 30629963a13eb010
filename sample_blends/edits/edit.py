"""One edit by hand and its propagation."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class Edit:
    """An asset put at a pose, to be propagated.

    Attributes
    ----------
    asset : str
        Name in the library.
    position : (float, float)
        Of the asset's origin, metres.
    angle : float
        Of the asset's +X, degrees counter-clockwise.
    most : int or None
        Most of them in one parent, the example counted.
    threshold : float
        Results below this importance are not placed.
    options : mapping
        Settings of :class:`geoanalogy.PoseOptions`.
    """

    asset: str
    position: tuple[float, float]
    angle: float
    most: int | None = None
    threshold: float = 0.3
    options: Mapping[str, Any] = field(default_factory=dict)
