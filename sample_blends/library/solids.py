"""A small kit that builds the geometry of assets as arrays: no Blender here, so footprints and sizes can be tested."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np

from ..plans.outlines import circle, inset

Vector = tuple[float, float, float]
ORIGIN: Vector = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Solid:
    """Vertices (n, 3), faces as tuples of vertex indices (outward normals), and a material name per face."""

    vertices: np.ndarray
    faces: list[tuple[int, ...]]
    materials: list[str] = field(repr=False)

    def __add__(self, other: Solid) -> Solid:
        return joined((self, other))

    def moved(self, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Solid:
        """Translated."""
        return Solid(self.vertices + np.array((x, y, z)), self.faces, self.materials)

    def turned(self, degrees: float, axis: str = "z") -> Solid:
        """Rotated about an axis through the origin."""
        first, second = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
        c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
        vertices = self.vertices.copy()
        vertices[:, first] = c * self.vertices[:, first] - s * self.vertices[:, second]
        vertices[:, second] = s * self.vertices[:, first] + c * self.vertices[:, second]
        return Solid(vertices, self.faces, self.materials)

    def scaled(self, x: float, y: float, z: float) -> Solid:
        """Scaled about the origin; a mirroring scale turns the faces over."""
        faces = self.faces if x * y * z > 0 else [face[::-1] for face in self.faces]
        return Solid(self.vertices * (x, y, z), faces, self.materials)

    def roughened(self, amount: float, seed: int) -> Solid:
        """Every vertex moved at random by up to ``amount``, but for those on the floor, which stay there."""
        jitter = np.random.default_rng(seed).uniform(-amount, amount, self.vertices.shape)
        jitter[self.vertices[:, 2] < 1e-6, 2] = 0.0
        return Solid(self.vertices + jitter, self.faces, self.materials)


def joined(solids: Iterable[Solid]) -> Solid:
    """One solid of many."""
    vertices: list[np.ndarray] = []
    faces: list[tuple[int, ...]] = []
    materials: list[str] = []
    start = 0
    for solid in solids:
        vertices.append(solid.vertices)
        faces.extend(tuple(index + start for index in face) for face in solid.faces)
        materials.extend(solid.materials)
        start += len(solid.vertices)
    return Solid(np.vstack(vertices), faces, materials)


def around(solid: Solid, count: int, start: float = 0.0) -> Solid:
    """``count`` copies of a solid, evenly turned about the vertical axis, the first by ``start`` degrees."""
    return joined(solid.turned(start + 360.0 * i / count) for i in range(count))


def _of(vertices: Sequence | np.ndarray, faces: list[tuple[int, ...]], material: str) -> Solid:
    return Solid(np.asarray(vertices, dtype=float), faces, [material] * len(faces))


def loft(rings: Sequence[np.ndarray], material: str, bottom: bool = True, top: bool = True) -> Solid:
    """Skin over rings (n, 3) of equal length that run counter-clockwise seen from the last ring's end."""
    count = len(rings[0])
    vertices = np.vstack([np.asarray(ring, dtype=float) for ring in rings])
    faces: list[tuple[int, ...]] = []
    for level in range(len(rings) - 1):
        low = level * count
        for i in range(count):
            j = (i + 1) % count
            faces.append((low + i, low + j, low + count + j, low + count + i))
    if bottom:
        faces.append(tuple(range(count))[::-1])
    if top:
        faces.append(tuple(range((len(rings) - 1) * count, len(rings) * count)))
    return _of(vertices, faces, material)


def at_height(outline: np.ndarray, z: float) -> np.ndarray:
    """A plane outline (n, 2) as a ring (n, 3) at a height."""
    return np.column_stack((outline, np.full(len(outline), z)))


def extruded(outline: np.ndarray, z0: float, z1: float, material: str, bevel: float = 0.0) -> Solid:
    """Prism over an outline between two heights, its upper edge (not the lower) bevelled."""
    rings = [at_height(outline, z0), at_height(outline, z1 - bevel)]
    if bevel > 0:
        rings.append(at_height(inset(outline, bevel), z1))
    return loft(rings, material)


