"""The empty crowns of figure 4.12: ``python sample_blends/crowns.py --output crowns.blend``.

The unrolled outlines lie on the table as sheets of gold; behind them stand the crowns, onto which :func:`place_on` maps
what lies on the sheets.
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
from sample_blends.edits.crowns import EDITS
from sample_blends.library import ASSETS
from sample_blends.library.meshes import add_solid
from sample_blends.library.solids import Solid, at_height, cushion, ellipsoid, joined, loft, sheet, tube
from sample_blends.plans import crowns as plan
from sample_blends.plans.crowns import CROWNS, Crown

GOLD_THICKNESS = 0.0016
# Where the crowns stand: behind the sheets, so that both are seen; heights of the cushions' tops below them.
STANDS = {"royal crown": (0.13, 0.53), "ducal crown": (0.42, 0.53)}
CUSHION = 0.055
LEVELS = 16
# Height of the goldsmith's band's middle; below it there is room for a row of pearls.
BAND = 0.0224


def stand(crown: Crown) -> np.ndarray:
    """Position of the middle of the crown's base."""
    return np.array((*STANDS[crown.id], CUSHION + 0.001))


def place_on(crown: Crown, x: float, y: float, direction: float, height: float = 0.0) -> Matrix:
    """Placement in the scene, on the standing crown, of what lies at (x, y) on its unrolled sheet."""
    placed = crown.frame(x, y, direction, height)
    placed[:3, 3] += stand(crown)
    return Matrix(placed.tolist())


def crown_surface(crown: Crown) -> Solid:
    """The wall of gold: outside, inside and rim, about the crown's axis."""
    rim = crown.rim()[:-1]
    levels = np.linspace(0.0, 1.0, LEVELS)
    flat = rim[:, None, :] * np.stack((np.ones(LEVELS), levels), axis=1)
    points = flat.reshape(-1, 2) + crown.origin
    outside = crown.rolled(points)
    inside = crown.rolled(points, -GOLD_THICKNESS)
    count = len(rim)
    vertices = np.vstack((outside, inside))
    back = count * LEVELS
    faces = []
    for i in range(count):
        a, b = i * LEVELS, (i + 1) % count * LEVELS
        for k in range(LEVELS - 1):
            faces.append((a + k, b + k, b + k + 1, a + k + 1))
            faces.append((back + a + k, back + a + k + 1, back + b + k + 1, back + b + k))
        top = LEVELS - 1
        faces.append((a + top, b + top, back + b + top, back + a + top))
        faces.append((a, back + a, back + b, b))
    return Solid(vertices, faces, ["brushed gold"] * len(faces))


def _edging(crown: Crown) -> Solid:
    """Beaded wires along the rim and about the base."""
    rim = crown.rim()[:-1] + crown.origin
    wire = tube(crown.rolled(rim, -GOLD_THICKNESS / 2), 0.0016, "bright gold", 8, closed=True)
    x = np.linspace(0.0, crown.length, 121)[:-1]
    rings = []
    for y, radius in ((0.0, 0.0026), (0.0122, 0.0013), (0.0326, 0.0016)):
        line = np.column_stack((x, np.full(len(x), y))) + crown.origin
        rings.append(tube(crown.rolled(line, 0.0), radius, "bright gold", 8, closed=True))
    return joined((wire, *rings))


def _velvet(crown: Crown) -> Solid:
    """The cap inside."""
    r = crown.radius - 0.004
    cap = ellipsoid((r, r, 0.075), (0.0, 0.0, 0.012), "velvet", 40, 16)
    puffs = 1 + 0.05 * np.abs(np.sin(4 * np.arctan2(cap.vertices[:, 1], cap.vertices[:, 0])))
    vertices = np.maximum(cap.vertices * np.column_stack((puffs, puffs, puffs)) * (0.95, 0.95, 1.0), (-1, -1, 0.002))
    return Solid(vertices, cap.faces, cap.materials)


