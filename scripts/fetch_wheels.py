"""Fetch the wheels that the extension carries into ./wheels, and prove that none is missing.

    python scripts/fetch_wheels.py                              all of them, about 320 MB
    python scripts/fetch_wheels.py --platform linux-x64 --python 3.11

The manifest lists the files one by one. This program fails where that list is not the complete grid of packages,
Pythons and platforms, or where the package index gives other files than the manifest lists.
"""

import argparse
import subprocess
import sys
from pathlib import Path

import wheel_grid


def fetch(platform: str, python: str, folder: Path) -> None:
    """Download the wheels of one platform and Python, unless they are there already."""
    if all((folder / wheel).is_file() for wheel in wheel_grid.chosen((platform,), (python,))):
        return
    command = [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", "--only-binary=:all:"]
    command += ["--implementation", "cp", "--python-version", python, "--abi", f"cp{python.replace('.', '')}"]
    for tag in wheel_grid.PLATFORMS[platform]:
        command += ["--platform", tag]
    command += ["--dest", str(folder)]
    command += [f"{package}=={version}" for package, version in wheel_grid.VERSIONS.items()]
    subprocess.run(command, check=True)


def main() -> int:
    """Fetch, then compare what is there with what the manifest lists."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--platform", choices=wheel_grid.PLATFORMS, action="append", help="only this one (repeatable)")
    parser.add_argument("--python", choices=wheel_grid.PYTHONS, action="append", help="only this one (repeatable)")
    arguments = parser.parse_args()
    platforms = tuple(arguments.platform or wheel_grid.PLATFORMS)
    pythons = tuple(arguments.python or wheel_grid.PYTHONS)

    faults = [f"blender_manifest.toml: {fault}" for fault in wheel_grid.faults(wheel_grid.manifest_wheels())]
    if not faults:
        wheel_grid.FOLDER.mkdir(exist_ok=True)
        for platform in platforms:
            for python in pythons:
                fetch(platform, python, wheel_grid.FOLDER)
        listed = wheel_grid.manifest_wheels()
        present = sorted(path.name for path in wheel_grid.FOLDER.glob("*.whl"))
        wanted = wheel_grid.chosen(platforms, pythons)
        faults = [f"wheels/{wheel} did not come" for wheel in wanted if wheel not in present]
        faults += [f"wheels/{wheel} is not in blender_manifest.toml" for wheel in present if wheel not in listed]
    for fault in faults:
        print(fault, file=sys.stderr)
    if not faults:
        print(f"{len(wanted)} wheels in {wheel_grid.FOLDER}: {', '.join(platforms)} on Python {', '.join(pythons)}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
