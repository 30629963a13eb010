"""Record the three types of houses, apply them to thirty other plots, and draw the result.

python -m sample_blends.houses [--output FOLDER] [--seed N] [--draw]

Writes TYPE.json, the operations tree of each type, and plots.geojson, the plots they are applied to.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

import numpy as np

import geoanalogy as ga
from geoanalogy.geometry.extrusion import triangulated

from . import condominium, one_storey, two_storey
from .plots import TYPES, quarter, recorded
from .recorder import Recorder

HERE = Path(__file__).parent
RECORDS = {"one-storey": one_storey.record, "two-storey": two_storey.record, "condominium": condominium.record}


def tree(label: str) -> ga.OperationsTree:
    """The operations tree of a type, recorded anew."""
    recorder = Recorder(recorded(label))
    RECORDS[label](recorder)
    return recorder.tree


def _lawns(scene: ga.Scene) -> list[ga.Mesh]:
    made = []
    for polygon in scene.polygons:
        faces = triangulated([polygon.points])
        flat = np.column_stack([polygon.points, np.full(len(polygon.points), -0.02)])
        uv, index = polygon.points[faces], np.zeros(len(faces), dtype=np.intp)
        made.append(ga.Mesh(flat, faces, uv, ("lawn",), index))
    return made


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--output", type=Path, default=HERE, help="folder of the trees and the plots")
    parser.add_argument("--seed", type=int, default=7)
    parser.add_argument("--draw", action="store_true", help="apply them and draw houses.png and gardens.png as well")
    arguments = parser.parse_args()
    scene = quarter()
    ga.write_scene(scene, arguments.output / "plots.geojson")
    meshes = _lawns(scene)
    for label in TYPES:
        start = time.perf_counter()
        made = tree(label)
        made.save(arguments.output / f"{label}.json")
        print(f"{label}: {len(made.nodes)} operations recorded in {time.perf_counter() - start:.1f} s")
        if arguments.draw:
            start = time.perf_counter()
            applied = made.apply(scene, arguments.seed)
            meshes += [e.mesh for e in applied if isinstance(e.mesh, ga.Mesh)]
            print(*applied.problems, sep="\n", end="\n" if applied.problems else "")
            print(f"  {len(applied)} elements in {time.perf_counter() - start:.1f} s")
    if arguments.draw:
        from .preview import draw

        x0, y0, x1, y1 = scene.bounds
        middle = ((x0 + x1) / 2, (y0 + y1) / 2, 0.0)
        for name, turn in (("houses.png", -70.0), ("gardens.png", 115.0)):
            draw(meshes, arguments.output / name, middle, turn, 32.0, 0.8 * (x1 - x0), (3000, 1300))
    return 0


if __name__ == "__main__":
    sys.exit(main())
