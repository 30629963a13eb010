"""The empty palace garden of figure 4.11: ``python sample_blends/garden.py --output garden.blend``."""

from __future__ import annotations

import sys
from pathlib import Path

import bpy
import numpy as np
import shapely

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))


from sample_blends import building, stage
from sample_blends.edits.edit import AnyEdit, GroupEdit
from sample_blends.edits.garden import EDITS
from sample_blends.library.meshes import add_solid
from sample_blends.library.regions import flat, standing
from sample_blends.library.solids import Solid, at_height, box, cylinder, extruded, joined, lathe, loft, sheet
from sample_blends.plans import garden as plan
from sample_blends.plans.outlines import inset, rectangle

EAVES = 9.0
KERB = 0.15
SOIL = 0.14


def lawns() -> Solid:
    """Grass of every garden parcel within a kerb."""
    pieces = []
    for parcel in plan.parcels():
        if parcel.label == "garden":
            outer = shapely.Polygon(parcel.ring)
            inner = outer.buffer(-KERB, join_style="mitre")
            finish = "fine lawn" if "outer" not in parcel.id and "palace" not in parcel.id else "lawn"
            pieces.append(flat(inner, 0.0, finish))
            pieces.append(standing(outer.difference(inner), -0.05, 0.05, "kerb", "kerb"))
    return joined(pieces)


