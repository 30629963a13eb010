"""The batch program as a farm starts it: a process of its own, judged by its exit code."""

import os
import subprocess
import sys

import bpy
import pytest
from conftest import INSIDE_BLENDER, ROOT

BATCH = str(ROOT / "batch.py")


def run(command, folder):
    """Run a program in a profile that has no extension."""
    environment = {**os.environ, "BLENDER_USER_RESOURCES": str(folder / "profile")}
    (folder / "profile").mkdir(exist_ok=True)
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, timeout=300)


def batch_command(*arguments):
    """`batch.py` as this Blender runs it."""
    if INSIDE_BLENDER:
        return [bpy.app.binary_path, "--background", "--python", BATCH, "--", *arguments]
    return [sys.executable, BATCH, *arguments]


def test_wrong_usage_is_code_2(tmp_path):
    done = run(batch_command("replay"), tmp_path)
    assert done.returncode == 2
    assert "replay needs --output, --render or both" in done.stderr


def test_help_names_the_exit_codes(tmp_path):
    done = run(batch_command("--help"), tmp_path)
    assert done.returncode == 0
    assert "4 cancelled" in done.stdout


def test_a_result_with_nowhere_to_go_is_code_5(tmp_path):
    done = run(batch_command("replay", "--output", "nowhere/out.blend"), tmp_path)
    assert done.returncode == 5
    assert "its folder does not exist" in done.stderr


needs_blender = pytest.mark.skipif(not INSIDE_BLENDER, reason="the bpy module has no command line")


@pytest.fixture(scope="module")
def profile(tmp_path_factory, extension_zip):
    """A profile into which Blender's own command line has installed the extension."""
    folder = tmp_path_factory.mktemp("installed")
    command = [bpy.app.binary_path, "--command", "extension", "install-file", "--repo", "user_default", "--enable"]
    done = run([*command, str(extension_zip)], folder)
    assert done.returncode == 0, done.stdout + done.stderr
    return folder


@needs_blender
@pytest.mark.parametrize(
    ("arguments", "code"), [(["--help"], 0), (["replay"], 2), (["replay", "--output", "x.png"], 2)]
)
def test_the_enabled_add_on_is_a_command_of_blender(profile, arguments, code):
    done = run([bpy.app.binary_path, "--background", "--command", "geoanalogy", *arguments], profile)
    assert done.returncode == code
    assert "Policy violation" not in done.stdout + done.stderr


@needs_blender
def test_batch_py_uses_the_engine_of_the_enabled_add_on(profile):
    done = run(batch_command("replay", "--output", "x.png"), profile)
    assert done.returncode == 2
    script = f"import runpy, sys; runpy.run_path({BATCH!r})['command_line'](); print('geoanalogy' in sys.modules)"
    done = run([bpy.app.binary_path, "--background", "--python-expr", script], profile)
    assert "False" in done.stdout.splitlines()
