"""Generate cities on the maps, and draw them: ``python -m sample_blends.city [MAP …] --output FOLDER [--jobs N]``.

The batch program does the work, as it would on any other map; its command is printed.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
from pathlib import Path

from ..houses.plots import TYPES
from .maps import HERE, MAPS

ROOT = HERE.parent.parent
TREES = [HERE.parent / "houses" / f"{label}.json" for label in TYPES]


def generate(name: str, folder: Path, jobs: int, output: Path) -> None:
    """Generate the city of a map into a .blend; the objects of the library stand in one beside it."""
    library = folder / "trees.blend"
    if not library.is_file():
        run(["-m", "sample_blends.city.library", str(library)])
    trees = [word for tree in TREES for word in ("--tree", str(tree))]
    command = [str(ROOT / "batch.py"), "apply", *trees, "--parcels", str(HERE / f"{name}.geojson"), "--seed", "7"]
    run([*command, "--jobs", str(jobs), "--library", str(library), "--output", str(output)])


def run(words: list[str]) -> None:
    """Run this Python, and say so."""
    print("python", *words, flush=True)
    subprocess.run([sys.executable, *words], cwd=ROOT, check=True)


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("maps", nargs="*", default=MAPS, help="which ones (default: all)")
    parser.add_argument("--output", type=Path, default=ROOT / "output", help="folder (output)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="processes (all processors)")
    parser.add_argument("--demo", action="store_true", help="one map alone, as city.blend and city.png")
    arguments = parser.parse_args()
    folder = arguments.output.absolute()
    folder.mkdir(parents=True, exist_ok=True)
    for name in ("bubenec",) if arguments.demo else arguments.maps:
        output = folder / ("city.blend" if arguments.demo else f"{name}.blend")
        generate(name, folder, arguments.jobs, output)
        words = ["-m", "sample_blends.city.views", str(output), "--map", name, "--output", str(folder)]
        run([*words, "--only", "_houses"] if arguments.demo else words)
        if arguments.demo:
            (folder / f"{name}_houses.png").replace(folder / "city.png")
            print(f"wrote {output} and {folder / 'city.png'}")


if __name__ == "__main__":
    main()
