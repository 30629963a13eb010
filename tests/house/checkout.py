"""The checkout as the checks of the house see it."""

import ast
import subprocess
from collections.abc import Iterator
from fnmatch import fnmatch
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def modules(*folders: str) -> list[Path]:
    """Every Python file under these folders, sorted."""
    return sorted(path for folder in folders for path in (ROOT / folder).rglob("*.py"))


def engine_modules() -> list[Path]:
    """The files of the engine: the package geoanalogy without its bridge to Blender."""
    return [path for path in modules("geoanalogy") if path.relative_to(ROOT).parts[1] != "blender"]


def name_of(path: Path) -> str:
    """A path as the tests' ids and messages show it."""
    return path.relative_to(ROOT).as_posix()


def module_name(path: Path) -> str:
    """The dotted name by which a file of the engine is imported."""
    return ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__")


@cache
def syntax_tree(path: Path) -> ast.Module:
    """A file's syntax tree."""
    return ast.parse(path.read_text(encoding="utf-8"), str(path))


def tracked_files() -> list[Path]:
    """The files that git knows and that are there; where git or its folder is missing, all but what is made here."""
    try:
        listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError):
        made = (ROOT / ".gitignore").read_text(encoding="utf-8").split()
        return [path for path in _walked(ROOT, [pattern.strip("/") for pattern in made]) if path.is_file()]
    return [ROOT / name for name in listed.split("\0") if name and (ROOT / name).is_file()]


def _walked(folder: Path, without: list[str]) -> Iterator[Path]:
    """Everything in a folder but what matches one of these patterns."""
    for path in sorted(folder.iterdir()):
        if path.name == ".git" or any(fnmatch(path.name, pattern) for pattern in without):
            continue
        yield path
        if path.is_dir():
            yield from _walked(path, without)
