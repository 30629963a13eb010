"""The wheels that the extension carries: which packages, for which Pythons and platforms, and the manifest's list."""

import sysconfig
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
MANIFEST = ROOT / "blender_manifest.toml"
FOLDER = ROOT / "wheels"

# scipy 1.16 asks for numpy 1.25.2 to 2.5, shapely 2.1 for 1.21 and later: both run on the numpy 1.26 of Blender 4.5
# and 5.0 and on the numpy 2 of 5.1 and later; so does manifold3d, which only exchanges arrays with it.
VERSIONS = {"manifold3d": "3.5.4", "scipy": "1.16.3", "shapely": "2.1.2"}

# Blender 4.5 and 5.0 run Python 3.11, Blender 5.1 and 5.2 run 3.13; Linux distributions build 5.2 with 3.14, and
# Blender refuses an extension whose wheels do not name its Python.
PYTHONS = ("3.11", "3.13", "3.14")

# Blender's names of the platforms, and the tags that pip may choose from for each.
PLATFORMS = {
    "linux-x64": ("manylinux_2_28_x86_64", "manylinux_2_27_x86_64", "manylinux_2_17_x86_64", "manylinux2014_x86_64"),
    "windows-x64": ("win_amd64",),
    "macos-arm64": ("macosx_12_0_arm64", "macosx_11_0_arm64"),
}

PLATFORM_HERE = {
    "linux-x86_64": "linux-x64",
    "win-amd64": "windows-x64",
}.get(sysconfig.get_platform(), "macos-arm64" if sysconfig.get_platform().endswith("arm64") else "")


def manifest_wheels() -> list[str]:
    """The file names that the manifest lists, without their folder."""
    return [Path(entry).name for entry in tomllib.loads(MANIFEST.read_text(encoding="utf-8"))["wheels"]]


def cell(wheel: str) -> tuple[str, str, str, str] | None:
    """The place of a wheel in the grid: package, version, Python, platform; None where it has none."""
    package, version, python_tag, abi_tag, platform_tag = wheel.removesuffix(".whl").split("-")
    if python_tag != abi_tag:
        return None
    for platform, tags in PLATFORMS.items():
        if set(platform_tag.split(".")) & set(tags):
            return package, version, f"{python_tag[2]}.{python_tag[3:]}", platform
    return None


def faults(wheels: list[str]) -> list[str]:
    """What is wrong with a list of wheels, a sentence each; an empty list means that the grid is complete.

    Blender offers an extension to every Python that any of its wheels names, so that one missing wheel is an import
    error on somebody's machine.
    """
    wanted = {
        (package, version, python, platform)
        for package, version in VERSIONS.items()
        for python in PYTHONS
        for platform in PLATFORMS
    }
    cells = [cell(wheel) for wheel in wheels]
    found = [place for place in cells if place in wanted]
    return (
        [f"no wheel of {' '.join(place)}" for place in sorted(wanted - set(found))]
        + [f"more than one wheel of {' '.join(place)}" for place in sorted(set(found)) if found.count(place) > 1]
        + [f"{wheel} is not wanted" for wheel, place in zip(wheels, cells, strict=True) if place not in wanted]
    )


def chosen(platforms: tuple[str, ...], pythons: tuple[str, ...]) -> list[str]:
    """The manifest's wheels for these platforms and Pythons."""
    places = ((wheel, cell(wheel)) for wheel in manifest_wheels())
    return [wheel for wheel, place in places if place is not None and place[3] in platforms and place[2] in pythons]
