"""Figure 4.21: noise on the boundary, with corners that persist over scales and without.

The bed of a clean room is propagated to a room of other proportions whose walls tremble more and more. Taken by the
letter of section 4.3 every stroke of the tremor is a corner and a segment; the engine takes features from the boundary
without its noise.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from unittest import mock

import numpy as np

import geoanalogy as ga
from geoanalogy.geometry import polygon
from geoanalogy.geometry.features import polygon_features
from geoanalogy.geometry.persistence import ClearRing, sharp_vertices

from .furnishing import Array, box, outline, pose

BED = box(2.0, 1.6)
SOURCE = pose(1.4, 4.5, -90)
CLEAN = outline((0, 0), (5, 0), (5, 2), (2.8, 2), (2.8, 5.6), (0, 5.6))
OTHER = outline((0, 0), (4.6, 0), (4.6, 2.3), (2.9, 2.3), (2.9, 6.0), (0, 6.0))
INTENDED = pose(8.45, 4.9, -90)

#: Standard deviation of the noise, metres; a vertex every 15 centimetres. Along the walls it is less, so that no stroke
#: crosses another.
LEVELS = (0.0, 0.01, 0.03, 0.05)
STEP = 0.15
ALONG = 0.4


@dataclass(frozen=True)
class Outcome:
    """What came of propagating to a noisy room.

    Attributes
    ----------
    scene : Scene
    corners : int
        That the target is taken to have; it has six.
    best : PropagatedPose or None
        None where nothing was found in the target.
    """

    scene: ga.Scene
    corners: int
    best: ga.PropagatedPose | None

    @property
    def importance(self) -> float:
        """Of the best; 0 where there is none."""
        return 0.0 if self.best is None else self.best.importance

    @property
    def error(self) -> float:
        """Distance from the intended place, metres; inf where nothing was found or it faces another way."""
        if self.best is None or abs(float(np.angle(np.exp(1j * (self.best.pose.angle - INTENDED.angle))))) > 0.35:
            return np.inf
        return float(np.hypot(*np.subtract(self.best.pose.position, INTENDED.position)))


def noisy(ring: Array, deviation: float, seed: int) -> Array:
    """A ring with a vertex every few centimetres, each moved at random, across more than along.

    Parameters
    ----------
    ring : ndarray of shape (n, 2)
    deviation : float
        Standard deviation across the edges, scene units; 0: the ring as it is.
    seed : int

    Returns
    -------
    ndarray of shape (m, 2)
    """
    if not deviation:
        return ring
    rng = np.random.default_rng(seed)
    parts = []
    for a, b in zip(ring, np.roll(ring, -1, axis=0), strict=True):
        length = float(np.hypot(*(b - a)))
        n = max(1, round(length / STEP))
        along = (b - a) / length
        across = np.array([-along[1], along[0]])
        tremor = rng.normal(scale=deviation, size=(n, 2)) * (ALONG, 1.0)
        parts.append(a + (b - a) * np.arange(n)[:, None] / n + tremor @ np.stack([along, across]))
    return np.concatenate(parts)


@contextmanager
def features_by_the_letter() -> Iterator[None]:
    """Features by the vertex test of section 4.3 alone, for polygons made while this is entered."""

    def as_it_is(ring: Array, labels: tuple[str, ...] = ()) -> ClearRing:
        return ClearRing(ring, sharp_vertices(ring), labels or ("",) * len(ring))

    with mock.patch.object(polygon, "clear_ring", as_it_is):
        yield


def run(deviation: float, seed: int = 1) -> Outcome:
    """Propagate the bed to a room with noise.

    Parameters
    ----------
    deviation : float
        Metres.
    seed : int

    Returns
    -------
    Outcome
    """
    target = ga.Polygon(noisy(OTHER, deviation, seed) + np.array([7.0, 0.0]), "bedroom", "target")
    scene = ga.Scene([ga.Polygon(CLEAN, "bedroom", "source"), target])
    options = ga.PoseOptions(scale="fixed", mirror=False, cells=20_000)
    found = ga.propagate_pose(scene, SOURCE, BED, options)
    best = next((r for r in found if r.parent.id == "target"), None)
    return Outcome(scene, len(polygon_features(target)[1]), best)