def box(size: Vector, at: Vector, material: str, bevel: float = 0.006) -> Solid:
    """Box with chamfered edges; ``at`` is the centre of its bottom."""
    half = np.asarray(size, dtype=float) / 2
    centre = np.asarray(at, dtype=float) + half * (0.0, 0.0, 1.0)
    bevel = min(bevel, 0.45 * float(half.min()))
    signs = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=float)
    if bevel <= 0:
        faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        vertices = signs * half
        return _of(vertices + centre, _outward(vertices, faces), material)
    # Vertex 3 k + a lies on the face perpendicular to axis a, next to corner k.
    vertices = np.repeat(signs, 3, axis=0) * half
    for axis in range(3):
        for other in range(3):
            if other != axis:
                vertices[axis::3, other] -= signs[:, other] * bevel
    faces = [(3 * k, 3 * k + 1, 3 * k + 2) for k in range(8)]
    bits = (4, 2, 1)
    for axis in range(3):
        first, second = (a for a in range(3) if a != axis)
        for side in (0, bits[axis]):
            low, right, left = side, side + bits[first], side + bits[second]
            high = side + bits[first] + bits[second]
            faces.append(tuple(3 * k + axis for k in (low, right, high, left)))
        # The edges that run along this axis.
        for a in (0, bits[first]):
            for b in (0, bits[second]):
                k, m = a + b, a + b + bits[axis]
                faces.append((3 * k + first, 3 * m + first, 3 * m + second, 3 * k + second))
    return _of(vertices + centre, _outward(vertices, faces), material)


def _outward(vertices: np.ndarray, faces: list[tuple[int, ...]]) -> list[tuple[int, ...]]:
    """Faces of a convex solid about the origin, each turned so that its normal points outwards."""
    turned = []
    for face in faces:
        a, b, c = (vertices[i] for i in face[:3])
        turned.append(face if np.cross(b - a, c - a) @ vertices[list(face)].mean(axis=0) > 0 else face[::-1])
    return turned


def _cube(parameters: Sequence[np.ndarray]) -> tuple[np.ndarray, list[tuple[int, ...]]]:
    """Surface of a box about the origin, divided along each axis at the given coordinates, without double vertices."""
    index: dict[tuple[float, ...], int] = {}
    points: list[tuple[float, ...]] = []
    faces: list[tuple[int, ...]] = []
    for axis in range(3):
        first, second = (axis + 1) % 3, (axis + 2) % 3
        for sign in (-1.0, 1.0):
            grid = np.empty((len(parameters[first]), len(parameters[second])), dtype=int)
            for i, u in enumerate(parameters[first]):
                for j, v in enumerate(parameters[second]):
                    point = np.empty(3)
                    point[axis], point[first], point[second] = sign * parameters[axis][-1], u, v
                    key = tuple(np.round(point, 6))
                    if key not in index:
                        index[key] = len(points)
                        points.append(tuple(point))
                    grid[i, j] = index[key]
            for i in range(grid.shape[0] - 1):
                for j in range(grid.shape[1] - 1):
                    face = (grid[i, j], grid[i + 1, j], grid[i + 1, j + 1], grid[i, j + 1])
                    faces.append(tuple(int(k) for k in (face if sign > 0 else face[::-1])))
    return np.array(points), faces


def cushion(
    size: Vector, at: Vector, material: str, radius: float = 0.05, segments: int = 2, puff: float = 0.0
) -> Solid:
    """Box with round edges; ``puff`` raises the middle of the top and ``at`` is the centre of the bottom."""
    half = np.asarray(size, dtype=float) / 2
    radius = min(radius, 0.98 * float(half.min()))
    corner = np.linspace(0.0, 1.0, segments + 1)
    parameters = []
    for h in half:
        inner = np.linspace(-(h - radius), h - radius, 5 if puff else 2)
        parameters.append(np.concatenate((-h + radius * corner[:-1], inner, h - radius + radius * corner[1:])))
    cube, faces = _cube(parameters)
    core = np.clip(cube, -(half - radius), half - radius)
    outwards = cube - core
    vertices = core + radius * outwards / np.linalg.norm(outwards, axis=1, keepdims=True)
    if puff:
        bulge = np.clip(1 - (vertices[:, 0] / half[0]) ** 2, 0, 1) * np.clip(1 - (vertices[:, 1] / half[1]) ** 2, 0, 1)
        vertices[:, 2] += np.where(vertices[:, 2] > 0, puff * bulge, 0.0)
    return _of(vertices + np.asarray(at) + (0.0, 0.0, half[2]), faces, material)


def lathe(profile: Sequence[tuple[float, float]], material: str, sides: int = 24, at: Vector = ORIGIN) -> Solid:
    """Surface of revolution of a profile of (radius, z) from bottom to top; end radii near 0 become points."""
    unit = circle(1.0, count=sides)
    rings = [at_height(unit * max(radius, 1e-4), z) for radius, z in profile]
    return loft(rings, material).moved(*at)


