"""Pictures of skyscrapers, each of a stone of its own; needs Blender.

python -m sample_blends.skyscrapers.drawing --output PICTURE.png [--turn DEGREES …]
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from pathlib import Path

import geoanalogy as ga
from geoanalogy.geometry.mesh import Mesh, joined
from geoanalogy.operations.chance import share

from ..pictures import draw, finished
from .__main__ import HERE, SEED, grown
from .streets import surroundings

#: Finish of a face by the last word of its label that is found here; "" is the stone of the building.
FINISHES = {
    "glass": "night glass",
    "roof": "roof slate",
    "terrace": "granite",
    "deck": "granite",
    "tank": "walnut",
    "stand": "black metal",
    "brace": "black metal",
    "post": "black metal",
    "transom": "brass",
    "canopy": "brass",
    "bar": "black metal",
    "mullion": "black metal",
    "sash": "black metal",
    "awning": "plaster sage",
    "leaf": "black metal",
    "plinth": "granite",
}

#: Degrees above the horizon that the viewer stands.
ELEVATION = 17.0

#: Metres at which haze takes most of what is seen: little of the towers, and all of the horizon.
VISIBILITY = 2000.0

#: The stones of walls, and what belts, cornices and spandrels are of beside each.
STONES = (
    ("sandstone", "plaster cream"),
    ("plaster brick", "sandstone"),
    ("plaster grey", "granite"),
    ("plaster cream", "sandstone"),
    ("granite", "plaster grey"),
    ("plaster rose", "plaster cream"),
)
TRIM = (
    "cornice",
    "belt",
    "band",
    "frieze",
    "quoin",
    "sill",
    "portal",
    "front",
    "keystone",
    "head",
    "spandrel",
    "parapet",
)


def meshes(applied: ga.operations.applied.Applied, lots: ga.Scene, seed: int) -> Iterator[Mesh]:
    """What there is in space, every lot in its stone."""
    ids = [str(lot.id) for lot in lots.polygons]
    stones = {id: STONES[int(share(seed, id) * len(STONES))] for id in ids}
    for e in applied:
        if isinstance(e.mesh, Mesh):
            wall, trim = next(stones[id] for id in ids if id == e.parent or id in e.surface or id in e.id)
            yield finished(e.mesh, {**FINISHES, **dict.fromkeys(TRIM, trim)}, wall)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--output", type=Path, required=True)
    parser.add_argument("--lots", type=Path, default=HERE / "lots.geojson")
    parser.add_argument("--turn", type=float, nargs="+", default=[-62.0, 118.0])
    parser.add_argument("--seed", type=int, default=SEED)
    parser.add_argument("--size", type=int, nargs=2, default=(1600, 1400))
    parser.add_argument("--samples", type=int, default=24)
    arguments = parser.parse_args()
    lots = ga.read_scene(arguments.lots)
    built = list(meshes(grown().apply(lots, arguments.seed), lots, arguments.seed))
    seen = joined(built).vertices
    whole = [*built, *surroundings(lots)]
    for k, turn in enumerate(arguments.turn):
        name = arguments.output if not k else arguments.output.with_stem(f"{arguments.output.stem}-{k + 1}")
        size, ground = tuple(arguments.size), ("meadow", -0.5)
        draw(whole, name, turn, ELEVATION, size, arguments.samples, ground, 50.0, seen, VISIBILITY)
    return 0


if __name__ == "__main__":
    sys.exit(main())
