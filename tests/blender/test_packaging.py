"""The zip holds what it should, and Blender takes it without a word."""

import json
import os
import platform
import re
import subprocess
import sys
import sysconfig
import zipfile
from pathlib import Path

import addon_utils
import bpy
import pytest
import wheel_grid
from conftest import ADDON, INSIDE_BLENDER, ROOT, build_extension, engine_twins, policy_warnings

ALLOWED = re.compile(
    r"__init__\.py|blender_manifest\.toml|LICENSE|README\.md"
    r"|(geoanalogy|operators|panels)/([a-z0-9_]+/)*[a-z0-9_]+\.py"
    r"|geoanalogy/py\.typed|geoanalogy/formats/labels\.json"
    r"|wheels/(manifold3d|scipy|shapely)-[\w.]+-[\w.]+-[\w.]+-[\w.]+\.whl"
)
PYTHON_HERE = ".".join(platform.python_version_tuple()[:2])


def test_the_zip_holds_only_what_the_add_on_needs(extension_zip):
    names = [name for name in zipfile.ZipFile(extension_zip).namelist() if not name.endswith("/")]
    assert [name for name in names if not ALLOWED.fullmatch(name)] == []
    assert {"__init__.py", "blender_manifest.toml", "LICENSE", "geoanalogy/__init__.py"} <= set(names)
    assert {"operators/__init__.py", "panels/__init__.py", "geoanalogy/blender/__init__.py"} <= set(names)


def test_the_zip_is_every_module_of_the_checkout(extension_zip):
    modules = {
        path.relative_to(ROOT).as_posix()
        for folder in ("geoanalogy", "operators", "panels")
        for path in (ROOT / folder).rglob("*.py")
    }
    assert modules - set(zipfile.ZipFile(extension_zip).namelist()) == set()


def test_the_manifest_passes_without_a_warning(extension_zip):
    # build_extension.py validates the folder and the zip and fails on any warning; this reads the manifest once more as
    # the installed extension has it.
    folder = Path(sys.modules[ADDON].__file__).parent
    assert (folder / "blender_manifest.toml").is_file()
    assert policy_warnings() == {}


def test_it_is_enabled_without_a_policy_warning(addon):
    assert addon_utils.check(ADDON) == (True, True)
    assert policy_warnings() == {}
    assert engine_twins() == []


def test_it_can_be_disabled_and_enabled_again(installed):
    for _ in range(2):
        addon_utils.disable(installed, default_set=True)
        assert addon_utils.check(installed) == (False, False)
        addon_utils.enable(installed, default_set=True)
        assert addon_utils.check(installed) == (True, True)


def registered_classes() -> set[str]:
    """Every class of ours that Blender knows."""
    return {
        name
        for base in (bpy.types.Operator, bpy.types.Panel, bpy.types.PropertyGroup, bpy.types.NodeTree, bpy.types.Node)
        for cls in base.__subclasses__()
        if (name := cls.__name__).startswith("GEOANALOGY") and getattr(cls, "is_registered", False)
    }


def test_registering_is_undone_in_full_and_can_be_repeated(addon):
    before = registered_classes()
    for _ in range(2):
        addon.unregister()
        assert registered_classes() == set()
        assert not hasattr(bpy.types.Scene, "geoanalogy")
        addon.register()
        assert registered_classes() == before


def test_a_failing_layer_unregisters_those_before_it(addon, monkeypatch):
    layers = sys.modules[f"{ADDON}.operators"], sys.modules[f"{ADDON}.panels"]
    addon.unregister()

    def fail():
        raise RuntimeError("no panels today")

    with monkeypatch.context() as patch:
        patch.setattr(layers[1], "register", fail)
        with pytest.raises(RuntimeError, match="no panels today"):
            addon.register()
        assert registered_classes() == set()
    addon.register()


def test_the_engine_of_the_extension_works(engine):
    assert engine.__name__ == f"{ADDON}.geoanalogy"
    assert issubclass(engine.InputError, ValueError)


@pytest.mark.skipif(
    PYTHON_HERE not in wheel_grid.PYTHONS or wheel_grid.PLATFORM_HERE not in wheel_grid.PLATFORMS,
    reason=f"the extension carries no wheels for Python {PYTHON_HERE} on {sysconfig.get_platform()}",
)
def test_the_zip_with_its_wheels_brings_its_own_libraries(tmp_path):
    here = ["--platform", wheel_grid.PLATFORM_HERE, "--python", PYTHON_HERE]
    built = build_extension(tmp_path / "zip", *here)
    said = tmp_path / "said.json"
    profile = tmp_path / "profile"
    script = str(Path(__file__).with_name("install_with_wheels.py"))
    environment = {"PATH": os.environ["PATH"], "HOME": str(tmp_path), "BLENDER_USER_RESOURCES": str(profile)}
    if INSIDE_BLENDER:
        command = [bpy.app.binary_path, "--background", "--python", script, "--"]
    else:
        # A Python of its own that has what this one has, but for the libraries that the wheels bring.
        environment["PYTHONPATH"] = str(tmp_path / "packages")
        Path(environment["PYTHONPATH"]).mkdir()
        for entry in Path(sysconfig.get_path("platlib")).iterdir():
            if not entry.name.startswith(("manifold3d", "scipy", "shapely")):
                Path(environment["PYTHONPATH"], entry.name).symlink_to(entry)
        command = [sys.executable, "-S", script]
    profile.mkdir()
    # The exit status says nothing: the bpy module may crash at its exit, when all is done.
    subprocess.run([*command, str(built), str(said)], env=environment, check=False)
    result = json.loads(said.read_text())
    assert result["area"] == 2.0
    assert result["warnings"] == {}
    for package, version in wheel_grid.VERSIONS.items():
        brought = list(profile.rglob(f"{package}-{version}.dist-info"))
        assert len(brought) == 1
        # A Blender that has the library already, as those of Linux distributions do, goes on using its own.
        if not INSIDE_BLENDER:
            assert result[package][0] == version
            assert Path(result[package][1]).is_relative_to(brought[0].parent)