def _facade_windows() -> list[Solid]:
    """Rows of tall windows on every wall of the palace."""
    parts = []
    ring = plan.WALLS
    for start, end in zip(ring, np.roll(ring, -1, axis=0), strict=True):
        along = (end - start) / np.linalg.norm(end - start)
        outwards = np.array((along[1], -along[0]))
        turn = np.degrees(np.arctan2(outwards[1], outwards[0]))
        length = float(np.linalg.norm(end - start))
        count = max(1, int((length - 1.5) // 2.6))
        for i in range(count):
            at = start + along * ((i + 0.5) * (length - 1.2) / count + 0.6)
            for z, height in ((1.3, 2.9), (5.6, 2.3)):
                window = joined(
                    (
                        box((0.16, 1.5, height + 0.3), (0.0, 0.0, z - 0.15), "marble", 0.02),
                        box((0.2, 1.14, height), (0.0, 0.0, z), "window glass", 0.0),
                        box((0.23, 0.07, height), (0.0, 0.0, z), "white lacquer", 0.0),
                        box((0.23, 1.14, 0.07), (0.0, 0.0, z + 0.62 * height), "white lacquer", 0.0),
                        box((0.34, 1.7, 0.14), (0.05, 0.0, z + height + 0.15), "marble", 0.02),
                    )
                )
                parts.append(window.turned(turn).moved(*at))
    return parts


def palace() -> Solid:
    """Two storeys about a court, a mansard roof, and a domed pavilion on the axis."""
    ring = plan.WALLS
    parts = [
        extruded(inset(ring, -0.25), 0.0, 0.9, "granite", 0.1),
        extruded(ring, 0.9, EAVES, "sandstone"),
        extruded(inset(ring, -0.18), 4.75, 5.05, "marble", 0.06),
        extruded(inset(ring, -0.5), EAVES - 0.35, EAVES + 0.1, "marble", 0.12),
        loft(
            [
                at_height(inset(ring, distance), z)
                for distance, z in ((-0.2, EAVES), (0.7, EAVES + 2.4), (0.9, EAVES + 2.5), (3.6, EAVES + 3.6))
            ],
            "roof slate",
        ),
        *_facade_windows(),
    ]
    for x in (-24.5, -20.5, -12.0, -7.8, 7.8, 12.0, 20.5, 24.5):
        y = 58.35 if abs(x) > 18 else 66.35
        parts.append(box((1.3, 1.0, 1.7), (x, y + 0.3, EAVES + 0.3), "sandstone", 0.05))
        parts.append(box((0.9, 0.1, 1.2), (x, y - 0.2, EAVES + 0.5), "window glass", 0.0))
        parts.append(box((1.6, 1.3, 0.25), (x, y + 0.3, EAVES + 2.0), "copper roof", 0.1))
    for x, y in ((-22.5, 72.0), (-13.0, 72.5), (13.0, 72.5), (22.5, 72.0)):
        parts.append(box((0.9, 1.4, 3.2), (x, y, EAVES + 2.2), "sandstone", 0.06))
        parts.append(box((1.1, 1.6, 0.2), (x, y, EAVES + 5.4), "granite", 0.03))
    return joined([*parts, _pavilion(), _outside_stairs()])


def _pavilion() -> Solid:
    body = rectangle(-5.0, 64.6, 5.0, 72.0)
    columns = [
        lathe([(0.5, 0.0), (0.5, 0.3), (0.36, 0.4), (0.32, 6.9), (0.44, 7.0), (0.5, 7.3)], "marble", 14, (x, 64.1, 0.9))
        for x in (-4.4, -2.2, 2.2, 4.4)
    ]
    pediment = loft([at_height(np.array([(-5.6, 8.9), (5.6, 8.9), (0.0, 11.4)]), z) for z in (0.0, 1.6)], "sandstone")
    gable = Solid(pediment.vertices[:, [0, 2, 1]] * (1, -1, 1), [f[::-1] for f in pediment.faces], pediment.materials)
    drum = [
        cylinder(4.2, 2.6, (0.0, 68.4, 11.2), "sandstone", 0.1, 28),
        cylinder(4.5, 0.35, (0.0, 68.4, 13.7), "marble", 0.1, 28),
        lathe(
            [(4.3, 0.0), (4.2, 0.9), (3.7, 2.2), (2.6, 3.5), (1.2, 4.3), (0.9, 4.5)],
            "copper roof",
            28,
            (0.0, 68.4, 14.0),
        ),
        lathe(
            [(0.85, 0.0), (0.8, 1.6), (1.0, 1.7), (0.5, 2.4), (0.12, 2.8), (0.05, 4.6), (0.0, 4.7)],
            "bright gold",
            12,
            (0.0, 68.4, 18.4),
        ),
    ]
    for i in range(8):
        window = box((0.2, 0.9, 1.7), (4.2, 0.0, 11.7), "window glass", 0.0)
        drum.append(window.turned(22.5 + 45 * i).moved(0.0, 68.4))
    return joined(
        [
            extruded(body, 0.0, 11.2, "sandstone"),
            extruded(rectangle(-5.6, 63.4, 5.6, 72.2), 8.2, 8.9, "marble", 0.1),
            extruded(rectangle(-5.6, 63.4, 5.6, 65.2), 0.0, 0.9, "granite", 0.05),
            gable.moved(0.0, 65.0, 0.0),
            *columns,
            box((1.9, 0.2, 4.0), (0.0, 64.55, 0.9), "walnut", 0.03),
            box((0.1, 0.26, 3.9), (0.0, 64.5, 0.9), "brass", 0.0),
            *drum,
        ]
    )


def _outside_stairs() -> Solid:
    return joined(
        box((7.0 + 0.7 * i, 0.45, 0.9 - 0.18 * i), (0.0, 63.2 - 0.4 * i, 0.0), "granite", 0.02) for i in range(5)
    )


def wall() -> Solid:
    """Low wall about the garden with a gate on the axis."""
    outer = shapely.Polygon(inset(plan.domain(), -1.2))
    ring = outer.difference(outer.buffer(-0.6, join_style="mitre"))
    gate = shapely.Polygon(rectangle(-4.0, plan.SOUTH - 2, 4.0, plan.SOUTH))
    parts = [standing(ring.difference(gate), -0.1, 1.5, "sandstone", "granite")]
    for x in (-4.6, 4.6):
        parts.append(box((1.2, 1.2, 2.8), (x, plan.SOUTH - 0.9, -0.1), "sandstone", 0.03))
        parts.append(box((1.5, 1.5, 0.3), (x, plan.SOUTH - 0.9, 2.7), "granite", 0.06))
        parts.append(
            lathe([(0.2, 0.0), (0.55, 0.5), (0.35, 0.95), (0.0, 1.1)], "granite", 16, (x, plan.SOUTH - 0.9, 3.0))
        )
    return joined(parts)


def height(edit: AnyEdit) -> float:
    """Flowers stand on the soil of their beds."""
    return SOIL if isinstance(edit, GroupEdit) or edit.asset == "red flower" else 0.0


def build(scene: bpy.types.Scene) -> np.ndarray:
    """Fill an empty scene; returns the points that a view must show."""
    holder = stage.collection(scene, "Grounds")
    add_solid("Gravel", sheet(inset(plan.domain(), -1.0), -0.03, "gravel"), holder)
    add_solid("Lawns", lawns(), holder)
    add_solid("Palace", palace(), holder)
    add_solid("Wall", wall(), holder)
    building.add_plan(scene, plan.plan(), height=0.02)
    stage.light(scene)
    corners = np.array(
        [(x, y, z) for x, y in plan.domain() for z in (0.0, 1.5)] + [(-27, 78, 13), (27, 78, 13), (0, 68, 20)]
    )
    stage.ground(scene, corners, "meadow", margin=90.0, z=-0.1)
    return corners


if __name__ == "__main__":
    building.run(build, __doc__, EDITS, height, elevation=46.0, lens=70.0, margin=0.01)