def _pillow(crown: Crown) -> Solid:
    """The cushion on which it stands, with tassels."""
    size = 2.7 * crown.radius
    pad = cushion((size, size, CUSHION), (0.0, 0.0, 0.0), "velvet", 0.026, segments=4, puff=0.002)
    cord = [
        (sx * (size / 2 - 0.004), sy * (size / 2 - 0.004), CUSHION / 2)
        for sx, sy in ((1, 1), (-1, 1), (-1, -1), (1, -1))
    ]
    tassels = []
    for x, y, z in cord:
        tassels.append(ellipsoid((0.007, 0.007, 0.007), (x, y, z), "bright gold", 10, 8))
        out = np.array((x, y)) / np.hypot(x, y)
        tassels.append(
            tube(
                [
                    (x, y, z),
                    (x + 0.014 * out[0], y + 0.014 * out[1], z - 0.008),
                    (x + 0.02 * out[0], y + 0.02 * out[1], 0.003),
                ],
                (0.004, 0.006, 0.009),
                "bright gold",
                10,
            )
        )
    return joined((pad, *tassels))


def _base_band(crown: Crown) -> Solid:
    """Pieces of the goldsmith's band bent about the base."""
    piece = ASSETS["gold band"].solid()
    count = round(crown.length / 0.02)
    pieces = []
    for i in range(count):
        along = (i + 0.5) * crown.length / count
        # The piece's +X is up the wall, its +Y along it; its height stands off the gold.
        x = crown.origin[0] + along - piece.vertices[:, 1] * crown.length / count / 0.02
        y = crown.origin[1] + BAND + piece.vertices[:, 0] * 0.9
        pieces.append(
            Solid(crown.rolled(np.column_stack((x, y)), piece.vertices[:, 2] * 0.7), piece.faces, piece.materials)
        )
    return joined(pieces)


def unrolled_sheet(crown: Crown) -> Solid:
    """The outline as a thin sheet of gold on the table."""
    outline = crown.outline()
    return loft([at_height(outline, -GOLD_THICKNESS), at_height(outline, 0.0)], "brushed gold")


def set_gems(scene: bpy.types.Scene) -> None:
    """Set a copy of every gem that lies on a sheet onto the standing crown that the sheet rolls up to."""
    holder = stage.collection(scene, "Set")
    for lying in building.examples_and_results(scene):
        x, y, _ = lying.location
        crown = next(c for c in CROWNS if shapely.Polygon(c.outline()).buffer(0.01).contains(shapely.Point(x, y)))
        gem = bpy.data.objects.new(lying.name, lying.data)
        holder.objects.link(gem)
        gem.matrix_world = place_on(crown, x, y, lying.rotation_euler.z) @ Matrix.Diagonal((*lying.scale, 1.0))


def build(scene: bpy.types.Scene) -> np.ndarray:
    """Fill an empty scene; returns the points that a view must show."""
    scene.unit_settings.length_unit = "MILLIMETERS"
    holder = stage.collection(scene, "Crowns")
    points = []
    for crown in CROWNS:
        add_solid(f"{crown.id} sheet", unrolled_sheet(crown), holder)
        body = joined((crown_surface(crown), _edging(crown), _base_band(crown)))
        for name, solid in ((crown.id, body), (f"{crown.id} cap", _velvet(crown))):
            add_solid(name, solid, holder).location = stand(crown)
        add_solid(f"{crown.id} cushion", _pillow(crown), holder).location = (*STANDS[crown.id], 0.0)
        top = stand(crown) + np.array((0.0, 0.0, crown.height))
        reach = 1.4 * crown.radius
        points += [top + np.array((x, y, 0.0)) for x in (-reach, reach) for y in (-reach, reach)]
        points += [(x, y, 0.0) for x, y in crown.outline()]
    building.add_plan(scene, plan.plan(), height=0.0002)
    stage.light(scene, sun=2.2, sky=0.6, softness=12.0)
    # Gold shows what it mirrors: bright panes before it and to its side.
    middle = np.array((0.28, 0.45, 0.08))
    stage.softbox(scene, middle + np.array((-0.5, -1.5, 0.55)), middle, 0.9, 16.0)
    stage.softbox(scene, middle + np.array((1.1, -0.6, 0.8)), middle, 0.7, 8.0)
    points = np.array(points)
    table = sheet(np.array([(-4.0, -4.0), (4.5, -4.0), (4.5, 5.0), (-4.0, 5.0)]), -GOLD_THICKNESS, "cloth")
    add_solid("Table", table, stage.collection(scene, "Stage"))
    return points


if __name__ == "__main__":
    building.run(build, __doc__, EDITS, finish=set_gems, elevation=38.0, lens=70.0, margin=0.03)
