"""Chapter 4 taken literally: every level set of every feature drawn into one grid over the scene, for every query.

What `geoanalogy` is compared with. Nothing is kept from one query to the next, no room is left out, and features of all
rooms are drawn over the whole plan. "Pose space" accumulates in a dense volume with 100 directions (section 4.9).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from geoanalogy import PoseModel, Scene
from geoanalogy.poses.kernels import wrap
from geoanalogy.relations.elements import Elements, ElementType
from geoanalogy.relations.observation import Observation
from geoanalogy.relations.table import Kind

Array = NDArray[np.float32]

#: Width over which a level set falls off, in cells: about three.
HALF_WIDTH = 3.0
BINS = 100


@dataclass(frozen=True)
class Raster:
    """A regular grid over a scene.

    Attributes
    ----------
    points : ndarray of shape (n, 2)
    spacing : float
    """

    points: NDArray[np.float64]
    spacing: float

    @classmethod
    def over(cls, scene: Scene, cells: int) -> Raster:
        """About so many cells over the whole scene."""
        low, high = scene.bounds[:2], scene.bounds[2:]
        spacing = float(np.sqrt(np.prod(high - low) / cells))
        axes = [np.arange(a, b, spacing) for a, b in zip(low, high, strict=True)]
        return cls(np.stack(np.meshgrid(*axes), axis=-1).reshape(-1, 2), spacing)


def accumulate(model: PoseModel, scene: Scene, raster: Raster, volume: bool = False) -> Array:
    """Importance at every cell (n,), or at every cell and direction (n, 100): section 4.5 without its shortcuts.

    Parameters
    ----------
    model : PoseModel
        With a point for a footprint.
    scene : Scene
    raster : Raster
    volume : bool
        Whether directions have an axis of their own.

    Returns
    -------
    ndarray
    """
    query = model.query
    shape = (len(raster.points), BINS) if volume else (len(raster.points),)
    width = HALF_WIDTH * raster.spacing
    bins = 2 * np.pi * np.arange(BINS) / BINS
    layers = {
        (element, k, i): np.zeros(shape, dtype=np.float32)
        for element, q in query.questions.items()
        for k in range(len(q.relations))
        for i in range(len(q.feature))
    }
    for polygon in scene.polygons:
        elements = Elements.of([polygon])
        seen = Observation(elements, raster.points)
        for (element, k, i), layer in layers.items():
            q = query.questions[element]
            if not _may_match(query.arrangement.elements, element, q.feature[i], polygon.label):
                continue
            accuracy = _accuracy(query.arrangement.elements, elements, element, q.feature[i])
            away = np.abs(_difference(q.relations[k], seen, elements, q.value[k, i])) / width
            kernel = np.maximum(0, 1 - away) * accuracy[:, None]
            if not volume:
                np.maximum(layer, kernel.max(axis=0), out=layer)
                continue
            direction = q.relations[k].directional.reference(seen) + q.turn[k, i]
            for row in np.flatnonzero(kernel.any(axis=1)):
                cell = np.flatnonzero(kernel[row])
                off = np.abs(wrap(bins - direction[row, cell, None])) / query.options.direction_width
                both = kernel[row, cell, None] * np.maximum(0, 1 - off)
                layer[cell] = np.maximum(layer[cell], both)
    total = np.zeros(shape, dtype=np.float32)
    for (element, k, i), layer in layers.items():
        total += query.questions[element].weight[k, i] * layer
    return total / query.total


def _may_match(source: Elements, element: ElementType, feature: int, label: str) -> bool:
    """Whether a feature of the example is of a polygon of a label (section 4.8)."""
    return source.polygons[source.polygon_of(element)[feature]].label == label


def _accuracy(source: Elements, target: Elements, element: ElementType, feature: int) -> NDArray[np.float64]:
    """I_m of section 4.4 between one feature of the example and all of a polygon."""
    if element is ElementType.POLYGON:
        return _ratio(source.polygons[feature].area, np.array([p.area for p in target.polygons]))
    if element is ElementType.SEGMENT:
        return _ratio(source.segment_length[feature], target.segment_length)
    return 1 - np.abs(source.corner_opening[feature] - target.corner_opening) / np.pi


def _ratio(a: float, b: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.minimum(a, b) / np.maximum(a, b)


def _difference(relation, seen: Observation, elements: Elements, value: float) -> NDArray[np.float64]:
    """Distance in the plane from the level set."""
    miss = relation.value(seen) - value
    if relation.period is not None:
        period = relation.period(elements)[:, None]
        miss = np.where(np.isfinite(period), wrap(miss, np.where(np.isfinite(period), period, 1.0)), miss)
    if relation.kind is Kind.LENGTH:
        return miss
    slope = np.broadcast_to(relation.slope(seen), miss.shape)
    return np.divide(miss, slope, out=np.full(miss.shape, 1e9), where=slope > 0)
