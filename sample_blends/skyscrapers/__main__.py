"""Record the skyscrapers in four sessions, grow the four trees together, and write what they are then built on.

python -m sample_blends.skyscrapers [--output FOLDER]

Writes mass.json, base.json, middle.json and top.json; and examples.geojson and lots.geojson.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from pathlib import Path

import geoanalogy as ga
from geoanalogy.operations.node import Link

from ..houses.recorder import Recorder
from . import facades, lots, mass
from .session import Session

HERE = Path(__file__).parent

#: Of all chance in what is shown.
SEED = 12

#: The sessions in their order; all but the first draw on what the first has built.
SESSIONS = {"mass": mass.record, "base": facades.base, "middle": facades.shaft, "top": facades.crown}


def recorded() -> dict[str, ga.OperationsTree]:
    """The tree of every session."""
    scene = lots.recorded()
    first = Recorder(scene)
    mass.record(first)
    trees = {"mass": first.tree}
    for name, record in list(SESSIONS.items())[1:]:
        session = Session(scene, first.tree, first.at)
        record(session)
        trees[name] = session.recorded
    return trees


def grown(folder: Path = HERE) -> ga.OperationsTree:
    """The trees of a folder as one: each facade goes on after what the one before it leaves."""
    tree = ga.OperationsTree()
    at: tuple[Link, ...] = ()
    for name in SESSIONS:
        tree = tree.with_tree(ga.OperationsTree.load(folder / f"{name}.json"), at, f"{name} ")
        at = tuple(Link(leaf) for leaf in tree.leaves)
    return tree


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--output", type=Path, default=HERE, help="folder of the trees and the lots")
    arguments = parser.parse_args()
    ga.write_scene(lots.recorded(), arguments.output / "examples.geojson")
    ga.write_scene(lots.built(), arguments.output / "lots.geojson")
    start = time.perf_counter()
    for name, tree in recorded().items():
        (arguments.output / f"{name}.json").write_text(json.dumps(tree.to_dict()) + "\n")
        print(f"{name}: {len(tree.nodes)} operations")
    print(f"recorded in {time.perf_counter() - start:.1f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
