"""The features of polygons as arrays: what `Elements` holds, taken from segments and corners (section 4.3)."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from ..geometry.features import Corner, Segment, features_by_ring
from ..geometry.polygon import Polygon, main_directions
from ..tolerances import LEAST_NOISY_TURNS, SMOOTH_TURN
from .runs import first_of

Array = NDArray[np.float64]


def extract_each(polygons: Sequence[Polygon]) -> Iterator[tuple[Polygon, dict[str, Any]]]:
    """The features of polygons, each for itself.

    Polygons of straight sides between sharp corners, which most rooms and furniture are, are evaluated together.

    Parameters
    ----------
    polygons : sequence of Polygon

    Yields
    ------
    Polygon, dict
        As `extract` returns it.
    """
    alike: dict[int, list[Polygon]] = {}
    for polygon in polygons:
        if polygon.holes or len(polygon.points) >= LEAST_NOISY_TURNS:
            yield polygon, extract((polygon,))
        else:
            alike.setdefault(len(polygon.points), []).append(polygon)
    for those in alike.values():
        yield from _extract_plain(those)


def _extract_plain(polygons: Sequence[Polygon]) -> Iterator[tuple[Polygon, dict[str, Any]]]:
    """The features of polygons of equally many vertices, without holes or noise."""
    start = np.array([p.points for p in polygons])
    vector = _following(start) - start
    length = np.hypot(vector[..., 0], vector[..., 1])
    after = vector / length[..., None]
    before = _preceding(after)
    dot = np.einsum("pij,pij->pi", before, after)
    plain = (dot <= SMOOTH_TURN).all(axis=1)
    whole = length.sum(axis=1)[:, None]
    turn = _turns(vector)
    count = start.shape[1]
    zeros, numbers = np.zeros(count), np.arange(count)
    owner = np.zeros(count, dtype=np.intp)
    cross = before[..., 0] * after[..., 1] - before[..., 1] * after[..., 0]
    each = {
        "edge_start": start,
        "edge_vector": vector,
        "edge_direction": (vector[..., 0] + 1j * vector[..., 1]) / length,
        "edge_heading": np.arctan2(vector[..., 1], vector[..., 0]),
        "edge_length": length,
        "edge_ring_offset": (np.cumsum(length, axis=1) - length) % whole,
        "edge_ring_length": np.repeat(whole, count, axis=1),
        "edge_turns": turn,
        "segment_length": length,
        "polygon_centroid": shapely.get_coordinates(shapely.centroid([p.shape for p in polygons]))[:, None],
        "polygon_orientation": main_directions(start)[:, None],
        "corner_vertex": start,
        "corner_before": np.arctan2(-before[..., 1], -before[..., 0]),
        "corner_opening": np.pi - np.arctan2(cross, dot),
    }
    shared = {
        "edge_offset": zeros,
        "edge_polygon": owner,
        "edge_segment": numbers,
        "segment_polygon": owner,
        "segment_curvature": zeros,
        "segment_closed": np.zeros(count, dtype=bool),
        "corner_polygon": owner,
    }
    for k, polygon in enumerate(polygons):
        if not plain[k]:
            yield polygon, extract((polygon,))
            continue
        own = {name: values[k] for name, values in each.items()}
        if polygon.orientation is not None:
            own["polygon_orientation"] = np.array([polygon.orientation])
        yield polygon, {**own, **shared, "segment_label": polygon.segment_labels}


def extract(polygons: Sequence[Polygon]) -> dict[str, Any]:
    """The features of polygons, one after another.

    Parameters
    ----------
    polygons : sequence of Polygon

    Returns
    -------
    dict
        The attributes of `Elements` by name, but for the polygons and the frame.
    """
    starts: list[Array] = []
    vectors: list[Array] = []
    turns: list[Array] = []
    per_segment: list[int] = []
    per_ring: list[int] = []
    segments: list[Segment] = []
    corners: list[Corner] = []
    segment_polygon: list[int] = []
    corner_polygon: list[int] = []
    for i, polygon in enumerate(polygons):
        for ring_segments, ring_corners in features_by_ring(polygon):
            first = len(vectors)
            for s in ring_segments:
                starts.append(s.vertices[:-1])
                vectors.append(s.vertices[1:] - s.vertices[:-1])
                per_segment.append(len(s.vertices) - 1)
            turns.append(_turns(np.concatenate(vectors[first:])))
            per_ring.append(len(turns[-1]))
            segments += ring_segments
            corners += ring_corners
            segment_polygon += [i] * len(ring_segments)
            corner_polygon += [i] * len(ring_corners)
    edge_vector = np.concatenate(vectors) if vectors else np.zeros((0, 2))
    edge_length = np.hypot(edge_vector[:, 0], edge_vector[:, 1])
    edge_segment = np.repeat(np.arange(len(segments)), per_segment)
    first_edge = first_of(np.array(per_segment, dtype=np.intp))
    segment_length = np.add.reduceat(edge_length, first_edge) if segments else np.zeros(0)
    first_of_ring = first_of(np.array(per_ring, dtype=np.intp))
    ring_length = np.repeat(np.add.reduceat(edge_length, first_of_ring), per_ring) if segments else np.zeros(0)
    arc = np.cumsum(edge_length) - edge_length
    offset = arc - arc[first_edge][edge_segment]
    # A segment may run over the ring's first vertex; there the count starts again.
    ring_offset = (np.array([s.ring_offset for s in segments], dtype=np.float64)[edge_segment] + offset) % ring_length
    before = np.array([c.before for c in corners]).reshape(-1, 2)
    return {
        "edge_start": np.concatenate(starts) if starts else np.zeros((0, 2)),
        "edge_vector": edge_vector,
        "edge_direction": np.asarray((edge_vector[:, 0] + 1j * edge_vector[:, 1]) / edge_length, dtype=np.complex128),
        "edge_heading": np.arctan2(edge_vector[:, 1], edge_vector[:, 0]),
        "edge_length": edge_length,
        "edge_offset": offset,
        "edge_ring_offset": ring_offset,
        "edge_ring_length": ring_length,
        "edge_turns": np.concatenate(turns) if turns else np.zeros((0, 2)),
        "edge_polygon": np.array(segment_polygon, dtype=np.intp)[edge_segment],
        "edge_segment": edge_segment,
        "segment_polygon": np.array(segment_polygon, dtype=np.intp),
        "segment_length": segment_length,
        "segment_curvature": np.array([s.curvature for s in segments]),
        "segment_closed": np.array([s.closed for s in segments], dtype=bool),
        "segment_label": tuple(s.label for s in segments),
        "polygon_centroid": np.array([p.centroid for p in polygons]).reshape(-1, 2),
        "polygon_orientation": np.array([p.main_orientation for p in polygons]),
        "corner_polygon": np.array(corner_polygon, dtype=np.intp),
        "corner_vertex": np.array([c.vertex for c in corners]).reshape(-1, 2),
        "corner_before": np.arctan2(-before[:, 1], -before[:, 0]),
        "corner_opening": np.array([c.opening for c in corners]),
    }


def _turns(steps: Array) -> Array:
    """Turns before and after each edge of a ring, shape (..., n, 2), from the ways along its edges."""
    following = _following(steps)
    cross = steps[..., 0] * following[..., 1] - steps[..., 1] * following[..., 0]
    after = np.arctan2(cross, np.einsum("...ij,...ij->...i", steps, following))
    return np.stack([_preceding(after[..., None])[..., 0], after], axis=-1)


def _following(ring: Array) -> Array:
    """What follows each in rings of shape (..., n, k)."""
    return np.concatenate([ring[..., 1:, :], ring[..., :1, :]], axis=-2)


def _preceding(ring: Array) -> Array:
    """What precedes each in rings of shape (..., n, k)."""
    return np.concatenate([ring[..., -1:, :], ring[..., :-1, :]], axis=-2)
