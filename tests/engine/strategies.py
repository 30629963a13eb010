"""What hypothesis draws: polygons, points and similarity transforms."""

from dataclasses import dataclass

import numpy as np
import shapes
from hypothesis import strategies as st


def numbers(low, high):
    """Finite floats without the denormal and endless-digit corners that no drawing has."""
    return st.floats(low, high, allow_nan=False, allow_infinity=False).map(lambda x: round(x, 6))


@dataclass(frozen=True)
class Similarity:
    """Scale, then rotation, then translation; with `mirrored` the y axis is flipped first."""

    angle: float = 0.0
    scale: float = 1.0
    shift: tuple[float, float] = (0.0, 0.0)
    mirrored: bool = False

    def __call__(self, points):
        c, s = np.cos(self.angle), np.sin(self.angle)
        flip = np.array([1.0, -1.0 if self.mirrored else 1.0])
        return self.scale * (points * flip) @ np.array([[c, s], [-s, c]]) + self.shift


def similarities(scales=(0.05, 20.0), mirrored=False):
    """Rotations by any angle, scales, translations by up to a hundred units."""
    return st.builds(
        Similarity,
        numbers(-np.pi, np.pi),
        numbers(*scales),
        st.tuples(numbers(-100, 100), numbers(-100, 100)),
        st.booleans() if mirrored else st.just(False),
    )


@st.composite
def simple_rings(draw, most=12):
    """Rings that are star-shaped about the origin, so simple whatever the radii."""
    count = draw(st.integers(3, most))
    # Gaps of less than half a turn: the origin stays inside.
    gaps = np.array(draw(st.lists(numbers(0.5, 1.0), min_size=count, max_size=count)))
    radii = np.array(draw(st.lists(numbers(0.3, 3.0), min_size=count, max_size=count)))
    angles = np.cumsum(gaps) * 2 * np.pi / gaps.sum()
    return np.stack([radii * np.cos(angles), radii * np.sin(angles)], axis=1)


@st.composite
def slivers(draw):
    """Long thin triangles."""
    length, height, along = draw(numbers(1.0, 50.0)), draw(numbers(1e-3, 1e-2)), draw(numbers(0.1, 0.9))
    return np.array([(0.0, 0.0), (length, 0.0), (along * length, height)])


def catalogue_rings():
    """The rings of the catalogue of shapes."""
    return st.sampled_from([outline for _, outline, _, _ in shapes.CATALOGUE])


def rings():
    """Simple rings of every sort."""
    return st.one_of(simple_rings(), slivers(), catalogue_rings())


@st.composite
def with_repeated_vertices(draw, source=None):
    """A ring, and the same ring with vertices repeated, perhaps closed."""
    outline = draw(source if source is not None else rings())
    counts = draw(st.lists(st.integers(1, 3), min_size=len(outline), max_size=len(outline)))
    repeated = np.repeat(outline, counts, axis=0)
    return outline, np.vstack([repeated, outline[:1]]) if draw(st.booleans()) else repeated


def places(reach=6.0):
    """Points anywhere about the origin, inside or outside of the rings above."""
    return st.tuples(numbers(-reach, reach), numbers(-reach, reach)).map(np.array)
