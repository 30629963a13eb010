"""Draw what a tree builds: a quick look without Blender."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

import matplotlib.image
import numpy as np

import geoanalogy as ga

#: Colour of a material by what its name ends with; the first that fits.
COLOURS = {
    "lawn": (0.55, 0.66, 0.42),
    "roof": (0.62, 0.30, 0.23),
    "glass": (0.40, 0.58, 0.72),
    "door": (0.42, 0.27, 0.17),
    "gate": (0.55, 0.55, 0.57),
    "reveal": (0.93, 0.91, 0.86),
    "base": (0.50, 0.48, 0.46),
    "": (0.85, 0.80, 0.70),
}
SUN = np.array([-0.45, -0.65, 0.75])


def colour(name: str) -> tuple[float, float, float]:
    """The colour of a material."""
    return next(c for key, c in COLOURS.items() if name.endswith(key))


def draw(
    meshes: Iterable[ga.Mesh],
    path: Path | str,
    target: Sequence[float],
    turn: float = -65.0,
    rise: float = 28.0,
    extent: float = 60.0,
    pixels: tuple[int, int] = (1400, 800),
) -> None:
    """Draw meshes in parallel projection.

    Parameters
    ----------
    meshes : iterable of Mesh
    path : path
        Of a .png.
    target : sequence of three float
        What is in the middle of the picture.
    turn, rise : float
        Where the eye is, degrees: direction in plan, and height.
    extent : float
        Width of the picture in scene units.
    pixels : (int, int)
        Width and height.
    """
    a, b = np.radians([turn, rise])
    back = np.array([np.cos(a) * np.cos(b), np.sin(a) * np.cos(b), np.sin(b)])
    right = np.array([-np.sin(a), np.cos(a), 0.0])
    axes = np.array([right, np.cross(back, right), back])
    width, height = pixels
    scale = width / extent
    image, depth = np.ones((height, width, 3)), np.full((height, width), -np.inf)
    for mesh in meshes:
        seen = (mesh.vertices - np.asarray(target, float)) @ axes.T * (scale, -scale, 1.0) + (width / 2, height / 2, 0)
        corners = mesh.vertices[mesh.faces]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-12)[:, None]
        light = 0.5 + 0.5 * np.clip(normals @ (SUN / np.linalg.norm(SUN)), 0.0, 1.0)
        paints = np.array([colour(name) for name in mesh.materials])[mesh.material_index] * light[:, None]
        for triangle, paint in zip(seen[mesh.faces], paints, strict=True):
            _fill(image, depth, triangle, paint)
    edge = np.zeros_like(depth, bool)
    for axis in (0, 1):
        jump = np.abs(np.diff(depth, axis=axis, prepend=np.take(depth, [0], axis=axis))) > 0.6
        edge |= jump
    image[edge & np.isfinite(depth)] *= 0.6
    matplotlib.image.imsave(path, np.clip(image, 0.0, 1.0))


def _fill(image: np.ndarray, depth: np.ndarray, corners: np.ndarray, paint: np.ndarray) -> None:
    (x0, y0), (x1, y1) = np.floor(corners[:, :2].min(axis=0)), np.ceil(corners[:, :2].max(axis=0)) + 1
    x0, x1 = int(max(x0, 0)), int(min(x1, image.shape[1]))
    y0, y1 = int(max(y0, 0)), int(min(y1, image.shape[0]))
    if x0 >= x1 or y0 >= y1:
        return
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = corners
    det = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay)
    if abs(det) < 1e-9:
        return
    x, y = np.meshgrid(np.arange(x0, x1) + 0.5, np.arange(y0, y1) + 0.5)
    v = ((x - ax) * (cy - ay) - (cx - ax) * (y - ay)) / det
    w = ((bx - ax) * (y - ay) - (x - ax) * (by - ay)) / det
    z = az + v * (bz - az) + w * (cz - az)
    part = depth[y0:y1, x0:x1]
    inside = (v >= -1e-6) & (w >= -1e-6) & (v + w <= 1 + 1e-6) & (z > part)
    part[inside] = z[inside]
    image[y0:y1, x0:x1][inside] = paint
