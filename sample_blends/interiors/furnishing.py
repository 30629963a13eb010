"""Furnishing a storey: rooms by the edits of the apartment, kitchens by theirs; and what there is to see of it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import manifold3d
import numpy as np
import shapely

import geoanalogy as ga
from geoanalogy.geometry.boolean import combined
from geoanalogy.geometry.extrusion import FaceLabels, extrude
from geoanalogy.geometry.frame import Frame
from geoanalogy.geometry.mesh import Mesh
from geoanalogy.operations.applied import Applied
from geoanalogy.operations.element import Element

from ..kitchens.__main__ import HERE as KITCHENS
from ..pictures import library
from ..plans.outlines import rectangle
from .storey import HALF_WALL, Storey

HERE = Path(__file__).parent

#: The building and the rooms are cut open at this height above the floor.
CUT = 1.35

#: Finishes of the floors of rooms.
FLOORS = {"bedroom": "parquet", "living room": "dark parquet", "bathroom": "bath tiles", "corridor": "corridor carpet"}

#: Stairs, metres: rise and tread of a step, width of a flight, and the widest hall that is a staircase: wider ones lead
#: to a wing.
RISE, TREAD, FLIGHT, STAIRCASE = 0.17, 0.28, 1.3, 6.0


def furnish(storey: Storey, seed: int = 0) -> tuple[Applied, Applied]:
    """Furniture for the rooms of a storey, and its kitchens, in the storey's own frame.

    What is placed are the objects of the library: nothing is drawn for this building.
    """
    things = library()
    rooms = ga.OperationsTree.load(HERE / "apartment.json").apply(storey.plan(), seed, library=things)
    tree = ga.OperationsTree.load(KITCHENS / "kitchens.json")
    return rooms, tree.apply(storey.kitchens(), seed, library=things)


def opened(building: Element, storey: Storey) -> Mesh:
    """A building without what is above the cut, and without what was inside the outer walls over the storey's floor."""
    assert building.solid is not None
    solid = building.solid
    outer = shapely.box(0, 0, storey.width, storey.depth).buffer(100.0, join_style="mitre")
    inner = shapely.box(0, 0, storey.width, storey.depth)
    for k, (shape, low) in enumerate(((outer, CUT), (inner, 0.0))):
        ring = shapely.get_coordinates(shapely.orient_polygons(shape).exterior)[:-1]
        cut = extrude(ga.Polygon(ring), 200.0, FaceLabels("wall", "wall", "wall cut")).renamed(f"cut {k}")
        frame = storey.frame.seen_from(building.place)
        raised = Frame(tuple(frame.to_space([(0.0, 0.0, low)])[0].tolist()), frame.x, frame.y)
        solid = combined(solid, [(cut, raised)], "subtract")
    return solid.mesh.placed(building.place)


def walls(storey: Storey) -> Iterator[Mesh]:
    """Inner walls, cut open, and floors, in the storey's own frame."""
    rooms = [(label, shapely.box(*box)) for label, box, _ in storey.rooms()]
    halls = [shapely.box(*box) for box in storey.halls()]
    clear = [shapely.box(*storey.corridor), *halls, *(shape for _, shape in rooms)]
    thick = [shape.buffer(2 * HALF_WALL, join_style="mitre") for label, shape in rooms if label not in FLOORS]
    ways = []
    half = storey.corridor[1] - HALF_WALL
    for label, (x0, _, x1, _), front in storey.openings():
        if label == "door":
            y = half if front else storey.depth - half
            ways.append(shapely.box(x0, y - 2 * HALF_WALL, x1, y + 2 * HALF_WALL))
    solid = shapely.box(0, 0, storey.width, storey.depth) - shapely.union_all([*clear, *thick, *ways])
    for part in shapely.get_parts(solid):
        rings = [shapely.get_coordinates(ring)[:-1] for ring in (part.exterior, *part.interiors)]
        body = extrude(ga.Polygon(rings[0], holes=rings[1:]), CUT, FaceLabels("wall", "wall cut", "wall"))
        yield body.mesh
    way = shapely.box(*storey.corridor).buffer(2 * HALF_WALL, join_style="mitre")  # to the thresholds
    for label, shape in (("corridor", way), *(("corridor", hall) for hall in halls), *rooms):
        if label in FLOORS:
            labels = FaceLabels(FLOORS[label], FLOORS[label], FLOORS[label])
            # Ways below rooms, where both lie; and halls between.
            height = {"corridor": 0.005 if shape is way else 0.0075}.get(label, 0.01)
            yield extrude(ga.Polygon(rectangle(*shape.bounds)), height, labels).mesh


def stairs(storey: Storey) -> Iterator[Mesh]:
    """Flights in the middle of its halls, towards a wall, as far as they are not cut off; in its own frame."""
    count = int(CUT / RISE)
    for x0, y0, x1, y1 in storey.halls():
        if x1 - x0 > STAIRCASE:
            continue
        middle = (y0 + y1) / 2
        for k in range(count):
            x = x0 + TREAD * (count - 1 - k)
            step = ga.Polygon(rectangle(x, middle - FLIGHT / 2, x + TREAD, middle + FLIGHT / 2))
            yield extrude(step, RISE * (k + 1), FaceLabels("granite", "plaster cream", "granite")).mesh


def below(mesh: Mesh, height: float) -> Mesh | None:
    """What of closed bodies lies below a height, the cut closed; None for nothing."""
    if mesh.vertices[:, 2].max() <= height:
        return mesh
    low, high = mesh.vertices.min(axis=0) - 1.0, mesh.vertices.max(axis=0) + 1.0
    if low[2] + 1.0 >= height:
        return None
    body = manifold3d.Manifold(_native(mesh.vertices, mesh.faces, mesh.material_index))
    block = extrude(ga.Polygon(rectangle(*low[:2], *high[:2])), high[2] - height)
    count = len(mesh.materials)
    above = _native(
        block.vertices + np.array((0.0, 0.0, height)), block.triangles, np.full(len(block.triangles), count)
    )
    left = (body - manifold3d.Manifold(above)).to_mesh64()
    triangles = np.asarray(left.tri_verts, dtype=np.intp)
    points = np.asarray(left.vert_properties)[:, :3]
    materials = (*mesh.materials, "wall cut")
    return Mesh(points, triangles, points[triangles][:, :, :2], materials, np.asarray(left.face_id, dtype=np.intp))


def _native(vertices: np.ndarray, triangles: np.ndarray, face: np.ndarray) -> manifold3d.Mesh64:
    plain = [np.ascontiguousarray(values, dtype=np.uint64) for values in (triangles, face)]
    return manifold3d.Mesh64(np.ascontiguousarray(vertices), plain[0], face_id=plain[1])
