"""What `pip install .` gives: the engine and the batch program, and nothing that Blender would be needed for."""

import os
import shutil
import subprocess
import sys
import tomllib

import pytest
from checkout import ROOT, modules


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """The folder that pip installed into, from a copy: setuptools leaves its working files in the source."""
    source = tmp_path_factory.mktemp("source")
    for name in ("pyproject.toml", "README.md", "LICENSE", "__init__.py", "batch.py"):
        shutil.copy(ROOT / name, source)
    for name in ("geoanalogy", "operators", "panels"):
        shutil.copytree(ROOT / name, source / name, ignore=shutil.ignore_patterns("__pycache__"))
    target = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-index", "--no-build-isolation"]
    subprocess.run([*command, "--target", str(target), str(source)], check=True)
    return target


def run(site, *command):
    environment = {**os.environ, "PYTHONPATH": str(site)}
    return subprocess.run(command, cwd=site, env=environment, capture_output=True, text=True, check=True).stdout.strip()


def test_it_is_the_engine_alone(site):
    assert {path.name for path in site.iterdir() if not path.name.endswith(".dist-info")} == {"geoanalogy", "bin"}
    expected = {path.relative_to(ROOT) for path in modules("geoanalogy")}
    assert {path.relative_to(site) for path in (site / "geoanalogy").rglob("*.py")} == expected
    assert (site / "geoanalogy" / "py.typed").is_file()


def test_it_imports_without_blender(site):
    program = "import sys; sys.modules['bpy'] = None; import geoanalogy; print(geoanalogy.__file__)"
    assert run(site, sys.executable, "-c", program) == str(site / "geoanalogy" / "__init__.py")


def test_it_brings_the_batch_program(site):
    version = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["version"]
    assert run(site, sys.executable, str(site / "bin" / "geoanalogy"), "--version") == f"GeoAnalogy {version}"
