"""A street of bare facades, dressed by eleven edits: ``python sample_blends/street.py --edits --output street.blend``.

Two houses are shown where parts belong; the operations tree takes them to the other six, on facades of other widths,
heights and directions.
"""

from __future__ import annotations

import sys
from pathlib import Path

import bpy
import numpy as np
import shapely
from mathutils import Matrix

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from sample_blends import building, stage
from sample_blends.edits.street import EDITS
from sample_blends.library.meshes import add_solid, mesh_of
from sample_blends.library.solids import Solid, at_height, box, joined, loft, sheet
from sample_blends.plans import street as plan
from sample_blends.plans.outlines import rectangle

EAVES, PAVEMENT, KERB = 0.35, 4.0, 0.14


def body(house: plan.House) -> Solid:
    """Walls and roof, in the facade's coordinates but upright: x along it, y into the house, z up."""
    w, h, d = house.width, house.height, plan.DEPTH
    # A hand's breadth narrower than the facade, so that neighbours of other directions do not show through.
    walls = box((w, d, h), (w / 2, d / 2, 0.0), house.finish, 0.0)
    rise = 0.3 * d
    profile = [(-EAVES, h - 0.02), (d + EAVES, h - 0.02), (d + EAVES, h + 0.12), (d / 2, h + rise), (-EAVES, h + 0.12)]
    ends = [np.array([(x, y, z) for y, z in profile]) for x in (0.02, w - 0.02)]
    chimney = box((0.7, 0.5, 1.6), (0.75 * w, 0.6 * d, h + 0.55 * rise), "plaster brick", 0.0)
    return joined((walls, loft(ends, house.roof), chimney))


def pavement() -> Solid:
    """The pavement along the facades, with its kerb."""
    feet = []
    for house in plan.HOUSES:
        frame = plan.frames()[house.id]
        feet += [frame[:2, 3], frame[:2, 3] + house.width * frame[:2, 0]]
    line = shapely.LineString([feet[0] - (12.0, 3.0), *feet, feet[-1] + (9.0, -5.0)])
    # Its kerb does not step back with single houses.
    ring = shapely.get_coordinates(line.simplify(1.0).buffer(PAVEMENT, cap_style="flat", join_style="mitre").exterior)[
        :-1
    ]
    ring = ring if shapely.LinearRing(ring).is_ccw else ring[::-1]
    return loft([at_height(ring, z) for z in (-KERB, 0.0)], "pavement")


def build(scene: bpy.types.Scene) -> np.ndarray:
    """Fill an empty scene; returns the points that a view must show."""
    holder, walls = stage.collection(scene, "Houses"), stage.collection(scene, building.PLAN)
    points = []
    for house in plan.HOUSES:
        frame = Matrix(plan.frames()[house.id].tolist())
        upright = frame @ Matrix.Rotation(-np.pi / 2, 4, "X")
        add_solid(f"{house.id} walls", body(house), holder).matrix_world = upright
        ring = rectangle(0.0, 0.0, house.width, house.height)
        facade = bpy.data.objects.new(house.id, mesh_of(house.id, sheet(ring, 0.0, "plan")))
        facade.matrix_world = frame
        facade["ga_label"] = "facade"
        facade.display_type = "WIRE"
        facade.hide_render = True
        walls.objects.link(facade)
        points += [frame @ facade.data.vertices[k].co for k in range(4)]
    corners = np.array(points)
    add_solid("Pavement", pavement(), holder)
    stage.light(scene)
    stage.ground(scene, corners, "granite", z=-KERB)
    front, roofs = corners * (1.0, 1.0, 0.0) - np.array((0.0, PAVEMENT / 2, 0.0)), corners + np.array((0.0, 1.0, 2.0))
    return np.vstack((corners, front, roofs))


if __name__ == "__main__":
    building.run(build, __doc__, EDITS, picture=(1800, 640), elevation=7.0, turn=-92.0, lens=42.0, margin=0.01)
