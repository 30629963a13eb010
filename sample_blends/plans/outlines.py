"""Outlines of the plans and the assets: rings (n, 2), counter-clockwise, without repeated last vertex."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class PlanPolygon:
    """One labelled polygon of a plan.

    Attributes
    ----------
    label, id : str
        What the polygon is, and its name, unique in the plan.
    ring : ndarray (n, 2)
        Counter-clockwise, metres, without repeated last vertex.
    parent : str or None
        ``id`` of the polygon it belongs to; None for the outermost ones.
    segment_labels : tuple of str, or None
        A label per edge (``""`` for none); edge i runs from vertex i to vertex i + 1.
    """

    label: str
    id: str
    ring: np.ndarray
    parent: str | None = None
    segment_labels: tuple[str, ...] | None = None


def rectangle(x0: float, y0: float, x1: float, y1: float) -> np.ndarray:
    """Rectangle between two opposite corners."""
    x0, x1 = min(x0, x1), max(x0, x1)
    y0, y1 = min(y0, y1), max(y0, y1)
    return np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1)], dtype=float)


def centred_rectangle(length: float, width: float, centre: tuple[float, float] = (0.0, 0.0)) -> np.ndarray:
    """Rectangle of a length along x and a width along y about a centre."""
    x, y = centre
    return rectangle(x - length / 2, y - width / 2, x + length / 2, y + width / 2)


def arc(centre: tuple[float, float], radius: float, start: float, end: float, count: int) -> np.ndarray:
    """``count`` points of a circle from the angle ``start`` to ``end`` (degrees), both included."""
    angles = np.radians(np.linspace(start, end, count))
    return np.column_stack((centre[0] + radius * np.cos(angles), centre[1] + radius * np.sin(angles)))


def circle(radius: float, centre: tuple[float, float] = (0.0, 0.0), count: int = 48) -> np.ndarray:
    """Regular polygon that stands for a circle."""
    return arc(centre, radius, 0.0, 360.0 * (count - 1) / count, count)


def ellipse(length: float, width: float, count: int = 48) -> np.ndarray:
    """Ellipse about the origin, of a length along x and a width along y."""
    return circle(1.0, count=count) * (length / 2, width / 2)


def rounded(ring: np.ndarray, radius: float, count: int = 6) -> np.ndarray:
    """A ring whose corners are replaced by arcs of ``radius`` with ``count`` points each."""
    ring = np.asarray(ring, dtype=float)
    points = []
    for before, corner, after in zip(np.roll(ring, 1, axis=0), ring, np.roll(ring, -1, axis=0), strict=True):
        towards = (before - corner) / np.linalg.norm(before - corner)
        onwards = (after - corner) / np.linalg.norm(after - corner)
        half = np.arccos(np.clip(towards @ onwards, -1.0, 1.0)) / 2
        bisector = (towards + onwards) / np.linalg.norm(towards + onwards)
        centre = corner + bisector * radius / np.sin(half)
        start, end = (corner + leg * radius / np.tan(half) - centre for leg in (towards, onwards))
        first = np.arctan2(start[1], start[0])
        sweep = (np.arctan2(end[1], end[0]) - first + np.pi) % (2 * np.pi) - np.pi
        angles = first + sweep * np.linspace(0.0, 1.0, count)
        points.append(centre + radius * np.column_stack((np.cos(angles), np.sin(angles))))
    return np.vstack(points)


def mirrored(ring: np.ndarray, axis: float = 0.0) -> np.ndarray:
    """The ring mirrored left to right about the vertical line x = ``axis``, again counter-clockwise."""
    return (np.asarray(ring, dtype=float) * (-1.0, 1.0) + (2 * axis, 0.0))[::-1]


def inset(ring: np.ndarray, distance: float | np.ndarray) -> np.ndarray:
    """Every edge moved inwards by ``distance`` (outwards if negative), corners mitred: vertex i stays vertex i.

    ``distance`` may be one number or one per edge. Edges must not vanish: nothing is cleaned up.
    """
    ring = np.asarray(ring, dtype=float)
    along = np.roll(ring, -1, axis=0) - ring
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    normal = np.column_stack((-along[:, 1], along[:, 0]))
    offset = np.broadcast_to(np.asarray(distance, dtype=float), len(ring))
    before = np.roll(normal, 1, axis=0)
    offset_before = np.roll(offset, 1)
    # The moved corner x satisfies before·x = offset_before and normal·x = offset, relative to the corner.
    determinant = before[:, 0] * normal[:, 1] - before[:, 1] * normal[:, 0]
    straight = np.abs(determinant) < 1e-6
    safe = np.where(straight, 1.0, determinant)
    mitred = (
        np.column_stack(
            (
                offset_before * normal[:, 1] - offset * before[:, 1],
                offset * before[:, 0] - offset_before * normal[:, 0],
            )
        )
        / safe[:, None]
    )
    return ring + np.where(straight[:, None], normal * offset[:, None], mitred)


def turned(ring: np.ndarray, angle: float) -> np.ndarray:
    """The ring turned counter-clockwise about the origin by ``angle`` degrees."""
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    return np.asarray(ring, dtype=float) @ np.array([[c, s], [-s, c]])


def smoothed(ring: np.ndarray, rounds: int = 2) -> np.ndarray:
    """The ring with its corners cut off again and again (Chaikin): 2^rounds times as many vertices."""
    ring = np.asarray(ring, dtype=float)
    for _ in range(rounds):
        after = np.roll(ring, -1, axis=0)
        ring = np.stack((0.75 * ring + 0.25 * after, 0.25 * ring + 0.75 * after), axis=1).reshape(-1, 2)
    return ring
