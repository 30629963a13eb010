"""Furnish one storey of a condominium, and draw the building cut open above it; drawing needs Blender.

python -m sample_blends.interiors --output PICTURE.png [--plot "plot 03"] [--storey 1] [--turn DEGREES …]
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from pathlib import Path

import geoanalogy as ga
from geoanalogy.geometry.frame import Frame
from geoanalogy.geometry.mesh import Mesh
from geoanalogy.operations.applied import Applied

from ..kitchens.drawing import FINISHES as KITCHEN_FINISHES
from ..pictures import draw, finished
from .furnishing import CUT, below, furnish, opened, stairs, walls
from .storey import HEIGHT, Storey

HOUSES = Path(__file__).resolve().parents[1] / "houses"

#: How far the lowest floor of a condominium lies above the ground.
PLINTH = 0.25

#: How far the floors of rooms lie above that of the storey, so that both can be drawn.
CLEAR = 0.01

#: Finishes of the building by the last words of its labels.
FINISHES = {
    "wall": "plaster cream",
    "glass": "night glass",
    "roof": "roof slate",
    "sill": "sandstone",
    "cornice": "sandstone",
    "reveal": "sandstone",
    "upright": "white lacquer",
    "crossbar": "white lacquer",
    "door": "walnut",
    "canopy": "granite",
    "balcony": "granite",
    "hedge": "box leaf",
    "parking": "granite",
    "drive": "granite",
    "walk": "sandstone",
}


def condominium(plot: str, seed: int) -> Applied:
    """What the houses' tree builds on one of their plots."""
    every = ga.read_scene(HOUSES / "plots.geojson")
    scene = ga.Scene([p for p in every.polygons if p.id == plot and p.label == "condominium"])
    if not scene.polygons:
        raise ga.InputError(f"there is no plot {plot!r} for a condominium; choose another one")
    return ga.OperationsTree.load(HOUSES / "condominium.json").apply(scene, seed)


def meshes(applied: Applied, number: int, seed: int) -> Iterator[Mesh]:
    """The building up to a storey, and what furnishes that."""
    block = next(e for e in applied if e.label == "block")
    storey = Storey.of(block, PLINTH + HEIGHT * number, applied)
    level = storey.frame.origin[2]
    yield finished(opened(block, storey), FINISHES, "plaster cream")
    for e in applied:
        if e is not block and isinstance(e.mesh, Mesh) and e.mesh.vertices[:, 2].max() < level + CUT:
            yield finished(e.mesh, FINISHES, "plaster cream")
    furniture, kitchens = furnish(storey, seed)
    x, y, z = storey.frame.origin
    floor = Frame((x, y, z + CLEAR), storey.frame.x, storey.frame.y)
    pieces = [m for e in furniture if isinstance(m := e.mesh, Mesh)]
    cut = (below(m, CUT) for e in kitchens if isinstance(m := e.mesh, Mesh))
    for mesh in (*walls(storey), *stairs(storey), *pieces, *(m for m in cut if m is not None)):
        yield finished(mesh.placed(floor), KITCHEN_FINISHES, "wall")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--output", type=Path, required=True)
    parser.add_argument("--plot", default="plot 03")
    parser.add_argument("--storey", type=int, default=1, help="0 is the lowest")
    parser.add_argument("--seed", type=int, default=7)
    parser.add_argument("--turn", type=float, nargs="+", default=[-70.0])
    parser.add_argument("--size", type=int, nargs=2, default=(1800, 1200))
    parser.add_argument("--samples", type=int, default=24)
    arguments = parser.parse_args()
    seen = list(meshes(condominium(arguments.plot, arguments.seed), arguments.storey, arguments.seed))
    points = seen[0].vertices
    for k, turn in enumerate(arguments.turn):
        name = arguments.output if not k else arguments.output.with_stem(f"{arguments.output.stem}-{k + 1}")
        draw(seen, name, turn, 48.0, tuple(arguments.size), arguments.samples, ("lawn", -0.03), seen=points)
    return 0


if __name__ == "__main__":
    sys.exit(main())
