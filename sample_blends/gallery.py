"""Build every sample scene with its edits, replay it and draw it: ``python -m sample_blends.gallery``.

The .blend files that the repository carries hold the plan, the examples and the recorded operations, without the
results: replaying makes those. ``--rebuild`` records them anew.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
from pathlib import Path

import geoanalogy as ga

from .drawings import SCENES as DRAWINGS
from .houses.plots import TYPES

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
SCENES = ("apartment", "garden", "crowns", "street")
HOUSES = "houses"


def rebuild(scene: str) -> None:
    """Record a scene's edits and write its .blend; in a process of its own, as a file that is built holds nothing
    else.
    """
    command = [sys.executable, str(HERE / f"{scene}.py"), "--edits", "--examples-only"]
    subprocess.run([*command, "--output", str(HERE / f"{scene}.blend")], check=True)


def replay(scene: str, folder: Path) -> None:
    """Replay the operations of a scene's .blend, and write the scene and its picture."""
    command = [sys.executable, str(ROOT / "batch.py"), "replay", str(HERE / f"{scene}.blend")]
    outputs = ["--output", str(folder / f"{scene}.blend"), "--render", str(folder / f"{scene}.png")]
    subprocess.run([*command, *outputs], check=True)


def draw_sheet(scene: str, folder: Path, anew: bool) -> None:
    """Replay a drawing, and draw its query beside what came of it; where wanted, record it anew before."""
    blend = HERE / "drawings" / f"{scene}.blend"
    if anew:
        build = [sys.executable, "-m", "sample_blends.drawings.build", scene, "--output", str(blend)]
        subprocess.run(build, cwd=ROOT, check=True)
    replayed = folder / f"{scene}.blend"
    batch = [sys.executable, str(ROOT / "batch.py"), "replay", str(blend), "--output", str(replayed)]
    subprocess.run(batch, check=True)
    sheet = [sys.executable, "-m", "sample_blends.drawings.sheet", str(replayed), str(folder / f"{scene}.png")]
    subprocess.run(sheet, cwd=ROOT, check=True)


def build_houses(folder: Path) -> None:
    """Apply the trees of all types of houses, grown together, to the other plots; write the scene and its picture."""
    grown = ga.OperationsTree()
    for label in TYPES:
        grown = grown.with_tree(ga.OperationsTree.load(HERE / HOUSES / f"{label}.json"), (), f"{label} ")
    tree = folder / f"{HOUSES}.json"
    grown.save(tree)
    command = [sys.executable, str(ROOT / "batch.py"), "apply", "--tree", str(tree), "--seed", "7"]
    outputs = ["--output", str(folder / f"{HOUSES}.blend"), "--render", str(folder / f"{HOUSES}.png")]
    subprocess.run([*command, "--parcels", str(HERE / HOUSES / "plots.geojson"), *outputs], check=True)


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scenes", nargs="*", default=(*SCENES, HOUSES, *DRAWINGS), help="which ones (default: all)")
    parser.add_argument(
        "--output", type=Path, default=ROOT / "output", help="folder for the replayed scenes and pictures"
    )
    parser.add_argument("--rebuild", action="store_true", help="record the edits anew before")
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    for scene in arguments.scenes:
        if scene == HOUSES:
            if arguments.rebuild:
                subprocess.run([sys.executable, "-m", "sample_blends.houses"], cwd=ROOT, check=True)
            build_houses(arguments.output)
            continue
        if scene in DRAWINGS:
            draw_sheet(scene, arguments.output.resolve(), arguments.rebuild)
            continue
        if arguments.rebuild:
            rebuild(scene)
        replay(scene, arguments.output)


if __name__ == "__main__":
    main()
