"""The batch program as a farm starts it: a process of its own, judged by its exit code."""

import bpy
import pytest
from conftest import BATCH, INSIDE_BLENDER, batch_command, run
from flats import bed, face, placed, results, rooms


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


@pytest.fixture
def furnished(tmp_path):
    """A file with rooms, one of another shape, a bed and its propagation."""
    rooms()
    face("hall", [(15, 0), (22, 0), (22, 5), (15, 5)], "bedroom")
    bed()
    bpy.ops.geoanalogy.propagate("EXEC_DEFAULT", True, most=0, threshold=0.95)
    render = bpy.context.scene.render
    render.resolution_x, render.resolution_y = 48, 32
    path = tmp_path / "flat.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    return path


def test_replay_writes_the_same_scene_and_a_picture(furnished, tmp_path):
    expected = placed()
    arguments = ["--output", str(tmp_path / "out.blend"), "--render", str(tmp_path / "out.png")]
    if INSIDE_BLENDER:
        done = run(batch_command("replay", *arguments, file=furnished), tmp_path)
    else:
        done = run(batch_command("replay", str(furnished), *arguments), tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    assert f"1 operations replayed, {len(expected)} objects made" in done.stdout
    assert "[100%] placing objects" in done.stderr
    assert (tmp_path / "out.png").read_bytes()[:4] == b"\x89PNG"
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "out.blend"))
    assert placed() == expected


def test_replay_takes_another_threshold(furnished, tmp_path):
    output = tmp_path / "out.blend"
    done = run(batch_command("replay", str(furnished), "--output", str(output), "--threshold", "0.2"), tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    before = len(results())
    bpy.ops.wm.open_mainfile(filepath=str(output))
    assert len(results()) > before


def missing(folder):
    return folder / "missing.blend"


def empty(folder):
    (folder / "empty.blend").touch()
    return folder / "empty.blend"


def garbage(folder):
    (folder / "garbage.blend").write_bytes(b"BLENDER-garbage" * 100)
    return folder / "garbage.blend"


def without_operations(folder):
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "bare.blend"))
    return folder / "bare.blend"


def from_a_newer_version(folder):
    rooms()
    bed()
    bpy.ops.geoanalogy.propagate("EXEC_DEFAULT", True)
    bpy.context.scene.geoanalogy.tree.nodes[0]["operation"]["schema"] = "geoanalogy.operations/99"
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "newer.blend"))
    return folder / "newer.blend"


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (missing, "missing.blend is not there"),
        (empty, "empty.blend is empty"),
        (garbage, "garbage.blend cannot be opened"),
        (without_operations, "has no operations"),
        (from_a_newer_version, "saved by a newer version"),
    ],
)
def test_a_file_that_cannot_be_replayed_is_code_3(make, message, tmp_path):
    output = tmp_path / "out.blend"
    done = run(batch_command("replay", str(make(tmp_path)), "--output", str(output)), tmp_path)
    assert done.returncode == 3, done.stdout + done.stderr
    assert message in done.stderr
    assert not output.exists()
