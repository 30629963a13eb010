"""Record the kitchens, and write what they are then built in.

python -m sample_blends.kitchens [--output FOLDER]

Writes kitchens.json, the operations tree; examples.geojson, the nine rooms that it was recorded in; and rooms.geojson,
sixteen others.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from pathlib import Path

import geoanalogy as ga

from . import rooms, runs
from .drawn import KitchenRecorder

HERE = Path(__file__).parent


def tree() -> ga.OperationsTree:
    """The operations tree of the kitchens, recorded anew."""
    recorder = KitchenRecorder(rooms.recorded())
    runs.record(recorder)
    return recorder.tree


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--output", type=Path, default=HERE, help="folder of the tree and the rooms")
    arguments = parser.parse_args()
    ga.write_scene(rooms.recorded(), arguments.output / "examples.geojson")
    ga.write_scene(rooms.built(), arguments.output / "rooms.geojson")
    start = time.perf_counter()
    made = tree()
    (arguments.output / "kitchens.json").write_text(json.dumps(made.to_dict()) + "\n")
    print(f"kitchens: {len(made.nodes)} operations recorded in {time.perf_counter() - start:.1f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
