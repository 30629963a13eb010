"""Build the extension's zip with Blender's own builder, and validate it.

    python scripts/build_extension.py                           a zip for each platform, for release
    python scripts/build_extension.py --platform linux-x64 --python 3.11
    python scripts/build_extension.py --without-wheels          where the libraries are at hand already

The builder is that of the Blender given by --blender or BLENDER, else that of the bpy module beside this Python.
"""

import argparse
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import wheel_grid

# Neither code nor anything that the manifest would have to exclude; the rest is left to its patterns.
NOT_STAGED = shutil.ignore_patterns(".*", "__pycache__", "wheels", "output")


def builder_command(blender: str | None, builder: str | None) -> list[str]:
    """The command line of Blender's builder, up to the name of the sub-command."""
    if blender:
        return [blender, "--command", "extension"]
    if builder is None:
        bpy = importlib.util.find_spec("bpy")
        found = [
            path
            for folder in (bpy.submodule_search_locations or [] if bpy else [])
            for path in Path(folder).glob("*/scripts/addons_core/bl_pkg/cli/blender_ext.py")
        ]
        if not found:
            sys.exit("No builder: set BLENDER to Blender's program, or install the bpy module (pip install bpy).")
        builder = str(found[0])
    return [sys.executable, builder]


def run_builder(command: list[str], *arguments: str) -> None:
    """Run the builder; a warning fails the build as an error does."""
    done = subprocess.run([*command, *arguments], capture_output=True, text=True, encoding="utf-8")
    said = done.stdout + done.stderr
    if done.returncode or re.search(r"warn|error", said, re.IGNORECASE):
        sys.exit(f"{' '.join(arguments[:1])} failed:\n{said}")


def valid_tags(command: list[str]) -> list[str]:
    """The arguments that name Blender's list of tags, which only Blender itself finds unasked."""
    if "--command" in command:
        return []
    scripts = Path(command[1]).parents[3]
    return ["--valid-tags", str(scripts / "modules" / "_bpy_internal" / "extensions" / "tags.py")]


def stage(folder: Path, wheels: list[str], platforms: tuple[str, ...]) -> None:
    """Copy the checkout with a manifest that lists only these wheels and platforms."""
    shutil.copytree(wheel_grid.ROOT, folder, ignore=NOT_STAGED)
    manifest = folder / wheel_grid.MANIFEST.name
    text = manifest.read_text(encoding="utf-8")
    for key, values in (("wheels", [f"./wheels/{wheel}" for wheel in wheels]), ("platforms", platforms)):
        entries = ", ".join(f'"{value}"' for value in values)
        text, count = re.subn(rf"^{key} = \[.*?\]", f"{key} = [{entries}]" if values else "", text, flags=re.M | re.S)
        if count != 1:
            sys.exit(f"blender_manifest.toml should have one entry {key!r}, but has {count}.")
    manifest.write_text(text, encoding="utf-8")
    (folder / "wheels").mkdir()
    for wheel in wheels:
        shutil.copy(wheel_grid.FOLDER / wheel, folder / "wheels")


def main() -> int:
    """Build into the output folder, validate each zip, and print its path."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--output", type=Path, default=wheel_grid.ROOT / "dist", help="folder of the zips (dist)")
    parser.add_argument("--platform", choices=wheel_grid.PLATFORMS, help="build for this platform only")
    parser.add_argument("--python", choices=wheel_grid.PYTHONS, help="carry the wheels of this Python only")
    parser.add_argument("--without-wheels", action="store_true", help="carry no wheels at all")
    parser.add_argument("--blender", default=os.environ.get("BLENDER"), help="Blender's program")
    parser.add_argument("--builder", help="Blender's blender_ext.py, where neither Blender nor bpy is found")
    arguments = parser.parse_args()

    platforms = (arguments.platform,) if arguments.platform else tuple(wheel_grid.PLATFORMS)
    pythons = (arguments.python,) if arguments.python else wheel_grid.PYTHONS
    wheels = [] if arguments.without_wheels else wheel_grid.chosen(platforms, pythons)
    missing = [wheel for wheel in wheels if not (wheel_grid.FOLDER / wheel).is_file()]
    if missing:
        sys.exit(f"{len(missing)} of {len(wheels)} wheels are missing: run scripts/fetch_wheels.py first.")

    output = arguments.output.resolve()
    output.mkdir(parents=True, exist_ok=True)
    command = builder_command(None if arguments.builder else arguments.blender, arguments.builder)
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary, "extension")
        target = Path(temporary, "zips")
        target.mkdir()
        stage(folder, wheels, platforms)
        run_builder(command, "validate", *valid_tags(command), str(folder))
        split = ["--split-platforms"] if wheels else []
        run_builder(
            command, "build", *split, *valid_tags(command), "--source-dir", str(folder), "--output-dir", str(target)
        )
        for built in sorted(target.glob("*.zip")):
            run_builder(command, "validate", *valid_tags(command), str(built))
            print(shutil.move(built, output / built.name))
    return 0


if __name__ == "__main__":
    sys.exit(main())
