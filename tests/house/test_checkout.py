"""The checkout: names that work everywhere, no trace of one machine, one version, a complete grid of wheels."""

import os
import re
import shutil
import subprocess
import sys
import tomllib
from collections import Counter

import pytest
from checkout import ROOT, modules, name_of, tracked_files

sys.path.append(str(ROOT / "scripts"))
import wheel_grid

MANIFEST = tomllib.loads((ROOT / "blender_manifest.toml").read_text(encoding="utf-8"))
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def readable(paths):
    for path in paths:
        try:
            yield path, path.read_text(encoding="utf-8")
        except UnicodeDecodeError:
            continue


def test_tests_are_no_package():
    # With an __init__.py there, a checkout that is called geoanalogy would hide the engine.
    assert [name_of(path) for path in modules("tests") if path.name == "__init__.py"] == []


def test_names_of_test_files_are_unique():
    counts = Counter(path.name for path in modules("tests") if path.name != "conftest.py")
    assert [name for name, count in counts.items() if count > 1] == []


def test_without_git_the_same_files_are_checked(monkeypatch):
    known = tracked_files()
    monkeypatch.setenv("PATH", "")
    assert set(known) <= set(tracked_files())


@pytest.mark.skipif(os.name == "nt", reason="a shell script")
def test_the_python_that_is_chosen_may_stand_in_a_folder_with_a_space(tmp_path):
    folder = tmp_path / "a folder"
    folder.mkdir()
    (folder / "python").write_text("#!/bin/sh\nexit 0\n")
    (folder / "python").chmod(0o755)
    chosen = {**os.environ, "PYTHON": str(folder / "python")}
    found = subprocess.run([ROOT / "scripts" / "find_python"], env=chosen, capture_output=True, text=True)
    assert found.stdout.strip() == str(folder / "python")


def test_without_a_network_one_sentence_says_what_is_missing(tmp_path):
    for name in ("Makefile", "pyproject.toml", "scripts/find_python", "scripts/list_requirements.py"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        shutil.copy(ROOT / name, tmp_path / name)
    offline = {**os.environ, "PYTHON": sys.executable, "PIP_NO_INDEX": "1", "PIP_CONFIG_FILE": os.devnull}
    made = subprocess.run(["make", ".venv/ready"], cwd=tmp_path, env=offline, capture_output=True, text=True)
    assert made.returncode == 2
    assert "pip could not install, see above: is there a network" in made.stderr
    assert not (tmp_path / ".venv" / "ready").exists()


def test_no_file_names_a_folder_of_one_machine():
    machine = re.compile(r"/(work|root|home/\w+|Users/\w+)/(?!\{)")
    wrong = [
        f"{name_of(path)}:{number}: {line.strip()}"
        for path, text in readable(tracked_files())
        for number, line in enumerate(text.splitlines(), 1)
        if machine.search(line)
    ]
    assert wrong == []


def test_no_file_is_left_half_done():
    marks = re.compile(r"\b(TO" + r"DO|FIX" + r"ME|XX" + r"X)\b")
    wrong = [name_of(path) for path, text in readable(tracked_files()) if marks.search(text)]
    assert wrong == []


def test_the_add_on_never_names_the_repository_it_is_installed_in():
    # Its users may install it from any repository of extensions.
    shipped = [ROOT / "__init__.py", *modules("geoanalogy", "operators", "panels")]
    assert [name_of(path) for path, text in readable(shipped) if "user_default" in text] == []


def test_there_is_one_version():
    released = re.search(r"^## (\S+)", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), flags=re.M)
    assert released, "CHANGELOG.md has no section"
    assert PROJECT["version"] == MANIFEST["version"] == released.group(1)


def test_the_libraries_of_the_wheels_satisfy_the_package():
    declared = {re.match(r"\w+", line).group(): line for line in PROJECT["dependencies"]}
    assert set(declared) == {*wheel_grid.VERSIONS, "numpy"}
    for package, version in wheel_grid.VERSIONS.items():
        least = re.search(r">=([\d.]+)", declared[package]).group(1)
        assert [int(part) for part in version.split(".")] >= [int(part) for part in least.split(".")]


def test_the_manifest_lists_the_complete_grid_of_wheels_and_never_numpy():
    wheels = wheel_grid.manifest_wheels()
    assert wheel_grid.faults(wheels) == []
    assert len(wheels) == len(wheel_grid.VERSIONS) * len(wheel_grid.PYTHONS) * len(wheel_grid.PLATFORMS)
    assert set(MANIFEST["platforms"]) == set(wheel_grid.PLATFORMS)
    assert [wheel for wheel in wheels if wheel.startswith("numpy")] == []


def test_blender_4_5_is_the_oldest_that_is_promised():
    assert MANIFEST["blender_version_min"] == "4.5.0"
    assert "blender_version_max" not in MANIFEST


def test_the_build_leaves_out_what_blender_would_by_itself():
    assert {"__pycache__/", ".*", "/*.zip", "*.blend[1-9]"} <= set(MANIFEST["build"]["paths_exclude_pattern"])


LINUX = "manylinux_2_17_x86_64"


@pytest.mark.parametrize(
    ("wheel", "place"),
    [
        (f"scipy-1.2.3-cp311-cp311-manylinux2014_x86_64.{LINUX}.whl", ("scipy", "1.2.3", "3.11", "linux-x64")),
        ("shapely-2.0.0-cp313-cp313-win_amd64.whl", ("shapely", "2.0.0", "3.13", "windows-x64")),
        ("shapely-2.0.0-cp313-cp313-macosx_11_0_arm64.whl", ("shapely", "2.0.0", "3.13", "macos-arm64")),
        ("shapely-2.0.0-cp313-cp313t-win_amd64.whl", None),
        ("shapely-2.0.0-cp313-cp313-musllinux_1_2_x86_64.whl", None),
        ("shapely-2.0.0-cp313-cp313-macosx_10_13_x86_64.whl", None),
    ],
)
def test_a_wheel_has_its_cell(wheel, place):
    assert wheel_grid.cell(wheel) == place


def test_a_hole_a_double_and_a_stranger_in_the_grid_are_found():
    complete = wheel_grid.manifest_wheels()
    hole = [wheel for wheel in complete if not wheel.startswith("shapely-2.1.2-cp313-cp313-win")]
    assert wheel_grid.faults(hole) == ["no wheel of shapely 2.1.2 3.13 windows-x64"]
    scipy = next(wheel for wheel in complete if wheel.startswith("scipy") and "macosx_12_0" in wheel)
    double = scipy.replace("macosx_12_0", "macosx_11_0")
    assert wheel_grid.faults([*complete, double]) == ["more than one wheel of scipy 1.16.3 3.11 macos-arm64"]
    stranger = "numpy-2.0.0-cp313-cp313-win_amd64.whl"
    assert wheel_grid.faults([*complete, stranger]) == [f"{stranger} is not wanted"]
