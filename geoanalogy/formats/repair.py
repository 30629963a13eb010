"""Parcels of maps as they come: what can be mended is mended, the rest is left out, and both are said by id."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import shapely

from ..errors import InputError
from ..geometry.polygon import Polygon
from ..geometry.scene import Scene
from ..tolerances import (
    LEAST_SIMPLE_SHARE,
    MOST_DRAWN,
    MOST_VERTICES,
    ON_SAME_EDGE,
    SIMPLIFIED,
    SMALLEST_MAP,
    SMALLEST_PARCEL,
    SURFACE_GRID,
    THINNEST_PARCEL,
    TOUCHING_SHARE,
    TWIN_SHARE,
)
from .outlines import Outline, Points

#: Bounds of degrees.
LONGITUDE, LATITUDE = 180.0, 90.0


def check_unit(file: str, outlines: Sequence[Outline]) -> None:
    """Find out whether coordinates are degrees, of which the file says nothing.

    Parameters
    ----------
    file : str
        For the message.
    outlines : sequence of Outline

    Raises
    ------
    InputError
        Where all coordinates could be degrees, and the largest parcel would be smaller than any other unit allows.
    """
    rings = [o.rings[0][np.isfinite(o.rings[0]).all(axis=1)] for o in outlines]
    rings = [ring for ring in rings if len(ring)]
    if not rings:
        return
    every = np.abs(np.concatenate(rings))
    largest = max(float(np.ptp(ring, axis=0).max()) for ring in rings)
    if largest < SMALLEST_MAP and every[:, 0].max() <= LONGITUDE and every[:, 1].max() <= LATITUDE:
        raise InputError(
            f"{file} seems to have its coordinates in degrees (its largest polygon is {largest:.2g} units wide); "
            "export it in a projected system in metres, such as UTM"
        )


def mended(file: str, outlines: Sequence[Outline], problems: list[str]) -> list[Outline]:
    """Outlines without what makes no polygon of them, where nearly all of the area stays.

    Parameters
    ----------
    file : str
        For messages.
    outlines : sequence of Outline
    problems : list of str
        Takes a sentence for every outline that is mended or left out.

    Returns
    -------
    list of Outline
        An outline that crosses itself has only its largest loop, where the others hardly count; holes are kept.
    """
    found = []
    for outline in outlines:
        said = f"{file}, {outline.where}: it"
        if all(len(ring) >= 4 and np.isfinite(ring).all() for ring in outline.rings):
            count = _count(outline.rings)
            # All crossings of an outline with itself are found to mend it, and they grow with the square of its edges.
            most = MOST_DRAWN if count > MOST_DRAWN or _shape(outline.rings).is_valid else MOST_VERTICES
            if count > most:
                outline = _redrawn(outline, _simplified(outline.rings))
                left = _count(outline.rings)
                if left > MOST_DRAWN or (left > MOST_VERTICES and not _shape(outline.rings).is_valid):
                    problems.append(f"{said} has {count} vertices, and {left} when simplified; draw it with fewer")
                    continue
                problems.append(f"{said} has {count} vertices and has been simplified to {left}")
            rings = _simple(outline.rings)
            if rings is not None:
                problems.append(f"{file}, {outline.where}: its outline touched or crossed itself and has been mended")
                outline = _redrawn(outline, rings)
        found.append(outline)
    return found


def _count(rings: Sequence[Points]) -> int:
    return sum(len(ring) for ring in rings)


def _shape(rings: Sequence[Points]) -> shapely.Polygon:
    """What closed rings enclose, beside the origin."""
    return shapely.Polygon(rings[0] - rings[0][0], [ring - rings[0][0] for ring in rings[1:]])


def _redrawn(outline: Outline, rings: Sequence[Points]) -> Outline:
    """The outline with other rings; which edge is which is no longer known."""
    return replace(outline, rings=rings, properties={**outline.properties, "segment_labels": None})


def _simplified(rings: Sequence[Points]) -> list[Points]:
    """Rings with fewer vertices; holes that are hardly there are gone.

    It takes time in proportion to the vertices, however often the rings cross themselves.
    """
    tolerance = SIMPLIFIED * float(np.ptp(rings[0], axis=0).max())
    lines = [shapely.simplify(shapely.LinearRing(ring), tolerance, preserve_topology=False) for ring in rings]
    outer, *holes = (shapely.get_coordinates(line) for line in lines)
    return [outer, *(hole for hole in holes if len(hole) >= 4)]


def _simple(rings: Sequence[Points]) -> list[Points] | None:
    """Closed rings that make a polygon; None where nothing has to be mended, or too much."""
    shift = rings[0][0]
    shape = _shape(rings)
    if shape.is_valid or shapely.get_num_interior_rings(shape) != len(rings) - 1:
        return None
    parts = shapely.get_parts(shapely.make_valid(shape, method="structure", keep_collapsed=False))
    parts = [part for part in parts if part.geom_type == "Polygon"]
    if not parts:
        return None
    largest = max(parts, key=lambda part: part.area)
    # Loops that run the other way cancel in the area, so that the hull of what was drawn is the measure.
    if largest.area < LEAST_SIMPLE_SHARE * sum(abs(loop.area) for loop in _loops(shape)):
        return None
    return [shapely.get_coordinates(ring) + shift for ring in (largest.exterior, *largest.interiors)]


def _loops(shape: shapely.Polygon) -> list[shapely.Polygon]:
    """All areas that the outline of a shape encloses."""
    return list(shapely.get_parts(shapely.polygonize([shapely.node(shape.exterior)])))


def sound_parcels(file: str, scene: Scene, problems: list[str]) -> Scene:
    """The parcels that something can be built on.

    Parameters
    ----------
    file : str
        For messages.
    scene : Scene
    problems : list of str
        Takes a sentence for every parcel that is left out: hardly any area, a sliver, no label.

    Returns
    -------
    Scene
    """
    parents = {p.parent for p in scene.polygons}
    sound = []
    for p in scene.polygons:
        width = 2 * p.area / p.shape.length
        if p.area < SMALLEST_PARCEL:
            problems.append(f"{file}, polygon {p.id!r}: its area is {p.area:.3g}; delete it or correct its outline")
        elif width < THINNEST_PARCEL:
            problems.append(f"{file}, polygon {p.id!r}: it is a sliver, {width:.2g} wide; delete it or correct it")
        elif not p.label and p.id not in parents:
            problems.append(f"{file}, polygon {p.id!r}: it has no label, so that no operation fits; give it one")
        else:
            sound.append(p)
    return Scene(sound, scene.offset, scene.memory)


def of_few_vertices(scene: Scene, labels: frozenset[str] | None, problems: list[str]) -> Scene:
    """Parcels whose outlines have so few vertices that relations between all of them can be looked at.

    Parameters
    ----------
    scene : Scene
    labels : frozenset of str or None
        Of the parcels that are built on, which this is about; None: all. Streets and water keep their shapes.
    problems : list of str
        Takes a sentence for every parcel that was simplified, or left out because that was not enough.

    Returns
    -------
    Scene
    """
    kept = []
    for p in scene.polygons:
        count = _count(p.rings)
        if count <= MOST_VERTICES or not (labels is None or p.label in labels):
            kept.append(p)
            continue
        made = _with_few_vertices(p)
        left = _count(made.rings)
        if left <= MOST_VERTICES:
            kept.append(made)
            problems.append(f"polygon {p.id!r} has {count} vertices and has been simplified to {left}")
        else:
            problems.append(
                f"polygon {p.id!r} has {count} vertices, {left} when simplified, and is left out; draw it with fewer"
            )
    return scene if kept == list(scene.polygons) else Scene(kept, scene.offset, scene.memory)


def _with_few_vertices(polygon: Polygon) -> Polygon:
    """A simplified polygon; an edge that takes the place of several keeps the label that these share."""
    shape = shapely.simplify(polygon.shape, SIMPLIFIED * polygon.size)
    ring = shapely.get_coordinates(shapely.orient_polygons(shape).exterior)[:-1]
    labels = None
    if any(polygon.segment_labels):
        places = {point: k for k, point in enumerate(map(tuple, polygon.points.tolist()))}
        kept = [places[point] for point in map(tuple, ring.tolist())]
        count = len(polygon.points)
        spans = [
            {polygon.segment_labels[k % count] for k in range(one, one + (other - one) % count)}
            for one, other in zip(kept, [*kept[1:], kept[0]], strict=True)
        ]
        labels = [span.pop() if len(span) == 1 else "" for span in spans]
    holes = [shapely.get_coordinates(hole)[:-1] for hole in shape.interiors]
    return Polygon(ring, polygon.label, polygon.id, holes, polygon.parent, polygon.orientation, labels)


def without_overlaps(scene: Scene, labels: frozenset[str] | None, problems: list[str]) -> Scene:
    """Parcels that do not overlap: where two do, the later one gives way.

    Parameters
    ----------
    scene : Scene
    labels : frozenset of str or None
        Of the parcels that are built on, which this is about; None: all.
    problems : list of str
        Takes a sentence for every parcel that was cut back, or left out because less than half of it would be left.
        A parcel inside another one is left alone, unless it is of the same label and more than half as large.

    Returns
    -------
    Scene
    """
    those = [i for i, p in enumerate(scene.polygons) if labels is None or p.label in labels]
    shapes = np.array([scene.polygons[i].shape for i in those])
    if len(shapes) < 2:
        return scene
    one, other = shapely.STRtree(shapes).query(shapes, predicate="intersects")
    pairs = [(a, b) for a, b in sorted(zip(one.tolist(), other.tolist(), strict=True)) if a < b]
    made = dict(enumerate(shapes))
    changed: dict[int, Polygon] = {}
    gone: set[int] = set()
    for a, b in pairs:
        if a in gone or b in gone:
            continue
        common = made[a].intersection(made[b]).area
        smaller = min(made[a].area, made[b].area)
        first, second = (scene.polygons[those[k]] for k in (a, b))
        inside = common >= LEAST_SIMPLE_SHARE * smaller
        twins = first.label == second.label and smaller > TWIN_SHARE * max(made[a].area, made[b].area)
        # What lies in another one altogether is its child, unless it is that one again; what hardly overlaps touches.
        if common <= TOUCHING_SHARE * smaller or (inside and not twins):
            continue
        # On a grid: edges that lie on one line but for rounding would leave spikes, which cross themselves.
        left = max(
            shapely.get_parts(shapely.difference(made[b], made[a], grid_size=SURFACE_GRID)),
            key=lambda part: part.area,
            default=shapely.Polygon(),
        )
        said = f"polygon {second.id!r} overlaps {first.id!r} by {common / made[b].area:.0%} of its area"
        if left.area < 0.5 * shapes[b].area:
            gone.add(b)
            problems.append(f"{said} and is left out; correct one of their outlines")
        else:
            made[b], changed[those[b]] = left, _with_shape(second, left)
            problems.append(f"{said} and has been cut back")
    dropped = {those[k] for k in gone}
    if not changed and not dropped:
        return scene
    kept = (changed.get(i, p) for i, p in enumerate(scene.polygons) if i not in dropped)
    return Scene(kept, scene.offset, scene.memory)


def _with_shape(polygon: Polygon, shape: shapely.Polygon) -> Polygon:
    """A polygon with another outline, whose edges keep the labels of the edges that they lie on."""
    ring = shapely.get_coordinates(shapely.orient_polygons(shape).exterior)[:-1]
    labels = None
    if any(polygon.segment_labels):
        old = [
            shapely.LineString(pair) for pair in zip(polygon.points, np.roll(polygon.points, -1, axis=0), strict=True)
        ]
        middles = shapely.points((ring + np.roll(ring, -1, axis=0)) / 2)
        away = np.array([shapely.distance(middles, line) for line in old])
        near = away.min(axis=0) <= ON_SAME_EDGE * polygon.size
        labels = [polygon.segment_labels[k] if ok else "" for k, ok in zip(away.argmin(axis=0), near, strict=True)]
    holes = [shapely.get_coordinates(hole)[:-1] for hole in shape.interiors]
    return Polygon(ring, polygon.label, polygon.id, holes, polygon.parent, polygon.orientation, labels)