def cylinder(
    radius: float,
    height: float,
    at: Vector,
    material: str,
    bevel: float = 0.0,
    sides: int = 20,
    top: float | None = None,
) -> Solid:
    """Upright cylinder, or a cone frustum with the radius ``top`` above; ``at`` is the centre of its bottom."""
    top = radius if top is None else top
    profile = [(radius, 0.0), (top, height)]
    if bevel > 0:
        profile = [(radius - bevel, 0.0), (radius, bevel), (top, height - bevel), (top - bevel, height)]
    return lathe(profile, material, sides, at)


def ellipsoid(radii: Vector, at: Vector, material: str, sides: int = 16, rings: int = 10) -> Solid:
    """Ellipsoid about ``at``."""
    angles = np.linspace(-np.pi / 2, np.pi / 2, rings + 1)
    ball = lathe([(np.cos(a), np.sin(a)) for a in angles], material, sides)
    return ball.scaled(*radii).moved(*at)


def tube(
    path: Sequence[Vector] | np.ndarray,
    radius: float | Sequence[float],
    material: str,
    sides: int = 8,
    closed: bool = False,
) -> Solid:
    """Round bar along a polyline, of one radius or of one per point."""
    points = np.asarray(path, dtype=float)
    radii = np.broadcast_to(np.asarray(radius, dtype=float), len(points))
    if closed:
        tangents = np.roll(points, -1, axis=0) - np.roll(points, 1, axis=0)
    else:
        tangents = np.gradient(points, axis=0)
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    # A frame carried along the path turns as little as possible.
    normal = np.cross(tangents[0], (0.0, 0.0, 1.0) if abs(tangents[0][2]) < 0.9 else (1.0, 0.0, 0.0))
    unit = circle(1.0, count=sides)
    rings = []
    for point, tangent, r in zip(points, tangents, radii, strict=True):
        normal = normal - (normal @ tangent) * tangent
        normal = normal / np.linalg.norm(normal)
        binormal = np.cross(tangent, normal)
        rings.append(point + r * (unit[:, :1] * normal + unit[:, 1:] * binormal))
    if closed:
        return loft([*rings, rings[0]], material, bottom=False, top=False)
    return loft(rings, material)


def legs(length: float, width: float, height: float, radius: float, material: str, top: float | None = None) -> Solid:
    """Four round legs under a rectangle about the origin; slimmer at the floor if ``top`` is given."""
    return joined(
        cylinder(radius, height, (sx * length / 2, sy * width / 2, 0.0), material, sides=10, top=top)
        for sx in (-1, 1)
        for sy in (-1, 1)
    )


def slab(length: float, width: float, z0: float, z1: float, material: str, bevel: float = 0.006) -> Solid:
    """Box about the vertical axis between two heights."""
    return box((length, width, z1 - z0), (0.0, 0.0, z0), material, bevel)


def sheet(outline: np.ndarray, z: float, material: str) -> Solid:
    """One flat face that looks upwards."""
    return _of(at_height(outline, z), [tuple(range(len(outline)))], material)


def cards(
    centres: np.ndarray, normals: np.ndarray, sizes: np.ndarray, material: str, rng: np.random.Generator
) -> Solid:
    """Leaves: a rhombus at each centre (n, 3), about perpendicular to its normal, turned at random."""
    normals = normals / np.linalg.norm(normals, axis=1, keepdims=True)
    random = rng.normal(size=normals.shape)
    first = np.cross(normals, random)
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    second = np.cross(normals, first)
    along, across = first * sizes[:, None], second * sizes[:, None] * 0.6
    vertices = np.stack((centres - along, centres - across, centres + along, centres + across), axis=1).reshape(-1, 3)
    faces = [(4 * i, 4 * i + 3, 4 * i + 2, 4 * i + 1) for i in range(len(centres))]
    return _of(vertices, faces, material)


def _divided(size: float, step: float) -> np.ndarray:
    return np.linspace(-size / 2, size / 2, max(2, round(size / step)) + 1)


def dense_box(size: Vector, step: float, material: str) -> Solid:
    """Box on the floor whose faces are divided into squares of about ``step``: a base for :meth:`Solid.roughened`."""
    vertices, faces = _cube([_divided(length, step) for length in size])
    return _of(vertices, faces, material).moved(z=size[2] / 2)


def dense_ball(radius: float, divisions: int, at: Vector, material: str) -> Solid:
    """Ball of 6 ``divisions``² faces of about equal size, without poles: a base for :meth:`Solid.roughened`."""
    even = np.tan(np.linspace(-np.pi / 4, np.pi / 4, divisions + 1))
    vertices, faces = _cube([even] * 3)
    return _of(vertices * (radius / np.linalg.norm(vertices, axis=1, keepdims=True)) + at, faces, material)
