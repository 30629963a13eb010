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
from .skyscrapers import __main__ as skyscrapers

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
SCENES = ("apartment", "garden", "crowns", "street")
HOUSES, KITCHENS, SKYSCRAPERS, INTERIORS = "houses", "kitchens", "skyscrapers", "interiors"
CITY = "city"

#: Seed of what is built by chance, and the second camera of a scene that a tree has built.
SEED, BEHIND = 7, "From behind"


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


def module(name: str, *arguments: str | Path) -> None:
    """Run a module of the repository in a process of its own."""
    subprocess.run([sys.executable, "-m", name, *map(str, arguments)], cwd=ROOT, check=True)


def apply(tree: ga.OperationsTree, parcels: Path, folder: Path, name: str, seed: int, *more: str | Path) -> Path:
    """Apply a tree to parcels, and write the scene."""
    stored, blend = folder / f"{name}.json", folder / f"{name}.blend"
    tree.save(stored)
    command = [sys.executable, ROOT / "batch.py", "apply", "--tree", stored, "--parcels", parcels, "--seed", seed]
    subprocess.run([*map(str, (*command, "--output", blend, *more))], check=True)
    return blend


def build_houses(folder: Path) -> None:
    """Apply the trees of all types of houses, grown together, to the other plots; the street and the gardens."""
    grown = ga.OperationsTree()
    for label in TYPES:
        grown = grown.with_tree(ga.OperationsTree.load(HERE / HOUSES / f"{label}.json"), (), f"{label} ")
    picture = ("--render", folder / f"{HOUSES}.png")
    blend = apply(grown, HERE / HOUSES / "plots.geojson", folder, HOUSES, SEED, *picture)
    module("sample_blends.view", blend, BEHIND, folder / f"{HOUSES}-2.png")


def build_kitchens(folder: Path) -> None:
    """Apply the kitchens' tree to the other rooms; two views, the walls towards the viewer cut down."""
    things, rooms = folder / "library.blend", HERE / KITCHENS / "rooms.geojson"
    module("sample_blends.library", things)
    stored = HERE / KITCHENS / "kitchens.json"
    apply(ga.OperationsTree.load(stored), rooms, folder, KITCHENS, SEED, "--library", things)
    pictures = ("--tree", stored, "--rooms", rooms, "--seed", str(SEED))
    module("sample_blends.kitchens.drawing", *pictures, "--output", folder / f"{KITCHENS}.png")


def build_skyscrapers(folder: Path) -> None:
    """Apply the four trees of skyscrapers, grown together, to the other lots; two views."""
    apply(skyscrapers.grown(), HERE / SKYSCRAPERS / "lots.geojson", folder, SKYSCRAPERS, skyscrapers.SEED)
    module("sample_blends.skyscrapers.drawing", "--output", folder / f"{SKYSCRAPERS}.png")


def build_interiors(folder: Path) -> None:
    """Furnish a storey of one of the houses; two views, the building cut open."""
    views = ("--turn", "-70", "110")
    module("sample_blends.interiors", "--output", folder / f"{INTERIORS}.png", *views)


def build_city(folder: Path) -> None:
    """Generate the cities of four maps, and draw each from above and from its streets."""
    module("sample_blends.city", "--output", folder)


BUILDERS = {
    HOUSES: build_houses,
    KITCHENS: build_kitchens,
    SKYSCRAPERS: build_skyscrapers,
    INTERIORS: build_interiors,
    CITY: build_city,
}


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scenes", nargs="*", default=(*SCENES, *BUILDERS, *DRAWINGS), help="which ones (default: all)")
    parser.add_argument(
        "--output", type=Path, default=ROOT / "output", help="folder for the replayed scenes and pictures"
    )
    parser.add_argument("--rebuild", action="store_true", help="record the edits anew before")
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    for scene in arguments.scenes:
        if scene in BUILDERS:
            if arguments.rebuild and scene not in (INTERIORS, CITY):  # which are made of what others have recorded
                module(f"sample_blends.{scene}")
            BUILDERS[scene](arguments.output.resolve())
            continue
        if scene in DRAWINGS:
            draw_sheet(scene, arguments.output.resolve(), arguments.rebuild)
            continue
        if arguments.rebuild:
            rebuild(scene)
        replay(scene, arguments.output)


if __name__ == "__main__":
    main()
