"""Pictures of kitchens: seen from above, the walls towards the viewer cut down; needs Blender.

python -m sample_blends.kitchens.drawing --tree TREE.json --rooms ROOMS.geojson --output PICTURE.png [--turn DEGREES …]
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Collection, Iterator
from pathlib import Path

import numpy as np
import shapely

import geoanalogy as ga
from geoanalogy.geometry.boolean import combined
from geoanalogy.geometry.extrusion import FaceLabels, extrude
from geoanalogy.geometry.frame import Frame
from geoanalogy.geometry.mesh import Mesh
from geoanalogy.operations.applied import with_geometry
from geoanalogy.operations.element import Element

from ..pictures import draw, finished, library
from .rooms import KITCHEN

#: Finish of a face by the last word of its label that is found here.
FINISHES = {
    "wall": "wall",
    "outside": "wall",
    "reveal": "wall",
    "rim": "wall cut",
    "cut": "wall cut",
    "floor": "kitchen tiles",
    "run": "sage lacquer",
    "front": "dark lacquer",
    "plinth": "dark lacquer",
    "worktop": "worktop",
    "edge": "worktop",
    "side": "white lacquer",
    "cabinet": "cream lacquer",
    "splash": "bath tiles",
    "glass": "daylight",
    "sill": "white lacquer",
    "upright": "white lacquer",
    "crossbar": "white lacquer",
    "casing": "white lacquer",
    "leaf": "birch",
    "panelling": "oak",
}

#: Walls towards the viewer are cut down to this height, and what hangs on them reaches so far into the room.
PARAPET, HANGING = 0.95, 0.56

#: Wall cabinets: how far they come out, and the heights that they lie between.
CABINETS = (0.36, 1.38, 2.2)

#: What stands in a corner between two walls hides nothing.
CORNER = 0.66

#: How far sills stand out of walls.
SILL = 0.06

#: Thickness that is certainly more than that of a wall.
WALL = 0.3


def near_edges(room: ga.Polygon, towards: np.ndarray) -> list[tuple[np.ndarray, np.ndarray]]:
    """The ends of those edges of a room whose walls stand between it and the viewer."""
    found = []
    for a, b in zip(room.points, np.roll(room.points, -1, axis=0), strict=True):
        outwards = np.array([b[1] - a[1], a[0] - b[0]]) / np.hypot(*(b - a))
        if outwards @ towards > 0.1:
            found.append((a, b))
    return found


def opened(element: Element, room: ga.Polygon, towards: np.ndarray, standing: shapely.Geometry) -> Element:
    """The solid of a room, its walls towards the viewer cut down and without the cabinets that hang on them.

    ``standing`` is what stands in front of walls, in plan, and stays.
    """
    assert element.solid is not None
    solid = element.solid
    near = near_edges(room, towards)
    starts, ends = ({tuple(np.round(edge[k], 6)) for edge in near} for k in (0, 1))
    for k, (a, b) in enumerate(near):
        along = (b - a) / np.hypot(*(b - a))
        inwards = np.array([-along[1], along[0]])
        out, sill, reach = WALL * inwards, SILL * inwards, CABINETS[0] * inwards
        past = 0.13 * along
        wall = shapely.Polygon([a - out - past, b - out + past, b + past + sill, a - past + sill])
        # Where the next wall is seen from inside, what hangs on that reaches into the corner.
        low = a if tuple(np.round(a, 6)) in ends else a + CORNER * along
        high = b if tuple(np.round(b, 6)) in starts else b - CORNER * along
        hung = shapely.Polygon([low, high, high + reach, low + reach]).difference(standing)
        parts = [(wall, PARAPET, 9.0)]
        if (high - low) @ along > CORNER:
            parts += [(part, *CABINETS[1:]) for part in shapely.get_parts(hung) if part.area > 1e-3]
        for n, (shape, bottom, top) in enumerate(parts):
            ring = shapely.get_coordinates(shapely.orient_polygons(shape).exterior)[:-1]
            inside = element.place.to_plane(np.column_stack([ring, np.zeros(len(ring))]))[:, :2]
            cut = extrude(ga.Polygon(inside), top - bottom, FaceLabels("cut", "cut", "cut")).renamed(f"cut {k} {n}")
            solid = combined(solid, [(cut, Frame(origin=(0.0, 0.0, bottom)))], "subtract")
    return element.changed(solid=solid)


def hidden(element: Element, points: np.ndarray, room: ga.Polygon, towards: np.ndarray) -> bool:
    """Whether an element hangs on a wall that has been cut down."""
    if points[:, 2].max() < PARAPET:
        return False
    for a, b in near_edges(room, towards):
        along = (b - a) / np.hypot(*(b - a))
        inwards = np.array([-along[1], along[0]])
        depth = (points[:, :2] - a) @ inwards
        if element.frame.normal[:2] @ inwards > 0.9 and depth.min() > -WALL and depth.max() < HANGING:
            return True
    return False


def _room_of(element: Element, rooms: Collection[str]) -> str:
    return next(id for id in rooms if id == element.parent or id in element.surface or id in element.id)


def meshes(applied: ga.operations.applied.Applied, rooms: ga.Scene, towards: np.ndarray) -> Iterator[Mesh]:
    """What is to be seen from a direction in plan, in space."""
    things = library()
    by_id = {str(room.id): room for room in rooms.polygons}
    talls: dict[str, list[shapely.Geometry]] = {}
    for e in applied.layout.elements:
        if e.label == "tall" and e.solid is not None:
            corners = e.place.to_space(e.solid.vertices)[:, :2]
            talls.setdefault(_room_of(e, by_id), []).append(shapely.MultiPoint(corners).convex_hull.buffer(0.01))
    for e in applied.layout.elements:
        if e.absorbed_by:
            continue
        room = by_id[_room_of(e, by_id)]
        if e.label == KITCHEN and e.solid is not None:
            e = opened(e, room, towards, shapely.union_all(talls.get(str(room.id), [])))
        mesh = with_geometry(e, things).mesh
        if isinstance(mesh, Mesh) and not (e.owner and hidden(e, mesh.vertices, room, towards)):
            yield finished(mesh, FINISHES, "wall")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tree", type=Path, required=True)
    parser.add_argument("--rooms", type=Path, required=True)
    parser.add_argument("--output", type=Path, required=True)
    parser.add_argument("--turn", type=float, nargs="+", default=[-82.0, 98.0])
    parser.add_argument("--seed", type=int, default=7)
    parser.add_argument("--only", nargs="*", help="ids of the rooms (default: all)")
    parser.add_argument("--size", type=int, nargs=2, default=(2000, 1500))
    parser.add_argument("--samples", type=int, default=24)
    arguments = parser.parse_args()
    rooms = ga.read_scene(arguments.rooms)
    if arguments.only:
        rooms = ga.Scene([room for room in rooms.polygons if room.id in arguments.only])
    applied = ga.OperationsTree.load(arguments.tree).apply(rooms, arguments.seed)
    for k, turn in enumerate(arguments.turn):
        name = arguments.output if not k else arguments.output.with_stem(f"{arguments.output.stem}-{k + 1}")
        towards = np.array([np.cos(np.radians(turn)), np.sin(np.radians(turn))])
        seen = list(meshes(applied, rooms, towards))
        draw(seen, name, turn, 56.0, tuple(arguments.size), arguments.samples, ("hall stone", -0.14))
    return 0


if __name__ == "__main__":
    sys.exit(main())
