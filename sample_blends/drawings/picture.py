"""A picture: its lines, and the edits that paint it; known truth says where each edit belongs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import shapely

import geoanalogy as ga
from geoanalogy.operations.region_transfer import region_of

from .lines import Array, Stroke, Warp

#: RGBA from points (n, 2): (n, 4), alpha not multiplied in.
Paint = Callable[[Array], Array]


@dataclass(frozen=True)
class Edit:
    """One region painted, for all that are like it.

    Attributes
    ----------
    name : str
    query : (n, 2)
        A ring round the region, or an open stroke along a thin shape.
    closed : bool
        Whether it is a ring.
    paint : callable
        Colour and alpha by points of the drawing, in the query.
    truth : list of callable
        For every place where it belongs, the map from the query to it.
    options : dict
        That differ from the defaults of `RegionOptions`.
    pixels : int
        Of the longer side of its image.
    """

    name: str
    query: Array
    paint: Paint
    truth: list[Warp]
    closed: bool = True
    options: dict[str, Any] = field(default_factory=dict)
    pixels: int = 448

    @property
    def region(self) -> shapely.Geometry:
        """What the image covers."""
        kind = "region" if self.closed else "stroke"
        reach = self.options.get("reach", ga.RegionOptions().reach)
        return region_of(np.asarray(self.query), ga.RegionOptions(query_kind=kind, reach=reach))


@dataclass(frozen=True)
class Picture:
    """Lines and edits.

    Attributes
    ----------
    name : str
    figure : str
        Of the thesis, that it takes after.
    strokes : list of Stroke
    edits : list of Edit
        Later ones over earlier ones.
    background : callable
        Colour by points of the picture.
    low, high : (x, y)
        Corners of the sheet.
    pen : float
        Radius of the ink, scene units.
    ink : (r, g, b)
    """

    name: str
    figure: str
    strokes: list[Stroke]
    edits: list[Edit]
    background: Paint
    low: tuple[float, float]
    high: tuple[float, float]
    pen: float = 0.02
    ink: tuple[float, float, float] = (0.07, 0.05, 0.06)

    @property
    def polylines(self) -> list[Array]:
        """The lines as Blender evaluates them."""
        return [stroke.polyline() for stroke in self.strokes]


def within(outline: Array) -> Callable[[Array], Array]:
    """Whether points lie in an outline, as 0 or 1."""
    import shapely

    shape = shapely.make_valid(shapely.polygons(outline))
    shapely.prepare(shape)
    return lambda points: shapely.contains_xy(shape, points[:, 0], points[:, 1]).astype(float)


def mixed(a: Array, b: Array, share: Array) -> Array:
    """From one colour to another."""
    t = np.clip(np.asarray(share, float), 0.0, 1.0)[..., None]
    return (1.0 - t) * np.asarray(a, float) + t * np.asarray(b, float)


def over(base: Array, colour: Array, share: Array) -> Array:
    """RGB ``colour`` over RGB ``base`` where ``share`` says."""
    return mixed(base, np.broadcast_to(np.asarray(colour, float), base.shape), share)


def with_alpha(colour: Array, alpha: Array) -> Array:
    """RGB and alpha as RGBA."""
    return np.column_stack([colour, alpha])


def step(value: Array, edge: float, blur: float) -> Array:
    """0 below an edge, 1 above it, smooth between."""
    t = np.clip((value - edge) / blur + 0.5, 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def painted(paint: Paint, low: Array, high: Array, pixels: int) -> Array:
    """An image (height, width, 4), bottom row first, with softened edges.

    The colours of clear pixels are those of the nearest painted ones, so that no edge shows a fringe.
    """
    from scipy.ndimage import distance_transform_edt

    extent = np.asarray(high, float) - low
    size = np.maximum(np.round(pixels * extent / extent.max()), 2).astype(int)
    fine = 2
    x, y = (low[i] + (np.arange(size[i] * fine) + 0.5) * extent[i] / (size[i] * fine) for i in (0, 1))
    grid = np.stack(np.meshgrid(x, y), 2).reshape(-1, 2)
    rgba = paint(grid).reshape(size[1] * fine, size[0] * fine, 4)
    weight = rgba[..., 3:]
    blocks = (size[1], fine, size[0], fine, -1)
    alpha = weight.reshape(blocks).mean((1, 3))
    colour = (rgba[..., :3] * weight).reshape(blocks).mean((1, 3)) / np.maximum(alpha, 1e-6)
    clear = alpha[..., 0] < 0.02
    if clear.any() and not clear.all():
        nearest = distance_transform_edt(clear, return_distances=False, return_indices=True)
        colour = colour[tuple(nearest)]
    return np.concatenate([np.clip(colour, 0.0, 1.0), np.where(clear[..., None], 0.0, alpha)], 2)
