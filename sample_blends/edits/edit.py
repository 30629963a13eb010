"""Edits by hand and how they are propagated: one class per kind of operation."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

Place = tuple[float, float, float]
"""x and y of an asset's origin in metres, and the angle of its +X in degrees counter-clockwise."""


@dataclass(frozen=True)
class Edit:
    """An asset put at a place, to be propagated.

    Attributes
    ----------
    asset : str
        Name in the library.
    place : (float, float, float)
        x and y in metres, direction in degrees.
    most : int or None
        Most of them in one parent, the example counted.
    threshold : float
        Results below this importance are not placed.
    options : mapping
        Settings of :class:`geoanalogy.PoseOptions`.
    """

    asset: str
    place: Place
    most: int | None = None
    threshold: float = 0.3
    options: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class ArrayEdit:
    """A row of an asset along the boundary of the polygon that is nearest to its start.

    Attributes
    ----------
    asset : str
    place : (float, float, float)
        Of the first one.
    end : (float, float, float) or None
        Of the last one; None: the row runs all round.
    spacing : float
        Metres along the row.
    options : mapping
        Settings of :class:`geoanalogy.PoseOptions`, for start and end.
    array : mapping
        Settings of the array.
    threshold : float
        Rows below this importance are not placed.
    """

    asset: str
    place: Place
    end: Place | None
    spacing: float
    options: Mapping[str, Any] = field(default_factory=dict)
    array: Mapping[str, Any] = field(default_factory=dict)
    threshold: float = 0.45


@dataclass(frozen=True)
class ScatterEdit:
    """An asset put at a place, of which others are drawn at random like it.

    Attributes
    ----------
    asset : str
    place : (float, float, float)
    scatter : mapping
        Settings of the scatter.
    seed : int
    options : mapping
        Settings of :class:`geoanalogy.PoseOptions`.
    """

    asset: str
    place: Place
    scatter: Mapping[str, Any]
    seed: int = 0
    options: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class GroupEdit:
    """All decorations of one polygon, taken to the others of its label in local coordinates.

    Attributes
    ----------
    items : tuple of (str, Place)
        Assets and their places, all in the polygon that is smallest about the first.
    transfer : mapping
        Settings of the transfer.
    """

    items: tuple[tuple[str, Place], ...]
    transfer: Mapping[str, Any] = field(default_factory=dict)


FacadeBox = tuple[str, float, float, float, float]
"""A facade, and the least and greatest x and y of a box on it, in the facade's own coordinates."""


@dataclass(frozen=True)
class PlacementEdit:
    """A part put into a few boxes on facades, to be learned from.

    Attributes
    ----------
    part : str
        Name in the library of facades.
    wanted : tuple of FacadeBox
        Examples of where it belongs. Where the part is repeated, they are drawn and it stands aside; else it stands in
        each.
    fit : (str, str)
        "scale" or "repeat", along and across.
    gap : (float, float)
        Least distance between repeated parts.
    threshold : float
    most : int or None
        Most placements in one parent, the examples counted.
    options : mapping
        Settings of :class:`geoanalogy.PlacementOptions`.
    """

    part: str
    wanted: tuple[FacadeBox, ...]
    fit: tuple[str, str] = ("scale", "scale")
    gap: tuple[float, float] = (0.0, 0.0)
    threshold: float = 0.5
    most: int | None = None
    options: Mapping[str, Any] = field(default_factory=dict)


AnyEdit = Edit | ArrayEdit | ScatterEdit | GroupEdit | PlacementEdit
