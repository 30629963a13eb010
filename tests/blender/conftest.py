"""The extension as a user gets it: built, installed from its zip, enabled; then one fresh file per test.

Runs with the bpy module, and inside Blender itself through run_in_blender.py. The engine is reached through the
installed extension only: its top-level twin would be a second copy, with classes of its own.
"""

import importlib.util
import os
import platform
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "scripts"))
ADDON = "bl_ext.user_default.geoanalogy"

INSIDE_BLENDER = "bpy" in sys.modules
if INSIDE_BLENDER:
    USER_FOLDER = None
else:
    # Blender reads this once, when it starts: no test may touch the extensions of whoever runs it.
    USER_FOLDER = tempfile.mkdtemp(prefix="geoanalogy-tests-")
    os.environ["BLENDER_USER_RESOURCES"] = USER_FOLDER

import bpy  # noqa: E402  # isort: skip
import addon_utils  # noqa: E402  # bpy puts it on the path
import wheel_grid  # noqa: E402

# Without the checkout on the path, nobody imports the top-level engine by mistake.
sys.path[:] = [entry for entry in sys.path if Path(entry).resolve() != ROOT]


def pytest_configure(config):
    """Take Blender's own warnings as warnings, and refuse to run in a user's own profile."""
    config.addinivalue_line("filterwarnings", "default")
    profile = Path(bpy.utils.resource_path("USER")).resolve()
    if not profile.is_relative_to(Path(tempfile.gettempdir()).resolve()):
        pytest.exit(f"These tests install an extension: set BLENDER_USER_RESOURCES, {profile} is not temporary.", 2)


def pytest_unconfigure():
    """Leave nothing behind."""
    if USER_FOLDER:
        shutil.rmtree(USER_FOLDER, ignore_errors=True)


def pytest_report_header():
    """Name the Blender and the libraries that the tests ran with."""
    import numpy

    return f"Blender {bpy.app.version_string}, Python {platform.python_version()}, numpy {numpy.__version__}"


def build_extension(folder: Path, *arguments: str) -> Path:
    """Build the zip with the builder of the Blender that runs, and return its path."""
    builder = Path(bpy.utils.system_resource("SCRIPTS"), "addons_core", "bl_pkg", "cli", "blender_ext.py")
    script = ROOT / "scripts" / "build_extension.py"
    subprocess.run(
        [sys.executable, str(script), "--builder", str(builder), "--output", str(folder), *arguments], check=True
    )
    (built,) = folder.glob("*.zip")
    return built


def policy_warnings() -> dict:
    """What Blender holds against the installed extensions; empty where all is well."""
    return dict(addon_utils._extensions_warnings_get())


def engine_twins() -> list[str]:
    """The modules of a second, top-level copy of the engine, whose classes would be others than the extension's."""
    return [
        name
        for name, module in list(sys.modules.items())
        if name.split(".")[0] == "geoanalogy"
        and Path(getattr(module, "__file__", None) or ".").resolve().is_relative_to(ROOT / "geoanalogy")
    ]


@pytest.fixture(scope="session")
def extension_zip(tmp_path_factory):
    """The zip without wheels where this Python has the libraries already, with its own wheels where not."""
    carried = ["--without-wheels"]
    if any(importlib.util.find_spec(package) is None for package in wheel_grid.VERSIONS):
        here = ".".join(map(str, sys.version_info[:2]))
        carried = ["--platform", wheel_grid.PLATFORM_HERE, "--python", here]
    return build_extension(tmp_path_factory.mktemp("extension"), *carried)


@pytest.fixture(scope="session")
def installed(extension_zip):
    """The name of the add-on, installed from its zip and enabled."""
    bpy.ops.extensions.package_install_files(
        filepath=str(extension_zip), repo="user_default", enable_on_install=True, overwrite=True
    )
    assert ADDON in bpy.context.preferences.addons, "the extension was not enabled: see the output above"
    return ADDON


BATCH = str(ROOT / "batch.py")


def batch_command(*arguments, file=None):
    """`batch.py` as this Blender runs it, with a file open where one is given."""
    if INSIDE_BLENDER:
        opened = [] if file is None else [str(file)]
        return [bpy.app.binary_path, "--background", *opened, "--python", BATCH, "--", *arguments]
    assert file is None, "the bpy module opens no file for a program"
    return [sys.executable, BATCH, *arguments]


def run(command, folder):
    """Run a program in a profile of the folder's own: one without the extension, unless it is put there."""
    environment = {**os.environ, "BLENDER_USER_RESOURCES": str(folder / "profile")}
    (folder / "profile").mkdir(exist_ok=True)
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, timeout=600)


@pytest.fixture(scope="session")
def profile(tmp_path_factory, extension_zip):
    """A folder whose profile has the extension, installed by Blender's own command line."""
    folder = tmp_path_factory.mktemp("installed")
    command = [bpy.app.binary_path, "--command", "extension", "install-file", "--repo", "user_default", "--enable"]
    done = run([*command, str(extension_zip)], folder)
    assert done.returncode == 0, done.stdout + done.stderr
    return folder


@pytest.fixture(autouse=True)
def fresh_file(installed):
    """An empty file for each test, and afterwards a clean conscience towards Blender's extension policies.

    `read_factory_settings` would disable the add-on.
    """
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    yield
    assert policy_warnings() == {}
    assert engine_twins() == []


@pytest.fixture
def addon(installed):
    """The add-on's root module."""
    return sys.modules[installed]


@pytest.fixture
def engine(addon):
    """The engine package inside the installed extension, the only copy that a test may use."""
    return importlib.import_module(f"{addon.__name__}.geoanalogy")
