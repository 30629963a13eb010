"""Render every asset of a family on one sheet: ``python -m sample_blends.contact_sheet garden --output garden.png``."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import bpy
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from sample_blends import stage
from sample_blends.library import ASSETS, Asset
from sample_blends.library.materials import material
from sample_blends.library.meshes import add_asset, add_solid
from sample_blends.library.solids import sheet


def arranged(assets: list[Asset], width: float, gap: float) -> list[tuple[float, float]]:
    """Positions that set the assets in rows of about ``width``, in order."""
    positions = []
    x = y = 0.0
    deep = 0.0
    for item in assets:
        points = np.vstack((item.footprint, item.solid().vertices[:, :2]))
        # Fronts look at the viewer and a little aside: the sheet is seen along +y.
        (left, low), (right, high) = points.min(axis=0), points.max(axis=0)
        wide = max(right - left, high - low)
        # A tall thing hides what stands behind it.
        tall = wide + 0.8 * float(item.solid().vertices[:, 2].max())
        if x > 0 and x + wide > width:
            x, y, deep = 0.0, y - deep - gap, 0.0
        positions.append((x + wide / 2, y - tall + wide / 2))
        x, deep = x + wide + gap, max(deep, tall)
    return positions


def contact_sheet(
    assets: list[Asset], output: Path, width: float, gap: float, samples: int, names: bool = True
) -> None:
    """Render the assets to a PNG."""
    scene = stage.clear()
    assets = sorted(assets, key=lambda item: -float(np.ptp(item.solid().vertices, axis=0).max()))
    holder = stage.collection(scene, "Assets")
    corners = []
    for item, (x, y) in zip(assets, arranged(assets, width, gap), strict=True):
        add_asset(item, holder, (x, y), angle=np.radians(-62.0))
        span = item.solid().vertices
        reach = float(np.abs(span[:, :2]).max())
        height = float(span[:, 2].max())
        corners += [(x + sx * reach, y + sy * reach, z) for sx in (-1, 1) for sy in (-1, 1) for z in (0.0, height)]
        if names:
            text = bpy.data.curves.new(item.name, "FONT")
            text.body = item.name
            text.align_x = "CENTER"
            text.size = 0.3 * gap
            text.materials.append(material("dark lacquer"))
            tag = bpy.data.objects.new(item.name, text)
            tag.location = (x, y - reach - 0.35 * gap, 0.002 * gap)
            holder.objects.link(tag)
        foot = add_solid(f"{item.name} footprint", sheet(item.footprint, 0.001 * gap, "kerb"), holder)
        foot.location = (x, y, 0.0)
        foot.rotation_euler = (0.0, 0.0, np.radians(-62.0))
    points = np.array(corners)
    stage.settings(scene, 1500, 1500, samples)
    # Seen at an angle, depth is foreshortened.
    tall = 0.75 * np.ptp(points[:, 1]) + 0.67 * np.ptp(points[:, 2])
    scene.render.resolution_y = int(np.clip(1500 * tall / np.ptp(points[:, 0]), 600, 2000))
    stage.light(scene)
    stage.ground(scene, points, "wall", z=-0.001 * gap)
    stage.camera(scene, points, elevation=48.0, lens=None, margin=0.02)
    stage.render(scene, output)


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("family", help="furniture, garden, crown, or a comma-separated list of asset names")
    parser.add_argument("--output", type=Path, required=True)
    parser.add_argument("--samples", type=int, default=24)
    parser.add_argument("--width", type=float, default=0.0, help="width of a row in metres; 0 for a square sheet")
    arguments = parser.parse_args(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else None)
    names = arguments.family.split(",")
    assets = [item for item in ASSETS.values() if item.family in names or item.name in names]
    spans = [float(np.ptp(item.solid().vertices[:, :2], axis=0).max()) for item in assets]
    gap = 0.3 * float(np.mean(spans))
    width = arguments.width or 1.15 * float(np.sqrt(sum((span + gap) ** 2 for span in spans)))
    contact_sheet(assets, arguments.output, width, gap, arguments.samples)


if __name__ == "__main__":
    main()
